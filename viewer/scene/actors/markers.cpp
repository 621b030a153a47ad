// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/markers.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "bw/core/base/units.h"
#include "scene/render/text_wrap.h"

namespace bw::scene {

namespace {

constexpr double kTubeWidth = 3;  ///< device-independent pixels
constexpr double kGlowWidth = 18;
constexpr double kGripWidth = 8;
constexpr double kGripLength = 22;
constexpr int kSides = 12;

/// A closed tube along a line; `radius` by point. Sections turn with the line as little as possible.
void buildTube(vtkPolyData* data, const std::vector<Polyline>& lines,
               const std::function<double(const Eigen::Vector3d&)>& radius) {
  const auto points = vtkSmartPointer<vtkPoints>::New();
  const auto normals = vtkSmartPointer<vtkFloatArray>::New();
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  normals->SetNumberOfComponents(3);
  const auto triangle = [&](vtkIdType a, vtkIdType b, vtkIdType c) {
    const vtkIdType corners[3] = {a, b, c};
    cells->InsertNextCell(3, corners);
  };
  for (const Polyline& line : lines) {
    if (line.size() < 2) continue;
    const auto tangentAt = [&](std::size_t i) -> Eigen::Vector3d {
      const Eigen::Vector3d d = line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0];
      const double length = d.norm();
      return length > 0 ? Eigen::Vector3d(d / length) : Eigen::Vector3d::UnitX();
    };
    Eigen::Vector3d side = tangentAt(0).unitOrthogonal();
    const vtkIdType first = points->GetNumberOfPoints();
    const auto ring = [&](const Eigen::Vector3d& center, const Eigen::Vector3d& tangent, double r,
                          const Eigen::Vector3d* capNormal) {
      const Eigen::Vector3d other = tangent.cross(side);
      for (int k = 0; k < kSides; ++k) {
        const double angle = 2 * kPi * k / kSides;
        const Eigen::Vector3d n = std::cos(angle) * side + std::sin(angle) * other;
        points->InsertNextPoint((center + r * n).eval().data());
        normals->InsertNextTuple(capNormal ? capNormal->data() : n.data());
      }
    };
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Eigen::Vector3d tangent = tangentAt(i);
      side = (side - side.dot(tangent) * tangent);
      side = side.norm() > 1e-9 ? side.normalized() : tangent.unitOrthogonal();
      ring(line[i], tangent, radius(line[i]), nullptr);
      if (i == 0) continue;
      const vtkIdType a = first + vtkIdType(i - 1) * kSides, b = a + kSides;
      for (int k = 0; k < kSides; ++k) {
        const int n = (k + 1) % kSides;
        triangle(a + k, a + n, b + n);
        triangle(a + k, b + n, b + k);
      }
    }
    for (const bool end : {false, true}) {
      const std::size_t i = end ? line.size() - 1 : 0;
      const Eigen::Vector3d tangent = tangentAt(i), outward = end ? tangent : Eigen::Vector3d(-tangent);
      side = (side - side.dot(tangent) * tangent).normalized();
      const vtkIdType start = points->GetNumberOfPoints();
      ring(line[i], tangent, radius(line[i]), &outward);
      for (int k = 1; k + 1 < kSides; ++k) triangle(start, start + k, start + k + 1);
    }
  }
  data->Initialize();
  if (points->GetNumberOfPoints() == 0) return;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetPointData()->SetNormals(normals);
}

/// A strip that faces the camera, opaque along its middle and clear at its borders.
void buildGlow(vtkPolyData* data, const Polyline& line, const Projection& view, double width,
               const Rgb& color, double strength) {
  const auto points = vtkSmartPointer<vtkPoints>::New();
  const auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  colors->SetNumberOfComponents(4);
  constexpr int kColumns = 9;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector3d pixel = view.toPixel(line[i]);
    const Eigen::Vector3d tangent = line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0];
    Eigen::Vector3d across = tangent.cross(view.ray(pixel.x(), pixel.y()).direction);
    across = across.norm() > 1e-9 ? across.normalized() : view.right();
    for (int k = 0; k < kColumns; ++k) {
      const double x = 2.0 * k / (kColumns - 1) - 1, fall = (1 - x * x) * (1 - x * x);
      points->InsertNextPoint((line[i] + 0.5 * x * width * view.pixelSize(pixel.z()) * across).eval().data());
      colors->InsertNextTuple4(float(255 * color.r), float(255 * color.g), float(255 * color.b),
                               float(255 * strength * fall));
    }
    if (i == 0) continue;
    for (int k = 0; k + 1 < kColumns; ++k) {
      const vtkIdType a = vtkIdType(i - 1) * kColumns + k, b = a + kColumns;
      const vtkIdType corners[4] = {a, a + 1, b + 1, b};
      cells->InsertNextCell(4, corners);
    }
  }
  data->Initialize();
  if (line.size() < 2) return;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetPointData()->SetScalars(colors);
}

// Device-independent pixels.
constexpr double kRing = 9, kHole = 6, kDot = 3, kPadding = 9, kLine = 17, kAway = 34, kMargin = 8;
constexpr std::size_t kColumns = 48, kLines = 4;

}  // namespace

MovingBlade::MovingBlade(Layers& layers) {
  tube_.setMatte(0.55, 0.5, 0.25);
  grips_.setMatte(0.4, 0.6, 0.2);
  glow_.setFlat();
  glow_.mapper()->ScalarVisibilityOn();
  glow_.mapper()->SetColorModeToDirectScalars();
  glow_.actor()->ForceTranslucentOn();
  for (Part* part : {&tube_, &grips_}) layers.add(Layer::blade, *part);
  layers.add(Layer::glow, glow_);
}

void MovingBlade::setLine(Polyline line) {
  line_ = std::move(line);
  for (Part* part : {&tube_, &grips_, &glow_}) part->setVisible(line_.size() >= 2);
}

void MovingBlade::setStyle(const Style& style, const Rgb& background) {
  const Theme& colors = theme(style.dark);
  pixelRatio_ = style.pixelRatio;
  tube_.setColor(colors.accent);
  grips_.setColor(colors.grip);
  const double keep = keptColor(style.stale);
  for (Part* part : {&tube_, &grips_}) part->setFade(keep, background);
  glow_.setOpacity(keep);
  glow_.setColor(colors.accent);
}

void MovingBlade::update(const Projection& view, double depthShift) {
  if (line_.size() < 2) return;
  const auto pixels = [&](double count, const Eigen::Vector3d& p) {
    return count * pixelRatio_ * view.pixelSize(std::max(1e-6, view.toPixel(p).z()));
  };
  buildTube(tube_.data(), {line_}, [&](const Eigen::Vector3d& p) { return 0.5 * pixels(kTubeWidth, p); });
  const auto grip = [&](const Eigen::Vector3d& end, const Eigen::Vector3d& inner) {
    const Eigen::Vector3d outward = (end - inner).normalized();
    const double length = pixels(kGripLength, end);
    return Polyline{end - 0.35 * length * outward, end + 0.65 * length * outward};
  };
  buildTube(grips_.data(), {grip(line_.front(), line_[1]), grip(line_.back(), line_[line_.size() - 2])},
            [&](const Eigen::Vector3d& p) { return 0.5 * pixels(kGripWidth, p); });
  double c[3];
  tube_.property()->GetColor(c);
  buildGlow(glow_.data(), line_, view, kGlowWidth * pixelRatio_, {c[0], c[1], c[2]}, 0.38);
  for (Part* part : {&tube_, &grips_, &glow_}) part->setDepthShift(depthShift);
}

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
  for (const std::string& line : lines) textWidth = std::max(textWidth, canvas_.textWidth(line, look));
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
    canvas_.line({x, y}, tip, 1.5 * px, color);
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
