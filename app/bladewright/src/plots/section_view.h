// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

#include <vector>

#include "controls/numbers.h"
#include "controls/theme.h"
#include "plots/section_drawing.h"
#include "workbench/workbench.h"

namespace bw::app {

/// The selected station in its plane: target curve with the tolerance band, elastica, the blade's extensions
/// (dashed) and grips, the foam, and the curvature below against the blade's limit. Over it a bar a station
/// with its deviation: click or arrow keys choose.
class SectionView : public QWidget {
  Q_OBJECT

 public:
  SectionView(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  /// How many times the distance between elastica and target is drawn larger than it is.
  void setExaggeration(double factor);
  double exaggeration() const { return exaggeration_; }
  /// Where the bar of a station stands, for tests and screen readers.
  QRectF barRect(int station) const;
  QSize sizeHint() const override { return {680, 220}; }
  QSize minimumSizeHint() const override { return {320, 120}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  void rebuild();
  void rebuildDrawing();
  int stationAt(const QPointF& position) const;
  void paintBars(QPainter& painter) const;
  int shownStation() const;

  Workbench& bench_;
  const Theme& theme_;
  std::vector<StationNumbers> numbers_;
  SectionDrawing drawing_;
  double exaggeration_ = 1;
  double tolerance_ = 2;
  int hovered_ = -1;
};

}  // namespace bw::app
