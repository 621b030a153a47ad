// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/output_fields.h"

#include <QDesktopServices>
#include <QUrl>

#include <algorithm>

#include "bw/core/design/program_formats.h"
#include "bw/core/motion/cell.h"

namespace bw::app {

namespace {

bool asked(const Design& design, const ProgramFormat& format) {
  return std::ranges::find(design.output.programs, format.word) != design.output.programs.end();
}

}  // namespace

OutputFields::OutputFields(Workbench& bench, FormColumn* column, QObject* parent)
    : QObject(parent), bench_(bench) {
  for (const ProgramFormat& format : programFormats()) {
    auto* box = new QCheckBox(tr(format.title));
    box->setToolTip(tr(format.about));
    column->addWide(box);
    programs_.push_back(box);
    connect(box, &QCheckBox::clicked, this, [this, word = format.word](bool on) {
      bench_.editDesign(tr("Choose programs"), [=](Design& design) {
        std::vector<std::string> chosen;
        for (const ProgramFormat& each : programFormats())
          if (each.word == word ? on : asked(design, each)) chosen.push_back(each.word);
        design.output.programs = chosen;
      });
    });
  }
  cell_ = new ChoiceField;
  if (Result<std::vector<std::string>> names = cellNames()) cells_ = std::move(*names);
  for (const std::string& name : cells_) {
    const Result<Cell> cell = loadCell(name);
    cell_->addItem(QString::fromStdString(cell && !cell->title.empty() ? cell->title : name));
  }
  column->addBelow(tr("Robot cell"), cell_, tr("Robots, tools and the place of the block"));
  connect(cell_, &QComboBox::activated, this, [this](int index) {
    bench_.editDesign(tr("Choose robot cell"),
                      [&](Design& design) { design.output.cell = cells_[std::size_t(index)]; });
  });
  column->addGap(2);
  export_ = new QPushButton(tr("Export everything…"));
  export_->setObjectName("primary");
  export_->setToolTip(
      tr("Report (HTML, PDF), CAD surface, mesh, stations, programs and pictures into a folder (Ctrl+E)"));
  column->addWide(export_);
  connect(export_, &QPushButton::clicked, this, &OutputFields::exportRequested);
  exportPrograms_ = new QPushButton(tr("Export programs…"));
  exportPrograms_->setToolTip(tr("The robot programs alone"));
  column->addWide(exportPrograms_);
  connect(exportPrograms_, &QPushButton::clicked, this, &OutputFields::programsRequested);
  auto* picture = new QPushButton(tr("Export picture…"));
  picture->setToolTip(tr("The view as PNG (Ctrl+Shift+E)"));
  column->addWide(picture);
  connect(picture, &QPushButton::clicked, this, &OutputFields::pictureRequested);
  exported_ = makeNote();
  exported_->setTextInteractionFlags(Qt::TextBrowserInteraction);
  exported_->setOpenExternalLinks(false);
  connect(exported_, &QLabel::linkActivated, this,
          [](const QString& link) { QDesktopServices::openUrl(QUrl(link)); });
  column->addWide(exported_);
}

void OutputFields::refresh() {
  const Design& design = bench_.design();
  for (std::size_t i = 0; i < programs_.size(); ++i)
    programs_[i]->setChecked(asked(design, programFormats()[i]));
  const auto cell = std::find(cells_.begin(), cells_.end(), design.output.cell);
  cell_->show(cell == cells_.end() ? -1 : int(cell - cells_.begin()));
}

void OutputFields::refreshState() {
  export_->setEnabled(bench_.canExport());
  exportPrograms_->setEnabled(bench_.canExportPrograms());
  const QString folder = QString::fromStdString(bench_.exportFolder().string());
  exported_->setVisible(!folder.isEmpty());
  if (folder.isEmpty()) return;
  QString text = tr("Last export: <a href=\"%1\">%2</a>")
                     .arg(QUrl::fromLocalFile(folder).toString(), folder.toHtmlEscaped());
  for (const WrittenFile& file : bench_.exportedFiles()) {
    const std::filesystem::path place = bench_.exportFolder() / file.path;
    text += QStringLiteral("<br><a href=\"%1\">%2</a>&nbsp; %3")
                .arg(QUrl::fromLocalFile(QString::fromStdString(place.string())).toString(),
                     QString::fromStdString(file.path.generic_string()).toHtmlEscaped(),
                     QString::fromStdString(pipeline::sizeText(file.bytes)));
  }
  exported_->setText(text);
}

}  // namespace bw::app
