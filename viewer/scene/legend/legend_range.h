// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bw/scene/scene.h"
#include "scene/theme.h"

namespace bw::scene {

/// The step 1, 2 or 5 × 10ⁿ that divides `span` (> 0) into about `count` parts.
double roundStep(double span, int count);

/// The smallest range with round ends that holds [low, high].
std::pair<double, double> roundRange(double low, double high, int count);

/// Round numbers in [low, high].
struct Ticks {
  std::vector<double> values;
  double step = 1;
  int decimals = 0;  ///< that the step needs
};
Ticks ticksIn(double low, double high, int count);

/// The text of a number with a true minus sign, and a plus sign if `sign`; zero has none.
std::string tickText(double value, int decimals, bool sign);

/// What is known of a field's values, once.
struct FieldSummary {
  double min = 0, max = 0;  ///< of the finite values
  std::size_t count = 0;    ///< of finite values
};
FieldSummary summarize(const std::vector<double>& values);

/// The legend's range for a field: as wished, or round numbers around the data.
///
/// - Deviation is symmetric: it reaches the tolerance once the data come near it, and otherwise follows them
///   down to a tenth of it, so that the small errors of a good cut show.
/// - A field with a `limit` runs from 0 to the limit, further only if the data do; the relative speed from 0
///   to 1.
/// - A map of words has all of them, whatever is wished.
/// - Any other spans at least a tenth of its largest value, so that rounding errors make no picture.
///
/// A wished end that leaves nothing of the automatic range takes its span along; ends that are the wrong way
/// round are exchanged.
std::pair<double, double> legendRangeOf(const std::string& field, const FieldSummary& summary,
                                        const Style& style, const std::optional<double>& limit = {});

/// The numbers that stand at a legend, round ones, and the isolines at them; those of a map of words each
/// have a word.
Ticks legendTicks(const std::string& field, const std::pair<double, double>& range);

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
