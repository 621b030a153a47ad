// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workbench/handover.h"

#include <QAbstractTextDocumentLayout>
#include <QBuffer>
#include <QPageLayout>
#include <QPainter>
#include <QPdfWriter>
#include <QTextBlock>
#include <QTextCursor>
#include <QTextDocument>
#include <QThread>
#include <QUrl>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "bw/core/files/file_set.h"
#include "bw/geometry/export.h"

namespace bw::app {

namespace {

constexpr int kWidth = 640;           ///< of a picture on the page, in its pixels of 1/96 inch
constexpr int kResolution = 96;       ///< dots per inch that the page is laid out in
constexpr double kMargin = 15;        ///< mm
constexpr double kFooter = 24;        ///< height of the footer, in dots of the layout
constexpr double kHeadingRoom = 140;  ///< below a heading, in dots of the layout
constexpr const char* kProgram = "Bladewright " BW_VERSION;

std::string pageWith(const pipeline::Evaluation& evaluation, const std::vector<ReportImage>& images,
                     const std::vector<std::filesystem::path>& files,
                     const std::function<QString(std::size_t)>& source) {
  std::vector<pipeline::ReportPicture> pictures;
  for (std::size_t i = 0; i < images.size(); ++i) {
    // Both sides: the layout of the printed page would take the other one from the file as it is.
    const double height = double(kWidth) * images[i].image.height() / std::max(images[i].image.width(), 1);
    pictures.push_back({images[i].title.toStdString(), source(i).toStdString(), kWidth, qRound(height)});
  }
  return pipeline::reportPage(evaluation, pictures, files, kProgram);
}

/// A heading goes to the next page where less than some lines of its table would stand below it.
void keepHeadingsWithTables(QTextDocument& document) {
  const double page = document.pageSize().height();
  for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
    if (block.blockFormat().headingLevel() == 0) continue;
    const double bottom = document.documentLayout()->blockBoundingRect(block).bottom();
    if (std::ceil(bottom / page) * page - bottom > kHeadingRoom) continue;
    QTextBlockFormat format = block.blockFormat();
    format.setPageBreakPolicy(QTextFormat::PageBreak_AlwaysBefore);
    QTextCursor(block).setBlockFormat(format);
  }
}

std::string pdfOf(const QString& html, const QString& title, const std::vector<ReportImage>& images) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  QPdfWriter writer(&buffer);
  writer.setTitle(title);
  writer.setCreator(kProgram);
  writer.setResolution(kResolution);
  writer.setPageSize(QPageSize(QPageSize::A4));
  writer.setPageMargins(QMarginsF(kMargin, kMargin, kMargin, kMargin), QPageLayout::Millimeter);

  QTextDocument document;
  for (std::size_t i = 0; i < images.size(); ++i)
    document.addResource(QTextDocument::ImageResource, QUrl(QString("picture-%1").arg(i)), images[i].image);
  QFont font("Inter");
  font.setFamilies({"Inter", "Noto Sans", "DejaVu Sans"});
  font.setPointSizeF(8.5);
  document.setDefaultFont(font);
  document.documentLayout()->setPaintDevice(&writer);
  document.setDocumentMargin(0);
  document.setHtml(html);
  const QSizeF paper(writer.width(), writer.height() - kFooter);
  document.setPageSize(paper);
  keepHeadingsWithTables(document);

  QPainter painter(&writer);
  const int pages = document.pageCount();
  for (int page = 0; page < pages; ++page) {
    if (page > 0) writer.newPage();
    painter.save();
    painter.translate(0, -page * paper.height());
    document.drawContents(&painter, QRectF(0, page * paper.height(), paper.width(), paper.height()));
    painter.restore();
    painter.setFont(font);
    painter.setPen(QColor(0x6b, 0x70, 0x78));
    painter.drawText(QRectF(0, paper.height(), paper.width(), kFooter), Qt::AlignLeft | Qt::AlignBottom,
                     title);
    painter.drawText(QRectF(0, paper.height(), paper.width(), kFooter), Qt::AlignRight | Qt::AlignBottom,
                     QString("%1 / %2").arg(page + 1).arg(pages));
  }
  painter.end();
  return bytes.toStdString();
}

/// Puts triangles to others.
void append(TriangleMesh& mesh, const TriangleMesh& more) {
  const int before = int(mesh.points.size());
  mesh.points.insert(mesh.points.end(), more.points.begin(), more.points.end());
  mesh.normals.insert(mesh.normals.end(), more.normals.begin(), more.normals.end());
  for (const auto& [a, b, c] : more.triangles) mesh.triangles.push_back({a + before, b + before, c + before});
}

/// Pictures, report, design and surface for others, beside the files that are made already.
Result<FileSet> filesBeside(const pipeline::Evaluation& evaluation, const std::vector<ReportImage>& pictures,
                            const std::vector<std::filesystem::path>& made, const pipeline::Wanted& wanted,
                            const RunContext& context) {
  using pipeline::FileKind;
  const bool pages = wanted.has(FileKind::pages), surface = wanted.has(FileKind::surface),
             meshes = wanted.has(FileKind::meshes);
  FileSet beside;
  for (const ReportImage& picture : pictures)
    if (pages) beside.add("pictures/" + picture.name + ".png", pngBytes(picture.image).toStdString());
  TriangleMesh mesh;
  int strip = 0;
  const bool several = evaluation.blocks.size() > 1 || evaluation.blocks.front().cuts.size() > 1;
  for (const pipeline::BlockEvaluation& block : evaluation.blocks)
    for (const pipeline::CutEvaluation& cut : block.cuts) {
      const SweepAnalysis& analysis = *cut.analysis.value;
      if (meshes) append(mesh, analysis.cut.triangles());
      if (!surface) continue;
      Result<std::string> iges = geometry::igesText(analysis.surface, several ? cut.id : "cut surface");
      if (!iges) return tl::unexpected<Error>(iges.error());
      beside.add(several ? "surface-strip-" + std::to_string(strip++) + ".iges" : "surface.iges",
                 std::move(*iges));
    }
  if (meshes) beside.add("mesh.stl", pipeline::stlBytes(mesh, "Bladewright cut surface, mm"));
  if (context.stopped()) return stoppedError();
  if (!pages) return beside;
  std::vector<std::filesystem::path> all = made;
  all.insert(all.end(), beside.paths().begin(), beside.paths().end());
  PrintedReport report = printReport(evaluation, pictures, all);
  beside.add("report.html", std::move(report.html));
  beside.add("report.pdf", std::move(report.pdf));
  return beside;
}

}  // namespace

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

PrintedReport printReport(const pipeline::Evaluation& evaluation, const std::vector<ReportImage>& images,
                          const std::vector<std::filesystem::path>& files) {
  PrintedReport report;
  report.html = pageWith(evaluation, images, files, [&](std::size_t i) {
    return "data:image/png;base64," + QString::fromLatin1(pngBytes(images[i].image).toBase64());
  });
  const std::string plain =
      pageWith(evaluation, images, files, [](std::size_t i) { return QString("picture-%1").arg(i); });
  // Laying out text takes a thread of Qt, which the caller's need not be.
  const std::unique_ptr<QThread> printer(QThread::create([&] {
    report.pdf = pdfOf(QString::fromStdString(plain), QString::fromStdString(evaluation.design.name), images);
  }));
  printer->start();
  printer->wait();
  return report;
}

std::vector<WrittenFile> writtenFiles(const FileSet& files) {
  std::vector<WrittenFile> list;
  for (std::size_t i = 0; i < files.paths().size(); ++i)
    list.push_back({files.paths()[i], files.bytes()[i].size()});
  return list;
}

pipeline::Policy handoverPolicy(std::vector<ReportImage> pictures, const pipeline::Wanted& wanted,
                                const RunContext& context) {
  pipeline::Policy policy;
  policy.wanted = wanted;
  policy.reader = words::Reader::window;
  policy.more = [pictures = std::move(pictures), wanted, context](
                    const pipeline::Evaluation& evaluation, const std::vector<std::filesystem::path>& made) {
    return filesBeside(evaluation, pictures, made, wanted, context);
  };
  return policy;
}

}  // namespace bw::app
