// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "shape_points.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <GeomLProp_SLProps.hxx>
#include <Poly_Triangulation.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "occt.h"
#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr double kMeshAngle = 0.35;   // rad between neighbouring facets, at most
constexpr double kPointsAngle = 0.7;  // the same where only points are wanted
constexpr double kMostParts = 256;    // of the side of a triangle

/// A copy with triangles: the mesher stores them in the shape. Geometry stays shared.
TopoDS_Shape meshed(const TopoDS_Shape& shape, double deflection, double angle) {
  TopoDS_Shape copy = BRepBuilderAPI_Copy(shape, Standard_False).Shape();
  BRepMesh_IncrementalMesh mesher(copy, deflection, Standard_False, angle, Standard_False);
  return copy;
}

struct Facets {
  Handle(Poly_Triangulation) triangulation;
  gp_Trsf placed;
  Eigen::Vector3d node(int i) const { return toEigen(triangulation->Node(i).Transformed(placed)); }
};

Facets facetsOf(const TopoDS_Face& face) {
  TopLoc_Location location;
  Facets facets{BRep_Tool::Triangulation(face, location), {}};
  facets.placed = location.Transformation();
  return facets;
}

/// The unit normal of the face at node `i`, on the side that its orientation says; zero where it has none.
Eigen::Vector3d normalAt(const TopoDS_Face& face, GeomLProp_SLProps& surface, const Facets& facets, int i) {
  const gp_Pnt2d uv = facets.triangulation->UVNode(i);
  surface.SetParameters(uv.X(), uv.Y());
  if (!surface.IsNormalDefined()) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d normal = toEigen(surface.Normal().XYZ());
  return face.Orientation() == TopAbs_REVERSED ? Eigen::Vector3d(-normal) : normal;
}

/// Points within a triangle, so many that they are `spacing` apart at most.
void fill(const std::array<Eigen::Vector3d, 3>& t, double spacing, std::vector<Eigen::Vector3d>& points) {
  const double longest = std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
  const int n = int(std::min(std::ceil(longest / spacing), kMostParts));
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      if ((i == 0 && j == 0) || i == n || j == n) continue;  // corners are there
      points.push_back(t[0] + (t[1] - t[0]) * (double(i) / n) + (t[2] - t[0]) * (double(j) / n));
    }
}

}  // namespace

TriangleMesh trianglesOf(const TopoDS_Shape& shape, double deflection) {
  TriangleMesh mesh;
  const TopoDS_Shape copy = meshed(shape, deflection, kMeshAngle);
  for (TopExp_Explorer it(copy, TopAbs_FACE); it.More(); it.Next()) {
    const TopoDS_Face& face = TopoDS::Face(it.Current());
    const Facets facets = facetsOf(face);
    if (facets.triangulation.IsNull()) continue;  // too thin for the mesher
    const int base = int(mesh.points.size()) - 1;
    GeomLProp_SLProps surface(BRep_Tool::Surface(face), 1, kNoLength);
    for (int i = 1; i <= facets.triangulation->NbNodes(); ++i) {
      mesh.points.push_back(facets.node(i));
      mesh.normals.push_back(normalAt(face, surface, facets, i));
    }
    for (int i = 1; i <= facets.triangulation->NbTriangles(); ++i) {
      int a = 0, b = 0, c = 0;
      facets.triangulation->Triangle(i).Get(a, b, c);
      if (face.Orientation() == TopAbs_REVERSED) std::swap(b, c);
      mesh.triangles.push_back({base + a, base + b, base + c});
    }
  }
  return mesh;
}

std::vector<Eigen::Vector3d> pointsOn(const TopoDS_Shape& shape, double sag) {
  return pointsOver(shape, sag, std::numeric_limits<double>::infinity());
}

std::vector<Eigen::Vector3d> pointsOver(const TopoDS_Shape& shape, double sag, double spacing) {
  const TopoDS_Shape copy = meshed(shape, sag, kPointsAngle);
  std::vector<Eigen::Vector3d> points;
  for (TopExp_Explorer it(copy, TopAbs_FACE); it.More(); it.Next()) {
    const TopoDS_Face& face = TopoDS::Face(it.Current());
    const Facets facets = facetsOf(face);
    if (facets.triangulation.IsNull()) continue;
    const bool flat = BRepAdaptor_Surface(face, Standard_False).GetType() == GeomAbs_Plane;
    // Of curved faces the mesher places some beside the border where chords stand for that.
    std::optional<BRepTopAdaptor_FClass2d> border;
    if (!flat) border.emplace(face, Precision::PConfusion());
    for (int i = 1; i <= facets.triangulation->NbNodes(); ++i)
      if (flat || border->Perform(facets.triangulation->UVNode(i)) != TopAbs_OUT)
        points.push_back(facets.node(i));
    if (!flat || !std::isfinite(spacing)) continue;
    for (int i = 1; i <= facets.triangulation->NbTriangles(); ++i) {
      int a = 0, b = 0, c = 0;
      facets.triangulation->Triangle(i).Get(a, b, c);
      fill({facets.node(a), facets.node(b), facets.node(c)}, spacing, points);
    }
  }
  return points;
}

}  // namespace bw::geometry
