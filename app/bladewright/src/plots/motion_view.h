// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <QToolButton>
#include <QWidget>

#include <vector>

#include "controls/fields.h"
#include "controls/numbers.h"
#include "controls/theme.h"
#include "workbench/workbench.h"

namespace bw::app {

/// Speed (slowest to fastest point of the blade) and bending stress over time, with the playhead: drag to
/// scrub.
class Timeline : public QWidget {
  Q_OBJECT

 public:
  Timeline(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  /// The x of a time, and the time of an x, in the widget.
  double xOf(double seconds) const;
  double timeAt(double x) const;
  QSize sizeHint() const override { return {680, 150}; }
  QSize minimumSizeHint() const override { return {320, 80}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;

 private:
  struct Sample {
    double time, speedMin, speedMax, stress;
  };
  void rebuild();
  void paintPlot(QPainter& painter, const QRectF& area, const QString& title, const QString& unit,
                 double limit, const QString& limitText, double Sample::*low, double Sample::*high) const;

  Workbench& bench_;
  const Theme& theme_;
  std::vector<Sample> samples_;
  double end_ = 0;
};

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
