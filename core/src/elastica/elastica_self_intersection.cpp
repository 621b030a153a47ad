// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica.h"
#include "elastica/elastica_scaled.h"

namespace bw {

namespace {

using Eigen::Vector2d;
using Flow = elastica::ElasticaFlow<0>;

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
