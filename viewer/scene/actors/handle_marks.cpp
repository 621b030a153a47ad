// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/handle_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>

#include "scene/render/text_wrap.h"
#include "scene/theme.h"

namespace bw::scene {

namespace {

// Device-independent pixels.
constexpr double kDisc = 4.5, kLitDisc = 6.5, kQuietDisc = 1.8, kRim = 1.5, kLine = 1, kCurve = 1.5,
                 kWay = 2.5, kTick = 7, kReach = 10;
constexpr double kPadding = 8, kTextLine = 17, kAway = 18, kMargin = 8;
constexpr std::size_t kColumns = 44, kMostLines = 4;

struct Spot {
  Eigen::Vector2d pixel;
  double depth = 0;
  bool seen = false;
};

Spot spotOf(const Projection& view, const Eigen::Vector3d& point) {
  if (!point.allFinite()) return {};
  const Eigen::Vector3d pixel = view.toPixel(point);
  return {pixel.head<2>(), pixel.z(), pixel.allFinite() && (view.parallel() || pixel.z() > 0)};
}

/// Lines far beyond the picture are cut off, so that the canvas takes only numbers of its size.
bool near(const Spot& spot, int width, int height) {
  return spot.seen && std::abs(spot.pixel.x()) < 20.0 * width && std::abs(spot.pixel.y()) < 20.0 * height;
}

}  // namespace

int handleAt(const Handles& handles, const Projection& view, double x, double y, double pixelRatio) {
  int best = -1;
  double depth = 0;
  for (std::size_t i = 0; i < handles.points.size(); ++i) {
    const Spot spot = spotOf(view, handles.points[i]);
    if (!spot.seen || (spot.pixel - Eigen::Vector2d(x, y)).norm() > kReach * pixelRatio) continue;
    // Of those that stand back one is found where no other is.
    const bool quiet = i < handles.quiet, bestQuiet = std::size_t(best) < handles.quiet;
    if (best >= 0 && (quiet != bestQuiet ? quiet : spot.depth >= depth)) continue;
    best = int(i);
    depth = spot.depth;
  }
  return best;
}

void HandleMarks::update(const Projection& view, int width, int height, const Style& style,
                         const std::vector<PixelRect>& taken) {
  canvas_.begin(height);
  card_ = std::nullopt;
  const Handles& handles = style.handles;
  const Theme& colors = theme(style.dark);
  const double px = style.pixelRatio;
  std::vector<Spot> spots;
  for (const Eigen::Vector3d& point : handles.points) spots.push_back(spotOf(view, point));
  const auto there = [&](int i) {
    return i >= 0 && std::size_t(i) < spots.size() && near(spots[std::size_t(i)], width, height);
  };
  for (const std::array<int, 2>& one : handles.lines)
    if (there(one[0]) && there(one[1]))
      canvas_.line(spots[std::size_t(one[0])].pixel, spots[std::size_t(one[1])].pixel, kLine * px,
                   colors.selection, 0.45);
  for (const Polyline& curve : handles.curves)
    for (std::size_t k = 1; k < curve.size(); ++k) {
      const Spot from = spotOf(view, curve[k - 1]), to = spotOf(view, curve[k]);
      if (near(from, width, height) && near(to, width, height))
        canvas_.line(from.pixel, to.pixel, kCurve * px, colors.selection, 0.8);
    }
  const Polyline& corners = handles.region.corners;
  if (there(handles.lit))
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Eigen::Vector2d& middle = spots[std::size_t(handles.lit)].pixel;
      const Spot from = spotOf(view, corners[k]), to = spotOf(view, corners[(k + 1) % corners.size()]);
      if (!near(from, width, height) || !near(to, width, height)) continue;
      canvas_.triangle(middle.x(), middle.y(), from.pixel.x(), from.pixel.y(), to.pixel.x(), to.pixel.y(),
                       colors.selection, 0.18);
      if (handles.region.ends[k]) canvas_.line(from.pixel, to.pixel, kCurve * px, colors.error, 0.7);
    }
  for (const HandleWay& way : handles.ways) {
    const Spot from = spotOf(view, way.from), to = spotOf(view, way.to);
    if (!near(from, width, height) || !near(to, width, height)) continue;
    canvas_.line(from.pixel, to.pixel, kWay * px, colors.selection);
    // Where it ends for a reason.
    const Eigen::Vector2d along = to.pixel - from.pixel;
    if (!(along.norm() > 0)) continue;
    const Eigen::Vector2d across = kTick * px * Eigen::Vector2d(-along.y(), along.x()).normalized();
    if (way.endsAtFrom) canvas_.line(from.pixel - across, from.pixel + across, kWay * px, colors.error);
    if (way.endsAtTo) canvas_.line(to.pixel - across, to.pixel + across, kWay * px, colors.error);
  }
  const auto disc = [&](int i, const Rgb& color, double radius) {
    if (!there(i)) return;
    const Eigen::Vector2d& at = spots[std::size_t(i)].pixel;
    canvas_.disc(at.x(), at.y(), (radius + kRim) * px, colors.panel);
    canvas_.disc(at.x(), at.y(), radius * px, color);
  };
  for (int i = 0; i < int(spots.size()); ++i) {
    if (i == handles.lit || !there(i)) continue;
    if (std::size_t(i) >= handles.quiet) {
      disc(i, colors.selection, kDisc);
      continue;
    }
    const Eigen::Vector2d& at = spots[std::size_t(i)].pixel;
    canvas_.disc(at.x(), at.y(), (kQuietDisc + kRim) * px, colors.selection);
    canvas_.disc(at.x(), at.y(), kQuietDisc * px, colors.panel);
  }
  for (const int chosen : handles.chosen)
    if (chosen != handles.lit) disc(chosen, colors.accent, kDisc);
  if (there(handles.lit)) {
    disc(handles.lit, handles.stopped ? colors.error : colors.accent, kLitDisc);
    std::vector<std::string> lines;
    std::istringstream paragraphs(handles.text);
    for (std::string paragraph; std::getline(paragraphs, paragraph);)
      std::ranges::copy(wrapped(paragraph, kColumns, kMostLines), std::back_inserter(lines));
    const TextLook look{12 * px, false, colors.text};
    double textWidth = 0;
    for (const std::string& text : lines) textWidth = std::max(textWidth, canvas_.textWidth(text, look));
    const double w = std::ceil(textWidth) + 2 * kPadding * px,
                 h = double(lines.size()) * kTextLine * px + (kPadding - 2) * px, away = kAway * px,
                 margin = kMargin * px;
    if (!handles.text.empty() && w + 2 * margin <= width && h + 2 * margin <= height) {
      const Eigen::Vector2d& at = spots[std::size_t(handles.lit)].pixel;
      PixelRect best{};
      for (const double side : {1.0, -1.0}) {
        const double left = side > 0 ? at.x() + away : at.x() - away - w;
        best = {std::clamp(left, margin, width - margin - w),
                std::clamp(at.y() - 0.5 * h, margin, height - margin - h), w, h};
        if (std::ranges::none_of(taken, [&](const PixelRect& other) { return other.overlaps(best); })) break;
      }
      card_ = best;
      const double hair = std::max(1.0, px);
      canvas_.roundedRect({best.x - hair, best.y - hair, w + 2 * hair, h + 2 * hair}, 6 * px,
                          handles.stopped ? colors.error : colors.selection);
      canvas_.roundedRect(best, 5 * px, colors.panel);
      for (std::size_t i = 0; i < lines.size(); ++i)
        canvas_.text(lines[i], best.x + kPadding * px,
                     best.y + (0.5 * (kPadding - 2) + kTextLine * (double(i) + 0.5)) * px, Align::left, look);
    }
  }
  canvas_.end();
}

}  // namespace bw::scene
