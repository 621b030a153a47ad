// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/sweep.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <utility>

#include "bw/core/text/number_text.h"
#include "sweep/remedies.h"
#include "sweep/station_fit.h"
#include "sweep/sweep_findings.h"

namespace bw {

namespace {

/// One fit a section. The longest section tells most of the blade: the row starts from it and goes to both
/// ends.
Result<std::vector<StationFit>> fitRow(const std::vector<Section>& sections, const FitRequest& request,
                                       const RunContext& context) {
  const auto longer = [](const Section& a, const Section& b) {
    return a.curve().length() < b.curve().length();
  };
  const auto start =
      std::size_t(std::max_element(sections.begin(), sections.end(), longer) - sections.begin());
  std::vector<std::optional<StationFit>> fits(sections.size());
  std::size_t done = 0;
  const auto fit = [&](std::size_t i, const StationFit* neighbour) -> Result<void> {
    if (context.stopped()) return stoppedError();
    context.report(double(done++) / double(sections.size()), "fitting");
    Result<StationFit> fitted = sweep::fitStation(sections[i].curve(), request, neighbour);
    if (!fitted) {
      Error error = fitted.error();
      error.where = stationName(sections[i].index);
      error.message = error.where + ": " + error.message;
      return tl::unexpected<Error>(std::move(error));
    }
    fits[i] = neighbour ? sweep::besideNeighbour(std::move(*fitted), *neighbour, sections[i].curve(), request)
                        : std::move(*fitted);
    return {};
  };
  Result<void> ok = fit(start, nullptr);
  for (std::size_t i = start + 1; ok && i < sections.size(); ++i) ok = fit(i, &*fits[i - 1]);
  for (std::size_t i = start; ok && i > 0; --i) ok = fit(i - 1, &*fits[i]);
  if (!ok) return tl::unexpected<Error>(ok.error());
  std::vector<StationFit> row;
  row.reserve(fits.size());
  for (std::optional<StationFit>& found : fits) row.push_back(std::move(*found));
  return row;
}

}  // namespace

Result<Sweep> buildSweep(const std::vector<Section>& all, const FitRequest& request, const Box& block,
                         const Eigen::Vector3d& direction, const RunContext& context, Findings& findings,
                         double* fitSeconds, double* extendSeconds) {
  using Clock = std::chrono::steady_clock;
  std::vector<Section> sections;
  std::ranges::copy_if(all, std::back_inserter(sections), [](const Section& s) { return s.chosen >= 0; });
  if (sections.empty())
    return fail(ErrorCode::badInput,
                "there are no sections to fit; place the block so that it meets the target", "sections", 0.0,
                1.0);
  const auto fitStart = Clock::now();
  Sweep sweep{block, direction, request, {}, {}};
  Result<std::vector<StationFit>> fits = fitRow(sections, request, context);
  if (!fits) return tl::unexpected<Error>(fits.error());
  sweep.fits = std::move(*fits);
  double longest = 0;
  int longestIndex = 0;
  for (std::size_t i = 0; i < sections.size(); ++i)
    if (const double length = sweep.fits[i].fit.elastica.length(); length > longest) {
      longest = length;
      longestIndex = sections[i].index;
    }
  const auto extendStart = Clock::now();
  if (longest > request.blade.length) {
    const std::optional<double> needed = sweep::lengthFor(longest, request.clearance);
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
  sweep.poses.reserve(sections.size());
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const Elastica& cut = sweep.fits[i].fit.elastica;
    const Result<Elastica> blade = sweep::extendedBlade(cut, request.blade.length);
    if (!blade) return tl::unexpected<Error>(blade.error());
    sweep.poses.push_back({sections[i].index, sections[i].travel, sections[i].frame, cut, *blade,
                           0.5 * (request.blade.length - cut.length()) / cut.length()});
  }
  sweep::addSwingFindings(sweep, findings);
  if (fitSeconds) *fitSeconds = std::chrono::duration<double>(extendStart - fitStart).count();
  if (extendSeconds) *extendSeconds = std::chrono::duration<double>(Clock::now() - extendStart).count();
  return sweep;
}

}  // namespace bw
