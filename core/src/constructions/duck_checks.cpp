// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "constructions/duck_checks.h"

#include <cmath>
#include <string>

namespace bw::constructions {

Result<void> checkDucks(const std::vector<Eigen::Vector2d>& points) {
  if (points.size() < 2)
    return fail(ErrorCode::badInput,
                "a spline needs at least 2 points; there are " + std::to_string(points.size()), "points",
                double(points.size()), 2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string where = "points[" + std::to_string(i) + "]";
    constexpr double kHuge = 1e100;
    if (!points[i].allFinite() || points[i].cwiseAbs().maxCoeff() > kHuge)
      return fail(ErrorCode::badInput, where + " is not a pair of finite numbers", where);
    if (i > 0 && !((points[i] - points[i - 1]).norm() > 0))
      return fail(ErrorCode::badInput, where + " coincides with the point before it; drop one of them",
                  where);
  }
  return {};
}

Result<void> checkTangents(const std::vector<double>& tangents, std::size_t points) {
  if (!tangents.empty() && tangents.size() != points)
    return fail(ErrorCode::badInput,
                "there are " + std::to_string(tangents.size()) + " tangent angles for " +
                    std::to_string(points) + " points; give one for each or none",
                "tangents", double(tangents.size()), double(points));
  for (std::size_t i = 0; i < tangents.size(); ++i)
    if (!std::isfinite(tangents[i]))
      return fail(ErrorCode::badInput, "tangents[" + std::to_string(i) + "] is not a finite number",
                  "tangents");
  return {};
}

}  // namespace bw::constructions
