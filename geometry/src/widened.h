// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <memory>

#include "level_curves.h"
#include "model_impl.h"

namespace bw::geometry {

/// A face that goes on beyond its borders as it ends there, and becomes straight. Planes that meet a block
/// obliquely need it where the face ends with the block: what lies at a corner between two of them is in the
/// section of neither (docs/mathematics.md, sections).
class WidenedFace {
 public:
  /// At least `by` mm wider on each side. None unless the target is one face, over the whole rectangle of its
  /// parameters, on a surface that goes on by its formula or is a spline, and not round.
  static std::shared_ptr<const WidenedFace> of(const Target::Impl& target, double by);

  const Target::Impl& target() const { return *target_; }
  /// Whether a place of it comes over the face itself as it is carried to and fro by `way`.
  bool reachedFromFace(const LevelNode& node, const Eigen::Vector3d& way) const;

 private:
  std::shared_ptr<const Target::Impl> target_;
  ParameterRange face_;  ///< of the face itself
};

}  // namespace bw::geometry
