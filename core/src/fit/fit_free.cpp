// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/work_meter.h"
#include "fit/fit_constrained.h"
#include "fit/fit_search.h"
#include "fit/piece_table.h"

namespace bw::fit {
namespace {

using Eigen::Vector2d;

// What the squares of a unit tangent that is missed at an end and of the logarithm of a missed length weigh
// against squares of distances.
constexpr double kTangentWeight = 0.01;
constexpr double kLengthWeight = 0.1;
// A place whose distance (root mean square) is larger than the first times a known one's and the second is
// not tried: without ends, with ends or tangents. Of some thousand curves none was improved by a place
// beyond.
struct Reach {
  double factor, step;
};
constexpr Reach kFreeReach{1.15, 0.002}, kHeldReach{1.5, 0.01};
// Pieces have up to so many inflections more than the target: as a rule, and with ends and tangents, where
// small waves may lie nearer than a taut blade.
constexpr int kMoreInflections = 2, kMoreHeld = 7;
// A place beside a nearer one of another length counts as so many times as far (squared): most often both
// lead to the same end.
constexpr double kBesideNearer = 1.5;
// Pieces that a descent could not take up are left out: force, curvature at the middle, length, and chord
// over length.
constexpr double kLargestForce = 2000;
constexpr double kLargestCurvature = 50;
constexpr double kShortest = 0.4, kLongest = 2.5;
constexpr double kShortestChord = 1e-3;
constexpr double kSamePeriods = 0.01;
// Pieces in a unit of work (`WorkMeter`).
constexpr int kPiecesPerUnit = 3;

// The point of the target at an arc length, by the tangents of the nodes `i` − 1 and `i` around it.
Vector2d pointBetween(const FitTarget& target, std::size_t i, double s) {
  const auto beyond = [&](std::size_t k) -> Vector2d {
    return target.point[k] + (s - target.s[k]) * target.tangent[k];
  };
  if (i == 0) return beyond(0);
  if (i == target.size()) return beyond(i - 1);
  const double h = target.s[i] - target.s[i - 1], u = (s - target.s[i - 1]) / h, v = 1 - u;
  return v * v * (1 + 2 * u) * target.point[i - 1] + u * u * (1 + 2 * v) * target.point[i] +
         h * u * v * (v * target.tangent[i - 1] - u * target.tangent[i]);
}

CurvePoints pointsOf(const FitTarget& target) {
  std::size_t i = 0;
  return CurvePoints([&](double s) {
    while (i < target.size() && target.s[i] < s) ++i;
    return pointBetween(target, i, s);
  });
}

struct Laid {
  Vector2d factor = Vector2d::Zero(), offset = Vector2d::Zero();
  double value = std::numeric_limits<double>::infinity();
};

class Layer {
 public:
  Layer(const FitTarget& target, const FitConstraints& constraints)
      : target_(target),
        constraints_(constraints),
        goal_(pointsOf(target)),
        start_(direction(target.startAngle)),
        end_(direction(target.endAngle)) {}

  Laid lay(const ElasticaPiece& piece) const {
    Laid out;
    if (piece.shape.tail<2>().norm() > kLargestForce || std::abs(piece.shape[0]) > kLargestCurvature)
      return out;
    const CurvePoints& points = piece.points;
    // conj(z) r in the mean.
    const Vector2d product = Vector2d(points.x.dot(goal_.x) + points.y.dot(goal_.y),
                                      points.x.dot(goal_.y) - points.y.dot(goal_.x)) /
                             CurvePoints::kCount;
    double extra = 0;
    if (constraints_.endpoints) {
      const Vector2d chord = piece.end - piece.start;
      if (!(chord.norm() > kShortestChord)) return out;
      out.factor = turnedBack(chord, target_.end - target_.start) / chord.squaredNorm();
      out.offset = target_.start - turned(out.factor, piece.start);
    } else {
      out.factor = product / points.square;
      if (constraints_.length) out.factor *= *constraints_.length / out.factor.norm();
      out.offset = goal_.mean;
    }
    const double square = out.factor.squaredNorm();
    if (!(square > kShortest * kShortest && square < kLongest * kLongest)) return Laid();
    if (constraints_.endpoints && constraints_.length) {
      const double miss = 0.5 * std::log(square) - std::log(*constraints_.length);
      extra += kLengthWeight * miss * miss;
    }
    if (constraints_.tangents) {
      const Vector2d turn = out.factor / std::sqrt(square);
      extra += kTangentWeight * ((turned(turn, piece.startTangent) - start_).squaredNorm() +
                                 (turned(turn, piece.endTangent) - end_).squaredNorm());
    }
    out.value = square * points.square + goal_.square - 2 * out.factor.dot(product) +
                (out.offset - goal_.mean).squaredNorm() + extra;
    return out;
  }

  AtlasPlace place(const ElasticaPiece& piece, bool besideNearer) const {
    const Laid laid = lay(piece);
    AtlasPlace out;
    out.value = laid.value;
    out.order = besideNearer ? kBesideNearer * laid.value : laid.value;
    out.held = constraints_.endpoints || constraints_.tangents;
    out.placement.shape = piece.shape;
    out.placement.logLength = std::log(laid.factor.norm());
    out.placement.angle = std::atan2(laid.factor.y(), laid.factor.x());
    out.placement.middle = turned(laid.factor, piece.middle) + laid.offset;
    return out;
  }

 private:
  const FitTarget& target_;
  const FitConstraints& constraints_;
  CurvePoints goal_;
  Vector2d start_, end_;  ///< the target's tangents there
};

}  // namespace

bool hopeless(const AtlasPlace& place, double knownValue) {
  const Reach& reach = place.held ? kHeldReach : kFreeReach;
  return std::sqrt(place.value) > reach.factor * std::sqrt(knownValue) + reach.step;
}

std::vector<AtlasPlace> placesFromAtlas(const FitTarget& target, const FitConstraints& constraints,
                                        std::size_t most) {
  const Layer layer(target, constraints);
  const bool held = constraints.endpoints && constraints.tangents;
  const double longest = 0.5 * (target.inflections() + (held ? kMoreHeld : kMoreInflections));
  const std::vector<PieceSheet>& table = pieceTable();
  std::vector<double> values(table.back().first + table.back().pieces.size(),
                             std::numeric_limits<double>::infinity());
  for (const PieceSheet& sheet : table) {
    if (sheet.periods > longest + kSamePeriods) continue;
    detail::chargeWork(static_cast<std::int64_t>(sheet.pieces.size()) / kPiecesPerUnit);
    for (std::size_t i = 0; i < sheet.pieces.size(); ++i)
      values[sheet.first + i] = layer.lay(sheet.pieces[i]).value;
  }
  std::vector<AtlasPlace> places;
  for (const PieceSheet& sheet : table) {
    const std::size_t count = sheet.pieces.size(), columns = sheet.columns;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = sheet.first + i, column = i % columns, row = at - column;
      if (!std::isfinite(values[at])) continue;
      const auto nearer = [&](std::size_t j) {
        return values[j] < values[at] || (values[j] == values[at] && j < at);
      };
      if (i >= columns && nearer(at - columns)) continue;
      if (i + columns < count && nearer(at + columns)) continue;
      if ((sheet.cyclic || column > 0) && nearer(row + (column + columns - 1) % columns)) continue;
      if ((sheet.cyclic || column + 1 < columns) && nearer(row + (column + 1) % columns)) continue;
      const bool beside = (sheet.shorter && nearer(at - count)) || (sheet.longer && nearer(at + count));
      places.push_back(layer.place(sheet.pieces[i], beside));
    }
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const AtlasPlace& a, const AtlasPlace& b) { return a.order < b.order; });
  if (places.size() > most) places.resize(most);
  return places;
}
namespace {

// A fit is better than another if its value is lower by more than this part.
constexpr double kSame = 1e-9;

// Fits without constraints: three unknowns.
class FreeFit {
 public:
  FreeFit(const FitTarget& target, const FitObjective& objective) : projected_(target, objective) {}

  // Starts by how near they are to the target.
  std::vector<Shape> sorted(const std::vector<Shape>& starts) const {
    std::vector<std::pair<double, Shape>> order;
    for (const Shape& shape : starts) {
      const std::optional<double> value = projected_.roughValue(shape);
      if (value) order.emplace_back(*value, shape);
    }
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Shape> out;
    for (const auto& [value, shape] : order) out.push_back(shape);
    return out;
  }

  // Descends from a start and keeps the result if it is better than the best so far.
  void attempt(const Shape& start) {
    const auto solution = projected_.solve(start, best_ ? &*best_ : nullptr);
    if (!solution) return;
    iterations_ += solution->iterations;
    if (!best_ || solution->value < best_->value * (1 - kSame)) best_ = solution;
  }

  // The same if the place is worth it.
  void attempt(const AtlasPlace& place) {
    if (!best_ || !hopeless(place, best_->value)) attempt(place.placement.shape);
  }

  // True if the best so far has more half periods than this.
  bool wavesMoreThan(int halfPeriods) const {
    return best_ && halfPeriodsOf(best_->placement.shape) > halfPeriods;
  }

  bool wanted(const StartRule& rule) const { return !best_ || best_->value > rule.limit(); }

  // The best so far, and the work of all descents.
  std::optional<FitSolution> best() const {
    std::optional<FitSolution> best = best_;
    if (best) best->iterations = iterations_;
    return best;
  }

 private:
  ProjectedFit projected_;
  std::optional<FitSolution> best_;
  int iterations_ = 0;
};

}  // namespace

std::optional<FitSolution> freeFit(const FitTarget& full, const FitTarget& coarse,
                                   const FitObjective& objective, const std::vector<Shape>& shapes,
                                   bool more) {
  FreeFit free(coarse, objective);
  if (!more) {
    free.attempt(shapes.front());
    return free.best();
  }
  for (const Shape& start : free.sorted(shapes)) {
    free.attempt(start);
    if (!free.wanted(starts::kGuesses)) break;
  }
  if (objective.norm != FitNorm::L2 && free.wanted(starts::kSimpleShapes)) {
    const Shape simple[] = {
        {coarse.endAngle - coarse.startAngle, 0, 0}, {0, 0, 0}, {0, -10, 20}, {0, -10, -20}};
    for (const Shape& shape : simple) free.attempt(shape);
  }
  if (free.wanted(starts::kAtlas) ||
      (free.wanted(starts::kAtlasOfWaves) &&
       (coarse.inflections() > starts::kFewInflections || free.wavesMoreThan(coarse.inflections() + 1)))) {
    FitConstraints constraints;
    constraints.length = objective.fixedLength;
    for (const AtlasPlace& place : placesFromAtlas(coarse, constraints, starts::kAtlas.most))
      free.attempt(place);
  }
  std::optional<FitSolution> best = free.best();
  if (!best || &full == &coarse) return best;
  FreeFit fine(full, objective);
  fine.attempt(best->placement.shape);
  if (std::optional<FitSolution> refined = fine.best()) {
    refined->iterations += best->iterations;
    best = refined;
  }
  return best;
}

}  // namespace bw::fit
