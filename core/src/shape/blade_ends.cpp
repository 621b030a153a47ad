// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/shape/blade_ends.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"

namespace bw {

Result<std::array<Eigen::Vector2d, 2>> bladeEnds(const KeyBlade& blade) {
  const Result<Elastica> curve = elasticaOf(blade);
  if (!curve) return tl::unexpected<Error>(curve.error());
  const std::vector<Eigen::Vector2d> ends = curve->sample(2);
  return std::array{ends.front(), ends.back()};
}

Result<KeyBlade> withEndHeights(const KeyBlade& blade, const EndHeights& heights) {
  const Result<std::array<Eigen::Vector2d, 2>> ends = bladeEnds(blade);
  if (!ends) return tl::unexpected<Error>(ends.error());
  const auto& [left, right] = *ends;
  const double toLeft = heights[0].value_or(left.y()), toRight = heights[1].value_or(right.y());
  if (std::max(std::abs(toLeft - left.y()), std::abs(toRight - right.y())) <= kEndMiss) return blade;
  const Eigen::Vector2d chord = right - left;
  const double rise = toRight - toLeft, length = chord.norm();
  if (!(std::abs(rise) <= length + kEndMiss))
    return fail(ErrorCode::badInput,
                "the ends of the key blade at y = " + shortText(blade.y, 6) + " are " + shortText(length, 6) +
                    " mm apart, so that one cannot lie " + shortText(std::abs(rise), 6) +
                    " mm higher than the other; make it longer, or the heights more alike",
                "end_heights", rise, length);
  // A blade that runs to the left goes on to do so.
  const double up = length > 0 ? std::asin(std::clamp(rise / length, -1.0, 1.0)) : 0;
  const double turn =
      length > 0 ? std::remainder((chord.x() < 0 ? kPi - up : up) - std::atan2(chord.y(), chord.x()), 2 * kPi)
                 : 0;
  const bool both = heights[0] && heights[1];
  const Eigen::Vector2d about = both ? Eigen::Vector2d((left + right) / 2) : heights[0] ? right : left;
  KeyBlade turned = blade;
  turned.middle = about + Eigen::Rotation2Dd(turn) * (blade.middle - about);
  if (both) turned.middle.y() += (toLeft + toRight) / 2 - about.y();
  turned.angle += turn;
  return turned;
}

KeyBlade bladeBeyond(const KeyBlade& blade, const KeyBlade& change, double way) {
  return {blade.y + way,
          blade.middle + way * change.middle,
          blade.angle + way * change.angle,
          blade.length + way * change.length,
          blade.bend + way * change.bend,
          blade.force + way * change.force,
          blade.turn + way * change.turn};
}

}  // namespace bw
