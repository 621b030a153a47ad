// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QLabel>
#include <QPushButton>
#include <QWidget>

#include "controls/fields.h"
#include "controls/theme.h"
#include "measure/blade_measuring.h"
#include "measure/measure_answer.h"
#include "measure/measure_drawing.h"
#include "measure/measure_table.h"
#include "workbench/workbench.h"

namespace bw::app {

/// The length of the mounted blade from how far it sags between its grips; the answer follows while numbers
/// are typed, and can be given to the design.
class MeasurePage : public QWidget {
  Q_OBJECT

 public:
  MeasurePage(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  /// Before it is shown: starts with a sensible way to hold the blade of the design.
  void enter();
  MeasureTable& table() { return *table_; }
  MeasureDrawing& drawing() { return *drawing_; }
  QPushButton* useButton() { return answer_->useButton(); }
  const MeasurementOutcome& outcome() const { return outcome_; }
  /// What the page tells in words: the problem, or a warning, or nothing.
  QString message() const { return answer_->message(); }

 signals:
  /// Done: back to where the user came from.
  void left();

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QWidget* makeInput();
  void refresh();
  void refreshDrawing();

  Workbench& bench_;
  const Theme& theme_;
  MeasurementOutcome outcome_;
  QLabel* blade_;
  ChoiceField* ends_;
  MeasureTable* table_;
  NumberField *heightError_, *angleError_, *distanceError_;
  QCheckBox *heightOffset_, *angleOffset_;
  MeasureDrawing* drawing_;
  MeasureAnswer* answer_;
  bool entered_ = false;
};

}  // namespace bw::app
