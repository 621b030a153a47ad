// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/entry_exit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/sweep/lowest_place.h"
#include "bw/core/text/number_text.h"
#include "sweep/held_blade.h"

namespace bw {

namespace {

using Eigen::Vector2d;

constexpr double kTilt = fromDegrees(10);       // of each grip of the arc
constexpr double kAway = 20;                    // mm, of the plane from the block at least
constexpr double kSameShape = 0.1;              // mm: the way ends in the shape of the station
constexpr double kHeld = 1e-6;                  // of the length: how closely its middle tells a blade
constexpr double kRounded = 1e-3;               // of a margin
constexpr std::array kCounts = {4, 8, 16, 32};  // of moves

/// A weightless blade by its middle, besides where that lies.
struct Bend {
  double curvature = 0;               // 1/mm
  Vector2d force = Vector2d::Zero();  // in the plane, 1/mm²
};

/// One end of a row.
class End {
 public:
  End(const Sweep& sweep, const BladePose& pose, const EntryExitRequest& request)
      : sweep_(sweep),
        pose_(pose),
        length_(pose.blade.length()),
        middle_(pose.blade.at(0.5 * length_)),
        stiffness_(sweep.request.blade.flexuralRigidity()),
        least_(request.margin) {}

  /// The best of some ways from an arc to the pose.
  BladeWay plan() const;

 private:
  /// The blade that bends so about the pose's middle.
  Result<Elastica> bent(const Bend& bend) const {
    return sweep::aboutMiddle(middle_.point, middle_.angle, bend.curvature, bend.force, length_);
  }
  BladePose posed(const Elastica& blade) const {
    BladePose pose = pose_;
    pose.cut = pose.blade = blade;
    pose.before = 0;
    pose.heavy.reset();
    return pose;
  }
  /// The way in so many moves.
  BladeWay follow(const Bend& from, const Bend& to, int moves) const;

  const Sweep& sweep_;
  const BladePose& pose_;
  double length_;
  Elastica::State middle_;
  double stiffness_, least_;
};

BladeWay End::follow(const Bend& from, const Bend& to, int moves) const {
  BladeWay way;
  const auto lost = [&](std::string why) {
    way.poses.clear();
    way.why = std::move(why);
    return way;
  };
  std::optional<HeavyBranch> branch;
  for (int k = 0; k <= moves; ++k) {
    const double share = double(k) / moves;
    const Bend bend{std::lerp(from.curvature, to.curvature, share),
                    (1 - share) * from.force + share * to.force};
    const Result<Elastica> light = k == moves ? Result<Elastica>(pose_.blade) : bent(bend);
    if (!light) return lost(light.error().message);
    BladePose pose = posed(*light);
    if (sweep::isTaut(pose)) {  // there is one shape
      if (pose_.heavy && k == moves) pose.heavy = pose_.heavy;
      branch.reset();
      way.poses.push_back(std::move(pose));
      continue;
    }
    if (!branch) {
      const Result<Hanging> hanging = hang(*light, stiffness_, sweep::weightIn(sweep_, pose.frame));
      if (!hanging) return lost(hanging.error().message);
      if (hanging->snapsAt) return lost("its weight brings the blade out of its shape on the way");
      const Result<HeavyBranch> start = HeavyBranch::from(hanging->blade, stiffness_);
      if (!start) return lost(start.error().message);
      branch = *start;
    } else {
      const sweep::Move half(sweep_, way.poses.back(), pose);
      for (const HeavyProblem& next : {half.at(0.5).problem, sweep::heldAt(sweep_, pose)}) {
        const Result<ClampedBranch::Move> move = branch->moveTo(next);
        if (!move) return lost(move.error().message);
        if (move->snapped) return lost("the blade snaps into another shape on the way");
        way.margin = std::min(way.margin, marginsOf(branch->blade()).inPlane);
      }
    }
    if (!sweep_.request.weight.isZero()) pose.heavy = branch->blade();
    way.poses.push_back(std::move(pose));
  }
  if (branch && sweep::apart(pose_, branch->blade()) > kSameShape)
    return lost("the blade that is led there takes another shape than the one shown");
  return way;
}

BladeWay End::plan() const {
  Bend to{middle_.curvature, pose_.blade.force()};
  if (!sweep_.request.weight.isZero() && !pose_.heavy)
    return {{}, 1, "how the blade rests at the station is not known"};
  const Result<Elastica> told = bent(to);
  const auto off = [&](double s) { return (told->point(s) - pose_.blade.point(s)).norm(); };
  if (!told || std::max(off(0), off(length_)) > kHeld * length_) {
    if (!sweep::isTaut(pose_))
      return {{}, 1, "the blade is too taut at the station to be told by its middle"};
    to = {};
  }
  const double limit = sweep_.request.blade.maxCurvature();
  const double arc = std::min(2 * kTilt / length_, 0.5 * limit);
  // A blade that is let go out of the straight line sags where its weight pulls: an arc to the other side
  // would snap it through.
  const Vector2d up(-std::sin(middle_.angle), std::cos(middle_.angle));
  const double pull = -sweep::weightIn(sweep_, pose_.frame).dot(up);
  const double side = std::copysign(1.0, sweep::isTaut(pose_) && pull != 0 ? pull : to.curvature);
  // What the station itself keeps, no way to it can exceed.
  const double own = sweep::isTaut(pose_) ? 1
                     : pose_.heavy        ? marginsOf(*pose_.heavy).inPlane
                                          : stabilityMargin(pose_.blade);
  const double asked = std::min(least_, own - kRounded);
  BladeWay best;
  for (const int moves : kCounts)
    for (const double sense : {side, -side}) {
      BladeWay way = follow({sense * arc, Vector2d::Zero()}, to, moves);
      const bool found = !way.poses.empty();
      if (found && way.margin >= asked) return way;
      if (best.poses.empty() ? found || best.why.empty() : found && way.margin > best.margin)
        best = std::move(way);
    }
  if (best.poses.empty()) return best;
  return {{},
          best.margin,
          "on the best of them the stability margin falls to " + shortText(best.margin, 2) + ", below " +
              shortText(asked, 2)};
}

/// Moves the poses of a way, from the arc to that of the station, up in their planes, so that none comes
/// lower than the floor, or than the last one where that is lower already: the arc by most, and each next one
/// evenly by less. An upright move changes no shape.
void raise(const Sweep& sweep, double floor, std::vector<BladePose>& way) {
  if (way.size() < 2) return;
  constexpr double kLying = 0.1;  // of 1: planes that lie so flat are not raised in
  const Eigen::Vector3d &up = sweep.block.frame.normal, &d = way.front().frame.normal;
  const Eigen::Vector3d upright = up - up.dot(d) * d;
  if (upright.norm() < kLying) return;
  const double least = std::min(floor, lowestPlace(sweep.block, way.back()).height);
  const auto last = double(way.size() - 1);
  double rise = 0;  // mm, of the arc
  for (std::size_t k = 0; k + 1 < way.size(); ++k)
    rise = std::max(rise, (least - lowestPlace(sweep.block, way[k]).height) / (1 - double(k) / last));
  // The way along the planes for a mm of height.
  const Eigen::Vector3d move = rise / upright.squaredNorm() * upright;
  for (std::size_t k = 0; k + 1 < way.size(); ++k) way[k].frame.origin += (1 - double(k) / last) * move;
}

}  // namespace

Result<EntryExit> planEntryExit(const Sweep& sweep, const EntryExitRequest& request,
                                const RunContext& context) {
  EntryExit plan;
  if (sweep.poses.empty()) return plan;
  const double away = std::max(request.lead, kAway);
  const auto end = [&](int i) {
    const bool entry = i == 0;
    const BladePose& pose = entry ? sweep.poses.front() : sweep.poses.back();
    BladeWay way = End(sweep, pose, request).plan();
    // Out of the block across the plane of the station.
    const Eigen::Vector3d& ahead = pose.frame.normal;
    double shift = 0;
    for (const Eigen::Vector3d& corner : sweep.block.corners()) {
      const double place = ahead.dot(corner - pose.frame.origin);
      shift = entry ? std::min(shift, place) : std::max(shift, place);
    }
    shift += entry ? -away : away;
    for (BladePose& at : way.poses) {
      at.index = -1;
      at.travel = pose.travel + shift;
      at.frame.origin += shift * ahead;
    }
    if (request.floor) raise(sweep, *request.floor, way.poses);
    if (!entry) std::ranges::reverse(way.poses);
    (entry ? plan.entry : plan.exit) = std::move(way);
  };
  if (Result<void> ok = parallelFor(context, 2, end); !ok) return tl::unexpected<Error>(ok.error());
  if (context.stopped()) return stoppedError();
  for (const bool entry : {true, false}) {
    const BladeWay& way = entry ? plan.entry : plan.exit;
    if (!way.poses.empty()) continue;
    const int index = (entry ? sweep.poses.front() : sweep.poses.back()).index;
    plan.findings.push_back({Severity::error, NoWay{entry, way.why}, {StationRange::of(index), {}}, {}});
  }
  return plan;
}

}  // namespace bw
