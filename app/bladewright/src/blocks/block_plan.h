// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QRectF>
#include <QWidget>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/design/block_grid.h"
#include "controls/theme.h"
#include "workbench/workbench.h"
#include "workflow/export_blocks.h"

namespace bw::app {

/// The blocks of the design as seen from above, one layer at a time, each with how it stands in colour and
/// word. A click chooses a block, the arrow keys its neighbours, Page Up and Page Down the layers. A boundary
/// between two columns or rows is pulled: in whole mm, with Shift in steps of 10, with Ctrl or Alt by a tenth
/// of the way of the hand; Esc gives a pull up. Blocks that are a list lie in their place and are only
/// chosen. Where blocks are too narrow to be hit the wheel brings them nearer, elsewhere with Ctrl; the plan
/// is pulled then, and shows the block that is selected.
class BlockPlan : public QWidget {
  Q_OBJECT

 public:
  BlockPlan(Workbench& bench, const Theme& theme, QWidget* parent = nullptr);

  void refresh();
  int layers() const { return layers_; }
  int layer() const { return layer_; }
  void setLayer(int layer);
  /// How a block stands in the plan: "cuttable", a count of warnings or errors, "not computed".
  QString wordOf(const std::string& block) const;
  /// Where a block of the layer is seen; empty where it is none of it.
  QRectF rectOf(const std::string& block) const;
  /// The middle of the boundary behind a column (`way` 0) or row (`way` 1), in the widget.
  QPointF boundary(std::size_t way, std::size_t index) const;

  QSize sizeHint() const override { return {380, 180}; }
  QSize minimumSizeHint() const override { return {240, 150}; }

 signals:
  /// Another layer is seen, or there is another number of them.
  void layersChanged();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;

 private:
  struct Cell {
    std::string id;
    QRectF place;  ///< mm, x along the columns, y along the rows
    std::array<int, 3> at = {0, 0, 0};
    BlockStanding standing;
  };
  struct Boundary {
    std::size_t way, index;
    bool operator==(const Boundary&) const = default;
  };
  /// The design and its grid as they were when a boundary was pressed.
  struct Pull {
    Boundary boundary;
    Design from;
    BlockGrid grid;
    double began;  ///< mm along the way, where the hand took hold
    double by = 0;
    int mergeId = -1;
    bool moved = false;
  };

  void makeCells();
  /// Blocks that stand anywhere are in layers, too, where one lies over another: by the heights of their
  /// bottoms, mm.
  void layCells(const std::vector<double>& bottoms);
  /// Where blocks are drawn, in the widget.
  QRectF room() const;
  /// Pixels a mm where all of it is seen.
  double fitting() const;
  /// Pixels a mm, and where the first corner lies.
  std::pair<double, QPointF> scale() const;
  /// Moves what is seen so that a place of the plan (mm) lies there in the widget.
  void bring(const QPointF& place, const QPointF& position);
  QPointF placeAt(const QPointF& position) const { return {along(0, position), along(1, position)}; }
  QRectF toWidget(const QRectF& place) const;
  /// mm along a way of what lies under a place of the widget.
  double along(std::size_t way, const QPointF& position) const;
  const Cell* cellAt(const QPointF& position) const;
  const Cell* selected() const;
  std::optional<Boundary> boundaryAt(const QPointF& position) const;
  void choose(const Cell& cell);
  void pull(double by, bool live);
  void endPull(bool givenUp);
  QString tipOf(const Cell& cell) const;
  void paintCell(QPainter& painter, const Cell& cell) const;
  void paintSizes(QPainter& painter) const;

  Workbench& bench_;
  const Theme& theme_;
  std::optional<BlockGrid> grid_;
  std::vector<Cell> cells_;
  QRectF whole_;       ///< mm
  std::string shown_;  ///< the block that was selected last
  int layers_ = 1, layer_ = 0;
  double zoom_ = 1;  ///< times as large as where all of it is seen
  QPointF middle_;   ///< mm, the place of the plan in the middle of the room then
  std::optional<QPointF> grasped_ = std::nullopt;  ///< mm, the place of the plan that is pulled
  std::optional<Boundary> hovered_;
  std::optional<Pull> pull_;
};

}  // namespace bw::app
