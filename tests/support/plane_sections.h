// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <vector>

#include "bw/core/surface/surface_sampler.h"
#include "bw/core/sweep/sweep.h"

namespace bw::test {

/// Sections in planes y = −step · i with x = X, y = Z, cutting towards −Y; `curve(i)` gives the i-th.
template <class Curve>
std::vector<Section> sectionsOf(int count, double step, Curve curve) {
  std::vector<Section> sections;
  for (int i = 0; i < count; ++i)
    sections.push_back({i,
                        step * i,
                        Frame{{0, -step * i, 0},
                              Eigen::Vector3d::UnitX(),
                              Eigen::Vector3d::UnitZ(),
                              -Eigen::Vector3d::UnitY()},
                        {curve(i)}});
  return sections;
}

/// The chain of points (x, height(x)) over |x| ≤ half.
template <class Height>
PlanarCurve graphCurve(double half, Height height, int points = 121) {
  std::vector<Eigen::Vector2d> chain;
  for (int k = 0; k < points; ++k) {
    const double x = half * (2.0 * k / (points - 1) - 1);
    chain.emplace_back(x, height(x));
  }
  return *PlanarCurve::points(chain);
}

/// The block under such sections: |x| ≤ half, y from −depth to 0, `low` ≤ z ≤ `high`.
inline Box blockUnder(double half, double depth, double low, double high) {
  return {
      Frame{
          {-half, -depth, low}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()},
      {2 * half, depth, high - low}};
}

/// How far (mm) a point lies outside of a block; less than 0 in it.
inline double outside(const Box& box, const Eigen::Vector3d& point) {
  const Frame& f = box.frame;
  const Eigen::Vector3d from = point - f.origin, at(from.dot(f.x), from.dot(f.y), from.dot(f.normal));
  const Eigen::Vector3d beyond = (-at).cwiseMax(at - box.size);
  return beyond.maxCoeff() < 0 ? beyond.maxCoeff() : beyond.cwiseMax(0).norm();
}

/// The surface z = height(x), whatever y: closest points by a fine table, within 1/400 of its width.
template <class Height>
class GraphSampler : public SurfaceSampler {
 public:
  GraphSampler(double half, Height height) : half_(half), height_(height) {}
  Result<Foot> closest(const Eigen::Vector3d& p, const Foot*) override {
    Foot foot;
    foot.distance = 1e300;
    for (int k = 0; k <= 400; ++k) {
      const double x = half_ * (k / 200.0 - 1);
      const Eigen::Vector3d q(x, p.y(), height_(x));
      const double distance = (p - q).norm();
      if (distance < foot.distance) foot = {0, {x, p.y()}, q, Eigen::Vector3d::UnitZ(), distance, false};
    }
    return foot;
  }
  Result<SurfaceJet> at(int, const Eigen::Vector2d& uv) const override {
    const double h = 1e-3 * half_, x = uv.x();
    const double slope = (height_(x + h) - height_(x - h)) / (2 * h);
    const double bend = (height_(x + h) - 2 * height_(x) + height_(x - h)) / (h * h);
    return SurfaceJet{{x, uv.y(), height_(x)},
                      {1, 0, slope},
                      {0, 1, 0},
                      {0, 0, bend},
                      Eigen::Vector3d::Zero(),
                      Eigen::Vector3d::Zero(),
                      Eigen::Vector3d(-slope, 0, 1).normalized()};
  }
  std::unique_ptr<SurfaceSampler> clone() const override { return std::make_unique<GraphSampler>(*this); }

 private:
  double half_;
  Height height_;
};

/// The number in `text` that follows the first `before`; NaN if there is none.
inline double numberAfter(const std::string& text, const std::string& before) {
  const std::size_t at = text.find(before);
  return at == std::string::npos ? std::nan("") : std::strtod(text.c_str() + at + before.size(), nullptr);
}

}  // namespace bw::test
