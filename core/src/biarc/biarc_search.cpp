// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "biarc/biarc_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/work_meter.h"
#include "biarc/biarc_chain.h"

namespace bw::biarc {

namespace {

/// Starts are brought near on about this many of the data points.
constexpr std::size_t kPart = 1500;
/// With more data points than this only the best of several starts goes through all stages.
constexpr std::size_t kMany = 1000;
constexpr int kApproach = 80;  ///< iterations
/// With more than twice as many data points all stages but the end go on about so many of them.
constexpr std::size_t kBody = 3000;

/// About `count` of the points, or none if there are not many more.
Points thinned(const Points& data, std::size_t count) {
  Points part;
  const std::size_t step = data.size() / count;
  if (step <= 1) return part;
  for (std::size_t i = 0; i < data.size(); i += step) part.push_back(data[i]);
  part.push_back(data.back());
  return part;
}

}  // namespace

BiarcSearch::BiarcSearch(const std::vector<Eigen::Vector2d>& data, const Points& chain,
                         const BiarcOptions& options, double size)
    : data_(data),
      chain_(chain),
      options_(options),
      size_(size),
      away_(chain, options.closed),
      tube_(chain, options.closed) {
  freedom_.points = options.movePoints && options.goal != BiarcGoal::curvature;
  freedom_.tangents = options.turnTangents;
  freedom_.joints = options.moveJoints;
  freedom_.keepEnds = options.keepEnds;
  for (std::size_t i = 1; i < chain.size(); ++i) gap_ = std::max(gap_, (chain[i] - chain[i - 1]).norm());
  if (options.closed) gap_ = std::max(gap_, (chain.front() - chain.back()).norm());
  part_ = thinned(data, kPart);
  body_ = thinned(data, kBody);
}

BiarcTerm BiarcSearch::termOf(BiarcDistance distance) const {
  BiarcTerm term;
  term.distance =
      distance == BiarcDistance::mean ? BiarcTerm::Distance::smoothMean : BiarcTerm::Distance::power;
  term.curvature = options_.curvature;
  const double w = options_.goal == BiarcGoal::distance    ? 0
                   : options_.goal == BiarcGoal::curvature ? 1
                                                           : options_.weight;
  // In units of the data's size, a distance is 1/size and a curvature measure `size` times as large.
  term.distanceWeight = 1 - w;
  term.curvatureWeight = w / (size_ * size_);
  return term;
}

double BiarcSearch::objective(const std::vector<BiarcNode>& nodes, double* largest) const {
  const BiarcChain chain(nodes, options_.closed);
  if (!chain.valid()) return std::numeric_limits<double>::infinity();
  BiarcMeasures m = measuresOf(chain.arcs(), options_.closed, data_);
  if (largest != nullptr) *largest = m.max;
  m.energy /= size_ * size_;
  m.angle /= size_ * size_;
  return objectiveOf(m, options_);
}

bool BiarcSearch::strays(const std::vector<BiarcNode>& nodes) const {
  const BiarcChain chain(nodes, options_.closed);
  if (!chain.valid()) return true;
  const double largest = measuresOf(chain.arcs(), options_.closed, data_).max;
  return away_.of(chain.arcs()) > largest + gap_ / 2;
}

std::vector<BiarcNode> BiarcSearch::trimmed(std::vector<BiarcNode> nodes) const {
  if (options_.closed || options_.keepEnds || !freedom_.points) return nodes;
  const BiarcChain chain(nodes, false);
  if (!chain.valid()) return nodes;
  const std::vector<CircularArc>& arcs = chain.arcs();
  const ArcTree tree(arcs, false);
  const int last = int(arcs.size()) - 1;
  double from = std::numeric_limits<double>::infinity(), to = -from;
  int seed = 0;
  for (const Eigen::Vector2d& p : data_) {
    const ArcFoot foot = tree.nearest(p, seed);
    seed = foot.arc;
    if (foot.arc == 0) from = std::min(from, foot.s);
    if (foot.arc == last) to = std::max(to, foot.s);
  }
  // Shares that make the shortened arc and its neighbour a biarc again; kept from being extreme.
  const auto logitOf = [&](const CircularArc& first, const CircularArc& second, double& z) {
    const double chord = first.length * sinc(first.turning / 2);
    const double l = (second.end() - first.start).norm(), total = first.turning + second.turning;
    double share = 0.5;
    for (int i = 0; i < 200; ++i) share = chord * sinc(total / 2) / (l * sinc(share * total / 2));
    constexpr double kLeast = 0.02;
    if (!(share > kLeast && share < 1 - kLeast)) return false;
    z = std::log(share / (1 - share));
    return true;
  };
  if (std::isfinite(from) && from > 0 && last > 1) {
    CircularArc arc = arcs[0];
    const double turn = arc.curvature() * from;
    arc = {arc.pointAt(from), arc.startAngle + turn, arc.turning - turn, arc.length - from};
    if (double z = 0; arc.length > 0 && logitOf(arc, arcs[1], z))
      nodes.front() = {arc.start.x(), arc.start.y(), arc.startAngle, z};
  }
  if (to > 0 && to < arcs.back().length && last > 1) {
    CircularArc arc = arcs.back();
    arc = {arc.start, arc.startAngle, arc.curvature() * to, to};
    double z = 0;
    if (logitOf(arcs[std::size_t(last - 1)], arc, z)) {
      nodes.back() = {arc.end().x(), arc.end().y(), arc.endAngle(), 0};
      nodes[nodes.size() - 2][3] = z;
    }
  }
  return nodes;
}

BiarcDescent BiarcSearch::approach(const std::vector<BiarcNode>& start, const RunContext& context) const {
  const BiarcProblem problem(part_.empty() ? data_ : part_, options_.closed, freedom_);
  BiarcProblem::Limits limits;
  limits.iterations = std::min(options_.maxIterations, kApproach);
  limits.quiet = kRoughBiarcs;
  return problem.descend(start, termOf(BiarcDistance::rms), limits, context);
}

Points BiarcSearch::balanced(const std::vector<BiarcNode>& nodes, int count) const {
  const BiarcChain curve(nodes, options_.closed);
  const ArcTree tree(curve.arcs(), options_.closed);
  std::vector<double> errors(std::size_t(curve.biarcs()), 0);
  std::vector<std::size_t> owner;
  int seed = 0;
  double largest = 0;
  for (const Eigen::Vector2d& p : chain_) {
    const ArcFoot foot = tree.nearest(p, seed);
    seed = foot.arc;
    owner.push_back(std::size_t(foot.arc / 2));
    errors[owner.back()] = std::max(errors[owner.back()], foot.distance);
    largest = std::max(largest, foot.distance);
  }
  // A biarc's error grows like the cube of its length.
  std::vector<double> density(errors.size());
  for (std::size_t k = 0; k < density.size(); ++k)
    density[k] = std::cbrt(std::max(errors[k], 0.03 * largest)) /
                 (curve.arcs()[2 * k].length + curve.arcs()[2 * k + 1].length);
  std::vector<double> measure{0};
  for (std::size_t i = 1; i < chain_.size() + (options_.closed ? 1 : 0); ++i)
    measure.push_back(measure.back() +
                      (chain_[i % chain_.size()] - chain_[i - 1]).norm() * density[owner[i - 1]]);
  return selectByMeasure(chain_, options_.closed, count, measure);
}

Result<BiarcOutcome> BiarcSearch::fixed(const RunContext& context) {
  Result<std::vector<Points>> starts = chooseStarts(data_, chain_, options_, options_.points, tube_);
  if (!starts) return tl::unexpected<Error>(starts.error());
  struct Start {
    std::vector<BiarcNode> initial, near;
    double value;
  };
  std::vector<Start> list;
  std::optional<Error> error;
  int iterations = 0;
  const bool filter = options_.goal != BiarcGoal::nothing && starts->size() > 1 && data_.size() > kMany;
  for (const Points& points : *starts) {
    Result<std::vector<BiarcNode>> nodes = nodesOf(points, options_.tangents, options_.closed);
    if (!nodes) {
      error = error ? error : nodes.error();
      continue;
    }
    Start start{*nodes, *nodes, 0};
    if (filter) {
      BiarcDescent end = approach(*nodes, context);
      iterations += end.iterations;
      start.value = end.value;
      start.near = std::move(end.nodes);
    }
    list.push_back(std::move(start));
  }
  if (list.empty()) return tl::unexpected<Error>(*error);
  if (filter) {
    std::stable_sort(list.begin(), list.end(),
                     [](const Start& a, const Start& b) { return a.value < b.value; });
    list.resize(1);
  }
  std::optional<BiarcOutcome> best;
  double reached = 0;
  bool stray = false;
  for (const Start& start : list) {
    if (context.stopped()) return stoppedError();
    BiarcOutcome outcome{start.initial, start.initial, 0, true, false, ""};
    double value = objective(start.initial);
    if (options_.goal != BiarcGoal::nothing) {
      const BiarcDescent end = minimise(start.near, -1, context);
      iterations += end.iterations;
      if (end.value <= value) {
        outcome.nodes = trimmed(end.nodes);
        value = end.value;
      }
      outcome.converged = end.converged;
      outcome.bounded = end.bounded;
    }
    const bool strange = strays(outcome.nodes);
    if (best && (strange != stray ? strange : !(value < reached))) continue;
    best = std::move(outcome);
    reached = value;
    stray = strange;
  }
  best->iterations = iterations;
  if (!best->converged)
    best->message = "the limit of iterations was reached before the measure settled";
  else if (best->bounded)
    best->message = "a tangent is held where it points almost straight back; other points may do better";
  return *best;
}

Result<BiarcOutcome> BiarcSearch::fewest(const RunContext& context) {
  const double tolerance = *options_.tolerance;
  const int most =
      std::max(2, std::min(int(chain_.size()), options_.maxArcs / 2 + (options_.closed ? 0 : 1)));
  BiarcOutcome best;
  int iterations = 0;
  bool met = false;
  const auto attempt = [&](int count) -> bool {
    Result<std::vector<Points>> starts = chooseStarts(data_, chain_, options_, count, tube_);
    if (!starts) return false;
    if (!best.nodes.empty()) starts->push_back(balanced(best.nodes, count));
    struct Start {
      std::vector<BiarcNode> initial;
      BiarcDescent near;
    };
    std::vector<Start> list;
    for (const Points& points : *starts) {
      const Result<std::vector<BiarcNode>> nodes = nodesOf(points, std::nullopt, options_.closed);
      if (!nodes || context.stopped()) continue;
      BiarcDescent near = approach(*nodes, context);
      iterations += near.iterations;
      // The rms is never larger than the maximum.
      if (near.value <= tolerance || list.empty()) list.push_back({*nodes, std::move(near)});
    }
    std::stable_sort(list.begin(), list.end(),
                     [](const Start& a, const Start& b) { return a.near.value < b.near.value; });
    const std::size_t tries = data_.size() > kMany ? 2 : list.size();
    for (std::size_t i = 0; i < std::min(tries, list.size()); ++i) {
      std::vector<BiarcNode> nodes = list[i].near.nodes;
      if (list[i].near.value <= tolerance) {
        BiarcDescent end = minimise(nodes, tolerance, context);
        iterations += end.iterations;
        nodes = std::move(end.nodes);
      }
      nodes = trimmed(std::move(nodes));
      const bool enough = objective(nodes) <= tolerance && !strays(nodes);
      if (enough || (!met && i == 0)) best = {list[i].initial, nodes, 0, true, false, ""};
      met = met || enough;
      if (enough) return true;
    }
    return false;
  };
  int low = 1, high = 2;  // the number of points: too few, enough
  const auto ended = [&] { return context.stopped() || detail::workExhausted(); };
  while (!attempt(high) && high < most && !ended()) {
    low = high;
    high = std::min(most, 2 * high);
  }
  while (high - low > 1 && !ended()) {
    const int middle = (low + high) / 2;
    (attempt(middle) ? high : low) = middle;
  }
  // What failed from the starts of the first search may go from the solution itself.
  while (met && high > 2 && !ended() && attempt(high - 1)) --high;
  best.iterations = iterations;
  if (best.nodes.empty())
    return fail(ErrorCode::noSolution,
                "no curve of biarcs could be begun from these data; choose points by hand", "points");
  return best;
}

}  // namespace bw::biarc
