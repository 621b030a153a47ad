// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <cmath>
#include <vector>

#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica.h"

namespace bw::test {

/// State and derivatives of an elastica by an independent route: adaptive Runge–Kutta–Fehlberg 7(8) in long
/// double on the equation and its variational equations.
struct IntegratedElastica {
  Elastica::State state;
  Elastica::Jacobian jacobian;
};

inline IntegratedElastica integrate(const Elastica& e, double s) {
  namespace odeint = boost::numeric::odeint;
  using Real = long double;
  // x, y, θ, κ, then the same for the derivatives with respect to θ0, κ0, λ1, λ2.
  using State = std::vector<Real>;
  const Real l1 = e.force().x();
  const Real l2 = e.force().y();
  const auto system = [&](const State& y, State& d, Real) {
    const Real c = std::cos(y[2]);
    const Real n = std::sin(y[2]);
    d[0] = c;
    d[1] = n;
    d[2] = y[3];
    d[3] = -l1 * n + l2 * c;
    for (std::size_t p = 1; p <= 4; ++p) {
      const Real turn = y[4 * p + 2];
      d[4 * p] = -n * turn;
      d[4 * p + 1] = c * turn;
      d[4 * p + 2] = y[4 * p + 3];
      d[4 * p + 3] = -(l1 * c + l2 * n) * turn;
    }
    d[15] -= n;
    d[19] += c;
  };
  State y(20, Real(0));
  y[2] = e.startAngle();
  y[3] = e.startCurvature();
  y[6] = 1;
  y[11] = 1;
  const auto stepper =
      odeint::make_controlled<odeint::runge_kutta_fehlberg78<State, Real>>(Real(1e-18), Real(1e-18));
  if (s != 0) {
    odeint::integrate_adaptive(stepper, system, y, Real(0), Real(s), Real(s) / 1000);
  }
  IntegratedElastica result;
  result.state.point =
      Eigen::Vector2d(static_cast<double>(e.start().x() + y[0]), static_cast<double>(e.start().y() + y[1]));
  result.state.angle = static_cast<double>(y[2]);
  result.state.curvature = static_cast<double>(y[3]);
  result.jacobian.setZero();
  result.jacobian(0, 0) = result.jacobian(1, 1) = 1;
  for (int p = 1; p <= 4; ++p) {
    for (int row = 0; row < 4; ++row) {
      result.jacobian(row, p + 1) = static_cast<double>(y[static_cast<std::size_t>(4 * p + row)]);
    }
  }
  return result;
}

/// K(k) for k < 1; for k > 1 the thesis's extension K(1/k)/k.
inline double quarterPeriod(double k) {
  return k < 1 ? boost::math::ellint_rf(0.0, (1 - k) * (1 + k), 1.0) : quarterPeriod(1 / k) / k;
}

/// The basic elastica ζ_k of the thesis (2.12), (2.13), (2.14) by Boost's Jacobi functions.
inline Elastica::State basicElastica(double k, double s) {
  Elastica::State state;
  const double modulus = k <= 1 ? k : 1 / k;
  const double u = k <= 1 ? s : k * s;
  double sn = 0;
  double cn = 0;
  double dn = 0;
  double amplitude = 0;
  double integral = 0;  // E(u, modulus)
  if (modulus == 1) {
    sn = std::tanh(u);
    cn = dn = 1 / std::cosh(u);
    integral = sn;
  } else {
    sn = boost::math::jacobi_elliptic(modulus, u, &cn, &dn);
    dn = std::sqrt((1 - modulus) * (1 + modulus) +
                   modulus * modulus * cn * cn);  // Boost's own is wrong at cn = 0
    const double turns = std::round(u / (4 * quarterPeriod(modulus)));
    amplitude = std::atan2(sn, cn) + 2 * kPi * turns;
    if (amplitude - u * kPi / (2 * quarterPeriod(modulus)) > kPi) {
      amplitude -= 2 * kPi;
    } else if (amplitude - u * kPi / (2 * quarterPeriod(modulus)) < -kPi) {
      amplitude += 2 * kPi;
    }
    integral = boost::math::ellint_2(modulus, amplitude);
  }
  if (k <= 1) {
    state.point = {2 * integral - s, 2 * k * (1 - cn)};
    state.angle = 2 * std::atan2(k * sn, dn);
    state.curvature = 2 * k * cn;
  } else {
    state.point = {2 * k * integral + s * (1 - 2 * k * k), 2 * k * (1 - dn)};
    state.angle = 2 * amplitude;
    state.curvature = 2 * k * dn;
  }
  return state;
}

}  // namespace bw::test
