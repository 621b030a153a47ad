// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/design/design.h"
#include "bw/core/motion/cell.h"
#include "bw/core/parts/crease.h"
#include "bw/core/shape/told_stretches.h"
#include "bw/core/simulation/barriers.h"
#include "bw/core/simulation/simulation.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/sweep/blade_lengths.h"
#include "bw/core/sweep/coverage.h"
#include "bw/core/sweep/joints.h"
#include "bw/core/sweep/row_certainty.h"
#include "bw/core/sweep/row_motion.h"
#include "bw/core/sweep/sweep_check.h"
#include "bw/geometry/cad_model.h"
#include "bw/geometry/part.h"
#include "bw/geometry/sections.h"
#include "bw/pipeline/direction_search.h"
#include "bw/pipeline/requests.h"
#include "bw/pipeline/split_block.h"

namespace bw::pipeline {

/// Seconds that each step took; 0 where an earlier result was used again.
struct Seconds {
  double read = 0, direction = 0, sections = 0, fit = 0, extend = 0, check = 0, write = 0, total = 0;
};

/// The results that another stands on, by identity.
using Inputs = std::vector<std::shared_ptr<const void>>;

/// A derived result, and what it was made from: a request, and the results that it stands on. Where both are
/// as they were, so is the result. Results are never edited.
template <class Request, class T>
struct Stage {
  Request request = {};
  Inputs inputs = {};
  std::shared_ptr<const T> value = {};
  Findings findings = {};
};

/// A CAD file that was read, or a designed surface that was made.
struct CadSource {
  geometry::CadModel model;
  Fingerprint content;  ///< of the bytes that were read, or of the spline
};

/// Sections for the middle of the blade.
struct MiddleSections {
  std::vector<Section> sections;
  double off = 0;  ///< mm along the normals of the target
};

/// All that the blade of a cut leaves, from grip to grip, through its block and out of it.
struct SweptSurface {
  SplineSurface surface;
  TriangleMesh mesh;
  geometry::Target target;  ///< for the nearest points of it
};

/// One station of a cut, with all that is known of it.
struct StationView {
  const BladePose& pose;
  const StationFit& fit;
  const StationCheck& check;
  const StationCertainty& certainty;
  Rest rest;
  double deviation;  ///< mm, the largest distance of its cut from the target
};

/// A way beside the stations that keeps the floor where its block reaches so many mm lower.
struct LowerWay {
  StationRange stations;  ///< those beside it, -1 for none
  double by = 0;
};

/// What keeps the slowest point of a blade nearer to its fastest, each computed as a design of its own.
struct SpeedRemedies {
  /// Blocks that lie in a grid, in another that splits them across the blade.
  struct Split {
    BlockGrid before;
    BlockSplit split;
    std::vector<UnevenSpeed::Part> parts;
  };
  std::optional<Split> split = std::nullopt;
  std::optional<UnevenSpeed::Planes> planes = std::nullopt;
};

/// What a cut came to, once all of its stages are done: views of their results.
struct CutResult {
  const Sweep& sweep;
  const SweepCheck& check;
  const SweepAnalysis& analysis;
  const Coverage& coverage;
  const RowMotion& way;
  const WayDeviation& between;
  const RowCertainty& certainty;
  const RowRest& rest;
  const EntryExit& ends;
  const Motion& motion;

  std::size_t size() const { return sweep.poses.size(); }
  StationView station(std::size_t i) const {
    return {sweep.poses[i],        sweep.fits[i],    check.stations[i],
            certainty.stations[i], rest.stations[i], analysis.stationDeviation[i]};
  }
};

/// One cut of a block: its stages, in the order in which they stand on each other. Those that failed or were
/// not reached are null.
struct CutEvaluation {
  std::string id;  ///< of the design's cut
  Stage<FaceChoice, geometry::Target> target;
  Stage<NoRequest, TriangleMesh> targetMesh;
  Stage<geometry::SetupRequest, geometry::Setup> placed;
  Stage<RowRequest, DirectionSearch> directions;      ///< only where the cut's direction is "auto"
  std::shared_ptr<const geometry::Setup> setup;       ///< `placed` with the direction that was chosen
  Stage<CountRequest, geometry::StationCount> count;  ///< only where the cut leaves it to the tolerance
  Stage<PlanesRequest, std::vector<Section>> sections;
  /// Only for files: what OpenCASCADE takes over of the traced sections, and the findings in their place.
  Stage<PlanesRequest, std::optional<std::vector<Section>>> confirmed;
  /// What the middle of the blade is to sweep, half a kerf beside the target: its sections, and how far along
  /// the target's normals it lies. Only where there is a kerf.
  Stage<Kerf, MiddleSections> middle;
  /// What lengths of the blade serve: where none is asked for, where for files one does not, and from
  /// `addSecondThought`.
  Stage<LengthsRequest, BladeLengths> lengths;
  /// What of the deviation it gives for its margin: where for files a station is lost for want of that, and
  /// from `addSecondThought`.
  Stage<LengthsRequest, MarginTrade> margins;
  /// Whether grips that come nearer to the block help: where no length serves a row that needs another one.
  Stage<LengthsRequest, ClearanceTrade> clearances;
  Stage<RowRequest, Sweep> sweep;                  ///< blades and poses
  Stage<CheckRequest, SweepCheck> check;           ///< velocities, margins, clearance
  Stage<FollowRequest, RowMotion> way;             ///< the targets of the robots, and the blade between them
  Stage<AnalysisRequest, SweepAnalysis> analysis;  ///< the cut surface against the target, and what was found
  Stage<CheckRequest, Coverage> coverage;          ///< the target against the cut surface
  Stage<WayRequest, WayDeviation> between;         ///< how far it lies off between the stations
  Stage<NoRequest, RowCertainty> certainty;        ///< what else the blades could rest in
  Stage<EntryExitRequest, EntryExit> ends;         ///< how the blade is led into the row and out of it
  Stage<CheckRequest, RowRest> rest;               ///< what keeps each blade in its shape
  Stage<MotionRequest, Motion> motion;
  Stage<NoRequest, std::vector<LowerWay>> lower;  ///< only where a way comes below the floor
  /// Only of the cut whose blade has the most uneven speeds: for files, and from `addSecondThought`.
  Stage<Design, SpeedRemedies> speeds;
  Stage<Kerf, SweptSurface> swept;                ///< only where its block has several cuts
  Stage<NoRequest, Simulation> run;               ///< the motion run; for files, and from `addSecondThought`
  Stage<WayRequest, SimulatedSurface> simulated;  ///< what that cuts; likewise
  Stage<NoRequest, std::vector<BarrierLook>> barriers;  ///< along it; likewise

  /// The block, once `setup` is there, as it lies for this cut: as it was placed; made around the surface,
  /// and with the blades known, as far below these as the floor asks for.
  const Box& block() const { return sweep.value ? sweep.value->block : setup->block; }
  std::optional<CutResult> result() const;  ///< empty until all stages are done
  /// What its program cuts, which is that of `blade simulate`; null until it is known, and where no blade
  /// runs through to the end.
  const SimulatedSurface* programCut() const;
  /// What the middle of the blade is held against; the target and its sections are there.
  std::unique_ptr<SurfaceSampler> middleSampler() const;
  Findings findings() const;  ///< of all stages in order
};

/// What is left of a block.
struct BlockPart {
  std::optional<geometry::Part> solid;  ///< empty where it could not be made; a finding tells why
  TriangleMesh mesh = {};               ///< its faces
};

/// One block of foam, and what is cut of it in this order.
struct BlockEvaluation {
  std::string id;  ///< of the design's block
  std::vector<CutEvaluation> cuts = std::vector<CutEvaluation>(1);
  /// Those that are not made, since they take nothing of what is left: their surfaces alone.
  std::vector<CutEvaluation> dropped = {};
  // Only where it has several cuts, or had before some were dropped:
  std::optional<BlockPlacement> placement = std::nullopt;  ///< where it is, before it is turned for any cut
  /// mm, up to the tolerance, of the foam that each cut takes of what those before it leave.
  Stage<MetRequest, std::vector<double>> met = {};
  Stage<MetRequest, CutsTogether> together = {};  ///< the creases that they leave
  /// For files, where there are several blocks, or cuts of it, or its surface is designed; else where there
  /// are several cuts from `addSecondThought`.
  Stage<MetRequest, BlockPart> part = {};
};

/// Everything that follows from a design: a list of blocks, of each a list of cuts, of each the stages.
struct Evaluation {
  Design design;
  Findings sourceFindings;  ///< whether the linked source is another than when the design was saved
  Stage<SourceRequest, CadSource> source;                ///< the first
  std::vector<Stage<SourceRequest, CadSource>> further;  ///< the others
  /// Of each source that key blades tell, what of all their travel no blade can be; of others nothing.
  std::vector<Stage<ToldRequest, std::vector<ToldStretch>>> told;
  Stage<NoRequest, FaceMesh> faceMesh;  ///< of all faces of the file; only from `addFaceMesh`
  std::vector<BlockEvaluation> blocks = std::vector<BlockEvaluation>(1);  ///< those that the surface meets
  Findings missed;                 ///< what blocks it does not meet, and why others are not cut
  std::vector<std::string> uncut;  ///< blocks that it meets and that no blade can cut
  double uncutArea = 0;            ///< mm², of the surfaces in these
  Findings outside;                ///< what of the surfaces lies in none of the blocks
  double outsideShare = 0;         ///< of the areas of all surfaces, that does
  Stage<JointRequest, Joints>
      joints;                     ///< how the cuts of neighbouring blocks meet; only where there are several
  Stage<CellRequest, Cell> cell;  ///< only where the design asks for programs; its findings tell how the
                                  ///< motions lie in the cell
  Findings programs;              ///< what the check of the programs warns of, once `produce` made them
  Seconds seconds;

  /// The case of one: the first cut of the first block.
  const CutEvaluation& cut() const { return blocks.front().cuts.front(); }
  CutEvaluation& cut() { return blocks.front().cuts.front(); }
  /// Its result.
  std::optional<CutResult> result() const { return cut().result(); }
  /// What a cut is of; it names a source of the design.
  const std::shared_ptr<const CadSource>& sourceOf(const Cut& cut) const;
  /// True if all cuts came to a result.
  bool complete() const;
  /// The cut of that id; null if there is none.
  const CutEvaluation* find(const std::string& id) const;
  Findings findings() const;  ///< of all stages in order, and of the programs
  /// Takes the stages that are missing here, of the same cuts, from an evaluation that came farther.
  void takeMissing(const Evaluation& before);
};

/// An evaluation with its blocks and cuts called as in `design`, so that these find their stages in it, and
/// its findings tell them so. Empty where none of both is called otherwise in the same place of its list.
std::optional<Evaluation> calledAs(const Evaluation& evaluation, const Design& design);

/// True if a surface may well be so many mm long: less, and much more, comes of a file that was read in
/// another unit than it was drawn in.
constexpr bool isPlausibleSize(double mm) { return mm >= 40 && mm <= 20000; }

/// True if one of these formats of programs is what robots run: it is held back where there are errors.
bool forRobots(const std::vector<std::string>& formats);

/// How far an evaluation got before it failed: the stages done stay usable, and the error names the step.
struct Outcome {
  Evaluation evaluation;
  std::optional<Error> error = std::nullopt;
};

/// What an evaluation is for: to be seen while its design changes, to be written, or to have a program
/// compared with it. Sections that were traced are confirmed by OpenCASCADE for the last two; what would
/// help a row that fails is sought only where it is written.
enum class Purpose { live, files, comparison };

/// The most blocks that are evaluated together.
inline constexpr int kMostBlocksMet = 256;

/// mm, lengths of blades by the ids of their cuts.
using CutLengths = std::map<std::string, double>;

/// Evaluates a design. Where it has several blocks, those that its surface meets by less than a square
/// centimetre are left out, and of the cuts of one block those that meet nothing of what is left. Where cuts
/// of one surface go on from block to block, they have as many stations, and those that leave their number
/// open get more until the joints hold. Stages of `previous` whose keys are unchanged are used again, so that
/// a change recomputes only what depends on it. Where the design leaves the length of its blade open,
/// `lengths` are those that were found before: they are taken in place of searches.
Outcome evaluate(const Design& design, const Evaluation* previous, const RunContext& context,
                 Purpose purpose = Purpose::live, const CutLengths& lengths = {});

/// The stage that reads the first source of a design, beside its evaluation: whoever evaluates the design
/// with it as what was before does not read the file once more, unless it has changed since.
Result<Stage<SourceRequest, CadSource>> readFirstSource(const Design& design, const RunContext& context);

/// The triangles of a cut's surface, unless they are there already: to be shown also where a later stage
/// failed. `seconds` grows by the time.
Result<void> meshTarget(CutEvaluation& cut, const CutEvaluation* previous, double& seconds);

/// Adds to a cut that came to a result the next of what takes longer than a picture may wait for: the motion
/// run, what it cuts, the barriers along it, then what is left of its block, what helps against uneven
/// speeds, the lengths of blade that would serve, the clearances where none does, and the margins. False if
/// nothing is left to be added, or it was stopped.
bool addSecondThought(Evaluation& evaluation, const RunContext& context);

/// Adds the motion runs of all cuts that came to a result, what they cut and the barriers along them, where
/// these are not there yet. Errors: those of `simulate`; `cancelled`.
Result<void> addRuns(Evaluation& evaluation, const RunContext& context);

/// Adds what is left of blocks with several cuts, where it is not there yet. Error: `cancelled`.
Result<void> addParts(Evaluation& evaluation, const RunContext& context);

/// Adds the triangles of all faces of the file, to choose among them, unless the file has one face only or
/// was not read. Those of `previous` are used again where the file is the same. A stop leaves them out.
void addFaceMesh(Evaluation& evaluation, const Evaluation* previous, const RunContext& context);

}  // namespace bw::pipeline
