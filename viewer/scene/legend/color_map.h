// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>

#include "scene/theme.h"

namespace bw::scene {

/// Perceptually even maps of [0, 1], readable by colour-blind eyes and in grey print; values outside take the
/// end colours. They pass through ten samples of the public-domain (CC0) maps of that name, joined smoothly
/// in the Oklab space.
Rgb viridis(double t);
Rgb cividis(double t);

/// Signed deviation: neutral within the tolerance band (a breath of the sign's colour at its edge), then a
/// step to a clear blue (below) or red (above) that saturates at `end`. All in mm, end > tolerance ≥ 0.
Rgb deviationColor(double value, double tolerance, double end);

/// How a field is coloured over its legend range.
struct ColorMap {
  std::string field;
  std::pair<double, double> range{0, 1};
  double tolerance = 0;  ///< mm; only "deviation" uses it

  Rgb at(double value) const;
  bool operator==(const ColorMap&) const = default;
};

}  // namespace bw::scene
