// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include "bw/core/base/units.h"

namespace bw::biarc {

/// The angle less whole turns, in (−π, π].
inline double wrapAngle(double angle) {
  const double turn = 2 * kPi;
  const double rest = std::remainder(angle, turn);
  return rest <= -kPi ? rest + turn : rest;
}

/// sin(x)/x through x = 0, for numbers and for Ceres' Jets.
template <class T>
T sinc(const T& x) {
  using std::sin;
  if (x < T(1e-2) && x > T(-1e-2)) {
    const T q = x * x;
    return 1.0 - q / 6.0 * (1.0 - q / 20.0 * (1.0 - q / 42.0));
  }
  return sin(x) / x;
}

/// A biarc in the frame of its start tangent.
template <class T>
struct BiarcShape {
  T firstTurning, secondTurning, firstChord, firstLength, secondLength;
};

/// docs/mathematics.md, "Biarcs": chord length l, angle α of the chord against the start tangent, angle β of
/// the end tangent against the chord, share λ. Regular through W = α + β = 0 and through straight arcs.
template <class T>
BiarcShape<T> biarcShape(const T& length, const T& alpha, const T& beta, const T& share) {
  const T total = alpha + beta;
  const T rest = 1.0 - share;
  const T scale = length / sinc(T(total / 2.0));
  BiarcShape<T> shape;
  shape.firstTurning = 2.0 * alpha - rest * total;
  shape.secondTurning = 2.0 * beta - share * total;
  shape.firstChord = scale * share * sinc(T(share * total / 2.0));
  shape.firstLength = shape.firstChord / sinc(T(shape.firstTurning / 2.0));
  shape.secondLength = scale * rest * sinc(T(rest * total / 2.0)) / sinc(T(shape.secondTurning / 2.0));
  return shape;
}

}  // namespace bw::biarc
