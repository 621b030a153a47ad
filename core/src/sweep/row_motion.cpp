// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/row_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "sweep/held_blade.h"
#include "sweep/remedies.h"
#include "sweep/surface_rows.h"
#include "sweep/sweep_findings.h"

namespace bw {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kBetween = 4;         // moves from station to station
constexpr int kPlaces = 25;         // on the part that cuts
constexpr double kWorse = 1.1;      // than the surface shown: a deviation of its own
constexpr double kTaut = 0.05;      // mm that a blade may sag by its slack
constexpr double kSameShape = 0.1;  // mm: a blade arrives in the shape of its station

/// The blade of a row on its way, told in the plane of the first station's axes.
class Walk {
 public:
  explicit Walk(const Sweep& row) : row_(row) {
    const Frame& frame = row.poses.front().frame;
    weight_ = sweep::weightIn(row, frame);
  }

  /// The blade at rest at a station, as the row has it. False where it is not known.
  bool stand(std::size_t i) {
    branch_.reset();
    const double stiffness = row_.request.blade.flexuralRigidity();
    std::optional<HeavyBlade> blade = row_.poses[i].heavy;
    if (!blade && weight_.isZero()) {
      const Result<Hanging> hanging = hang(row_.poses[i].blade, stiffness, weight_);
      if (hanging && !hanging->snapsAt) blade = hanging->blade;
    }
    if (!blade) return false;
    if (const Result<HeavyBranch> branch = HeavyBranch::from(*blade, stiffness)) branch_ = *branch;
    return branch_.has_value();
  }

  /// Moves the grips to a share of the way from station i to the next one.
  Result<ClampedBranch::Move> go(std::size_t i, double share) {
    const HeavyProblem a = sweep::heldAt(row_, row_.poses[i]), b = sweep::heldAt(row_, row_.poses[i + 1]);
    HeavyProblem there = a;
    there.grips.start += share * (b.grips.start - a.grips.start);
    there.grips.end += share * (b.grips.end - a.grips.end);
    *there.grips.startAngle += share * std::remainder(*b.grips.startAngle - *a.grips.startAngle, 2 * kPi);
    *there.grips.endAngle += share * std::remainder(*b.grips.endAngle - *a.grips.endAngle, 2 * kPi);
    return branch_->moveTo(there);
  }

  /// Where the part that cuts is then, in space.
  std::vector<Vector3d> cut(std::size_t i, double share) const {
    const BladePose &a = row_.poses[i], &b = row_.poses[i + 1];
    const auto blend = [&](double x, double y) { return x + share * (y - x); };
    const double from = blend(a.before, b.before), length = blend(a.cut.length(), b.cut.length());
    std::vector<double> arcs(kPlaces);
    for (int k = 0; k < kPlaces; ++k) arcs[std::size_t(k)] = from + length * k / (kPlaces - 1);
    std::vector<Elastica::State> states(kPlaces);
    branch_->blade().at(arcs, states);
    const Vector3d travelled = share * (b.frame.origin - a.frame.origin);
    std::vector<Vector3d> places;
    for (const Elastica::State& state : states) places.push_back(a.frame.toWorld(state.point) + travelled);
    return places;
  }

 private:
  const Sweep& row_;
  Vector2d weight_;
  std::optional<HeavyBranch> branch_;
};

/// A blade that its grips hold straight but for kTaut: there is no other shape, and none to be followed.
bool taut(const BladePose& pose) {
  return largestSag(pose.blade.length(), (pose.rightPoint() - pose.leftPoint()).norm()) < kTaut;
}

/// Stretches of a row between whose stations the same happened.
template <class Happened>
void tell(const Sweep& row, const std::vector<char>& marks, Severity severity, Happened cause,
          Findings& findings) {
  for (const sweep::Stretch& at : sweep::stretchesOf(
           marks.size(), [&](std::size_t i) { return marks[i] != 0; },
           [](std::size_t, std::size_t) { return false; }))
    findings.push_back({severity, cause, sweep::placeOf(row.poses, at), {}});
}

}  // namespace

Result<RowMotion> followRow(const Sweep& row, const SweepAnalysis& analysis, const CheckRequest& request,
                            const SurfaceSampler& target, const RunContext& context) {
  RowMotion motion;
  const std::unique_ptr<SurfaceSampler> sampler = target.clone();
  const sweep::SurfaceRows shown(analysis.cut, row.planes);
  const std::size_t n = row.poses.size();
  std::vector<char> snaps(n, 0), others(n, 0), lost(n, 0);
  std::string why;
  double sum = 0;
  std::size_t count = 0;
  std::vector<std::optional<SurfaceSampler::Foot>> feet(kPlaces);
  const auto see = [&](const std::vector<Vector3d>& places) -> Result<void> {
    for (std::size_t c = 0; c < places.size(); ++c) {
      Result<SurfaceSampler::Foot> foot = sampler->closest(places[c], feet[c] ? &*feet[c] : nullptr);
      if (!foot) return tl::unexpected<Error>(foot.error());
      feet[c] = *foot;
      sum += foot->distance;
      ++count;
      if (foot->distance > motion.deviationMax) {
        motion.deviationMax = foot->distance;
        motion.worst = places[c];
      }
      motion.fromShown = std::max(motion.fromShown, shown.look(places[c]).distance);
    }
    return {};
  };
  Walk walk(row);
  // A blade that is all but straight at a station may be followed from the next one alone: back to place k.
  const auto back = [&](std::size_t i, int k) -> Result<bool> {
    if (!walk.stand(i + 1)) return false;
    for (int j = kBetween - 1; j >= k; --j) {
      const double share = double(j) / kBetween;
      const Result<ClampedBranch::Move> move = walk.go(i, share);
      if (!move || move->snapped) return false;
      if (Result<void> ok = see(walk.cut(i, share)); !ok) return tl::unexpected<Error>(ok.error());
    }
    return walk.stand(i + 1);
  };
  bool standing = walk.stand(0);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (context.stopped()) return stoppedError();
    if (taut(row.poses[i]) && taut(row.poses[i + 1])) {
      // Straight throughout: its points go evenly, as its ends do.
      standing = false;
      const std::vector<Vector3d> a = row.poses[i].cutPoints(kPlaces),
                                  b = row.poses[i + 1].cutPoints(kPlaces);
      for (int k = 1; k < kBetween; ++k) {
        std::vector<Vector3d> places;
        for (std::size_t c = 0; c < a.size(); ++c)
          places.push_back(a[c] + double(k) / kBetween * (b[c] - a[c]));
        if (Result<void> ok = see(places); !ok) return tl::unexpected<Error>(ok.error());
      }
      continue;
    }
    if (!standing) standing = walk.stand(i);
    if (!standing) continue;  // what is wrong with the station itself is told of it
    for (int k = 1; k <= kBetween && standing; ++k) {
      const double share = double(k) / kBetween;
      const Result<ClampedBranch::Move> move = walk.go(i, share);
      standing = move && !move->snapped;
      if (!move) {
        const Result<bool> met = back(i, k);
        if (!met) return tl::unexpected<Error>(met.error());
        standing = *met;
        if (standing) break;
        lost[i] = 1;
        why = move.error().message;
      }
      if (move && move->snapped) snaps[i] = 1;
      if (!standing) break;
      const std::vector<Vector3d> places = walk.cut(i, share);
      if (k == kBetween) {
        // Where it arrives, the row has its own shape, which has been looked at.
        const std::vector<Vector3d> own = row.poses[i + 1].cutPoints(kPlaces);
        double apart = 0;
        for (std::size_t c = 0; c < own.size(); ++c) apart = std::max(apart, (own[c] - places[c]).norm());
        others[i + 1] = apart > kSameShape;
        standing = apart <= kSameShape;
        break;
      }
      if (Result<void> ok = see(places); !ok) return tl::unexpected<Error>(ok.error());
    }
  }
  if (count > 0) motion.deviationMean = sum / double(count);
  motion.snaps = int(std::ranges::count(snaps, 1));
  tell(row, snaps, Severity::warning, SnapsOnTheWay{}, motion.findings);
  tell(row, others, Severity::warning, ArrivesOtherwise{}, motion.findings);
  tell(row, lost, Severity::warning, LostOnTheWay{why}, motion.findings);
  // Where the surface shown misses the tolerance as well, that is told of it.
  const double skin = analysis.summary.deviationMax;
  if (motion.deviationMax > request.tolerance &&
      (skin <= request.tolerance || motion.deviationMax > kWorse * skin))
    motion.findings.push_back({Severity::warning,
                               TooFarOnTheWay{motion.deviationMax, request.tolerance},
                               {{}, motion.worst},
                               sweep::twiceAsMany(row, request.clearance)});
  return motion;
}

}  // namespace bw
