// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/station_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

#include "bw/core/elastica/elastica_stability.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/text/number_text.h"
#include "fit/fit_distance.h"
#include "sweep/held_blade.h"
#include "sweep/remedies.h"
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
/// A section with a radius so many times smaller than the blade's is far beyond it.
constexpr double kFarBeyond = 10;

/// The curvature to which a blade is fitted at most, 1/mm: a little less than it bends to.
double curvatureLimit(const FitRequest& request) {
  return (request.weight.isZero() ? kAtLimit : kAtLimitWithWeight) * request.blade.maxCurvature();
}

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

/// The smallest radius of a section, mm, a third of which bends sharper than the blade may; none otherwise.
std::optional<double> mostlySharper(const PlanarCurve& section, const Blade& blade) {
  constexpr int kPlacesLooked = 129;
  int sharper = 0;
  double most = 0;
  for (int k = 0; k < kPlacesLooked; ++k) {
    const double bend =
        std::abs(section.curvature(section.parameterAt(section.length() * k / double(kPlacesLooked - 1))));
    sharper += bend > blade.maxCurvature();
    most = std::max(most, bend);
  }
  return 3 * sharper > kPlacesLooked ? std::optional(1 / most) : std::nullopt;
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
  Result<FitResult> best = fitBesideNeighbour(section, options, start);
  if (!best) return tl::unexpected<Error>(best.error());
  // Ends, tangents and length leave nothing to be bent for the sake of the blade.
  const bool determined =
      request.fitEndpoints && request.fitTangents && request.fitLength != FitOptions::Length::free;
  if (determined || !usable(*best) || best->hausdorff > allowed || bladeHolds(best->elastica, request.blade))
    return StationFit{section, std::move(*best)};
  FitOptions tighter = boundedOptions(options, request);
  std::optional<FitResult> restless;
  for (int k = 0; k < kPeriodBounds; ++k, *tighter.maxPeriods *= 0.5) {
    Result<FitResult> bounded = fitBesideNeighbour(section, tighter, start ? start : &*best);
    if (!bounded || !usable(*bounded) || bounded->hausdorff > allowed) break;
    if (!bladeHolds(bounded->elastica, request.blade)) continue;
    if (atRest(*bounded)) return StationFit{section, std::move(*bounded), true};
    if (!restless) restless = std::move(*bounded);
  }
  if (restless) return StationFit{section, std::move(*restless), true};
  return StationFit{section, std::move(*best)};
}

Error tooShort(const FitRequest& request, const PlanarCurve& section, const std::string& where,
               double longest) {
  const std::string words =
      "the blade of " + shortText(request.blade.length, 5) + " mm " +
      (longest > request.blade.length
           ? std::string("is shorter than")
           : "leaves less than the clearance of " + shortText(request.clearance, 4) + " mm at both ends of") +
      " the section of " + where + " (" + shortText(longest, 6) + " mm)";
  const std::optional<double> needed = lengthFor(longest, request.clearance);
  if (const std::optional<double> radius = mostlySharper(section, request.blade))
    return {ErrorCode::badInput,
            words + ", much of which bends sharper than the blade may (to a radius of " +
                shortText(*radius, 3) + " mm, the blade to " + shortText(request.blade.minRadius(), 3) +
                " mm), so that no longer one cuts it; make it gentler, or choose a blade that bends more",
            where, request.blade.length, needed.value_or(Blade::kLongest)};
  const std::string other = "a smaller block, or another cutting direction";
  Error error{ErrorCode::badInput,
              words + "; choose " +
                  (needed ? "a blade of " + shortText(*needed, 6) + " mm or longer, " + other
                          : other + ": no blade may be longer than " + shortText(Blade::kLongest, 6) + " mm"),
              where, request.blade.length, needed ? *needed : Blade::kLongest};
  if (needed) error.remedies = {OtherLength{*needed}};
  return error;
}

void compare(const BladePose& pose, const InFoam& foam, StationFit& fit) {
  fit.fit.R4 = Places(fit.target).residual(pose);
  double from = pose.before, to = pose.before + pose.cut.length();
  if (foam.slanted()) {
    // From the first of its places that are in the block to the last, unless it only touches that.
    const std::vector<double> arcs = pose.cutArcs(kPlaces);
    const std::vector<Eigen::Vector3d> places = pose.points(arcs);
    const auto holds = [&](const Eigen::Vector3d& place) { return foam.holds(place); };
    const auto first = std::ranges::find_if(places, holds);
    const auto last = std::find_if(places.rbegin(), places.rend(), holds).base();
    if (last - first > 1) {
      from = arcs[std::size_t(first - places.begin())];
      to = arcs[std::size_t(last - places.begin()) - 1];
    }
  }
  fit.fit.hausdorff = fit::oneSidedHausdorff({to - from,
                                              [&](auto part, auto out) {
                                                std::vector<double> whole(part.begin(), part.end());
                                                for (double& s : whole) s += from;
                                                pose.at(whole, out);
                                              }},
                                             fit.target);
}

Result<void> fitInto(Sweep& sweep, std::size_t i, const StationFit* neighbour) {
  BladePose& pose = sweep.poses[i];
  Result<StationFit> found = fitStation(sweep.fits[i].target, sweep.request, neighbour);
  if (!found) {
    Error error = found.error();
    error.where = stationName(pose.index);
    error.message = error.where + ": " + error.message;
    return tl::unexpected<Error>(std::move(error));
  }
  const double length = sweep.request.blade.length;
  if (const double cut = found->fit.elastica.length(); cut > length)
    return tl::unexpected<Error>(tooShort(sweep.request, sweep.fits[i].target, stationName(pose.index), cut));
  const Result<Elastica> blade = extendedBlade(found->fit.elastica, length);
  if (!blade) return tl::unexpected<Error>(blade.error());
  pose.cut = found->fit.elastica;
  pose.blade = *blade;
  pose.before = 0.5 * (length - pose.cut.length());
  sweep.fits[i] = std::move(*found);
  return {};
}

void hangInto(Sweep& sweep, std::size_t i) {
  if (sweep.request.weight.isZero()) return;
  BladePose& pose = sweep.poses[i];
  const Result<Hanging> hanging =
      hang(pose.blade, sweep.request.blade.flexuralRigidity(), weightIn(sweep, pose.frame));
  if (!hanging) {
    sweep.fits[i].unknown = hanging.error().message;
    return;
  }
  pose.heavy = hanging->blade;
  sweep.fits[i].snapsAt = hanging->snapsAt;
}

Result<void> fromLongest(
    const Sweep& sweep, const RunContext& context,
    const std::function<Result<void>(std::size_t i, std::optional<std::size_t> from)>& find) {
  const auto shorter = [](const StationFit& a, const StationFit& b) {
    return a.target.length() < b.target.length();
  };
  const std::size_t n = sweep.fits.size();
  const auto start = std::size_t(std::ranges::max_element(sweep.fits, shorter) - sweep.fits.begin());
  if (Result<void> ok = find(start, {}); !ok) return ok;
  std::mutex told;
  std::size_t done = 1;
  std::array<Result<void>, 2> ways;
  const Result<void> ok = parallelFor(context, 2, [&](int k) {
    const bool back = k == 1;
    Result<void>& way = ways[std::size_t(k)];
    for (std::size_t i = start; way && (back ? i > 0 : i + 1 < n); back ? --i : ++i) {
      if (context.stopped()) way = stoppedError();
      if (way) way = find(back ? i - 1 : i + 1, i);
      const std::lock_guard lock(told);
      context.report(double(++done) / double(n), "fitting");
    }
  });
  if (!ok) return ok;
  return ways[0] ? ways[1] : ways[0];
}

}  // namespace bw::sweep
