// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/picture_file.h"

#include <QBuffer>

#include "bw/core/file_set.h"

namespace bw::app {

Result<void> writePng(const QImage& image, const std::filesystem::path& file) {
  QByteArray png;
  QBuffer buffer(&png);
  buffer.open(QIODevice::WriteOnly);
  if (image.isNull() || !image.save(&buffer, "PNG"))
    return fail(ErrorCode::noSolution, "no picture of this size can be made; choose a smaller one");
  return writeFile(file, png.toStdString());
}

}  // namespace bw::app
