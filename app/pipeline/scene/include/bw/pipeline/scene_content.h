// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bw/pipeline/handover.h"
#include "bw/pipeline/pipeline.h"
#include "bw/pipeline/simulate.h"
#include "bw/pipeline/sketch.h"
#include "bw/scene/scene.h"

namespace bw::pipeline {

/// What a picture of an evaluation shows; stages that are missing are left out, but
/// for a block that could not be used: it is shown where the job puts it.
scene::Content sceneContent(const Evaluation& evaluation);
/// The ids of blocks of the design that have no evaluation, since their surface misses them or no blade can
/// cut it there. Their outlines are numbered on from those of the others; none where there are very many.
std::vector<std::string> blocksLeftOut(const Evaluation& evaluation);
/// Marks the place where a surface reaches farthest beyond its cut, where that is more than it may be; empty
/// if all is cut.
std::optional<scene::Marker> uncoveredMark(const Evaluation& evaluation);
/// The pictures of a report on an evaluation (`kReportPictures`), drawn without a window. Errors: those of
/// `scene::Scene::render`; `cancelled`.
Result<std::vector<ReportPicture>> reportPictures(const Evaluation& evaluation, const RunContext& context);
/// What a program cuts that was run, drawn without a window: "cut", by its deviation from the target, and
/// "cut-from-shown", by its distance from the surface shown, with the largest of either at its place. A run
/// that comes over no surface has one picture, of all that the blade sweeps. Errors: those of
/// `scene::Scene::render`; `cancelled`. `scene` draws them: one made by `readyScene` does so sooner, and the
/// same.
Result<std::vector<ReportPicture>> simulationPictures(const ProgramRun& run, const RunContext& context,
                                                      scene::Scene scene = {});
/// A scene whose driver is started and whose shaders are made, which takes some 0.2 s on one thread and hangs
/// on no run: to be made beside one.
scene::Scene readyScene();
/// What a picture of a sketch shows.
scene::Content sceneContent(const Sketch& sketch);
/// What of that is another than in the picture of the sketch before, for `scene::Scene::replace`; empty where
/// the two are not of the same cuts.
std::optional<scene::Content> sceneChange(const Sketch& sketch, const Sketch& before);

}  // namespace bw::pipeline
