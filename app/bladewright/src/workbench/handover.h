// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QByteArray>
#include <QImage>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/files/file_set.h"
#include "bw/pipeline/handover.h"

namespace bw::app {

/// A picture of the window as one of a report. `name` is that of its file, without suffix.
pipeline::ReportPicture reportPicture(const std::string& name, const QString& title, const QImage& image);

/// PNG bytes of a picture.
QByteArray pngBytes(const QImage& image);
/// Writes them, all or nothing. An error if the picture is null (`ErrorCode::noSolution`) or cannot be
/// written.
Result<void> writePng(const QImage& image, const std::filesystem::path& file);

/// A file that was written, relative to its folder.
struct WrittenFile {
  std::filesystem::path path;
  std::uintmax_t bytes = 0;
};
std::vector<WrittenFile> writtenFiles(const FileSet& files);

}  // namespace bw::app
