// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/design/design.h"
#include "bw/core/files/shared_bytes.h"
#include "bw/core/shape/designed_surface.h"
#include "bw/core/sweep/blade_lengths.h"
#include "bw/core/sweep/entry_exit.h"
#include "bw/core/sweep/joints.h"
#include "bw/core/sweep/kerf.h"
#include "bw/core/sweep/row_motion.h"
#include "bw/core/sweep/section_request.h"
#include "bw/core/sweep/sweep_check.h"
#include "bw/geometry/cad_model.h"
#include "bw/geometry/sections.h"

namespace bw::pipeline {

/// A file at some moment, as far as that tells whether it was written since.
struct FileStamp {
  std::filesystem::path path;
  std::uintmax_t size = 0;
  std::int64_t changed = 0;  ///< ns: when it was written, replaced or renamed last; 0 where it is not there
  bool operator==(const FileStamp&) const = default;

  static FileStamp of(const std::filesystem::path& file);
};

/// What is read: a surface or bytes that a design holds, or else a file.
struct SourceRequest {
  FileStamp file;  ///< only its path where there are bytes, which names them
  SharedBytes bytes;
  ReadOptions options;
  std::optional<DesignedSurface> surface = std::nullopt;  ///< then nothing else is asked for
  bool operator==(const SourceRequest&) const = default;
};

/// What key blades tell, and how sharp a blade may bend.
struct ToldRequest {
  std::optional<DesignedSurface> surface = std::nullopt;
  double minRadius = 0;  ///< mm
  bool operator==(const ToldRequest&) const = default;
};

/// How many planes a tolerance asks for.
struct CountRequest {
  geometry::Setup setup;
  double tolerance = 0;
  bool operator==(const CountRequest&) const = default;
};

/// Planes through a target that lies in its block; their number is known.
struct PlanesRequest {
  geometry::Setup setup;
  SectionRequest sections;
  double beyond = 0;  ///< mm along the blade that sections are followed beyond the block
  bool operator==(const PlanesRequest&) const = default;
};

/// A row of blades in a block.
struct RowRequest {
  geometry::Setup setup;
  FitRequest fit;
  std::optional<double> room = {};  ///< mm that the block is to go on below the lowest of them
  bool operator==(const RowRequest&) const = default;
};

/// Lengths of a blade for a row in a block.
struct LengthsRequest {
  geometry::Setup setup;
  LengthRequest lengths;
  bool operator==(const LengthsRequest&) const = default;
};

/// The blade that a cut is made with.
Blade bladeOf(const Design& design, const Cut& cut);

/// What a design asks of the stages of a cut whose block `lies` so: nothing else of it reaches them.
/// `joined`: the cut goes on in a neighbouring block, and its blades have the ends and tangents of their
/// sections.
FitRequest fitRequest(const Design& design, const Cut& cut, const Box& lies, bool joined = false);
/// mm that the sections of such blades are followed on their surface beyond the block; 0 if not.
double reachBeyond(const FitRequest& fit, const Blade& blade, const Box& lies);
/// The planes of key blades that are turned, where the surface of the cut is told by such.
std::optional<TurningPlanes> turningOf(const Design& design, const Cut& cut);
/// mm that a block which is made around the surface of its one cut goes on below the lowest blade; none of
/// other blocks.
std::optional<double> roomBelow(const Design& design, const Cut& cut);
CheckRequest checkRequest(const Design& design, const Cut& cut);
/// The same while the block is not known to reach below the blades: no floor is asked of it, unless it is
/// given.
CheckRequest trialCheckRequest(const Design& design, const Cut& cut);
Kerf kerfOf(const Design& design, const Cut& cut, const Box& lies);
LengthRequest lengthRequest(const Design& design, const Cut& cut, const Box& lies, bool joined = false);
JointRequest jointRequest(const Design& design);
WayRequest wayRequest(const Design& design);
FollowRequest followRequest(const Design& design);
EntryExitRequest entryExitRequest(const Design& design, const Cut& cut);
MotionRequest motionRequest(const Design& design, const Cut& cut);

/// A cell for programs.
struct CellRequest {
  Output output;
  FileStamp file;  ///< of the cell, where it is a file
  bool operator==(const CellRequest&) const = default;
};

/// What cuts of one block, in their order, do to each other.
struct MetRequest {
  Box placed = {};
  std::vector<Eigen::Vector3d> kept = {};  ///< of each, the way to the foam that stays
  double tolerance = 0;                    ///< mm
  bool operator==(const MetRequest&) const = default;
};

/// What the surface that stands is held against.
struct AnalysisRequest {
  CheckRequest check;
  Kerf kerf;
  bool operator==(const AnalysisRequest&) const = default;
};

/// Of a stage that hangs on its inputs alone.
struct NoRequest {
  bool operator==(const NoRequest&) const = default;
};

}  // namespace bw::pipeline
