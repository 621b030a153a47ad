// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/joints.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bw/core/sweep/joint_kerf.h"
#include "bw/core/sweep/neighbours.h"
#include "bw/core/sweep/section_request.h"
#include "sweep/boundary_crossing.h"

namespace bw {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

using sweep::Crossing;
using sweep::Crossings;
using sweep::kRowInset;
using sweep::levelOf;
using sweep::RowBlades;
using sweep::RowBoundary;
using sweep::Through;

constexpr double kParallel = 1e-6;   // sine of an angle
constexpr double kOverlap = 1;       // mm that two faces have in common, at least
constexpr double kRounding = 0.01;   // mm: a gap that is computed from turned corners is no exact number
constexpr double kSamePlane = 1e-6;  // mm
constexpr int kAcross = 101;         // places on a cut that meets the one of the next row
constexpr double kStep = 1;          // mm of travel, over which the slope of a surface is taken
constexpr double kTogether = 10;     // mm between places of two surfaces that belong together
constexpr double kBeyond = 0.5;      // of a chord: past the end of a line there is nothing to meet

bool sameFamily(const PlaneFamily& a, const PlaneFamily& b) {
  if (a.turns() || b.turns()) return a.turn == b.turn && a.frame == b.frame;
  return a.direction().cross(b.direction()).norm() < kParallel && a.direction().dot(b.direction()) > 0 &&
         a.frame.x.cross(b.frame.x).norm() < kParallel;
}

/// The angle between two lines.
double between(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

/// Takes one place into a joint.
void note(Joint& joint, double gap, double kink, const Vector3d& place, bool isStation) {
  if (gap > joint.gapMax || joint.places == 0) {
    joint.gapMax = gap;
    joint.gapAt = place;
  }
  if (kink > joint.kinkMax || joint.places == 0) {
    joint.kinkMax = kink;
    joint.kinkAt = place;
  }
  if (isStation) {
    joint.gapAtStations = std::max(joint.gapAtStations, gap);
    joint.kinkAtStations = std::max(joint.kinkAtStations, kink);
  }
  joint.gapMean += (gap - joint.gapMean) / ++joint.places;
}

/// The levels at which two rows are compared, ascending, and whether they are stations of one of them.
std::vector<std::pair<double, bool>> levelsOf(const Sweep& a, const Sweep& b, double from, double to) {
  std::vector<double> stations;
  for (const Sweep* sweep : {&a, &b})
    for (const BladePose& pose : sweep->poses) {
      const double level = levelOf(*sweep, pose);
      if (level >= from - kRowInset && level <= to + kRowInset) stations.push_back(level);
    }
  std::ranges::sort(stations);
  const auto same = [](double x, double y) { return y - x < kRowInset; };
  stations.erase(std::unique(stations.begin(), stations.end(), same), stations.end());
  std::vector<std::pair<double, bool>> levels;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    levels.emplace_back(stations[i], true);
    for (int k = 1; k < sweep::kBetweenStations && i + 1 < stations.size(); ++k)
      levels.emplace_back(std::lerp(stations[i], stations[i + 1], double(k) / sweep::kBetweenStations),
                          false);
  }
  return levels;
}

/// How two rows come to their boundary.
struct Pair {
  RowBoundary mine, theirs;
  Joint& joint;
  int unknown = 0;  ///< places of which it is not known how both meet
  Vector3d unknownAt = Vector3d::Zero();

  void cannotTell(const Vector3d& place) {
    ++unknown;
    unknownAt = place;
  }
  void lacks(const Vector3d& place) {
    ++joint.open;
    joint.openAt = place;
  }
};

/// Notes how a place of one surface meets the lines of the other one; true if they have one near to it.
/// `slit`: mm of the way from one to the other that neither has.
bool meet(const Crossing& at, const std::vector<sweep::CrossingLine>& lines, double farthest, Joint& joint,
          double slit = 0) {
  const Vector3d& p = at.point;
  double nearest = 1e300, share = 0;
  const Crossing *from = nullptr, *to = nullptr;
  for (const sweep::CrossingLine& line : lines)
    for (std::size_t j = 0; j < line.size(); j += j + 2 == line.size() ? 2 : 1) {
      const Crossing &a = line[j], &b = line[std::min(j + 1, line.size() - 1)];
      const Vector3d way = b.point - a.point;
      const double length = way.squaredNorm(), past = length > 0 ? way.dot(p - a.point) / length : 0;
      const double s = std::clamp(past, 0.0, 1.0), off = (p - a.point - s * way).norm();
      if (off >= nearest) continue;
      nearest = off;
      share = past;
      from = &a;
      to = &b;
    }
  if (nearest > farthest) return false;
  if (share < -kBeyond || share > 1 + kBeyond) return true;
  const Vector3d normal = ((1 - share) * from->normal + share * to->normal).normalized();
  // Across the surface: the chords lie off the curve by a little.
  const Vector3d foot = from->point + share * (to->point - from->point);
  const Vector3d t0 = from->normal, t1 = to->normal;
  const double sag = share * (1 - share) * 0.5 * (to->point - from->point).dot(t1 - t0);
  const double stands = at.stands * at.normal.dot(normal) - std::lerp(from->stands, to->stands, share);
  const double gap = std::abs((p - foot).dot(normal) - sag + stands);
  note(joint, std::hypot(gap, slit), between(at.normal, normal), p, true);
  return true;
}

/// How far what stands of two surfaces lies apart in a plane across the travel, at the boundary.
double gapOf(const Crossing& a, const Crossing& b, const Vector3d& line) {
  constexpr double kAlong = 0.02;  // of a unit normal
  const double x = a.normal.dot(line), y = b.normal.dot(line);
  if (std::min(std::abs(x), std::abs(y)) < kAlong)
    return std::abs((a.point - b.point).dot(a.normal) + a.stands - b.stands);
  return std::abs((a.point - b.point).dot(line) + a.stands / x - b.stands / y);
}

/// Places of one surface that are to be found on the other one as well.
using Loose = std::vector<Crossing>;

/// Rows side by side: each plane of theirs meets the boundary in a line. What one of them alone has there is
/// left over.
Result<void> alongside(Pair& pair, std::array<Loose, 2>& loose, const RunContext& context) {
  RowBlades mine(pair.mine.sweep), theirs(pair.theirs.sweep);
  const double from = std::max(mine.first(), theirs.first()), to = std::min(mine.last(), theirs.last());
  for (const auto& known : levelsOf(pair.mine.sweep, pair.theirs.sweep, from, to)) {
    // Both ends of both rows are in one plane, but for what keeps them off a border or a kerf leads them out.
    const double level = std::min(std::max(known.first, from), to);
    const bool isStation = known.second;
    if (context.stopped()) return stoppedError();
    const Vector3d across = pair.mine.sweep.planes.at(level).normal,
                   line = pair.mine.boundary.normal.cross(across).stableNormalized();
    const std::optional<BladePose> p = mine.at(level), q = theirs.at(level);
    const std::vector<Through> all = p ? through(*p, pair.mine) : std::vector<Through>(),
                               others = q ? through(*q, pair.theirs) : std::vector<Through>();
    if (!p || !q) {
      if (!all.empty() || !others.empty()) pair.cannotTell(all.empty() ? others[0].point : all[0].point);
      continue;
    }
    // Those that belong together: a surface may come to a boundary twice.
    std::vector<char> used(all.size()), met(others.size());
    for (std::size_t turns = std::min(all.size(), others.size()); turns > 0; --turns) {
      std::size_t x = all.size(), y = 0;
      for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < others.size(); ++j)
          if (!used[i] && !met[j] &&
              (x == all.size() ||
               (all[i].point - others[j].point).norm() < (all[x].point - others[y].point).norm())) {
            x = i;
            y = j;
          }
      used[x] = met[y] = 1;
      double gap = (all[x].point - others[y].point).norm();
      Vector3d one = all[x].tangent, other = others[y].tangent;
      if (pair.mine.kerf.field || pair.theirs.kerf.field) {
        const auto a = crossingAt(mine, level, *p, all[x], pair.mine);
        const auto b = crossingAt(theirs, level, *q, others[y], pair.theirs);
        if (!a || !b) {
          pair.cannotTell(all[x].point);
          continue;
        }
        gap = gapOf(*a, *b, line);
        one = a->tangent;
        other = b->tangent;
      }
      note(pair.joint, gap, between(one, other), all[x].point, isStation);
    }
    const auto leave = [&](RowBlades& blades, const BladePose& pose, const std::vector<Through>& places,
                           const std::vector<char>& paired, const RowBoundary& at, Loose& left) {
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (paired[i] || !at.has(places[i].point)) continue;
        if (const std::optional<Crossing> place = crossingAt(blades, level, pose, places[i], at))
          left.push_back(*place);
        else
          pair.cannotTell(places[i].point);
      }
    };
    leave(mine, *p, all, used, pair.mine, loose[0]);
    leave(theirs, *q, others, met, pair.theirs, loose[1]);
  }
  return {};
}

/// Rows that their boundary does not part across the travel of both: at the ends of their blades, and where
/// their first and last blades run along it.
Result<void> beside(Pair& pair, const RunContext& context) {
  std::array<Loose, 2> loose;
  const Sweep &a = pair.mine.sweep, &b = pair.theirs.sweep;
  // Planes that turn pass a boundary across the travel within a few stations, more and more of them from one
  // side: their blades run along it.
  constexpr double kMostlyAlong = 0.7;
  const bool runAlong =
      a.planes.turns() && std::abs(a.planes.direction().dot(pair.mine.boundary.normal)) > kMostlyAlong;
  const bool common = !runAlong && sameFamily(a.planes, b.planes);
  if (common)
    if (const Result<void> ok = alongside(pair, loose, context); !ok) return ok;
  const std::array<const RowBoundary*, 2> rows = {&pair.mine, &pair.theirs};
  std::array<Crossings, 2> lines = {rowCrossings(pair.mine), rowCrossings(pair.theirs)};
  const auto reaches = [&](const Sweep& one, const Sweep& other) {
    return levelOf(one, one.poses.front()) < levelOf(other, other.poses.front()) - kRowInset ||
           levelOf(one, one.poses.back()) > levelOf(other, other.poses.back()) + kRowInset;
  };
  for (const Crossings& row : lines)
    if (row.unknown > 0) pair.cannotTell(row.unknownAt);
  const bool more = !common || !loose[0].empty() || !loose[1].empty() || !lines[0].lines.empty() ||
                    !lines[1].lines.empty() || reaches(a, b) || reaches(b, a);
  if (!more) return {};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const sweep::CrossingLine& line : lines[i].lines)
      loose[i].insert(loose[i].end(), line.begin(), line.end());
    Result<Crossings> ends = endCrossings(*rows[i], context);
    if (!ends) return tl::unexpected<Error>(ends.error());
    const Sweep& other = rows[1 - i]->sweep;
    for (sweep::CrossingLine& line : ends->lines) {
      for (const Crossing& place : line) {
        const double level = other.planes.level(place.point);
        if (!common || level < levelOf(other, other.poses.front()) - kRowInset ||
            level > levelOf(other, other.poses.back()) + kRowInset)
          loose[i].push_back(place);
      }
      lines[i].lines.push_back(std::move(line));
    }
  }
  const double farthest =
      kTogether + pair.mine.boundary.apart + 0.5 * (pair.mine.kerf.widest() + pair.theirs.kerf.widest());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const Crossing& place : loose[i])
      if (!meet(place, lines[1 - i].lines, farthest, pair.joint)) pair.lacks(place.point);
  return {};
}

/// The cut at the end of a row, at the boundary. `front`: where the row begins, else where it ends.
/// Its blade goes on as it goes there.
std::optional<sweep::CrossingLine> endOf(const RowBoundary& row, bool front, double level) {
  const Sweep& sweep = row.sweep;
  RowBlades blades(sweep);
  BladePose end = front ? sweep.poses.front() : sweep.poses.back();
  double own = levelOf(sweep, end);
  // With a kerf it may go on behind it.
  if (front ? own < level - kSamePlane : own > level + kSamePlane) {
    std::optional<BladePose> there = blades.at(level);
    if (!there) return {};
    end = std::move(*there);
    own = level;
  }
  const std::optional<BladePose> inner = blades.at(front ? own + kStep : own - kStep);
  if (!inner) return {};
  const double step = levelOf(sweep, *inner) - own;
  if (std::abs(step) < 1e-3) return {};
  sweep::CrossingLine cut;
  const std::vector<double> arcs = end.cutArcs(kAcross);
  std::vector<Elastica::State> states(arcs.size()), there(arcs.size());
  end.at(arcs, states);
  std::vector<double> feet(arcs.size());
  for (std::size_t k = 0; k < feet.size(); ++k)
    feet[k] = inner->before + inner->cut.length() * double(k) / (kAcross - 1);
  constexpr int kFootSteps = 3;
  for (int i = 0; i < kFootSteps; ++i) {
    inner->at(feet, there);
    for (std::size_t k = 0; k < feet.size(); ++k) {
      const Vector2d tangent(std::cos(there[k].angle), std::sin(there[k].angle));
      feet[k] =
          std::clamp(feet[k] + tangent.dot(states[k].point - there[k].point), 0.0, inner->blade.length());
    }
  }
  inner->at(feet, there);
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    const Elastica::State& state = states[k];
    const Vector2d tangent(std::cos(state.angle), std::sin(state.angle)), normal(-tangent.y(), tangent.x());
    const double rise = normal.dot(there[k].point - state.point) / step;
    const Vector3d along = sweep.planes.direction() + rise * end.frame.directionToWorld(normal);
    Crossing& place = cut.emplace_back();
    place.point = end.frame.toWorld(state.point) + (level - own) * along;
    place.tangent = end.frame.directionToWorld(tangent);
    place.normal = place.tangent.cross(along).normalized();
    if (row.kerf.field) place.stands = 0.5 * row.side * row.kerf.width(place.point);
  }
  return cut;
}

/// One row ends where the other one begins.
void inLine(Pair& pair) {
  const Boundary& boundary = pair.mine.boundary;
  const Vector3d& direction = pair.mine.sweep.planes.direction();
  const bool forwards = direction.dot(boundary.normal) > 0;
  const double level = pair.mine.sweep.planes.level(boundary.point);
  const auto ends = [&](const Sweep& sweep, bool front) {
    return levelOf(sweep, front ? sweep.poses.front() : sweep.poses.back());
  };
  const auto reaches = [&](const RowBoundary& row, bool front) {
    const double past = (front ? level - ends(row.sweep, front) : ends(row.sweep, front) - level),
                 slack = 0.5 * boundary.apart + sweep::kNearBoundary;
    return past >= -slack && past <= slack + 0.5 * row.kerf.widest();
  };
  const bool one = reaches(pair.mine, !forwards), other = reaches(pair.theirs, forwards);
  if (!one && !other) return;
  const std::optional<sweep::CrossingLine> x = one ? endOf(pair.mine, !forwards, level) : std::nullopt,
                                           y = other ? endOf(pair.theirs, forwards, level) : std::nullopt;
  if (!x || !y) {
    if (one && other)
      pair.cannotTell(boundary.point);
    else
      pair.lacks(boundary.point);
    return;
  }
  // What is handed over ends with the rows, which may stop before their blocks do.
  const double way = (forwards ? 1 : -1) *
                     (ends(pair.theirs.sweep, forwards) - ends(pair.mine.sweep, !forwards)),
               slit = std::max(0.0, way - boundary.apart);
  constexpr double kAnywhere = 1e300;
  for (const Crossing& place : *x) meet(place, {*y}, kAnywhere, pair.joint, slit);
}

}  // namespace

std::optional<Boundary> boundaryOf(const Box& first, const Box& second, double apart) {
  const std::array<Vector3d, 3> axes = {first.frame.x, first.frame.y, first.frame.normal};
  // The second box along the axes of the first. Middles are compared, not corners: what angles are off by
  // counts half as much there, and from both boxes alike.
  const Vector3d way = second.center() - first.center();
  Vector3d size, low;
  for (int k = 0; k < 3; ++k) {
    const Vector3d turned(axes[std::size_t(k)].dot(second.frame.x), axes[std::size_t(k)].dot(second.frame.y),
                          axes[std::size_t(k)].dot(second.frame.normal));
    Eigen::Index along = 0;
    const double most = turned.cwiseAbs().maxCoeff(&along);
    if (most < 1 - kParallel) return {};
    size(k) = second.size(along);
    low(k) = axes[std::size_t(k)].dot(way) + 0.5 * (first.size(k) - size(k));
  }
  for (int k = 0; k < 3; ++k) {
    const double before = low(k) - first.size(k), after = -(low(k) + size(k));
    const double between = std::max(before, after);
    if (between < -kTouching || between > std::max(apart, kTouching) + kRounding) continue;
    // Where they are thinner than that both sides may seem to touch.
    const bool onward = before >= after;
    Boundary boundary;
    boundary.apart = std::max(0.0, between);
    boundary.normal = onward ? axes[std::size_t(k)] : Vector3d(-axes[std::size_t(k)]);
    Vector3d middle;
    middle(k) = onward ? 0.5 * (first.size(k) + low(k)) : 0.5 * (low(k) + size(k));
    bool overlaps = true;
    for (int j = 0; j < 3; ++j) {
      if (j == k) continue;
      const double from = std::max(0.0, low(j)), to = std::min(first.size(j), low(j) + size(j));
      overlaps = overlaps && to - from > kOverlap;
      middle(j) = 0.5 * (from + to);
    }
    if (!overlaps) continue;
    boundary.point = first.frame.origin;
    for (int j = 0; j < 3; ++j) boundary.point += middle(j) * axes[std::size_t(j)];
    return boundary;
  }
  return {};
}

double Joints::gapMax() const {
  double most = 0;
  for (const Joint& joint : joints) most = std::max(most, joint.gapMax);
  return most;
}

double Joints::kinkMax() const {
  double most = 0;
  for (const Joint& joint : joints) most = std::max(most, joint.kinkMax);
  return most;
}

bool Joints::wantsStations(const JointRequest& request) const {
  bool between = false;
  for (const Joint& joint : joints) {
    if (joint.gapAtStations > request.gap || joint.kinkAtStations > request.kink) return false;
    between = between || joint.gapMax > request.gap || joint.kinkMax > request.kink;
  }
  return between;
}

namespace {

MayMeet ofOneSurface(const std::vector<BlockRow>& rows) {
  return [&rows](std::size_t i, std::size_t j) { return rows[i].surface == rows[j].surface; };
}

}  // namespace

std::vector<char> joined(const std::vector<BlockRow>& rows, const std::vector<Box>& blocks, double apart) {
  std::vector<char> has(rows.size(), 0);
  for (const Neighbours& pair : neighboursAmong(rows, blocks, apart, ofOneSurface(rows)))
    has[pair.first] = has[pair.second] = 1;
  return has;
}

Result<Joints> measureJoints(const std::vector<BlockRow>& rows, const JointRequest& request,
                             const RunContext& context) {
  return measureJoints(rows, std::vector<RowKerf>(rows.size()), request, context);
}

Result<Joints> measureJoints(const std::vector<BlockRow>& rows, const std::vector<RowKerf>& kerfs,
                             const JointRequest& request, const RunContext& context) {
  std::vector<Box> blocks;
  for (const BlockRow& row : rows) blocks.push_back(row.sweep->block);
  return measureJoints(rows, kerfs, neighboursAmong(rows, blocks, request.apart, ofOneSurface(rows)), request,
                       context);
}

namespace {

/// Twice as many stations as the row of two that has more of them, where `atStations` keeps the limit, so
/// that what lies between them alone is off.
Remedies moreStations(const Sweep& a, const Sweep& b, double atStations, double limit) {
  const auto count = [](const Sweep& sweep) {
    return sweep.poses.back().index - sweep.poses.front().index + 1;
  };
  const int more = 2 * std::max(count(a), count(b)) - 1;
  return atStations <= limit && more <= SectionRequest::kMost ? Remedies{MoreStations{more}} : Remedies{};
}

}  // namespace

Result<Joints> measureJoints(const std::vector<BlockRow>& rows, const std::vector<RowKerf>& kerfs,
                             const std::vector<Neighbours>& pairs, const JointRequest& request,
                             const RunContext& context) {
  std::vector<Joint> all;
  std::vector<Boundary> boundaries;
  for (const Neighbours& pair : pairs) {
    if (rows[pair.first].sweep->poses.size() < 2 || rows[pair.second].sweep->poses.size() < 2) continue;
    all.push_back({pair.first, pair.second});
    boundaries.push_back(pair.boundary);
  }
  std::vector<std::pair<int, Vector3d>> unknown(all.size(), {0, Vector3d::Zero()});
  const Result<void> ok = parallelFor(context, int(all.size()), [&](int k) {
    Joint& joint = all[std::size_t(k)];
    const Boundary& boundary = boundaries[std::size_t(k)];
    const Sweep &a = *rows[joint.first].sweep, &b = *rows[joint.second].sweep;
    Pair pair{{a, boundary, b.block, kerfs[joint.first]}, {b, boundary, a.block, kerfs[joint.second]}, joint};
    const double along = std::abs(a.planes.direction().dot(boundary.normal));
    if (along > 1 - kParallel && !a.planes.turns() && sameFamily(a.planes, b.planes))
      inLine(pair);
    else
      (void)beside(pair, context);  // a stop is told below
    unknown[std::size_t(k)] = {pair.unknown, pair.unknownAt};
  });
  if (!ok) return tl::unexpected<Error>(ok.error());
  if (context.stopped()) return stoppedError();
  Joints joints;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Joint& joint = all[k];
    const std::string &one = rows[joint.first].block, &other = rows[joint.second].block;
    if (const auto& [places, at] = unknown[k]; places > 0)
      joints.findings.push_back({Severity::warning, JointUnknown{one, other, places}, {{}, at}, {}});
    if (joint.places == 0 && joint.open == 0) continue;
    joints.joints.push_back(joint);
    const auto more = [&](double atStations, double limit) {
      return moreStations(*rows[joint.first].sweep, *rows[joint.second].sweep, atStations, limit);
    };
    if (joint.gapMax > request.gap)
      joints.findings.push_back({Severity::warning,
                                 JointGap{one, other, joint.gapMax, request.gap, joint.gapAtStations},
                                 {{}, joint.gapAt},
                                 more(joint.gapAtStations, request.gap)});
    if (joint.kinkMax > request.kink)
      joints.findings.push_back({Severity::warning,
                                 JointKink{one, other, joint.kinkMax, request.kink, joint.kinkAtStations},
                                 {{}, joint.kinkAt},
                                 more(joint.kinkAtStations, request.kink)});
    if (joint.open > 0)
      joints.findings.push_back(
          {Severity::warning, JointOpen{one, other, joint.open, joint.places}, {{}, joint.openAt}, {}});
  }
  return joints;
}

}  // namespace bw
