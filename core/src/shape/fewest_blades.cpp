// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <limits>

#include "bw/core/shape/key_blades.h"
#include "shape/blade_distance.h"
#include "shape/fewest_keys.h"

namespace bw {

double detail::distanceOf(const KeyBlade& blade, const std::vector<Eigen::Vector2d>& samples) {
  const Result<Elastica> elastica = elasticaOf(blade);
  if (!elastica) return std::numeric_limits<double>::infinity();
  const std::vector<Eigen::Vector2d> own = elastica->sample(kBladeSamples);
  double largest = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) largest = std::max(largest, (own[i] - samples[i]).norm());
  return largest;
}

Result<FewestBlades> fewestBlades(const std::vector<PlacedCurve>& curves, double tolerance,
                                  const RunContext& context) {
  if (curves.size() < 2)
    return fail(ErrorCode::badInput, "key blades are made of two curves or more", "curves",
                double(curves.size()), 2.0);
  for (std::size_t i = 1; i < curves.size(); ++i)
    if (!(curves[i].y > curves[i - 1].y))
      return fail(ErrorCode::badInput, "the curves must be in order of y", "curves", curves[i].y,
                  curves[i - 1].y);
  std::vector<const PlanarCurve*> own;
  std::vector<std::vector<Eigen::Vector2d>> samples;
  for (const PlacedCurve& placed : curves) {
    own.push_back(&placed.curve);
    samples.push_back(placed.curve.sample(detail::kBladeSamples));
  }
  Result<std::vector<KeyBlade>> fitted = detail::fittedBlades(
      own, [&](std::size_t i) { return curves[i].y; }, context);
  if (!fitted) return tl::unexpected<Error>(fitted.error());
  for (std::size_t i = 0; i < curves.size(); ++i) {
    (*fitted)[i] = detail::rounded((*fitted)[i]);
    (*fitted)[i].y = curves[i].y;
  }
  std::vector<double> share;
  for (std::size_t i = 0; i < curves.size(); ++i)
    share.push_back(detail::countedShare(detail::distanceOf((*fitted)[i], samples[i]), tolerance));
  const auto of = [&](const detail::KeyList& keys) {
    std::vector<KeyBlade> blades;
    for (const std::size_t key : keys) blades.push_back((*fitted)[key]);
    return blades;
  };
  const auto missedBy = [&](const detail::KeyList& keys, double bound) -> Result<detail::Missed> {
    const Result<BladeSweep> sweep = BladeSweep::through(of(keys));
    if (!sweep) return tl::unexpected<Error>(sweep.error());
    detail::Missed worst;
    for (std::size_t i = 0; i < samples.size() && worst.deviation <= bound; ++i) {
      const double off = share[i] * detail::distanceOf(sweep->at(curves[i].y), samples[i]);
      if (off > worst.deviation) worst = {off, i};
    }
    return worst;
  };
  const Result<detail::FewestKeys> fewest = detail::fewestKeys(curves.size(), tolerance, missedBy, context);
  if (!fewest) return tl::unexpected<Error>(fewest.error());
  FewestBlades found{of(fewest->keys), 0, 0};
  const Result<BladeSweep> sweep = BladeSweep::through(found.blades);
  if (!sweep) return tl::unexpected<Error>(sweep.error());
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (const double off = detail::distanceOf(sweep->at(curves[i].y), samples[i]); off > found.deviation) {
      found.deviation = off;
      found.worst = i;
    }
  return found;
}

}  // namespace bw
