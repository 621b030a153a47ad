// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fit/fit_constraints.h"
#include "fit/fit_projection.h"

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

/// Pieces of elastica of all kinds over which a target was laid, and how near each came.
struct AtlasPlace {
  Placement placement;
  double value = 0;   ///< mean square distance, more where the conditions are missed
  double order = 0;   ///< by which places are tried
  bool held = false;  ///< laid with ends or tangents
};

/// True if a descent from there does not come below a known value as far as experience tells.
bool hopeless(const AtlasPlace& place, double knownValue);

/// Where descents to a target may start so that none of the basins is left out: of a table of some thousand
/// pieces (swing or turns, periods, phase) with some inflections more than the target, laid over the target
/// as the conditions ask, those that lie nearer than their neighbours of the same length; the nearest first,
/// with a handicap beside a nearer one of another length, at most `most`. Ends are met, tangents and a length
/// only nearly. About 0.1 ms, with ends or tangents 0.3.
std::vector<AtlasPlace> placesFromAtlas(const FitTarget& target, const FitConstraints& constraints,
                                        std::size_t most);

/// Curves with more quadrature nodes than this are first fitted on a coarser rule of kCoarseNodes.
inline constexpr std::size_t kManyNodes = 64;
inline constexpr int kCoarseNodes = 32;

/// The best fit without constraints from some shapes; if `more` is set and the result is poor, also from
/// others (`starts`). Done on `coarse` and finished on `full`, if these are not the same. Empty if no
/// start can be placed.
std::optional<FitSolution> freeFit(const FitTarget& full, const FitTarget& coarse,
                                   const FitObjective& objective, const std::vector<Shape>& shapes,
                                   bool more);

/// What a fit under constraints starts from. The simplest places come last.
struct FitStarts {
  std::vector<Placement> places;
  FitSolution free;              ///< the fit without constraints
  std::optional<Elastica> warm;  ///< if set, the first place is its own, and the only start
};

/// What became of a fit under constraints.
struct ConditionedFit {
  std::optional<FitSolution> best;
  FitConstraints constraints;  ///< those that the best one was found under
  int iterations = 0;
  int worst = -1;  ///< if there is no solution: the name of the constraint that was hardest to meet
  std::vector<std::string> conflict =
      {};  ///< then: constraints that contradict each other, all of them needed
};

/// The fit under constraints (docs/mathematics.md, 7.5): under end conditions rough descents on `coarse` from
/// the free fit and, if that leads to nothing good, from the atlas; the best is finished on `target`. A curve
/// that meets more constraints also meets fewer: where the result is very poor, the fits with one constraint
/// more are starts as well, up to the equilibria of a clamped blade with the length of the target. 0.3 to 3
/// ms, some tens if very poor or taut.
ConditionedFit fitUnderConstraints(const FitTarget& target, const FitTarget& coarse,
                                   const FitConstraints& constraints, const Disjunctions& disjunctions,
                                   FitNorm norm, const FitStarts& starts);

}  // namespace bw::fit
