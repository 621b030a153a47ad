// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What a program cuts, in pictures.

#include <memory>
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

/// True if it comes over a surface that it is compared with.
bool isOver(const ProgramRun& run) {
  return run.surface && run.surface->covered > 0 && run.compared.cut.rows > 1;
}

scene::Content contentOf(const ProgramRun& run) {
  const bool over = isOver(run);
  scene::Content content;
  if (over && run.compared.target) content.add({0, 0}, *run.compared.target);
  if (!run.motion.block.size.isZero()) content.add({0}, run.motion.block);
  if (over || run.simulation.blades.size() > 1)
    content.add({0, 0, 0}, scene::CutSurface{standing(run, over ? run.compared.cut : run.simulation.swept()),
                                             {},
                                             {{kFromShown.field, run.compared.motionTolerance}}});
  return content;
}

scene::Style styleOf(const ProgramRun& run, const PictureOfRun& picture) {
  scene::Style style;
  style[scene::Kind::cut].map = picture.field;
  style.tolerance = run.compared.tolerance;
  style.marker = markOf(run, picture);
  return style;
}

/// A run over a small surface, of which pictures show all that those of any run do.
ProgramRun sampleRun() {
  constexpr int kRows = 5;
  constexpr double kApart = 20;  // mm
  ProgramRun run;
  run.motion.block.size = {kApart * (kRows - 1), kApart * (kRows - 1), kApart};
  SurfaceGrid& cut = run.compared.cut;
  cut.rows = cut.columns = kRows;
  cut.fields = {{kFromTarget.field, "Deviation", "mm", {}}, {kFromShown.field, "Distance", "mm", {}}};
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kRows; ++c) {
      cut.points.emplace_back(kApart * c, kApart * r, 0.2 * kApart * (1 + r % 2));
      for (Field& field : cut.fields) field.values.push_back(0.1 * r);
    }
  run.compared.target = std::make_shared<const TriangleMesh>(cut.triangles());
  run.compared.tolerance = run.compared.motionTolerance = 1;
  run.surface.emplace();
  run.surface->covered = 1;
  run.surface->toTargetAt.place = cut.points.back();
  return run;
}

}  // namespace

scene::Scene readyScene() {
  // As wide as a scene reckons that has drawn nothing: the room that a picture leaves for its legend hangs on
  // the one before.
  constexpr int kWidth = 900, kHeight = 300;
  const ProgramRun run = sampleRun();
  scene::Scene scene;
  scene.setContent(contentOf(run));
  scene.setStyle(styleOf(run, kFromTarget));
  scene.setCamera(scene.fitFrom(scene::directionOf(scene::View::iso), false, {kWidth, kHeight}));
  // Where this fails so do the pictures, which say why.
  [[maybe_unused]] const Result<scene::Picture> picture = scene.render(kWidth, kHeight);
  return scene;
}

Result<std::vector<ReportPicture>> simulationPictures(const ProgramRun& run, const RunContext& context,
                                                      scene::Scene scene) {
  if (context.stopped()) return stoppedError();
  auto drawn = std::make_unique<scene::Scene>(std::move(scene));
  drawn->setContent(contentOf(run));
  PictureList pictures(*drawn, context);
  for (const PictureOfRun& wanted :
       isOver(run) ? std::vector{kFromTarget, kFromShown} : std::vector{kAlone}) {
    drawn->setStyle(styleOf(run, wanted));
    if (Result<void> ok = pictures.add(scene::View::iso, false, wanted.name, wanted.title); !ok)
      return tl::unexpected<Error>(ok.error());
  }
  drawn.reset();  // while the last one is encoded
  return pictures.take();
}

}  // namespace bw::pipeline
