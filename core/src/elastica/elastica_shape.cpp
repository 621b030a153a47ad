// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/gauss_legendre.h"
#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica.h"
#include "elastica/elastica_flow.h"
#include "optimise/bracketed_root.h"

namespace bw {

namespace {

using elastica::ElasticaInvariants;
using elastica::forEachPiece;
using elastica::ScaledElastica;
using Flow = elastica::ElasticaFlow<0>;
using Block = Flow::Block;

using elastica::kNegligible;

double peakCurvature(const ElasticaInvariants& known) { return 2 * known.halfPeakCurvature; }

}  // namespace

double Elastica::energy() const {
  const ScaledElastica scaled = elastica::scaled(*this);
  constexpr int kNodes = 12;
  const detail::GaussRule rule = detail::gaussRule(kNodes);
  double sum = 0;
  forEachPiece(scaled, [&](const Flow& flow, double a, double b) {
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double curvature = flow.at(a + (b - a) * rule.nodes[i])(3, 0);
      sum += std::abs(b - a) * rule.weights[i] * curvature * curvature;
    }
  });
  return 0.5 * sum / scaled.unit;
}

std::vector<double> Elastica::inflections() const {
  std::vector<double> result;
  const ScaledElastica scaled = elastica::scaled(*this);
  const ElasticaInvariants& known = scaled.known;
  const double peak = peakCurvature(known);
  const bool inflected =
      scaled.straight > 0 ? anchor_.curvature == 0 : known.hasInflections() && !known.isSingleLoop();
  if (!inflected || known.isLine(scaled.length)) {
    return result;
  }
  const double zero = kNegligible * peak;
  const double first = scaled.first();
  const double last = scaled.last();
  const auto add = [&](double t) { result.push_back(std::clamp((t - first) * scaled.unit, 0.0, length_)); };
  // The walks go out from the origin, where the sign is told exactly; a curvature at an end that is zero to
  // rounding counts.
  const bool atOrigin = first <= 0 && last >= 0 &&
                        (first == 0 || last == 0 ? std::abs(scaled.flow.curvature) <= zero
                                                 : anchored_ && anchor_.curvature == 0);
  if (atOrigin) {
    add(0);
  }
  double sign = 0;
  double before = 0;
  forEachPiece(scaled, [&](const Flow& flow, double a, double b) {
    const double direction = b > a ? 1 : -1;
    const double shift = direction * scaled.straight;
    const double next = flow.at(b)(3, 0);
    if (direction != sign) {
      sign = direction;
      const Block start = flow.at(a);
      before = start(3, 0);
      if (std::abs(a) == 0 && atOrigin && scaled.straight == 0) {
        before = direction * scaled.flow.normal;
      } else if (std::abs(a) > 0 && std::abs(before) <= zero) {
        add(a + shift);
        before = 0;
      }
    }
    const double end = direction > 0 ? last : first;
    if (b == end - shift && std::abs(next) <= zero) {
      add(end);
    } else if (next * before < 0) {
      const auto curvature = [&](double t) { return flow.at(t)(3, 0); };
      add(optimise::bracketedRoot(curvature, std::min(a, b), std::max(a, b)).middle() + shift);
    }
    before = next != 0 ? next : -before;
  });
  std::sort(result.begin(), result.end());
  return result;
}

double Elastica::maxCurvature() const {
  const ScaledElastica scaled = elastica::scaled(*this);
  const ElasticaInvariants& known = scaled.known;
  // |κ| is largest at an end or at an apex, where the tangent points along the force.
  const double forceAngle = std::atan2(scaled.flow.normal, scaled.flow.tangential);
  const auto turns = [&](double angle) { return std::floor((angle - forceAngle) / (2 * kPi)); };
  double largest = 0;
  forEachPiece(scaled, [&](const Flow& flow, double a, double b) {
    const Block start = flow.at(a);
    const Block end = flow.at(b);
    largest = std::max({largest, std::abs(start(3, 0)), std::abs(end(3, 0))});
    if (known.force > 0 && turns(start(2, 0)) != turns(end(2, 0))) {
      largest = std::max(largest, peakCurvature(known));
    }
  });
  return largest / scaled.unit;
}

std::optional<double> Elastica::period() const {
  const ScaledElastica scaled = elastica::scaled(*this);
  const ElasticaInvariants& known = scaled.known;
  if (known.isLine(scaled.length) || known.isCircle() || known.isSingleLoop()) {
    return std::nullopt;
  }
  return elastica::periodLength(known) * scaled.unit;
}

namespace {

using Eigen::Vector2d;

/// Two points nearer than this part of the length are one.
constexpr double kSamePoint = 1e-10;
/// An elastica that crosses itself anywhere does so within two periods from any start; the half is for
/// rounding.
constexpr double kPeriodsToSearch = 2.5;
/// Longest turning of an arc to start with.
constexpr double kArcTurning = kPi / 4;
/// Pairs of arcs to compare at most. Only curves that run along themselves within rounding come near it; they
/// count as touching.
constexpr int kMaxPairs = 200000;

struct Node {
  double t = 0;
  Vector2d point;
  double curvature = 0;
};

/// A short part of the curve, within `thickness` of its chord and never running back along it.
struct Arc {
  const Flow* flow = nullptr;
  Node from, to;
  double turning = 0;    ///< upper bound of ∫|κ|
  double thickness = 0;  ///< upper bound of the distance from the chord
  double length() const { return to.t - from.t; }
  Vector2d chord() const { return to.point - from.point; }
};

class CrossingSearch {
 public:
  CrossingSearch(const elastica::ScaledElastica& scaled, double force)
      : force_(force), tolerance_(kSamePoint * scaled.length) {
    // Between the bends of a taut blade any straight stretch tells the same: it is left out.
    elastica::forEachPiece(scaled, [&](const Flow& flow, double a, double b) {
      pieces_.push_back({flow, std::min(a, b), std::max(a, b)});
    });
    std::sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) { return a.from < b.from; });
    for (const Piece& piece : pieces_) {
      addArcs(arc(piece.flow, node(piece.flow, piece.from), node(piece.flow, piece.to)));
    }
  }

  /// A loop turns through at least π, so that only arcs with that much turning from one to the other can
  /// meet.
  bool found() {
    for (std::size_t j = 0; j < arcs_.size(); ++j) {
      double turning = arcs_[j].turning;
      for (std::size_t i = j; i-- > 0;) {
        turning += arcs_[i].turning;
        if (turning >= kPi && meet(arcs_[i], arcs_[j])) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  struct Piece {
    Flow flow;
    double from, to;
  };

  static Node node(const Flow& flow, double t) {
    const Flow::Block block = flow.at(t);
    return Node{t, Vector2d(block(0, 0), block(1, 0)), block(3, 0)};
  }

  /// |κ'| ≤ f bounds the curvature between two nodes.
  Arc arc(const Flow& flow, const Node& from, const Node& to) const {
    const double length = to.t - from.t;
    const double turning =
        0.5 * length * (std::abs(from.curvature) + std::abs(to.curvature) + force_ * length);
    return Arc{&flow, from, to, turning, 0.5 * length * std::min(turning, 1.0)};
  }

  void halves(const Arc& whole, Arc& first, Arc& second) const {
    const Node middle = node(*whole.flow, 0.5 * (whole.from.t + whole.to.t));
    first = arc(*whole.flow, whole.from, middle);
    second = arc(*whole.flow, middle, whole.to);
  }

  void addArcs(const Arc& whole) {
    if (whole.turning <= kArcTurning) {
      arcs_.push_back(whole);
      return;
    }
    Arc first;
    Arc second;
    halves(whole, first, second);
    addArcs(first);
    addArcs(second);
  }

  bool meet(const Arc& a, const Arc& b) {
    if (++pairs_ > kMaxPairs) {
      return true;
    }
    if (apart(a, b)) {
      return false;
    }
    if (cross(a, b)) {
      return true;
    }
    if (a.length() < tolerance_ && b.length() < tolerance_) {
      return true;
    }
    Arc first;
    Arc second;
    if (a.length() >= b.length()) {
      halves(a, first, second);
      return meet(first, b) || meet(second, b);
    }
    halves(b, first, second);
    return meet(a, first) || meet(a, second);
  }

  /// True if a line along or across one of the chords separates the arcs by more than the tolerance.
  bool apart(const Arc& a, const Arc& b) const {
    for (const Vector2d& chord : {a.chord(), b.chord()}) {
      const double size = chord.norm();
      for (const Vector2d& axis : {Vector2d(-chord.y(), chord.x()), chord}) {
        const double a0 = axis.dot(a.from.point);
        const double a1 = axis.dot(a.to.point);
        const double b0 = axis.dot(b.from.point);
        const double b1 = axis.dot(b.to.point);
        const double margin = (a.thickness + b.thickness + tolerance_) * size;
        if (std::min(a0, a1) > std::max(b0, b1) + margin || std::min(b0, b1) > std::max(a0, a1) + margin) {
          return true;
        }
      }
    }
    return false;
  }

  /// True if the ends of each arc lie on different sides of the other arc, clear of its thickness.
  static bool cross(const Arc& a, const Arc& b) { return straddles(a, b) && straddles(b, a); }

  static bool straddles(const Arc& a, const Arc& b) {
    const Vector2d chord = b.chord();
    const Vector2d normal(-chord.y(), chord.x());
    const double from = normal.dot(a.from.point - b.from.point);
    const double to = normal.dot(a.to.point - b.from.point);
    const double clearance = b.thickness * chord.norm();
    return std::min(from, to) < -clearance && std::max(from, to) > clearance;
  }

  double force_;
  double tolerance_;
  int pairs_ = 0;
  std::vector<Piece> pieces_;
  std::vector<Arc> arcs_;
};

}  // namespace

bool Elastica::selfIntersects() const {
  elastica::ScaledElastica scaled = elastica::scaled(*this);
  const elastica::ElasticaInvariants& known = scaled.known;
  if (!anchored_) {
    scaled.length = std::min(scaled.length, kPeriodsToSearch * elastica::periodLength(known));
  }
  if (2 * known.halfPeakCurvature * scaled.length < kPi) {
    return false;
  }
  return CrossingSearch(scaled, known.force).found();
}

}  // namespace bw
