// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/row_between.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "sweep/held_blade.h"
#include "sweep/in_foam.h"
#include "sweep/smooth_way.h"

namespace bw::sweep {

namespace {

using Eigen::Vector2d;

constexpr int kPlaces = 33;  // of a section
constexpr int kSteps = 4;    // from a place of the blade to the one nearest to the section's
constexpr std::size_t kNear = 6;

/// The section at a place of the travel, after station i.
std::vector<Vector2d> sectionAt(const Sweep& row, const std::vector<std::vector<Vector2d>>& sections,
                                std::size_t i, double travel) {
  const std::size_t count = std::min(kNear, sections.size()),
                    first = std::min(i < kNear / 2 - 1 ? 0 : i + 1 - kNear / 2, sections.size() - count);
  std::vector<Vector2d> there(kPlaces, Vector2d::Zero());
  for (std::size_t a = first; a < first + count; ++a) {
    double share = 1;
    for (std::size_t b = first; b < first + count; ++b)
      if (b != a) share *= (travel - row.poses[b].travel) / (row.poses[a].travel - row.poses[b].travel);
    for (std::size_t k = 0; k < there.size(); ++k) there[k] += share * sections[a][k];
  }
  return there;
}

/// mm, of the place that is farthest from the blade of a pose, with its weight or without, as far as it
/// counts.
template <class AnyBlade>
double farthestFrom(const AnyBlade& blade, const BladePose& pose, const std::vector<Vector2d>& section,
                    const InFoam& foam) {
  std::vector<double> arcs = pose.cutArcs(kPlaces);
  std::vector<Elastica::State> states(kPlaces);
  for (int step = 0; step < kSteps; ++step) {
    blade.at(arcs, states);
    for (std::size_t k = 0; k < arcs.size(); ++k) {
      const Vector2d tangent(std::cos(states[k].angle), std::sin(states[k].angle));
      arcs[k] = std::clamp(arcs[k] + tangent.dot(section[k] - states[k].point), 0.0, blade.length());
    }
  }
  blade.at(arcs, states);
  double farthest = 0;
  for (std::size_t k = 0; k < arcs.size(); ++k)
    farthest = std::max(farthest,
                        foam.share(pose.frame.toWorld(section[k])) * (section[k] - states[k].point).norm());
  return farthest;
}

/// The same of the blade as it hangs there after station i, followed from this or else from the next:
/// infinite where it snaps on the way, or where it is not known.
double offAt(const Sweep& row, std::size_t i, const std::optional<BladePose>& pose,
             const std::vector<Vector2d>& section, const InFoam& foam) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  if (!pose) return kUnknown;
  // Pulled straight it has one shape, from which none is followed.
  if (isTaut(*pose)) return farthestFrom(pose->blade, *pose, section, foam);
  for (const std::size_t from : {i, i + 1}) {
    std::optional<HeavyBranch> branch = standing(row, row.poses[from]);
    if (!branch) continue;
    const Result<ClampedBranch::Move> move = branch->moveTo(heldAt(row, *pose));
    if (move) return move->snapped ? kUnknown : farthestFrom(branch->blade(), *pose, section, foam);
  }
  return kUnknown;
}

}  // namespace

Result<double> offBetween(const Sweep& row, const RunContext& context) {
  const std::size_t n = row.poses.size();
  if (n < 2) return 0.0;
  const SmoothWay smooth(row);
  const InFoam foam(row);
  std::vector<std::vector<Vector2d>> sections;
  for (const StationFit& fit : row.fits) sections.push_back(fit.target.sample(kPlaces));
  std::vector<double> off(n - 1, 0);
  const Result<void> ok = parallelFor(context, int(n - 1), [&](int k) {
    const std::size_t i = std::size_t(k);
    const double travel = 0.5 * (row.poses[i].travel + row.poses[i + 1].travel);
    off[i] = offAt(row, i, smooth.at(travel), sectionAt(row, sections, i, travel), foam);
  });
  if (!ok) return tl::unexpected<Error>(ok.error());
  if (context.stopped()) return stoppedError();
  return std::ranges::max(off);
}

}  // namespace bw::sweep
