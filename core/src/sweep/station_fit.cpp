// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/station_fit.h"

#include <algorithm>
#include <optional>

#include "bw/core/elastica_stability.h"

namespace bw::detail {

namespace {

/// A warm-started fit this much worse than its neighbour's is compared with a cold start.
constexpr double kSuspiciousGrowth = 2.0;
/// R4 below this is good whatever the neighbour says.
constexpr double kGoodResidual = 1e-4;
/// A slightly better minimum on another branch is not worth a jump of the blade.
constexpr double kWorthAJump = 0.7;
/// Periods that the whole blade may have: where it is much longer than the section, what it does beyond it
/// would otherwise be left to rounding.
constexpr double kBladePeriods = 2.0;
/// How far beyond the tolerance a curve may lie for the sake of a blade that holds.
constexpr double kAllowance = 2.0;
/// Bounds on the periods that are tried with the blade's radius: 1, ½, ¼, … of the job's.
constexpr int kPeriodBounds = 7;

FitOptions fitOptions(const Job& job, double sectionLength) {
  FitOptions options;
  options.length = job.fitLength;
  options.endpoints = job.fitEndpoints;
  options.tangents = job.fitTangents;
  options.maxPeriods = std::min(job.maxPeriods, kBladePeriods * sectionLength / job.blade.length);
  return options;
}

bool usable(const FitResult& fit) { return fit.status != FitStatus::infeasible; }

Result<FitResult> fitBesideNeighbour(const PlanarCurve& section, FitOptions options,
                                     const FitResult* neighbour) {
  if (!neighbour) return fitElastica(section, options);
  options.initial = neighbour->elastica;
  Result<FitResult> warm = fitElastica(section, options);
  if (warm && usable(*warm) && warm->status != FitStatus::iterationLimit &&
      warm->R4 <= std::max(kGoodResidual, kSuspiciousGrowth * neighbour->R4))
    return warm;
  options.initial.reset();
  Result<FitResult> cold = fitElastica(section, options);
  if (!warm) return cold;
  if (!cold) return warm;
  if (usable(*cold) != usable(*warm)) return usable(*cold) ? cold : warm;
  return cold->R4 < kWorthAJump * warm->R4 ? cold : warm;
}

/// True if the blade that continues this fit keeps its radius and rests in its shape.
bool bladeHolds(const FitResult& fit, const Blade& blade) {
  const Result<Elastica> whole = extendedBlade(fit.elastica, blade.length);
  return whole && whole->maxCurvature() <= blade.maxCurvature() && stabilityMargin(*whole) > 0;
}

}  // namespace

Result<Elastica> extendedBlade(const Elastica& fitted, double bladeLength) {
  const double extra = 0.5 * (bladeLength - fitted.length());
  return extra > 0 ? fitted.segment(-extra, fitted.length() + extra) : Result<Elastica>(fitted);
}

Result<StationFit> fitStation(const PlanarCurve& section, const Job& job, const FitResult* neighbour) {
  FitOptions options = fitOptions(job, section.length());
  Result<FitResult> best = fitBesideNeighbour(section, options, neighbour);
  const double allowed = kAllowance * job.tolerance;
  if (!best) return tl::unexpected<Error>(best.error());
  if (!usable(*best) || best->hausdorff > allowed || bladeHolds(*best, job.blade))
    return StationFit{std::move(*best)};
  options.maxCurvature = job.blade.maxCurvature();
  options.curvatureRange = job.blade.length;
  std::optional<FitResult> restless;
  for (int k = 0; k < kPeriodBounds; ++k, *options.maxPeriods *= 0.5) {
    Result<FitResult> bounded = fitBesideNeighbour(section, options, neighbour ? neighbour : &*best);
    if (!bounded || !usable(*bounded) || bounded->hausdorff > allowed) break;
    if (!bladeHolds(*bounded, job.blade)) continue;
    if (bounded->status != FitStatus::iterationLimit) return StationFit{std::move(*bounded), true};
    if (!restless) restless = std::move(*bounded);
  }
  if (restless) return StationFit{std::move(*restless), true};
  return StationFit{std::move(*best)};
}

}  // namespace bw::detail
