// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Which rows of several blocks are to meet: one rule for those who fit them, measure their joints and draw
// their seams.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/sweep/joint_kerf.h"
#include "bw/core/sweep/joints.h"

namespace bw {

/// Two rows whose blocks lie side by side.
struct Neighbours {
  std::size_t first = 0, second = 0;  ///< among the rows, ascending
  Boundary boundary;                  ///< from the first one's block to the second one's
};

/// Whether two rows (indices) are of one surface, or may be.
using MayMeet = std::function<bool(std::size_t, std::size_t)>;

/// The pairs of rows that may meet and whose blocks (one a row) lie side by side, at most `apart` mm from
/// each other, with no third block between them whose row may meet both: such a one is nearer to each.
/// Ascending by both indices. Looks at all pairs.
[[nodiscard]] std::vector<Neighbours> neighboursAmong(const std::vector<BlockRow>& rows,
                                                      const std::vector<Box>& blocks, double apart,
                                                      const MayMeet& mayMeet);

/// A surface of its own, and the block that is cut along it.
struct SurfaceInBlock {
  const TriangleMesh& mesh;
  const Box& block;
};
/// True if two surfaces come to the boundary of their blocks as one does: at most `within` mm apart, along
/// half of what one of them has there, at least. They are led on to the boundary from a little inside of
/// their blocks, since a surface may end at the faces of its own.
[[nodiscard]] bool comeTogether(const SurfaceInBlock& first, const SurfaceInBlock& second,
                                const Boundary& boundary, double within);

/// `measureJoints` of these pairs.
[[nodiscard]] Result<Joints> measureJoints(const std::vector<BlockRow>& rows,
                                           const std::vector<RowKerf>& kerfs,
                                           const std::vector<Neighbours>& pairs, const JointRequest& request,
                                           const RunContext& context);

}  // namespace bw
