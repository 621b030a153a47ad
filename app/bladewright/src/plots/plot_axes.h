// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QRectF>
#include <QString>

#include <vector>

#include "controls/theme.h"

class QPainter;

namespace bw::app {

/// The part of an axis that is seen. It lies within the whole, and is never narrower than a thousandth of it.
struct AxisRange {
  double low = 0, high = 0;

  double span() const { return high - low; }
  bool operator==(const AxisRange&) const = default;
  /// `factor` < 1 comes nearer; the value `about` stays where it is, as far as `whole` allows.
  [[nodiscard]] AxisRange zoomed(double about, double factor, const AxisRange& whole) const;
  /// Moved by `by`, not out of `whole`.
  [[nodiscard]] AxisRange moved(double by, const AxisRange& whole) const;
};

/// Round numbers in a range, about `count` of them.
struct AxisTicks {
  std::vector<double> values;
  int decimals = 0;  ///< that tell them apart
};
AxisTicks axisTicks(const AxisRange& range, int count);
/// A tick's number as it is written, with a true minus sign.
QString axisText(double value, int decimals);

/// The horizontal axis under `area`: ticks, numbers, the unit behind the last. Grid lines through the area if
/// `grid`.
void paintBottomAxis(QPainter& painter, const QRectF& area, const AxisRange& range, const QString& unit,
                     const Colours& colours, bool grid);
/// The vertical axis at the left of `area`, numbers right-aligned; `high` is at the top.
void paintLeftAxis(QPainter& painter, const QRectF& area, const AxisRange& range, const Colours& colours,
                   bool grid);

/// What lies under the cursor: a card with `lines` beside `at`, inside `bounds`.
void paintReadout(QPainter& painter, const QPointF& at, const QRectF& bounds, const QStringList& lines,
                  const Colours& colours);

}  // namespace bw::app
