// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

#include <optional>
#include <utility>
#include <vector>

#include "controls/numbers.h"
#include "controls/theme.h"
#include "plots/section_grips.h"
#include "plots/section_plots.h"
#include "workbench/workbench.h"

namespace bw::app {

/// The selected station in its plane: target curve with the tolerance band, elastica, the blade's extensions
/// (dashed) and grips, the foam, and beside it the curvature against the blade's limit. Over it a bar a
/// station with its deviation: click, wheel or arrow keys choose. Over the plots the wheel zooms to the
/// cursor, dragging moves, a double click shows all again; what lies under the cursor stands beside it.
/// Points of the surface that lie in the plane of the station are pulled in it.
class SectionView : public QWidget {
  Q_OBJECT

 public:
  SectionView(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  /// How many times the distance between elastica and target is drawn larger than it is.
  void setExaggeration(double factor);
  double exaggeration() const { return exaggeration_; }
  /// The station that is shown; −1 without one.
  int shownStation() const;
  /// Where the bar of a station stands, for tests and screen readers.
  QRectF barRect(int station) const;
  /// Where the section and the curvature are plotted.
  QRectF sectionArea() const;
  QRectF curvatureArea() const;
  /// What the section shows of its plane, and the curvature of the blade, mm.
  AxisRange seenAcross() const { return frame().x; }
  AxisRange seenAlong() const { return along_; }
  /// Who tells which points of the surface lie in a plane.
  void setGrips(FindGrips find) { findGrips_ = std::move(find); }
  /// Those in the plane of the station that is shown, and where one of them is in the widget.
  SectionGrips grips() const;
  QPointF placeOf(const SectionGrips::Grip& grip) const;
  /// What stands beside the cursor; empty if nothing does.
  QStringList readout() const;
  QSize sizeHint() const override { return {680, 220}; }
  QSize minimumSizeHint() const override { return {320, 120}; }

 signals:
  /// A point of the surface is pressed, moved in the plane of the station by so many mm from where it was
  /// taken hold of, and let go of; `givenUp`: what it did is to be undone.
  void gripPressed(int handle, Qt::KeyboardModifiers keys);
  /// `pixel`: mm of a pixel.
  void gripMoved(const bw::Frame& plane, const Eigen::Vector2d& by, double pixel, Qt::KeyboardModifiers keys);
  void gripReleased(bool givenUp);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  static constexpr int kBarsHeight = 34;  ///< of the bars above, their room included

  void follow(const Change& change);
  void rebuild();
  void rebuildDrawing();
  int stationAt(const QPointF& position) const;
  void paintBars(QPainter& painter) const;
  void paintCursor(QPainter& painter) const;
  SectionFrame frame() const;
  /// How the plane lies in the widget, which stays while a grip is held.
  SectionFrame seen() const;
  AxisRange wholeAlong() const;
  /// Comes nearer to a place of the widget by a factor below 1, or goes away from it.
  void zoomAt(const QPointF& position, double factor);
  void showAll();
  /// Lets go of the grip that is held.
  void letGo(bool givenUp);

  Workbench& bench_;
  const Theme& theme_;
  std::vector<StationNumbers> numbers_;
  SectionDrawing drawing_;
  double exaggeration_ = 1;
  double tolerance_ = 2;
  int hovered_ = -1;
  QRectF window_;    ///< mm of the plane that is seen; null: all
  AxisRange along_;  ///< mm of the blade that are seen
  QPointF cursor_;   ///< in the widget; null outside
  QPointF grabbed_;  ///< where the drag is, in the widget; null without one
  /// The grip that is held, and the plane as it was when it was taken hold of.
  struct Hold {
    SectionFrame seen;
    QPointF from;  ///< mm in the plane as it is shown, where the hand was
    Frame plane;
    ShownPlane shown;
  };
  FindGrips findGrips_;
  std::optional<Hold> hold_;
};

}  // namespace bw::app
