// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/shape/iso_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

namespace bw {

namespace {

constexpr double kSame = 1e-9;   // mm
constexpr double kClear = 0.05;  // of the chord, that a section runs along x
constexpr int kNewton = 50;

/// The levels of the rows of poles along a direction; empty where a row is not level, or the rows do not
/// ascend or descend.
std::optional<std::vector<double>> levelsOf(const SplineSurface& surface, const Eigen::Vector3d& direction) {
  std::vector<double> levels;
  for (int row = 0; row < surface.polesV; ++row) {
    const auto* poles = surface.poles.data() + std::ptrdiff_t(row) * surface.polesU;
    levels.push_back(direction.dot(poles[0]));
    for (int k = 1; k < surface.polesU; ++k)
      if (std::abs(direction.dot(poles[k]) - levels.back()) > kSame) return {};
  }
  const bool up = levels.back() > levels.front();
  for (std::size_t i = 1; i < levels.size(); ++i)
    if (up ? levels[i] <= levels[i - 1] : levels[i] >= levels[i - 1]) return {};
  return levels;
}

/// The span of flat knots that holds t.
int spanOf(const std::vector<double>& knots, int degree, int poles, double t) {
  const auto after = std::upper_bound(knots.begin() + degree + 1, knots.begin() + poles, t);
  return int(after - knots.begin()) - 1;
}

/// Blends rows of poles as the surface does at v.
template <class Row>
auto blended(const SplineSurface& surface, double v, const Row& row) {
  const int span = spanOf(surface.knotsV, surface.degreeV, surface.polesV, v);
  const std::array<double, 4> basis = splineBasis(surface.knotsV, surface.degreeV, span, v);
  std::decay_t<decltype(row(0))> sum = basis[0] * row(span - surface.degreeV);
  for (int k = 1; k <= surface.degreeV; ++k) sum += basis[std::size_t(k)] * row(span - surface.degreeV + k);
  return sum;
}

/// The v at which the surface lies at a level.
double parameterOf(const SplineSurface& surface, const std::vector<double>& levels, double level) {
  double low = surface.knotsV.front(), high = surface.knotsV.back();
  const bool up = levels.back() > levels.front();
  const auto at = [&](double v) {
    return blended(surface, v, [&](int row) { return levels[std::size_t(row)]; });
  };
  // Levels rise evenly: the secant between both ends, which halves where it is slow.
  double fLow = at(low) - level, fHigh = at(high) - level;
  for (int k = 0; k < kNewton && high - low > 0; ++k) {
    const double secant = low - fLow * (high - low) / (fHigh - fLow);
    const double v = k % 3 == 2 ? 0.5 * (low + high) : std::clamp(secant, low, high), f = at(v) - level;
    if (std::abs(f) < 1e-12 * std::max(1.0, std::abs(level))) return v;
    if ((f < 0) == up) {
      low = v;
      fLow = f;
    } else {
      high = v;
      fHigh = f;
    }
  }
  return 0.5 * (low + high);
}

/// True if all poles lie within the block but for the way along the direction, which one of its sides has.
bool within(const SplineSurface& surface, const Box& block, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d axes[] = {block.frame.x, block.frame.y, block.frame.normal};
  for (int axis = 0; axis < 3; ++axis) {
    const double along = std::abs(axes[axis].dot(direction));
    if (along > 1 - kSame) continue;
    if (along > kSame) return false;
    for (const Eigen::Vector3d& pole : surface.poles) {
      const double place = axes[axis].dot(pole - block.frame.origin);
      if (!(place >= 0 && place <= block.size(axis))) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<std::vector<Section>> isoSections(const SplineSurface& surface, const SplineSurface& before,
                                                const std::vector<Section>& like, const Box& block) {
  if (like.empty()) return {};
  const Eigen::Vector3d direction = like.front().frame.normal;
  const auto levels = levelsOf(surface, direction), were = levelsOf(before, direction);
  if (!levels || !were || !within(surface, block, direction)) return {};
  if (std::abs(levels->front() - were->front()) > kSame || std::abs(levels->back() - were->back()) > kSame)
    return {};
  std::vector<Section> sections;
  sections.reserve(like.size());
  const auto [low, high] = std::minmax(levels->front(), levels->back());
  for (const Section& one : like) {
    const Frame& frame = one.frame;
    const double level = direction.dot(frame.origin);
    if (one.chosen < 0 || level < low || level > high) return {};
    const double v = parameterOf(surface, *levels, level);
    std::vector<Eigen::Vector2d> poles;
    for (int k = 0; k < surface.polesU; ++k) {
      const Eigen::Vector3d pole = blended(surface, v, [&](int row) -> Eigen::Vector3d {
        return surface.poles[std::size_t(row) * std::size_t(surface.polesU) + std::size_t(k)];
      });
      poles.push_back(frame.toLocal(pole).head<2>());
    }
    const Eigen::Vector2d chord = poles.back() - poles.front();
    if (std::abs(chord.x()) <= kClear * chord.norm()) return {};
    Result<PlanarCurve> curve = PlanarCurve::bspline(surface.degreeU, surface.knotsU, std::move(poles));
    if (!curve) return {};
    sections.push_back({one.index, one.travel, frame, {chord.x() < 0 ? curve->reversed() : *curve}, 0});
  }
  return sections;
}

}  // namespace bw
