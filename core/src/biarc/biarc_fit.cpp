// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include "biarc/biarc_formula.h"
#include "biarc/biarc_search.h"
#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"

namespace bw {

using namespace biarc;

namespace {

/// Data of other sizes (mm) have squares outside of the numbers there are.
constexpr double kSmallest = 1e-150, kLargest = 1e150;

tl::unexpected<Error> passOn(const Error& error) { return tl::unexpected<Error>(error); }

Result<void> checkData(const std::vector<Eigen::Vector2d>& data) {
  for (std::size_t i = 0; i < data.size(); ++i)
    if (!data[i].allFinite())
      return fail(ErrorCode::badInput, "data point " + std::to_string(i) + " is not a pair of finite numbers",
                  "points[" + std::to_string(i) + "]");
  return {};
}

Result<void> checkOptions(const BiarcOptions& o) {
  const auto finite = [](const char* key, double value, double least) -> Result<void> {
    if (std::isfinite(value) && value >= least) return {};
    return fail(ErrorCode::badInput,
                std::string(key) + " must be a finite number of at least " + shortText(least) + ", not " +
                    shortText(value),
                key, value, least);
  };
  if (Result<void> ok = finite("tube", o.tube, 0); !ok) return ok;
  if (Result<void> ok = finite("weight", o.weight, 0); !ok) return ok;
  if (o.weight > 1)
    return fail(ErrorCode::badInput, "weight must lie in [0, 1], not " + shortText(o.weight), "weight",
                o.weight, 1);
  if (o.tolerance && !(std::isfinite(*o.tolerance) && *o.tolerance > 0))
    return fail(ErrorCode::badInput, "tolerance must be a positive number", "tolerance", o.tolerance, 0);
  if (o.maxIterations < 1 || o.maxArcs < 2)
    return fail(ErrorCode::badInput, "the limits of iterations and arcs must be at least 1 and 2", "limits");
  if (o.tangents)
    for (const double angle : *o.tangents)
      if (!std::isfinite(angle))
        return fail(ErrorCode::badInput, "the tangent angles must be finite numbers", "tangents");
  return {};
}

Result<Points> givenPoints(const std::vector<Eigen::Vector2d>& data, const BiarcOptions& o) {
  Points points = o.coordinates;
  if (o.select == BiarcSelect::index) {
    points.clear();
    for (const int index : o.indices) {
      if (index < 0 || index >= int(data.size()))
        return fail(ErrorCode::badInput,
                    "index " + std::to_string(index) + " names no data point; there are " +
                        std::to_string(data.size()) + ", counted from 0",
                    "indices", index, double(data.size()) - 1);
      points.push_back(data[std::size_t(index)]);
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite())
      return fail(ErrorCode::badInput,
                  "chosen point " + std::to_string(i) + " is not a pair of finite numbers",
                  "coordinates[" + std::to_string(i) + "]");
    const bool wraps = i + 1 == points.size();
    if ((!wraps || o.closed) && points[i] == points[(i + 1) % points.size()] && points.size() > 1)
      return fail(ErrorCode::badInput,
                  "the chosen points " + std::to_string(i) + " and " +
                      std::to_string((i + 1) % points.size()) + " coincide; drop one of them" +
                      (wraps ? " (a closed curve does not repeat its first point)" : ""),
                  "points");
  }
  return points;
}

}  // namespace

namespace biarc {

Result<std::vector<Points>> chooseStarts(const std::vector<Eigen::Vector2d>& data, const Points& chain,
                                         const BiarcOptions& o, int count, TubeOrder& tube) {
  constexpr int least = 2;
  const bool given =
      (o.select == BiarcSelect::index && !o.indices.empty()) || o.select == BiarcSelect::coordinates;
  if (given) {
    Result<Points> points = givenPoints(data, o);
    if (!points) return passOn(points.error());
    if (int(points->size()) < least)
      return fail(
          ErrorCode::badInput,
          "a curve of biarcs needs at least 2 chosen points; there are " + std::to_string(points->size()),
          "points", double(points->size()), least);
    return std::vector<Points>{std::move(*points)};
  }
  if (o.select == BiarcSelect::tube && count == 0) return std::vector<Points>{tube.within(o.tube)};
  if (count < least)
    return fail(ErrorCode::badInput, "say how many points to choose (at least 2), which ones, or a tolerance",
                "points", double(count), least);
  const int most = int(chain.size());
  const bool amongData = o.select == BiarcSelect::index || o.select == BiarcSelect::tube;
  if (count > (amongData ? most : std::max(most, 1000000)))
    return fail(ErrorCode::badInput,
                std::to_string(count) + " points cannot be chosen from " + std::to_string(most) +
                    " different data points; ask for fewer",
                "points", count, most);
  std::vector<Points> starts;
  const bool all = o.select == BiarcSelect::automatic;
  if (all || o.select == BiarcSelect::spacing) starts.push_back(selectBySpacing(chain, o.closed, count));
  if (all || o.select == BiarcSelect::curvature) starts.push_back(selectByCurvature(chain, o.closed, count));
  if (all && count > most) starts.push_back(selectAllAndBetween(chain, o.closed, count));
  if ((all && count <= most) || o.select == BiarcSelect::tube) starts.push_back(tube.last(count));
  if ((all && count <= most) || o.select == BiarcSelect::index)
    starts.push_back(selectByIndex(chain, o.closed, count));
  return starts;
}

Result<std::vector<BiarcNode>> nodesOf(const Points& points,
                                       const std::optional<std::vector<double>>& tangents, bool closed) {
  if (tangents && tangents->size() != points.size())
    return fail(ErrorCode::badInput,
                "there are " + std::to_string(tangents->size()) + " tangent angles for " +
                    std::to_string(points.size()) + " chosen points; give one for each",
                "tangents", double(tangents->size()), double(points.size()));
  Result<std::vector<double>> angles = std::vector<double>();
  if (tangents) {
    angles = *tangents;
  } else if (closed && points.size() == 2) {
    // Two points of a closed curve: across their connection, so that both halves bulge alike.
    const Eigen::Vector2d chord = points[1] - points[0];
    const double across = std::atan2(chord.y(), chord.x()) - kPi / 2;
    angles = std::vector<double>{across, across + kPi};
  } else {
    angles = biarcTangents(points, closed);
  }
  if (!angles) return passOn(angles.error());
  std::vector<BiarcNode> nodes;
  for (std::size_t i = 0; i < points.size(); ++i)
    nodes.emplace_back(points[i].x(), points[i].y(), (*angles)[i], 0);
  const BiarcChain chain(nodes, closed);
  if (!chain.valid())
    return fail(ErrorCode::noSolution,
                "between the chosen points " + std::to_string(chain.faulty()) + " and " +
                    std::to_string((chain.faulty() + 1) % int(points.size())) +
                    " a tangent points straight back along the chord, so that no biarc joins them; choose "
                    "other points or tangents",
                "points");
  return nodes;
}

double objectiveOf(const BiarcMeasures& m, const BiarcOptions& o) {
  const double distance = o.distance == BiarcDistance::mean  ? m.mean
                          : o.distance == BiarcDistance::rms ? m.rms
                                                             : m.max;
  const double curvature = o.curvature == BiarcCurvature::energy ? m.energy : m.angle;
  switch (o.goal) {
    case BiarcGoal::nothing:
      return 0;
    case BiarcGoal::distance:
      return distance;
    case BiarcGoal::curvature:
      return curvature;
    case BiarcGoal::combined:
      return (1 - o.weight) * distance + o.weight * curvature;
  }
  return 0;
}

}  // namespace biarc

Result<BiarcMeasures> measureBiarcs(const BiarcCurve& curve, const std::vector<Eigen::Vector2d>& data) {
  if (curve.arcs.empty() || data.empty())
    return fail(ErrorCode::badInput, "measures need at least one arc and one data point", "points");
  if (Result<void> ok = checkData(data); !ok) return passOn(ok.error());
  BiarcMeasures measures = measuresOf(curve.arcs, curve.closed, data);
  measures.away = ChainDistance(data, curve.closed).of(curve.arcs);
  return measures;
}

Result<BiarcResult> fitBiarcs(const std::vector<Eigen::Vector2d>& data, const BiarcOptions& options,
                              const RunContext& context) {
  const auto begin = std::chrono::steady_clock::now();
  if (Result<void> ok = checkData(data); !ok) return passOn(ok.error());
  if (Result<void> ok = checkOptions(options); !ok) return passOn(ok.error());
  const Points distinct = withoutRepeats(data, options.closed);
  const std::size_t least = options.closed ? 3 : 2;
  if (distinct.size() < least)
    return fail(ErrorCode::badInput,
                std::string(options.closed ? "a closed curve needs at least 3" : "a curve needs at least 2") +
                    " different data points; there are " + std::to_string(distinct.size()),
                "points", double(distinct.size()), double(least));
  // All is computed in units of the data's size, from its middle.
  Eigen::Vector2d low = data[0], high = data[0];
  for (const Eigen::Vector2d& p : data) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double size = (high / 2 - low / 2).stableNorm() * 2;
  if (!std::isfinite(size) || size < kSmallest || size > kLargest)
    return fail(ErrorCode::badInput,
                "the data are " + shortText(size) + " mm large; scale them to a size near 1", "points", size);
  const Eigen::Vector2d middle = low / 2 + high / 2;
  const auto shrink = [&](Points points) {
    for (Eigen::Vector2d& p : points) p = (p - middle) / size;
    return points;
  };
  BiarcOptions scaled = options;
  scaled.coordinates = shrink(options.coordinates);
  scaled.tube = options.tube / size;
  if (options.tolerance) scaled.tolerance = *options.tolerance / size;
  const bool chosen = options.points > 0 || options.select == BiarcSelect::coordinates ||
                      !options.indices.empty() || (options.select == BiarcSelect::tube && options.tube > 0);
  if (options.tolerance && !chosen) {
    scaled.goal = BiarcGoal::distance;
    scaled.distance = BiarcDistance::max;
  }
  const Points small = shrink(data), chain = withoutRepeats(small, options.closed);
  BiarcSearch search(small, chain, scaled, size);

  Result<BiarcOutcome> outcome =
      options.tolerance && !chosen ? search.fewest(context) : search.fixed(context);
  if (context.stopped()) return stoppedError();
  if (!outcome) return passOn(outcome.error());

  const auto curveOf = [&](const std::vector<BiarcNode>& nodes) {
    Points points;
    std::vector<double> tangents, shares;
    for (const BiarcNode& node : nodes) {
      points.push_back(node.head<2>() * size + middle);
      tangents.push_back(wrapAngle(node[2]));
      shares.push_back(1 / (1 + std::exp(-node[3])));
    }
    if (!options.closed) shares.pop_back();
    return biarcCurve(std::move(points), std::move(tangents), std::move(shares), options.closed);
  };
  const Result<BiarcCurve> first = curveOf(outcome->initial), last = curveOf(outcome->nodes);
  if (!first) return passOn(first.error());
  if (!last) return passOn(last.error());
  BiarcResult result;
  result.curve = *last;
  const Result<BiarcMeasures> before = measureBiarcs(*first, data), after = measureBiarcs(*last, data);
  if (!before) return passOn(before.error());
  if (!after) return passOn(after.error());
  result.initial = *before;
  result.measures = *after;
  result.objective = objectiveOf(result.measures, scaled);
  result.iterations = outcome->iterations;
  result.status = scaled.goal == BiarcGoal::nothing ? BiarcStatus::constructed
                  : !outcome->converged             ? BiarcStatus::iterationLimit
                  : outcome->bounded                ? BiarcStatus::boundActive
                                                    : BiarcStatus::converged;
  result.message = outcome->message;
  // The search works to the tolerance itself; the scaling may round.
  constexpr double kRounding = 1e-9;
  if (options.tolerance && result.measures.max > *options.tolerance * (1 + kRounding)) {
    result.status = BiarcStatus::toleranceExceeded;
    result.message = "data point " + std::to_string(result.measures.farthest) + " lies " +
                     shortText(result.measures.max) + " mm from the curve, the tolerance is " +
                     shortText(*options.tolerance) + " mm; allow more arcs";
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace bw
