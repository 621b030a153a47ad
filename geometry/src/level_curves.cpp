// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "level_curves.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>

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
  // Of a carrier all is looked at, so that the curves of its faces, whose cells are others, lie on it whole.
  for (const Carrier& carrier : target.carriers) {
    Box all;
    all.frame.origin = carrier.bounds.min;
    all.size = carrier.bounds.size();
    faces_.push_back(levelsOf(*carrier.surface, normal, all));
  }
}

bool PlaneCutter::grazes(double level) const {
  const auto close = [&](double low, double high) {
    return std::abs(low - level) < kGraze && std::abs(high - level) < kGraze;
  };
  return std::any_of(edges_.begin(), edges_.end(),
                     [&](const EdgeLevels& e) { return close(e.low, e.high); }) ||
         std::any_of(faces_.begin(), faces_.begin() + std::ptrdiff_t(target_.faces.size()),
                     [&](const FaceLevels& f) { return close(f.low, f.high); });
}

PlaneCutter::Cut PlaneCutter::cut(double level, bool byKernel) const {
  const std::vector<Root> roots = crossings(level);
  Cut result;
  for (int face = 0; face < int(target_.faces.size()); ++face) {
    std::vector<LevelPiece> chains;
    if (byKernel)
      intersect(face, level, chains);
    else
      march(face, level, chains);
    split(face, roots, level, chains, result);
  }
  if (target_.faces.size() > 1) bridge(roots, level, byKernel, result);
  return result;
}

bool PlaneCutter::project(int face, double level, LevelNode& node) const {
  const FaceGeometry& geometry = geometryOf(face);
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
  geometryOf(face).patch().first(node.uv.x(), node.uv.y(), jet);
  const Eigen::Vector3d n = jet.du.cross(jet.dv);
  const Eigen::Vector3d t = normal_.cross(n);
  const double length = t.norm();
  if (!(length > kNoTangent * n.norm()) || length == 0) return Eigen::Vector3d::Zero();
  return t / length;
}

EdgeLevels levelsOf(const EdgeGeometry& edge, int index, const Eigen::Vector3d& normal) {
  EdgeLevels levels;
  levels.edge = index;
  const auto g = [&](double t) { return normal.dot(edge.value(t)); };
  for (std::size_t i = 0; i < edge.t.size(); ++i) {
    levels.t.push_back(edge.t[i]);
    levels.g.push_back(normal.dot(edge.points[i]));
  }
  // Insert the extrema between samples, so that each interval has at most one crossing.
  for (std::size_t i = 1; i + 1 < levels.t.size(); ++i) {
    const double before = levels.g[i] - levels.g[i - 1], after = levels.g[i + 1] - levels.g[i];
    if (before * after >= 0) continue;
    const bool peak = before > 0;
    const double t = boost::math::tools::brent_find_minima([&](double at) { return peak ? -g(at) : g(at); },
                                                           levels.t[i - 1], levels.t[i + 1],
                                                           std::numeric_limits<double>::digits / 2)
                         .first;
    if (t == levels.t[i]) continue;
    const std::size_t at = t < levels.t[i] ? i : i + 1;
    levels.t.insert(levels.t.begin() + std::ptrdiff_t(at), t);
    levels.g.insert(levels.g.begin() + std::ptrdiff_t(at), g(t));
    ++i;
  }
  levels.low = *std::min_element(levels.g.begin(), levels.g.end());
  levels.high = *std::max_element(levels.g.begin(), levels.g.end());
  return levels;
}

FaceLevels levelsOf(const FaceGeometry& face, const Eigen::Vector3d& normal, const Box& region) {
  FaceLevels levels;
  const int nu = int(face.gridU().size()), nv = int(face.gridV().size());
  levels.g.resize(std::size_t(nu) * nv);
  levels.low = 1e300;
  levels.high = -1e300;
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      const double g = normal.dot(face.gridPoint(i, j));
      levels.g[std::size_t(i) * nv + j] = g;
      levels.low = std::min(levels.low, g);
      levels.high = std::max(levels.high, g);
    }
  }
  levels.active.assign(std::size_t(nu - 1) * (nv - 1), 1);
  levels.rowLow.assign(std::size_t(nu - 1), 1e300);
  levels.rowHigh.assign(std::size_t(nu - 1), -1e300);
  for (int i = 0; i + 1 < nu; ++i) {
    for (int j = 0; j + 1 < nv; ++j) {
      Bounds cell, local;
      for (const int a : {0, 1}) {
        for (const int b : {0, 1}) {
          const Eigen::Vector3d& p = face.gridPoint(i + a, j + b);
          cell.add(p);
          local.add(region.frame.toLocal(p));
        }
      }
      const double slack = 0.5 * cell.size().norm() + kSlack;
      const bool far = ((local.min.array() - slack) > region.size.array()).any() ||
                       ((local.max.array() + slack) < 0).any();
      if (far) {
        levels.active[std::size_t(i) * (nv - 1) + j] = 0;
        continue;
      }
      for (const int a : {0, 1}) {
        for (const int b : {0, 1}) {
          const double g = levels.g[std::size_t(i + a) * nv + (j + b)];
          levels.rowLow[i] = std::min(levels.rowLow[i], g);
          levels.rowHigh[i] = std::max(levels.rowHigh[i], g);
        }
      }
    }
  }
  return levels;
}

}  // namespace bw::geometry
