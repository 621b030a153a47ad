// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Designs from the curves of CAD files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/design/design.h"
#include "bw/core/dxf/dxf_curves.h"
#include "bw/core/shape/drawn_sections.h"

namespace bw::pipeline {

/// Which curves of a file are taken, and how.
struct DrawnRequest {
  DrawnOptions sections = {};
  std::optional<LengthUnit> unit = std::nullopt;  ///< empty: as the file states
  std::string numbers = {};                       ///< of curves, as "1, 3-5" from 1; empty: all
  std::vector<std::string> names = {};            ///< of layers or curves; empty: all
};

/// The curves of a file.
struct DrawnCurves {
  std::string format, unit;             ///< of the file
  std::vector<SpaceCurve> curves;       ///< in its order
  std::vector<UnusableCurve> unusable;  ///< of it: of these no section can be made
  std::vector<std::string> leftOut;     ///< of it, in words
};

/// Reads them from the bytes of a STEP, IGES, BREP or DXF file; its numbers are taken in `unit`, or as it
/// states. `name` serves messages. Errors: those of `geometry::readCurves` and `readDxf`.
Result<DrawnCurves> drawnCurves(const std::string& bytes, const std::string& name,
                                std::optional<LengthUnit> unit, const RunContext& context = {});

struct DrawnLayer {
  std::string name;
  int curves = 0;  ///< on it, those that cannot be used among them
};

/// The layers of a drawing on which curves lie, by their names; of STEP, IGES and BREP the names of curves.
std::vector<DrawnLayer> layersOf(const DrawnCurves& curves);

struct DrawnDesign {
  Design design;
  DrawnSections sections;
  int curves = 0;                    ///< that were taken
  std::string format, unit;          ///< of the file
  std::vector<std::string> leftOut;  ///< of the file, in words
};

/// A design that cuts a loft through the curves of a STEP, IGES, BREP or DXF file, which it does not need any
/// more: the surface of `sectionsThrough`, a block around it, travel across the curves, and a blade that is
/// as much longer than the longest curve as that of a new single block than its block. `name` serves messages
/// and the name of the design. Errors: those of `geometry::readCurves`, `readDxf` and `sectionsThrough`, with
/// the file's name; a choice of curves that there are not (`badInput`).
Result<DrawnDesign> designThrough(const std::string& bytes, const std::string& name,
                                  const DrawnRequest& request, const RunContext& context = {});
/// The same of curves that are read; what `request` says of their unit is passed over.
Result<DrawnDesign> designThrough(const DrawnCurves& curves, const std::string& name,
                                  const DrawnRequest& request, const RunContext& context = {});

/// `design` with its first source made from other curves of a drawing: the surface is that of `next`, and of
/// the first block its place, of the first cut its direction, and the length of the blade are those of `next`
/// where they still are as one of `earlier`, made from the same drawing, has them.
Design withDrawn(const Design& design, const std::vector<DrawnDesign>& earlier, const DrawnDesign& next);

/// How a design tells what its first source was made of: of a file with that content at `path`, and of the
/// curves of a layer, or of all.
DrawingLink linkTo(const std::filesystem::path& path, const Fingerprint& content,
                   const std::optional<std::string>& layer, const DrawnDesign& made);

/// What was made of a drawing, as far as a design tells: what `withDrawn` takes as made from it before.
DrawnDesign madeBefore(const DrawingLink& link, const DesignedSurface& surface);

/// A design, and what became of the drawing that it is made of.
struct FollowedDesign {
  Design design;
  std::string told = {};  ///< for people; empty where there is no drawing, or it is as it was
  Severity severity = Severity::info;
};

/// The design with the surface made anew of its drawing, and of the layer that was chosen, where that file is
/// another by now. A surface that a hand has changed since stays, and so it does where the file cannot be
/// read: both are told. Errors: those of `designThrough`.
Result<FollowedDesign> followDrawing(const Design& design, const RunContext& context = {});

/// "3 curves (2 pieces joined) of walls.dxf: the loft of 3 sections with 7 points each lies within 0.08 mm of
/// them (the farthest is curve 2)": what became of the curves, for people.
std::string drawnText(const DrawnDesign& drawn, const std::string& name);

/// True for the bytes of a file that holds curves and nothing of which a face is made: a DXF file, or a STEP
/// or IGES text without the entities of faces. Takes some ms a MB.
bool holdsCurvesAlone(const std::string& bytes);

}  // namespace bw::pipeline
