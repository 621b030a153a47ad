// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/boundary_crossing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "bw/core/sweep/block_pieces.h"
#include "bw/core/sweep/oblique_planes.h"

namespace bw::sweep {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSameLevel = 1e-6;  // mm
constexpr double kAlong = 0.02;      // of a unit normal: less of it, and the boundary is run along
constexpr double kStep = 1;          // mm of travel, over which the slope of a surface is taken
constexpr int kPlaces = 41;          // of a blade that runs along the boundary, at least
constexpr double kApart = 8;         // mm between these, at most
constexpr double kRounding = 1e-3;   // mm

Elastica::State stateAt(const BladePose& pose, double s) {
  const std::array<double, 1> arc = {s};
  std::array<Elastica::State, 1> state;
  pose.at(arc, state);
  return state[0];
}

/// That of a blade at an end of its cut, where this ends near the boundary.
std::optional<Through> through(const BladePose& pose, const RowBoundary& at, const BoundaryLine& line,
                               double end) {
  constexpr int kSteps = 20;
  constexpr double kFarthest = 20;
  double s = end;
  Elastica::State state = stateAt(pose, s);
  if (std::abs(line.distance(state.point)) > at.reach()) return {};
  for (int k = 0; k < kSteps; ++k) {
    const double away = line.distance(state.point);
    const double slope = line.normal.dot(Vector2d(std::cos(state.angle), std::sin(state.angle)));
    if (std::abs(slope) < kAlong) return {};
    if (std::abs(away) < 1e-10) break;
    s = std::clamp(s - away / slope, 0.0, pose.blade.length());
    if (std::abs(s - end) > 2 * at.reach() + kFarthest) return {};
    state = stateAt(pose, s);
  }
  return Through{pose.frame.toWorld(state.point),
                 pose.frame.directionToWorld({std::cos(state.angle), std::sin(state.angle)}), s};
}

/// A blade of the row beside the one at a level, and how far along the travel.
std::optional<std::pair<BladePose, double>> beside(RowBlades& blades, double level) {
  const double other = level + kStep <= blades.last() ? level + kStep : level - kStep;
  std::optional<BladePose> pose = blades.at(other);
  if (!pose) return {};
  const double step = levelOf(blades.sweep(), *pose) - level;
  if (std::abs(step) < 1e-3) return {};
  return std::pair(std::move(*pose), step);
}

/// The arc length at which a blade comes nearest to a place of its plane, from a guess.
double footOn(const BladePose& pose, const Vector3d& place, double guess) {
  constexpr int kFootSteps = 3;
  const Vector2d at(pose.frame.x.dot(place - pose.frame.origin), pose.frame.y.dot(place - pose.frame.origin));
  double foot = std::clamp(guess, 0.0, pose.blade.length());
  for (int i = 0; i < kFootSteps; ++i) {
    const Elastica::State there = stateAt(pose, foot);
    const Vector2d tangent(std::cos(there.angle), std::sin(there.angle));
    foot = std::clamp(foot + tangent.dot(at - there.point), 0.0, pose.blade.length());
  }
  return foot;
}

/// The arc length of the same share of the part that cuts.
double sameShare(const BladePose& from, double arc, const BladePose& to) {
  return to.before + to.cut.length() * (arc - from.before) / from.cut.length();
}

/// The way in which the surface goes on along the travel from a place of a blade, per mm across its plane:
/// from the nearest place of `other`, a blade of the row beside it, `step` mm on or back where their planes
/// are parallel.
Vector3d onward(const Sweep& row, const BladePose& pose, const Elastica::State& state, double arc,
                const BladePose& other, double step) {
  const double foot = footOn(other, pose.frame.toWorld(state.point), sameShare(pose, arc, other));
  const Vector3d normal = pose.frame.directionToWorld({-std::sin(state.angle), std::cos(state.angle)});
  const Vector3d way = other.frame.toWorld(stateAt(other, foot).point) - pose.frame.toWorld(state.point);
  if (row.planes.turns()) step = pose.frame.normal.dot(way);
  return pose.frame.normal + normal.dot(way) / step * normal;
}

/// What is known of a surface at a place of a blade.
struct Place {
  Crossing at;
  Vector3d along;    ///< the way of the travel on it
  double far = 0;    ///< mm, of what stands from the boundary, along its normal
  double rise = 0;   ///< mm towards it, per mm across the plane
  bool runs = true;  ///< the blade runs along the boundary more than the travel does
};
Place placeAt(const RowBoundary& at, const BladePose& pose, double arc, const BladePose& other, double step) {
  const Elastica::State state = stateAt(pose, arc);
  Place place;
  place.along = onward(at.sweep, pose, state, arc, other, step);
  place.at.point = pose.frame.toWorld(state.point);
  place.at.tangent = pose.frame.directionToWorld({std::cos(state.angle), std::sin(state.angle)});
  place.at.normal = place.at.tangent.cross(place.along).normalized();
  place.at.stands = 0.5 * at.side * at.kerf.width(place.at.point);
  place.far = at.boundary.normal.dot(place.at.point + place.at.stands * place.at.normal - at.boundary.point);
  place.rise = at.boundary.normal.dot(place.along);
  const double across = std::abs(at.boundary.normal.dot(place.at.tangent));
  place.runs = across < std::max(kAlong, std::abs(place.rise) / place.along.norm());
  return place;
}

/// Lines of places that come one after the other.
class Lines {
 public:
  explicit Lines(Crossings& crossings) : crossings_(crossings) {}
  Lines(const Lines&) = delete;
  ~Lines() { finish(); }
  void add(const Crossing& place) { line_.push_back(place); }
  void finish() {
    if (!line_.empty()) crossings_.lines.push_back(std::exchange(line_, {}));
  }

 private:
  Crossings& crossings_;
  CrossingLine line_;
};

/// Arc lengths of places of the part that cuts, evenly.
std::vector<double> placesOf(const BladePose& pose) {
  return pose.cutArcs(std::max(kPlaces, 1 + int(std::ceil(pose.cut.length() / kApart))));
}

/// The arc lengths at which the part of a blade that cuts comes through a boundary itself.
std::vector<double> ownCrossings(const BladePose& pose, const Boundary& boundary) {
  constexpr int kHalvings = 40;
  const auto away = [&](double arc) {
    return boundary.normal.dot(pose.frame.toWorld(stateAt(pose, arc).point) - boundary.point);
  };
  std::vector<double> found;
  const std::vector<double> arcs = placesOf(pose);
  for (std::size_t k = 0; k + 1 < arcs.size(); ++k) {
    double a = arcs[k], b = arcs[k + 1];
    const bool behind = away(a) < 0;
    if (behind == (away(b) < 0)) continue;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = std::midpoint(a, b);
      ((away(middle) < 0) == behind ? a : b) = middle;
    }
    found.push_back(std::midpoint(a, b));
  }
  return found;
}

/// Where the surface comes through between two blades of the row, looked for from places of the first one of
/// them, `step` mm of travel before the other one (or behind it, below 0). `beyond`: of those alone that the
/// other one does not cut any more.
void addBetween(const RowBoundary& at, RowBlades& blades, const BladePose& from, const BladePose& to,
                bool beyond, Crossings& crossings) {
  constexpr int kSteps = 4;
  constexpr double kSteepest = 5;  // mm towards the boundary, per mm of travel
  const double step = levelOf(at.sweep, to) - levelOf(at.sweep, from);
  const auto away = [&](const Vector3d& p) {
    const double far = at.boundary.normal.dot(p - at.boundary.point);
    return std::abs(far) < kRounding ? 0 : far;
  };
  struct Start {
    double arc, foot;  ///< of the one blade, and of the place of the other one that is nearest
  };
  std::vector<Start> starts;
  const auto start = [&](double arc) {
    const Vector3d place = from.frame.toWorld(stateAt(from, arc).point);
    starts.push_back({arc, footOn(to, place, sameShare(from, arc, to))});
  };
  for (const double arc : placesOf(from)) start(arc);
  // Where a blade itself comes through, the places of both sides of it are to follow each other.
  for (const double arc : ownCrossings(from, at.boundary)) start(arc);
  for (const double foot : ownCrossings(to, at.boundary)) {
    const double arc = footOn(from, to.frame.toWorld(stateAt(to, foot).point), sameShare(to, foot, from));
    if (arc > from.before && arc < from.before + from.cut.length()) starts.push_back({arc, foot});
  }
  std::ranges::sort(starts, {}, &Start::arc);
  Lines lines(crossings);
  for (const auto& [arc, foot] : starts) {
    const Elastica::State state = stateAt(from, arc);
    const Vector3d begin = from.frame.toWorld(state.point);
    if (std::abs(away(begin)) > kSteepest * std::abs(step)) {
      lines.finish();
      continue;
    }
    const Vector3d end = to.frame.toWorld(stateAt(to, foot).point);
    const bool cut = foot >= to.before && foot <= to.before + to.cut.length();
    if ((beyond && cut) || away(begin) * away(end) > 0 || away(begin) == away(end)) {
      lines.finish();
      continue;
    }
    // The middle of the blade comes through there, and what stands a little before it or behind it.
    double share = away(begin) / (away(begin) - away(end));
    std::optional<Place> place;
    for (int k = 0; k < kSteps; ++k) {
      const double level = levelOf(at.sweep, from) + share * step;
      const std::optional<BladePose> pose = blades.at(level);
      const auto other = beside(blades, level);
      place.reset();
      if (!pose || !other) break;
      const double here = footOn(*pose, begin + share * (end - begin), std::lerp(arc, foot, share));
      place = placeAt(at, *pose, here, other->first, other->second);
      const double middle = away(place->at.point);
      if (std::abs(place->rise) < kAlong || std::abs(middle) < 1e-9) break;
      const double passes = at.sweep.planes.speed(level, place->at.point);
      share = std::clamp(share - middle / (place->rise * step * passes), 0.0, 1.0);
    }
    if (!place) {
      ++crossings.unknown;
      crossings.unknownAt = begin;
      lines.finish();
    } else if (!place->runs || std::abs(place->rise) < kAlong || !at.has(place->at.point)) {
      lines.finish();
    } else {
      place->at.point -= place->far / place->rise * place->along;
      lines.add(place->at);
    }
  }
}

/// Where the surface comes through before the first blade of the row, or behind its last one.
void addEnd(const RowBoundary& at, bool front, Crossings& crossings) {
  constexpr double kTouches = 0.1;  // mm
  constexpr double kBack = 1e-3;    // mm: a little inside of the row, too
  const BladePose& end = front ? at.sweep.poses.front() : at.sweep.poses.back();
  const std::vector<double> arcs = placesOf(end);
  std::vector<Elastica::State> states(arcs.size());
  end.at(arcs, states);
  if (std::ranges::none_of(states, [&](const Elastica::State& state) {
        const Vector3d place = end.frame.toWorld(state.point);
        return std::abs(at.boundary.normal.dot(place - at.boundary.point)) <= at.reach();
      }))
    return;
  RowBlades blades(at.sweep);
  const auto inner = beside(blades, levelOf(at.sweep, end));
  Lines lines(crossings);
  if (!inner) {
    ++crossings.unknown;
    crossings.unknownAt = end.frame.toWorld(states[states.size() / 2].point);
    return;
  }
  for (const double arc : arcs) {
    Place place = placeAt(at, end, arc, inner->first, inner->second);
    if (!place.runs || std::abs(place.far) > at.aside() || !at.has(place.at.point)) {
      lines.finish();
    } else if (std::abs(place.rise) < kAlong) {
      lines.finish();
      if (std::abs(place.far) > 0.5 * at.boundary.apart + kTouches) continue;
      ++crossings.unknown;
      crossings.unknownAt = place.at.point;
    } else {
      const double travel = -place.far / place.rise;
      place.at.point += travel * place.along;
      if ((front ? -travel : travel) > -kBack && at.has(place.at.point))
        lines.add(place.at);
      else
        lines.finish();
    }
  }
}

}  // namespace

double levelOf(const Sweep& sweep, const BladePose& pose) { return sweep.planes.level(pose.frame.origin); }

std::optional<BladePose> RowBlades::at(double level) {
  const BladePose& front = sweep_.poses.front();
  const double travel = std::clamp(level - first() + front.travel, front.travel, sweep_.poses.back().travel);
  const std::size_t i = way_.before(travel);
  for (const std::size_t k : {i, i + 1})
    if (std::abs(sweep_.poses[k].travel - travel) < kSameLevel) return sweep_.poses[k];
  std::optional<BladePose> pose = way_.at(travel);
  if (!pose || sweep_.request.weight.isZero() || isTaut(*pose)) return pose;
  if (hangingFrom_ != i || !hanging_) {
    hanging_ = standing(sweep_, sweep_.poses[i]);
    hangingFrom_ = i;
  }
  if (!hanging_) return {};
  const Result<ClampedBranch::Move> move = hanging_->moveTo(heldAt(sweep_, *pose));
  if (!move || move->snapped) {
    hanging_.reset();
    return {};
  }
  pose->heavy = hanging_->blade();
  return pose;
}

RowBoundary::RowBoundary(const Sweep& row, const Boundary& at, const Box& beyond, const RowKerf& melts)
    : sweep(row), boundary(at), other(beyond), kerf(melts) {
  if (melts.widest() == 0) return;
  // The mean of all normals, each with its area.
  constexpr int kOfBlade = 9;
  Vector3d mean = Vector3d::Zero();
  for (std::size_t i = 0; i + 1 < row.poses.size(); ++i) {
    const std::vector<Vector3d> a = row.poses[i].cutPoints(kOfBlade),
                                b = row.poses[i + 1].cutPoints(kOfBlade);
    for (std::size_t k = 0; k + 1 < a.size(); ++k) mean += (a[k + 1] - a[k]).cross(b[k] - a[k]);
  }
  if (mean.dot(melts.kerf.kept) < 0) side = -1;
}

double RowBoundary::aside() const { return 0.5 * boundary.apart + kerf.kerf.back + kNearBoundary; }

double RowBoundary::reach() const { return aside() + 0.5 * kerf.widest(); }

bool RowBoundary::has(const Vector3d& place) const {
  // Beside the place: what comes to the boundary from a block may still be half of the gap, and what its row
  // ends before it, away from that.
  const double slack = reach() + kRowInset;
  const Vector3d beside = place - boundary.normal.dot(place - boundary.point) * boundary.normal;
  const auto in = [&](const Box& box) {
    const Vector3d local = box.frame.toLocal(beside);
    return (local.array() >= -slack).all() && (local.array() <= box.size.array() + slack).all();
  };
  return in(sweep.block) && in(other);
}

std::vector<Through> through(const BladePose& pose, const RowBoundary& at) {
  std::vector<Through> places;
  const std::optional<BoundaryLine> line = boundaryIn(pose.frame, at.boundary.point, at.boundary.normal);
  if (!line) return places;
  for (const double end : {pose.before, pose.before + pose.cut.length()})
    if (const std::optional<Through> place = through(pose, at, *line, end)) places.push_back(*place);
  // Sections in planes that meet their block obliquely go on beyond it: they come through before they end.
  const Sweep& row = at.sweep;
  if (row.planes.turns() || !areOblique(row.planes, row.block)) return places;
  const double apart = 2 * at.reach();
  for (const double arc : ownCrossings(pose, at.boundary)) {
    const auto known = [&](const Through& place) { return std::abs(place.arc - arc) < apart; };
    if (std::ranges::any_of(places, known)) continue;
    const Elastica::State state = stateAt(pose, arc);
    places.push_back({pose.frame.toWorld(state.point),
                      pose.frame.directionToWorld({std::cos(state.angle), std::sin(state.angle)}), arc});
  }
  return places;
}

std::optional<Crossing> crossingAt(RowBlades& blades, double level, const BladePose& pose,
                                   const Through& place, const RowBoundary& at) {
  const auto other = beside(blades, level);
  if (!other) return {};
  const Vector3d along =
      onward(blades.sweep(), pose, stateAt(pose, place.arc), place.arc, other->first, other->second);
  Crossing crossing{place.point, place.tangent.cross(along).normalized(), place.tangent,
                    0.5 * at.side * at.kerf.width(place.point)};
  if (!at.kerf.field) return crossing;
  // What stands leans from the middle as the kerf grows along the blade, told of places that it cuts.
  constexpr double kInside = 5;  // mm
  const double inward = place.arc < pose.before + 0.5 * pose.cut.length() ? 1 : -1;
  const auto widthAt = [&](double inside) {
    const double arc = std::clamp(place.arc + inward * inside, 0.0, pose.blade.length());
    return at.kerf.width(pose.frame.toWorld(stateAt(pose, arc).point));
  };
  const double grows = inward * (widthAt(at.reach() + kInside) - widthAt(at.reach())) / kInside;
  crossing.tangent = (place.tangent + 0.5 * at.side * grows * crossing.normal).normalized();
  return crossing;
}

Result<Crossings> endCrossings(const RowBoundary& at, const RunContext& context) {
  const std::vector<BladePose>& poses = at.sweep.poses;
  Crossings crossings;
  RowBlades blades(at.sweep);
  std::array<CrossingLine, 2> lines;  // of the one end of the cuts and of the other
  const auto finish = [&](CrossingLine& line) {
    if (!line.empty()) crossings.lines.push_back(std::exchange(line, {}));
  };
  for (std::size_t i = 0; i < poses.size(); ++i)
    for (int k = 0; k < (i + 1 < poses.size() ? kBetweenStations : 1); ++k) {
      if (context.stopped()) return stoppedError();
      double level = levelOf(at.sweep, poses[i]);
      if (k > 0) level = std::lerp(level, levelOf(at.sweep, poses[i + 1]), double(k) / kBetweenStations);
      const std::optional<BladePose> pose = blades.at(level);
      std::array<bool, 2> comes = {};
      for (const Through& place : pose ? through(*pose, at) : std::vector<Through>()) {
        if (!at.has(place.point)) continue;
        if (const std::optional<Crossing> crossing = crossingAt(blades, level, *pose, place, at)) {
          const std::size_t end = place.arc > pose->before + 0.5 * pose->cut.length() ? 1 : 0;
          lines[end].push_back(*crossing);
          comes[end] = true;
        } else {
          ++crossings.unknown;
          crossings.unknownAt = place.point;
        }
      }
      for (std::size_t end = 0; end < 2; ++end)
        if (!comes[end]) finish(lines[end]);
    }
  for (CrossingLine& line : lines) finish(line);
  return crossings;
}

Crossings rowCrossings(const RowBoundary& at) {
  Crossings crossings;
  const std::vector<BladePose>& poses = at.sweep.poses;
  addEnd(at, true, crossings);
  RowBlades blades(at.sweep);
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    addBetween(at, blades, poses[i], poses[i + 1], false, crossings);
    addBetween(at, blades, poses[i + 1], poses[i], true, crossings);
  }
  addEnd(at, false, crossings);
  return crossings;
}

}  // namespace bw::sweep
