// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <cmath>

#include "bw/core/sweep/sweep.h"

namespace bw {

namespace {

/// Largest |κ| L of a bend that does not count. An arc of a whole blade of 800 mm rises by κL · L/8 = 0.01 mm
/// then: less than a robot repeats its points and than any foam shows. In a straight section, rounding alone
/// makes 1e-14.
constexpr double kLeastBend = 1e-4;

}  // namespace

int bladeInflections(const Elastica& shape) {
  std::vector<double> places = shape.inflections();
  if (places.empty() || shape.maxCurvature() * shape.length() <= kLeastBend) return 0;
  places.insert(places.begin(), 0.0);
  places.push_back(shape.length());
  int changes = 0;
  double side = 0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const Result<Elastica> bend = shape.segment(places[i], places[i + 1]);
    if (!bend || bend->maxCurvature() * shape.length() <= kLeastBend) continue;
    const double now = std::copysign(1.0, shape.at(0.5 * (places[i] + places[i + 1])).curvature);
    if (side * now < 0) ++changes;
    side = now;
  }
  return changes;
}

}  // namespace bw
