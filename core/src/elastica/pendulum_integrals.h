// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include "bw/core/base/units.h"

namespace bw::elastica {

/// Carlson's R_F(x, y, z) and R_D(x, y, z) in one duplication.
struct Carlson {
  double f, d;
};
Carlson carlson(double x, double y, double z);

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
inline PendulumIntegrals quarter(const Modulus& k, double h) {
  const double s = std::sin(h), c = std::cos(h);
  const double below = std::max(k.excess + c * c, 0.0);
  const Carlson r = carlson(k.square * c * c, below, k.square);
  return {s * r.f, k.square * s * s * s * r.d / 3};
}

/// The integrals up to the turning point of a swing (k < 1).
inline PendulumIntegrals swing(const Modulus& k) {
  const double root = std::sqrt(k.square);
  const Carlson r = carlson(-k.square * k.excess, 0, k.square);
  return {root * r.f, k.square * k.square * root * r.d / 3};
}

/// The integrals from 0 to π/2 for a pendulum that goes over (k > 1).
inline PendulumIntegrals overTop(const Modulus& k) {
  const Carlson r = carlson(0, k.excess, k.square);
  return {r.f, k.square * r.d / 3};
}

/// The integrals from 0 to any h for a pendulum that goes over (k > 1), or within its swing.
inline PendulumIntegrals upTo(const Modulus& k, double h) {
  const double turns = std::round(h / kPi);
  PendulumIntegrals result = quarter(k, h - turns * kPi);
  if (turns != 0) result = result + overTop(k) * (2 * turns);
  return result;
}

}  // namespace bw::elastica
