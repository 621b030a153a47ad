// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>

#include "base/work_meter.h"
#include "biarc/biarc_problem.h"

namespace bw::biarc {

namespace {

/// Points on the arcs whose distance from a chain of very many data is looked at.
constexpr std::size_t kMostSamples = 40000;
/// Work (`WorkMeter`) of a nearest point.
constexpr std::int64_t kFootWork = 3;

}  // namespace

double curvatureSum(const std::vector<CircularArc>& arcs, BiarcCurvature kind) {
  double sum = 0;
  for (const CircularArc& arc : arcs) {
    const double bend = std::abs(arc.turning);
    sum += kind == BiarcCurvature::energy ? bend * bend / arc.length
                                          : bend * bend * bend / (arc.length * arc.length);
  }
  return sum;
}

double curvatureOf(const std::vector<CircularArc>& arcs, BiarcCurvature kind) {
  const double sum = curvatureSum(arcs, kind);
  return kind == BiarcCurvature::energy ? sum : std::sqrt(sum);
}

BiarcRow curvatureGradient(const BiarcChain& chain, int biarc, BiarcCurvature kind) {
  ArcDerivatives d[2];
  chain.derivatives(biarc, d[0], d[1]);
  BiarcRow row = BiarcRow::Zero();
  for (int i = 0; i < 2; ++i) {
    const CircularArc& arc = chain.arcs()[std::size_t(2 * biarc + i)];
    const double k = arc.curvature();
    if (kind == BiarcCurvature::energy)
      row += 2 * k * d[i].turning - k * k * d[i].length;
    else
      row += 3 * k * std::abs(k) * d[i].turning - 2 * std::abs(k * k * k) * d[i].length;
  }
  return row;
}

BiarcMeasures measuresOf(const std::vector<CircularArc>& arcs, bool closed,
                         const std::vector<Eigen::Vector2d>& data) {
  BiarcMeasures m;
  const ArcTree tree(arcs, closed);
  detail::chargeWork(kFootWork * std::ssize(data));
  int seed = 0;
  for (std::size_t i = 0; i < data.size(); ++i) {
    const ArcFoot foot = tree.nearest(data[i], seed);
    seed = foot.arc;
    m.mean += foot.distance;
    m.rms += foot.distance * foot.distance;
    if (foot.distance > m.max) {
      m.max = foot.distance;
      m.farthest = int(i);
    }
  }
  m.mean /= double(data.size());
  m.rms = std::sqrt(m.rms / double(data.size()));
  m.energy = curvatureOf(arcs, BiarcCurvature::energy);
  m.angle = curvatureOf(arcs, BiarcCurvature::angle);
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    m.length += arcs[i].length;
    m.turning += std::abs(arcs[i].turning);
    if (i + 1 < arcs.size() || closed)
      m.largestJump =
          std::max(m.largestJump, std::abs(arcs[(i + 1) % arcs.size()].curvature() - arcs[i].curvature()));
  }
  return m;
}

ChainDistance::ChainDistance(const std::vector<Eigen::Vector2d>& data, bool closed)
    : samples_(std::min(4 * data.size(), kMostSamples)) {
  std::vector<CircularArc> edges;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < data.size(); ++i) {
    const Eigen::Vector2d edge = data[(i + 1) % data.size()] - data[i];
    const double length = edge.norm();
    if (length > 0) edges.push_back({data[i], std::atan2(edge.y(), edge.x()), 0, length});
  }
  empty_ = edges.empty();
  if (!empty_) tree_ = ArcTree(edges, closed);
  detail::chargeWork(kFootWork * std::ssize(edges));
}

double ChainDistance::of(const std::vector<CircularArc>& arcs) const {
  if (empty_) return 0;
  const int samples = std::max(16, int(samples_ / std::max<std::size_t>(1, arcs.size())));
  detail::chargeWork(kFootWork * (samples + 1) * std::ssize(arcs));
  double worst = 0;
  int seed = 0;
  for (const CircularArc& arc : arcs)
    for (int i = 0; i <= samples; ++i) {
      const ArcFoot foot = tree_.nearest(arc.pointAt(arc.length * i / samples), seed);
      seed = foot.arc;
      worst = std::max(worst, foot.distance);
    }
  return worst;
}

}  // namespace bw::biarc
