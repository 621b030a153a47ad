// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// The stages of a minimisation, from the smooth measure to the asked one.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "base/work_meter.h"
#include "biarc/biarc_search.h"

namespace bw::biarc {

namespace {

/// Rounds in which the farthest points of each arc join the part of very many data while the maximum is made
/// small, and the share of the largest distance from which on they do.
constexpr int kBodyRounds = 4;
constexpr double kFarPoints = 0.8;
/// Points are farther than those known only if it is by more than this part.
constexpr double kSame = 1e-3;
/// Iterations with all of very many data, from the minimum on a part of them.
constexpr int kLastIterations = 12;
/// By how much of the largest distance the kink of the mean distance is rounded off, from stage to stage.
constexpr double kRounded[] = {0.1, 0.01, 1e-3, 1e-4};
/// Distances below are rounding, in units of the data's size.
constexpr double kLeastDistance = 1e-12;

}  // namespace

BiarcDescent BiarcSearch::minimise(const std::vector<BiarcNode>& start, double enough,
                                   const RunContext& context) const {
  std::vector<Eigen::Vector2d> body = body_.empty() ? data_ : body_;
  const BiarcProblem onBody(body, options_.closed, freedom_), onAll(data_, options_.closed, freedom_);
  BiarcDescent best{start, objective(start), 0, true, false};
  std::vector<BiarcNode> nodes = start;
  double largest = 0;  // distance, of the points that the last stage saw
  const auto keep = [&] {
    const double reached = objective(nodes, &largest);
    if (!(reached < best.value)) return;
    best.value = reached;
    best.nodes = nodes;
  };
  const auto stage = [&](const BiarcProblem& problem, const BiarcTerm& term, bool final) {
    BiarcProblem::Limits limits{options_.maxIterations, enough};
    if (!final || !body_.empty()) limits.quiet = kRoughBiarcs;
    if (&problem == &onAll) limits.iterations = std::min(limits.iterations, kLastIterations);
    const BiarcDescent end = problem.descend(nodes, term, limits, context);
    nodes = end.nodes;
    best.iterations += end.iterations;
    // With all of very many data the minimum on a part of them is only finished.
    best.converged = end.converged || (&problem == &onAll && best.converged);
    best.bounded = end.bounded;
    if (body_.empty() || &problem == &onAll)
      keep();
    else
      largest = measuresOf(BiarcChain(nodes, options_.closed).arcs(), options_.closed, body).max;
    return end.value;
  };
  const auto finish = [&](const BiarcTerm& term) {
    stage(onBody, term, true);
    if (!body_.empty()) stage(onAll, term, true);
  };
  const BiarcTerm smooth = termOf(BiarcDistance::rms);
  if (smooth.distanceWeight == 0 || options_.distance == BiarcDistance::rms) {
    finish(smooth);
    return best;
  }
  // A power mean is never larger than the maximum, so neither is its minimum.
  double bound = stage(onBody, smooth, false);
  BiarcTerm term = termOf(options_.distance);
  if (options_.distance == BiarcDistance::mean) {
    const double scale = std::max(largest, kLeastDistance);
    for (const double part : kRounded) {
      term.epsilon = part * scale;
      if (part == std::end(kRounded)[-1]) break;
      stage(onBody, term, false);
    }
    finish(term);
    return best;
  }
  constexpr double kPowers[] = {6, 16, 48, 144, 432};
  const auto hopeless = [&] { return enough > 0 && bound > enough; };
  for (const double power : kPowers) {
    if (context.stopped() || largest <= enough || hopeless()) break;
    term.power = power;
    bound = stage(onBody, term, power == std::end(kPowers)[-1]);
  }
  for (int round = 0; !body_.empty(); ++round) {
    keep();
    if (round == kBodyRounds || context.stopped() || detail::workExhausted() || largest <= enough ||
        hopeless())
      break;
    if (!addFarPoints(nodes, body)) break;
    stage(onBody, term, true);
  }
  return best;
}

bool BiarcSearch::addFarPoints(const std::vector<BiarcNode>& nodes,
                               std::vector<Eigen::Vector2d>& body) const {
  const BiarcChain curve(nodes, options_.closed);
  if (!curve.valid()) return false;
  const ArcTree tree(curve.arcs(), options_.closed);
  const double known = measuresOf(curve.arcs(), options_.closed, body).max;
  std::vector<std::pair<double, std::size_t>> farthest(curve.arcs().size(), {0, 0});
  double largest = 0;
  int seed = 0;
  for (std::size_t i = 0; i < data_.size(); ++i) {
    const ArcFoot foot = tree.nearest(data_[i], seed);
    seed = foot.arc;
    largest = std::max(largest, foot.distance);
    auto& own = farthest[std::size_t(foot.arc)];
    if (foot.distance > own.first) own = {foot.distance, i};
  }
  if (largest <= known * (1 + kSame)) return false;
  for (const auto& [distance, i] : farthest)
    if (distance > kFarPoints * largest) body.push_back(data_[i]);
  return true;
}

}  // namespace bw::biarc
