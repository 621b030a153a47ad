// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "biarc/biarc_select.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace bw::biarc {

namespace {

/// Arc length of the chain at each point; one value more if closed.
std::vector<double> lengthsOf(const Points& chain, bool closed) {
  std::vector<double> lengths{0};
  for (std::size_t i = 1; i < chain.size() + (closed ? 1 : 0); ++i)
    lengths.push_back(lengths.back() + (chain[i % chain.size()] - chain[i - 1]).norm());
  return lengths;
}

}  // namespace

Points withoutRepeats(const Points& data, bool closed) {
  Points chain;
  for (const Eigen::Vector2d& p : data)
    if (chain.empty() || p != chain.back()) chain.push_back(p);
  while (closed && chain.size() > 1 && chain.back() == chain.front()) chain.pop_back();
  return chain;
}

Points selectByMeasure(const Points& chain, bool closed, int count, const std::vector<double>& measure) {
  Points result;
  result.reserve(std::size_t(count));
  std::size_t at = 0;
  for (int i = 0; i < count; ++i) {
    if (!closed && i + 1 == count) {
      result.push_back(chain.back());
      break;
    }
    const double goal = measure.back() * i / (closed ? count : count - 1);
    while (at + 2 < measure.size() && measure[at + 1] <= goal) ++at;
    const double step = measure[at + 1] - measure[at];
    const double t = step > 0 ? std::clamp((goal - measure[at]) / step, 0.0, 1.0) : 0;
    result.push_back((1 - t) * chain[at] + t * chain[(at + 1) % chain.size()]);
  }
  return result;
}

Points selectBySpacing(const Points& chain, bool closed, int count) {
  return selectByMeasure(chain, closed, count, lengthsOf(chain, closed));
}

Points selectAllAndBetween(const Points& chain, bool closed, int count) {
  const std::vector<double> lengths = lengthsOf(chain, closed);
  const std::size_t edges = lengths.size() - 1;
  // Each further point halves, thirds, … the edge with the longest parts.
  std::vector<int> parts(edges, 1);
  std::priority_queue<std::pair<double, std::size_t>> longest;
  for (std::size_t i = 0; i < edges; ++i) longest.emplace(lengths[i + 1] - lengths[i], edges - i);
  for (std::size_t left = std::size_t(count) - chain.size(); left > 0; --left) {
    const std::size_t i = edges - longest.top().second;
    longest.pop();
    longest.emplace((lengths[i + 1] - lengths[i]) / ++parts[i], edges - i);
  }
  Points result;
  result.reserve(std::size_t(count));
  for (std::size_t i = 0; i < edges; ++i)
    for (int k = 0; k < parts[i]; ++k) {
      const double t = double(k) / parts[i];
      result.push_back((1 - t) * chain[i] + t * chain[(i + 1) % chain.size()]);
    }
  if (!closed) result.push_back(chain.back());
  return result;
}

Points selectByIndex(const Points& chain, bool closed, int count) {
  Points result;
  const double last = closed ? double(chain.size()) : double(chain.size() - 1);
  for (int i = 0; i < count; ++i)
    result.push_back(chain[std::size_t(std::lround(last * i / (closed ? count : count - 1)))]);
  return result;
}

Points selectByCurvature(const Points& chain, bool closed, int count) {
  const std::vector<double> lengths = lengthsOf(chain, closed);
  const std::size_t size = chain.size(), edges = lengths.size() - 1;
  const auto edge = [&](std::size_t i) -> Eigen::Vector2d { return chain[(i + 1) % size] - chain[i % size]; };
  // The turning at a point is spread over half of each edge beside it.
  std::vector<double> turning(edges + 1, 0);
  std::vector<double> atEdge(edges, 0);
  for (std::size_t i = closed ? 0 : 1; i < (closed ? size : size - 1); ++i) {
    const Eigen::Vector2d in = edge((i + size - 1) % size), out = edge(i);
    const double turn = std::abs(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out)));
    atEdge[(i + edges - 1) % edges] += turn / 2;
    atEdge[i] += turn / 2;
  }
  for (std::size_t i = 0; i < edges; ++i) turning[i + 1] = turning[i] + atEdge[i];
  std::vector<double> measure(edges + 1);
  for (std::size_t i = 0; i <= edges; ++i)
    measure[i] = lengths[i] / lengths.back() + (turning.back() > 0 ? turning[i] / turning.back() : 0);
  return selectByMeasure(chain, closed, count, measure);
}

}  // namespace bw::biarc
