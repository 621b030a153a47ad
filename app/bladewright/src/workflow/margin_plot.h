// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

#include <memory>

#include "bw/core/sweep/blade_lengths.h"
#include "controls/theme.h"

namespace bw::app {

/// What of the deviation a row gives for the margin of its blades: the margins that were tried against how
/// far the blades then lie from their sections, with the tolerance as a line. A click takes a margin.
class MarginPlot : public QWidget {
  Q_OBJECT

 public:
  explicit MarginPlot(const Theme& theme, QWidget* parent = nullptr);

  /// `trade` null: not known yet. `margin`: the one asked for; `tolerance` in mm.
  void show(std::shared_ptr<const MarginTrade> trade, double margin, double tolerance);
  using QWidget::show;
  /// Where a trial is drawn.
  QPointF placeOf(const RowTrial& trial) const;
  QSize sizeHint() const override { return {160, 110}; }
  QSize minimumSizeHint() const override { return {120, 110}; }

 signals:
  void chosen(double margin);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  bool event(QEvent* event) override;

 private:
  QRectF area() const;
  double xOf(double margin) const;
  double yOf(double deviation) const;
  double highest() const;  ///< mm, at the top
  /// The trial drawn nearest to a place; null where none is.
  const RowTrial* nearest(QPointF place) const;

  const Theme& theme_;
  std::shared_ptr<const MarginTrade> trade_;
  double margin_ = 0, tolerance_ = 1;
};

/// The least margin that serves, or that none does, or that it is not known yet.
QString marginsText(const MarginTrade* trade);

}  // namespace bw::app
