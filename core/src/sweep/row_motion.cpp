// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/row_motion.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/motion/motion.h"
#include "sweep/held_blade.h"
#include "sweep/in_foam.h"
#include "sweep/peaks.h"
#include "sweep/remedies.h"
#include "sweep/smooth_way.h"
#include "sweep/surface_rows.h"
#include "sweep/sweep_findings.h"

namespace bw {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kPlaces = 25;         // on the part that cuts
constexpr double kWorse = 1.1;      // than the surface shown: a deviation of its own
constexpr double kSameShape = 0.1;  // mm: a blade arrives in the shape of its station
constexpr int kMostMoves = 40;      // from station to station
constexpr double kRoom = 1.15;      // in how far the way is off for each number of moves
constexpr double kOfChords = 0.6;   // of the tolerance: the rest is left to the surface between the targets
constexpr double kEdge = 0.01;      // mm beyond the end of a row of the surface shown: rounding
constexpr double kLongest = 1;      // s of a move past stations: whoever steps through a program sees the row

/// The way of the blade from one station to another.
struct Way {
  enum class End { arrives, unknown, snaps, otherwise, lost } end = End::unknown;
  std::string why = {};
  std::vector<BladePose> targets = {};             ///< between the two
  std::vector<std::vector<Vector3d>> places = {};  ///< of the part that cuts, on the way
  double off = 0;                                  ///< mm, the farthest of them from the smooth way
  double slack = 0;                                ///< mm that a straight blade has, at most
};

/// Into how many parts the way from each station to the next is cut for the surface to follow it: where the
/// ends of the part that cuts run along it in a corner, as at the corner of a block, a smooth skin through
/// the stations alone swings out there and folds.
std::vector<int> skinParts(const Sweep& row) {
  constexpr double kCarriedOn = 0.27;  // of a swing: what cubics make of it in the next interval
  constexpr double kCutOff = 0.2;      // of curvature times the square of the swing: how far it lies off then
  constexpr double kFlattest = 1e-4;   // 1/mm: surfaces bend along the travel, too
  const std::size_t n = row.poses.size();
  std::vector<int> parts(n, 1);
  if (n < 3) return parts;
  std::vector<double> swing(n, 0);
  std::vector<std::vector<Vector3d>> ends;
  for (const BladePose& pose : row.poses) ends.push_back(pose.cutPoints(2));
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = row.poses[i].travel - row.poses[i - 1].travel,
                 after = row.poses[i + 1].travel - row.poses[i].travel;
    const Vector3d along = (ends[i][1] - ends[i][0]).normalized();
    for (std::size_t e = 0; e < 2; ++e) {
      const Vector3d turn = (ends[i + 1][e] - ends[i][e]) / after - (ends[i][e] - ends[i - 1][e]) / before;
      swing[i] = std::max(swing[i], std::abs(turn.dot(along)) * std::max(before, after));
    }
  }
  for (std::size_t i = 1; i < n; ++i) swing[i] = std::max(swing[i], kCarriedOn * swing[i - 1]);
  for (std::size_t i = n - 1; i-- > 0;) swing[i] = std::max(swing[i], kCarriedOn * swing[i + 1]);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double bend = kFlattest + std::max(row.poses[i].maxCurvature(), row.poses[i + 1].maxCurvature());
    const double asked = std::max(swing[i], swing[i + 1]) * std::sqrt(kCutOff * bend / kSkinTolerance);
    parts[i] = std::clamp(int(std::ceil(asked)), 1, kMostMoves);
  }
  return parts;
}

/// Follows the blade of a row from station to station as robots move its grips.
class Follower {
 public:
  explicit Follower(const Sweep& row) : row_(row), between_(row) {}

  /// To the next station, in so many moves as keep it within that of the smooth way, or nearest to it.
  Way from(std::size_t i, double tolerance) const {
    Way best = follow(i, i + 1, 1);
    if (best.end == Way::End::unknown) return best;
    int moves = 1;
    for (int trial = 0; trial < 3; ++trial) {
      if (keeps(best, tolerance)) break;
      const int asked =
          best.end == Way::End::arrives ? int(std::ceil(moves * partsFor(best, tolerance))) : 4 * moves;
      moves = std::min(std::max(asked, moves + 1), kMostMoves);
      Way finer = follow(i, i + 1, moves);
      const bool better =
          finer.end == Way::End::arrives &&
          (best.end != Way::End::arrives || partsFor(finer, tolerance) < partsFor(best, tolerance));
      if (better) best = std::move(finer);
      if (!better || moves == kMostMoves) break;
    }
    return best;
  }

  /// To the next station, in so many moves.
  Way inMoves(std::size_t i, int moves) const { return follow(i, i + 1, moves); }

  /// True for a way that arrives and keeps within the tolerance; a straight blade stays so if it is pulled.
  bool keeps(const Way& way, double tolerance) const {
    return way.end == Way::End::arrives && way.off <= tolerance && way.slack <= mostPull(length());
  }

  /// In how many parts a way is to go to do so: off and slack go with the square of its length.
  double partsFor(const Way& way, double tolerance) const {
    return std::sqrt(kRoom * std::max(way.off / tolerance, way.slack / mostPull(length())));
  }

  /// From station i to j in one move, past those between.
  Way past(std::size_t i, std::size_t j) const {
    const bool taut = sweep::isTaut(row_.poses[i]);
    for (std::size_t k = i + 1; k <= j; ++k)
      if (sweep::isTaut(row_.poses[k]) != taut) return {};
    return follow(i, j, 1);
  }

  /// The station before places of the blade on the way.
  std::size_t before(const std::vector<Vector3d>& places) const { return between_.before(travelOf(places)); }

 private:
  double length() const { return row_.request.blade.length; }

  double travelOf(const std::vector<Vector3d>& places) const {
    const BladePose& first = row_.poses.front();
    return first.travel + row_.planes.level(places[places.size() / 2]) -
           row_.planes.level(first.frame.origin);
  }

  Way follow(std::size_t start, std::size_t end, int moves) const {
    Way way;
    std::vector<BladePose> poses = {row_.poses[start]};
    for (int k = 1; k < moves; ++k) {
      const std::optional<BladePose> pose =
          between_.at(std::lerp(row_.poses[start].travel, row_.poses[end].travel, double(k) / moves));
      if (!pose) return way;
      poses.push_back(*pose);
    }
    poses.push_back(row_.poses[end]);
    const int looks = moves > 1 ? 2 : std::max(4, 2 * int(end - start));  // at the way of each move
    if (sweep::isTaut(poses.front()) && sweep::isTaut(poses.back())) {
      // Straight throughout: its points go evenly, as its ends do. Where it turns on the way, these come
      // nearer to each other meanwhile.
      for (std::size_t j = 0; j + 1 < poses.size(); ++j) {
        const Vector3d first = poses[j].rightPoint() - poses[j].leftPoint(),
                       last = poses[j + 1].rightPoint() - poses[j + 1].leftPoint();
        const double nearer = std::min(first.norm(), last.norm());
        const std::vector<Vector3d> a = poses[j].cutPoints(kPlaces), b = poses[j + 1].cutPoints(kPlaces);
        for (int k = 1; k <= looks; ++k) {
          if (k == looks && j + 2 == poses.size()) break;
          std::vector<Vector3d>& places = way.places.emplace_back();
          for (std::size_t c = 0; c < a.size(); ++c)
            places.push_back(a[c] + double(k) / looks * (b[c] - a[c]));
          if (k == looks) continue;
          const double share = double(k) / looks;
          way.off = std::max(way.off, offTheWay(places, {}));
          way.slack = std::max(way.slack, nearer - ((1 - share) * first + share * last).norm());
        }
      }
      way.end = Way::End::arrives;
    } else {
      go(poses, looks, way);
      if (way.end == Way::End::lost) {
        // A blade that is all but straight at a station may be followed from the next one alone.
        std::ranges::reverse(poses);
        Way back;
        go(poses, looks, back);
        std::ranges::reverse(poses);
        if (back.end == Way::End::arrives) way = std::move(back);
      }
    }
    way.targets.assign(std::make_move_iterator(poses.begin() + 1), std::make_move_iterator(poses.end() - 1));
    return way;
  }

  /// How far a blade, of which `now` is the part that cuts, lies from the smooth way, across it. `branch` is
  /// where the blade is; none for a straight one.
  double offTheWay(const std::vector<Vector3d>& now, std::optional<HeavyBranch> branch) const {
    const std::optional<BladePose> smooth = between_.at(travelOf(now));
    constexpr double kUnknown = std::numeric_limits<double>::infinity();
    if (!smooth) return kUnknown;
    const std::vector<double> arcs = smooth->cutArcs(kPlaces);
    std::vector<Elastica::State> states(kPlaces);
    if (branch) {
      const Result<ClampedBranch::Move> move = branch->moveTo(sweep::heldAt(row_, *smooth));
      if (!move || move->snapped) return kUnknown;
      branch->blade().at(arcs, states);
    } else {
      smooth->blade.at(arcs, states);
    }
    double farthest = 0;
    for (std::size_t c = 0; c < now.size(); ++c) {
      const Vector2d normal(-std::sin(states[c].angle), std::cos(states[c].angle));
      const Vector3d off = now[c] - smooth->frame.toWorld(states[c].point);
      farthest = std::max(farthest, std::abs(off.dot(smooth->frame.directionToWorld(normal))));
    }
    return farthest;
  }

  /// From the first pose to the last; those between take on the blade that hangs there.
  void go(std::vector<BladePose>& poses, int looks, Way& way) const {
    std::optional<HeavyBranch> branch = sweep::standing(row_, poses.front());
    if (!branch) return;
    for (std::size_t j = 0; j + 1 < poses.size(); ++j) {
      const sweep::Move course(row_, poses[j], poses[j + 1]);
      for (int k = 1; k <= looks; ++k) {
        const double share = double(k) / looks;
        const sweep::Move::Hold hold = course.at(share);
        const Result<ClampedBranch::Move> move = branch->moveTo(hold.problem);
        if (!move) {
          way.end = Way::End::lost;
          way.why = move.error().message;
          return;
        }
        if (move->snapped) {
          way.end = Way::End::snaps;
          return;
        }
        const std::vector<Vector3d> places = cut(poses[j], poses[j + 1], share, hold.frame, branch->blade());
        if (k < looks || j + 2 < poses.size()) {
          if (k < looks) way.off = std::max(way.off, offTheWay(places, branch));
          way.places.push_back(places);
          continue;
        }
        // Where it arrives, the row has its own shape, which has been looked at.
        const std::vector<Vector3d> own = poses.back().cutPoints(kPlaces);
        double apart = 0;
        for (std::size_t c = 0; c < own.size(); ++c) apart = std::max(apart, (own[c] - places[c]).norm());
        way.end = apart > kSameShape ? Way::End::otherwise : Way::End::arrives;
      }
      if (j + 2 < poses.size() && !row_.request.weight.isZero()) poses[j + 1].heavy = branch->blade();
    }
  }

  /// Where the part that cuts is then, in space.
  static std::vector<Vector3d> cut(const BladePose& a, const BladePose& b, double share, const Frame& frame,
                                   const HeavyBlade& blade) {
    const double from = std::lerp(a.before, b.before, share),
                 length = std::lerp(a.cut.length(), b.cut.length(), share);
    std::vector<double> arcs(kPlaces);
    for (int k = 0; k < kPlaces; ++k) arcs[std::size_t(k)] = from + length * k / (kPlaces - 1);
    std::vector<Elastica::State> states(kPlaces);
    blade.at(arcs, states);
    std::vector<Vector3d> places;
    for (const Elastica::State& state : states) places.push_back(frame.toWorld(state.point));
    return places;
  }

  const Sweep& row_;
  sweep::SmoothWay between_;
};

/// How fast a row goes from station to station.
class Pace {
 public:
  Pace(const Sweep& row, double cuttingSpeed) : speed_(cuttingSpeed) {
    constexpr int kPoints = 9;
    for (const BladePose& pose : row.poses) points_.push_back(pose.bladePoints(kPoints));
  }
  /// At least, in one move.
  double seconds(std::size_t i, std::size_t j) const {
    double farthest = 0;
    for (std::size_t k = 0; k < points_[i].size(); ++k)
      farthest = std::max(farthest, (points_[j][k] - points_[i][k]).norm());
    return farthest / speed_;
  }

 private:
  double speed_;
  std::vector<std::vector<Vector3d>> points_;
};

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

Result<RowMotion> followRow(const Sweep& row, const FollowRequest& request, const RunContext& context) {
  RowMotion motion;
  const Follower follower(row);
  const double tolerance = kOfChords * request.motionTolerance;
  const std::size_t n = row.poses.size();
  std::vector<char> snaps(n, 0), others(n, 0), lost(n, 0);
  std::vector<Way> ways;
  motion.reached.assign(n, 0);
  const std::vector<int> parts = skinParts(row);
  std::string why;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (context.stopped()) return stoppedError();
    Way& way = ways.emplace_back(follower.from(i, tolerance));
    const bool arrives = way.end == Way::End::arrives;
    motion.reached[i + 1] = arrives;
    snaps[i] = way.end == Way::End::snaps;
    others[i + 1] = way.end == Way::End::otherwise;
    lost[i] = way.end == Way::End::lost;
    if (lost[i]) why = way.why;
    if (!arrives) way.targets.clear();
    motion.course.push_back(row.poses[i]);
    std::vector<BladePose> between = way.targets;
    if (arrives && parts[i] > int(between.size()) + 1)
      if (Way finer = follower.inMoves(i, parts[i]); finer.end == Way::End::arrives)
        between = std::move(finer.targets);
    std::ranges::move(between, std::back_inserter(motion.course));
  }
  if (n > 0) motion.course.push_back(row.poses.back());

  // Stations without which the blade keeps as near to the smooth way are passed by.
  const Pace pace(row, request.cuttingSpeed);
  std::size_t reach = n;  // stations that a move went, the last time
  for (std::size_t i = 0; i + 1 < n;) {
    if (context.stopped()) return stoppedError();
    motion.targets.push_back(row.poses[i]);
    const auto plain = [&](std::size_t k) {
      return k + 1 < n && ways[k].end == Way::End::arrives && ways[k].targets.empty();
    };
    // The next station from which one move leads on in time; what is left of plain ones ends there otherwise.
    const auto inTime = [&](std::size_t from) {
      std::size_t to = from;
      while (plain(to) && pace.seconds(from, to) < kTargetSeconds) ++to;
      return to;
    };
    const auto crowds = [&](std::size_t k) {
      return pace.seconds(k, inTime(k)) < kTargetSeconds && plain(k);
    };
    std::size_t next = i + 1;
    if (plain(i)) {
      const std::size_t soonest = inTime(i);
      std::size_t last = soonest;
      while (plain(last) && pace.seconds(i, last + 1) <= kLongest) ++last;
      next = std::clamp(i + reach + std::max<std::size_t>(1, reach / 4), soonest, last);
      if (crowds(next)) next = inTime(next);
      while (next > i + 1) {
        Way past = follower.past(i, next);
        const bool arrives = past.end == Way::End::arrives;
        if (follower.keeps(past, tolerance)) {
          ways[i] = std::move(past);
          break;
        }
        // How far the way is off grows with the square of its length.
        const std::size_t span = next - i;
        const double part = arrives ? 1 / follower.partsFor(past, tolerance) : 0.5;
        next = i + std::clamp<std::size_t>(std::size_t(part * double(span)), 1, span - 1);
        while (next > soonest && crowds(next)) --next;
      }
      reach = next - i;
    }
    for (std::vector<Vector3d>& places : ways[i].places) {
      const std::size_t station = next == i + 1 ? i : follower.before(places);
      motion.instants.push_back({station, std::move(places)});
    }
    std::ranges::move(ways[i].targets, std::back_inserter(motion.targets));
    i = next;
  }
  if (n > 0) motion.targets.push_back(row.poses.back());
  motion.snaps = int(std::ranges::count(snaps, 1));
  tell(row, snaps, Severity::error, SnapsOnTheWay{}, motion.findings);
  tell(row, others, Severity::error, ArrivesOtherwise{}, motion.findings);
  tell(row, lost, Severity::warning, LostOnTheWay{why}, motion.findings);
  return motion;
}

Result<WayDeviation> deviationOf(const RowMotion& motion, const Sweep& row, const SweepAnalysis& analysis,
                                 const WayRequest& request, const SurfaceSampler& target,
                                 const RunContext& context) {
  WayDeviation way;
  const std::unique_ptr<SurfaceSampler> sampler = target.clone();
  const sweep::SurfaceRows shown(analysis.swept(), row.planes);
  const sweep::InFoam foam(row.block);
  std::vector<double> off(row.poses.size(), 0);  // on the way from each station to the next
  std::vector<std::optional<SurfaceSampler::Foot>> feet(kPlaces);
  std::vector<double> farthest(kPlaces, -1);  // from the target, of each place, and when
  std::vector<const RowMotion::Instant*> farthestAt(kPlaces, nullptr);
  for (const RowMotion::Instant& instant : motion.instants) {
    if (context.stopped()) return stoppedError();
    for (std::size_t c = 0; c < instant.places.size(); ++c) {
      const Vector3d& place = instant.places[c];
      Result<SurfaceSampler::Foot> foot = sampler->closest(place, feet[c] ? &*feet[c] : nullptr);
      if (!foot) return tl::unexpected<Error>(foot.error());
      feet[c] = *foot;
      if (!foam.cuts(place, *foot)) continue;
      const double away = std::abs(sampler->offset(place, *foot));
      if (away > farthest[c]) {
        farthest[c] = away;
        farthestAt[c] = &instant;
      }
      if (away > way.deviationMax) {
        way.deviationMax = away;
        way.worst = place;
      }
      // Beyond the end of a row there is no surface that it could leave.
      if (const sweep::SurfaceRows::Seen seen = shown.look(place); seen.beside <= kEdge) {
        double& worst = off[std::min(instant.station, std::max<std::size_t>(off.size(), 2) - 2)];
        worst = std::max(worst, seen.distance);
      }
    }
  }
  // Between two places it may be more: where one is the farthest of its neighbours, that is looked at.
  for (const std::size_t c : sweep::peaksOf(farthest)) {
    const std::vector<Vector3d>& places = farthestAt[c]->places;
    const auto first = std::size_t(std::clamp<std::ptrdiff_t>(std::ptrdiff_t(c) - 1, 0, kPlaces - 4));
    const auto placeAt = [&](double at) -> Vector3d {
      const double t = at - double(first), a = t, b = t - 1, d = t - 2, e = t - 3;
      return -b * d * e / 6 * places[first] + a * d * e / 2 * places[first + 1] -
             a * b * e / 2 * places[first + 2] + a * b * d / 6 * places[first + 3];
    };
    const sweep::Peak peak = sweep::farthestBetween(
        std::max(0.0, double(c) - 1), std::min(double(c) + 1, kPlaces - 1.0), placeAt, *sampler, foam);
    if (peak.value <= way.deviationMax) continue;
    way.deviationMax = peak.value;
    way.worst = placeAt(peak.place);
  }
  way.fromShown = std::ranges::max(off);
  for (const sweep::Stretch& at : sweep::stretchesOf(
           off.size(), [&](std::size_t i) { return off[i] > request.motionTolerance; },
           [&](std::size_t a, std::size_t b) { return off[a] > off[b]; })) {
    const bool slackens = sweep::slackensNear(row, at.worst);
    way.findings.push_back(
        {Severity::warning, OffTheSurfaceShown{off[at.worst], request.motionTolerance, false, slackens},
         sweep::placeOf(row.poses, at), slackens ? Remedies() : sweep::twiceAsMany(row, request.clearance)});
  }
  // Where the surface shown misses the tolerance as well, that is told of it.
  const double skin = analysis.summary.deviationMax;
  if (way.deviationMax > request.tolerance && (skin <= request.tolerance || way.deviationMax > kWorse * skin))
    way.findings.push_back({Severity::warning,
                            TooFarOnTheWay{way.deviationMax, request.tolerance},
                            {{}, way.worst},
                            sweep::twiceAsMany(row, request.clearance)});
  return way;
}

}  // namespace bw
