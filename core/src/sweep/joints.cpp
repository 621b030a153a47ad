// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/joints.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bw/core/sweep/block_pieces.h"
#include "sweep/held_blade.h"
#include "sweep/smooth_way.h"

namespace bw {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kParallel = 1e-6;   // sine of an angle
constexpr double kOverlap = 1;       // mm that two faces have in common, at least
constexpr double kNear = 2;          // mm from the boundary at which a cut that ends there may end
constexpr double kSameLevel = 1e-6;  // mm
constexpr double kInset = 0.5;       // mm: rows begin and end this near to the faces that they come through
constexpr int kBetween = 4;          // parts of the way from station to station
constexpr int kAcross = 101;         // places on a cut that meets the one of the next row
constexpr double kStep = 1;          // mm of travel, over which the slope of a surface is taken

double levelOf(const Sweep& sweep, const BladePose& pose) {
  return sweep.planes.direction().dot(pose.frame.origin);
}

bool sameFamily(const PlaneFamily& a, const PlaneFamily& b) {
  return a.direction().cross(b.direction()).norm() < kParallel && a.direction().dot(b.direction()) > 0 &&
         a.frame.x.cross(b.frame.x).norm() < kParallel;
}

/// The blade of a row, with its weight, anywhere on its way.
class RowBlades {
 public:
  explicit RowBlades(const Sweep& sweep) : sweep_(sweep), way_(sweep) {}

  const Sweep& sweep() const { return sweep_; }
  double first() const { return levelOf(sweep_, sweep_.poses.front()); }
  double last() const { return levelOf(sweep_, sweep_.poses.back()); }

  /// At a level, or at the end of the row where that is past it; empty where it is not known.
  std::optional<BladePose> at(double level) {
    const BladePose& front = sweep_.poses.front();
    const double travel =
        std::clamp(level - first() + front.travel, front.travel, sweep_.poses.back().travel);
    const std::size_t i = way_.before(travel);
    for (const std::size_t k : {i, i + 1})
      if (std::abs(sweep_.poses[k].travel - travel) < kSameLevel) return sweep_.poses[k];
    std::optional<BladePose> pose = way_.at(travel);
    if (!pose || sweep_.request.weight.isZero() || sweep::isTaut(*pose)) return pose;
    if (hangingFrom_ != i || !hanging_) {
      hanging_ = sweep::standing(sweep_, sweep_.poses[i]);
      hangingFrom_ = i;
    }
    if (!hanging_) return {};
    const Result<ClampedBranch::Move> move = hanging_->moveTo(sweep::heldAt(sweep_, *pose));
    if (!move || move->snapped) {
      hanging_.reset();
      return {};
    }
    pose->heavy = hanging_->blade();
    return pose;
  }

 private:
  const Sweep& sweep_;
  sweep::SmoothWay way_;
  std::optional<HeavyBranch> hanging_;
  std::size_t hangingFrom_ = 0;
};

Elastica::State stateAt(const BladePose& pose, double s) {
  const std::array<double, 1> arc = {s};
  std::array<Elastica::State, 1> state;
  pose.at(arc, state);
  return state[0];
}

/// Where a blade comes through a boundary, and its tangent there.
struct Through {
  Vector3d point, tangent;
};

/// That of a blade at an end of its cut, where this ends near the boundary.
std::optional<Through> through(const BladePose& pose, const Boundary& boundary, const BoundaryLine& line,
                               double end) {
  constexpr int kSteps = 20;
  constexpr double kAlong = 0.02, kFarthest = 20;  // a blade that runs along the boundary is not followed
  double s = end;
  Elastica::State state = stateAt(pose, s);
  if (std::abs(line.distance(state.point)) > 0.5 * boundary.apart + kNear) return {};
  for (int k = 0; k < kSteps; ++k) {
    const double away = line.distance(state.point);
    const double slope = line.normal.dot(Vector2d(std::cos(state.angle), std::sin(state.angle)));
    if (std::abs(slope) < kAlong) return {};
    if (std::abs(away) < 1e-10) break;
    s = std::clamp(s - away / slope, 0.0, pose.blade.length());
    if (std::abs(s - end) > boundary.apart + kFarthest) return {};
    state = stateAt(pose, s);
  }
  return Through{pose.frame.toWorld(state.point),
                 pose.frame.directionToWorld({std::cos(state.angle), std::sin(state.angle)})};
}

/// Where a blade comes through the boundary at the ends of its cut: at none, one or both of them.
std::vector<Through> through(const BladePose& pose, const Boundary& boundary) {
  std::vector<Through> places;
  const std::optional<BoundaryLine> line = boundaryIn(pose.frame, boundary.point, boundary.normal);
  if (!line) return places;
  for (const double end : {pose.before, pose.before + pose.cut.length()})
    if (const std::optional<Through> place = through(pose, boundary, *line, end)) places.push_back(*place);
  return places;
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
      if (level >= from - kInset && level <= to + kInset) stations.push_back(level);
    }
  std::ranges::sort(stations);
  const auto same = [](double x, double y) { return y - x < kInset; };
  stations.erase(std::unique(stations.begin(), stations.end(), same), stations.end());
  std::vector<std::pair<double, bool>> levels;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    levels.emplace_back(stations[i], true);
    for (int k = 1; k < kBetween && i + 1 < stations.size(); ++k)
      levels.emplace_back(std::lerp(stations[i], stations[i + 1], double(k) / kBetween), false);
  }
  return levels;
}

/// Rows side by side: each plane of theirs meets the boundary in a line.
Result<void> alongside(const Sweep& a, const Sweep& b, const Boundary& boundary, Joint& joint,
                       const RunContext& context) {
  RowBlades mine(a), theirs(b);
  const double from = std::max(mine.first(), theirs.first()), to = std::min(mine.last(), theirs.last());
  for (const auto& [level, isStation] : levelsOf(a, b, from, to)) {
    if (context.stopped()) return stoppedError();
    const std::optional<BladePose> p = mine.at(level), q = theirs.at(level);
    if (!p || !q) continue;
    const std::vector<Through> all = through(*p, boundary), others = through(*q, boundary);
    if (all.empty() && others.empty()) continue;
    // Those that belong together: a surface may come to a boundary twice.
    const Through *x = nullptr, *y = nullptr;
    for (const Through& one : all)
      for (const Through& other : others)
        if (!x || (one.point - other.point).norm() < (x->point - y->point).norm()) {
          x = &one;
          y = &other;
        }
    if (x) {
      note(joint, (x->point - y->point).norm(), between(x->tangent, y->tangent), x->point, isStation);
    } else {
      ++joint.open;
      joint.openAt = all.empty() ? others.front().point : all.front().point;
    }
  }
  return {};
}

/// A cut at the end of a row, as far as the boundary, with the normals of its surface.
struct EndOfRow {
  std::vector<Vector3d> points, normals;
};

/// `front`: where the row begins, else where it ends. Its blade goes on as it goes there.
std::optional<EndOfRow> endOf(const Sweep& sweep, bool front, double level) {
  RowBlades blades(sweep);
  const BladePose& end = front ? sweep.poses.front() : sweep.poses.back();
  const double own = levelOf(sweep, end);
  const std::optional<BladePose> inner = blades.at(front ? own + kStep : own - kStep);
  if (!inner) return {};
  const double step = levelOf(sweep, *inner) - own;
  if (std::abs(step) < 1e-3) return {};
  EndOfRow cut;
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
    cut.points.push_back(end.frame.toWorld(state.point) + (level - own) * along);
    cut.normals.push_back(end.frame.directionToWorld(tangent).cross(along).normalized());
  }
  return cut;
}

/// One row ends where the other one begins.
void inLine(const Sweep& a, const Sweep& b, const Boundary& boundary, Joint& joint) {
  const bool forwards = a.planes.direction().dot(boundary.normal) > 0;
  const double level = a.planes.direction().dot(boundary.point);
  const auto reaches = [&](const Sweep& sweep, bool front) {
    return std::abs(levelOf(sweep, front ? sweep.poses.front() : sweep.poses.back()) - level) <=
           0.5 * boundary.apart + kNear;
  };
  const bool one = reaches(a, !forwards), other = reaches(b, forwards);
  if (!one && !other) return;
  const std::optional<EndOfRow> x = one ? endOf(a, !forwards, level) : std::nullopt,
                                y = other ? endOf(b, forwards, level) : std::nullopt;
  if (!x || !y) {
    if (one && other) return;  // not known
    joint.open = 1;
    joint.openAt = boundary.point;
    return;
  }
  // Each place of the first against the chords of the second.
  for (std::size_t k = 0; k < x->points.size(); ++k) {
    const Vector3d& p = x->points[k];
    double nearest = 1e300, share = 0;
    std::size_t chord = 0;
    for (std::size_t j = 0; j + 1 < y->points.size(); ++j) {
      const Vector3d way = y->points[j + 1] - y->points[j];
      const double at = way.dot(p - y->points[j]) / way.squaredNorm();
      const double s = std::clamp(at, 0.0, 1.0), off = (p - y->points[j] - s * way).norm();
      if (off >= nearest) continue;
      nearest = off;
      share = at;
      chord = j;
    }
    constexpr double kBeyond = 0.5;  // of a chord: past the end of the other cut there is nothing to meet
    if (share < -kBeyond || share > 1 + kBeyond) continue;
    const Vector3d normal = ((1 - share) * y->normals[chord] + share * y->normals[chord + 1]).normalized();
    // Across the surface: the chords lie off the curve by a little.
    const Vector3d foot = y->points[chord] + share * (y->points[chord + 1] - y->points[chord]);
    const Vector3d t0 = y->normals[chord], t1 = y->normals[chord + 1];
    const double sag = share * (1 - share) * 0.5 * (y->points[chord + 1] - y->points[chord]).dot(t1 - t0);
    const double gap = std::abs((p - foot).dot(normal) - sag);
    note(joint, gap, between(x->normals[k], normal), p, true);
  }
}

}  // namespace

std::optional<Boundary> boundaryOf(const Box& first, const Box& second, double apart) {
  const std::array<Vector3d, 3> axes = {first.frame.x, first.frame.y, first.frame.normal};
  // The second box along the axes of the first.
  Vector3d size, low;
  for (int k = 0; k < 3; ++k) {
    const Vector3d turned(axes[std::size_t(k)].dot(second.frame.x), axes[std::size_t(k)].dot(second.frame.y),
                          axes[std::size_t(k)].dot(second.frame.normal));
    Eigen::Index along = 0;
    const double most = turned.cwiseAbs().maxCoeff(&along);
    if (most < 1 - kParallel) return {};
    size(k) = second.size(along);
    low(k) = axes[std::size_t(k)].dot(second.frame.origin - first.frame.origin);
    if (turned(along) < 0) low(k) -= size(k);
  }
  for (int k = 0; k < 3; ++k) {
    const double before = low(k) - first.size(k), after = -(low(k) + size(k));
    const double between = std::max(before, after);
    if (between < -kTouching || between > std::max(apart, kTouching)) continue;
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

std::vector<char> joined(const std::vector<BlockRow>& rows, const std::vector<Box>& blocks, double apart) {
  std::vector<char> has(rows.size(), 0);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = i + 1; j < rows.size(); ++j)
      if (rows[i].surface == rows[j].surface && rows[i].block != rows[j].block &&
          boundaryOf(blocks[i], blocks[j], apart))
        has[i] = has[j] = 1;
  return has;
}

Result<Joints> measureJoints(const std::vector<BlockRow>& rows, const JointRequest& request,
                             const RunContext& context) {
  std::vector<Joint> all;
  std::vector<Boundary> boundaries;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = i + 1; j < rows.size(); ++j) {
      const Sweep &a = *rows[i].sweep, &b = *rows[j].sweep;
      if (rows[i].surface != rows[j].surface || rows[i].block == rows[j].block) continue;
      if (a.poses.size() < 2 || b.poses.size() < 2 || !sameFamily(a.planes, b.planes)) continue;
      if (const std::optional<Boundary> boundary = boundaryOf(a.block, b.block, request.apart)) {
        all.push_back({i, j});
        boundaries.push_back(*boundary);
      }
    }
  const Result<void> ok = parallelFor(context, int(all.size()), [&](int k) {
    Joint& joint = all[std::size_t(k)];
    const Boundary& boundary = boundaries[std::size_t(k)];
    const Sweep &a = *rows[joint.first].sweep, &b = *rows[joint.second].sweep;
    const double along = std::abs(a.planes.direction().dot(boundary.normal));
    if (along > 1 - kParallel)
      inLine(a, b, boundary, joint);
    else
      (void)alongside(a, b, boundary, joint, context);  // a stop is told below
  });
  if (!ok) return tl::unexpected<Error>(ok.error());
  if (context.stopped()) return stoppedError();
  Joints joints;
  for (const Joint& joint : all) {
    if (joint.places == 0 && joint.open == 0) continue;
    joints.joints.push_back(joint);
    const std::string &one = rows[joint.first].block, &other = rows[joint.second].block;
    if (joint.gapMax > request.gap)
      joints.findings.push_back({Severity::warning,
                                 JointGap{one, other, joint.gapMax, request.gap, joint.gapAtStations},
                                 {{}, joint.gapAt},
                                 {}});
    if (joint.kinkMax > request.kink)
      joints.findings.push_back({Severity::warning,
                                 JointKink{one, other, joint.kinkMax, request.kink, joint.kinkAtStations},
                                 {{}, joint.kinkAt},
                                 {}});
    if (joint.open > 0)
      joints.findings.push_back(
          {Severity::warning, JointOpen{one, other, joint.open, joint.places}, {{}, joint.openAt}, {}});
  }
  return joints;
}

}  // namespace bw
