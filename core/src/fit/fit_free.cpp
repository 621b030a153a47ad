// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "fit/fit_constrained.h"
#include "fit/fit_search.h"
#include "fit/shape_atlas.h"
#include "fit/start_rules.h"

namespace bw::fit {
namespace {

// A fit is better than another if its value is lower by more than this part.
constexpr double kSame = 1e-9;

// Fits without constraints: three unknowns.
class FreeFit {
 public:
  FreeFit(const FitTarget& target, const FitObjective& objective) : projected_(target, objective) {}

  // Starts by how near they are to the target.
  std::vector<Shape> sorted(const std::vector<Shape>& starts) const {
    std::vector<std::pair<double, Shape>> order;
    for (const Shape& shape : starts) {
      const std::optional<double> value = projected_.roughValue(shape);
      if (value) order.emplace_back(*value, shape);
    }
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Shape> out;
    for (const auto& [value, shape] : order) out.push_back(shape);
    return out;
  }

  // Descends from a start and keeps the result if it is better than the best so far.
  void attempt(const Shape& start) {
    const auto solution = projected_.solve(start, best_ ? &*best_ : nullptr);
    if (!solution) return;
    iterations_ += solution->iterations;
    if (!best_ || solution->value < best_->value * (1 - kSame)) best_ = solution;
  }

  // The same if the place is worth it.
  void attempt(const AtlasPlace& place) {
    if (!best_ || !hopeless(place, best_->value)) attempt(place.placement.shape);
  }

  // True if the best so far has more half periods than this.
  bool wavesMoreThan(int halfPeriods) const {
    return best_ && halfPeriodsOf(best_->placement.shape) > halfPeriods;
  }

  bool wanted(const StartRule& rule) const { return !best_ || best_->value > rule.limit(); }

  // The best so far, and the work of all descents.
  std::optional<FitSolution> best() const {
    std::optional<FitSolution> best = best_;
    if (best) best->iterations = iterations_;
    return best;
  }

 private:
  ProjectedFit projected_;
  std::optional<FitSolution> best_;
  int iterations_ = 0;
};

}  // namespace

std::optional<FitSolution> freeFit(const FitTarget& full, const FitTarget& coarse,
                                   const FitObjective& objective, const std::vector<Shape>& shapes,
                                   bool more) {
  FreeFit free(coarse, objective);
  if (!more) {
    free.attempt(shapes.front());
    return free.best();
  }
  for (const Shape& start : free.sorted(shapes)) {
    free.attempt(start);
    if (!free.wanted(starts::kGuesses)) break;
  }
  if (objective.norm != FitNorm::L2 && free.wanted(starts::kSimpleShapes)) {
    const Shape simple[] = {
        {coarse.endAngle - coarse.startAngle, 0, 0}, {0, 0, 0}, {0, -10, 20}, {0, -10, -20}};
    for (const Shape& shape : simple) free.attempt(shape);
  }
  if (free.wanted(starts::kAtlas) ||
      (free.wanted(starts::kAtlasOfWaves) &&
       (coarse.inflections() > starts::kFewInflections || free.wavesMoreThan(coarse.inflections() + 1)))) {
    FitConstraints constraints;
    constraints.length = objective.fixedLength;
    for (const AtlasPlace& place : placesFromAtlas(coarse, constraints, starts::kAtlas.most))
      free.attempt(place);
  }
  std::optional<FitSolution> best = free.best();
  if (!best || &full == &coarse) return best;
  FreeFit fine(full, objective);
  fine.attempt(best->placement.shape);
  if (std::optional<FitSolution> refined = fine.best()) {
    refined->iterations += best->iterations;
    best = refined;
  }
  return best;
}

}  // namespace bw::fit
