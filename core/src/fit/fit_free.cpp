// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "fit/fit_free.h"

#include <algorithm>

#include "fit/shape_atlas.h"

namespace bw::detail {
namespace {

// So many places of the atlas are starts of a poor fit, and of one (R4) worse than this where the target has
// more inflections than a cubic or the fit waves more often than the target.
constexpr std::size_t kAtlasPlaces = 16;
constexpr double kVeryGood = 1e-3;
constexpr int kFewInflections = 2;

// Fits without end conditions and bounds: three unknowns.
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
    const auto solution = projected_.solve(start, best_ ? &best_->placed : nullptr);
    if (!solution) return;
    iterations_ += solution->iterations;
    if (!best_ || solution->placed.value < best_->placed.value * (1 - 1e-9)) best_ = solution;
  }

  // True if the best so far has more half periods than this.
  bool wavesMoreThan(int halfPeriods) const {
    return best_ && 2 * periodsOf(best_->placed.placement.shape).count > halfPeriods;
  }

  bool worseThan(double R4) const { return !best_ || best_->placed.value > R4 * R4; }

  std::optional<FreeFitResult> best() const {
    if (!best_) return std::nullopt;
    return FreeFitResult{best_->placed.placement, best_->placed.value, iterations_, !best_->limit};
  }

 private:
  ProjectedFit projected_;
  std::optional<ProjectedFit::Solution> best_;
  int iterations_ = 0;
};

}  // namespace

std::optional<FreeFitResult> freeFit(const FitTarget& full, const FitTarget& coarse,
                                     const FitObjective& objective, const std::vector<Shape>& starts,
                                     bool more) {
  FreeFit free(coarse, objective);
  if (!more) {
    free.attempt(starts.front());
    return free.best();
  }
  for (const Shape& start : free.sorted(starts)) {
    free.attempt(start);
    if (!free.worseThan(1)) break;
  }
  // The atlas compares points, not derivatives: an arc, a line and S-shapes besides.
  if (objective.norm != FitNorm::L2 && free.worseThan(kGoodFit)) {
    const Shape simple[] = {
        {coarse.endAngle - coarse.startAngle, 0, 0}, {0, 0, 0}, {0, -10, 20}, {0, -10, -20}};
    for (const Shape& shape : simple) free.attempt(shape);
  }
  if (free.worseThan(kGoodFit) ||
      (free.worseThan(kVeryGood) &&
       (coarse.inflections() > kFewInflections || free.wavesMoreThan(coarse.inflections() + 1)))) {
    FitConstraints constraints;
    constraints.length = objective.fixedLength;
    for (const AtlasPlace& place : placesFromAtlas(coarse, constraints, kAtlasPlaces))
      if (!free.best() || !hopeless(place, free.best()->value)) free.attempt(place.placement.shape);
  }
  std::optional<FreeFitResult> best = free.best();
  if (!best || &full == &coarse) return best;
  FreeFit fine(full, objective);
  fine.attempt(best->placement.shape);
  if (const std::optional<FreeFitResult> refined = fine.best()) {
    const int before = best->iterations;
    best = refined;
    best->iterations += before;
  }
  return best;
}

}  // namespace bw::detail
