// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "carriers.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <Geom_ElementarySurface.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "occt.h"
#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr double kOneSurface = 1e-4;  // mm between two surfaces that are one
constexpr int kLooks = 4;             // of them along each parameter, and one more at the end

using Rectangle = Eigen::AlignedBox2d;

/// By face: the number of the part of the target that hangs together over shared edges.
std::vector<int> connectedParts(const Target::Impl& target) {
  std::vector<int> part(target.faces.size(), -1);
  int parts = 0;
  for (std::size_t first = 0; first < part.size(); ++first) {
    if (part[first] >= 0) continue;
    std::vector<std::size_t> next = {first};
    part[first] = parts;
    while (!next.empty()) {
      const std::size_t face = next.back();
      next.pop_back();
      for (const Neighbour& beside : target.neighbours[face])
        if (std::exchange(part[std::size_t(beside.face)], parts) < 0)
          next.push_back(std::size_t(beside.face));
    }
    ++parts;
  }
  return part;
}

/// What tells at a glance that most faces lie on different surfaces.
struct Look {
  Eigen::Vector3d corner;                            ///< a point of the surface
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of a plane
  bool spline;                                       ///< the corner is that of all of it

  explicit Look(const FaceGeometry& face) : spline(face.patch().isSpline()) {
    const SurfacePatch& patch = face.patch();
    corner = spline ? patch.value(patch.breaksU().front(), patch.breaksV().front())
                    : patch.value(face.u0(), face.v0());
    if (patch.type() == "plane") normal = face.normal(face.u0(), face.v0());
  }
  bool differs(const Look& other) const {
    const Eigen::Vector3d apart = other.corner - corner;
    return spline != other.spline || std::abs(apart.dot(normal)) > kOneSurface ||
           (spline && apart.norm() > kOneSurface);
  }
};

/// Faces on one surface: that of the first of them.
struct Group {
  const FaceGeometry* face;
  Look look;
  Handle(ShapeAnalysis_Surface) formula;  // null where the surface has none
  int part;
  Rectangle range;
  std::vector<int> faces;

  /// The parameters of a point of `other` at `uv` on this surface; empty if it does not lie on it.
  std::optional<Eigen::Vector2d> placeOf(const FaceGeometry& other, const Eigen::Vector2d& uv) const {
    const SurfacePatch& patch = face->patch();
    const Eigen::Vector3d p = other.patch().value(uv.x(), uv.y());
    if (!formula.IsNull()) {
      const gp_Pnt2d at = formula->ValueOfUV(toPoint(p), Precision::Confusion());
      if ((patch.value(at.X(), at.Y()) - p).norm() > kOneSurface) return {};
      return Eigen::Vector2d(at.X(), at.Y());
    }
    if (patch.isSpline() && (uv.x() < patch.breaksU().front() || uv.x() > patch.breaksU().back() ||
                             uv.y() < patch.breaksV().front() || uv.y() > patch.breaksV().back()))
      return {};
    if ((patch.value(uv.x(), uv.y()) - p).norm() > kOneSurface) return {};
    return uv;
  }

  /// The rectangle of `other` in the parameters of this surface; empty if it lies on another one.
  std::optional<Rectangle> rangeOf(const FaceGeometry& other) const {
    const Eigen::Vector2d low(other.u0(), other.v0()), size(other.u1() - other.u0(), other.v1() - other.v0());
    const double periods[2] = {face->patch().periodU(), face->patch().periodV()};
    Rectangle around;
    std::vector<Eigen::Vector2d> row, before;
    for (int i = 0; i <= kLooks; ++i) {
      for (int j = 0; j <= kLooks; ++j) {
        std::optional<Eigen::Vector2d> at =
            placeOf(other, low + Eigen::Vector2d(double(i) / kLooks, double(j) / kLooks).cwiseProduct(size));
        if (!at) return {};
        // Over a seam the parameters go on from those beside.
        const Eigen::Vector2d beside = j > 0 ? row.back() : i > 0 ? before.front() : range.center();
        for (const int axis : {0, 1})
          if (const double period = periods[axis]; period > 0)
            (*at)[axis] += period * std::round((beside[axis] - (*at)[axis]) / period);
        row.push_back(*at);
        around.extend(*at);
      }
      before = std::exchange(row, {});
    }
    return around;
  }
};

/// Whether there is a rectangle of parameters to be continued in: none goes all the way round.
bool bounded(const Group& group) {
  const Eigen::Vector2d size = group.range.sizes();
  const double periods[2] = {group.face->patch().periodU(), group.face->patch().periodV()};
  return !((periods[0] > 0 && size.x() > (1 - kSameSize) * periods[0]) ||
           (periods[1] > 0 && size.y() > (1 - kSameSize) * periods[1]));
}

}  // namespace

std::vector<Carrier> carriersOf(const Target::Impl& target) {
  std::vector<Carrier> carriers;
  if (target.faces.size() < 2 || std::ranges::find(target.edgeUses, 1) == target.edgeUses.end())
    return carriers;
  const std::vector<int> parts = connectedParts(target);
  std::vector<Group> groups;
  for (std::size_t k = 0; k < target.faces.size(); ++k) {
    const FaceGeometry& face = *target.faces[k];
    const Look look(face);
    bool known = false;
    for (Group& group : groups) {
      if (group.part != parts[k] || group.look.differs(look) ||
          group.face->patch().type() != face.patch().type())
        continue;
      const std::optional<Rectangle> range = group.rangeOf(face);
      if (!range) continue;
      group.range.extend(*range);
      group.faces.push_back(int(k));
      known = true;
      break;
    }
    if (known) continue;
    Group& group = groups.emplace_back(
        Group{&face,
              look,
              {},
              parts[k],
              Rectangle(Eigen::Vector2d(face.u0(), face.v0()), Eigen::Vector2d(face.u1(), face.v1())),
              {int(k)}});
    if (face.patch().surface()->IsKind(STANDARD_TYPE(Geom_ElementarySurface)))
      group.formula = new ShapeAnalysis_Surface(face.patch().surface());
  }
  for (Group& group : groups) {
    if (group.faces.size() < 2 || !bounded(group)) continue;
    BRepBuilderAPI_MakeFace made(group.face->patch().surface(), group.range.min().x(), group.range.max().x(),
                                 group.range.min().y(), group.range.max().y(), Precision::Confusion());
    if (!made.IsDone()) continue;
    TopoDS_Face around = made.Face();
    if (group.face->reversed()) around.Reverse();
    Carrier carrier{
        FaceGeometry::make(around, -1, [](const TopoDS_Edge&) { return -1; }), std::move(group.faces), {}};
    const FaceGeometry& surface = *carrier.surface;
    for (int i = 0; i < int(surface.gridU().size()); ++i)
      for (int j = 0; j < int(surface.gridV().size()); ++j) carrier.bounds.add(surface.gridPoint(i, j));
    carriers.push_back(std::move(carrier));
  }
  return carriers;
}

}  // namespace bw::geometry
