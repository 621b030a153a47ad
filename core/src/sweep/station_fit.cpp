// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/station_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "bw/core/elastica/elastica_stability.h"
#include "fit/fit_distance.h"
#include "sweep/tight_section.h"

namespace bw::sweep {

namespace {

using Eigen::Vector2d;

constexpr int kPlaces = 101;

Vector2d meanOf(const std::vector<Vector2d>& points) {
  Vector2d mean = Vector2d::Zero();
  for (const Vector2d& p : points) mean += p / double(points.size());
  return mean;
}

/// A warm-started fit this much worse than its neighbour's is compared with a cold start.
constexpr double kSuspiciousGrowth = 2.0;
/// R4 below this is good whatever the neighbour says.
constexpr double kGoodResidual = 1e-4;
/// A slightly better minimum on another branch is not worth a jump of the blade.
constexpr double kWorthAJump = 0.7;
/// A curve that came to rest is taken in place of one that did not, up to this part of its residual.
constexpr double kSameResidual = 1 + 1e-6;
/// Periods that the whole blade may have: where it is much longer than the section, what it does beyond it
/// would otherwise be left to rounding.
constexpr double kBladePeriods = 2.0;
/// Bounds on the periods that are tried with the blade's radius: 1, ½, ¼, … of those asked for.
constexpr int kPeriodBounds = 7;
/// Part of its largest curvature to which a blade at its limit bends, and to which a fit is bounded: rounding
/// does not decide whether the blade holds, and a blade with weight bends a little more.
constexpr double kAtLimit = 1 - 1e-6, kAtLimitWithWeight = 0.98;
/// A blade that bends to this part of its bound presses against it.
constexpr double kPresses = 1 - 1e-4;
/// A section with a radius so many times smaller than the blade's is far beyond it.
constexpr double kFarBeyond = 10;

FitOptions fitOptions(const FitRequest& request, double sectionLength) {
  FitOptions options;
  options.length = request.fitLength;
  options.endpoints = request.fitEndpoints;
  options.tangents = request.fitTangents;
  options.maxPeriods = std::min(request.maxPeriods, kBladePeriods * sectionLength / request.blade.length);
  return options;
}

bool usable(const FitResult& fit) { return fit.status != FitStatus::infeasible; }

bool atRest(const FitResult& fit) { return usable(fit) && fit.status != FitStatus::iterationLimit; }

Result<FitResult> fitBesideNeighbour(const PlanarCurve& section, FitOptions options,
                                     const FitResult* neighbour) {
  if (!neighbour) return fitElastica(section, options);
  options.initial = neighbour->elastica;
  Result<FitResult> warm = fitElastica(section, options);
  if (warm && atRest(*warm) && warm->R4 <= std::max(kGoodResidual, kSuspiciousGrowth * neighbour->R4))
    return warm;
  options.initial.reset();
  Result<FitResult> cold = fitElastica(section, options);
  if (!warm) return cold;
  if (!cold) return warm;
  if (usable(*cold) != usable(*warm)) return usable(*cold) ? cold : warm;
  const double worth = atRest(*cold) && !atRest(*warm) ? kSameResidual : kWorthAJump;
  return cold->R4 < worth * warm->R4 ? cold : warm;
}

/// How a section is fitted where the nearest curve does not do for the whole blade.
FitOptions boundedOptions(FitOptions options, const FitRequest& request) {
  options.maxCurvature = curvatureLimit(request);
  options.curvatureRange = request.blade.length;
  return options;
}

/// Where the curvature of the section alone keeps the blade farther off than is allowed, or is far beyond
/// what it bends to, no search would find a better one than the straight blade or one at its radius. Empty
/// elsewhere, or where these lie farther off than is allowed although the curvature does not ask for it.
std::optional<StationFit> stiffFit(const PlanarCurve& section, const FitRequest& request) {
  const double limit = request.blade.maxCurvature(), allowed = kAllowance * request.tolerance;
  if (!TightSection::bendsBeyond(section, request.blade.minRadius()) || request.fitEndpoints ||
      request.fitTangents)
    return {};
  const TightSpot spot = TightSection(section).tightest(request.blade.minRadius());
  const bool tooTight = spot.distance > allowed;
  if (!tooTight && !(spot.distance > 0 && kFarBeyond * spot.radius * limit < 1)) return {};
  const Places places(section);
  std::optional<StationFit> best;
  for (const double curvature : {0.0, curvatureLimit(request), -curvatureLimit(request)}) {
    const Result<Elastica> arc =
        Elastica::make(Vector2d::Zero(), 0, curvature, Vector2d::Zero(), section.length());
    if (!arc) continue;
    const Elastica laid = places.laid(*arc);
    FitResult fit;
    fit.elastica = fit.initial = laid;
    fit.R4 = fit.R4initial = places.residual(laid);
    if (best && best->fit.R4 <= fit.R4) continue;
    fit.hausdorff = fit::oneSidedHausdorff(laid, section);
    fit.status = FitStatus::constraintsActive;
    fit.message = "the blade at its smallest radius, or straight: the section is too tight for it";
    if (bladeHolds(fit.elastica, request.blade)) best = StationFit{section, std::move(fit), true};
  }
  return best && (tooTight || best->fit.hausdorff <= allowed) ? std::move(best) : std::nullopt;
}

/// True if the blade that continues this fit bends as far as it may: then the nearest curve bends farther.
bool bladePresses(const FitResult& fit, const FitRequest& request) {
  const Result<Elastica> whole = extendedBlade(fit.elastica, request.blade.length);
  return whole && whole->maxCurvature() >= kPresses * curvatureLimit(request);
}

}  // namespace

Places::Places(const PlanarCurve& section) : points_(section.sample(kPlaces)), centre_(meanOf(points_)) {}

Elastica Places::laid(const Elastica& elastica) const {
  const std::vector<Vector2d> own = elastica.sample(kPlaces);
  const Vector2d centre = meanOf(own);
  double along = 0, across = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const Vector2d p = own[i] - centre, q = points_[i] - centre_;
    along += p.dot(q);
    across += p.x() * q.y() - p.y() * q.x();
  }
  const double angle = std::atan2(across, along);
  return elastica.transformed(angle, 1, centre_ - Eigen::Rotation2Dd(angle) * centre);
}

double Places::residual(const Elastica& elastica) const {
  return residual(elastica.sample(kPlaces), elastica.length());
}

double Places::residual(const BladePose& pose) const {
  std::vector<Elastica::State> states(kPlaces);
  pose.at(pose.cutArcs(kPlaces), states);
  std::vector<Vector2d> own;
  for (const Elastica::State& state : states) own.push_back(state.point);
  return residual(own, pose.cut.length());
}

double Places::residual(const std::vector<Vector2d>& own, double length) const {
  double sum = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const double weight = i == 0 || i + 1 == own.size() ? 0.5 : 1;
    sum += weight * (own[i] - points_[i]).squaredNorm();
  }
  return std::sqrt(sum / (kPlaces - 1)) / length;
}

Result<Elastica> extendedBlade(const Elastica& fitted, double bladeLength) {
  const double extra = 0.5 * (bladeLength - fitted.length());
  return extra > 0 ? fitted.segment(-extra, fitted.length() + extra) : Result<Elastica>(fitted);
}

double curvatureLimit(const FitRequest& request) {
  return (request.weight.isZero() ? kAtLimit : kAtLimitWithWeight) * request.blade.maxCurvature();
}

bool bladeHolds(const Elastica& cut, const Blade& blade) {
  const Result<Elastica> whole = extendedBlade(cut, blade.length);
  return whole && whole->maxCurvature() <= blade.maxCurvature() && stabilityMargin(*whole) > 0;
}

Result<StationFit> fitStation(const PlanarCurve& section, const FitRequest& request,
                              const StationFit* neighbour) {
  if (std::optional<StationFit> stiff = stiffFit(section, request)) return std::move(*stiff);
  const FitOptions options = fitOptions(request, section.length());
  const FitResult* start = neighbour ? &neighbour->fit : nullptr;
  const double allowed = kAllowance * request.tolerance;
  std::optional<Result<FitResult>> tried;  // with the first of the bounds
  if (neighbour && neighbour->heldBack) {
    // Most likely this one is held back too, and the nearest curve, which may be far from any blade, need not
    // be sought.
    tried = fitBesideNeighbour(section, boundedOptions(options, request), start);
    const Result<FitResult>& bounded = *tried;
    if (bounded && atRest(*bounded) && bounded->hausdorff <= allowed &&
        bladeHolds(bounded->elastica, request.blade) && bladePresses(*bounded, request))
      return StationFit{section, *bounded, true};
  }
  Result<FitResult> best = fitBesideNeighbour(section, options, start);
  if (!best) return tl::unexpected<Error>(best.error());
  if (!usable(*best) || best->hausdorff > allowed || bladeHolds(best->elastica, request.blade))
    return StationFit{section, std::move(*best)};
  FitOptions tighter = boundedOptions(options, request);
  std::optional<FitResult> restless;
  for (int k = 0; k < kPeriodBounds; ++k, *tighter.maxPeriods *= 0.5) {
    Result<FitResult> bounded =
        k == 0 && tried ? std::move(*tried) : fitBesideNeighbour(section, tighter, start ? start : &*best);
    if (!bounded || !usable(*bounded) || bounded->hausdorff > allowed) break;
    if (!bladeHolds(bounded->elastica, request.blade)) continue;
    if (atRest(*bounded)) return StationFit{section, std::move(*bounded), true};
    if (!restless) restless = std::move(*bounded);
  }
  if (restless) return StationFit{section, std::move(*restless), true};
  return StationFit{section, std::move(*best)};
}

}  // namespace bw::sweep
