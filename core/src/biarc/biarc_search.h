// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "biarc/biarc_problem.h"
#include "biarc/biarc_select.h"
#include "bw/core/biarc/biarc.h"

namespace bw::biarc {

/// The chosen points of every start that the options ask for. `chain` is the data without repeats, `tube` the
/// order of its points.
Result<std::vector<Points>> chooseStarts(const std::vector<Eigen::Vector2d>& data, const Points& chain,
                                         const BiarcOptions& options, int count, TubeOrder& tube);

/// Points and tangents (the report's, if none are given) as nodes of a valid chain; an error that names the
/// points otherwise.
Result<std::vector<BiarcNode>> nodesOf(const Points& points,
                                       const std::optional<std::vector<double>>& tangents, bool closed);

/// The measure that the options minimise.
double objectiveOf(const BiarcMeasures& measures, const BiarcOptions& options);

/// What stages before the last are settled to.
inline constexpr double kRoughBiarcs = 1e-5;

struct BiarcOutcome {
  std::vector<BiarcNode> initial, nodes;
  int iterations = 0;
  bool converged = true, bounded = false;
  std::string message;
};

/// The search for a curve, on data of size 1. Lengths in the options are in that unit too; `size` is the
/// unit, which the weight needs. Refers to its arguments, which must outlive it.
class BiarcSearch {
 public:
  /// `chain` is the data without repeats.
  BiarcSearch(const std::vector<Eigen::Vector2d>& data, const Points& chain, const BiarcOptions& options,
              double size);

  /// A curve with chosen points: the best of all starts.
  Result<BiarcOutcome> fixed(const RunContext& context);
  /// The fewest biarcs that keep the tolerance.
  Result<BiarcOutcome> fewest(const RunContext& context);

 private:
  /// The rms, on a part of the data if there are many: brings a start near.
  BiarcDescent approach(const std::vector<BiarcNode>& start, const RunContext& context) const;
  /// Stages from the smooth measure to the asked one; the best curve by the asked one, never worse than the
  /// start. Ends early when no distance is larger than `enough`, or when none of the curves near can reach
  /// that. With very many data all but the end goes on a part of them.
  BiarcDescent minimise(const std::vector<BiarcNode>& start, double enough, const RunContext& context) const;
  /// The asked measure, in the data's unit and up to that factor; infinite for a chain that is not valid.
  /// Also gives the largest distance if asked for.
  double objective(const std::vector<BiarcNode>& nodes, double* largest = nullptr) const;
  /// Whether the curve strays farther from the chain of the data than its distances and the gaps between data
  /// points explain.
  bool strays(const std::vector<BiarcNode>& nodes) const;
  /// An open curve cut off where its end arcs run on beyond the data. No distance changes.
  std::vector<BiarcNode> trimmed(std::vector<BiarcNode> nodes) const;
  /// K points along the chain where the errors of a curve with other points would be equal.
  Points balanced(const std::vector<BiarcNode>& nodes, int count) const;
  /// Adds the farthest data point of each arc to `body`, where it lies nearly as far as any. False if none
  /// lies farther than those of `body`.
  bool addFarPoints(const std::vector<BiarcNode>& nodes, std::vector<Eigen::Vector2d>& body) const;
  BiarcTerm termOf(BiarcDistance distance) const;

  const std::vector<Eigen::Vector2d>& data_;
  const Points& chain_;
  const BiarcOptions& options_;
  double size_, gap_ = 0;
  std::vector<Eigen::Vector2d> part_;  ///< of the data, for `approach`; empty where they are few
  std::vector<Eigen::Vector2d> body_;  ///< for the stages of `minimise`; empty where all take part
  ChainDistance away_;
  TubeOrder tube_;
  BiarcFreedom freedom_;
};

}  // namespace bw::biarc
