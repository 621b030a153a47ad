// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

namespace bw::pipeline {

Bar barOf(const Sketch& sketch) { return barOf(sketch, sketch.design.process.tolerance); }

Bar barOf(const Sketch& sketch, double deviation) {
  Bar worst = Bar::none;
  const auto meet = [&worst](bool met, Bar bar) {
    if (met && (worst == Bar::none || bar < worst)) worst = bar;
  };
  for (const std::vector<CutSketch>& block : sketch.blocks)
    for (const CutSketch& cut : block) {
      const RowSketch& look = *cut.look;
      meet(cut.left > 0, Bar::outside);
      meet(look.minRadius > 0 && look.minRadius < cut.sweep->request.blade.minRadius(), Bar::tooTight);
      meet(std::ranges::find(look.crosses, 1) != look.crosses.end(), Bar::crosses);
      meet(std::ranges::any_of(look.rest,
                               [](Rest rest) { return rest == Rest::lost || rest == Rest::unknown; }),
           Bar::lost);
      meet(look.deviationMax > deviation, Bar::tooFar);
      meet(look.nearBottom, Bar::low);
    }
  return worst;
}

bool Reach::knows(double by) const {
  const End& end = ends[by < 0 ? 0 : 1];
  return now != Bar::none || end.known || std::abs(by) <= std::abs(end.free);
}

namespace {

/// True where sketches only lose sight of the blades.
bool losesSight(Bar bar) { return bar == Bar::lost || bar == Bar::noBlade; }

/// True if an evaluation tells, of stations or of what lies between them, that a blade would not keep its
/// shape.
bool losesShape(const Evaluation& evaluation) {
  return std::ranges::any_of(evaluation.findings(), [](const Finding& finding) {
    constexpr std::array kinds = {FindingKind::fit,    FindingKind::stability, FindingKind::outOfPlane,
                                  FindingKind::weight, FindingKind::certainty, FindingKind::motion};
    return finding.severity == Severity::error && std::ranges::find(kinds, finding.kind()) != kinds.end();
  });
}

/// True if an evaluation tells that some of the surface is not cut, not for what blades do between stations.
bool leavesSome(const Evaluation& evaluation) {
  return std::ranges::any_of(evaluation.findings(), [](const Finding& finding) {
    const auto* some = std::get_if<Uncovered>(&finding.cause);
    return finding.severity == Severity::error && finding.kind() == FindingKind::coverage &&
           !(some && some->between);
  });
}

/// True if the blades of an evaluation leave the surface at their stations or between them.
bool leavesSurface(const Evaluation& evaluation) {
  for (const BlockEvaluation& block : evaluation.blocks)
    for (const CutEvaluation& cut : block.cuts)
      if (const std::optional<CutResult> result = cut.result();
          result && std::max(result->analysis.summary.deviationMax, result->between.deviationMax) >
                        evaluation.design.process.tolerance)
        return true;
  return false;
}

}  // namespace

ReachSearch::ReachSearch(const std::shared_ptr<const Evaluation>& from, std::function<Design(double)> at,
                         double farthest, double withinShare)
    : from_(from),
      at_(std::move(at)),
      farthest_(farthest),
      withinShare_(withinShare),
      sides_{Side{Sketcher(from)}, Side{Sketcher(from)}},
      near_(Sketcher(from)) {}

Bar ReachSearch::barAt(Sketcher& sketcher, double by, const RunContext& context) const {
  const std::optional<Sketch> sketch = sketcher.draw(at_(by), context);
  return sketch ? barOf(*sketch, deviation_) : Bar::noBlade;
}

bool ReachSearch::looking() const {
  return !began_ || (reach_.now == Bar::none && (!sides_[0].done || !sides_[1].done));
}

bool ReachSearch::seeks(double by) const {
  return !began_ || (reach_.now == Bar::none && !sides_[by < 0 ? 0 : 1].done && !reach_.knows(by));
}

bool ReachSearch::bars(double by) const {
  return reach_.ends[by < 0 ? 0 : 1].bar != Bar::none && !reach_.knows(by) && !seeks(by);
}

bool ReachSearch::unsure(std::size_t side) const {
  return reach_.now == Bar::none && sides_[side].done && !reach_.ends[side].known;
}

bool ReachSearch::unsure() const { return unsure(0) || unsure(1); }

bool ReachSearch::look(const RunContext& context) {
  if (!began_) {
    const std::optional<Sketch> now = near_->draw(at_(0), context);
    if (context.stopped()) return true;
    began_ = true;
    reach_.now = now ? barOf(*now) : Bar::noBlade;
    if (reach_.now != Bar::none) return false;
    // Between its stations a blade is farther off than a sketch sees, if by little.
    constexpr double kOfTolerance = 0.98;
    const double tolerance = now->design.process.tolerance;
    deviation_ = kOfTolerance * tolerance;
    for (const std::vector<CutSketch>& block : now->blocks)
      for (const CutSketch& cut : block) deviation_ = std::max(deviation_, cut.look->deviationMax);
    return looking();
  }
  if (!looking()) return false;
  const std::size_t aimed = aim_ < 0 ? 0 : 1;
  const bool waitedFor = !near_ && seeks(aim_);
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    Side& side = sides_[i];
    Reach::End& end = reach_.ends[i];
    if (side.done || (waitedFor && i != aimed)) continue;
    const double sign = i == 0 ? -1 : 1, free = std::abs(end.free);
    const bool known = end.bar != Bar::none;
    const double ahead = near_ ? kNear : free < kFirst ? kFirst : free + std::min(free, kStride);
    const double next = known ? 0.5 * (free + side.barred) : std::min(farthest_, ahead);
    const Bar bar = barAt(near_ ? *near_ : side.sketcher, sign * next, context);
    if (context.stopped()) return true;
    if (bar == Bar::none) {
      end.free = sign * next;
    } else {
      end.bar = bar;
      side.barred = next;
    }
    const double far = std::abs(end.free), within = losesSight(end.bar) ? kWithinSight : kWithin;
    side.done =
        end.bar != Bar::none ? side.barred - far <= std::max(within, withinShare_ * far) : next >= farthest_;
    end.known = side.done && end.bar == Bar::none;
  }
  near_.reset();
  return looking();
}

bool ReachSearch::confirm(const RunContext& context) {
  const std::size_t aimed = aim_ < 0 ? 0 : 1, i = unsure(aimed) ? aimed : 1 - aimed;
  if (!unsure(i)) return false;
  Side& side = sides_[i];
  Reach::End& end = reach_.ends[i];
  const double sign = i == 0 ? -1 : 1, free = std::abs(end.free);
  const double wanted = i == aimed ? std::abs(aim_) : 0;
  double by = side.barred;
  if (side.proved) {
    by = side.sure < free ? free : 0.5 * (free + side.barred);
  } else if (wanted > free) {
    // Where sketches lost sight of the blades, nothing is said of where they would be barred.
    if (losesSight(end.bar)) by = std::max(by, free + std::max(side.step, kStepShare * free));
    by = std::min(by, std::max(wanted, side.sure > 0 ? free : side.barred));
  }
  const Design design = at_(sign * by);
  Outcome outcome = evaluate(design, from_.get(), context);
  Bar bar = Bar::noBlade;
  if (!outcome.error && outcome.evaluation.complete() && outcome.evaluation.uncut == from_->uncut) {
    // Looked at as sketches are, from itself: its blades are where it has them.
    const auto evaluation = std::make_shared<const Evaluation>(std::move(outcome.evaluation));
    if (const std::optional<Sketch> sketch = Sketcher(evaluation).draw(design, context)) bar = barOf(*sketch);
    if (bar == Bar::none && leavesSome(*evaluation) && !leavesSome(*from_)) bar = Bar::outside;
    // A blade that snaps leaves the surface by that.
    if (bar == Bar::none && losesShape(*evaluation) && !losesShape(*from_)) bar = Bar::lost;
    if (bar == Bar::none && leavesSurface(*evaluation)) bar = Bar::tooFar;
  }
  if (context.stopped()) return true;
  if (bar != Bar::none) {
    end.bar = bar;
    side.barred = by;
    side.proved = true;
    // Where sketches saw it free it is not; it may be a little before that.
    if (by <= free) end.free = sign * std::max(side.sure, by - std::exchange(side.back, 2 * side.back));
  } else {
    end.free = sign * std::max(free, by);
    side.sure = std::max(side.sure, by);
    if (!side.proved) {
      end.bar = Bar::none;
      end.known = by >= farthest_;
      const double step = std::max(std::exchange(side.step, 2 * side.step), kStepShare * by);
      side.barred = std::min(farthest_, by + step);
    }
  }
  if (side.proved) {
    const double found = std::abs(end.free);
    end.known = side.sure >= found && side.barred - found <= std::max(kWithin, kWithinShare * found);
  }
  return true;
}

}  // namespace bw::pipeline
