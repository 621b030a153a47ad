// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/ground_grid.h"

#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/legend/ticks.h"

namespace bw::scene {

GroundGrid::GroundGrid(Layers& layers) {
  lines_.setFlat();
  lines_.mapper()->ScalarVisibilityOn();
  lines_.mapper()->SetColorModeToDirectScalars();
  // Tells VTK to draw after all that is solid: the fading is in the colours.
  lines_.actor()->ForceTranslucentOn();
  layers.add(Layer::ground, lines_);
  layers.add(Layer::ground, labels_);
}

void GroundGrid::setBounds(const Bounds& bounds) {
  content_ = bounds;
  rebuild();
}

void GroundGrid::setStyle(const Style& style) {
  const bool changed = style.dark != dark_;
  visible_ = style.showGrid;
  dark_ = style.dark;
  pixelRatio_ = style.pixelRatio;
  lines_.setLineWidth(pixelRatio_);
  lines_.setVisible(visible_ && content_.valid());
  if (changed) rebuild();
}

Bounds GroundGrid::bounds() const {
  Bounds result;
  if (!visible_ || !content_.valid()) return result;
  result.add({x0_ - reach_, y0_ - reach_, z_});
  result.add({x1_ + reach_, y1_ + reach_, z_});
  return result;
}

void GroundGrid::rebuild() {
  lines_.clear();
  lines_.setVisible(visible_ && content_.valid());
  if (!content_.valid()) return;
  const Eigen::Vector3d size = content_.size();
  step_ = roundStep(std::max({size.x(), size.y(), 0.2 * size.z(), 1.0}), 8);
  // Half a step of air around the content.
  const auto down = [&](double v) { return std::floor((v - 0.4 * step_) / step_) * step_; };
  const auto up = [&](double v) { return std::ceil((v + 0.4 * step_) / step_) * step_; };
  x0_ = down(content_.min.x());
  x1_ = up(content_.max.x());
  y0_ = down(content_.min.y());
  y1_ = up(content_.max.y());
  z_ = content_.min.z();
  const int out = int(std::ceil(0.6 * std::max(x1_ - x0_, y1_ - y0_) / step_));
  reach_ = out * step_;
  const int nx = int(std::lround((x1_ - x0_) / step_)) + 2 * out,
            ny = int(std::lround((y1_ - y0_) / step_)) + 2 * out;

  const Theme& colors = theme(dark_);
  const auto points = vtkSmartPointer<vtkPoints>::New();
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  const auto rgba = vtkSmartPointer<vtkUnsignedCharArray>::New();
  rgba->SetNumberOfComponents(4);
  points->SetDataTypeToFloat();
  const auto fade = [&](double x, double y) {
    const double dx = std::max({x0_ - x, x - x1_, 0.0}), dy = std::max({y0_ - y, y - y1_, 0.0});
    const double t = std::clamp(1 - std::hypot(dx, dy) / reach_, 0.0, 1.0);
    return 0.75 * t * t;
  };
  const auto add = [&](double x, double y, const Rgb& color) {
    rgba->InsertNextTuple4(float(std::lround(255 * color.r)), float(std::lround(255 * color.g)),
                           float(std::lround(255 * color.b)), float(std::lround(255 * fade(x, y))));
    return points->InsertNextPoint(x, y, z_);
  };
  const auto line = [&](bool alongX, int index) {
    const double fixed = (alongX ? y0_ : x0_) + (index - out) * step_;
    const bool axis = std::abs(fixed) < 1e-6 * step_;
    const Rgb& color = axis ? (alongX ? colors.axisX : colors.axisY) : colors.grid;
    const int count = alongX ? nx : ny;
    cells->InsertNextCell(count + 1);
    for (int k = 0; k <= count; ++k) {
      const double along = (alongX ? x0_ : y0_) + (k - out) * step_;
      cells->InsertCellPoint(alongX ? add(along, fixed, color) : add(fixed, along, color));
    }
  };
  for (int i = 0; i <= nx; ++i) line(false, i);
  for (int i = 0; i <= ny; ++i) line(true, i);
  lines_.data()->SetPoints(points);
  lines_.data()->SetLines(cells);
  lines_.data()->GetPointData()->SetScalars(rgba);
}

void GroundGrid::update(const Projection& view, int width, int height, const std::vector<PixelRect>& taken) {
  labels_.begin(width, height);
  if (visible_ && content_.valid()) {
    std::vector<PixelRect> occupied = taken;
    labelEdge(true, view, width, height, occupied);
    labelEdge(false, view, width, height, occupied);
  }
  labels_.end();
}

void GroundGrid::labelEdge(bool alongX, const Projection& view, int width, int height,
                           std::vector<PixelRect>& occupied) {
  const TextLook look{11 * pixelRatio_, false, theme(dark_).secondary, 1};
  // The edges on the camera's side; straight from above, the lower and the left one.
  const Eigen::Vector3d towards = -view.forward() - 0.02 * view.up() - 0.02 * view.right();
  const bool upper = alongX ? towards.y() > 0 : towards.x() > 0;
  const double fixed = alongX ? (upper ? y1_ : y0_) : (upper ? x1_ : x0_);
  const double low = alongX ? x0_ : y0_, high = alongX ? x1_ : y1_;
  const Eigen::Vector3d outward =
      (upper ? 1.0 : -1.0) * (alongX ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX());
  const auto at = [&](double along) {
    return alongX ? Eigen::Vector3d(along, fixed, z_) : Eigen::Vector3d(fixed, along, z_);
  };
  const Eigen::Vector3d a = view.toPixel(at(low)), b = view.toPixel(at(high));
  if (a.z() <= 0 || b.z() <= 0) return;

  // Every first, second, fifth or tenth line, so that the numbers do not crowd.
  const int count = int(std::lround((high - low) / step_));
  const double spacing = (b - a).head<2>().norm() / std::max(1, count);
  const double needed = (std::abs(b.x() - a.x()) > std::abs(b.y() - a.y()) ? 46 : 26) * pixelRatio_;
  constexpr std::array<int, 6> kEvery{1, 2, 5, 10, 20, 50};
  const auto every = std::find_if(kEvery.begin(), kEvery.end(), [&](int n) { return spacing * n >= needed; });
  if (every == kEvery.end()) return;

  // Where the two edges meet, their numbers would stand on each other.
  const bool otherUpper = alongX ? towards.x() > 0 : towards.y() > 0;
  const int corner = otherUpper ? count : 0;
  const long long first = std::llround(low / step_);
  // From the far end; its number names the unit, and nearer ones give way to it.
  bool unitSaid = false;
  for (int k = count; k >= 0; --k) {
    if ((first + k) % *every != 0 || k == corner) continue;
    const Eigen::Vector3d place = at(low + k * step_);
    const Eigen::Vector3d anchor = view.toPixel(place), beyond = view.toPixel(place + 0.2 * step_ * outward);
    if (anchor.z() <= 0 || beyond.z() <= 0) continue;
    const Eigen::Vector2d away = (beyond - anchor).head<2>();
    if (away.norm() < 1e-6) continue;
    const std::string text =
        tickText((double(first) + k) * step_, step_ < 1 ? 1 : 0, false) + (unitSaid ? "" : " mm");
    const double half = 0.5 * Canvas::textWidth(text, look) + 4, reach = 10 * pixelRatio_;
    const Eigen::Vector2d direction = away.normalized();
    const double x = anchor.x() + direction.x() * (14 * pixelRatio_ + 0.7 * half);
    const double y = anchor.y() + direction.y() * 14 * pixelRatio_;
    const PixelRect box{x - half, y - reach, 2 * half, 2 * reach};
    const bool outside = box.x < 0 || box.y < 0 || box.x + box.width > width || box.y + box.height > height;
    if (outside ||
        std::any_of(occupied.begin(), occupied.end(), [&](const PixelRect& o) { return box.overlaps(o); }))
      continue;
    occupied.push_back(box);
    unitSaid = true;
    labels_.text(text, x, y, Align::center, look);
  }
}

}  // namespace bw::scene
