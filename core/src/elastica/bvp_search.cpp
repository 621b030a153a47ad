// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "elastica/bvp_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/work_meter.h"
#include "bw/core/base/units.h"
#include "elastica/bvp_sheets.h"
#include "elastica/bvp_taut.h"
#include "optimise/bracketed_root.h"

namespace bw::elastica {

namespace {

using Eigen::Vector2d;
/// Beyond this phase the start values do not tell the end well.
constexpr double kTaut = 14;
/// Solutions that miss their ends by more, in lengths and rad, hang on digits that no number here has.
constexpr double kLargestMiss = 1e-10;
/// Work (`WorkMeter`) of a node of a sheet, and of its image on one.
constexpr std::int64_t kNodeWork = 20, kImageWork = 2;

std::vector<double> levels(double first, double step, double linear, double last) {
  std::vector<double> result;
  for (double t = first; t < linear; t += step) result.push_back(t);
  for (double t = linear; t < last; t *= 1.3) result.push_back(t);
  return result;
}

/// Collects roots by cells of a grid in (a, t).
class Search {
 public:
  Search(const UnitProblem& problem, std::vector<UnitSolution>& out)
      : problem_(problem), sheets_(problem), out_(out) {}

  void swinging(int maxInflections) {
    const double width = 2 * kPi - sheets_.turning();
    if (!(width > 1e-9)) return;
    constexpr int kAngles = 49;  // odd: where both ends lie equally high the sheets have an edge
    const std::vector<double> ts = levels(0, 0.15, 3.0, 90.0);
    grid(kAngles, ts, [&](int i, double t) {
      // Denser towards the ends, where the pendulum starts or ends at the top.
      const double u = double(i) / (kAngles - 1);
      const double v = std::clamp(u - std::sin(2 * kPi * u) / (2 * kPi) * 0.8, 1e-6, 1 - 1e-6);
      return sheets_.swingingNode(-kPi + v * width, t, kSomeDigits);
    });
    const int most = maxInflections + (hinged() ? 1 : 0);
    for (int n = 1; n <= most; ++n)
      for (const int direction : {1, -1}) cells({n, direction}, false);
  }

  void oneWay() {
    if (hinged() || !(problem_.turning > 1e-12)) return;
    constexpr int kAngles = 65;
    std::vector<double> ts = levels(0.02, 0.2, 3.0, 90.0);
    grid(kAngles, ts, [&](int i, double t) {
      return sheets_.oneWayNode(-kPi + 2 * kPi * i / (kAngles - 1), t, kSomeDigits);
    });
    cells({0, 1}, true);
  }

 private:
  bool hinged() const { return problem_.ends == HeldEnds::start; }

  template <class Make>
  void grid(int angles, const std::vector<double>& ts, Make&& make) {
    columns_ = int(ts.size());
    rows_ = angles;
    nodes_.clear();
    detail::chargeWork(kNodeWork * angles * std::ssize(ts));
    for (int i = 0; i < angles; ++i)
      for (const double t : ts) nodes_.push_back(make(i, t));
  }
  const SheetNode& node(int i, int j) const { return nodes_[std::size_t(i * columns_ + j)]; }

  void cells(const Sheet& sheet, bool oneWay) {
    images_.resize(nodes_.size());
    detail::chargeWork(kImageWork * std::ssize(nodes_));
    for (std::size_t i = 0; i < nodes_.size(); ++i) images_[i] = Sheets::image(nodes_[i], sheet);
    for (int i = 0; i + 1 < rows_; ++i)
      for (int j = 0; j + 1 < columns_; ++j) {
        const std::size_t k = std::size_t(i * columns_ + j);
        const SheetImage* corner[4] = {&images_[k], &images_[k + 1], &images_[k + std::size_t(columns_)],
                                       &images_[k + std::size_t(columns_) + 1]};
        double lowX = INFINITY, highX = -INFINITY, lowY = INFINITY, highY = -INFINITY;
        for (const SheetImage* c : corner) {
          lowX = std::min(lowX, c->x);
          highX = std::max(highX, c->x);
          lowY = std::min(lowY, c->y);
          highY = std::max(highY, c->y);
        }
        const double margin = 0.3 * std::max(highX - lowX, highY - lowY) + 1e-9;
        const double x = problem_.end.x(), y = problem_.end.y();
        if (!(x > lowX - margin && x < highX + margin && y > lowY - margin && y < highY + margin)) continue;
        for (const int half : {0, 1}) {
          const SheetImage& o = half ? *corner[3] : *corner[0];
          const SheetImage& p = half ? *corner[2] : *corner[1];  // along t
          const SheetImage& q = half ? *corner[1] : *corner[2];  // along a
          const double px = p.x - o.x, py = p.y - o.y, qx = q.x - o.x, qy = q.y - o.y;
          const double det = px * qy - py * qx;
          double u = ((x - o.x) * qy - (y - o.y) * qx) / det, v = (px * (y - o.y) - py * (x - o.x)) / det;
          constexpr double kOutside = 0.8;
          const double flat = 0.05 * (std::hypot(px, py) * std::hypot(qx, qy));
          if (std::abs(det) > flat) {
            if (u < -kOutside || v < -kOutside || u + v > 1 + kOutside) continue;
          }
          if (!std::isfinite(u) || !std::isfinite(v)) u = v = 0.3;
          u = std::clamp(u, 0.0, 1.0);
          v = std::clamp(v, 0.0, 1.0);
          const double da = node(i + 1, j).a - node(i, j).a, dt = node(i, j + 1).t - node(i, j).t;
          const double a = half ? node(i + 1, j).a - v * da : node(i, j).a + v * da;
          const double t = half ? node(i, j + 1).t - u * dt : node(i, j).t + u * dt;
          attempt(sheet, oneWay, a, t);
        }
      }
  }

  void attempt(const Sheet& sheet, bool oneWay, double a, double t) {
    if (detail::workExhausted()) return;
    const SheetNode start = node(oneWay, a, t);
    const UnitShape shape = Sheets::shape(start, sheet);
    if (!shape.allFinite()) return;
    const std::optional<UnitSolution> found =
        phaseOf(shape) < kTaut ? settle(problem_, shape, 14, out_) : settleTaut(sheet, oneWay, a, t);
    if (!found) return;
    for (const UnitSolution& other : out_)
      if (sameShape(other.shape, found->shape)) return;
    out_.push_back(*found);
  }

  SheetNode node(bool oneWay, double a, double t) const {
    return oneWay ? sheets_.oneWayNode(a, t) : sheets_.swingingNode(a, t);
  }

  /// Newton's method in the sheet itself, where the force angle and the level keep their digits however taut
  /// the blade is.
  std::optional<UnitSolution> settleTaut(const Sheet& sheet, bool oneWay, double a, double t) const {
    const auto miss = [&](double angle, double level) {
      detail::chargeWork(kNodeWork);
      const SheetImage image = Sheets::image(node(oneWay, angle, level), sheet);
      return Vector2d(image.x - problem_.end.x(), image.y - problem_.end.y());
    };
    constexpr int kRounds = 25;
    constexpr double kDifference = 1e-6;
    const double first = oneWay ? -1e9 : -kPi, last = oneWay ? 1e9 : kPi - sheets_.turning();
    Vector2d r = miss(a, t);
    for (int round = 0; round < kRounds && r.allFinite(); ++round) {
      if (r.norm() < 1e-12) break;
      const double ha = a + kDifference < last ? kDifference : -kDifference;
      const double ht = kDifference * (1 + t);
      const Vector2d da = (miss(a + ha, t) - r) / ha, dt = (miss(a, t + ht) - r) / ht;
      const double det = da.x() * dt.y() - da.y() * dt.x();
      double stepA = -(r.x() * dt.y() - r.y() * dt.x()) / det;
      double stepT = -(da.x() * r.y() - da.y() * r.x()) / det;
      if (!std::isfinite(stepA) || !std::isfinite(stepT)) return std::nullopt;
      const double scale = std::max({std::abs(stepA) / 0.3, std::abs(stepT) / (0.2 + 0.3 * t), 1.0});
      stepA /= scale;
      stepT /= scale;
      const double oldA = a, oldT = t;
      double share = 1;
      Vector2d next = r;
      for (int half = 0; half < 6; ++half, share *= 0.5) {
        a = std::clamp(oldA + share * stepA, first + 1e-12, last - 1e-12);
        t = std::clamp(oldT + share * stepT, 1e-9, 300.0);
        next = miss(a, t);
        if (next.norm() < r.norm()) break;
      }
      if (!(next.norm() < r.norm())) break;
      r = next;
    }
    if (!(r.norm() < 1e-9)) return std::nullopt;
    const SheetNode end = node(oneWay, a, t);
    UnitSolution result;
    result.shape = Sheets::shape(end, sheet);
    result.ends = problem_.ends;
    result.turning = sheets_.turning(end, sheet);
    if (std::abs(end.modulus.excess) > kNearLoop)
      if (const std::optional<UnitSolution> settled = settle(problem_, result.shape, 4);
          settled && sameShape(settled->shape, result.shape))
        return settled;
    result.anchor = Sheets::anchor(end, sheet);
    result.error = missOf(*result.anchor);
    if (!(result.error < kLargestMiss)) return std::nullopt;
    return result;
  }

  /// How far the curve held there is from both grips.
  double missOf(const Elastica::Anchor& anchor) const {
    const Result<Elastica> held = Elastica::makeAnchored(anchor, 1);
    if (!held) return INFINITY;
    const Elastica::State end = held->at(1);
    const double tangent = hinged() ? end.curvature : end.angle - problem_.turning;
    return std::max({held->start().norm(), std::abs(held->startAngle()), (end.point - problem_.end).norm(),
                     std::abs(tangent)});
  }

  static bool sameShape(const UnitShape& a, const UnitShape& b) {
    constexpr double kSame = 1e-6;
    const double size = 1 + std::abs(a(0)) + std::sqrt(std::hypot(a(1), a(2)));
    return std::abs(a(0) - b(0)) < kSame * size && (a - b).tail<2>().norm() < kSame * size * size;
  }

  const UnitProblem& problem_;
  Sheets sheets_;
  std::vector<UnitSolution>& out_;
  int rows_ = 0, columns_ = 0;
  std::vector<SheetNode> nodes_;
  std::vector<SheetImage> images_;
};

UnitSolution mirrorOf(UnitSolution solution) {
  solution.shape = mirrored(solution.shape);
  solution.turning = -solution.turning;
  if (solution.anchor) {
    solution.anchor->point.y() *= -1;
    solution.anchor->angle *= -1;
    solution.anchor->curvature *= -1;
    solution.anchor->force.y() *= -1;
  }
  return solution;
}

/// All shapes with at most `maxInflections` inflections, that of a hinge not counted, that meet the problem.
/// The start holds its tangent.
std::vector<UnitSolution> allShapes(const UnitProblem& problem, int maxInflections) {
  if (detail::workExhausted()) return {};
  const bool mirror = problem.turning < 0;
  const UnitProblem turned = mirror ? problem.mirrored() : problem;
  std::vector<UnitSolution> result;
  Search search(turned, result);
  search.oneWay();
  search.swinging(maxInflections);
  if (mirror)
    for (UnitSolution& solution : result) solution = mirrorOf(solution);
  // So taut that the cells do not reach it.
  for (const TautBends& bends : tautBends(problem)) {
    const std::optional<UnitSolution> taut = tautShape(problem, bends);
    if (!taut) continue;
    const auto known = std::find_if(result.begin(), result.end(), [&](const UnitSolution& other) {
      return (other.shape - taut->shape).norm() < 1e-4 * taut->shape.norm();
    });
    if (known == result.end())
      result.push_back(*taut);
    else
      known->bends = taut->bends;
  }
  return result;
}

}  // namespace

std::vector<UnitSolution> shapesOf(const CheckedProblem& problem, double maxTurning, int maxInflections) {
  std::vector<UnitSolution> result;
  if (problem.ends == HeldEnds::both) {
    for (const double turning : problem.turnings(maxTurning)) {
      const std::vector<UnitSolution> shapes = allShapes({problem.end, turning}, maxInflections);
      result.insert(result.end(), shapes.begin(), shapes.end());
    }
    return result;
  }
  result = problem.ends == HeldEnds::start ? allShapes({problem.end, 0, problem.ends}, maxInflections)
                                           : halfWaves(problem.end.norm(), maxInflections);
  std::erase_if(result, [&](const UnitSolution& shape) { return std::abs(shape.turning) > maxTurning; });
  return result;
}

namespace {

/// 1 − k² = sech² t, so that k → 1 is far away.
Modulus modulusAt(double t) {
  const double sech = 1 / std::cosh(t), tanh = std::tanh(t);
  return {tanh * tanh, -sech * sech};
}

/// A half wave.
struct HalfWave {
  Modulus modulus;
  double time = 0;  ///< √f times half its length
};

/// That whose chord along its force is 1 − `missing` of its length; `missing` in (0, 2) grows with k. Empty
/// where k is 1 to all digits of t.
std::optional<HalfWave> halfWave(double missing) {
  // Far beyond what the digits of 1 − k² tell, on both sides.
  constexpr double kSmallestLevel = 1e-60, kLargestLevel = 300;
  const auto excess = [missing](double t) {
    const PendulumIntegrals half = swing(modulusAt(t));
    return 2 * half.square - missing * half.time;
  };
  if (excess(kLargestLevel) < 0) return std::nullopt;
  const double t = optimise::bracketedRoot(excess, kSmallestLevel, kLargestLevel).high;
  return HalfWave{modulusAt(t), swing(modulusAt(t)).time};
}

/// `count` of them, the first bending to the left for `side` 1, to the right for −1; the chord along the
/// force is `share` of the length.
UnitSolution waves(const HalfWave& wave, double share, int count, double side) {
  const double delta = std::sqrt(-wave.modulus.excess), k = std::sqrt(wave.modulus.square);
  const double swing = kPi - 2 * std::asin(delta);  // the largest angle against the force
  const double root = 2 * count * wave.time, f = root * root;
  const double along = f * (2 * delta * delta - 1), across = f * 2 * k * delta;
  UnitSolution result;
  result.ends = HeldEnds::none;
  result.shape = {0, along, side * across};
  result.turning = count % 2 == 1 ? 2 * side * swing : 0;
  if (-wave.modulus.excess > kNearLoop) return result;
  // Held at the inflection nearest to the middle.
  const int place = count / 2;
  const bool odd = place % 2 == 1;
  Elastica::Anchor anchor;
  anchor.at = double(place) / count;
  anchor.point = anchor.at * share * Eigen::Vector2d(std::cos(swing), side * std::sin(swing));
  anchor.angle = odd ? 2 * side * swing : 0;
  anchor.force = {along, odd ? -side * across : side * across};
  result.anchor = anchor;
  return result;
}

}  // namespace

std::vector<UnitSolution> halfWaves(double distance, int maxInflections) {
  std::vector<UnitSolution> result;
  // The chord lies along the force, or against it: with loops between stretches under tension.
  for (const double sense : {1.0, -1.0}) {
    const std::optional<HalfWave> wave = halfWave(1 - sense * distance);
    if (!wave) continue;
    for (int count = 1; count <= maxInflections + 1; ++count)
      for (const double side : {-sense, sense}) result.push_back(waves(*wave, sense * distance, count, side));
  }
  return result;
}

}  // namespace bw::elastica
