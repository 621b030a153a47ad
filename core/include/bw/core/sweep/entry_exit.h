// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/motion/motion.h"
#include "bw/core/sweep/sweep.h"

namespace bw {

/// How a blade is led through the air between a slack shape that its grips decide, an arc, and the shape of
/// an end of its row. All poses lie in one plane, clear of the block.
struct BladeWay {
  std::vector<BladePose>
      poses;             ///< in the order of travel: from the arc on, or to it; empty if none is known
  double margin = 1;     ///< the least on it, as the robots move from pose to pose
  std::string why = {};  ///< why none is known
};

/// What the entry and the exit of a row are planned with.
struct EntryExitRequest {
  double margin = 0.15;  ///< of stability, that the blade keeps on the way
  double lead = 20;      ///< mm, of the motion (`MotionRequest`)
  /// mm above the face that the block lies on; empty where that is not known (`CheckRequest`).
  std::optional<double> floor = std::nullopt;
  bool operator==(const EntryExitRequest&) const = default;
};

struct EntryExit {
  BladeWay entry, exit;
  Findings findings = {};
};

/// Plans both: the curvature and the force at the middle of the weightless blade go evenly from those of the
/// arc to those of the station, and its grips hold the blade that hangs. Each of some ways is followed as
/// robots make it, and the first that keeps the margin (or that of the station, where that is less) is taken.
/// One that comes below the floor is raised, evenly towards the arc, as far as the planes stand upright, but
/// not over what the station itself keeps (docs/mathematics.md, sweep). `cancelled` on a stop. Some 3 ms.
[[nodiscard]] Result<EntryExit> planEntryExit(const Sweep& sweep, const EntryExitRequest& request,
                                              const RunContext& context);

/// How the blades of a row follow each other.
struct MotionRequest {
  double cuttingSpeed = 20;  ///< mm/s of the fastest point
  double lead = 20;  ///< mm of travel before the first and after the last station, with the shape held
  double motionTolerance = 0.1;                ///< mm, with which the targets were chosen
  std::optional<double> floor = std::nullopt;  ///< as for `EntryExitRequest`
  bool operator==(const MotionRequest&) const = default;
};

/// Times entry, targets (`RowMotion`) and exit so that the fastest point of the blade, with its weight and at
/// four instants from each target to the next, moves at the cutting speed, adds the leads, and puts the ends
/// in the block frame, places and times as programs state them. Quaternions keep one sign along the path. A
/// lead that would end with a part of the blade in the block is grown until all of it is outside, which a
/// finding tells; so are targets that follow in less than kTargetSeconds, and how low the blade comes on the
/// way in, between stations and on the way out where that is below the floor (`NearBottom`: the range has the
/// stations beside, -1 for none, and counts 0 of them).
Result<Motion> buildMotion(const Sweep& sweep, const EntryExit& ends, const std::vector<BladePose>& targets,
                           const MotionRequest& request, Findings& findings);

}  // namespace bw
