// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/place_marker.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/render/text_wrap.h"

namespace bw::scene {

namespace {

// Device-independent pixels.
constexpr double kRing = 9, kHole = 6, kDot = 3, kPadding = 9, kLine = 17, kAway = 34, kMargin = 8;
constexpr std::size_t kColumns = 48, kLines = 4;

void drawLine(Canvas& canvas, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width,
              const Rgb& color) {
  const Eigen::Vector2d way = b - a;
  if (!(way.norm() > 0)) return;
  const Eigen::Vector2d side = 0.5 * width * Eigen::Vector2d(-way.y(), way.x()).normalized();
  const Eigen::Vector2d p = a + side, q = b + side, r = b - side, s = a - side;
  canvas.triangle(p.x(), p.y(), q.x(), q.y(), r.x(), r.y(), color);
  canvas.triangle(p.x(), p.y(), r.x(), r.y(), s.x(), s.y(), color);
}

}  // namespace

void PlaceMarker::update(const Projection& view, int width, int height, const Style& style,
                         const std::vector<PixelRect>& taken) {
  canvas_.begin(height);
  ring_ = card_ = std::nullopt;
  const bool given = style.marker && style.marker->point.allFinite();
  const Eigen::Vector3d pixel = given ? view.toPixel(style.marker->point) : Eigen::Vector3d::Zero();
  const bool inside = pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < width && pixel.y() < height;
  if (!given || !inside || (!view.parallel() && pixel.z() <= 0)) {
    canvas_.end();
    return;
  }
  const Theme& colors = theme(style.dark);
  const double px = style.pixelRatio;
  const Rgb& color = style.marker->severity == Severity::error     ? colors.error
                     : style.marker->severity == Severity::warning ? colors.warning
                                                                   : colors.selection;
  const double x = pixel.x(), y = pixel.y(), ring = kRing * px;
  ring_ = PixelRect{x - ring, y - ring, 2 * ring, 2 * ring};

  const std::vector<std::string> lines = wrapped(style.marker->text, kColumns, kLines);
  const TextLook look{12 * px, false, colors.text};
  double textWidth = 0;
  for (const std::string& line : lines) textWidth = std::max(textWidth, Canvas::textWidth(line, look));
  const double w = std::ceil(textWidth) + 2 * kPadding * px,
               h = double(lines.size()) * kLine * px + 2 * (kPadding - 3) * px, away = kAway * px,
               margin = kMargin * px;
  if (!lines.empty() && w + 2 * margin <= width && h + 2 * margin <= height) {
    // Above to the right, or where else it stands free; at the worst over something else.
    const std::array<Eigen::Vector2d, 4> corners = {{{x + 0.6 * away, y - away - h},
                                                     {x - 0.6 * away - w, y - away - h},
                                                     {x + 0.6 * away, y + away},
                                                     {x - 0.6 * away - w, y + away}}};
    PixelRect best{};
    for (std::size_t i = 0; i <= corners.size(); ++i) {
      const Eigen::Vector2d& corner = corners[i % corners.size()];
      best = {std::clamp(corner.x(), margin, width - margin - w),
              std::clamp(corner.y(), margin, height - margin - h), w, h};
      const bool free =
          std::none_of(taken.begin(), taken.end(), [&](const PixelRect& t) { return t.overlaps(best); }) &&
          !best.overlaps(*ring_);
      if (free) break;
    }
    card_ = best;
    const Eigen::Vector2d tip(std::clamp(x, best.x, best.x + w), std::clamp(y, best.y, best.y + h));
    drawLine(canvas_, {x, y}, tip, 1.5 * px, color);
    const double hair = std::max(1.0, px);
    canvas_.roundedRect({best.x - hair, best.y - hair, w + 2 * hair, h + 2 * hair}, 6 * px, color);
    canvas_.roundedRect(best, 5 * px, colors.panel);
    for (std::size_t i = 0; i < lines.size(); ++i)
      canvas_.text(lines[i], best.x + kPadding * px, best.y + (kPadding - 3 + kLine * (double(i) + 0.5)) * px,
                   Align::left, look);
  }
  canvas_.disc(x, y, ring, color);
  canvas_.disc(x, y, kHole * px, colors.panel);
  canvas_.disc(x, y, kDot * px, color);
  canvas_.end();
}

}  // namespace bw::scene
