// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The stages of one cut, in the order in which they stand on each other.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bw/core/sweep/kerf_field.h"
#include "bw/pipeline/pipeline.h"
#include "settle.h"

namespace bw::pipeline {

/// The stages of one cut at work.
struct CutWork {
  const Design& design;
  const Cut& cut;
  CutEvaluation& e;
  const CutEvaluation* previous;
  Seconds& seconds;
  const RunContext& context;
  Purpose purpose;
  std::optional<double> length = std::nullopt;  ///< mm, in place of a search for it
  bool joined = false;                          ///< goes on in a neighbouring block
  std::optional<int> stations = std::nullopt;   ///< in place of what its own sections ask for
  bool tried = false;                           ///< to see whether it serves: ends where it is seen not to

  template <class Request, class T, class Make>
  Result<void> settle(Stage<Request, T> CutEvaluation::*stage, const std::type_identity_t<Request>& request,
                      Inputs inputs, double& time, const Make& make) const {
    return pipeline::settle(e.*stage, previous ? &(previous->*stage) : nullptr, request, std::move(inputs),
                            time, make);
  }
  /// Takes a stage that stands from before, where it is what would be made now.
  template <class Request, class T>
  void keep(Stage<Request, T> CutEvaluation::*stage, const std::type_identity_t<Request>& request,
            const Inputs& inputs) const {
    if (!previous || (e.*stage).value) return;
    const Stage<Request, T>& before = previous->*stage;
    if (before.value && before.request == request && before.inputs == inputs) e.*stage = before;
  }
  /// That of the cut.
  Blade blade() const { return bladeOf(design, cut); }
  Result<void> unlessStopped() const {
    return context.stopped() ? Result<void>(stoppedError()) : Result<void>();
  }
};

/// The surface.
Result<void> aim(const CutWork& work, const std::shared_ptr<const CadSource>& source);
/// Block and direction; where the direction is left to us, the best of some. What the trials hang on does not
/// hold the number of stations: its change is what people drag.
Result<void> place(const CutWork& work, const std::optional<BlockPlacement>& placement);
/// What the design asks for, with the number of stations where that is left to the tolerance.
Result<SectionRequest> sectionRequest(const CutWork& work);
/// The sections of the target: those of the tracer, or what OpenCASCADE took over of them.
std::shared_ptr<const std::vector<Section>> ownRow(const CutEvaluation& e);
/// The sections that the blades are for.
std::shared_ptr<const std::vector<Section>> rowOf(const CutEvaluation& e);
/// The target's curves in its planes.
Result<void> section(const CutWork& work);
/// The sections for the middle of a blade beside whose kerf (above 0) a surface is to stand: of one width, or
/// of those of a `field`. The outer ones lie as far out as what stands needs (`carriedOut`). Errors: those of
/// `movedBy`, and `badInput` where it cannot be told on which side of what is cut foam stays.
Result<MiddleSections> middleOf(const geometry::Target& target, const std::vector<Section>& sections,
                                const PlaneFamily& planes, const Kerf& kerf, const RunContext& context,
                                Findings& findings, std::shared_ptr<const KerfField> field = nullptr);
/// What the middle of the blade is held against; its kerf is that of the `field`, if there is one.
std::unique_ptr<SurfaceSampler> middleSampler(const geometry::Target& target, const MiddleSections& middle,
                                              const Kerf& kerf, std::shared_ptr<const KerfField> field);
/// Sections, and the blades for them.
Result<void> fit(const CutWork& work);
/// The row, its motion, and how sure its blades rest. Of what is tried, `noSolution` where it does not serve.
Result<void> check(const CutWork& work);

// What takes longer than a picture may wait for.

/// The motion of the row, run.
Result<void> runMotion(const CutWork& work, double& seconds);
/// What that run cuts, and what it tells of the blade between its stations.
Result<void> seeTheRun(const CutWork& work, double& seconds);
/// How loosely the blade rests on that run.
Result<void> seeBarriers(const CutWork& work, double& seconds);
/// What is missing of all these.
Result<void> seeRun(const CutWork& work, double& seconds);
/// What a run cuts of the surface of a cut. `melted` gets the kerf at the speeds of the run, where it is told
/// over speed; `cut` is that of `bw::compare`.
Result<SimulatedSurface> cutBy(const Simulation& run, const CutEvaluation& e, const RunContext& context,
                               std::shared_ptr<const KerfField>* melted = nullptr,
                               SurfaceGrid* cut = nullptr);

/// The lengths of blade that serve.
Result<void> seekLengths(const CutWork& work, double& seconds);
/// What grips that come nearer to the block make of the row.
Result<void> seekClearances(const CutWork& work, double& seconds);
/// What the row gives for the margin of its blades.
Result<void> seekMargins(const CutWork& work, double& seconds);
/// Those of these that may help a row that fails, at its stations or in its run.
Result<void> seekAdvice(const CutWork& work, double& seconds);

}  // namespace bw::pipeline
