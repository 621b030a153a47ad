// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "ground_grid.h"

#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

#include "bw/core/number_text.h"
#include "ticks.h"

namespace bw::scene {

GroundGrid::GroundGrid() {
  lines_.setFlat();
  lines_.mapper()->ScalarVisibilityOn();
  lines_.mapper()->SetColorModeToDirectScalars();
  // Tells VTK to draw after all that is solid: the fading is in the colours.
  lines_.actor()->ForceTranslucentOn();
}

void GroundGrid::addTo(vtkRenderer* renderer) {
  renderer->AddActor(lines_.actor());
  labels_.addTo(renderer);
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
  const int nx = int(std::lround((x1_ - x0_) / step_)) + 2 * out, ny = int(std::lround((y1_ - y0_) / step_)) + 2 * out;

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
    rgba->InsertNextTuple4(float(std::lround(255 * color.r)), float(std::lround(255 * color.g)), float(std::lround(255 * color.b)),
                           float(std::lround(255 * fade(x, y))));
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

void GroundGrid::update(const Projection& view, int width, int height) {
  labels_.begin(width, height);
  if (visible_ && content_.valid()) {
    const TextLook look{11 * pixelRatio_, false, theme(dark_).secondary, 1};
    // The edges on the camera's side; straight from above, the lower and the left one.
    const Eigen::Vector3d towards = -view.forward() - 0.02 * view.up() - 0.02 * view.right();
    const double yEdge = towards.y() <= 0 ? y0_ : y1_, xEdge = towards.x() < 0 ? x0_ : x1_;
    const auto edge = [&](bool alongX) {
      const double low = alongX ? x0_ : y0_, high = alongX ? x1_ : y1_;
      const Eigen::Vector3d outward = alongX ? Eigen::Vector3d(0, yEdge == y0_ ? -1 : 1, 0) : Eigen::Vector3d(xEdge == x0_ ? -1 : 1, 0, 0);
      const auto at = [&](double along) { return alongX ? Eigen::Vector3d(along, yEdge, z_) : Eigen::Vector3d(xEdge, along, z_); };
      const Eigen::Vector3d a = view.toPixel(at(low)), b = view.toPixel(at(high));
      if (a.z() <= 0 || b.z() <= 0) return;
      // Every first, second, fifth or tenth line, so that the numbers do not crowd.
      const int count = int(std::lround((high - low) / step_));
      const double spacing = (b - a).head<2>().norm() / std::max(1, count);
      const double needed = (std::abs(b.x() - a.x()) > std::abs(b.y() - a.y()) ? 46 : 26) * pixelRatio_;
      int every = 1;
      for (const int candidate : {1, 2, 5, 10, 20, 50}) {
        every = candidate;
        if (spacing * candidate >= needed) break;
      }
      if (spacing * every < needed) return;
      const long long first = std::llround(low / step_);
      for (int k = 0; k <= count; ++k) {
        if ((first + k) % every != 0) continue;
        const double along = low + k * step_;
        const Eigen::Vector3d anchor = view.toPixel(at(along)), beyond = view.toPixel(at(along) + 0.2 * step_ * outward);
        if (anchor.z() <= 0 || beyond.z() <= 0) continue;
        Eigen::Vector2d direction = (beyond - anchor).head<2>();
        if (direction.norm() < 1e-6) continue;
        direction.normalize();
        const Eigen::Vector2d place = anchor.head<2>() + 14 * pixelRatio_ * direction;
        const std::string text = tickText((double(first) + k) * step_, step_ < 1 ? 1 : 0, false);
        const double half = 0.5 * Canvas::textWidth(text, look) + 4;
        if (place.x() < half || place.x() > width - half || place.y() < 10 * pixelRatio_ || place.y() > height - 10 * pixelRatio_) continue;
        labels_.text(text, place.x() + 0.7 * direction.x() * half, place.y(), Align::center, look);
      }
      // The unit, once an edge, beyond its last number.
      const Eigen::Vector3d end = view.toPixel(at(high + 0.5 * step_) + 0.2 * step_ * outward);
      (void)end;
    };
    edge(true);
    edge(false);
  }
  labels_.end();
}

std::vector<Overlay::Text> GroundGrid::texts() const { return labels_.texts(); }

}  // namespace bw::scene
