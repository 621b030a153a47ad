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
#include "bw/core/parts/cut_pose.h"
#include "bw/core/sweep/plane_family.h"
#include "bw/core/sweep/section_request.h"
#include "bw/core/sweep/sweep.h"
#include "bw/geometry/cad_model.h"

namespace bw::geometry {

/// How the target lies in its block, and the planes in which the blade goes through it.
struct Setup {
  Box block;  ///< as it lies: z (frame.normal) is the side from which the surface is looked at
  PlaneFamily planes;
  bool operator==(const Setup&) const = default;
};

/// Where the block lies and which way the blade goes, as far as that is given.
struct SetupRequest {
  std::optional<BlockPlacement> block;       ///< empty: around the target
  std::optional<Eigen::Vector3d> direction;  ///< in the file's frame, not zero; empty: along the block
  CutPose pose = {};                         ///< how the block lies
  /// Planes that turn, where no direction is given.
  std::optional<TurningPlanes> turning = std::nullopt;
  bool operator==(const SetupRequest&) const = default;
};

/// Resolves what is not given: the block around the target (oriented box of the part's frame, axis-parallel
/// where that is nearly as small, with a few mm of margin below and above so that no cut runs along a face of
/// the block) and the cutting direction (the longer side of that box). A given direction is normalised; a
/// zero one is an error, and so are planes that turn and meet in the block.
Result<Setup> resolveSetup(const Target& target, const SetupRequest& request, Findings& findings);

/// A way that the blade could go, with the name of where it comes from.
struct NamedDirection {
  std::string name;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitY();  ///< unit
};

/// Directions worth a try, each at least 5° from those before it: along the block's longer side (what
/// `resolveSetup` takes) and its shorter one, the principal axes of the target, the diagonals of the block's
/// base, the axes of the file, and the height of the block.
std::vector<NamedDirection> directionsToTry(const Target& target, const Box& block);

/// How many stations a tolerance asks for.
struct StationCount {
  static constexpr int kLeast = 41, kMost = 241;
  int stations = kLeast;
  /// mm, the farthest that a section between two stations lies from what the stations say of it; empty where
  /// no two sections can be compared.
  std::optional<double> between = {};
  bool operator==(const StationCount&) const = default;
};

/// The fewest of some numbers of stations with which the sections of planes between them lie within a share
/// of `tolerance` (mm, above 0) of the skin through those at the stations (docs/mathematics.md, Number of
/// stations); the most of them where none does. Traces 121 sections at least and 481 at most. Errors: no
/// plane meets the target.
Result<StationCount> stationsFor(const Target& target, const Setup& setup, double tolerance,
                                 const RunContext& context);

/// Intersects the target with parallel planes of `setup.planes`, from the first to the last place
/// inside block and target. Each section is cleaned (tiny spurious oscillation, duplicate knots), chained
/// over the faces, trimmed to the block, and converted to a planar curve; all run the same way (towards +x of
/// their frames) and all frames are parallel (x: horizontal in the block where possible, y: towards the outer
/// side of the target, normal: the cutting direction). Planes that miss, closed sections and sections with
/// several branches are reported in `issues` with their station, never guessed: a station without exactly one
/// open curve keeps its branches with none of them chosen, and no station at all with one is an error.
/// A request that leaves their number to the tolerance is an error: `stationsFor` finds it before.
/// `request.route` `kernel` takes OpenCASCADE's intersection of each face, the others the own tracer.
Result<std::vector<Section>> cutSections(const Target& target, const Setup& setup,
                                         const SectionRequest& request, const RunContext& context,
                                         Findings& findings);

/// Looks with OpenCASCADE's intersection at some of the stations that `cutSections` traced with `request`:
/// the first, the last, the middle one, and those on which `findings`, what it found, casts doubt. Where the
/// two routes differ by more than 0.01 mm at a place of every 5 mm (2001 at most), in their number of curves
/// or by a thousandth of their length, the neighbours are looked at too, on and on, and OpenCASCADE's section
/// is taken unless it is the shorter one: what was traced lies on surface and plane, so it cannot be too
/// much. Returns the sections anew, nothing where none was taken; `findings` then tells of those, and of
/// every difference. Errors: those of `cutSections`.
Result<std::optional<std::vector<Section>>> confirmSections(const Target& target, const Setup& setup,
                                                            const SectionRequest& request,
                                                            const RunContext& context, Findings& findings);

/// Follows sections of `setup` on their surface beyond the block, to `reach` mm (> 0) around it: `beyond` of
/// each that is chosen is the curve through it, running its way, where there is an open one. Errors:
/// `cancelled`.
Result<void> followBeyond(const Target& target, const Setup& setup, double reach,
                          std::vector<Section>& sections, const RunContext& context);

}  // namespace bw::geometry
