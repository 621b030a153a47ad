// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/design/design.h"
#include "bw/core/files/file_set.h"
#include "bw/core/simulation/barriers.h"
#include "bw/core/simulation/simulation.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/sweep/kerf_field.h"
#include "bw/pipeline/pipeline.h"
#include "bw/robotio/text/program_text.h"

namespace bw::pipeline {

/// What a run is seen with.
struct ComparedRun {
  SurfaceGrid cut = {};  ///< what the blade cuts of the surface shown (`bw::compare`)
  std::shared_ptr<const TriangleMesh> target = {};
  double tolerance = 0, motionTolerance = 0;  ///< mm
};

/// A program that was read back and run.
struct ProgramRun {
  Motion motion;
  Simulation simulation;
  std::optional<SimulatedSurface> surface = {};  ///< only with a design
  ComparedRun compared = {};                     ///< likewise
  std::vector<BarrierLook> barriers = {};        ///< likewise
  std::string block = {}, cut = {};              ///< ids of what it was compared with; likewise
  Kerf kerf = {};                                ///< of that cut; likewise
  /// The kerf at the speeds of the run, where it is told over speed.
  std::shared_ptr<const KerfField> melted = {};
  bool alone = true;  ///< true if the design has no other cut
  /// What breaks a rule of its dialect or a limit of the design, or snaps: a clause each.
  std::vector<std::string> exceeded = {};
  std::size_t broken = 0;                  ///< of these, the first that break a rule
  std::size_t around = 0;                  ///< of these, those of the ways around the cut and of the heat
  std::vector<std::string> warnings = {};  ///< what is no limit: a clause each
};

/// Reads a program in the dialect of its files and runs it with the blade and the weight of a design, against
/// the surface that the design shows and its target. Without a design the blade has no weight, and its shape
/// alone is followed. With one the ways to the block and from it are run too, as far as the text tells them,
/// and home, approach, retreat, targets and pace are held against what the design planned. Where the design
/// leaves the lengths of blades open, they are `lengths`, those of the results that the program belongs to,
/// or else what the program tells; where that leaves another cut of its block without a blade, they are
/// sought. Errors: those of reading, of the design's evaluation, of `simulate`; badInput where no dialect
/// reads the files, or the blade's length is not that of the design. `seen` is called, on this thread, as
/// soon as all is known that pictures and the surface tell, while energy barriers are still sought on others.
Result<ProgramRun> runProgram(const robotio::Program& program, const Design* design,
                              const RunContext& context, const CutLengths& lengths = {},
                              const std::function<void(const ProgramRun&)>& seen = {});

/// The text of simulation.json.
std::string simulationText(const ProgramRun& run);
/// What stands beside what the middle of the blade of a run sweeps: by half the kerf of what it was compared
/// with.
SurfaceGrid standing(const ProgramRun& run, SurfaceGrid swept);
/// The text of cut.obj, which needs no barriers.
std::string cutText(const ProgramRun& run);

}  // namespace bw::pipeline
