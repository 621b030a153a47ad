// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

#include <optional>

#include "bw/core/calibration/blade_length.h"
#include "controls/theme.h"

namespace bw::app {

/// A measured blade to scale between its grips, with distance, angle, height and length as dimensions; the
/// blade of the design in the same grips is dashed.
class MeasureDrawing : public QWidget {
  Q_OBJECT

 public:
  /// What is drawn; without `measured` the dimensions are those of `expected`.
  struct Content {
    double distance = 0;  ///< mm
    bool hinged = false;
    std::optional<BladeLength> measured;
    std::optional<BladeHeight> expected;
    double measuredHeight = 0;  ///< mm
    bool outdated = false;      ///< belongs to numbers typed before
  };

  explicit MeasureDrawing(const Theme& theme, QWidget* parent = nullptr);
  void setContent(Content content);
  const Content& content() const { return content_; }
  QSize sizeHint() const override { return {560, 320}; }
  QSize minimumSizeHint() const override { return {360, 200}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintKey(QPainter& painter, const QRectF& area) const;

  const Theme& theme_;
  Content content_;
};

}  // namespace bw::app
