// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "biarc/biarc_search.h"

#include <algorithm>
#include <cmath>

namespace bw::detail {

Result<BiarcOutcome> BiarcSearch::fixed(const Points& chain, const RunContext& context) const {
  Result<std::vector<Points>> starts = chooseStarts(data_, chain, options_, options_.points);
  if (!starts) return tl::unexpected<Error>(starts.error());
  std::optional<BiarcOutcome> best;
  std::optional<Error> error;
  double reached = 0;
  int iterations = 0;
  for (const Points& points : *starts) {
    if (context.stopped()) return stoppedError();
    Result<std::vector<BiarcNode>> nodes = nodesOf(points, options_.tangents, options_.closed);
    if (!nodes) {
      error = error ? error : nodes.error();
      continue;
    }
    BiarcOutcome outcome{*nodes, *nodes, 0, true, ""};
    double value = objective(*nodes);
    if (options_.goal != BiarcGoal::nothing) {
      BiarcDescent end = minimise(*nodes, -1, context);
      outcome.nodes = std::move(end.nodes);
      outcome.converged = end.converged;
      iterations += end.iterations;
      value = end.value;
    }
    if (best && !(value < reached)) continue;
    best = std::move(outcome);
    reached = value;
  }
  if (!best) return tl::unexpected<Error>(*error);
  best->iterations = iterations;
  if (!best->converged) best->message = "the limit of iterations was reached before the measure settled";
  return *best;
}

Result<BiarcOutcome> BiarcSearch::fewest(const Points& chain, const RunContext& context) const {
  const double tolerance = *options_.tolerance;
  const int most = std::max(2, std::min(int(chain.size()), options_.maxArcs / 2 + (options_.closed ? 0 : 1)));
  BiarcOutcome best;
  int iterations = 0;
  const auto attempt = [&](int count) -> bool {
    const Result<std::vector<Points>> starts = chooseStarts(data_, chain, options_, count);
    if (!starts) return false;
    for (const Points& points : *starts) {
      const Result<std::vector<BiarcNode>> nodes = nodesOf(points, std::nullopt, options_.closed);
      if (!nodes || context.stopped()) continue;
      const BiarcDescent end = minimise(*nodes, tolerance, context);
      iterations += end.iterations;
      const BiarcChain curve(end.nodes, options_.closed);
      const bool enough = measuresOf(curve.arcs(), options_.closed, data_).max <= tolerance;
      if (enough || best.nodes.empty()) best = {*nodes, end.nodes, 0, true, ""};
      if (enough) return true;
    }
    return false;
  };
  int low = 1, high = 2;  // the number of points: too few, enough
  while (!attempt(high) && high < most && !context.stopped()) {
    low = high;
    high = std::min(most, 2 * high);
  }
  while (high - low > 1 && !context.stopped()) {
    const int middle = (low + high) / 2;
    (attempt(middle) ? high : low) = middle;
  }
  best.iterations = iterations;
  if (best.nodes.empty())
    return fail(ErrorCode::noSolution,
                "no curve of biarcs could be begun from these data; choose points by hand", "points");
  return best;
}

}  // namespace bw::detail
