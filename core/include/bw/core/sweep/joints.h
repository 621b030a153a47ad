// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/base/units.h"
#include "bw/core/sweep/sweep.h"

namespace bw {

/// How well cuts of neighbouring blocks are to meet.
struct JointRequest {
  double gap = 0.1;              ///< mm between their surfaces, and
  double kink = fromDegrees(1);  ///< rad between these, at the boundary, that are allowed
  double apart = 0;              ///< mm between two faces of blocks that still are neighbours
  bool operator==(const JointRequest&) const = default;
};

/// mm between two faces of blocks that lie against each other.
inline constexpr double kTouching = 0.5;

/// Where two blocks lie side by side: the part of the plane midway between their faces that both have.
struct Boundary {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< its middle
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< unit, from the first block to the second
  double apart = 0;                                   ///< mm between the faces
};
/// That of two blocks whose faces look at each other from at most `apart` (but kTouching at least) mm away,
/// over more than a millimetre each way; empty where they do not, or are turned against each other.
[[nodiscard]] std::optional<Boundary> boundaryOf(const Box& first, const Box& second, double apart);

/// A row of blades and the block that it cuts.
struct BlockRow {
  std::string block, cut;  ///< ids
  const Sweep* sweep = nullptr;
  int surface = 0;  ///< rows of the same surface meet
};

/// How two rows meet at the boundary of their blocks.
struct Joint {
  std::size_t first = 0, second = 0;             ///< among the rows
  double gapMax = 0, gapMean = 0;                ///< mm between the surfaces, over all places
  double kinkMax = 0;                            ///< rad between them
  double gapAtStations = 0, kinkAtStations = 0;  ///< likewise, over those that are stations of one of them
  Eigen::Vector3d gapAt = Eigen::Vector3d::Zero(), kinkAt = Eigen::Vector3d::Zero();  ///< the worst places
  int places = 0;  ///< at which it was measured
  int open = 0;    ///< at which one of the surfaces comes to the boundary and the other one does not
  Eigen::Vector3d openAt = Eigen::Vector3d::Zero();  ///< one of them
};

/// The joints of a design.
struct Joints {
  std::vector<Joint> joints;  ///< those along which a surface goes on
  Findings findings;          ///< of those that exceed the request
  double gapMax() const;      ///< mm; 0 where there are none
  double kinkMax() const;     ///< rad
  /// True if all keep the request at the stations, but not between them: more stations may help.
  bool wantsStations(const JointRequest& request) const;
};

/// Which rows have neighbours: one entry a row.
[[nodiscard]] std::vector<char> joined(const std::vector<BlockRow>& rows, const std::vector<Box>& blocks,
                                       double apart);

/// Measures how rows of neighbouring blocks meet, with the weight of their blades: at all stations and at
/// three places between any two of them, on the smooth way of the blade, each blade going on as it does to
/// the plane midway between the blocks. The gap is the distance of the two surfaces there, the kink the angle
/// between their blades, or, where one row ends as the other one begins, between their normals. Rows meet
/// that are of one surface and have one family of planes. Fails with `cancelled` alone. Some 0.2 ms a place.
[[nodiscard]] Result<Joints> measureJoints(const std::vector<BlockRow>& rows, const JointRequest& request,
                                           const RunContext& context);

}  // namespace bw
