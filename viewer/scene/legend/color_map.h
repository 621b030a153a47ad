// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "scene/theme.h"

namespace bw::scene {

/// Perceptually even maps of [0, 1], readable by colour-blind eyes and in grey print; values outside take the
/// end colours. They pass through ten samples of the public-domain (CC0) maps of that name, joined smoothly
/// in the Oklab space.
Rgb viridis(double t);
Rgb cividis(double t);

/// Signed deviation: white at nothing, through a pale blue (below) or red (above) at the edge of the
/// tolerance band, then a step to a clear one that darkens up to `end`. Where the scale ends within the band,
/// the pale colour is reached at its end; where it begins beside zero, at `start`, white stands there. All in
/// mm, end > start ≥ 0, tolerance ≥ 0.
Rgb deviationColor(double value, double tolerance, double end, double start = 0);

/// How a field is coloured over its legend range.
struct ColorMap {
  std::string field;
  std::pair<double, double> range{0, 1};
  double tolerance = 0;         ///< mm; only banded maps use it
  std::optional<double> limit;  ///< of the field: red beyond

  Rgb at(double value) const;
  bool operator==(const ColorMap&) const = default;
};

}  // namespace bw::scene
