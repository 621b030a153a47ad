// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/handover.h"

#include <algorithm>
#include <utility>

#include "bw/core/sweep/maps.h"
#include "bw/geometry/export.h"
#include "make_files.h"

namespace bw::pipeline {

namespace {

/// Puts triangles to others.
void append(TriangleMesh& mesh, const TriangleMesh& more) {
  const int before = int(mesh.points.size());
  mesh.points.insert(mesh.points.end(), more.points.begin(), more.points.end());
  mesh.normals.insert(mesh.normals.end(), more.normals.begin(), more.normals.end());
  for (const auto& [a, b, c] : more.triangles) mesh.triangles.push_back({a + before, b + before, c + before});
}

/// The files beside those that are made already.
Result<FileSet> filesBeside(const Evaluation& evaluation, const Pictures& makePictures,
                            const std::vector<std::filesystem::path>& made, const Wanted& wanted,
                            const RunContext& context) {
  const bool pages = wanted.has(FileKind::pages), surface = wanted.has(FileKind::surface),
             meshes = wanted.has(FileKind::meshes);
  FileSet beside;
  Result<std::vector<ReportPicture>> pictures;
  if (pages) pictures = makePictures(evaluation);
  if (!pictures) return tl::unexpected<Error>(pictures.error());
  for (const ReportPicture& picture : *pictures) beside.add("pictures/" + picture.name + ".png", picture.png);
  TriangleMesh mesh;
  const std::vector<Strip> strips = stripsOf(evaluation);
  const bool several = strips.size() > 1;
  for (const Strip& strip : strips) {
    const SweepAnalysis& analysis = *strip.cut->analysis.value;
    if (meshes) append(mesh, analysis.cut.triangles());
    if (!surface) continue;
    Result<std::string> iges = geometry::igesText(analysis.surface, several ? strip.cut->id : "cut surface");
    if (!iges) return tl::unexpected<Error>(iges.error());
    beside.add(several ? "surface-strip-" + std::to_string(strip.index) + ".iges" : "surface.iges",
               std::move(*iges));
  }
  if (meshes) beside.add("mesh.stl", stlBytes(mesh, "Bladewright cut surface, mm"));
  if (context.stopped()) return stoppedError();
  if (!pages) return beside;
  std::vector<std::filesystem::path> all = made;
  all.insert(all.end(), beside.paths().begin(), beside.paths().end());
  const drawings::Report report = reportOf(evaluation, *pictures, all);
  Result<std::string> pdf = drawings::reportPdf(report, context);
  if (!pdf) return tl::unexpected<Error>(pdf.error());
  beside.add("report.html", reportHtml(report));
  beside.add("report.pdf", std::move(*pdf));
  return beside;
}

}  // namespace

bool hasCreases(const Evaluation& evaluation) {
  return std::ranges::any_of(evaluation.blocks, [](const BlockEvaluation& block) {
    return block.together.value &&
           std::ranges::any_of(block.together.value->creases,
                               [](const Crease& crease) { return !crease.curves.empty(); });
  });
}

bool isOf(const PictureOfReport& picture, const Evaluation& evaluation) {
  const MapInfo* map = cutMap(picture.field);
  return !map || map->ofCut || hasCreases(evaluation);
}

Policy withHandover(Policy policy, Pictures pictures, const RunContext& context) {
  policy.more = [pictures = std::move(pictures), wanted = policy.wanted, context](
                    const Evaluation& evaluation, const std::vector<std::filesystem::path>& made) {
    return filesBeside(evaluation, pictures, made, wanted, context);
  };
  return policy;
}

}  // namespace bw::pipeline
