// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <string>
#include <variant>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/shape/key_blades.h"
#include "bw/core/surface/spline_surface.h"
#include "bw/core/text/expression.h"

namespace bw {

// Surfaces that are shaped rather than read from a file: plain values, cheap to copy and to compare. Each is
// told in a frame of its own, mm, with z up; u of its spline runs along x, v along y.

/// A rectangle of the plane z = 0.
struct Rectangle {
  Eigen::Vector2d min = {0, 0}, max = {600, 800};  ///< mm, max above min
  bool operator==(const Rectangle&) const = default;
};

/// A pole of a surface: over its place in the grid, or beside it.
struct SurfacePole {
  double height = 0;                                ///< mm
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();  ///< mm from its place in the grid
  bool operator==(const SurfacePole&) const = default;
};

/// A tensor-product B-spline with clamped uniform knots, whose poles lie on a regular grid over a rectangle.
struct PolesSurface {
  static constexpr int kMost = 100;  ///< poles each way

  Rectangle over = {};
  int columns = 4, rows = 6;     ///< poles along x and along y, more than the degree
  int degreeX = 3, degreeY = 3;  ///< 1 to 3
  std::vector<SurfacePole> poles = std::vector<SurfacePole>(24);  ///< rows × columns, row by row

  SurfacePole& at(int row, int column) { return poles[std::size_t(row) * columns + column]; }
  const SurfacePole& at(int row, int column) const { return poles[std::size_t(row) * columns + column]; }
  /// The place of a pole in the grid.
  Eigen::Vector2d place(int row, int column) const;
  bool operator==(const PolesSurface&) const = default;
};

/// The graph z = f(x, y) over a rectangle.
struct FormulaSurface {
  static constexpr double kTolerance = 0.01;  ///< mm between graph and spline
  static constexpr int kMost = 257;           ///< poles each way

  Rectangle over = {};
  std::string formula = "0";              ///< of x and y, mm, and of `numbers` (bw/core/text/expression.h)
  std::vector<NamedNumber> numbers = {};  ///< the variables that it uses, by what they are now
  bool operator==(const FormulaSurface&) const = default;
};

/// A curve in the plane across the travel at y.
struct SectionCurve {
  static constexpr int kMost = 200;  ///< points

  enum class Kind {
    bezier,  ///< the points are the poles of cubics, each from where the one before it ends, or two or three
    spline,  ///< the cubic spline through the points, without curvature at its ends
    ducks    ///< the elastic spline that slides through the points, its ends free to turn
  };
  static constexpr int kMostDucks = 50;
  static constexpr double kLine = 1e-4;  ///< rad by which the legs at a joint of cubics may not be in line
  double y = 0;
  Kind kind = Kind::bezier;
  std::vector<Eigen::Vector2d> points = {};  ///< (x, z)
  bool operator==(const SectionCurve&) const = default;
};

/// The words of the kinds in files, by value: the keys of their points.
inline constexpr const char* kSectionKinds[] = {"bezier", "spline", "ducks"};

/// True for the numbers of poles that a Bézier curve or a chain of cubics has: 2, 3, 4, 7, 10, …
constexpr bool isBezierCount(std::size_t points) {
  return points == 2 || points == 3 ||
         (points >= 4 && points % 3 == 1 && points <= std::size_t(SectionCurve::kMost));
}

/// Moves a pole of a Bézier curve or chain so that cubics still meet with one tangent: a joint takes the legs
/// on both sides with it, and where the end of a leg is moved, the leg beyond the joint turns with it and
/// keeps its length.
void moveBezierPole(std::vector<Eigen::Vector2d>& poles, std::size_t pole, const Eigen::Vector2d& to);

/// How far apart the parameters of neighbouring sections of a loft lie.
enum class LoftSpacing {
  chord,   ///< as the mean of the distances of their poles
  root,    ///< as its square root: tight
  uniform  ///< evenly
};
inline constexpr const char* kLoftSpacings[] = {"chord", "root", "uniform"};

/// A loft through section curves: it holds each of them, and its cut at any y is a curve of its spline.
struct SectionsSurface {
  static constexpr int kMost = 200;  ///< sections

  std::vector<SectionCurve> sections = {};  ///< two or more, y ascending
  LoftSpacing loft = LoftSpacing::chord;
  bool operator==(const SectionsSurface&) const = default;
};

using SurfaceShape = std::variant<PolesSurface, FormulaSurface, SectionsSurface, BladesSurface>;
/// The words of the kinds in files, in their order in `SurfaceShape`.
inline constexpr const char* kShapeKinds[] = {"poles", "formula", "sections", "blades"};

/// A surface that is designed, and where its frame lies in that of the design.
struct DesignedSurface {
  SurfaceShape shape = {};
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of its frame, mm
  Eigen::Vector3d rotation =
      Eigen::Vector3d::Zero();  ///< of its frame, rad, as `rotationFromAngles` takes it
  bool operator==(const DesignedSurface&) const = default;
};

/// What it is in a few words: "poles 4 × 6", "formula z = x*y/4000", "loft of 3 sections, by chord",
/// "4 key blades".
std::string shapeText(const DesignedSurface& surface);

/// The surface as a spline in the design's frame: exact for poles and sections, but for sections by ducks,
/// which are held within 0.001 mm; within `kTolerance` for a formula and for blades, held at twelve places
/// and more of each of its spans (docs/mathematics.md, Designed surfaces). Errors, `badInput` with what to
/// do: numbers that are not finite or make no surface; sections whose loft runs backwards, or whose cubics
/// meet in a kink; a formula that has no finite value somewhere (`noSolution`, with the place); a formula or
/// blades that no spline comes near to, with the place and the distance; ducks that no elastic spline slides
/// through (`noSolution`). Takes some µs for poles and sections.
Result<SplineSurface> splineOf(const DesignedSurface& surface);

}  // namespace bw
