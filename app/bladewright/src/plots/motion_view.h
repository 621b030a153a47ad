// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <QToolButton>
#include <QWidget>

#include "controls/fields.h"
#include "controls/theme.h"
#include "plots/timeline.h"
#include "workbench/workbench.h"

namespace bw::app {

/// The motion tab: play, step and scrub the blade through the block.
class MotionView : public QWidget {
  Q_OBJECT

 public:
  MotionView(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  bool playing() const { return timer_.isActive(); }
  Timeline& timeline() { return *timeline_; }

 public slots:
  void togglePlay();
  void stepStation(int by);
  void goTo(double seconds);

 private:
  void refresh();
  void tick();

  Workbench& bench_;
  const Theme& theme_;
  Timeline* timeline_;
  QToolButton* play_;
  QList<QToolButton*> buttons_;
  ChoiceField* pace_;
  QCheckBox* blade_;
  QLabel* clock_;
  QTimer timer_;
  QElapsedTimer elapsed_;
};

}  // namespace bw::app
