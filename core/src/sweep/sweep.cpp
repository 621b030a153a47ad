// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/sweep.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "bw/core/text/number_text.h"
#include "sweep/remedies.h"
#include "sweep/station_continuity.h"
#include "sweep/station_fit.h"

namespace bw {

namespace {

Eigen::Vector3d tangentAt(const Frame& frame, double angle) {
  return frame.directionToWorld({std::cos(angle), std::sin(angle)});
}

/// One fit a section. The longest section tells most of the blade: the row starts from it and goes to both
/// ends.
Result<std::vector<detail::StationFit>> fitRow(const std::vector<Section>& sections,
                                               const FitRequest& request, const RunContext& context) {
  const auto longer = [](const Section& a, const Section& b) { return a.curve.length() < b.curve.length(); };
  const auto start =
      std::size_t(std::max_element(sections.begin(), sections.end(), longer) - sections.begin());
  std::vector<detail::StationFit> fits(sections.size());
  std::size_t done = 0;
  const auto fit = [&](std::size_t i, const detail::StationFit* neighbour) -> Result<void> {
    if (context.stopped()) return stoppedError();
    context.report(double(done++) / double(sections.size()), "fitting");
    Result<detail::StationFit> fitted = detail::fitStation(sections[i].curve, request, neighbour);
    if (!fitted) {
      Error error = fitted.error();
      error.where = stationName(sections[i].index);
      error.message = error.where + ": " + error.message;
      return tl::unexpected<Error>(std::move(error));
    }
    fits[i] = neighbour ? detail::besideNeighbour(std::move(*fitted), *neighbour, sections[i].curve, request)
                        : std::move(*fitted);
    return {};
  };
  Result<void> ok = fit(start, nullptr);
  for (std::size_t i = start + 1; ok && i < sections.size(); ++i) ok = fit(i, &fits[i - 1]);
  for (std::size_t i = start; ok && i > 0; --i) ok = fit(i - 1, &fits[i]);
  if (!ok) return tl::unexpected<Error>(ok.error());
  return fits;
}

}  // namespace

Eigen::Vector3d Station::leftTangent() const { return tangentAt(frame, blade.startAngle()); }

Eigen::Vector3d Station::rightPoint() const { return frame.toWorld(blade.at(blade.length()).point); }

Eigen::Vector3d Station::rightTangent() const { return tangentAt(frame, blade.at(blade.length()).angle); }

Result<Sweep> buildSweep(std::vector<Section> sections, const FitRequest& request, const Box& block,
                         const Eigen::Vector3d& direction, const RunContext& context, Findings& findings,
                         double* fitSeconds, double* extendSeconds) {
  using Clock = std::chrono::steady_clock;
  if (sections.empty())
    return fail(ErrorCode::badInput,
                "there are no sections to fit; place the block so that it meets the target", "sections", 0.0,
                1.0);
  const auto fitStart = Clock::now();
  Sweep sweep{block, direction, request, {}};
  sweep.stations.reserve(sections.size());
  const Result<std::vector<detail::StationFit>> fits = fitRow(sections, request, context);
  if (!fits) return tl::unexpected<Error>(fits.error());
  double longest = 0;
  int longestIndex = 0;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    Section& section = sections[i];
    const detail::StationFit& fitted = (*fits)[i];
    const FitResult& fit = fitted.fit;
    Station station{.index = section.index,
                    .travel = section.travel,
                    .frame = section.frame,
                    .target = section.curve,
                    .targetLength = section.curve.length(),
                    .fit = fit,
                    .heldBack = fitted.heldBack,
                    .steadied = fitted.steadied};
    if (fit.elastica.length() > longest) {
      longest = fit.elastica.length();
      longestIndex = station.index;
    }
    sweep.stations.push_back(std::move(station));
  }
  const auto extendStart = Clock::now();
  if (longest > request.blade.length) {
    const std::optional<double> needed = detail::lengthFor(longest, request.clearance);
    const std::string other = "a smaller block, or another cutting direction";
    Error error{
        ErrorCode::badInput,
        "the blade of " + shortText(request.blade.length, 5) + " mm is shorter than the section of " +
            stationName(longestIndex) + " (" + shortText(longest, 6) + " mm); choose " +
            (needed ? "a blade of at least " + shortText(*needed, 6) + " mm, " + other
                    : other + ": no blade may be longer than " + shortText(Blade::kLongest, 6) + " mm"),
        stationName(longestIndex), request.blade.length, needed ? *needed : Blade::kLongest};
    if (needed) error.remedies = {OtherLength{*needed}};
    return tl::unexpected<Error>(std::move(error));
  }
  for (Station& station : sweep.stations) {
    const double length = station.fit.elastica.length();
    const Result<Elastica> blade = detail::extendedBlade(station.fit.elastica, request.blade.length);
    if (!blade) return tl::unexpected<Error>(blade.error());
    station.blade = *blade;
    station.extension = 0.5 * (request.blade.length - length) / length;
  }
  detail::addSwingFindings(sweep, findings);
  if (fitSeconds) *fitSeconds = std::chrono::duration<double>(extendStart - fitStart).count();
  if (extendSeconds) *extendSeconds = std::chrono::duration<double>(Clock::now() - extendStart).count();
  return sweep;
}

}  // namespace bw
