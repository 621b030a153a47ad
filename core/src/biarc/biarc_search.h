// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "biarc/biarc_problem.h"
#include "biarc/biarc_select.h"
#include "bw/core/biarc.h"

namespace bw::detail {

/// The chosen points of every start that the options ask for. `chain` is the data without repeats.
Result<std::vector<Points>> chooseStarts(const std::vector<Eigen::Vector2d>& data, const Points& chain,
                                         const BiarcOptions& options, int count);

/// Points and tangents (the report's, if none are given) as nodes of a valid chain; an error that names the
/// points otherwise.
Result<std::vector<BiarcNode>> nodesOf(const Points& points,
                                       const std::optional<std::vector<double>>& tangents, bool closed);

/// The measure that the options minimise.
double objectiveOf(const BiarcMeasures& measures, const BiarcOptions& options);

struct BiarcOutcome {
  std::vector<BiarcNode> initial, nodes;
  int iterations = 0;
  bool converged = true;
  std::string message;
};

/// The search for a curve, on data of size 1. Lengths in the options are in that unit too; `size` is the
/// unit, which the weight needs.
class BiarcSearch {
 public:
  BiarcSearch(const std::vector<Eigen::Vector2d>& data, const BiarcOptions& options, double size);

  /// A curve with chosen points: the best of all starts.
  Result<BiarcOutcome> fixed(const Points& chain, const RunContext& context) const;
  /// The fewest biarcs that keep the tolerance.
  Result<BiarcOutcome> fewest(const Points& chain, const RunContext& context) const;

  /// Stages from the smooth measure to the asked one; the best curve by the asked one, never worse than the
  /// start. Ends early when no distance is larger than `enough`.
  BiarcDescent minimise(const std::vector<BiarcNode>& start, double enough, const RunContext& context) const;
  /// The asked measure, in the data's unit and up to that factor; infinite for a chain that is not valid.
  double objective(const std::vector<BiarcNode>& nodes) const;

 private:
  BiarcTerm termOf(BiarcDistance distance) const;

  const std::vector<Eigen::Vector2d>& data_;
  const BiarcOptions& options_;
  double size_;
  BiarcFreedom freedom_;
};

}  // namespace bw::detail
