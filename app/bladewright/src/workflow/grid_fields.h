// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>

#include <array>
#include <functional>
#include <vector>

#include "bw/core/design/block_grid.h"
#include "controls/fields.h"
#include "controls/number_field.h"
#include "controls/typed_field.h"
#include "workbench/workbench.h"

namespace bw::app {

/// A line of lengths in mm, one for all or one each: "600", "600; 500; 600". A comma followed by a space
/// parts them too.
class LengthsField : public TypedField {
  Q_OBJECT

 public:
  /// Each lies between `min` and `max`, mm.
  LengthsField(double min, double max, QWidget* parent = nullptr);

  /// Shows the lengths without telling them as an edit. A field that is being typed into keeps its text.
  void show(const std::vector<double>& lengths);
  using QWidget::show;

 signals:
  /// As many as were shown.
  void edited(const std::vector<double>& lengths);

 protected:
  QString take(const QString& text) override;
  QString valueText() const override;
  QString limitsText() const override;

 private:
  double min_, max_;
  std::vector<double> lengths_;
};

/// How many blocks lie side by side, how large they are and how far apart; edits go to the design, whose
/// cuts follow.
class GridFields : public QObject {
  Q_OBJECT

 public:
  /// Adds its lines to `column`.
  GridFields(Workbench& bench, FormColumn* column, QObject* parent);
  void refresh();

 private:
  void changeCount(std::size_t way, int count);
  void change(const QString& text, const std::function<void(BlockGrid&)>& change);

  Workbench& bench_;
  std::array<NumberField*, 3> counts_;
  std::array<LengthsField*, 3> sizes_, gaps_;
  QLabel* listed_;
};

}  // namespace bw::app
