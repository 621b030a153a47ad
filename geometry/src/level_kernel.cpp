// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// The second way to the curves of a plane over one face: OpenCASCADE's intersection of two surfaces.

#include <Geom2d_BSplineCurve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <GeomInt_IntSS.hxx>
#include <Geom_Plane.hxx>
#include <Precision.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <cmath>

#include "level_curves.h"
#include "occt.h"

namespace bw::geometry {

namespace {

constexpr int kConicIntervals = 48;     // of a curve that OpenCASCADE tells by a formula
constexpr int kSlideSteps = 8;          // of Newton's method along one parameter
constexpr double kPlaneMargin = 2;      // times the face's size: so far the plane reaches about it
constexpr double kBetweenNodes = 0.25;  // of a face's range of heights: so far it may leave its grid's
constexpr double kWalkError = 1e-3;     // mm that a place of the kernel may be off

/// Where a curve lies on the face, from its start to its end: the places that the kernel walked over, or even
/// ones on a conic.
std::vector<Eigen::Vector2d> placesOf(const GeomInt_IntSS& kernel, int line) {
  std::vector<Eigen::Vector2d> places;
  if (!kernel.HasLineOnS1(line) || kernel.LineOnS1(line).IsNull()) return places;
  const Handle(Geom2d_Curve)& curve = kernel.LineOnS1(line);
  const auto add = [&](const gp_Pnt2d& p) { places.emplace_back(p.X(), p.Y()); };
  const auto walked = Handle(Geom2d_BSplineCurve)::DownCast(curve);
  if (!walked.IsNull() && walked->Degree() == 1) {
    for (int k = 1; k <= walked->NbPoles(); ++k) add(walked->Pole(k));
    return places;
  }
  // Only the curve in space is bounded.
  const double first = kernel.Line(line)->FirstParameter(), last = kernel.Line(line)->LastParameter();
  if (Precision::IsInfinite(first) || Precision::IsInfinite(last)) return places;
  for (int k = 0; k <= kConicIntervals; ++k) add(curve->Value(first + (last - first) * k / kConicIntervals));
  return places;
}

}  // namespace

void PlaneCutter::slide(int face, double level, int along, LevelNode& node) const {
  const SurfacePatch& patch = target_.faces[face]->patch();
  Jet jet;
  for (int k = 0; k < kSlideSteps; ++k) {
    patch.first(node.uv.x(), node.uv.y(), jet);
    const double f = normal_.dot(jet.p) - level, slope = normal_.dot(along == 0 ? jet.du : jet.dv);
    if (std::abs(f) < kConverged || slope == 0) break;
    node.uv[along] -= f / slope;
  }
  node.p = patch.value(node.uv.x(), node.uv.y());
}

void PlaneCutter::intersect(int face, double level, std::vector<LevelPiece>& chains) const {
  const FaceGeometry& geometry = *target_.faces[face];
  const FaceLevels& levels = faces_[face];
  const double slack = kBetweenNodes * (levels.high - levels.low) + kOnPlane;
  if (level < levels.low - slack || level > levels.high + slack) return;
  const Eigen::Vector3d origin = geometry.gridPoint(0, 0) + (level - levels.g.front()) * normal_;
  double size = 0;
  for (int i = 0; i < int(geometry.gridU().size()); ++i)
    for (int j = 0; j < int(geometry.gridV().size()); ++j)
      size = std::max(size, (geometry.gridPoint(i, j) - origin).norm());
  const double reach = kPlaneMargin * size;
  const Handle(Geom_Plane) plane =
      new Geom_Plane(gp_Pln(toPoint(origin), gp_Dir(normal_.x(), normal_.y(), normal_.z())));
  GeomInt_IntSS kernel;
  kernel.Perform(new GeomAdaptor_Surface(geometry.patch().surface(), geometry.u0(), geometry.u1(),
                                         geometry.v0(), geometry.v1()),
                 new GeomAdaptor_Surface(plane, -reach, reach, -reach, reach), Precision::Confusion(),
                 Standard_False, Standard_True, Standard_False);
  if (!kernel.IsDone()) throw Standard_Failure("a face and a plane are not intersected");
  for (int line = 1; line <= kernel.NbLines(); ++line)
    if (auto places = placesOf(kernel, line); places.size() > 1)
      follow(face, level, std::move(places), chains);
}

void PlaneCutter::follow(int face, double level, std::vector<Eigen::Vector2d> places,
                         std::vector<LevelPiece>& chains) const {
  const FaceGeometry& geometry = *target_.faces[face];
  const SurfacePatch& patch = geometry.patch();
  const Eigen::Vector2d low(geometry.u0(), geometry.v0()), high(geometry.u1(), geometry.v1());
  const bool wraps[2] = {geometry.wrapsU(), geometry.wrapsV()};
  const double periods[2] = {wraps[0] ? high.x() - low.x() : patch.periodU(),
                             wraps[1] ? high.y() - low.y() : patch.periodV()};
  const std::vector<double>* const creases[2] = {&patch.creasesU(), &patch.creasesV()};

  // One continuous way through the parameters, which may lead over seams.
  places.front() = geometry.wrapped(places.front());
  for (std::size_t k = 1; k < places.size(); ++k)
    for (const int axis : {0, 1})
      if (const double period = periods[axis]; period > 0)
        places[k][axis] += period * std::round((places[k - 1][axis] - places[k][axis]) / period);
  const auto turns = [&](double t, int axis) {
    return wraps[axis] ? std::floor((t - low[axis]) / periods[axis]) : 0.0;
  };
  const auto inRange = [&](Eigen::Vector2d uv) {
    for (const int axis : {0, 1}) uv[axis] -= turns(uv[axis], axis) * periods[axis];
    return uv;
  };

  LevelPiece piece{face, {}, false};
  const auto add = [&](const LevelNode& node) {
    if (!piece.nodes.empty() && (node.p - piece.nodes.back().p).norm() <= kSameNode)
      piece.nodes.back().crease = piece.nodes.back().crease || node.crease;
    else
      piece.nodes.push_back(node);
  };
  const auto finish = [&]() {
    if (piece.nodes.size() >= 2) chains.push_back(std::move(piece));
    piece = {face, {}, false};
  };
  const auto addPlace = [&](const Eigen::Vector2d& uv) {
    LevelNode node;
    node.uv = inRange(uv);
    const LevelNode walked{node.uv, patch.value(node.uv.x(), node.uv.y())};
    // Where the plane touches the face, Newton's method may lead away: the kernel's own place is as good.
    add(project(face, level, node) && (node.p - walked.p).norm() < kWalkError ? node : walked);
  };
  struct Line {
    double at;  // 0…1 between two places
    int axis;
    double value;  // of that parameter
    bool seam;
  };
  addPlace(places.front());
  for (std::size_t k = 1; k < places.size(); ++k) {
    const Eigen::Vector2d &a = places[k - 1], &b = places[k];
    std::vector<Line> lines;
    for (const int axis : {0, 1}) {
      const auto cross = [&](double value, bool seam) {
        lines.push_back({(value - a[axis]) / (b[axis] - a[axis]), axis, value, seam});
      };
      for (const double crease : *creases[axis])
        if ((a[axis] < crease) != (b[axis] < crease)) cross(crease, false);
      const double before = turns(a[axis], axis), after = turns(b[axis], axis);
      if (before != after) cross(low[axis] + std::max(before, after) * periods[axis], true);
    }
    std::ranges::sort(lines, {}, &Line::at);
    for (const Line& line : lines) {
      LevelNode node;
      node.uv = inRange(a + line.at * (b - a));
      const bool up = b[line.axis] > a[line.axis];
      node.uv[line.axis] = !line.seam ? line.value : up ? high[line.axis] : low[line.axis];
      slide(face, level, 1 - line.axis, node);
      node.crease = !line.seam;
      add(node);
      if (!line.seam) continue;
      finish();
      node.uv[line.axis] = up ? low[line.axis] : high[line.axis];
      piece.nodes.push_back(node);
    }
    addPlace(b);
  }
  auto& nodes = piece.nodes;
  piece.closed = nodes.size() > 3 && (nodes.front().p - nodes.back().p).norm() <= kSameNode &&
                 ((nodes.front().uv - nodes.back().uv).array().abs() < 0.5 * (high - low).array()).all();
  if (piece.closed) nodes.pop_back();
  finish();
}

}  // namespace bw::geometry
