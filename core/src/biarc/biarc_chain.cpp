// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "biarc/biarc_chain.h"

#include <ceres/jet.h>

#include <algorithm>
#include <cmath>

#include "biarc/biarc_formula.h"

namespace bw::biarc {

namespace {

using Jet = ceres::Jet<double, kBiarcUnknowns>;

template <class T>
struct Arcs {
  BiarcShape<T> shape;
  T jointX, jointY;
  double alpha = 0, beta = 0;
};

double valueOf(double x) { return x; }
double valueOf(const Jet& x) { return x.a; }

/// Both arcs from x0, y0, τ0, z, x1, y1, τ1.
template <class T>
Arcs<T> arcsOf(const T* u) {
  using std::atan2, std::cos, std::exp, std::sin, std::sqrt;
  const T dx = u[4] - u[0], dy = u[5] - u[1];
  const T length = sqrt(dx * dx + dy * dy), direction = atan2(dy, dx);
  const auto wrapped = [](const T& angle) { return angle + (wrapAngle(valueOf(angle)) - valueOf(angle)); };
  const T alpha = wrapped(direction - u[2]), beta = wrapped(u[6] - direction);
  const T share = 1.0 / (1.0 + exp(-u[3]));
  Arcs<T> arcs{biarcShape(length, alpha, beta, share), u[0], u[1], valueOf(alpha), valueOf(beta)};
  const T middle = u[2] + arcs.shape.firstTurning / 2.0;
  arcs.jointX = u[0] + arcs.shape.firstChord * cos(middle);
  arcs.jointY = u[1] + arcs.shape.firstChord * sin(middle);
  return arcs;
}

}  // namespace

BiarcChain::BiarcChain(std::vector<BiarcNode> nodes, bool closed, double steepest)
    : nodes_(std::move(nodes)), closed_(closed) {
  arcs_.reserve(std::size_t(2 * biarcs()));
  for (int k = 0; k < biarcs(); ++k) {
    const BiarcNode& a = nodes_[std::size_t(k)];
    const BiarcNode& b = nodes_[std::size_t(k + 1) % nodes_.size()];
    const double u[kBiarcUnknowns] = {a[0], a[1], a[2], a[3], b[0], b[1], b[2]};
    const Arcs<double> arcs = arcsOf(u);
    const BiarcShape<double>& shape = arcs.shape;
    steepest_ = std::max({steepest_, std::abs(arcs.alpha), std::abs(arcs.beta)});
    if (!(steepest_ < steepest && shape.firstLength > 0 && shape.secondLength > 0 &&
          std::isfinite(shape.firstLength + shape.secondLength))) {
      valid_ = false;
      faulty_ = k;
      return;
    }
    arcs_.push_back({a.head<2>(), a[2], shape.firstTurning, shape.firstLength});
    arcs_.push_back(
        {{arcs.jointX, arcs.jointY}, a[2] + shape.firstTurning, shape.secondTurning, shape.secondLength});
  }
}

void BiarcChain::derivatives(int biarc, ArcDerivatives& first, ArcDerivatives& second) const {
  const BiarcNode& a = nodes_[std::size_t(biarc)];
  const BiarcNode& b = nodes_[std::size_t(biarc + 1) % nodes_.size()];
  const Jet u[kBiarcUnknowns] = {Jet(a[0], 0), Jet(a[1], 1), Jet(a[2], 2), Jet(a[3], 3),
                                 Jet(b[0], 4), Jet(b[1], 5), Jet(b[2], 6)};
  const Arcs<Jet> arcs = arcsOf(u);
  const BiarcShape<Jet>& shape = arcs.shape;
  first = {u[0].v,
           u[1].v,
           u[2].v,
           (shape.firstTurning / shape.firstLength).v,
           shape.firstTurning.v,
           shape.firstLength.v};
  second = {arcs.jointX.v,
            arcs.jointY.v,
            (u[2] + shape.firstTurning).v,
            (shape.secondTurning / shape.secondLength).v,
            shape.secondTurning.v,
            shape.secondLength.v};
}

}  // namespace bw::biarc
