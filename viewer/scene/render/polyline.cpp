// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/render/polyline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace bw::scene {

namespace {

/// `count` points at equal shares of the length.
Polyline resampled(const Polyline& line, std::size_t count) {
  std::vector<double> s(line.size(), 0.0);
  for (std::size_t i = 1; i < line.size(); ++i) s[i] = s[i - 1] + (line[i] - line[i - 1]).norm();
  Polyline result;
  result.reserve(count);
  std::size_t k = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double target = s.back() * double(i) / double(count - 1);
    while (k + 2 < line.size() && s[k + 1] < target) ++k;
    const double length = s[k + 1] - s[k];
    result.push_back(line[k] + (length > 0 ? std::clamp((target - s[k]) / length, 0.0, 1.0) : 0.0) *
                                   (line[k + 1] - line[k]));
  }
  return result;
}

}  // namespace

double lengthOf(const Polyline& line) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) sum += (line[i + 1] - line[i]).norm();
  return sum;
}

bool usable(const Polyline& line) {
  return line.size() >= 2 &&
         std::all_of(line.begin(), line.end(), [](const Eigen::Vector3d& p) { return p.allFinite(); });
}

Segments edgesOf(const Box& box) {
  const std::array<Eigen::Vector3d, 8> corners = box.corners();
  Segments edges;
  for (std::size_t a = 0; a < 8; ++a)
    for (const std::size_t bit : {1u, 2u, 4u})
      if (!(a & bit)) edges.emplace_back(corners[a], corners[a | bit]);
  return edges;
}

std::pair<double, double> shareInBox(const Eigen::Vector3d& from, const Eigen::Vector3d& along,
                                     const Eigen::Vector3d& size, double least, double most) {
  for (int k = 0; k < 3; ++k) {
    if (along[k] == 0) {
      if (from[k] < 0 || from[k] > size[k]) return {1, 0};
      continue;
    }
    const auto [enter, leave] = std::minmax({-from[k] / along[k], (size[k] - from[k]) / along[k]});
    least = std::max(least, enter);
    most = std::min(most, leave);
  }
  return {least, most};
}

Segments dashes(const Polyline& line, double dash, double gap) {
  Segments result;
  if (!(dash > 0) || !(gap > 0)) return result;
  double phase = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double length = (line[i + 1] - line[i]).norm();
    if (!(length > 0)) continue;
    const Eigen::Vector3d direction = (line[i + 1] - line[i]) / length;
    for (double s = 0; s < length;) {
      const bool drawn = phase < dash;
      const double step = std::min(length - s, (drawn ? dash : dash + gap) - phase);
      if (drawn && step > 0) result.emplace_back(line[i] + s * direction, line[i] + (s + step) * direction);
      s += step;
      phase += step;
      if (phase >= dash + gap - 1e-12) phase = 0;
      if (step <= 0) break;
    }
  }
  return result;
}

std::vector<Polyline> beyondStation(const Polyline& blade, const Polyline& station) {
  if (!usable(blade)) return {};
  if (!usable(station)) return {blade};
  // The part that cuts ends where the blade comes nearest to the ends of the station.
  const auto nearest = [&](const Eigen::Vector3d& p) {
    return std::size_t(std::min_element(blade.begin(), blade.end(),
                                        [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
                                          return (a - p).squaredNorm() < (b - p).squaredNorm();
                                        }) -
                       blade.begin());
  };
  std::size_t first = nearest(station.front()), last = nearest(station.back());
  if (first > last) std::swap(first, last);
  std::vector<Polyline> pieces;
  if (first > 0) pieces.emplace_back(blade.rend() - std::ptrdiff_t(first + 1), blade.rend());
  if (last + 1 < blade.size()) pieces.emplace_back(blade.begin() + std::ptrdiff_t(last), blade.end());
  return pieces;
}

std::vector<Polyline> clipped(const Polyline& line, const Box& box, Side side) {
  std::vector<Polyline> pieces;
  if (!usable(line)) return pieces;
  Polyline piece;
  const auto close = [&] {
    if (piece.size() >= 2) pieces.push_back(piece);
    piece.clear();
  };
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    // The share [enter, leave] of the edge lies in the box.
    const Eigen::Vector3d p = box.frame.toLocal(line[i]), d = box.frame.toLocal(line[i + 1]) - p;
    const auto [enter, leave] = shareInBox(p, d, box.size, 0, 1);
    const auto add = [&](double from, double to) {
      if (!(to > from)) return;
      if (piece.empty()) piece.push_back(line[i] + from * (line[i + 1] - line[i]));
      piece.push_back(line[i] + to * (line[i + 1] - line[i]));
    };
    const bool met = leave > enter;
    if (side == Side::inside) {
      if (!met || enter > 0) close();
      if (met) add(enter, leave);
      if (met && leave < 1) close();
    } else {
      add(0, met ? enter : 1);
      if (met) {
        close();
        add(leave, 1);
      }
    }
  }
  close();
  return pieces;
}

Polyline bladeAt(const std::vector<Polyline>& blades, double playhead) {
  if (blades.empty() || !(playhead >= 0)) return {};
  const double position = std::min(playhead, double(blades.size() - 1));
  const std::size_t i = std::min(std::size_t(position), blades.size() - 1),
                    next = std::min(i + 1, blades.size() - 1);
  const double t = position - double(i);
  if (blades[i].size() < 2 || t == 0 || blades[next].size() < 2)
    return blades[i].size() < 2 ? Polyline{} : blades[i];
  const bool same = blades[i].size() == blades[next].size();
  const std::size_t count = std::max(blades[i].size(), blades[next].size());
  const Polyline a = same ? blades[i] : resampled(blades[i], count),
                 b = same ? blades[next] : resampled(blades[next], count);
  Polyline result(count);
  for (std::size_t k = 0; k < count; ++k) result[k] = (1 - t) * a[k] + t * b[k];
  return result;
}

}  // namespace bw::scene
