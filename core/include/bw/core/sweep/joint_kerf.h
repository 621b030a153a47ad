// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "bw/core/sweep/joints.h"
#include "bw/core/sweep/kerf_field.h"

namespace bw {

/// What the blade of a row melts: what stands of the surfaces meets, half of that beside its middle.
struct RowKerf {
  Kerf kerf;
  std::shared_ptr<const KerfField> field = nullptr;  ///< where it is told over speed

  double width(const Eigen::Vector3d& place) const { return field ? field->width(place) : kerf.width; }
  /// mm.
  double widest() const { return field ? widestKerf(kerf.table) : kerf.width; }
};

/// `measureJoints` of rows with their kerfs, one a row.
[[nodiscard]] Result<Joints> measureJoints(const std::vector<BlockRow>& rows,
                                           const std::vector<RowKerf>& kerfs, const JointRequest& request,
                                           const RunContext& context);

}  // namespace bw
