// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "versions/comparison.h"

#include <algorithm>
#include <utility>

#include "bw/core/design/design_versions.h"
#include "bw/model/history.h"

namespace bw::app {

namespace {

/// Evaluates a design as far as it comes; its targets are seen even where a later step fails.
Result<void> evaluateInto(pipeline::Evaluation& evaluation, const Design& design,
                          const pipeline::Evaluation* previous, const RunContext& context) {
  pipeline::Outcome outcome = pipeline::evaluate(design, previous, context);
  evaluation = std::move(outcome.evaluation);
  // With what is left of blocks, as that of now is seen; a picture without is none of the whole.
  if (!outcome.error) return pipeline::addParts(evaluation, context);
  for (pipeline::BlockEvaluation& block : evaluation.blocks)
    for (pipeline::CutEvaluation& cut : block.cuts)
      (void)pipeline::meshTarget(cut, nullptr, evaluation.seconds.read);
  return tl::unexpected<Error>(*outcome.error);
}

}  // namespace

Comparison::Comparison(Workbench& bench, QObject* parent) : QObject(parent), bench_(bench) {
  connect(&bench, &Workbench::changed, this, &Comparison::follow);
  connect(&bench.document(), &model::Document::replaced, this, [this] { choose({}); });
  // A step counts only after the design was swapped.
  connect(&bench.document().undoStack(), &QUndoStack::indexChanged, this, [this] {
    if (beside_.what == Beside::What::before) find();
  });
}

bool Comparison::hasBefore() const { return model::designBefore(bench_.document()) != nullptr; }

void Comparison::choose(const Beside& beside) {
  if (beside == beside_) return;
  beside_ = beside;
  forget();
  settle();
  emit chosen();
}

void Comparison::forget() {
  design_.reset();
  making_.reset();
  evaluation_.reset();
  error_.reset();
  if (runner_) runner_->cancel();
}

void Comparison::follow(const Change& change) {
  if (change.any(Aspect::design)) {
    if (beside_.what == Beside::What::version) find();
  } else if (change.any(Aspect::source) && design_ && !design_->source().surface) {
    order(design_);  // the file that it is of may be another now
  }
}

void Comparison::find() {
  const Beside before = beside_;
  const std::shared_ptr<const Design> known = design_;
  settle();
  if (beside_ != before || design_ != known) emit chosen();
}

void Comparison::settle() {
  std::shared_ptr<const Design> now;
  const auto& versions = bench_.design().versions;
  if (beside_.what == Beside::What::version) {
    auto found = std::ranges::find(versions, beside_.version, &NamedVersion::name);
    // One that got another name is the same.
    if (found == versions.end() && design_)
      found = std::ranges::find(versions, design_, &NamedVersion::design);
    if (found == versions.end()) {
      beside_ = {};
      return forget();
    }
    beside_.version = found->name;
    now = found->design;
  } else if (beside_.what == Beside::What::before) {
    now = model::designBefore(bench_.document());
    if (!now) {
      beside_ = {};
      return forget();
    }
  }
  const auto bare = [](const std::shared_ptr<const Design>& design) { return withoutVersions(*design); };
  if (design_ == now || (design_ && now && bare(design_) == bare(now))) return;
  design_ = now;
  if (now) order(now);
}

void Comparison::order(const std::shared_ptr<const Design>& design) {
  if (!runner_) runner_ = std::make_unique<model::EvaluationRunner>();
  making_.reset();  // what runs for an earlier one is not waited for
  runner_->cancel();
  auto made = std::make_shared<pipeline::Evaluation>();
  making_ = made;
  runner_->submit(
      tr("Compare"),
      [design, made, previous = bench_.shown()](const pipeline::Evaluation&, const RunContext& context) {
        return evaluateInto(*made, *design, previous.get(), context);
      },
      [this, made](const Result<void>& done) {
        if (making_ != made) return;
        making_.reset();
        error_ = done ? std::optional<Error>() : done.error();
        evaluation_ = made;
        emit computed();
      },
      model::EvaluationRunner::Needs::nothing);
  emit computed();
}

}  // namespace bw::app
