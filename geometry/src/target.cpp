// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>

#include "bw/core/text/number_text.h"
#include "model_impl.h"
#include "occt.h"

namespace bw::geometry {

namespace {

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

}  // namespace

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

Result<Target> Target::make(const CadModel& model, const FaceChoice& choice, Findings* findings) {
  auto chosen = model.choose(choice, findings);
  if (!chosen) return tl::unexpected(chosen.error());
  return guarded(ErrorCode::internal, "cannot prepare the faces", [&]() -> Result<Target> {
    auto impl = std::make_shared<Impl>();
    // The model outlives its targets through this shared handle.
    impl->model = model.shared();
    impl->indices = *chosen;
    impl->edgeUses.assign(impl->model->edges.size(), 0);
    impl->sheet = true;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int i : *chosen) {
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
    impl->meanNormal = impl->area > 0 ? Eigen::Vector3d(sum / impl->area) : Eigen::Vector3d::Zero();
    if (impl->sheet) {
      // A sheet has no inside: it is seen from above, or else from the positive side of y or x.
      const Eigen::Vector3d& m = impl->meanNormal;
      const int axis = std::abs(m.z()) > kUpright ? 2 : std::abs(m.y()) > kUpright ? 1 : 0;
      impl->flipped = m[axis] < 0;
      if (impl->flipped) impl->meanNormal = -impl->meanNormal;
    }
    return Target(impl);
  });
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
