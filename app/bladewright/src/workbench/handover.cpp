// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workbench/handover.h"

#include "bw/geometry/export.h"

namespace bw::app {

namespace {

/// Pictures, report, design and surface for others, beside the files that are made already.
Result<FileSet> filesBeside(const pipeline::Evaluation& evaluation, const std::vector<ReportImage>& pictures,
                            const std::vector<std::filesystem::path>& made, const RunContext& context) {
  const SweepAnalysis& analysis = *evaluation.cut().analysis.value;
  FileSet beside;
  for (const ReportImage& picture : pictures)
    beside.add("pictures/" + picture.name + ".png", pngBytes(picture.image).toStdString());
  Result<std::string> iges = geometry::igesText(analysis.surface, "cut surface");
  if (!iges) return tl::unexpected<Error>(iges.error());
  beside.add("surface.iges", std::move(*iges));
  beside.add("mesh.stl", pipeline::stlBytes(analysis.cut.triangles(), "Bladewright cut surface, mm"));
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

pipeline::Policy handoverPolicy(std::vector<ReportImage> pictures, const RunContext& context) {
  pipeline::Policy policy;
  policy.reader = words::Reader::window;
  policy.more = [pictures = std::move(pictures), context](const pipeline::Evaluation& evaluation,
                                                          const std::vector<std::filesystem::path>& made) {
    return filesBeside(evaluation, pictures, made, context);
  };
  return policy;
}

}  // namespace bw::app
