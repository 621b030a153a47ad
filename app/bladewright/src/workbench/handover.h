// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QByteArray>
#include <QImage>
#include <QString>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/files/file_set.h"
#include "bw/pipeline/produce.h"
#include "bw/pipeline/report_page.h"

namespace bw::app {

/// A picture that goes into a report.
struct ReportImage {
  std::string name;  ///< of its file, without suffix
  QString title;     ///< what it shows
  QImage image;
};

/// The report of a result and the files beside it as a page that holds its pictures itself, and the same on
/// A4 as PDF with numbered pages. May run beside the window's thread.
struct PrintedReport {
  std::string html;
  std::string pdf;
};
PrintedReport printReport(const pipeline::Evaluation& evaluation, const std::vector<ReportImage>& images,
                          const std::vector<std::filesystem::path>& files);

/// PNG bytes of a picture.
QByteArray pngBytes(const QImage& image);
/// Writes them, all or nothing. An error if the picture is null (`ErrorCode::noSolution`) or cannot be
/// written.
Result<void> writePng(const QImage& image, const std::filesystem::path& file);

/// Has all files of a result made that let it be understood and used without this program: beside those of
/// `Contents::results` the surface as IGES, the mesh as STL, the report as HTML and PDF, and the pictures; of
/// all these what is `wanted`.
pipeline::Policy handoverPolicy(std::vector<ReportImage> pictures, const pipeline::Wanted& wanted,
                                const RunContext& context);

/// A file that was written, relative to its folder.
struct WrittenFile {
  std::filesystem::path path;
  std::uintmax_t bytes = 0;
};
std::vector<WrittenFile> writtenFiles(const FileSet& files);

}  // namespace bw::app
