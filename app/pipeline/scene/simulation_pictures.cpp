// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What a program cuts, in pictures.

#include <optional>
#include <string>
#include <utility>

#include "bw/core/text/number_text.h"
#include "bw/pipeline/scene_content.h"
#include "report_picture.h"

namespace bw::pipeline {

namespace {

/// A picture of what a run cuts.
struct PictureOfRun {
  const char* name;
  const char* title;
  const char* field;  ///< the map; "none" for none
};
constexpr PictureOfRun kFromTarget = {"cut", "Deviation of what the program cuts from the target",
                                      "deviation"},
                       kFromShown = {"cut-from-shown",
                                     "Distance of what the program cuts from the surface shown",
                                     "from_shown"},
                       kAlone = {"cut", "What the blade sweeps", "none"};

/// What is told at a place of the picture.
std::optional<scene::Marker> markOf(const ProgramRun& run, const PictureOfRun& picture) {
  if (const std::optional<Halt>& halt = run.simulation.halt)
    return scene::Marker{halt->place, "No blade goes on here, at " + shortText(halt->time, 4) + " s",
                         Severity::error};
  if (picture.field == kAlone.field) return {};
  const SimulatedSurface& surface = *run.surface;
  const bool ofTarget = picture.field == kFromTarget.field;
  const double most = ofTarget ? surface.toTargetMax : surface.toDesignMax,
               mean = ofTarget ? surface.toTargetMean : surface.toDesignMean,
               limit = ofTarget ? run.compared.tolerance : run.compared.motionTolerance;
  const RunSpot& at = ofTarget ? surface.toTargetAt : surface.toDesignAt;
  return scene::Marker{at.place,
                       "The program cuts within " + shortText(most) + " mm of the " +
                           (ofTarget ? "target" : "surface shown") + ", mean " + shortText(mean) +
                           " mm; farthest off here, at " + shortText(at.time, 4) + " s",
                       most > limit ? Severity::warning : Severity::info};
}

}  // namespace

Result<std::vector<ReportPicture>> simulationPictures(const ProgramRun& run, const RunContext& context) {
  const bool over = run.surface && run.surface->covered > 0 && run.compared.cut.rows > 1;
  scene::Scene scene;
  scene::Content content;
  if (over && run.compared.target) content.add({0, 0}, *run.compared.target);
  if (!run.motion.block.size.isZero()) content.add({0}, run.motion.block);
  if (over || run.simulation.blades.size() > 1)
    content.add({0, 0, 0}, scene::CutSurface{standing(run, over ? run.compared.cut : run.simulation.swept()),
                                             {},
                                             {{kFromShown.field, run.compared.motionTolerance}}});
  scene.setContent(std::move(content));
  std::vector<ReportPicture> pictures;
  for (const PictureOfRun& wanted : over ? std::vector{kFromTarget, kFromShown} : std::vector{kAlone}) {
    if (context.stopped()) return stoppedError();
    scene::Style style;
    style[scene::Kind::cut].map = wanted.field;
    style.tolerance = run.compared.tolerance;
    style.marker = markOf(run, wanted);
    scene.setStyle(style);
    Result<ReportPicture> picture = pictureFrom(scene, scene::View::iso, false, wanted.name, wanted.title);
    if (!picture) return tl::unexpected<Error>(picture.error());
    pictures.push_back(std::move(*picture));
  }
  return pictures;
}

}  // namespace bw::pipeline
