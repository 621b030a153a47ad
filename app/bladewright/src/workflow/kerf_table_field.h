// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/sweep/kerf_table.h"
#include "controls/typed_field.h"

namespace bw::app {

/// The kerf over the speed of the blade as pairs of both, "5: 4.2, 20: 2.6"; empty where one width serves.
class KerfTableField : public TypedField {
  Q_OBJECT

 public:
  explicit KerfTableField(QWidget* parent = nullptr);

  /// Shows a table without telling it as an edit. A field that is being typed into keeps its text.
  void show(const KerfTable& table);
  using QWidget::show;

 signals:
  void edited(const bw::KerfTable& table);

 protected:
  QString take(const QString& text) override;
  QString valueText() const override;
  QString limitsText() const override;

 private:
  KerfTable table_;
};

}  // namespace bw::app
