// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QPolygonF>
#include <QWidget>

#include <limits>
#include <optional>
#include <vector>

#include "controls/numbers.h"
#include "controls/theme.h"
#include "plots/plot_axes.h"
#include "workbench/workbench.h"

namespace bw::app {

/// Speed (slowest to fastest point of the blade), bending stress, stability margin and energy barrier over
/// time, with the playhead: drag to scrub. The wheel zooms to the time under the cursor, with Shift it moves,
/// a double click shows all again; what lies under the cursor stands beside it.
class Timeline : public QWidget {
  Q_OBJECT

 public:
  Timeline(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  /// The x of a time, and the time of an x, in the widget.
  double xOf(double seconds) const;
  double timeAt(double x) const;
  /// The seconds that are seen.
  AxisRange seen() const { return seen_; }
  /// What stands beside the cursor; empty if nothing does.
  QStringList readout() const;
  QSize sizeHint() const override { return {680, 150}; }
  QSize minimumSizeHint() const override { return {320, 80}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;

 private:
  struct Sample {
    double time, speedMin, speedMax, stress;
  };
  void follow(const Change& change);
  void rebuild();
  /// One curve over time, or the band between two.
  struct Track {
    QString title;
    std::vector<QPolygonF> high;  ///< over seconds, a line for each stretch that is known
    QPolygonF low = {};           ///< likewise, of one line; empty: the band begins at 0
    std::optional<double> limit = std::nullopt;
    bool least = false;  ///< the limit is what is kept at least
    QString limitText = {};
    bool dots = false;  ///< its points are marked: between them nothing is known
    /// What lies above runs out of the plot, so that what is near the limit can be told apart.
    double top = std::numeric_limits<double>::infinity();
  };
  void paintPlot(QPainter& painter, const QRectF& area, const Track& track) const;
  std::vector<Track> tracks() const;
  /// N mm at a time between two looks, or near one; none where nothing is known.
  std::optional<double> barrierAt(double seconds) const;
  /// The numbers at a time, between the stations in proportion.
  Sample at(double seconds) const;
  void zoom(double about, double factor);

  Workbench& bench_;
  const Theme& theme_;
  std::vector<Sample> samples_;
  QPolygonF margins_;  ///< of stability over seconds, as the motion is run; empty until that is known
  /// N mm over seconds, likewise: a polygon for each stretch of looks where another shape is about as low.
  std::vector<QPolygonF> barriers_;
  double end_ = 0;
  AxisRange seen_;      ///< s
  double cursor_ = -1;  ///< x in the widget; −1 outside
};

}  // namespace bw::app
