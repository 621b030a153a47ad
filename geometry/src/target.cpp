// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <BRepBuilderAPI_Copy.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>

#include <algorithm>
#include <cmath>
#include <functional>

#include "bw/core/text/number_text.h"
#include "carriers.h"
#include "model_impl.h"
#include "occt.h"

namespace bw::geometry {

namespace {

constexpr double kMeshAngle = 0.35;       // rad between neighbouring facets, at most
constexpr double kMeshParts = 64;         // of one interval of a face's grid, at most
constexpr double kOverview = 1.0 / 1000;  // of the file's size, for the mesh of all faces
constexpr std::size_t kBatch = 32;        // faces that are meshed between two looks at the stop token

/// Parameters along one direction such that chords keep within `deflection` of the face. `u` tells which
/// direction.
std::vector<double> meshLines(const FaceGeometry& face, bool u, double deflection) {
  const auto& along = u ? face.gridU() : face.gridV();
  const auto& across = u ? face.gridV() : face.gridU();
  std::vector<double> lines = {along.front()};
  const std::size_t step = std::max<std::size_t>(1, across.size() / 24);
  for (std::size_t i = 0; i + 1 < along.size(); ++i) {
    const double h = along[i + 1] - along[i], middle = 0.5 * (along[i] + along[i + 1]);
    double parts = 1;
    for (std::size_t j = 0; j < across.size(); j += step) {
      Jet s;
      face.patch().second(u ? middle : across[j], u ? across[j] : middle, s);
      const Eigen::Vector3d cross = s.du.cross(s.dv);
      const double length = cross.norm();
      if (!(length > 1e-12 * s.du.norm() * s.dv.norm()) || length == 0) continue;
      const double bend = std::abs((u ? s.duu : s.dvv).dot(cross)) / length, speed = (u ? s.du : s.dv).norm();
      parts = std::max(parts, std::sqrt(bend * h * h / (4 * deflection)));  // half the deflection a direction
      if (speed > 0) parts = std::max(parts, bend * h / (speed * kMeshAngle));
    }
    const int n = int(std::ceil(std::min(parts, kMeshParts)));
    for (int k = 1; k <= n; ++k) lines.push_back(k == n ? along[i + 1] : along[i] + h * k / n);
  }
  return lines;
}

/// A face that is the whole rectangle of its parameters needs no general mesher.
void meshNatural(const FaceGeometry& face, bool flipped, double deflection, TriangleMesh& mesh) {
  const std::vector<double> us = meshLines(face, true, deflection), vs = meshLines(face, false, deflection);
  const int base = int(mesh.points.size()), nu = int(us.size()), nv = int(vs.size());
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      mesh.points.push_back(face.patch().value(us[i], vs[j]));
      const Eigen::Vector3d n = face.normal(us[i], vs[j]);
      mesh.normals.push_back(flipped ? Eigen::Vector3d(-n) : n);
    }
  }
  const bool flip = face.reversed() != flipped;
  const auto add = [&](int a, int b, int c) {
    // At a pole two corners are the same point.
    const auto same = [&](int p, int q) { return mesh.points[p] == mesh.points[q]; };
    if (same(a, b) || same(b, c) || same(c, a)) return;
    mesh.triangles.push_back(flip ? std::array<int, 3>{a, c, b} : std::array<int, 3>{a, b, c});
  };
  for (int i = 0; i + 1 < nu; ++i) {
    for (int j = 0; j + 1 < nv; ++j) {
      const int a = base + i * nv + j, b = a + nv, c = b + 1, d = a + 1;
      // The shorter diagonal follows the surface better.
      if ((mesh.points[a] - mesh.points[c]).squaredNorm() <=
          (mesh.points[b] - mesh.points[d]).squaredNorm()) {
        add(a, b, c);
        add(a, c, d);
      } else {
        add(a, b, d);
        add(b, c, d);
      }
    }
  }
}

/// Triangles of OCCT's mesher for the faces with borders of their own.
void meshTrimmed(const std::vector<const FaceGeometry*>& faces, bool flipped, double deflection,
                 TriangleMesh& mesh, const std::function<void(std::size_t)>& done) {
  TopoDS_Compound compound;
  BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const FaceGeometry* face : faces) builder.Add(compound, face->face());
  // The mesher stores its result in the shape, so it works on a shape of its own; the geometry stays shared.
  const TopoDS_Shape shape = BRepBuilderAPI_Copy(compound, Standard_False).Shape();
  BRepMesh_IncrementalMesh mesher(shape, deflection, Standard_False, kMeshAngle, Standard_True);
  std::size_t at = 0;
  for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next(), ++at) {
    const FaceGeometry& face = *faces[at];
    TopLoc_Location location;
    const Handle(Poly_Triangulation) triangulation =
        BRep_Tool::Triangulation(TopoDS::Face(it.Current()), location);
    if (triangulation.IsNull()) continue;  // too thin for the mesher
    const bool flip = face.reversed() != flipped;
    const int base = int(mesh.points.size());
    for (int i = 1; i <= triangulation->NbNodes(); ++i) {
      mesh.points.push_back(toEigen(triangulation->Node(i).Transformed(location.Transformation())));
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();
      if (triangulation->HasUVNodes()) {
        const gp_Pnt2d uv = triangulation->UVNode(i);
        normal = face.normal(uv.X(), uv.Y());
      }
      mesh.normals.push_back(flipped ? Eigen::Vector3d(-normal) : normal);
    }
    for (int i = 1; i <= triangulation->NbTriangles(); ++i) {
      int a = 0, b = 0, c = 0;
      triangulation->Triangle(i).Get(a, b, c);
      if (flip) std::swap(b, c);
      mesh.triangles.push_back({base + a - 1, base + b - 1, base + c - 1});
    }
    done(at);
  }
}

/// Where the surface has no normal of its own (a pole), the triangles around give it.
void completeNormals(TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> sums(mesh.points.size(), Eigen::Vector3d::Zero());
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d n =
        (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
    for (const int i : t) sums[i] += n;
  }
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (mesh.normals[i].squaredNorm() > 0.5) continue;
    const double length = sums[i].norm();
    mesh.normals[i] = length > 0 ? Eigen::Vector3d(sums[i] / length) : Eigen::Vector3d::UnitZ();
  }
}

constexpr double kFinestMesh = 1e-6;             // of the size: no finer deflection
constexpr double kUpright = 1e-3;                // of a unit normal: a smaller part points nowhere
constexpr double kDeflectionRatio = 1.0 / 2000;  // of the size, for display

/// Area-weighted mean of the outer normals, and the area it was summed over.
Eigen::Vector3d normalSum(const FaceGeometry& face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0;
  const int nu = int(face.gridU().size()), nv = int(face.gridV().size());
  for (int i = 0; i + 1 < nu; ++i) {
    for (int j = 0; j + 1 < nv; ++j) {
      if (!face.gridInside(i, j) || !face.gridInside(i + 1, j + 1)) continue;
      const Eigen::Vector3d cross = (face.gridPoint(i + 1, j + 1) - face.gridPoint(i, j))
                                        .cross(face.gridPoint(i, j + 1) - face.gridPoint(i + 1, j));
      sum += 0.5 * cross;
      area += 0.5 * cross.norm();
    }
  }
  if (face.reversed()) sum = -sum;
  if (!(area > 0)) {
    return face.area() * face.normal(0.5 * (face.u0() + face.u1()), 0.5 * (face.v0() + face.v1()));
  }
  return sum * (face.area() / area);
}

/// Appends triangles of faces within `deflection` mm (> 0) to `mesh`. `flipped` turns their outer side round.
/// Returns, for each triangle of `mesh`, the position of its face in `faces`; `mesh` was empty before. A face
/// too thin for the mesher has no triangles.
std::vector<int> meshFaces(const std::vector<const FaceGeometry*>& faces, bool flipped, double deflection,
                           TriangleMesh& mesh) {
  std::vector<int> owners;
  std::vector<const FaceGeometry*> trimmed;
  std::vector<int> trimmedAt;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i]->natural()) {
      meshNatural(*faces[i], flipped, deflection, mesh);
      owners.resize(mesh.triangles.size(), int(i));
    } else {
      trimmed.push_back(faces[i]);
      trimmedAt.push_back(int(i));
    }
  }
  if (!trimmed.empty()) {
    meshTrimmed(trimmed, flipped, deflection, mesh,
                [&](std::size_t at) { owners.resize(mesh.triangles.size(), trimmedAt[at]); });
  }
  completeNormals(mesh);
  return owners;
}

}  // namespace

Result<FaceMesh> faceMesh(const CadModel& model, const RunContext& context) {
  return guarded(ErrorCode::internal, "cannot make triangles of the faces", [&]() -> Result<FaceMesh> {
    const CadModel::Impl& impl = model.impl();
    const double deflection = kOverview * impl.info.bounds.size().norm();
    FaceMesh all;
    std::vector<const FaceGeometry*> faces;
    std::vector<int> indices;
    for (std::size_t i = 0; i <= impl.faces.size(); ++i) {
      if (i < impl.faces.size() && impl.faces[i]) {
        faces.push_back(impl.faces[i].get());
        indices.push_back(int(i));
      }
      if (faces.size() < kBatch && i < impl.faces.size()) continue;
      if (context.stopped()) return stoppedError();
      TriangleMesh mesh;
      const std::vector<int> owners = meshFaces(faces, false, deflection, mesh);
      const int base = int(all.mesh.points.size());
      all.mesh.points.insert(all.mesh.points.end(), mesh.points.begin(), mesh.points.end());
      all.mesh.normals.insert(all.mesh.normals.end(), mesh.normals.begin(), mesh.normals.end());
      for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
        const auto& [a, b, c] = mesh.triangles[k];
        all.mesh.triangles.push_back({base + a, base + b, base + c});
        all.faces.push_back(indices[std::size_t(owners[k])]);
      }
      faces.clear();
      indices.clear();
    }
    return all;
  });
}

std::array<double, 2> Target::Impl::extent(const Eigen::Vector3d& direction) const {
  std::array<double, 2> result = {1e300, -1e300};
  for (const auto& face : faces) {
    const auto range = face->extent(direction, model->edges);
    result[0] = std::min(result[0], range[0]);
    result[1] = std::max(result[1], range[1]);
  }
  return result;
}

Target::Target(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

namespace {

std::vector<std::vector<Neighbour>> neighboursOf(const Target::Impl& target) {
  std::vector<std::vector<int>> facesOf(target.edgeUses.size());
  for (std::size_t face = 0; face < target.faces.size(); ++face)
    for (const TrimEdge& trim : target.faces[face]->trims())
      if (trim.edge >= 0 && target.edgeUses[std::size_t(trim.edge)] == 2)
        facesOf[std::size_t(trim.edge)].push_back(int(face));
  std::vector<std::vector<Neighbour>> neighbours(target.faces.size());
  const auto add = [&](int face, int other, double tolerance) {
    std::vector<Neighbour>& list = neighbours[std::size_t(face)];
    const auto known = std::ranges::find(list, other, &Neighbour::face);
    if (known == list.end())
      list.push_back({other, tolerance});
    else
      known->tolerance = std::max(known->tolerance, tolerance);
  };
  for (std::size_t edge = 0; edge < facesOf.size(); ++edge) {
    const std::vector<int>& two = facesOf[edge];
    if (two.size() != 2 || two[0] == two[1]) continue;
    add(two[0], two[1], target.model->edges[edge].tolerance);
    add(two[1], two[0], target.model->edges[edge].tolerance);
  }
  return neighbours;
}

}  // namespace

std::shared_ptr<const Target::Impl> targetOf(std::shared_ptr<const CadModel::Impl> model,
                                             const std::vector<int>& faces) {
  auto impl = std::make_shared<Target::Impl>();
  // The model outlives its targets through this shared handle.
  impl->model = std::move(model);
  impl->indices = faces;
  impl->edgeUses.assign(impl->model->edges.size(), 0);
  impl->sheet = true;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int i : faces) {
    const auto& face = impl->model->faces[i];
    impl->faces.push_back(face);
    impl->area += face->area();
    const Bounds& bounds = impl->model->info.faceList[i].bounds;
    impl->bounds.add(bounds.min);
    impl->bounds.add(bounds.max);
    sum += normalSum(*face);
    if (impl->model->inSolid[i]) impl->sheet = false;
    for (const TrimEdge& trim : face->trims()) {
      if (trim.edge >= 0) ++impl->edgeUses[trim.edge];
    }
  }
  impl->neighbours = neighboursOf(*impl);
  impl->carriers = carriersOf(*impl);
  impl->meanNormal = impl->area > 0 ? Eigen::Vector3d(sum / impl->area) : Eigen::Vector3d::Zero();
  if (impl->sheet) {
    // A sheet has no inside: it is seen from above, or else from the positive side of y or x.
    const Eigen::Vector3d& m = impl->meanNormal;
    const int axis = std::abs(m.z()) > kUpright ? 2 : std::abs(m.y()) > kUpright ? 1 : 0;
    impl->flipped = m[axis] < 0;
    if (impl->flipped) impl->meanNormal = -impl->meanNormal;
  }
  return impl;
}

Result<Target> Target::make(const CadModel& model, const FaceChoice& choice, Findings* findings) {
  auto chosen = model.choose(choice, findings);
  if (!chosen) return tl::unexpected(chosen.error());
  return guarded(ErrorCode::internal, "cannot prepare the faces",
                 [&]() -> Result<Target> { return Target(targetOf(model.shared(), *chosen)); });
}

Bounds Target::bounds() const { return impl_->bounds; }

double Target::area() const { return impl_->area; }

const std::vector<int>& Target::faces() const { return impl_->indices; }

Result<TriangleMesh> Target::mesh(double deflection) const {
  if (!std::isfinite(deflection) || deflection < 0) {
    return fail(ErrorCode::badInput, "the deflection of a mesh must be 0 or more mm", "deflection",
                deflection, 0.0);
  }
  const double size = impl_->bounds.size().norm();
  if (deflection == 0) deflection = size * kDeflectionRatio;
  deflection = std::max(deflection, kFinestMesh * size);
  return guarded(ErrorCode::internal, "cannot make triangles of the target", [&]() -> Result<TriangleMesh> {
    TriangleMesh mesh;
    std::vector<const FaceGeometry*> faces;
    for (const auto& face : impl_->faces) faces.push_back(face.get());
    meshFaces(faces, impl_->flipped, deflection, mesh);
    if (mesh.triangles.empty()) {
      return fail(ErrorCode::internal, "no triangles could be made of the target; choose other faces");
    }
    return mesh;
  });
}

}  // namespace bw::geometry
