// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QScrollArea>
#include <QStackedWidget>

#include <functional>
#include <vector>

#include "controls/fields.h"
#include "workbench/workbench.h"
#include "workflow/blade_fields.h"
#include "workflow/block_fields.h"

namespace bw::app {

/// The right panel: the numbers of what is selected, editable where they are settings.
class Inspector : public QScrollArea {
  Q_OBJECT

 public:
  Inspector(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  const BladeFields* bladeFields() const { return bladeFields_; }

 private:
  /// A read-only line: its label and how its text follows from the result.
  struct Value {
    QLabel* label;
    std::function<QString()> text;
  };
  FormColumn* addPage(Selection::Kind kind);
  void addValue(FormColumn* column, const QString& name, const QString& tip, std::function<QString()> text);
  void makeResult();
  void makeSurface();
  void makeBlock();
  void makeBlade();
  void makeStation();
  void refresh();
  const Station* station() const;
  const SweepSummary* summary() const;

  Workbench& bench_;
  const Theme& theme_;
  ChoiceField* kind_;
  QStackedWidget* pages_;
  QLabel* empty_;
  std::vector<Value> values_;
  BlockFields* blockFields_ = nullptr;
  BladeFields* bladeFields_ = nullptr;
  NumberField* stationNumber_ = nullptr;
};

}  // namespace bw::app
