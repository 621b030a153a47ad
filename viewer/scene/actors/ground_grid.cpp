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

#include "scene/legend/legend_range.h"

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
  lines_.setLine({}, pixelRatio_);  // coloured point by point
  lines_.setVisible(visible_ && content_.valid());
  if (changed) rebuild();
}

Bounds GroundGrid::bounds() const {
  Bounds result;
  if (!visible_ || !content_.valid()) return result;
  result.add({low_.x() - reach_, low_.y() - reach_, z_});
  result.add({high_.x() + reach_, high_.y() + reach_, z_});
  return result;
}

void GroundGrid::rebuild() {
  lines_.clear();
  lines_.setVisible(visible_ && content_.valid());
  if (!content_.valid()) return;
  const Eigen::Vector3d size = content_.size();
  step_ = roundStep(std::max({size.x(), size.y(), 0.2 * size.z(), 1.0}), 8);
  // Half a step of air around the content.
  low_ = ((content_.min.head<2>().array() - 0.4 * step_) / step_).floor() * step_;
  high_ = ((content_.max.head<2>().array() + 0.4 * step_) / step_).ceil() * step_;
  z_ = content_.min.z();
  const int out = int(std::ceil(0.6 * (high_ - low_).maxCoeff() / step_));
  reach_ = out * step_;

  const Theme& colors = theme(dark_);
  const auto points = vtkSmartPointer<vtkPoints>::New();
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  const auto rgba = vtkSmartPointer<vtkUnsignedCharArray>::New();
  rgba->SetNumberOfComponents(4);
  const auto add = [&](const Eigen::Array2d& p, const Rgb& color) {
    const Eigen::Array2d beside = (low_ - p).max(p - high_).max(0.0);
    const double t = std::clamp(1 - std::hypot(beside.x(), beside.y()) / reach_, 0.0, 1.0);
    rgba->InsertNextTuple4(float(std::lround(255 * color.r)), float(std::lround(255 * color.g)),
                           float(std::lround(255 * color.b)), float(std::lround(255 * (0.75 * t * t))));
    return points->InsertNextPoint(p.x(), p.y(), z_);
  };
  const auto lineCount = [&](int axis) {
    return int(std::lround((high_[axis] - low_[axis]) / step_)) + 2 * out;
  };
  for (const int axis : {1, 0}) {  // along which a line runs
    const int count = lineCount(axis), other = 1 - axis;
    for (int i = 0; i <= lineCount(other); ++i) {
      Eigen::Array2d p;
      p[other] = low_[other] + (i - out) * step_;
      const bool origin = std::abs(p[other]) < 1e-6 * step_;
      const Rgb& color = !origin ? colors.grid : axis == 0 ? colors.axisX : colors.axisY;
      cells->InsertNextCell(count + 1);
      for (int k = 0; k <= count; ++k) {
        p[axis] = low_[axis] + (k - out) * step_;
        cells->InsertCellPoint(add(p, color));
      }
    }
  }
  lines_.data()->SetPoints(points);
  lines_.data()->SetLines(cells);
  lines_.data()->GetPointData()->SetScalars(rgba);
}

void GroundGrid::update(const Projection& view, int width, int height, const std::vector<PixelRect>& taken) {
  labels_.begin(height);
  if (visible_ && content_.valid()) {
    std::vector<PixelRect> occupied = taken;
    for (const int axis : {0, 1}) labelEdge(axis, view, width, height, occupied);
  }
  labels_.end();
}

void GroundGrid::labelEdge(int axis, const Projection& view, int width, int height,
                           std::vector<PixelRect>& occupied) {
  const TextLook look{11 * pixelRatio_, false, theme(dark_).secondary};
  // The edges on the camera's side; straight from above, the lower and the left one.
  const Eigen::Vector3d towards = -view.forward() - 0.02 * view.up() - 0.02 * view.right();
  const int other = 1 - axis;
  const bool upper = towards[other] > 0;
  const double low = low_[axis], high = high_[axis];
  const Eigen::Vector3d outward = (upper ? 1.0 : -1.0) * Eigen::Vector3d::Unit(other);
  const auto at = [&](double along) {
    Eigen::Vector3d p = Eigen::Vector3d::Constant(z_);
    p[axis] = along;
    p[other] = upper ? high_[other] : low_[other];
    return p;
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
  const int corner = towards[axis] > 0 ? count : 0;
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
    const double half = 0.5 * labels_.textWidth(text, look) + 4, reach = 10 * pixelRatio_;
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
