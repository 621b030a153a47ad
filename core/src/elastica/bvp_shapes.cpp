// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "elastica/bvp_shapes.h"

#include <cmath>

#include "elastica/bvp_hinged.h"
#include "elastica/bvp_search.h"

namespace bw::detail {

std::vector<UnitSolution> shapesOf(const CheckedProblem& problem, double maxTurning, int maxInflections) {
  std::vector<UnitSolution> result;
  if (problem.ends == HeldEnds::both) {
    for (const double turning : problem.turnings(maxTurning)) {
      const std::vector<UnitSolution> shapes = allShapes({problem.end, turning}, maxInflections);
      result.insert(result.end(), shapes.begin(), shapes.end());
    }
    return result;
  }
  result = problem.ends == HeldEnds::start ? allShapes({problem.end, 0, problem.ends}, maxInflections)
                                           : halfWaves(problem.end.norm(), maxInflections);
  std::erase_if(result, [&](const UnitSolution& shape) { return std::abs(shape.turning) > maxTurning; });
  return result;
}

}  // namespace bw::detail
