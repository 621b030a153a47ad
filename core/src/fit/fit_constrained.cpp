// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_constrained.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace bw::detail {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kPi = std::numbers::pi;
// A peak of the curvature that stands out by less than this part is covered by the fixed places.
constexpr double kPeakExcess = 1e-11;
// Logarithms of lengths beyond this are no fits.
constexpr double kLargestLogLength = 5;
// Places between the ends of an extended range where the direction of the curve is looked at for a peak.
constexpr int kRangePlaces = 33;
// Places of peaks that are remembered.
constexpr std::size_t kPeaks = 4;
// Distance (lengths of the elastica) by which an end stays off another strand, and part of a bound by which
// the other bounds against self-intersection and on the inflections are kept.
constexpr double kClearance = 1e-6;
// k² of the elastica whose neighbouring loops touch; k = 0.855092407720383.
constexpr double kTouching = 0.855092407720383 * 0.855092407720383;
constexpr int kFootSteps = 12;
constexpr double kFootStep = 0.1;
constexpr double kFootTolerance = 1e-14;
// An elastica whose curvature varies by less than this part is so near to a circle that its peaks are not
// definite.
constexpr double kRound = 1e-3;
// A range longer than this (lengths of the elastica) is no blade any more.
constexpr double kLongestRange = 1000;
// Over a range of so many lengths and more no curve that winds on by more than this (rad) can keep the bound:
// it would only cost time to follow it.
constexpr double kLongRange = 10;
constexpr double kMostWinding = 100;

enum Name {
  kLength,
  kShortest,
  kLongest,
  kStartPoint,
  kEndPoint,
  kStartTangent,
  kEndTangent,
  kCurvatureStart,
  kCurvatureMiddle,
  kCurvatureEnd,
  kCurvaturePeak,
  kPeriods,
  kStrand,
  kTurningLeft,
  kTurningRight,
  kLoops,
  kStartSign,
  kEndSign,
  kPeakPlace  // and the next ones, one a place
};

const char* wordsFor(int name) {
  switch (name) {
    case kLength:
      return "the length";
    case kShortest:
    case kLongest:
      return "the tolerance of the length";
    case kStartPoint:
      return "the start point";
    case kEndPoint:
      return "the end point";
    case kStartTangent:
      return "the start tangent";
    case kEndTangent:
      return "the end tangent";
    case kCurvatureStart:
      return "the curvature bound at the start";
    case kCurvatureMiddle:
      return "the curvature bound in the middle";
    case kCurvatureEnd:
      return "the curvature bound at the end";
    case kCurvaturePeak:
      return "the curvature bound";
    case kPeriods:
      return "the number of periods";
    case kStrand:
    case kTurningLeft:
    case kTurningRight:
    case kLoops:
      return "the absence of self-intersections";
    case kStartSign:
    case kEndSign:
      return "the number of inflections";
    default:
      return name >= kPeakPlace ? "the curvature bound" : "a condition";
  }
}

std::vector<double> withEnds(const std::vector<double>& nodes) {
  std::vector<double> all{-0.5};
  all.insert(all.end(), nodes.begin(), nodes.end());
  all.push_back(0.5);
  return all;
}

// Adds up the model of a sum of squares, row by row.
class Accumulator {
 public:
  void add(double weight, const Vector2d& miss, const std::array<Vector2d, 7>& rows) {
    for (std::size_t i = 0; i < 7; ++i) {
      const Vector2d weighted = weight * rows[i];
      half_[i] += weighted.dot(miss);
      for (std::size_t j = 0; j <= i; ++j) products_[i][j] += weighted.dot(rows[j]);
    }
  }
  void give(LeastSquaresModel& model) const {
    model.half.resize(7);
    model.gaussNewton.resize(7, 7);
    for (std::size_t i = 0; i < 7; ++i) {
      model.half[static_cast<Index>(i)] = half_[i];
      for (std::size_t j = 0; j <= i; ++j) {
        model.gaussNewton(static_cast<Index>(i), static_cast<Index>(j)) = products_[i][j];
        model.gaussNewton(static_cast<Index>(j), static_cast<Index>(i)) = products_[i][j];
      }
    }
  }

 private:
  std::array<double, 7> half_{};
  std::array<std::array<double, 7>, 7> products_{};
};

}  // namespace

VectorXd toVector(const Placement& p) {
  VectorXd v(7);
  v << p.shape, p.logLength, p.angle, p.middle;
  return v;
}

Placement toPlacement(const VectorXd& v) {
  Placement p;
  p.shape = v.head<3>();
  p.logLength = v[3];
  p.angle = v[4];
  p.middle = v.tail<2>();
  return p;
}

// agm(√f, √g) / 2π with inflections, else agm(ω, √−g) / π, where ω² = κ²/4 + (f − f_t)/2 and g = f − ω². The
// mean is differentiated along with its iteration.
Periods periodsOf(const Shape& shape) {
  const double f = shape.tail<2>().norm();
  const Eigen::Vector3d fSlope =
      f > 0 ? Eigen::Vector3d(0, shape[1] / f, shape[2] / f) : Eigen::Vector3d::Zero();
  const double squared = 0.25 * shape[0] * shape[0] + 0.5 * (f - shape[1]);
  const Eigen::Vector3d squaredSlope = Eigen::Vector3d(0.5 * shape[0], -0.5, 0) + 0.5 * fSlope;
  const double g = 0.5 * (f + shape[1]) - 0.25 * shape[0] * shape[0];
  const bool inflectional = g >= 0;
  const double larger = inflectional ? f : squared;
  double a = std::sqrt(larger);
  double b = std::sqrt(std::abs(g));
  if (!(a > 0) || !(b > 0)) return {};
  Eigen::Vector3d aSlope = (inflectional ? fSlope : squaredSlope) / (2 * a);
  Eigen::Vector3d bSlope = (inflectional ? fSlope - squaredSlope : squaredSlope - fSlope) / (2 * b);
  for (int i = 0; i < 40 && std::abs(a - b) > 1e-15 * a; ++i) {
    const double root = std::sqrt(a * b);
    const Eigen::Vector3d rootSlope = (b * aSlope + a * bSlope) / (2 * root);
    aSlope = 0.5 * (aSlope + bSlope);
    a = 0.5 * (a + b);
    bSlope = rootSlope;
    b = root;
  }
  const double factor = 1 / (inflectional ? 2 * kPi : kPi);
  return {a * factor, aSlope * factor};
}

ConstrainedFit::ConstrainedFit(const FitTarget& target, const FitConstraints& constraints, bool tangentNorm)
    : target_(target),
      constraints_(constraints),
      tangentNorm_(tangentNorm),
      nodes_(withEnds(target.s)),
      range_({-0.5, 0.5}),
      between_({}),
      foot_({0.0}) {}

bool ConstrainedFit::objective(const VectorXd& v, LeastSquaresModel* model, double& value) {
  const Shape shape = v.head<3>();
  if (!v.allFinite() || std::abs(v[3]) > kLargestLogLength || !nodes_.evaluate(shape, model != nullptr))
    return false;
  const Vector2d factor = std::exp(v[3]) * direction(v[4]);
  const Vector2d middle = v.tail<2>();
  value = 0;
  Accumulator sums;
  std::array<Vector2d, 7> rows;
  for (std::size_t i = 0; i < target_.size(); ++i) {
    const Vector2d placed = turned(factor, nodes_.point(i + 1));
    const Vector2d miss = placed + middle - target_.point[i];
    value += target_.weight[i] * miss.squaredNorm();
    if (model != nullptr) {
      for (int j = 0; j < 3; ++j)
        rows[static_cast<std::size_t>(j)] = turned(factor, nodes_.pointDerivative(i + 1, j));
      rows[3] = placed;
      rows[4] = quarterTurn(placed);
      rows[5] = Vector2d(1, 0);
      rows[6] = Vector2d(0, 1);
      sums.add(target_.weight[i], miss, rows);
    }
    if (!tangentNorm_) continue;
    const Vector2d tangent = turned(factor, direction(nodes_.angle(i + 1)));
    const Vector2d missed = tangent - target_.tangent[i];
    value += target_.weight[i] * missed.squaredNorm();
    if (model != nullptr) {
      for (int j = 0; j < 3; ++j)
        rows[static_cast<std::size_t>(j)] = quarterTurn(tangent) * nodes_.angleDerivative(i + 1, j);
      rows[3] = tangent;
      rows[4] = quarterTurn(tangent);
      rows[5] = rows[6] = Vector2d::Zero();
      sums.add(target_.weight[i], missed, rows);
    }
  }
  if (model != nullptr) {
    sums.give(*model);
    model->value = value;
  }
  return std::isfinite(value);
}

void ConstrainedFit::endConditions(const VectorXd& v, Conditions& out) {
  const Vector2d factor = std::exp(v[3]) * direction(v[4]);
  for (std::size_t end = 0; end < 2; ++end) {
    if (constraints_.endpoints) {
      const Vector2d placed = turned(factor, ends().point(end));
      const Vector2d miss = placed + v.tail<2>() - (end == 0 ? target_.start : target_.end);
      const Vector2d across = quarterTurn(placed);
      for (int k = 0; k < 2; ++k) {
        auto slope = out.slopes.col(out.add(miss[k], end == 0 ? kStartPoint : kEndPoint));
        for (int j = 0; j < 3; ++j) slope[j] = turned(factor, ends().pointDerivative(end, j))[k];
        slope[3] = placed[k];
        slope[4] = across[k];
        slope[5 + k] = 1;
      }
    }
    if (constraints_.tangents) {
      const double miss = v[4] + ends().angle(end) - (end == 0 ? startAngle_ : endAngle_);
      auto slope = out.slopes.col(out.add(miss, end == 0 ? kStartTangent : kEndTangent));
      for (int j = 0; j < 3; ++j) slope[j] = ends().angleDerivative(end, j);
      slope[4] = 1;
    }
  }
}

bool ConstrainedFit::curvatureBounds(const VectorXd& v, Conditions& out) {
  // At both ends and in the middle, and at a peak of |κ| between them. Three fixed places keep the bound
  // smooth where the elastica is nearly a circle and has no definite peak.
  static constexpr int kPlaces[] = {kCurvatureStart, kCurvatureMiddle, kCurvatureEnd};
  const Shape shape = v.head<3>();
  const double ft = shape[1];
  const double fn = shape[2];
  const auto slopeAt = [&](double angle) { return fn * std::cos(angle) - ft * std::sin(angle); };
  const double scale = std::exp(-v[3]) / *constraints_.maxCurvature;
  const bool extended = constraints_.curvatureRange.has_value();
  // Half the range, in lengths of the elastica.
  const double half = extended ? 0.5 * *constraints_.curvatureRange * std::exp(-v[3]) : 0.5;
  if (!(half <= 0.5 * kLongestRange)) return false;
  if (half > 0.5 * kLongRange && half * (std::abs(shape[0]) + std::sqrt(std::hypot(ft, fn))) > kMostWinding)
    return false;
  ShapeEvaluator& whole = extended ? range_ : nodes_;
  if (extended) range_.moveTo({-half, half});
  if (!whole.evaluate(shape, true)) return false;
  const ShapeEnds ends(whole);
  double highest = 0;
  for (int place = 0; place < 3; ++place) {
    const auto end = static_cast<std::size_t>(place / 2);
    const double kappa = place == 1 ? shape[0] : ends.state(end).curvature;
    const double sign = kappa < 0 ? -1 : 1;
    auto slope = out.slopes.col(out.add(std::abs(kappa) * scale - 1, kPlaces[place]));
    for (int j = 0; j < 3; ++j)
      slope[j] = sign * scale * (place == 1 ? (j == 0 ? 1.0 : 0.0) : ends.curvatureDerivative(end, j));
    slope[3] = -std::abs(kappa) * scale;
    // A range of fixed length covers less of a longer elastica.
    if (extended && place != 1)
      slope[3] += sign * scale * slopeAt(ends.angle(end)) * (place == 0 ? half : -half);
    highest = std::max(highest, std::abs(kappa));
  }
  // κ' = f_n cos ψ − f_t sin ψ changes sign where the tangent runs with the force. The height of the peak is
  // known in closed form, κ_peak² = κ² + 2 (f − f_t).
  if (extended) {
    std::vector<double> places;
    for (int i = 1; i + 1 < kRangePlaces; ++i) places.push_back(half * (2.0 * i / (kRangePlaces - 1) - 1));
    between_.moveTo(std::move(places));
  }
  ShapeEvaluator& between = extended ? between_ : nodes_;
  if (!between.evaluate(shape, false)) return false;
  double before = slopeAt(ends.angle(0));
  double placeBefore = ends.arc(0);
  bool peak = false;
  double peakPlace = 0;
  for (std::size_t i = 0; i <= between.size() && !peak; ++i) {
    const double angle = i < between.size() ? between.angle(i) : ends.angle(1);
    const double place = i < between.size() ? between.arc(i) : ends.arc(1);
    const double here = slopeAt(angle);
    peak = before * here < 0 && ft * std::cos(angle) + fn * std::sin(angle) > 0;
    if (peak) peakPlace = placeBefore + (place - placeBefore) * before / (before - here);
    before = here;
    placeBefore = place;
  }
  const double f = std::hypot(ft, fn);
  const double height = std::sqrt(std::max(0.0, shape[0] * shape[0] + 2 * (f - ft)));
  if (peak && f > 0 && height > highest * (1 + kPeakExcess)) {
    auto slope = out.slopes.col(out.add(height * scale - 1, kCurvaturePeak));
    slope[0] = scale * shape[0] / height;
    slope[1] = scale * (ft / f - 1) / height;
    slope[2] = scale * (fn / f) / height;
    slope[3] = -height * scale;
    // On a circle there is no peak, but every small change may raise one. Where one was met on the way, the
    // bound is kept from then on.
    const double part = peakPlace / half;
    if (height * scale > 1 &&
        std::none_of(peaks_.begin(), peaks_.end(), [&](double p) { return std::abs(p - part) < 1e-9; })) {
      if (peaks_.size() < kPeaks)
        peaks_.push_back(part);
      else
        peaks_[nextPeak_++ % kPeaks] = part;
    }
  }
  if (f * half > kRound * highest) return true;
  for (std::size_t i = 0; i < peaks_.size(); ++i) {
    foot_.moveTo({peaks_[i] * half});
    if (!foot_.evaluate(shape, true)) return false;
    const double kappa = foot_.state(0).curvature;
    const double sign = kappa < 0 ? -1 : 1;
    auto slope = out.slopes.col(out.add(std::abs(kappa) * scale - 1, kPeakPlace + static_cast<int>(i)));
    for (int j = 0; j < 3; ++j) slope[j] = sign * scale * foot_.curvatureDerivative(0, j);
    slope[3] = -std::abs(kappa) * scale;
    if (extended) slope[3] -= sign * scale * slopeAt(foot_.angle(0)) * peaks_[i] * half;
  }
  return true;
}

// What keeps an elastica from meeting itself or from having too many inflections.
bool ConstrainedFit::shapeBounds(const VectorXd& v, Conditions& out) {
  const Shape shape = v.head<3>();
  if (constraints_.strand) {
    const FitConstraints::Strand& strand = *constraints_.strand;
    const std::size_t end = strand.atStart ? 0 : 1;
    // The foot of the end on the other strand, by Newton's method.
    double place = strand.place;
    for (int step = 0; step < kFootSteps; ++step) {
      foot_.moveTo({place});
      if (!foot_.evaluate(shape, false)) return false;
      const Vector2d away = ends().point(end) - foot_.point(0);
      const Vector2d along = direction(foot_.angle(0));
      const double slope = 1 - foot_.state(0).curvature * quarterTurn(along).dot(away);
      const double move = std::clamp(away.dot(along) / std::max(slope, 0.3), -kFootStep, kFootStep);
      place = std::clamp(place + move, -0.5, 0.5);
      if (std::abs(move) < kFootTolerance) break;
    }
    foot_.moveTo({place});
    if (!foot_.evaluate(shape, true)) return false;
    const Vector2d normal = strand.side * quarterTurn(direction(foot_.angle(0)));
    const Vector2d away = ends().point(end) - foot_.point(0);
    auto slope = out.slopes.col(out.add(kClearance - normal.dot(away), kStrand));
    for (int j = 0; j < 3; ++j)
      slope[j] = -normal.dot(ends().pointDerivative(end, j) - foot_.pointDerivative(0, j));
  }
  if (constraints_.maxTurning) {
    const double turning = ends().angle(1) - ends().angle(0);
    for (const double sign : {1.0, -1.0}) {
      const double value = sign * turning / *constraints_.maxTurning - 1 + kClearance;
      auto slope = out.slopes.col(out.add(value, sign > 0 ? kTurningLeft : kTurningRight));
      for (int j = 0; j < 3; ++j)
        slope[j] =
            sign * (ends().angleDerivative(1, j) - ends().angleDerivative(0, j)) / *constraints_.maxTurning;
    }
  }
  if (constraints_.openLoops) {
    // ω² ≤ k² f, in units in which it is of order one.
    const double f = shape.tail<2>().norm();
    const double bound = kTouching * (1 - kClearance);
    const double size = 10;
    auto slope = out.slopes.col(
        out.add((0.25 * shape[0] * shape[0] + 0.5 * (f - shape[1]) - bound * f) / size, kLoops));
    slope[0] = 0.5 * shape[0] / size;
    slope[1] = -0.5 / size;
    if (f > 0) {
      slope[1] += (0.5 - bound) * shape[1] / f / size;
      slope[2] += (0.5 - bound) * shape[2] / f / size;
    }
  }
  for (std::size_t end = 0; end < 2; ++end) {
    const double sign = end == 0 ? constraints_.startSign : constraints_.endSign;
    if (sign == 0) continue;
    auto slope = out.slopes.col(
        out.add(kClearance - sign * ends().state(end).curvature, end == 0 ? kStartSign : kEndSign));
    for (int j = 0; j < 3; ++j) slope[j] = -sign * ends().curvatureDerivative(end, j);
  }
  return true;
}

bool ConstrainedFit::conditions(const VectorXd& v, Conditions& out) {
  out.clear(7);
  if (!constraints_.equalities() && !constraints_.bounds()) return true;
  const Shape shape = v.head<3>();
  if (!v.allFinite() || std::abs(v[3]) > kLargestLogLength || !nodes_.evaluate(shape, true)) return false;
  const bool tolerant = constraints_.lengthTolerance > 0;
  if (constraints_.length && !tolerant)
    out.slopes(3, out.add(v[3] - std::log(*constraints_.length), kLength)) = 1;
  endConditions(v, out);
  out.equalities = out.size();
  if (constraints_.length && tolerant) {
    const double shortest = *constraints_.length - constraints_.lengthTolerance;
    if (shortest > 0) out.slopes(3, out.add(std::log(shortest) - v[3], kShortest)) = -1;
    const double longest = *constraints_.length + constraints_.lengthTolerance;
    out.slopes(3, out.add(v[3] - std::log(longest), kLongest)) = 1;
  }
  if (constraints_.maxCurvature && !curvatureBounds(v, out)) return false;
  if (constraints_.maxPeriods) {
    const Periods periods = periodsOf(shape);
    auto slope = out.slopes.col(out.add(periods.count / *constraints_.maxPeriods - 1, kPeriods));
    slope.head<3>() = periods.slope / *constraints_.maxPeriods;
  }
  return shapeBounds(v, out);
}

void ConstrainedFit::chooseBranch(const Placement& placement) {
  startAngle_ = target_.startAngle;
  endAngle_ = target_.endAngle;
  if (!nodes_.evaluate(placement.shape, false)) return;
  startAngle_ += 2 * kPi * std::round((placement.angle + ends().angle(0) - startAngle_) / (2 * kPi));
  endAngle_ += 2 * kPi * std::round((placement.angle + ends().angle(1) - endAngle_) / (2 * kPi));
}

double ConstrainedFit::violation(const Placement& placement) {
  chooseBranch(placement);
  Conditions all;
  return conditions(toVector(placement), all) ? largestViolation(all).size : 1;
}

Stationarity ConstrainedFit::stationarity(const Placement& placement, const std::vector<double>& peaks) {
  chooseBranch(placement);
  peaks_ = peaks;
  const VectorXd v = toVector(placement);
  LeastSquaresModel model;
  double value = 0;
  Conditions all;
  if (!objective(v, &model, value) || !conditions(v, all)) return {1, 1, 1};
  return stationarityOf(model, all, kActive);
}

ConstrainedFit::Solution ConstrainedFit::solve(const Placement& start) {
  chooseBranch(start);
  peaks_.clear();
  nextPeak_ = 0;
  const Descent descent = descend(*this, toVector(start));
  Solution out;
  out.placement = toPlacement(descent.v);
  out.value = descent.value;
  out.iterations = descent.iterations;
  out.feasible = descent.feasible;
  out.converged = descent.converged;
  out.boundActive = descent.boundActive;
  out.violation = descent.violation;
  out.worst = wordsFor(descent.worst);
  out.peaks = peaks_;
  return out;
}

}  // namespace bw::detail
