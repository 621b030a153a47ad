// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/fit/elastica_fit.h"
#include "ipopt_fit.h"
#include "test_curves.h"

namespace {

using bw::ControlParameters;
using bw::Elastica;
using bw::FitResult;
using bw::FitStatus;
using bw::bench::IpoptFit;

// A fit counts as good as another up to this (R4, relatively, and besides).
constexpr double kAsGood = 1e-3, kBesides = 1e-8;

// Processor time: what else the machine does matters less.
double secondsSince(std::clock_t begin) { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; }

// The thesis's method beside ours, curve by curve and in turn: the first `count` test curves (12: the Béziers
// of the kinds of Figure 3.3). Both from the canonical guess; the time of ours includes making it, the time
// of IPOPT does not. A curve whose guess has no control parameters (a line or a circle) IPOPT cannot start
// from: it counts as not converged, and its time is left out.
void fitBesideIpopt(benchmark::State& state) {
  if (!bw::bench::haveIpopt()) {
    for (auto _ : state) {
    }
    state.SetLabel("skipped: built without IPOPT (Debian's coinor-libipopt-dev, scripts/setup --bench)");
    return;
  }
  const std::vector<bw::test::NamedCurve> curves = bw::test::fitCurves();
  const auto count = std::min(static_cast<std::size_t>(state.range(0)), curves.size());
  std::vector<double> ours(count, 1e9), theirs(count, 1e9);
  std::size_t oursConverged = 0, theirsConverged = 0, theirsBest = 0;
  std::string failures;
  bool first = true;
  for (auto _ : state) {
    oursConverged = theirsConverged = theirsBest = 0;
    for (std::size_t i = 0; i < count; ++i) {
      std::clock_t begin = std::clock();
      const FitResult fit = bw::fitElastica(curves[i].curve).value();
      ours[i] = std::min(ours[i], secondsSince(begin));
      oursConverged += fit.status == FitStatus::converged ? 1U : 0U;
      const std::optional<ControlParameters> start = fit.initial.controlParameters();
      IpoptFit other;
      if (start) {
        begin = std::clock();
        other = bw::bench::fitByIpopt(curves[i].curve, *start);
        if (other.iterations > 0) theirs[i] = std::min(theirs[i], secondsSince(begin));
      }
      const bool best = other.converged && other.R4 <= fit.R4 * (1 + kAsGood) + kBesides;
      theirsConverged += other.converged ? 1U : 0U;
      theirsBest += best ? 1U : 0U;
      if (first && !best) {
        char text[160];
        std::snprintf(text, sizeof text, "%s%s: %s after %d, R4 %.3g against %.3g",
                      failures.empty() ? "" : "; ", curves[i].name.c_str(),
                      !start            ? "no start"
                      : other.converged ? "another minimum"
                                        : "not converged",
                      other.iterations, other.R4, fit.R4);
        failures += text;
      }
    }
    first = false;
  }
  std::vector<double> ratios, mine, others;
  for (std::size_t i = 0; i < count; ++i) {
    if (theirs[i] > 1e8) continue;
    ratios.push_back(theirs[i] / ours[i]);
    mine.push_back(ours[i]);
    others.push_back(theirs[i]);
  }
  for (std::vector<double>* list : {&ratios, &mine, &others}) std::sort(list->begin(), list->end());
  char text[400];
  std::snprintf(
      text, sizeof text,
      "ours: %zu of %zu converged, median %.3f ms; IPOPT: %zu converged, %zu as good, median %.3f ms; "
      "IPOPT/ours: median %.1f, from %.1f to %.1f. ",
      oursConverged, count, 1e3 * mine[mine.size() / 2], theirsConverged, theirsBest,
      1e3 * others[others.size() / 2], ratios[ratios.size() / 2], ratios.front(), ratios.back());
  state.SetLabel(text + failures);
}
BENCHMARK(fitBesideIpopt)->Arg(12)->Arg(36)->Iterations(5)->Unit(benchmark::kMillisecond);

}  // namespace
