// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/parts/crease.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "bw/core/parts/cut_order.h"
#include "bw/core/surface/refine.h"

namespace bw {

namespace {

using Eigen::Vector3d;
using Foot = SurfaceSampler::Foot;

constexpr int kSteps = 60;
constexpr double kSettled = 1e-8;        ///< mm of a step
constexpr double kMeets = 1e-4;          ///< mm of a place from both surfaces
constexpr double kTouches = 1e-2;        ///< mm of a border from the surface that ends at it
constexpr double kOneTangent = 1e-5;     ///< sin² of the angle between two surfaces
constexpr double kSamples = 60;          ///< in the diagonal of a block
constexpr double kBeside = 1;            ///< mm
constexpr double kNoArea = 1e-9;         ///< mm²
constexpr double kBehind = 2 * kBeside;  ///< mm into the foam that a surface bounds
constexpr double kTakenBy = 1e-3;        ///< mm

bool inside(const Box& box, const Vector3d& p, double more = 0) {
  const Eigen::Array3d local = box.frame.toLocal(p).array();
  return (local >= -more).all() && (local <= box.size.array() + more).all();
}

using EdgeKey = std::pair<int, int>;

/// The points of edges that surfaces meet at, joined to curves.
class Chains {
 public:
  void join(EdgeKey a, EdgeKey b) {
    neighbours_[a].push_back(b);
    neighbours_[b].push_back(a);
  }
  /// Each chain once, from one end to the other; closed ones come back to their first edge.
  std::vector<std::vector<EdgeKey>> take() {
    std::vector<std::vector<EdgeKey>> chains;
    for (const bool fromEnds : {true, false})
      for (auto& [key, next] : neighbours_) {
        if (next.empty() || (fromEnds && next.size() != 1)) continue;
        std::vector<EdgeKey> chain = {key};
        while (!neighbours_[chain.back()].empty()) {
          const EdgeKey here = chain.back(), there = neighbours_[here].back();
          neighbours_[here].pop_back();
          std::vector<EdgeKey>& back = neighbours_[there];
          if (const auto found = std::ranges::find(back, here); found != back.end()) back.erase(found);
          chain.push_back(there);
        }
        chains.push_back(std::move(chain));
      }
    return chains;
  }

 private:
  std::map<EdgeKey, std::vector<EdgeKey>> neighbours_;
};

/// The parts of a curve that lie in a box, cut off at its faces.
std::vector<Polyline> clipped(const Polyline& curve, const Box& box) {
  std::vector<Polyline> parts;
  bool open = false;
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    const Vector3d a = box.frame.toLocal(curve[i]), b = box.frame.toLocal(curve[i + 1]);
    double from = 0, to = 1;
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        const double limit = sign > 0 ? box.size(axis) : 0;
        const double outA = sign * (a(axis) - limit), outB = sign * (b(axis) - limit);
        if (outA <= 0 && outB <= 0) continue;
        if (outA > 0 && outB > 0) {
          to = -1;
        } else {
          const double at = outA / (outA - outB);
          (outA > 0 ? from : to) = outA > 0 ? std::max(from, at) : std::min(to, at);
        }
      }
    if (!(from < to)) {
      open = false;
      continue;
    }
    const auto at = [&](double t) -> Vector3d { return curve[i] + t * (curve[i + 1] - curve[i]); };
    if (!open) parts.push_back({from > 0 ? at(from) : curve[i]});
    parts.back().push_back(to < 1 ? at(to) : curve[i + 1]);
    open = to >= 1;
  }
  return parts;
}

}  // namespace

Result<std::optional<Vector3d>> nearestMeeting(const Vector3d& p, SurfaceSampler& first,
                                               SurfaceSampler& second) {
  Vector3d q = p;
  std::optional<Foot> seedA, seedB;
  for (int step = 0; step < kSteps; ++step) {
    const Result<Foot> a = first.closest(q, seedA ? &*seedA : nullptr);
    if (!a) return tl::unexpected<Error>(a.error());
    const Result<Foot> b = second.closest(q, seedB ? &*seedB : nullptr);
    if (!b) return tl::unexpected<Error>(b.error());
    seedA = *a;
    seedB = *b;
    const double c = a->normal.dot(b->normal), det = 1 - c * c;
    if (det < kOneTangent) return std::optional<Vector3d>();
    // Of the line in which both tangent planes meet the point nearest to p.
    const double ra = a->normal.dot(a->point - p), rb = b->normal.dot(b->point - p);
    const Vector3d next = p + ((ra - c * rb) * a->normal + (rb - c * ra) * b->normal) / det;
    const double moved = (next - q).norm();
    if (!std::isfinite(moved)) return std::optional<Vector3d>();
    if (moved < kSettled || (step + 1 == kSteps && moved < kMeets)) {
      const double apart = std::max((next - a->point).norm(), (next - b->point).norm());
      const double allowed = a->onBoundary || b->onBoundary ? kTouches : kMeets;
      return apart < allowed ? std::optional<Vector3d>(next) : std::nullopt;
    }
    q = next;
  }
  return std::optional<Vector3d>();
}

Result<std::vector<Polyline>> meetingCurves(const MeshedSurface& first, const MeshedSurface& second,
                                            const Box& box, const RunContext& context) {
  const double apart = box.size.norm() / kSamples;
  const TriangleMesh mesh = refined(*first.mesh, box, apart);
  const std::size_t n = mesh.points.size();
  std::vector<double> offset(n, 0);
  std::vector<char> known(n, 0), touches(n, 0);
  Foot seed;
  bool seeded = false;
  for (std::size_t i = 0; i < n; ++i) {
    if (context.stopped()) return stoppedError();
    if (!inside(box, mesh.points[i], 2 * apart)) continue;
    const Result<Foot> foot = second.sampler->closest(mesh.points[i], seeded ? &seed : nullptr);
    if (!foot) return tl::unexpected<Error>(foot.error());
    seed = *foot;
    seeded = true;
    offset[i] = second.sampler->offset(mesh.points[i], *foot);
    known[i] = !foot->onBoundary || foot->distance < kTouches;
    touches[i] = foot->distance < kTouches;
  }
  std::map<EdgeKey, int> sharedBy;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++sharedBy[std::minmax(t[k], t[(k + 1) % 3])];

  Chains chains;
  const auto crosses = [&](int a, int b) {
    const auto i = std::size_t(a), j = std::size_t(b);
    return known[i] && known[j] && (offset[i] < 0) != (offset[j] < 0);
  };
  for (const auto& t : mesh.triangles) {
    std::vector<EdgeKey> met;
    for (std::size_t k = 0; k < 3; ++k)
      if (crosses(t[k], t[(k + 1) % 3])) met.push_back(std::minmax(t[k], t[(k + 1) % 3]));
    if (met.size() == 2) chains.join(met[0], met[1]);
  }
  std::vector<Polyline> curves;
  for (const std::vector<EdgeKey>& chain : chains.take()) {
    Polyline curve;
    for (const auto& [a, b] : chain) {
      const double fa = offset[std::size_t(a)], fb = offset[std::size_t(b)];
      const Vector3d guess = mesh.points[std::size_t(a)] +
                             fa / (fa - fb) * (mesh.points[std::size_t(b)] - mesh.points[std::size_t(a)]);
      const Result<std::optional<Vector3d>> point = nearestMeeting(guess, *first.sampler, *second.sampler);
      if (!point) return tl::unexpected<Error>(point.error());
      if (*point && (**point - guess).norm() < apart) curve.push_back(**point);
    }
    for (Polyline& part : clipped(curve, box)) curves.push_back(std::move(part));
  }
  // Surfaces that end at each other do not cross.
  Chains borders;
  for (const auto& [edge, count] : sharedBy)
    if (count == 1 && touches[std::size_t(edge.first)] && touches[std::size_t(edge.second)] &&
        !crosses(edge.first, edge.second))
      borders.join({edge.first, edge.first}, {edge.second, edge.second});
  for (const std::vector<EdgeKey>& chain : borders.take()) {
    Polyline curve;
    for (const EdgeKey& vertex : chain) curve.push_back(mesh.points[std::size_t(vertex.first)]);
    for (Polyline& part : clipped(curve, box)) curves.push_back(std::move(part));
  }
  return curves;
}

namespace {

/// Measures curves against the meeting of two surfaces; `each` is told of every point and what is known of
/// it.
template <class Each>
Result<void> measure(const std::vector<Polyline>& curves, SurfaceSampler& first, SurfaceSampler& second,
                     const RunContext& context, const Each& each) {
  for (std::size_t c = 0; c < curves.size(); ++c)
    for (std::size_t i = 0; i < curves[c].size(); ++i) {
      if (context.stopped()) return stoppedError();
      const Vector3d& p = curves[c][i];
      const Result<std::optional<Vector3d>> nearest = nearestMeeting(p, first, second);
      if (!nearest) return tl::unexpected<Error>(nearest.error());
      const double before = i > 0 ? (p - curves[c][i - 1]).norm() : 0;
      const double after = i + 1 < curves[c].size() ? (curves[c][i + 1] - p).norm() : 0;
      each(c, p, *nearest ? std::optional((p - **nearest).norm()) : std::nullopt, 0.5 * (before + after));
    }
  return {};
}

/// mm by which `p` is outside of what a cut leaves; ≤ 0 for what stays.
Result<double> takenBy(const CutSurfaces& cut, const Vector3d& p) {
  const Result<double> depth = depthIn({{cut.cut.sampler, cut.side}}, p);
  return depth ? Result<double>(-*depth) : depth;
}

/// True if a line through `p` along `way` meets the triangles, or passes by their border within kBeside.
bool isOver(const TriangleMesh& mesh, const Vector3d& way, const Vector3d& p) {
  const Vector3d x = way.unitOrthogonal(), y = way.cross(x);
  const auto flat = [&](const Vector3d& q) { return Eigen::Vector2d((q - p).dot(x), (q - p).dot(y)); };
  for (const auto& t : mesh.triangles) {
    const std::array<Eigen::Vector2d, 3> corner = {flat(mesh.points[std::size_t(t[0])]),
                                                   flat(mesh.points[std::size_t(t[1])]),
                                                   flat(mesh.points[std::size_t(t[2])])};
    const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      return a.x() * b.y() - a.y() * b.x();
    };
    const double area = cross(corner[1] - corner[0], corner[2] - corner[0]);
    bool within = std::abs(area) > kNoArea;
    for (std::size_t k = 0; k < 3 && within; ++k) {
      const Eigen::Vector2d edge = corner[(k + 1) % 3] - corner[k];
      within = std::copysign(1, area) * cross(edge, -corner[k]) >= -kBeside * edge.norm();
    }
    if (within) return true;
  }
  return false;
}

/// The stretches of curves that no cut but those two takes away.
Result<std::vector<Polyline>> left(const std::vector<Polyline>& curves, const std::vector<CutSurfaces>& cuts,
                                   std::size_t first, std::size_t second) {
  std::vector<Polyline> kept;
  for (const Polyline& curve : curves) {
    bool open = false;
    for (const Vector3d& p : curve) {
      bool stays = true;
      for (std::size_t k = 0; k < cuts.size() && stays; ++k) {
        if (k == first || k == second || !cuts[k].cut.sampler) continue;
        const Result<double> taken = takenBy(cuts[k], p);
        if (!taken) return tl::unexpected<Error>(taken.error());
        stays = *taken < kTakenBy;
      }
      if (stays && !open) kept.emplace_back();
      if (stays) kept.back().push_back(p);
      open = stays;
    }
  }
  std::erase_if(kept, [](const Polyline& curve) { return curve.size() < 2; });
  return kept;
}

Result<std::optional<Crease>> creaseOf(const std::vector<CutSurfaces>& cuts, std::size_t first,
                                       std::size_t second, const Box& box, const RunContext& context) {
  const CutSurfaces &a = cuts[first], &b = cuts[second];
  const auto meeting = [&](const MeshedSurface& one,
                           const MeshedSurface& other) -> Result<std::vector<Polyline>> {
    const Result<std::vector<Polyline>> curves = meetingCurves(one, other, box, context);
    if (!curves) return curves;
    return left(*curves, cuts, first, second);
  };
  Result<std::vector<Polyline>> cut = meeting(a.cut, b.cut);
  if (!cut) return tl::unexpected<Error>(cut.error());
  const Result<std::vector<Polyline>> designed = meeting(a.target, b.target);
  if (!designed) return tl::unexpected<Error>(designed.error());
  if (cut->empty() && designed->empty()) return std::optional<Crease>();
  Crease crease{first, second, std::move(*cut)};
  crease.off.resize(crease.curves.size());
  double sum = 0, weights = 0;
  const auto count = [&](const Vector3d& p, double off, double weight) {
    sum += off * weight;
    weights += weight;
    if (off < crease.offMax) return;
    crease.offMax = off;
    crease.worst = p;
  };
  Result<void> ok =
      measure(crease.curves, *a.target.sampler, *b.target.sampler, context,
              [&](std::size_t c, const Vector3d& p, const std::optional<double>& off, double share) {
                crease.off[c].push_back(off);
                crease.length += share;
                off ? count(p, *off, share) : void(crease.alone += share);
              });
  if (ok)
    ok = measure(*designed, *a.cut.sampler, *b.cut.sampler, context,
                 [&](std::size_t, const Vector3d& p, const std::optional<double>& off, double share) {
                   off ? count(p, *off, share) : void(crease.lacking += share);
                 });
  if (!ok) return tl::unexpected<Error>(ok.error());
  if (weights > 0) crease.offMean = sum / weights;
  return std::optional(std::move(crease));
}

/// The most that the blade of one cut takes of the surface of another, beyond its own.
Result<void> tellTaken(const std::vector<CutSurfaces>& cuts, std::size_t taker, std::size_t of,
                       const Box& box, double tolerance, const RunContext& context, Findings& findings) {
  double most = tolerance;
  std::optional<Vector3d> worst;
  for (const Vector3d& p : refined(*cuts[of].target.mesh, box, box.size.norm() / kSamples).points) {
    if (context.stopped()) return stoppedError();
    if (!inside(box, p)) continue;
    const Result<double> taken = takenBy(cuts[taker], p);
    if (!taken) return tl::unexpected<Error>(taken.error());
    if (*taken <= most) continue;
    // What is meant to go is over the surface of a cut: the foam behind this place, not what borders on it.
    const Vector3d behind = p + kBehind * cuts[of].kept;
    bool meant = false;
    for (std::size_t k = 0; k < cuts.size() && !meant; ++k) {
      if (k == of || !cuts[k].cut.sampler) continue;
      const Result<double> by = k == taker ? *taken : takenBy(cuts[k], p);
      if (!by) return tl::unexpected<Error>(by.error());
      meant = *by > 0 && isOver(*cuts[k].target.mesh, cuts[k].kept, behind);
    }
    if (meant) continue;
    most = *taken;
    worst = p;
  }
  if (worst)
    findings.push_back(
        {Severity::error, TakesSurface{cuts[taker].id, cuts[of].id, most, tolerance}, {{}, worst}, {}});
  return {};
}

}  // namespace

Result<CutsTogether> compareCuts(const std::vector<CutSurfaces>& cuts, const Box& box, double tolerance,
                                 const RunContext& context) {
  CutsTogether together;
  const auto made = std::size_t(
      std::ranges::count_if(cuts, [](const CutSurfaces& cut) { return cut.cut.sampler != nullptr; }));
  for (std::size_t i = 0; i < made; ++i)
    for (std::size_t j = i + 1; j < made; ++j) {
      Result<std::optional<Crease>> crease = creaseOf(cuts, i, j, box, context);
      if (!crease) return tl::unexpected<Error>(crease.error());
      if (*crease) together.creases.push_back(std::move(**crease));
    }
  for (std::size_t i = 0; i < made; ++i) {
    std::vector<double>& depths = together.depths.emplace_back();
    if (!cuts[i].shown) continue;
    for (const Vector3d& p : *cuts[i].shown) {
      if (context.stopped()) return stoppedError();
      double depth = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < made; ++k) {
        if (k == i) continue;
        const Result<double> taken = takenBy(cuts[k], p);
        if (!taken) return tl::unexpected<Error>(taken.error());
        depth = std::min(depth, -*taken);
      }
      depths.push_back(depth);
    }
  }
  for (const Crease& crease : together.creases)
    if (crease.offMax > tolerance || crease.lacking > 0)
      together.findings.push_back({crease.offMax > tolerance ? Severity::error : Severity::warning,
                                   CreaseOff{cuts[crease.first].id, cuts[crease.second].id, crease.offMax,
                                             crease.offMean, tolerance, crease.lacking},
                                   {{}, crease.worst},
                                   {}});
  for (std::size_t i = 0; i < made; ++i)
    for (std::size_t j = 0; j < cuts.size(); ++j)
      if (i != j)
        if (Result<void> ok = tellTaken(cuts, i, j, box, tolerance, context, together.findings); !ok)
          return tl::unexpected<Error>(ok.error());
  return together;
}

}  // namespace bw
