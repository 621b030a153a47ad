// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

#include <algorithm>
#include <cmath>

namespace bw::view {

/// The picture's pixels in a widget, whose own coordinates are device-independent.
class Viewport {
 public:
  explicit Viewport(const QWidget* widget) : widget_(widget) {}

  /// Pixels a device-independent one.
  double ratio() const { return widget_->devicePixelRatioF(); }
  int width() const { return pixels(widget_->width()); }
  int height() const { return pixels(widget_->height()); }
  double aspect() const { return double(width()) / height(); }

 private:
  int pixels(int length) const { return std::max(1, int(std::lround(length * ratio()))); }

  const QWidget* widget_;
};

}  // namespace bw::view
