// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A cut that follows a hand from sketch to sketch.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bw/core/surface/spline_surface.h"
#include "bw/core/sweep/kerf_field.h"
#include "bw/core/sweep/live_row.h"
#include "bw/core/sweep/row_sketch.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// What a sketch asks of one of its cuts.
struct LiveOrder {
  const Design& design;
  Cut cut;
  std::optional<BlockPlacement> placement = {};
  std::shared_ptr<const geometry::Target> target = {};
  std::shared_ptr<const SplineSurface> spline = {};  ///< that the target is of; null for a file
};

/// What is kept of a cut: its sections, its row and what was seen of it, with what they were made of. Two of
/// them know nothing of each other.
class LiveCut {
 public:
  /// Of a cut that came to a result; `spline` as it was then.
  LiveCut(const CutEvaluation& cut, std::shared_ptr<const SplineSurface> spline);

  /// Takes the sections of an order. False where there are none: then nothing can be shown of it. `isMade`
  /// tells then whether the row has to be looked at anew: not where planes, sections and all that is asked of
  /// row and look stay, and the surface changed, if at all, beside what the look is of alone.
  bool take(const LiveOrder& order, const RunContext& context);
  bool isMade() const { return made_; }
  /// Lays the blades on what was taken, and looks at them. False where that cannot be.
  bool follow(const LiveOrder& order, const RunContext& context);
  /// Has the next order made anew, whatever stays.
  void forget() { look_.reset(); }

  const std::shared_ptr<const geometry::Setup>& setup() const { return setup_; }
  const std::shared_ptr<const Sweep>& sweep() const { return sweep_; }
  const std::shared_ptr<const RowSketch>& look() const { return look_; }
  /// Stations that are left out, beside those that were.
  int left() const;

 private:
  /// What row and look are made for, beside the sections.
  struct Asked {
    FitRequest fit;
    CheckRequest check;
    Kerf kerf;
    bool operator==(const Asked&) const = default;
  };

  /// Has the hand begin with other curves in place of the sections, next to equal to them.
  void beginOn(std::vector<Section> sections);

  CutEvaluation cut_;                   ///< as it was evaluated
  std::shared_ptr<const Sweep> began_;  ///< the row then, on the sections with which the hand began
  PlanesRequest planes_;
  std::shared_ptr<const std::vector<Section>> sections_;
  std::shared_ptr<const SplineSurface> spline_;  ///< that they are of; null for a file
  std::optional<Asked> asked_ = std::nullopt;
  std::shared_ptr<const KerfField> melted_;  ///< by the speeds of the row from which the hand began
  bool made_ = false;
  std::optional<LiveRow> row_ = std::nullopt;
  std::optional<RowSketcher> sketcher_ = std::nullopt;
  double lostAt_ = 0;  ///< mm of the way from where the hand began on which nothing followed it last
  std::shared_ptr<const geometry::Setup> setup_;
  std::shared_ptr<const Sweep> sweep_;
  std::shared_ptr<const RowSketch> look_;  ///< null where none is of this
};

}  // namespace bw::pipeline
