// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

namespace bw::fit {

/// When some starts are tried: where the best fit so far is worse (R4) than `poor` and than `worse` times the
/// free fit, which is a lower limit of fits under constraints.
struct StartRule {
  double poor = 0;
  double worse = 0;
  std::size_t most = 0;  ///< so many of them, where there are more

  /// The value of the objective above which they are tried.
  double limit(double freeValue = 0) const { return std::max(poor * poor, worse * worse * freeValue); }
};

/// Which start is tried when, in this order. A warm start is the only start, free or under constraints.
namespace starts {

// Free fits, unknowns the shape alone.

/// The canonical guess by length, that by count where it is asked for or below `kFarBetter` of the other's
/// value (on short, nearly straight pieces the tangents hardly tell the place: counting does), the affine law
/// at the middle, and the same law from the tangent angles: the nearest to the target first, the next ones
/// only where a fit has lost the target.
inline constexpr StartRule kGuesses{.poor = 1};
inline constexpr double kFarBetter = 1e-2;
/// H1 and H2: an arc, a line and two S-shapes, since the atlas compares points, not derivatives.
inline constexpr StartRule kSimpleShapes{.poor = 5e-3};
/// The nearest places of the atlas. Chosen on 1900 random curves: none better than 6.4e-3 was ever improved
/// by another start.
inline constexpr StartRule kAtlas{.poor = 5e-3, .most = 16};
/// The same where the target has more inflections than a cubic, or the fit more half periods than one above
/// the target's inflections: other waves may lie nearer.
inline constexpr StartRule kAtlasOfWaves{.poor = 1e-3};
inline constexpr int kFewInflections = 2;

// Fits under constraints, unknowns shape and placement.

/// Ends, tangents and length: all equilibria of a clamped blade, the nearest first, unless the one near the
/// free fit is good. The same limit ends the descents under bounds, from the places of all starts above, an
/// arc and a line: bounds may cost so much.
inline constexpr StartRule kBlades{.poor = 5e-3, .worse = 4};
/// Ends or tangents: rough descents from the free fit, then from places of the atlas that are held there. Of
/// 6000 curves with 1 to 6 inflections, held at ends and tangents, 3 ended above 1.01 of the best known.
inline constexpr StartRule kHeldAtlas{.poor = 1e-3, .worse = 1.01, .most = 12};
inline constexpr StartRule kHeldAtlasOfBoth{.poor = 1e-3, .worse = 1.01, .most = 20};
/// Of these the lowest is descended from with all digits; if it does not come to rest, those whose values are
/// higher by less than this part as well.
inline constexpr double kHardlyWorse = 2e-2;
/// The fits under more constraints, also where the fit does not come to rest or has more half periods than
/// this many above the target's inflections: a taut blade may lie nearer than small waves.
inline constexpr StartRule kMoreConstraints{.poor = 6e-2, .worse = 1.5};
inline constexpr int kMoreWaves = 2;
/// Where the nearest of these is taut, from which a descent hardly gets on: so many others.
inline constexpr std::size_t kSlackBlades = 2;
/// Disjunctive constraints: the fit that breaks them, and so many of the simplest starts, an arc and a line;
/// all places only if these lead nowhere.
inline constexpr std::size_t kSimplestPlaces = 2;

}  // namespace starts

}  // namespace bw::fit
