// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/shape/designed_surface.h"

#include <algorithm>

#include "bw/core/base/frame.h"
#include "bw/core/text/number_text.h"
#include "shape/shapes.h"

namespace bw {

namespace {

constexpr int kMostDegree = 3;

/// Clamped uniform knots over [0, 1].
std::vector<double> uniformKnots(int poles, int degree) {
  std::vector<double> knots(std::size_t(degree + 1), 0.0);
  const int spans = poles - degree;
  for (int i = 1; i < spans; ++i) knots.push_back(double(i) / spans);
  knots.insert(knots.end(), std::size_t(degree + 1), 1.0);
  return knots;
}

Result<void> checkCount(const char* along, int poles, int degree) {
  if (degree < 1 || degree > kMostDegree)
    return fail(
        ErrorCode::badInput,
        std::string("the degree along ") + along + " is " + std::to_string(degree) + " but must be 1, 2 or 3",
        "degree", double(degree), double(kMostDegree));
  if (poles <= degree || poles > PolesSurface::kMost)
    return fail(ErrorCode::badInput,
                "there are " + std::to_string(poles) + " poles along " + along + "; a surface of degree " +
                    std::to_string(degree) + " has " + std::to_string(degree + 1) + " to " +
                    std::to_string(PolesSurface::kMost),
                "poles", double(poles), double(poles <= degree ? degree + 1 : PolesSurface::kMost));
  return {};
}

}  // namespace

Eigen::Vector2d PolesSurface::place(int row, int column) const {
  const Eigen::Vector2d share(double(column) / std::max(1, columns - 1), double(row) / std::max(1, rows - 1));
  return over.min + share.cwiseProduct(over.max - over.min);
}

std::string shapeText(const DesignedSurface& surface) {
  if (const auto* poles = std::get_if<PolesSurface>(&surface.shape))
    return "poles " + std::to_string(poles->columns) + " × " + std::to_string(poles->rows);
  if (const auto* graph = std::get_if<FormulaSurface>(&surface.shape)) return "formula z = " + graph->formula;
  if (const auto* loft = std::get_if<SectionsSurface>(&surface.shape)) {
    constexpr const char* kSpaced[] = {"by chord", "by its root", "evenly"};
    return "loft of " + std::to_string(loft->sections.size()) + " sections, " +
           kSpaced[std::size_t(loft->loft)];
  }
  return std::to_string(std::get<BladesSurface>(surface.shape).blades.size()) + " key blades";
}

Result<SplineSurface> splineOf(const DesignedSurface& surface) {
  if (!surface.origin.allFinite() || !surface.rotation.allFinite())
    return fail(ErrorCode::badInput, "the frame of the surface is not given by finite numbers", "frame");
  Result<SplineSurface> spline =
      std::visit([](const auto& shape) { return shape::splineOf(shape); }, surface.shape);
  if (!spline || (surface.origin.isZero(0) && surface.rotation.isZero(0))) return spline;
  const Eigen::Matrix3d rotation = rotationFromAngles(surface.rotation);
  for (Eigen::Vector3d& pole : spline->poles) pole = surface.origin + rotation * pole;
  return spline;
}

namespace shape {

std::string placeText(const Eigen::Vector2d& place) {
  return "x = " + shortText(place.x(), 6) + ", y = " + shortText(place.y(), 6);
}

Result<void> checkRectangle(const Rectangle& rectangle) {
  if (rectangle.min.allFinite() && rectangle.max.allFinite() &&
      (rectangle.max.array() > rectangle.min.array()).all())
    return {};
  return fail(ErrorCode::badInput,
              "the surface lies over x from " + shortText(rectangle.min.x(), 6) + " to " +
                  shortText(rectangle.max.x(), 6) + " and y from " + shortText(rectangle.min.y(), 6) +
                  " to " + shortText(rectangle.max.y(), 6) + " mm; both must ascend",
              "rectangle");
}

Result<SplineSurface> splineOf(const PolesSurface& surface) {
  if (Result<void> ok = checkRectangle(surface.over); !ok) return tl::unexpected<Error>(ok.error());
  if (Result<void> ok = checkCount("x", surface.columns, surface.degreeX); !ok)
    return tl::unexpected<Error>(ok.error());
  if (Result<void> ok = checkCount("y", surface.rows, surface.degreeY); !ok)
    return tl::unexpected<Error>(ok.error());
  if (surface.poles.size() != std::size_t(surface.rows) * surface.columns)
    return fail(ErrorCode::badInput,
                "the surface has " + std::to_string(surface.poles.size()) + " poles in place of " +
                    std::to_string(surface.rows) + " × " + std::to_string(surface.columns),
                "poles");
  SplineSurface spline{surface.degreeX,
                       surface.degreeY,
                       uniformKnots(surface.columns, surface.degreeX),
                       uniformKnots(surface.rows, surface.degreeY),
                       surface.columns,
                       surface.rows,
                       {}};
  spline.poles.reserve(surface.poles.size());
  for (int row = 0; row < surface.rows; ++row)
    for (int column = 0; column < surface.columns; ++column) {
      const SurfacePole& pole = surface.at(row, column);
      const Eigen::Vector2d at = surface.place(row, column) + pole.moved;
      spline.poles.emplace_back(at.x(), at.y(), pole.height);
      if (!spline.poles.back().allFinite())
        return fail(ErrorCode::badInput,
                    "pole " + std::to_string(column + 1) + " of row " + std::to_string(row + 1) +
                        " has no finite place",
                    "poles");
    }
  return spline;
}

}  // namespace shape

}  // namespace bw
