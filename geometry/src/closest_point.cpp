// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "model_impl.h"

#include <algorithm>
#include <cmath>

#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr int kIterations = 40;
constexpr int kHalvings = 12;
constexpr double kAccuracy = 1e-7;    // mm, of the foot
constexpr double kConvexBoth = 1e-9;  // of E G: a smaller determinant of the Hessian is rounding
constexpr double kBow = 1e-3;         // of an edge's size: so far it may leave the chords of its samples
constexpr double kLongestLast =
    0.01;  // mm; a longer step is never the last: the jet tells no more of the surface

struct Range {
  double low, high;
  bool wraps;
  double clamp(double t) const {
    if (!wraps) return std::clamp(t, low, high);
    const double period = high - low;
    return t - period * std::floor((t - low) / period);
  }
  /// True if `clamp` leaves the place on the surface as it is.
  bool reaches(double t) const { return wraps || (t >= low && t <= high); }
  /// True if the minimum is held back at an end of the range.
  bool holds(double t, double slope) const {
    return !wraps && ((t <= low && slope > 0) || (t >= high && slope < 0));
  }
};

/// A step of Newton's method in parameters, and what it leaves.
struct Step {
  double u = 0, v = 0;
  double error = 1e300;  ///< mm, about what is left after it; large where it is no step of Newton's
};

/// How far from the foot a full Newton step ends: the jet tells the third derivatives of |S − p|² but for
/// those of S, and `convexity`, the smallest eigenvalue of its Hessian against the first fundamental form,
/// divides them (docs/mathematics.md, closest points).
double newtonError(const Jet& jet, const Step& step, double distance, double E, double G, double convexity) {
  if (!(convexity > 0)) return 1e300;
  const double length2 = E * step.u * step.u + G * step.v * step.v;
  if (length2 > kLongestLast * kLongestLast) return 1e300;
  const double bend = std::max({jet.duu.norm() / E, jet.dvv.norm() / G, jet.duv.norm() / std::sqrt(E * G)});
  return 2 * bend * (1 + distance * bend) * length2 / convexity;
}

/// Newton's method on |S(u, v) − p|² within the rectangle of the face, damped; place and first derivatives of
/// `jet` are left at the foot.
Eigen::Vector2d descend(const FaceGeometry& face, const Eigen::Vector3d& p, Eigen::Vector2d uv, Jet& jet) {
  const SurfacePatch& patch = face.patch();
  const Range ru{face.u0(), face.u1(), face.wrapsU()}, rv{face.v0(), face.v1(), face.wrapsV()};
  uv = {ru.clamp(uv.x()), rv.clamp(uv.y())};
  patch.second(uv.x(), uv.y(), jet);
  Eigen::Vector3d r = jet.p - p;
  double f = r.squaredNorm();
  for (int k = 0; k < kIterations; ++k) {
    const double gu = r.dot(jet.du), gv = r.dot(jet.dv);
    const double E = jet.du.squaredNorm(), F = jet.du.dot(jet.dv), G = jet.dv.squaredNorm();
    double huu = E + r.dot(jet.duu), huv = F + r.dot(jet.duv), hvv = G + r.dot(jet.dvv);
    const bool holdU = ru.holds(uv.x(), gu), holdV = rv.holds(uv.y(), gv);
    if (holdU && holdV) break;
    Step step;
    double convexity = 0;
    if (holdU) {
      convexity = hvv / G;
      step.v = -gv / (hvv > kConvex * G ? hvv : std::max(G, kVanishing));
    } else if (holdV) {
      convexity = huu / E;
      step.u = -gu / (huu > kConvex * E ? huu : std::max(E, kVanishing));
    } else {
      double det = huu * hvv - huv * huv;
      if (!(huu > 0) ||
          !(det > kConvexBoth * E * G)) {  // not convex here: the first fundamental form leads downhill
        huu = E * (1 + kConvexBoth) + kVanishing;
        huv = F;
        hvv = G * (1 + kConvexBoth) + kVanishing;
        det = huu * hvv - huv * huv;
      } else {
        convexity = det / (huu * G + hvv * E);  // below the smaller eigenvalue: product over sum
      }
      step.u = -(hvv * gu - huv * gv) / det;
      step.v = -(huu * gv - huv * gu) / det;
    }
    // No further than a third of the face at once.
    const double longest =
        std::max(std::abs(step.u) / (ru.high - ru.low), std::abs(step.v) / (rv.high - rv.low));
    if (longest > 0.34) {
      step.u *= 0.34 / longest;
      step.v *= 0.34 / longest;
    }
    // Where a border cuts one parameter short the other one goes to where it is best there: as far as the
    // whole step has it, it might lead away.
    const bool shortU = !ru.reaches(uv.x() + step.u), shortV = !rv.reaches(uv.y() + step.v);
    if (shortU && !shortV && hvv > 0) {
      step.u = ru.clamp(uv.x() + step.u) - uv.x();
      step.v = -(gv + huv * step.u) / hvv;
    } else if (shortV && !shortU && huu > 0) {
      step.v = rv.clamp(uv.y() + step.v) - uv.y();
      step.u = -(gu + huv * step.v) / huu;
    }
    const bool tiny = (step.u * jet.du + step.v * jet.dv).squaredNorm() < kAccuracy * kAccuracy;
    step.error = newtonError(jet, step, std::sqrt(f), E, G, convexity);
    bool moved = false, arrived = tiny;
    for (int h = 0; h < (tiny ? 1 : kHalvings); ++h) {
      const Eigen::Vector2d next(ru.clamp(uv.x() + step.u), rv.clamp(uv.y() + step.v));
      // A step that a border cuts short has not come to the foot.
      const bool last = h == 0 && step.error < kAccuracy && !shortU && !shortV;
      Jet trial;
      if (last || tiny)
        patch.first(next.x(), next.y(), trial);
      else
        patch.second(next.x(), next.y(), trial);
      const Eigen::Vector3d rt = trial.p - p;
      const double ft = rt.squaredNorm();
      if (ft <= f) {
        moved = next != uv;
        arrived = arrived || last;
        uv = next;
        jet = trial;
        r = rt;
        f = ft;
        break;
      }
      step.u *= 0.5;
      step.v *= 0.5;
    }
    if (arrived || !moved) break;
  }
  return uv;
}

/// The parameter of the point of an edge nearest to `p`, if it is nearer than `limit`.
bool footOnEdge(const EdgeGeometry& edge, const Eigen::Vector3d& p, double& limit, double& at,
                Eigen::Vector3d& point) {
  if (edge.degenerate() || edge.points.size() < 2) return false;
  const Eigen::Vector3d outside = (edge.bounds.min - p).cwiseMax(p - edge.bounds.max).cwiseMax(0.0);
  const double slack = kBow * edge.bounds.size().norm();
  if (outside.norm() > limit + slack) return false;
  double best2 = 1e300;
  for (std::size_t i = 1; i < edge.points.size(); ++i) {
    const Eigen::Vector3d &a = edge.points[i - 1], &b = edge.points[i];
    const double s = nearestOnSegment(p, a, b);
    const double d2 = (a + s * (b - a) - p).squaredNorm();
    if (d2 < best2) {
      best2 = d2;
      at = edge.t[i - 1] + s * (edge.t[i] - edge.t[i - 1]);
    }
  }
  if (std::sqrt(best2) > limit + slack) return false;
  Eigen::Vector3d d1, d2;
  for (int k = 0; k < 20; ++k) {
    edge.second(at, point, d1, d2);
    const Eigen::Vector3d r = point - p;
    const double speed2 = d1.squaredNorm();
    const double bend = speed2 + r.dot(d2);
    const double step = -r.dot(d1) / (bend > kConvex * speed2 ? bend : std::max(speed2, kVanishing));
    const double next = std::clamp(at + step, edge.first, edge.last);
    const double moved = std::abs(next - at) * std::sqrt(speed2);
    at = next;
    if (moved < kNoLength) break;
  }
  point = edge.value(at);
  const double distance = (point - p).norm();
  if (distance >= limit) return false;
  limit = distance;
  return true;
}

}  // namespace

FaceFoot footOnSurface(const FaceGeometry& face, const Eigen::Vector3d& p, const Eigen::Vector2d& start) {
  FaceFoot foot;
  Jet jet;
  foot.uv = descend(face, p, start, jet);
  foot.point = jet.p;
  foot.distance = (jet.p - p).norm();
  foot.normal = face.normal(jet);
  return foot;
}

FaceFoot footOnFace(const FaceGeometry& face, const std::vector<EdgeGeometry>& edges,
                    const Eigen::Vector3d& p, const Eigen::Vector2d& start) {
  FaceFoot foot = footOnSurface(face, p, start);
  // A start that is off the end by rounding may stay there.
  const double slackU = kSameSize * (face.u1() - face.u0()), slackV = kSameSize * (face.v1() - face.v0());
  const bool low[2] = {foot.uv.x() <= face.u0() + slackU, foot.uv.y() <= face.v0() + slackV};
  const bool high[2] = {foot.uv.x() >= face.u1() - slackU, foot.uv.y() >= face.v1() - slackV};
  const bool wraps[2] = {face.wrapsU(), face.wrapsV()};
  if (face.natural()) {
    for (int k = 0; k < 2; ++k) {
      if (wraps[k] || !(low[k] || high[k])) continue;
      foot.onBorder = true;
      const int side = 2 * k + (high[k] ? 1 : 0);
      // A side may be of several edges, some of which other faces share: the nearest of them.
      double nearest = 1e300, at = 0;
      Eigen::Vector3d point;
      for (const TrimEdge& trim : face.trims())
        if (trim.side == side && trim.edge >= 0 &&
            footOnEdge(edges[trim.edge], foot.point, nearest, at, point))
          foot.edge = trim.edge;
    }
    return foot;
  }
  // Where the face touches the end of its parameters, Newton's method stops on the border itself.
  const bool stopped = (!wraps[0] && (low[0] || high[0])) || (!wraps[1] && (low[1] || high[1]));
  const bool inside = face.contains(foot.uv);
  if (inside && !stopped) return foot;
  FaceFoot border;
  border.onBorder = true;
  for (const TrimEdge& trim : face.trims()) {
    double at = 0;
    Eigen::Vector3d point;
    if (trim.edge < 0 || !footOnEdge(edges[trim.edge], p, border.distance, at, point)) continue;
    border.point = point;
    border.edge = trim.edge;
    border.uv = face.wrapped(trim.value(std::clamp(at, trim.first, trim.last)));
  }
  if (border.edge < 0 || (inside && foot.distance < border.distance)) {
    foot.onBorder = stopped;
    foot.edge = border.edge;
    return foot;
  }
  return border;
}

}  // namespace bw::geometry
