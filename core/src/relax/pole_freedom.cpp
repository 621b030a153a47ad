// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "relax/pole_freedom.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace bw::relax {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

/// An end tangent's control point keeps at least this part of its distance.
constexpr double kShortestHandle = 0.05;

}  // namespace

PoleFreedom freedomOf(const Eigen::MatrixX2d& target, const RelaxOptions& options, double epsilon) {
  const Eigen::Index n = target.rows();
  PoleFreedom f;
  f.base = VectorXd::Zero(2 * n);
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> start, low, high;
  using Column = std::vector<std::pair<Eigen::Index, double>>;
  const auto add = [&](const Column& column, double value, double width, double least) {
    for (const auto& [row, share] : column) entries.emplace_back(row, Eigen::Index(start.size()), share);
    start.push_back(value);
    low.push_back(std::max(value - width, least));
    high.push_back(value + width);
  };
  const auto unit = [](Eigen::Index i, int c) { return Column{{2 * i + c, 1}}; };
  constexpr double none = -std::numeric_limits<double>::infinity();
  for (const bool atStart : {true, false}) {
    const Eigen::Index end = atStart ? 0 : n - 1, next = atStart ? 1 : n - 2;
    const Vector2d handle = (target.row(next) - target.row(end)).transpose();
    // A moving end takes its tangent's point along: both shares together stay within ε.
    const double share = options.tangents && !options.endpoints ? 0.5 * epsilon : epsilon;
    for (int c = 0; c < 2; ++c) {
      if (options.endpoints) {
        f.base[2 * end + c] = target(end, c);
        if (options.tangents) f.base[2 * next + c] = target(end, c);
      } else {
        Column column = unit(end, c);
        if (options.tangents) column.emplace_back(2 * next + c, 1);
        add(column, target(end, c), share, none);
      }
    }
    if (options.tangents) {
      const Vector2d t = handle.normalized();
      add({{2 * next, t.x()}, {2 * next + 1, t.y()}}, handle.norm(), share / t.cwiseAbs().maxCoeff(),
          kShortestHandle * handle.norm());
    } else {
      for (int c = 0; c < 2; ++c) add(unit(next, c), target(next, c), epsilon, none);
    }
  }
  for (Eigen::Index i = 2; i + 2 < n; ++i)
    for (int c = 0; c < 2; ++c) add(unit(i, c), target(i, c), epsilon, none);
  f.lift.resize(2 * n, Eigen::Index(start.size()));
  f.lift.setFromTriplets(entries.begin(), entries.end());
  f.start = Eigen::Map<VectorXd>(start.data(), Eigen::Index(start.size()));
  f.low = Eigen::Map<VectorXd>(low.data(), Eigen::Index(low.size()));
  f.high = Eigen::Map<VectorXd>(high.data(), Eigen::Index(high.size()));
  return f;
}

}  // namespace bw::relax
