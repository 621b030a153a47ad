// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "level_curves.h"

#include <algorithm>
#include <cmath>

#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr double kFlatMetric =
    1e-14;  // of E G: a smaller determinant of the first fundamental form is rounding
constexpr double kTouching = 1e-12;  // squared sine of the angle between face and plane: below it they touch
constexpr double kNoTangent = 1e-8;  // sine of that angle below which the section has no tangent
constexpr double kGraze = 1e-7;      // mm: a border all of whose samples are this close runs along the plane

}  // namespace

PlaneCutter::PlaneCutter(const Target::Impl& target, const Eigen::Vector3d& normal, const Box& region)
    : target_(target), normal_(normal) {
  for (int e = 0; e < int(target.edgeUses.size()); ++e) {
    const EdgeGeometry& edge = target.model->edges[e];
    if (target.edgeUses[e] == 0 || edge.degenerate()) continue;
    edges_.push_back(levelsOf(edge, e, normal));
  }
  for (const auto& face : target.faces) faces_.push_back(levelsOf(*face, normal, region));
}

bool PlaneCutter::grazes(double level) const {
  const auto close = [&](double low, double high) {
    return std::abs(low - level) < kGraze && std::abs(high - level) < kGraze;
  };
  return std::any_of(edges_.begin(), edges_.end(),
                     [&](const EdgeLevels& e) { return close(e.low, e.high); }) ||
         std::any_of(faces_.begin(), faces_.end(), [&](const FaceLevels& f) { return close(f.low, f.high); });
}

PlaneCutter::Cut PlaneCutter::cut(double level, bool byKernel) const {
  const std::vector<Root> roots = crossings(level);
  Cut result;
  for (int face = 0; face < int(faces_.size()); ++face) {
    std::vector<LevelPiece> chains;
    if (byKernel)
      intersect(face, level, chains);
    else
      march(face, level, chains);
    split(face, roots, level, chains, result);
  }
  return result;
}

bool PlaneCutter::project(int face, double level, LevelNode& node) const {
  const FaceGeometry& geometry = *target_.faces[face];
  Jet jet;
  for (int k = 0; k < 12; ++k) {
    geometry.patch().first(node.uv.x(), node.uv.y(), jet);
    const double f = normal_.dot(jet.p) - level;
    node.p = jet.p;
    if (std::abs(f) < kConverged) return true;
    // The shortest way in space along the surface to the plane.
    const double gu = normal_.dot(jet.du), gv = normal_.dot(jet.dv);
    const double E = jet.du.squaredNorm(), F = jet.du.dot(jet.dv), G = jet.dv.squaredNorm();
    const double det = E * G - F * F;
    if (!(det > kFlatMetric * E * G) || det == 0) return false;
    const double hu = (G * gu - F * gv) / det, hv = (E * gv - F * gu) / det;
    const double slope = gu * hu + gv * hv;
    if (!(slope > kTouching)) return false;
    node.uv -= (f / slope) * Eigen::Vector2d(hu, hv);
    if (geometry.patch().isSpline()) {
      node.uv.x() = std::clamp(node.uv.x(), geometry.u0(), geometry.u1());
      node.uv.y() = std::clamp(node.uv.y(), geometry.v0(), geometry.v1());
    }
  }
  return std::abs(normal_.dot(node.p) - level) < kSlack;
}

bool PlaneCutter::between(int face, const LevelNode& a, const LevelNode& b, double at, double level,
                          LevelNode& node) const {
  node = {};
  node.uv = a.uv + at * (b.uv - a.uv);
  if (!project(face, level, node)) return false;
  // A foot far from the chord belongs to another branch.
  const double chord = (b.p - a.p).norm();
  return (node.p - (a.p + at * (b.p - a.p))).norm() <= chord + kSlack;
}

Eigen::Vector3d PlaneCutter::tangent(int face, const LevelNode& node) const {
  Jet jet;
  target_.faces[face]->patch().first(node.uv.x(), node.uv.y(), jet);
  const Eigen::Vector3d n = jet.du.cross(jet.dv);
  const Eigen::Vector3d t = normal_.cross(n);
  const double length = t.norm();
  if (!(length > kNoTangent * n.norm()) || length == 0) return Eigen::Vector3d::Zero();
  return t / length;
}

}  // namespace bw::geometry
