// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/shape/key_blades.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bw/core/base/frame.h"
#include "bw/core/base/units.h"
#include "bw/core/shape/turning_planes.h"
#include "bw/core/text/number_text.h"
#include "shape/fitted_grid.h"
#include "shape/shapes.h"

namespace bw {

namespace {

constexpr int kCubic = 3;
constexpr int kFirstSpans = 8;

Eigen::Matrix2d turned(double angle) { return Eigen::Rotation2Dd(angle).toRotationMatrix(); }

/// The curve from the middle on, as long as half of the blade; the other half lies before its start.
Result<Elastica> halfOf(const KeyBlade& blade) {
  const double length = blade.length;
  return Elastica::make(blade.middle, blade.angle, blade.bend / length,
                        turned(blade.angle) * blade.force / (length * length), length / 2);
}

Result<void> check(const KeyBlade& blade) {
  const auto name = [&blade] { return "the key blade at y = " + shortText(blade.y, 6); };
  const bool finite = std::isfinite(blade.y) && blade.middle.allFinite() && std::isfinite(blade.angle) &&
                      std::isfinite(blade.length) && std::isfinite(blade.bend) && blade.force.allFinite() &&
                      std::isfinite(blade.turn);
  if (!finite) return fail(ErrorCode::badInput, name() + " has a number that is not finite", "blades");
  if (!(blade.length > 0))
    return fail(ErrorCode::badInput,
                name() + " is " + shortText(blade.length) + " mm long; it must be longer than 0", "blades",
                blade.length, 0.0);
  if (std::abs(blade.bend) > KeyBlade::kMostBend)
    return fail(ErrorCode::badInput,
                name() + " bends by " + shortText(blade.bend) + " rad at the rate of its middle; it may by " +
                    shortText(KeyBlade::kMostBend),
                "blades", blade.bend, KeyBlade::kMostBend);
  if (std::abs(blade.turn) > KeyBlade::kMostTurn)
    return fail(ErrorCode::badInput,
                name() + " has its plane turned by " + shortText(blade.turn / kDegree) + "°; it may by " +
                    shortText(KeyBlade::kMostTurn / kDegree, 3) + "°",
                "blades", blade.turn, KeyBlade::kMostTurn);
  if (blade.force.norm() > KeyBlade::kMostForce)
    return fail(ErrorCode::badInput,
                name() + " has a force of " + shortText(blade.force.norm()) +
                    " in EI over its length squared; " + shortText(KeyBlade::kMostForce) + " is the most",
                "blades", blade.force.norm(), KeyBlade::kMostForce);
  return {};
}

}  // namespace

Eigen::Vector3d KeyBlade::placed(const Eigen::Vector2d& place) const {
  if (turn == 0) return {place.x(), y, place.y()};
  const double aside = place.x() - middle.x();
  return {middle.x() + aside * std::cos(turn), y + aside * std::sin(turn), place.y()};
}

Result<Elastica> elasticaOf(const KeyBlade& blade) {
  if (Result<void> ok = check(blade); !ok) return tl::unexpected<Error>(ok.error());
  const Result<Elastica> half = halfOf(blade);
  return half ? half->segment(-blade.length / 2, blade.length / 2) : half;
}

KeyBlade keyBladeOf(const Elastica& elastica, double y) {
  const double length = elastica.length();
  const Elastica::State middle = elastica.at(length / 2);
  KeyBlade blade{y, middle.point, middle.angle, length, middle.curvature * length, {}};
  blade.force = turned(-middle.angle) * elastica.force() * (length * length);
  return blade;
}

BladeSweep::Numbers BladeSweep::numbersOf(const KeyBlade& blade) {
  Numbers numbers;
  numbers << blade.middle, blade.angle, blade.length, blade.bend, blade.force, blade.turn;
  return numbers;
}

KeyBlade BladeSweep::bladeOf(const Numbers& numbers, double y) {
  return {y, numbers.head<2>(), numbers(2), numbers(3), numbers(4), numbers.segment<2>(5), numbers(7)};
}

Result<BladeSweep> BladeSweep::through(const std::vector<KeyBlade>& blades) {
  if (blades.size() < 2 || blades.size() > std::size_t(BladesSurface::kMost))
    return fail(ErrorCode::badInput,
                "a surface of blades takes 2 to " + std::to_string(BladesSurface::kMost) +
                    " key blades, not " + std::to_string(blades.size()),
                "blades", double(blades.size()), blades.size() < 2 ? 2.0 : BladesSurface::kMost);
  std::vector<double> y;
  BladeSweep sweep;
  for (const KeyBlade& blade : blades) {
    if (Result<void> ok = check(blade); !ok) return tl::unexpected<Error>(ok.error());
    if (!y.empty() && !(blade.y > y.back()))
      return fail(ErrorCode::badInput,
                  "the key blade at y = " + shortText(blade.y, 6) +
                      " must lie beyond the one before it; put the blades in order of y",
                  "blades", blade.y, y.back());
    y.push_back(blade.y);
    sweep.poles_.push_back(numbersOf(blade));
  }
  sweep.degree_ = std::min(kCubic, int(y.size()) - 1);
  const shape::SplineInterpolation alongY(y, sweep.degree_);
  alongY.solve(sweep.poles_.data(), 1);
  sweep.knots_ = alongY.knots();
  return sweep;
}

BladeSweep::Numbers BladeSweep::value(double y, bool change) const {
  const int degree = change ? degree_ - 1 : degree_;
  const int poles = int(poles_.size());
  const auto above = std::upper_bound(knots_.begin() + degree_, knots_.begin() + poles, y);
  const int span = int(above - knots_.begin()) - 1;
  if (!change) {
    const std::array<double, 4> basis = splineBasis(knots_, degree, span, y);
    Numbers sum = Numbers::Zero();
    for (int k = 0; k <= degree; ++k) sum += basis[std::size_t(k)] * poles_[std::size_t(span - degree + k)];
    return sum;
  }
  // The derivative is the spline of the differences of the poles, of one degree less on the same knots
  // without the first and the last.
  const std::vector<double> inner(knots_.begin() + 1, knots_.end() - 1);
  const std::array<double, 4> basis = splineBasis(inner, degree, span - 1, y);
  Numbers sum = Numbers::Zero();
  for (int k = 0; k <= degree; ++k) {
    const std::size_t i = std::size_t(span - degree_ + k);
    sum += basis[std::size_t(k)] * degree_ / (knots_[i + std::size_t(degree_) + 1] - knots_[i + 1]) *
           (poles_[i + 1] - poles_[i]);
  }
  return sum;
}

KeyBlade BladeSweep::at(double y) const { return bladeOf(value(y, false), y); }

KeyBlade BladeSweep::changeAt(double y) const { return bladeOf(value(y, true), 1); }

Result<std::vector<Eigen::Vector2d>> bladeVelocities(const KeyBlade& blade, const KeyBlade& change,
                                                     const std::vector<double>& shares) {
  const Result<Elastica> half = halfOf(blade);
  if (!half) return tl::unexpected<Error>(half.error());
  const double length = blade.length, perLength = change.length / length;
  // What the middle of the curve changes by: its place, tangent, curvature, and λ in the plane.
  Eigen::Matrix<double, 6, 1> start;
  const Eigen::Vector2d force = half->force();
  const Eigen::Vector2d across(-force.y(), force.x());
  start << change.middle, change.angle, change.bend / length - perLength * blade.bend / length,
      turned(blade.angle) * change.force / (length * length) + change.angle * across - 2 * perLength * force;
  std::vector<Eigen::Vector2d> velocities;
  for (const double share : shares) {
    const double s = (share - 0.5) * length;
    Elastica::Jacobian jacobian;
    const Elastica::State state = half->at(s, jacobian);
    velocities.emplace_back(jacobian.topRows<2>() * start +
                            (share - 0.5) * change.length *
                                Eigen::Vector2d(std::cos(state.angle), std::sin(state.angle)));
  }
  return velocities;
}

Result<std::vector<Eigen::Vector3d>> spaceVelocities(const KeyBlade& blade, const KeyBlade& change,
                                                     const std::vector<double>& shares) {
  const Result<std::vector<Eigen::Vector2d>> flat = bladeVelocities(blade, change, shares);
  if (!flat) return tl::unexpected<Error>(flat.error());
  const Result<Elastica> elastica = elasticaOf(blade);
  if (!elastica) return tl::unexpected<Error>(elastica.error());
  const Eigen::Vector2d along(std::cos(blade.turn), std::sin(blade.turn)), across(-along.y(), along.x());
  std::vector<Eigen::Vector3d> velocities;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const double aside = elastica->at(shares[k] * blade.length).point.x() - blade.middle.x();
    const Eigen::Vector2d plan = Eigen::Vector2d(change.middle.x(), 1) +
                                 ((*flat)[k].x() - change.middle.x()) * along + aside * change.turn * across;
    velocities.emplace_back(plan.x(), plan.y(), (*flat)[k].y());
  }
  return velocities;
}

std::optional<TurningPlanes> planesOf(const DesignedSurface& surface) {
  const auto* blades = std::get_if<BladesSurface>(&surface.shape);
  if (!blades || std::ranges::all_of(blades->blades, [](const KeyBlade& blade) { return blade.turn == 0; }))
    return {};
  const Result<BladeSweep> sweep = BladeSweep::through(blades->blades);
  if (!sweep) return {};
  TurningPlanes planes;
  const Eigen::Matrix3d axes = rotationFromAngles(surface.rotation);
  planes.frame = {surface.origin, -axes.col(0), axes.col(2), axes.col(1)};
  planes.turn.to = sweep->to();
  // Cubics between two keys, each by its ends.
  for (std::size_t i = 0; i + 1 < blades->blades.size(); ++i) {
    const double from = blades->blades[i].y, way = blades->blades[i + 1].y - from;
    const KeyBlade a = sweep->at(from), b = sweep->at(from + way), da = sweep->changeAt(from),
                   db = sweep->changeAt(from + way);
    const auto cubic = [way](double p, double q, double dp, double dq) -> std::array<double, 4> {
      const double rise = (q - p) / way;
      return {p, dp, (3 * rise - 2 * dp - dq) / way, (dp + dq - 2 * rise) / (way * way)};
    };
    planes.turn.spans.push_back({from, cubic(-a.middle.x(), -b.middle.x(), -da.middle.x(), -db.middle.x()),
                                 cubic(a.turn, b.turn, da.turn, db.turn)});
  }
  return planes;
}

namespace shape {

Result<SplineSurface> splineOf(const BladesSurface& surface) {
  const Result<BladeSweep> sweep = BladeSweep::through(surface.blades);
  if (!sweep) return tl::unexpected<Error>(sweep.error());
  std::vector<double> arcs;
  std::vector<Elastica::State> states;
  const RowOf rowOf = [&](double y, std::span<const double> u,
                          std::span<Eigen::Vector2d> out) -> Result<void> {
    const Result<Elastica> elastica = elasticaOf(sweep->at(y));
    if (!elastica) {
      Error error = elastica.error();
      error.message += "; add a key blade near there, or bring its neighbours nearer to each other";
      return tl::unexpected<Error>(error);
    }
    arcs.assign(u.begin(), u.end());
    for (double& s : arcs) s *= elastica->length();
    states.resize(arcs.size());
    elastica->at(arcs, states);
    for (std::size_t i = 0; i < states.size(); ++i) out[i] = states[i].point;
    return {};
  };
  Places y;
  for (const KeyBlade& blade : surface.blades) y.breaks.push_back(blade.y);
  y.parts = std::max(1, kFirstSpans / int(y.breaks.size() - 1));
  // Blades whose planes turn are rows of places in space.
  std::vector<Eigen::Vector2d> flat;
  const SpaceRowOf placedRow = [&](double at, std::span<const double> u,
                                   std::span<Eigen::Vector3d> out) -> Result<void> {
    flat.resize(out.size());
    if (Result<void> ok = rowOf(at, u, flat); !ok) return ok;
    const KeyBlade blade = sweep->at(at);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = blade.placed(flat[i]);
    return {};
  };
  const bool turns = std::ranges::any_of(surface.blades, [](const KeyBlade& b) { return b.turn != 0; });
  const Places u{{0, 1}, kFirstSpans};
  Result<FittedGrid> fitted =
      turns ? fittedGrid(placedRow, u, y, BladesSurface::kTolerance, BladesSurface::kMostPoles)
            : fittedGrid(rowOf, u, y, BladesSurface::kTolerance, BladesSurface::kMostPoles);
  if (!fitted) return tl::unexpected<Error>(fitted.error());
  if (fitted->miss <= BladesSurface::kTolerance) return std::move(fitted->spline);
  return fail(ErrorCode::badInput,
              "the blades change too much near y = " + shortText(fitted->place.y(), 6) + ": a spline of " +
                  std::to_string(fitted->spline.polesU) + " × " + std::to_string(fitted->spline.polesV) +
                  " poles misses them by " + shortText(fitted->miss) + " mm, more than " +
                  shortText(BladesSurface::kTolerance) + "; make neighbouring key blades more alike there",
              "blades", fitted->miss, BladesSurface::kTolerance);
}

}  // namespace shape

}  // namespace bw
