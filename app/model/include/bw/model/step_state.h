// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "bw/core/base/result.h"
#include "bw/core/design/design.h"
#include "bw/pipeline/pipeline.h"

namespace bw::model {

/// The four steps of the work, in their order.
enum class Step { setup, input, process, output };
inline constexpr int kStepCount = 4;

/// How a step stands at a glance.
struct StepState {
  enum class Kind { idle, done, stale, running, warning, error };
  Kind kind = Kind::idle;
  double progress = 0;  ///< in [0, 1] while running
  QString text;         ///< the state in a few words, for instance "60 stations"
};

using StepStates = std::array<StepState, kStepCount>;

/// What the states follow from.
struct StepFacts {
  std::shared_ptr<const Design> design;                    ///< the present design
  std::shared_ptr<const Design> evaluated;                 ///< the design of `evaluation`
  std::shared_ptr<const pipeline::Evaluation> evaluation;  ///< the newest result or null
  std::string cut = {};                                    ///< id of the cut selected; empty = the first
  std::optional<Error> error;                              ///< why it stopped short
  bool busy = false;
  double progress = 0;
  QString busyStep;           ///< the pipeline's word for what runs
  std::string exported;       ///< `exportKey` of the result written last; empty: none was
  bool exportedPart = false;  ///< only some of its files, or those of some blocks, were chosen
  bool exporting = false;
  QString exportProblem;
};

/// What the files of an export hang on: the same for equal results with the same programs for the same cell.
std::string exportKey(const pipeline::Evaluation& evaluation);

/// The states of the four steps. Which step failed follows from the first stage that is missing.
StepStates stepStates(const StepFacts& facts);

/// The first step that an evaluation did not finish for a cut of it; `cut` is null if it has none.
Step failedStep(const pipeline::Evaluation* evaluation, const pipeline::CutEvaluation* cut);

/// The step that a finding belongs to, by its kind.
Step stepOf(FindingKind kind);

}  // namespace bw::model
