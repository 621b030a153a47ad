// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QLabel>
#include <QPushButton>
#include <QWidget>

#include "controls/theme.h"
#include "measure/blade_measuring.h"
#include "workbench/workbench.h"

namespace bw::app {

/// What the measurements tell: the length of the blade and how sure it is, the measurement chosen alone, what
/// is wrong with them, and the button that gives the length to the design.
class MeasureAnswer : public QWidget {
  Q_OBJECT

 public:
  MeasureAnswer(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  /// `chosen` is the row whose numbers are shown alone; `hinged` as on the sheet that was evaluated.
  /// `outdated`: something else is typed that is refused.
  void setOutcome(const MeasurementOutcome& outcome, int chosen, bool hinged, bool outdated = false);
  QPushButton* useButton() { return use_; }
  /// What it tells in words: the problem, or a warning, or nothing.
  QString message() const { return message_->text(); }

 signals:
  /// The length was given to the design, or is already its own.
  void used();

 private:
  QLayout* makeMessage();
  QLayout* makeCommon();
  QLayout* makeSingle();
  void refreshCommon();
  void refreshUse();
  void refreshSingle(int chosen, bool hinged);
  void tellProblem();
  void use();
  double storedLength() const;

  Workbench& bench_;
  const Theme& theme_;
  MeasurementOutcome outcome_;
  bool outdated_ = false;
  QLabel *icon_, *message_;
  QLabel *length_, *interval_, *reference_, *fit_;
  QPushButton* use_;
  QLabel* useNote_;
  QLabel *one_, *case_, *byHeight_, *byAngle_, *byDistance_, *radius_;
};

}  // namespace bw::app
