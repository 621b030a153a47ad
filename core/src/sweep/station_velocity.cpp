// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/station_velocity.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace bw::sweep {

namespace {

constexpr int kBlade = 20;  // parts of the whole blade whose ends are looked at too

/// Weights of the three-point derivative at t[i] for uneven spacing; one-sided at the ends
/// (docs/mathematics.md, velocity).
struct Stencil {
  int first = 0, count = 0;
  double weight[3] = {0, 0, 0};
};

Stencil derivativeStencil(const std::vector<double>& t, int i) {
  const int n = int(t.size());
  Stencil s;
  if (n == 2) {
    const double h = t[1] - t[0];
    s = {0, 2, {-1 / h, 1 / h, 0}};
    return s;
  }
  s.first = std::clamp(i - 1, 0, n - 3);
  s.count = 3;
  const double a = t[std::size_t(s.first)], b = t[std::size_t(s.first + 1)], c = t[std::size_t(s.first + 2)];
  const double x = t[std::size_t(i)];
  s.weight[0] = (2 * x - b - c) / ((a - b) * (a - c));
  s.weight[1] = (2 * x - a - c) / ((b - a) * (b - c));
  s.weight[2] = (2 * x - a - b) / ((c - a) * (c - b));
  return s;
}

/// Points of a station at material coordinates σ measured from the blade's middle, in space.
std::vector<Eigen::Vector3d> materialPoints(const BladePose& pose, const std::vector<double>& sigma) {
  std::vector<double> arcs(sigma.size());
  const double middle = 0.5 * pose.blade.length();
  for (std::size_t i = 0; i < sigma.size(); ++i) arcs[i] = middle + sigma[i];
  return pose.points(arcs);
}

}  // namespace

StationVelocity stationVelocity(const std::vector<BladePose>& poses, const std::vector<double>& travel,
                                std::size_t i, int columns, double cuttingSpeed) {
  const BladePose& pose = poses[i];
  const Stencil stencil = derivativeStencil(travel, int(i));
  const double length = pose.cut.length();
  std::vector<double> sigma;
  sigma.reserve(std::size_t(columns) + kBlade + 1);
  const double begin = pose.before - 0.5 * pose.blade.length();
  for (int c = 0; c < columns; ++c) sigma.push_back(begin + double(c) / (columns - 1) * length);
  for (int c = 0; c <= kBlade; ++c) sigma.push_back((double(c) / kBlade - 0.5) * pose.blade.length());
  std::vector<Eigen::Vector3d> velocity(sigma.size(), Eigen::Vector3d::Zero());
  for (int k = 0; k < stencil.count; ++k) {
    const std::vector<Eigen::Vector3d> points = materialPoints(poses[std::size_t(stencil.first + k)], sigma);
    for (std::size_t c = 0; c < sigma.size(); ++c) velocity[c] += stencil.weight[k] * points[c];
  }
  double fastestBlade = 0, fastest = 0;
  for (std::size_t c = 0; c < sigma.size(); ++c) {
    const double speed = velocity[c].norm();
    fastestBlade = std::max(fastestBlade, speed);
    if (c < std::size_t(columns)) fastest = std::max(fastest, speed);
  }
  StationVelocity result;
  for (int c = 0; c < columns; ++c) {
    const double speed = velocity[std::size_t(c)].norm();
    const double along = velocity[std::size_t(c)].dot(pose.frame.normal);
    const double across = velocity[std::size_t(c)].cross(pose.frame.normal).norm();
    result.angle.push_back(std::atan2(across, along));
    result.relative.push_back(fastest > 0 ? speed / fastest : 1.0);
    result.speed.push_back(fastestBlade > 0 ? speed / fastestBlade * cuttingSpeed : cuttingSpeed);
  }
  return result;
}

VelocitySpan spanOf(const StationVelocity& velocity, const std::vector<char>& held) {
  const bool all = std::ranges::count(held, 1) == 0;
  VelocitySpan span{0, 0, 1, std::numeric_limits<double>::infinity(), 0};
  double slowest = std::numeric_limits<double>::infinity(), fastest = 0, count = 0;
  for (std::size_t k = 0; k < velocity.angle.size(); ++k) {
    if (!all && !held[k]) continue;
    ++count;
    span.angleMean += velocity.angle[k];
    span.angleMax = std::max(span.angleMax, velocity.angle[k]);
    span.speedMin = std::min(span.speedMin, velocity.speed[k]);
    span.speedMax = std::max(span.speedMax, velocity.speed[k]);
    slowest = std::min(slowest, velocity.relative[k]);
    fastest = std::max(fastest, velocity.relative[k]);
  }
  span.angleMean /= count;
  span.relativeMin = fastest > 0 ? slowest / fastest : 1;
  return span;
}

}  // namespace bw::sweep
