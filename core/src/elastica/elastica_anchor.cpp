// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bw/core/elastica/elastica.h"
#include "bw/core/text/number_text.h"

namespace bw {

namespace {

/// What lies about a straight stretch deviates from it by no more than this, rad: then it grows
/// exponentially.
constexpr double kSmallDeviation = 1e-9;
/// Derivatives are carried over pieces of this many 1/√|λ|.
constexpr double kPieceLength = 3;
/// Derivatives stop growing here.
constexpr double kLargestDerivative = 1e150;

tl::unexpected<Error> refuse(const char* what, double value, const char* remedy, double limit) {
  return fail(
      ErrorCode::badInput,
      std::string("The ") + what + " of the elastica's anchor is " + shortText(value) + "; " + remedy + ".",
      what, value, limit);
}

}  // namespace

Result<Elastica> Elastica::makeAnchored(const Anchor& anchor, double length) {
  const double c = std::cos(anchor.angle);
  const double s = std::sin(anchor.angle);
  const Eigen::Vector2d force(c * anchor.force.x() - s * anchor.force.y(),
                              s * anchor.force.x() + c * anchor.force.y());
  // Its numbers are those of a curve that starts there.
  Result<Elastica> result = make(anchor.point, anchor.angle, anchor.curvature, force, length);
  if (!result) {
    return result;
  }
  const double phase = std::abs(anchor.at) / length +
                       std::abs(anchor.straight) / length;  // in lengths: bounds the way to the segment
  constexpr double kFarthest = 100;
  if (!(phase <= kFarthest)) {
    return refuse("arc length", anchor.at, "give one within a hundred lengths of the segment",
                  kFarthest * length);
  }
  if (anchor.straight < 0) {
    return refuse("straight", anchor.straight, "give half a length, at least 0", 0);
  }
  if (anchor.straight > 0) {
    const double tension = -anchor.force.x();
    if (!(tension > 0)) {
      return refuse("force along the tangent", anchor.force.x(),
                    "a straight stretch needs tension, a value below 0", 0);
    }
    if (anchor.curvature != 0 && anchor.force.y() != 0) {
      return refuse("curvature", anchor.curvature,
                    "beside a straight stretch either it or the force across must be 0", 0);
    }
    const double deviation =
        std::abs(anchor.force.y()) / tension + std::abs(anchor.curvature) / std::sqrt(tension);
    if (!(deviation <= kSmallDeviation)) {
      return refuse("deviation from the straight stretch", deviation, "give one below 1e-9", kSmallDeviation);
    }
  }
  result->anchored_ = true;
  result->anchor_ = anchor;
  const State start = result->at(0.0);
  result->start_ = start.point;
  result->startAngle_ = start.angle;
  result->startCurvature_ = start.curvature;
  return result;
}

void Elastica::anchoredAt(std::span<const double> s, std::span<State> out,
                          std::span<Jacobian> jacobians) const {
  at(s, out);
  // Along the curve as its anchor tells it, piece by piece: each piece has its own start, and the derivatives
  // chain.
  const double root = std::sqrt(force_.norm());
  std::vector<std::size_t> order(s.size());
  for (std::size_t i = 0; i < s.size(); ++i) {
    order[i] = i;
  }
  for (const double sign : {1.0, -1.0}) {
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return sign * s[a] < sign * s[b]; });
    Jacobian chain = Jacobian::Zero();
    chain.leftCols<4>().setIdentity();
    double from = 0;
    for (const std::size_t i : order) {
      if (sign * s[i] < 0 || (sign < 0 && s[i] == 0)) {
        continue;
      }
      const double way = std::abs(s[i] - from);
      const double pieces = std::max(1.0, std::ceil(way * std::max(root, 1 / length_) / kPieceLength));
      const double begin = from;
      for (double k = 1; k <= pieces; ++k) {
        const double to = k == pieces ? s[i] : begin + (s[i] - begin) * k / pieces;
        const State state = at(from);
        Elastica piece;
        piece.start_ = state.point;
        piece.startAngle_ = state.angle;
        piece.startCurvature_ = state.curvature;
        piece.force_ = force_;
        piece.length_ = length_;
        Jacobian local;
        piece.at(to - from, local);
        const Eigen::Matrix<double, 4, 2> forced = local.rightCols<2>();
        chain = (local.leftCols<4>() * chain).eval();
        chain.rightCols<2>() += forced;
        chain = chain.cwiseMax(-kLargestDerivative).cwiseMin(kLargestDerivative);
        from = to;
      }
      jacobians[i] = chain;
    }
  }
}

}  // namespace bw
