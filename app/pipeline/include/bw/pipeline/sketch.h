// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/sweep/live_row.h"
#include "bw/core/sweep/row_sketch.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// One cut of a sketch.
struct CutSketch {
  std::string id;  ///< of the design's cut
  std::shared_ptr<const TriangleMesh> target;
  std::shared_ptr<const geometry::Setup> setup;
  std::shared_ptr<const Sweep> sweep;
  std::shared_ptr<const RowSketch> look;
};

/// What follows a hand while it changes a design: of each cut surface, blades and what is seen of them at the
/// stations. Nothing of it is written: the evaluation of the design comes when the hand rests.
struct Sketch {
  Design design;
  std::vector<std::vector<CutSketch>> blocks;  ///< as those of the evaluation that it goes on from
  double seconds = 0;

  /// The cut of that id; null if there is none.
  const CutSketch* find(const std::string& id) const;
};

/// Draws sketches, one after the other, of designs that a hand brings forth from one that was evaluated.
class Sketcher {
 public:
  /// From an evaluation all of whose cuts came to a result.
  explicit Sketcher(std::shared_ptr<const Evaluation> from);

  /// Empty where the design is none that can be sketched, so that it must be evaluated: a file that was not
  /// read, another choice of faces, other blocks or cuts, nothing to be fitted, a blade too short; or at a
  /// stop. A direction and a number of stations that are left open stay those of the evaluation.
  std::optional<Sketch> draw(const Design& design, const RunContext& context);

 private:
  /// What is kept of a cut from sketch to sketch.
  struct Row {
    std::optional<LiveRow> live = std::nullopt;
    std::optional<RowSketcher> sketcher = std::nullopt;
    std::shared_ptr<const geometry::Target> target;
    std::shared_ptr<const TriangleMesh> mesh;
    std::shared_ptr<const std::vector<Section>> sections;
    std::shared_ptr<const SplineSurface> spline;  ///< that they are of; null for a file
    PlanesRequest planes;
  };
  std::optional<CutSketch> draw(const Design& design, std::size_t index, const CutEvaluation& cut,
                                const std::optional<BlockPlacement>& placement, const RunContext& context);
  /// A source, as the last sketch had it.
  struct Surface {
    std::optional<DesignedSurface> surface = std::nullopt;
    std::shared_ptr<const SplineSurface> spline = nullptr;  ///< null for a file
    std::optional<geometry::CadModel> model = std::nullopt;
  };
  const Surface& surfaceOf(const Design& design, const Cut& cut) const;
  bool takeSurfaces(const Design& design);

  std::shared_ptr<const Evaluation> from_;
  std::vector<Row> rows_;          ///< of all cuts, block by block
  std::vector<Surface> surfaces_;  ///< of all sources
};

}  // namespace bw::pipeline
