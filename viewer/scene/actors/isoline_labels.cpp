// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/isoline_labels.h"

#include <algorithm>
#include <array>

namespace bw::scene {

namespace {

constexpr double kShortest = 0.04;  ///< diagonals: a shorter line carries no value
constexpr double kLong = 0.6;       ///< diagonals: a longer one carries several
constexpr double kTextSize = 11, kHeight = 15, kPadding = 4, kAir = 10;  ///< device-independent pixels
constexpr std::size_t kMost = 40;

Eigen::Vector3d pointAt(const Polyline& line, double arc) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double step = (line[i + 1] - line[i]).norm();
    if (arc <= step && step > 0) return line[i] + arc / step * (line[i + 1] - line[i]);
    arc -= step;
  }
  return line.back();
}

}  // namespace

void IsolineLabels::add(const std::vector<Isoline>& lines, const std::function<std::string(double)>& text,
                        double diagonal) {
  for (const Isoline& isoline : lines) {
    const double length = lengthOf(isoline.line);
    if (length < kShortest * diagonal) continue;
    const bool several = length > kLong * diagonal;
    // The middle first; where it is out of sight a place beside it stands in.
    for (const auto& [share, weight] : {std::pair(0.5, 1.0), std::pair(0.2, 0.4), std::pair(0.8, 0.4)}) {
      if (share != 0.5 && !several) continue;
      places_.push_back({pointAt(isoline.line, share * length), text(isoline.level), weight * length});
    }
  }
  std::ranges::stable_sort(places_, std::greater(), &Place::rank);
}

void IsolineLabels::update(const Projection& view, int width, int height, double pixelRatio,
                           const std::vector<PixelRect>& taken,
                           const std::function<bool(const Eigen::Vector3d&)>& seen) {
  canvas_.begin(width, height);
  std::vector<PixelRect> boxes = taken;
  // Lines are dark in both themes, and so are their values, on a light ground of their own.
  const TextLook look{kTextSize * pixelRatio, false, kLineOverSurface, 1};
  std::size_t drawn = 0;
  for (const Place& place : places_) {
    if (drawn == kMost) break;
    const Eigen::Vector3d pixel = view.toPixel(place.point);
    if (!view.parallel() && pixel.z() <= 0) continue;
    const double w = Canvas::textWidth(place.text, look) + 2 * kPadding * pixelRatio,
                 h = kHeight * pixelRatio, air = kAir * pixelRatio;
    const PixelRect box{pixel.x() - 0.5 * w, pixel.y() - 0.5 * h, w, h};
    const PixelRect wide{box.x - air, box.y - air, w + 2 * air, h + 2 * air};
    if (box.x < 0 || box.y < 0 || box.x + w > width || box.y + h > height) continue;
    if (std::any_of(boxes.begin(), boxes.end(), [&](const PixelRect& b) { return b.overlaps(wide); }))
      continue;
    if (!seen(place.point)) continue;
    boxes.push_back(box);
    canvas_.roundedRect(box, 0.5 * h, Rgb::hex(0xFFFFFF), 0.85);
    canvas_.text(place.text, pixel.x(), pixel.y(), Align::center, look);
    ++drawn;
  }
  canvas_.end();
}

}  // namespace bw::scene
