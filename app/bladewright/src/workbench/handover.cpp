// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workbench/handover.h"

#include "bw/geometry/export.h"

namespace bw::app {

namespace {

/// Pictures, report, design and surface for others, beside the files that are made already.
Result<FileSet> filesBeside(const pipeline::Evaluation& evaluation, const std::vector<ReportImage>& pictures,
                            const std::vector<std::filesystem::path>& made, const RunContext& context) {
  const SweepAnalysis& analysis = evaluation.sweep.value->analysis;
  FileSet beside;
  for (const ReportImage& picture : pictures)
    beside.add("pictures/" + picture.name + ".png", pngBytes(picture.image).toStdString());
  Result<std::string> iges = geometry::igesText(analysis.surface, "cut surface");
  if (!iges) return tl::unexpected<Error>(iges.error());
  beside.add("surface.iges", std::move(*iges));
  beside.add("mesh.stl", pipeline::stlBytes(analysis.cut.triangles(), "Bladewright cut surface, mm"));
  const Result<Design> stored = pipeline::storedDesign(evaluation);
  if (!stored) return tl::unexpected<Error>(stored.error());
  beside.add(pipeline::kDesignFile, designToJson(*stored));
  if (context.stopped()) return stoppedError();
  std::vector<std::filesystem::path> all = made;
  all.insert(all.end(), beside.paths().begin(), beside.paths().end());
  PrintedReport report = printReport(evaluation, pictures, all);
  beside.add("report.html", std::move(report.html));
  beside.add("report.pdf", std::move(report.pdf));
  return beside;
}

}  // namespace

std::vector<WrittenFile> writtenFiles(const FileSet& files) {
  std::vector<WrittenFile> list;
  for (std::size_t i = 0; i < files.paths().size(); ++i)
    list.push_back({files.paths()[i], files.bytes()[i].size()});
  return list;
}

Result<FileSet> handoverFiles(pipeline::Evaluation& evaluation, const std::vector<ReportImage>& pictures,
                              const RunContext& context) {
  if (!evaluation.sweep.value)
    return fail(ErrorCode::badInput, "there is no result to write; mend what the messages say first",
                "results");
  const auto beside = [&](const std::vector<std::filesystem::path>& made) {
    return filesBeside(evaluation, pictures, made, context);
  };
  return pipeline::resultFiles(evaluation, context, {}, beside);
}

}  // namespace bw::app
