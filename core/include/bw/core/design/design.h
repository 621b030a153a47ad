// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/blade/blade.h"
#include "bw/core/design/block_grid.h"
#include "bw/core/design/drawing_link.h"
#include "bw/core/design/face_choice.h"
#include "bw/core/design/part_marks.h"
#include "bw/core/design/read_options.h"
#include "bw/core/design/variables.h"
#include "bw/core/files/fingerprint.h"
#include "bw/core/files/shared_bytes.h"
#include "bw/core/fit/elastica_fit.h"
#include "bw/core/parts/cut_pose.h"
#include "bw/core/shape/designed_surface.h"
#include "bw/core/sweep/extension.h"
#include "bw/core/sweep/kerf_table.h"
#include "bw/core/sweep/section_request.h"
#include "bw/core/text/expression.h"

namespace bw {

/// Where surfaces of a design come from: a CAD file, and how it is read, or a surface that is designed.
struct Source {
  std::string id = "source-1";
  std::filesystem::path path = {};  ///< of the CAD file; relative to the design file when stored
  SharedBytes bytes = {};           ///< the file itself if it is embedded, else empty
  /// What the linked file was when the design was last saved; nothing if never, or if it is embedded.
  std::optional<Fingerprint> saved = std::nullopt;
  std::optional<LengthUnit> unit =
      std::nullopt;  ///< the file's numbers are in it; empty = as the file states
  std::optional<double> sewing =
      std::nullopt;  ///< mm within which edges of faces are joined; empty = by the tolerance
  /// A surface that is designed, in the design's frame; then there is no file.
  std::optional<DesignedSurface> surface = std::nullopt;
  /// What curves of that surface were called, by their place, counted from 0 (surface_curves.h).
  std::map<int, std::string> curveNames = {};
  /// The drawing that surface was made of, where there is one; only of the first source.
  std::optional<DrawingLink> drawing = std::nullopt;
  bool operator==(const Source&) const = default;

  /// True where nothing is named yet.
  bool empty() const { return !surface && path.empty() && bytes.empty(); }
};

/// A block of foam.
struct StockBlock {
  std::string id = "block-1";
  std::optional<BlockPlacement> placement = std::nullopt;  ///< empty = "auto": around the surface that is cut
  bool operator==(const StockBlock&) const = default;
};

/// A cut of a block along a surface.
struct Cut {
  std::string id = "cut-1";
  std::string source = "source-1", block = "block-1";  ///< ids
  FaceChoice face = {};                                ///< which faces of the source are the surface
  std::optional<Eigen::Vector3d> direction =
      std::nullopt;  ///< of travel, in the file's frame, not zero; empty = "auto"
  SectionRequest sections = {};
  CutPose pose = {};                            ///< how the block lies for it
  KeptSide keep = KeptSide::below;              ///< which foam stays
  std::optional<int> order = std::nullopt;      ///< among the cuts of its block; empty: by its height
  std::optional<double> length = std::nullopt;  ///< mm, of the blade; empty: that of the design's
  /// mm that the foam stands back from the surface, along its normals: half of what two moulds leave between
  /// them for a panel. Only for a cut that is alone in its block.
  double offset = 0;
  bool operator==(const Cut&) const = default;

  static constexpr int kMostOrder = 10000;
  static constexpr double kMostOffset = 500;  ///< mm
};

/// What is asked of cuts where their blocks lie side by side and the surface goes on.
enum class Join {
  none,          ///< nothing: each blade lies as near to its section as it can
  tangentPlanes  ///< each has the ends and tangents of its section, so that neighbours meet smoothly
};
/// Their words in files, by value.
inline constexpr std::array<const char*, 2> kJoins = {"none", "tangent-planes"};

/// The word of files for a way up that is left to the blocks.
inline constexpr const char* kUpOfBlock = "block";

/// How blades are found, driven and judged.
struct Process {
  FitOptions::Length fitLength = FitOptions::Length::free;
  bool fitEndpoints = false;
  bool fitTangents = false;
  double maxPeriods = 1;
  /// What holds the grips of cuts that do not go on in a neighbouring block. Where that is not the section
  /// alone, nothing of the four above is asked for.
  Extension extend = Extension::none;
  double tolerance = 2.0;        ///< mm, deviation of the cut surface
  double cuttingSpeed = 20.0;    ///< mm/s of the fastest point of the blade
  double kerf = 0;               ///< mm of foam that the blade melts away across itself
  KerfTable kerfTable = {};      ///< the same over the speed of the blade there; empty: `kerf` at any
  double clearance = 50.0;       ///< mm between a grip and the block
  double floor = 20;             ///< mm that the whole blade stays above the face that its block lies on
  double margin = 0.15;          ///< of stability, that blades are to keep
  double motionTolerance = 0.1;  ///< mm between the blade as the robots move it and the surface shown
  double lead = 20;              ///< mm of straight travel before and after the block
  double gripError = 0.5;        ///< mm that a grip may be off, and
  double gripAngle = 0.2;        ///< degrees that it may be turned: what the cut then moves by is told
  bool weight = true;            ///< blades hang in their own weight
  Join join = Join::tangentPlanes;
  double jointGap = 0.1;  ///< mm between the surfaces of neighbouring blocks at their boundary, and
  double jointKink = 1;   ///< degrees between these there, that are allowed
  /// Against which weight pulls: not zero, in the file's frame; empty: the way to the top of each block, as
  /// it lies.
  std::optional<Eigen::Vector3d> up = std::nullopt;
  bool operator==(const Process&) const = default;
};

/// What is written for the robots.
struct Output {
  std::vector<std::string> programs = {"rapid", "csv", "json"};  ///< words of `programFormats`
  std::string cell = "irb1600-pair";                             ///< its word, or the path of its file
  bool operator==(const Output&) const = default;
};

struct Design;

/// A state of a design that was given a name, to come back to and to compare with.
struct NamedVersion {
  std::string name;
  std::shared_ptr<const Design> design;  ///< not null; without versions and marks of its own
  bool operator==(const NamedVersion& other) const;
};

/// A design: an immutable value that holds everything a result is made from. What the desktop program edits
/// and saves. It has at least one source, one block and one cut, and each cut names a source and a block of
/// it; sources after the first are designed surfaces.
struct Design {
  std::string name = "Untitled";
  std::vector<Source> sources = {{}};
  std::vector<StockBlock> stock = {{}};
  std::vector<Cut> cuts = {{}};
  /// What the blocks were laid out by; they, and the cuts of each, stand in `stock` and `cuts` all the same.
  /// Where these are still what the grid makes, files tell the grid in place of them.
  std::optional<BlockGrid> grid = std::nullopt;
  Blade blade;
  Process process;
  Output output;
  std::vector<Variable> variables = {};
  /// The numbers that expressions stand for, by their JSON pointers in the design's file, or in the one that
  /// it has where all cuts are told one by one. One that no longer is what its expression came to was changed
  /// since, and is free of it.
  std::map<std::string, BoundNumber> bindings = {};
  std::vector<NamedVersion> versions = {};  ///< in the order in which they were named
  PartMarks marks = {};                     ///< versions have none

  /// The first of each: the case of one.
  const Source& source() const { return sources.front(); }
  const StockBlock& block() const { return stock.front(); }
  const Cut& cut() const { return cuts.front(); }
  Source& source() { return sources.front(); }
  StockBlock& block() { return stock.front(); }
  Cut& cut() { return cuts.front(); }

  /// The source of that id; null if there is none.
  const Source* find(const std::string& id) const;
  /// That of a cut, whose source is one of the design.
  const Source& sourceOf(const Cut& cut) const { return *find(cut.source); }
  Source& sourceOf(const Cut& cut) { return const_cast<Source&>(std::as_const(*this).sourceOf(cut)); }

  /// How a source of it is read: edges are joined within a tenth of the tolerance, at most
  /// ReadOptions::kMostSewing, unless the source says more.
  ReadOptions readOptions(const Source& of) const;

  static constexpr int kVersion = 2;
  static constexpr int kMostSources = 100, kMostBlocks = BlockGrid::kMostBlocks, kMostCuts = 10000,
                       kMostVersions = 100;
  bool operator==(const Design&) const = default;
};

/// The blocks of a grid as stock.
std::vector<StockBlock> stockOf(const BlockGrid& grid);
/// The cuts of such blocks: for each block each of `each`, its id followed by "-" and the block's, in the
/// place of the block's id; then `own`, of which one with the id of such a cut takes its place.
std::vector<Cut> cutsOf(const std::vector<StockBlock>& stock, const std::vector<Cut>& each,
                        const std::vector<Cut>& own);

/// Reads JOB.json, the settings of a design with one block and one cut, without its source. Unknown keys,
/// wrong types and values out of range are errors that name the key, the value and the remedy (the nearest
/// known key is suggested). Every key is optional. What a machine takes is no part of it: `threads` gets the
/// number of worker threads that the text may ask for, 0 = all.
Result<Design> parseJob(std::string_view json, int* threads = nullptr);

/// Reads a .bladewright file's text; numbers told by expressions are what these come to. A newer version,
/// unknown keys and wrong types are errors that name them. Older versions are read too; `version` gets that
/// of the text.
Result<Design> parseDesign(std::string_view json, int* version = nullptr);
/// The text of a .bladewright file (JSON, versioned; embedded geometry as base64).
std::string designToJson(const Design& design);

/// Fills `saved` of each source from the linked file as it is now; leaves it empty for an embedded source,
/// and as it was where the file cannot be read.
void noteSources(Design& design);

/// Reads and writes the file itself; a linked source is resolved against the file's folder. Writing is
/// atomic.
Result<Design> loadDesign(const std::filesystem::path& file, int* version = nullptr);
Result<void> saveDesign(const Design& design, const std::filesystem::path& file);

}  // namespace bw
