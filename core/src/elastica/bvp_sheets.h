// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "elastica/bvp_unit.h"

namespace bw::elastica {

/// Carlson's R_F(x, y, z) and R_D(x, y, z) in one duplication.
struct Carlson {
  double f, d;
};
/// `spread`: how far apart the arguments may still be where the series takes over, of their mean; off by
/// about the sixth power of that.
inline constexpr double kAllDigits = 1.5e-3, kSomeDigits = 0.05;
Carlson carlson(double x, double y, double z, double spread = kAllDigits);

/// Along a pendulum, with h half its angle against the force: ∫ dh / √(k² − sin² h) and ∫ sin² h dh / √(k² −
/// sin² h).
struct PendulumIntegrals {
  double time = 0, square = 0;
  PendulumIntegrals operator+(const PendulumIntegrals& o) const { return {time + o.time, square + o.square}; }
  PendulumIntegrals operator-(const PendulumIntegrals& o) const { return {time - o.time, square - o.square}; }
  PendulumIntegrals operator*(double s) const { return {s * time, s * square}; }
};

/// One modulus: k² and k² − 1, the latter without cancellation.
struct Modulus {
  double square = 1, excess = 0;
};

/// The integrals from 0 to h in [−π/2, π/2], |sin h| ≤ k.
inline PendulumIntegrals quarter(const Modulus& k, double h, double spread = kAllDigits) {
  const double s = std::sin(h), c = std::cos(h);
  const double below = std::max(k.excess + c * c, 0.0);
  const Carlson r = carlson(k.square * c * c, below, k.square, spread);
  return {s * r.f, k.square * s * s * s * r.d / 3};
}

/// The integrals up to the turning point of a swing (k < 1).
inline PendulumIntegrals swing(const Modulus& k, double spread = kAllDigits) {
  const double root = std::sqrt(k.square);
  const Carlson r = carlson(-k.square * k.excess, 0, k.square, spread);
  return {root * r.f, k.square * k.square * root * r.d / 3};
}

/// The integrals from 0 to π/2 for a pendulum that goes over (k > 1).
inline PendulumIntegrals overTop(const Modulus& k, double spread = kAllDigits) {
  const Carlson r = carlson(0, k.excess, k.square, spread);
  return {r.f, k.square * r.d / 3};
}

/// The integrals from 0 to any h for a pendulum that goes over (k > 1), or within its swing.
inline PendulumIntegrals upTo(const Modulus& k, double h, double spread = kAllDigits) {
  const double turns = std::round(h / kPi);
  PendulumIntegrals result = quarter(k, h - turns * kPi, spread);
  if (turns != 0) result = result + overTop(k, spread) * (2 * turns);
  return result;
}

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
  SheetNode swingingNode(double a, double t, double spread = kAllDigits) const;

  /// The same for the sheet that turns one way only, t > 0.
  SheetNode oneWayNode(double a, double t, double spread = kAllDigits) const;

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
