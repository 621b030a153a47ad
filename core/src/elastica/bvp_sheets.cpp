// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "elastica/bvp_sheets.h"

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"

namespace bw::elastica {

Carlson carlson(double x, double y, double z, double spread) {
  constexpr int kMaxSteps = 60;
  double sum = 0, share = 1;
  for (int i = 0; i < kMaxSteps; ++i) {
    const double mean = (x + y + z) / 3;
    const double apart = std::max({std::abs(mean - x), std::abs(mean - y), std::abs(mean - z)});
    if (apart <= spread * mean) break;
    const double rx = std::sqrt(x), ry = std::sqrt(y), rz = std::sqrt(z);
    const double shift = rx * ry + ry * rz + rz * rx;
    sum += share / (rz * (z + shift));
    share *= 0.25;
    x = 0.25 * (x + shift);
    y = 0.25 * (y + shift);
    z = 0.25 * (z + shift);
  }
  Carlson result{};
  {
    const double mean = (x + y + z) / 3;
    const double once = 1 / mean, u = (mean - x) * once, v = (mean - y) * once, w = -(u + v);
    const double e2 = u * v - w * w, e3 = u * v * w;
    result.f = (1 + (e2 / 24 - 0.1 - 3 * e3 / 44) * e2 + e3 / 14) / std::sqrt(mean);
  }
  {
    const double mean = (x + y + 3 * z) / 5;
    const double once = 1 / mean, u = (mean - x) * once, v = (mean - y) * once, w = (mean - z) * once;
    const double ea = u * v, eb = w * w, ec = ea - eb, ed = ea - 6 * eb, ee = ed + ec + ec;
    const double series = 1 + ed * (-3.0 / 14 + 0.25 * 9.0 / 22 * ed - 1.5 * 3.0 / 26 * w * ee) +
                          w * (ee / 6 + w * (-9.0 / 22 * ec + w * 3.0 / 26 * ea));
    result.d = 3 * sum + share * series * once / std::sqrt(mean);
  }
  return result;
}

SheetNode Sheets::swingingNode(double a, double t, double spread) const {
  const double b = a + turning_;
  const double sa = std::sin(0.5 * a), sb = std::sin(0.5 * b);
  const double ca = std::cos(0.5 * a), cb = std::cos(0.5 * b);
  // 1 − k² = (1 − k_min²) sech² t: the sheets' edges at t = 0 are smooth, and k → 1 is far away.
  const double left = std::min(ca * ca, cb * cb);
  const double sech = 1 / std::cosh(t);
  Modulus k;
  k.excess = -left * sech * sech;
  k.square = 1 + k.excess;
  SheetNode node{.a = a, .t = t, .modulus = k};
  node.start = quarter(k, 0.5 * a, spread);
  node.whole = swing(k, spread);
  const double tanh = std::tanh(t);
  const double gap = left * tanh * tanh;  // k² − k_min²
  node.startRate =
      2 * std::sqrt(std::max(gap + (std::abs(sa) >= std::abs(sb) ? 0.0 : sb * sb - sa * sa), 0.0));
  node.hinged = hinged_;
  if (hinged_) return node;
  node.end = quarter(k, 0.5 * b, spread);
  node.endRate = 2 * std::sqrt(std::max(gap + (std::abs(sb) >= std::abs(sa) ? 0.0 : sa * sa - sb * sb), 0.0));
  return node;
}

SheetNode Sheets::oneWayNode(double a, double t, double spread) const {
  const double b = a + turning_;
  const double ha = 0.5 * a, hb = 0.5 * b;
  const double ca = std::cos(ha), cb = std::cos(hb);
  const bool over = std::floor((hb + 0.5 * kPi) / kPi) != std::floor((ha + 0.5 * kPi) / kPi);
  const double left = over ? 0.0 : std::min(ca * ca, cb * cb);  // 1 − k_min²
  const double sinh = std::sinh(t);
  const double gap = 1 / (sinh * sinh);
  Modulus k;
  k.excess = gap - left;
  k.square = 1 + k.excess;
  SheetNode node{.a = a, .t = t, .modulus = k};
  node.start = upTo(k, ha, spread);
  node.end = upTo(k, hb, spread);
  node.startRate = 2 * std::sqrt(gap + (ca * ca - left));
  node.endRate = 2 * std::sqrt(gap + (cb * cb - left));
  return node;
}

UnitShape Sheets::shape(const SheetNode& node, const Sheet& sheet) {
  const double root = image(node, sheet).root;
  return {sheet.direction * node.startRate * root, root * root * std::cos(node.a),
          -root * root * std::sin(node.a)};
}

double Sheets::turning(const SheetNode& node, const Sheet& sheet) const {
  if (!hinged_) return turning_;
  const double side = sheet.inflections % 2 == 1 ? sheet.direction : -sheet.direction;
  return side * (kPi - 2 * std::asin(std::sqrt(-node.modulus.excess))) - node.a;
}

Elastica::Anchor Sheets::anchor(const SheetNode& node, const Sheet& sheet) {
  const Modulus& k = node.modulus;
  const double root = image(node, sheet).root, direction = sheet.direction;
  const bool wave = k.excess <= 0;
  const PendulumIntegrals half = wave ? swing(k) : overTop(k);
  const PendulumIntegrals first = half - node.start * direction;  // the way to the first such place
  const double turn = std::round((0.5 * root - first.time) / (2 * half.time));
  // Swinging sheets have the inflections that they count; those that turn one way only may have them
  // outside.
  const double place = sheet.inflections > 0 ? std::clamp(turn, 0.0, sheet.inflections - 1.0)
                       : wave                ? std::min(turn, 0.0)
                                             : turn;
  const PendulumIntegrals way = first + half * (2 * std::max(place, wave ? -1.0 : place));
  const double side = wave && std::fmod(std::abs(std::max(place, -1.0)), 2.0) == 1 ? -1 : 1;
  const double delta = std::sqrt(std::max(-k.excess, 0.0));  // cos of the half angle against the force there
  const double angle =
      wave ? direction * side * (kPi - 2 * std::asin(std::min(delta, 1.0))) : kPi * (1 + 2 * place);
  const double rate = wave ? 0 : 2 * std::sqrt(k.excess);
  const double along = way.time - 2 * way.square, across = direction * (node.startRate - rate);
  const double c = std::cos(node.a), s = std::sin(node.a);
  Elastica::Anchor result;
  result.at = way.time / root;
  result.point = {(c * along + s * across) / root, (c * across - s * along) / root};
  result.angle = angle - node.a;
  result.curvature = direction * rate * root;
  const double sine = wave ? -direction * side * 2 * std::sqrt(k.square) * delta : 0;
  result.force = {root * root * (wave ? 2 * delta * delta - 1 : -1), root * root * sine};
  return result;
}

}  // namespace bw::elastica
