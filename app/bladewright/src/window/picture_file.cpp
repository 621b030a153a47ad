// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/picture_file.h"

#include "bw/core/files/file_set.h"
#include "workbench/report_print.h"

namespace bw::app {

Result<void> writePng(const QImage& image, const std::filesystem::path& file) {
  const QByteArray png = image.isNull() ? QByteArray() : pngBytes(image);
  if (png.isEmpty())
    return fail(ErrorCode::noSolution, "no picture of this size can be made; choose a smaller one");
  return writeFile(file, png.toStdString());
}

}  // namespace bw::app
