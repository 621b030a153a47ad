// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/simulation/simulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <memory>
#include <optional>
#include <utility>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/text/number_text.h"
#include "simulation/run_speeds.h"
#include "sweep/sweep_findings.h"

namespace bw {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kBetween = 4;           // moves from instant to instant
constexpr double kTaut = 0.05;        // mm that a blade may sag by its slack
constexpr double kHardlySlack = 0.5;  // mm: so close to the straight line that it counts as it, if need be
constexpr double kStretch = 1e-3;     // mm, rounding of written positions, beyond what a blade is pulled by
constexpr double kOffPlane = 0.5;     // mm, of an end,
constexpr double kTilted = fromDegrees(0.5);

/// What is done as long as nothing halts it.
template <class T>
using Step = tl::expected<T, Halt>;

/// How the grips hold the blade at a moment.
struct Hold {
  Frame frame;  ///< of its plane, in the block's frame
  HeavyProblem problem;
};

class Runner {
 public:
  Runner(const Motion& motion, const Blade& blade, const Vector3d& weight)
      : motion_(motion), length_(motion.bladeLength > 0 ? motion.bladeLength : blade.length) {
    const Frame& f = motion.block.frame;
    weight_ = {weight.dot(f.x), weight.dot(f.y), weight.dot(f.normal)};
    stiffness_ = blade.flexuralRigidity();
    round_ = blade.section != Blade::Section::flat;
  }

  Result<Simulation> run(const RunContext& context);

 private:
  /// Of an end: straight from instant to instant, turning evenly, but for parabolas at corners with zones.
  Pose poseAt(std::size_t end, std::size_t instant, double share) const;
  Step<Hold> holdAt(std::size_t instant, double share);
  Step<void> begin(const Hold& hold);
  Step<void> go(const Hold& hold, double time, std::size_t instant);
  Step<void> note(const Hold& hold, double time, std::size_t instant, bool atInstant);
  /// How firmly the blade rests at a moment, and how tightly it bends.
  void look(std::size_t k);
  /// All of them, but those that were looked at on the way.
  Result<void> judge(const RunContext& context, std::size_t from);
  /// What comes of the blade at a moment.
  Step<void> moment(std::size_t instant, double share, bool atInstant);
  Vector3d toFile(const Vector3d& inBlock) const {
    const Frame& f = motion_.block.frame;
    return inBlock.x() * f.x + inBlock.y() * f.y + inBlock.z() * f.normal;
  }
  double timeAt(std::size_t instant, double share) const {
    const double now = motion_.instants[instant].time;
    return share > 0 ? std::lerp(now, motion_.instants[instant + 1].time, share) : now;
  }
  /// `moment` tells when and where.
  static tl::unexpected<Halt> lost(const std::string& reason) {
    Halt halt;
    halt.reason = reason;
    return tl::unexpected<Halt>(std::move(halt));
  }
  /// mm that the blade may sag by its slack.
  static double slack(const HeavyProblem& problem) {
    return largestSag(problem.grips.length, (problem.grips.end - problem.grips.start).norm());
  }
  static bool taut(const HeavyProblem& problem) { return slack(problem) < kTaut; }

  const Motion& motion_;
  double length_, stiffness_ = 1;
  bool round_ = false;
  Vector3d weight_;                 ///< in the block's frame
  std::optional<Vector3d> across_;  ///< the direction in the plane that the angles are told from
  Vector3d home_ = Vector3d::Zero();
  double startAngle_ = 0, turning_ = 0;
  std::optional<HeavyBranch> branch_;  ///< none while the blade is straight
  std::vector<char> bent_;             ///< of each moment, whether there was one
  std::vector<double> curvatures_;     ///< of each that was looked at
  Simulation result_;
};

Pose Runner::poseAt(std::size_t end, std::size_t instant, double share) const {
  const auto cornerAt = [&](std::size_t i, double since) -> std::optional<Pose> {
    if (i == 0 || i + 1 >= motion_.instants.size()) return {};
    const double zone =
        motion_.instants[i].zone.value_or(plannedZone(motion_.instants, i, motion_.cornersWithin));
    const MotionInstant &before = motion_.instants[i - 1], &at = motion_.instants[i],
                        &after = motion_.instants[i + 1];
    const double in = at.time - before.time, out = after.time - at.time;
    const Pose &a = before.poses[end], &b = at.poses[end], &c = after.poses[end];
    const Vector3d arriving = (b.position - a.position) / in, leaving = (c.position - b.position) / out;
    // As long before as after it, for both ends at once, and half of the shorter move at most: a controller
    // shrinks larger zones.
    double fastest = 0;
    for (std::size_t e = 0; e < at.poses.size(); ++e)
      fastest = std::max({fastest, (at.poses[e].position - before.poses[e].position).norm() / in,
                          (after.poses[e].position - at.poses[e].position).norm() / out});
    const double half = std::min(0.5 * std::min(in, out), fastest > 0 ? zone / fastest : zone);
    if (!(half > 0) || std::abs(since) >= half) return {};
    // The speed goes evenly from the one to the other.
    const double arrives = -(since - half) * (since - half) / (4 * half),
                 leaves = (since + half) * (since + half) / (4 * half);
    const auto turning = [](const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) -> Vector3d {
      const Eigen::AngleAxisd turn(to * from.conjugate());
      return std::remainder(turn.angle(), 2 * kPi) * turn.axis();
    };
    const Vector3d turned =
        arrives / in * turning(a.rotation, b.rotation) + leaves / out * turning(b.rotation, c.rotation);
    Pose pose{b.position + arrives * arriving + leaves * leaving, b.rotation};
    if (turned.norm() > 0)
      pose.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(turned.norm(), turned.normalized())) * b.rotation;
    return pose;
  };
  if (const std::optional<Pose> corner = cornerAt(instant, timeAt(instant, share) - timeAt(instant, 0)))
    return *corner;
  const Pose& a = motion_.instants[instant].poses[end];
  if (share <= 0) return a;
  if (const std::optional<Pose> corner =
          cornerAt(instant + 1, timeAt(instant, share) - timeAt(instant + 1, 0)))
    return *corner;
  const Pose& b = motion_.instants[instant + 1].poses[end];
  return {a.position + share * (b.position - a.position), a.rotation.slerp(share, b.rotation)};
}

Step<Hold> Runner::holdAt(std::size_t instant, double share) {
  const Pose left = poseAt(0, instant, share), right = poseAt(1, instant, share);
  const Vector3d zl = left.rotation * Vector3d::UnitZ(), zr = right.rotation * Vector3d::UnitZ();
  const Vector3d normal = (zl + zr).normalized();
  const Vector3d chord = right.position - left.position;
  Halt halt{Halt::Why::tears, timeAt(instant, share), instant};
  halt.place = motion_.block.frame.origin + toFile(0.5 * (left.position + right.position));
  halt.apart = chord.norm();
  halt.off = std::abs(chord.dot(normal));
  halt.twist = std::acos(std::clamp(zl.dot(zr), -1.0, 1.0));
  if (halt.apart > length_ + mostPull(length_) + kStretch) return tl::unexpected<Halt>(halt);
  halt.why = Halt::Why::offPlane;
  if (!(halt.off <= kOffPlane) || !(halt.twist <= kTilted)) return tl::unexpected<Halt>(halt);
  if (!across_) {
    across_ = chord.norm() > 0 ? chord : left.rotation * Vector3d::UnitX();
    home_ = left.position;
  }
  Hold hold;
  hold.frame.normal = normal;
  hold.frame.x = (*across_ - across_->dot(normal) * normal).normalized();
  hold.frame.y = normal.cross(hold.frame.x);
  hold.frame.origin = home_ + (left.position - home_).dot(normal) * normal;
  const auto flat = [&](const Vector3d& v) { return Vector2d(v.dot(hold.frame.x), v.dot(hold.frame.y)); };
  const auto angle = [&](const Vector3d& v) {
    const Vector2d p = flat(v);
    return std::atan2(p.y(), p.x());
  };
  ClampedProblem& grips = hold.problem.grips;
  grips.start = flat(left.position - hold.frame.origin);
  grips.end = flat(right.position - hold.frame.origin);
  const double start = angle(left.rotation * Vector3d::UnitX()),
               end = angle(-(right.rotation * Vector3d::UnitX()));
  // Without whole turns from one moment to the next.
  startAngle_ += std::remainder(start - startAngle_, 2 * kPi);
  turning_ += std::remainder(end - startAngle_ - turning_, 2 * kPi);
  grips.startAngle = startAngle_;
  grips.endAngle = startAngle_ + turning_;
  grips.turning = turning_;
  grips.length = length_;
  hold.problem.stiffness = stiffness_;
  hold.problem.weight = flat(weight_);
  return hold;
}

Step<void> Runner::begin(const Hold& hold) {
  branch_.reset();
  if (taut(hold.problem)) return {};
  const Result<HeavyAnswer> all = solveAllHeavy(hold.problem);
  if (!all) return lost(all.error().message);
  const HeavySolution* lowest = nullptr;
  for (const HeavySolution& solution : all->solutions) {
    if (!solution.stable) continue;
    if (!lowest) {
      lowest = &solution;
      const Result<HeavyBranch> branch = HeavyBranch::from(hold.problem, solution);
      if (!branch) return lost(branch.error().message);
      branch_ = *branch;
    } else if (solution.energy - lowest->energy <= stiffness_ * lowest->blade.clearGap()) {
      result_.decided = result_.decided && !result_.blades.empty();
    }
  }
  if (!lowest) return lost("No shape at rest was found.");
  return {};
}

Step<void> Runner::go(const Hold& hold, double time, std::size_t instant) {
  if (taut(hold.problem)) {
    branch_.reset();
    return {};
  }
  // All but straight, and rounded as it is written, it may not be found.
  const auto anew = [&]() -> Step<void> {
    const Step<void> found = begin(hold);
    if (found || slack(hold.problem) > kHardlySlack) return found;
    branch_.reset();
    result_.straightWithin = std::max(result_.straightWithin, slack(hold.problem));
    return {};
  };
  if (!branch_) return anew();
  const Result<ClampedBranch::Move> move = branch_->moveTo(hold.problem);
  if (!move && slack(hold.problem) <= kHardlySlack) return anew();
  if (!move) return lost(move.error().message);
  if (!move->snapped) return {};
  result_.snaps.push_back({time, instant});
  return begin(hold);
}

Step<void> Runner::note(const Hold& hold, double time, std::size_t instant, bool atInstant) {
  Frame frame;
  frame.origin = motion_.block.frame.origin + toFile(hold.frame.origin);
  frame.x = toFile(hold.frame.x);
  frame.y = toFile(hold.frame.y);
  frame.normal = toFile(hold.frame.normal);
  const ClampedProblem& grips = hold.problem.grips;
  std::optional<HeavyBlade> blade;
  if (branch_) {
    blade = branch_->blade();
  } else {
    const Vector2d chord = grips.end - grips.start;
    const Result<Elastica> straight =
        Elastica::make(grips.start, std::atan2(chord.y(), chord.x()), 0, Vector2d::Zero(), length_);
    const Result<Hanging> held = straight ? hang(*straight, stiffness_, Vector2d::Zero())
                                          : Result<Hanging>(tl::unexpected<Error>(straight.error()));
    if (!held) return lost(held.error().message);
    blade = held->blade;
  }
  SimulatedBlade now{time, instant, frame, *blade};
  now.atInstant = atInstant;
  bent_.push_back(branch_.has_value());
  result_.blades.push_back(std::move(now));
  return {};
}

void Runner::look(std::size_t k) {
  SimulatedBlade& at = result_.blades[k];
  curvatures_[k] = at.blade.maxCurvature();
  if (!bent_[k]) return;
  const HeavyMargins margins = marginsOf(at.blade);
  at.margin = margins.inPlane;
  if (round_) at.outOfPlaneMargin = margins.outOfPlane;
  at.crossesItself = at.blade.selfIntersects();
}

Result<void> Runner::judge(const RunContext& context, std::size_t from) {
  const Result<void> ok =
      parallelFor(context, int(result_.blades.size() - from), [&](int k) { look(from + std::size_t(k)); });
  if (!ok) return ok;
  double tightest = 0;
  for (std::size_t i = 0; i < result_.blades.size(); ++i) {
    result_.marginMin = std::min(result_.marginMin, result_.blades[i].margin);
    tightest = std::max(tightest, curvatures_[i]);
  }
  if (tightest > 0) result_.minRadius = 1 / tightest;
  return {};
}

Step<void> Runner::moment(std::size_t instant, double share, bool atInstant) {
  const Step<Hold> hold = holdAt(instant, share);
  if (!hold) return tl::unexpected<Halt>(hold.error());
  const double time = timeAt(instant, share);
  Step<void> ok = result_.blades.empty() ? begin(*hold) : go(*hold, time, instant);
  if (ok) ok = note(*hold, time, instant, atInstant);
  if (ok) return ok;
  Halt& halt = ok.error();
  const ClampedProblem& grips = hold->problem.grips;
  halt.time = time;
  halt.instant = instant;
  halt.place = motion_.block.frame.origin + toFile(hold->frame.toWorld(0.5 * (grips.start + grips.end)));
  halt.apart = (grips.end - grips.start).norm();
  return ok;
}

std::optional<RunSpeeds> speedsOf(const Simulation& simulation) {
  std::optional<RunSpeeds> speeds;
  const SurfaceGrid grid = simulation.swept();
  for (int r = 1; r < grid.rows; ++r) {
    const SimulatedBlade& now = simulation.blades[std::size_t(r)];
    const double seconds = now.time - simulation.blades[std::size_t(r) - 1].time;
    if (!(seconds > 0)) continue;
    for (int c = 0; c < grid.columns; ++c) {
      const double speed = (grid.at(r, c) - grid.at(r - 1, c)).norm() / seconds;
      see(speeds, speed, {grid.at(r, c), now.time, now.instant});
    }
  }
  return speeds;
}

Result<Simulation> Runner::run(const RunContext& context) {
  const std::size_t n = motion_.instants.size(), most = kBetween * n;
  // What is looked at on the way stays where it is.
  result_.blades.reserve(most);
  bent_.reserve(most);
  curvatures_.resize(most);
  constexpr std::size_t kTogether = 32;  // moments that are worth a thread
  std::size_t seen = 0;
  std::future<void> looks;
  for (std::size_t i = 0; i < n && !result_.halt; ++i)
    for (int k = i == 0 ? kBetween : 1; k <= kBetween && !result_.halt; ++k) {
      if (context.stopped()) return stoppedError();
      // Up to instant i, from the one before.
      const std::size_t from = i == 0 || k == kBetween ? i : i - 1;
      const Step<void> ok = moment(from, from == i ? 0 : double(k) / kBetween, from == i);
      if (!ok) result_.halt = ok.error();
      const std::size_t now = result_.blades.size();
      if (context.threads == 1 || now < seen + kTogether) continue;
      if (looks.valid() && looks.wait_for(std::chrono::seconds(0)) != std::future_status::ready) continue;
      looks = std::async(std::launch::async, [this, seen, now] {
        for (std::size_t at = seen; at < now; ++at) look(at);
      });
      seen = now;
    }
  if (looks.valid()) looks.get();
  if (const Result<void> ok = judge(context, seen); !ok) return tl::unexpected<Error>(ok.error());
  result_.speeds = speedsOf(result_);
  return std::move(result_);
}

}  // namespace

const char* haltName(Halt::Why why) {
  switch (why) {
    case Halt::Why::tears:
      return "tears";
    case Halt::Why::offPlane:
      return "off-plane";
    case Halt::Why::lost:
      break;
  }
  return "lost";
}

SurfaceGrid Simulation::swept(int places) const {
  SurfaceGrid grid;
  grid.rows = int(blades.size());
  grid.columns = places;
  for (const SimulatedBlade& at : blades)
    for (const Elastica::State& state : at.blade.sample(places))
      grid.points.push_back(at.frame.toWorld(state.point));
  return grid;
}

namespace {

/// The stretches of moments of which `bad` holds; the worst is that of the largest `rank`.
template <class Bad, class Rank>
std::vector<RunStretch> stretches(const std::vector<SimulatedBlade>& blades, Bad bad, Rank rank) {
  std::vector<RunStretch> found;
  for (const sweep::Stretch& at : sweep::stretchesOf(
           blades.size(), [&](std::size_t i) { return bad(blades[i]); },
           [&](std::size_t a, std::size_t b) { return rank(blades[a]) > rank(blades[b]); }))
    found.push_back({at.first, at.last, at.worst});
  return found;
}

}  // namespace

std::vector<RunStretch> Simulation::crossings() const {
  return stretches(
      blades, [](const SimulatedBlade& at) { return at.crossesItself; },
      [](const SimulatedBlade& at) { return at.blade.maxCurvature(); });
}

std::vector<RunStretch> Simulation::twists() const {
  return stretches(
      blades, [](const SimulatedBlade& at) { return at.outOfPlaneMargin <= 0; },
      [](const SimulatedBlade& at) { return -at.outOfPlaneMargin; });
}

std::vector<RunStretch> Simulation::loose(double margin) const {
  return stretches(
      blades, [margin](const SimulatedBlade& at) { return at.margin < margin; },
      [](const SimulatedBlade& at) { return -at.margin; });
}

Result<Simulation> simulate(const Motion& motion, const Blade& blade, const Vector3d& weight,
                            const RunContext& context) {
  if (motion.instants.size() < 2 ||
      !std::ranges::all_of(motion.instants, [](const MotionInstant& at) { return at.poses.size() == 2; }))
    return fail(ErrorCode::badInput, "a motion that is run needs two instants or more, each of two ends",
                "motion", double(motion.instants.size()), 2.0);
  return Runner(motion, blade, weight).run(context);
}

}  // namespace bw
