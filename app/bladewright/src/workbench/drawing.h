// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/files/fingerprint.h"
#include "bw/pipeline/drawn_design.h"

namespace bw::app {

/// The curves of a CAD file that the open design was made from, and what was made of them so far. The design
/// itself keeps a link to the file (`DrawingLink`).
struct Drawing {
  using Layer = std::optional<std::string>;  ///< its name; empty: all layers together

  std::string file;                                          ///< its name
  Fingerprint content = {};                                  ///< of what was read of it
  std::filesystem::path path = {};                           ///< where it lies
  std::shared_ptr<const pipeline::DrawnCurves> curves = {};  ///< null where they could not be read
  std::vector<pipeline::DrawnLayer> layers = {};             ///< of a DXF file; empty for other ones
  std::vector<Layer> taken = {};                             ///< what each of those was made of
  std::vector<pipeline::DrawnDesign> made = {};
  std::string whyOne = {};  ///< why one layer was taken to begin with, where all together give no surface
  Layer chosen = {};        ///< which of them was taken last
  std::vector<pipeline::DrawnDesign> earlier = {};  ///< what was made of the file before it changed

  /// The design of a layer, made unless it was. Errors: those of `designThrough`.
  Result<pipeline::DrawnDesign> make(const Layer& layer, const RunContext& context) const;
  /// Notes what was made of a layer, which is the one taken last.
  void add(const Layer& layer, pipeline::DrawnDesign design);
  /// All that was made of the file, before it changed and since.
  std::vector<pipeline::DrawnDesign> all() const;
  /// How a design tells that it is made of the file.
  DrawingLink linkTo(const pipeline::DrawnDesign& drawn, const Layer& layer) const;
  /// A design with the surface of what was made next, and the link to it; of the rest, what a hand has set
  /// stays.
  Design onto(const Design& design, const pipeline::DrawnDesign& next, const DrawingLink& link) const;
  /// The layer that a surface was made of; nothing where it is none of those made.
  std::optional<Layer> layerOf(const std::optional<DesignedSurface>& surface) const;
};

/// Reads a file that holds curves alone, and makes a design of them: of all together or, where these give no
/// surface, of the layer with the most curves that does. Errors: those of `drawnCurves`, and of
/// `designThrough` for all together.
Result<Drawing> readDrawing(const std::string& bytes, const std::string& file, const RunContext& context);

/// The same of one layer. Errors: those of `drawnCurves` and of `designThrough`.
Result<Drawing> readDrawing(const std::string& bytes, const std::string& file, const Drawing::Layer& layer,
                            const RunContext& context);

}  // namespace bw::app
