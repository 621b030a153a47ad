// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workbench/handover.h"

#include <QBuffer>

namespace bw::app {

pipeline::ReportPicture reportPicture(const std::string& name, const QString& title, const QImage& image) {
  // Without the channel of what shines through: nothing does, and not every reader of pages takes it.
  const QImage plain = image.convertToFormat(QImage::Format_RGB888);
  return {name, title.toStdString(), pngBytes(plain).toStdString(), image.width(), image.height()};
}

QByteArray pngBytes(const QImage& image) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  image.save(&buffer, "PNG");
  return bytes;
}

Result<void> writePng(const QImage& image, const std::filesystem::path& file) {
  const QByteArray png = image.isNull() ? QByteArray() : pngBytes(image);
  if (png.isEmpty())
    return fail(ErrorCode::noSolution, "no picture of this size can be made; choose a smaller one");
  return writeFile(file, png.toStdString());
}

std::vector<WrittenFile> writtenFiles(const FileSet& files) {
  std::vector<WrittenFile> list;
  for (std::size_t i = 0; i < files.paths().size(); ++i)
    list.push_back({files.paths()[i], files.bytes()[i].size()});
  return list;
}

}  // namespace bw::app
