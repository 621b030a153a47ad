// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "calibration/symmetric_arc.h"

#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <cmath>

namespace bw::calibration {
namespace {

// Double precision is enough, and three times as fast as the library's detour through extended precision.
using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

struct Stretch {
  double arc = 0;
  double sag = 0;
};

// From the middle to the half angle with this sine and cosine; `speed` is the curvature there, over that of
// the middle.
Stretch stretchTo(double sine, double cosine, double speed) {
  if (sine == 0) return {};
  const double c2 = cosine * cosine, v2 = speed * speed;
  return {2 * sine * boost::math::ellint_rf(c2, v2, 1.0, Policy()),
          2.0 / 3.0 * sine * sine * sine * boost::math::ellint_rd(c2, v2, 1.0, Policy())};
}

SymmetricArc assemble(double height, double endCurvature, double force, const Stretch& stretch) {
  return {height, endCurvature, stretch.arc, stretch.sag, stretch.arc - 2 * stretch.sag, force};
}

}  // namespace

SymmetricArc symmetricArc(double sine, double cosine, double height) {
  const double square = sine * sine;
  const double c = 4 * square / height - 1;
  const double force = 2 * (height - 2 * square) / (height * height);
  Stretch stretch = stretchTo(sine, cosine, c);
  if (c < 0) {
    // Past the inflection: twice the way to it, less what lies between it and the end.
    const double k2 = height * height / (8 * (height - 2 * square));
    const Stretch quarter = stretchTo(std::sqrt(k2), std::sqrt(1 - k2), 0);
    stretch = {2 * quarter.arc - stretch.arc, 2 * quarter.sag - stretch.sag};
  }
  return assemble(height, c, force, stretch);
}

SymmetricArc hingedArc(double k) {
  return assemble(4 * k * k, 0, 0.25 / (k * k), stretchTo(k, std::sqrt((1 - k) * (1 + k)), 0));
}

double tallestArc(double sine, double k) {
  const double ratio = sine / k;
  return 4 * k * k * (1 + std::sqrt((1 - ratio) * (1 + ratio)));
}

}  // namespace bw::calibration
