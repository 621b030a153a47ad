// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/sweep/row_sketch.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// One cut of a sketch. What a change does not reach is that of the sketch before, by identity.
struct CutSketch {
  std::string id;                              ///< of the design's cut
  std::shared_ptr<const TriangleMesh> target;  ///< one for all cuts of a surface
  std::shared_ptr<const geometry::Setup> setup;
  std::shared_ptr<const Sweep> sweep;
  std::shared_ptr<const RowSketch> look;
  /// Stations that are left out, beside those that were: there is no single curve of the surface in the
  /// block.
  int left = 0;
};

/// What follows a hand while it changes a design: of each cut surface, blades and what is seen of them at the
/// stations. Nothing of it is written: the evaluation of the design comes when the hand rests.
struct Sketch {
  Design design;
  std::vector<std::vector<CutSketch>> blocks;  ///< as those of the evaluation that it goes on from
  int made = 0;                                ///< cuts that were made for it; the others stayed
  double seconds = 0;

  /// The cut of that id; null if there is none.
  const CutSketch* find(const std::string& id) const;
};

/// Draws sketches, one after the other, of designs that a hand brings forth from one that was evaluated. Of
/// several blocks only the cuts are made again that a change can reach: a pole that is moved leaves the
/// surface as it is but for a few spans of its spline. They are made side by side, each into a slot of its
/// own, so that sketches do not hang on the number of threads.
class Sketcher {
 public:
  /// From an evaluation all of whose cuts came to a result.
  explicit Sketcher(std::shared_ptr<const Evaluation> from);
  Sketcher(Sketcher&& other) noexcept;
  Sketcher& operator=(Sketcher&& other) noexcept;
  ~Sketcher();

  /// Empty where the design is none that can be sketched, so that it must be evaluated: a file that was not
  /// read, another choice of faces, other blocks or cuts, nothing to be fitted, a blade too short; or at a
  /// stop. A direction and a number of stations that are left open stay those of the evaluation.
  std::optional<Sketch> draw(const Design& design, const RunContext& context);

  /// Has the next sketch make all cuts anew, to be compared with one that makes those alone that a change
  /// reaches.
  void forget();

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace bw::pipeline
