// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "elastica/bvp_unit.h"
#include "elastica/pendulum_integrals.h"

namespace bw::elastica {

/// A shape in the sheets: swinging pendulums by inflections and first direction, and those that turn one way
/// only.
struct Sheet {
  int inflections = 0;  ///< 0: one way only; that of a hinge counts
  int direction = 1;    ///< of the first swing
};

/// What all swinging sheets share at one force angle a and one level t.
struct SheetNode {
  double a = 0, t = 0;
  PendulumIntegrals start{}, end{}, whole{};
  double startRate = 0, endRate = 0;  ///< |κ|/√f at the ends
  Modulus modulus;
  bool hinged = false;  ///< the end is the last inflection
};

struct SheetImage {
  double x = 0, y = 0;  ///< the end in the frame of the start, the length 1
  double root = 0;      ///< √f
};

/// All elastica of length 1 that turn by a given angle, or end in an inflection, as sheets over force angle
/// and level (docs/mathematics.md, 6). The pendulum's angle against the force is a at the start and a +
/// turning at the end (half angles inside).
class Sheets {
 public:
  /// The turning of the problem not negative.
  explicit Sheets(const UnitProblem& problem)
      : turning_(problem.ends == HeldEnds::both ? problem.turning : 0),
        hinged_(problem.ends != HeldEnds::both) {}

  /// By which the force angle at the end is asked to differ, 0 at a hinge.
  double turning() const { return turning_; }

  /// What the swinging sheets share at force angle a, rad, and level t ≥ 0, which is 0 at the sheets' edges.
  SheetNode swingingNode(double a, double t) const;

  /// The same for the sheet that turns one way only, t > 0.
  SheetNode oneWayNode(double a, double t) const;

  /// Where a shape ends.
  static SheetImage image(const SheetNode& node, const Sheet& sheet) {
    const double parity = sheet.inflections % 2 ? -1 : 1;
    const PendulumIntegrals whole = (node.end * parity - node.start) * double(sheet.direction) +
                                    node.whole * double(2 * sheet.inflections - (node.hinged ? 1 : 0));
    // From an inflection at once to the hinge: nothing but rounding is left of the blade, which is straight.
    constexpr double kNoLength = 1e-12;
    if (node.hinged && !(whole.time > kNoLength * node.whole.time)) return {1, 0, 0};
    const double along = whole.time - 2 * whole.square;
    const double across = sheet.direction * (node.startRate - parity * node.endRate);
    const double c = std::cos(node.a), s = std::sin(node.a);
    return {(c * along + s * across) / whole.time, (c * across - s * along) / whole.time, whole.time};
  }

  /// A shape by its numbers at the start.
  static UnitShape shape(const SheetNode& node, const Sheet& sheet);

  /// From its start tangent to its end tangent, rad.
  double turning(const SheetNode& node, const Sheet& sheet) const;

  /// Holds the shape where it lies nearest to rest against the force: at an inflection, or where it points
  /// along it; of these, where it is nearest to the middle.
  static Elastica::Anchor anchor(const SheetNode& node, const Sheet& sheet);

 private:
  double turning_;
  bool hinged_;
};

}  // namespace bw::elastica
