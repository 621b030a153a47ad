// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/pendulum_integrals.h"

namespace bw::elastica {

Carlson carlson(double x, double y, double z) {
  constexpr double kSpread = 1.5e-3;  // series to fifth order: errors of about kSpread^6
  constexpr int kMaxSteps = 60;
  double sum = 0, share = 1;
  for (int i = 0; i < kMaxSteps; ++i) {
    const double mean = (x + y + z) / 3;
    const double spread = std::max({std::abs(mean - x), std::abs(mean - y), std::abs(mean - z)});
    if (spread <= kSpread * mean) break;
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
    const double u = (mean - x) / mean, v = (mean - y) / mean, w = -(u + v);
    const double e2 = u * v - w * w, e3 = u * v * w;
    result.f = (1 + (e2 / 24 - 0.1 - 3 * e3 / 44) * e2 + e3 / 14) / std::sqrt(mean);
  }
  {
    const double mean = (x + y + 3 * z) / 5;
    const double u = (mean - x) / mean, v = (mean - y) / mean, w = (mean - z) / mean;
    const double ea = u * v, eb = w * w, ec = ea - eb, ed = ea - 6 * eb, ee = ed + ec + ec;
    const double series = 1 + ed * (-3.0 / 14 + 0.25 * 9.0 / 22 * ed - 1.5 * 3.0 / 26 * w * ee) +
                          w * (ee / 6 + w * (-9.0 / 22 * ec + w * 3.0 / 26 * ea));
    result.d = 3 * sum + share * series / (mean * std::sqrt(mean));
  }
  return result;
}

}  // namespace bw::elastica
