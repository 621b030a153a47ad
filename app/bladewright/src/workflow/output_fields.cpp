// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workflow/output_fields.h"

#include <QDesktopServices>
#include <QDir>
#include <QFileInfo>
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

FolderField::FolderField(Workbench& bench, QWidget* parent) : TypedField(parent), bench_(bench) {
  setAccessibleName(tr("Folder of exports"));
  setPlaceholderText(tr("Asked for at each export"));
  setToolTip(tr("Where exports go; what others put there stays"));
}

QString FolderField::take(const QString& text) {
  QString typed = text.trimmed();
  if (typed == "~" || typed.startsWith("~/")) typed = QDir::homePath() + typed.mid(1);
  const QFileInfo folder(typed);
  if (!typed.isEmpty()) {
    if (folder.isRelative())
      return tr("\"%1\" does not begin with / or ~; tell the folder from there on").arg(typed);
    if (folder.exists() ? !folder.isDir() : !QFileInfo(folder.absolutePath()).isDir())
      return folder.exists() ? tr("%1 is a file; tell a folder").arg(typed)
                             : tr("there is no folder %1").arg(folder.absolutePath());
  }
  bench_.setExportTo(typed.isEmpty() ? std::string() : QDir::cleanPath(typed).toStdString());
  return {};
}

QString FolderField::valueText() const { return QString::fromStdString(bench_.exportTo().string()); }

QString FolderField::limitsText() const {
  return tr("A folder that is there, or a new one in such a folder");
}

OutputFields::OutputFields(Workbench& bench, FormColumn* column, const Theme& theme, QObject* parent)
    : QObject(parent), bench_(bench) {
  column->addHeading(tr("Programs"));
  for (const ProgramFormat& format : programFormats()) {
    QCheckBox* box = programs_.emplace_back(column->addCheck(tr(format.title), tr(format.about)));
    connect(box, &QCheckBox::clicked, this, [this, word = format.word](bool on) {
      bench_.editDesign(tr("Choose programs"), [=](Design& design) {
        std::vector<std::string> chosen;
        for (const ProgramFormat& each : programFormats())
          if (each.word == word ? on : asked(design, each)) chosen.push_back(each.word);
        design.output.programs = chosen;
      });
    });
  }
  cell_ = column->addBelow(tr("Robot cell"), tr("Robots, tools and the place of the block"));
  if (Result<std::vector<std::string>> names = cellNames()) cells_ = std::move(*names);
  for (const std::string& name : cells_) {
    const Result<Cell> cell = loadCell(name);
    cell_->addItem(QString::fromStdString(cell && !cell->title.empty() ? cell->title : name));
  }
  connect(cell_, &QComboBox::activated, this, [this](int index) {
    bench_.editDesign(tr("Choose robot cell"),
                      [&](Design& design) { design.output.cell = cells_[std::size_t(index)]; });
  });
  column->addHeading(tr("What is written"));
  for (std::size_t i = 0; i < pipeline::kFileKinds; ++i) {
    const pipeline::FileKindInfo& info = pipeline::kFileKindInfos[i];
    kinds_[i] = column->addCheck(tr(info.title), tr(info.about));
    connect(kinds_[i], &QCheckBox::clicked, this,
            [this, i](bool on) { bench_.setWanted(pipeline::FileKind(i), on); });
  }
  column->addWide(
      makeNote(tr("And always the design, report.json and sweep.json, by which a result is "
                  "checked and shown again.")));
  column->addHeading(tr("Blocks"));
  blocks_ = column->addWide(new ExportBlocks(bench, theme));
  column->addHeading(tr("Folder"));
  folder_ = column->addWide(new FolderField(bench));
  column->addWide(makeButton(tr("Choose folder…"), tr("Choose or make the folder that exports go to"), this,
                             &OutputFields::folderRequested));
  column->addGap();
  export_ = column->addWide(makeButton(
      tr("Export everything…"),
      tr("Report (HTML, PDF), CAD surface, mesh, stations, programs and pictures into a folder (Ctrl+E)"),
      this, &OutputFields::exportRequested));
  export_->setObjectName("primary");
  exportPrograms_ = column->addWide(makeButton(tr("Export programs…"), tr("The robot programs alone"), this,
                                               &OutputFields::programsRequested));
  column->addWide(makeButton(tr("Export picture…"), tr("The view as PNG (Ctrl+Shift+E)"), this,
                             &OutputFields::pictureRequested));
  exported_ = column->addWide(makeNote());
  exported_->setTextInteractionFlags(Qt::TextBrowserInteraction);
  exported_->setOpenExternalLinks(false);
  connect(exported_, &QLabel::linkActivated, this,
          [](const QString& link) { QDesktopServices::openUrl(QUrl(link)); });
}

void OutputFields::refresh() {
  const Design& design = bench_.design();
  for (std::size_t i = 0; i < programs_.size(); ++i)
    programs_[i]->setChecked(asked(design, programFormats()[i]));
  const auto cell = std::find(cells_.begin(), cells_.end(), design.output.cell);
  cell_->show(cell == cells_.end() ? -1 : int(cell - cells_.begin()));
}

void OutputFields::refreshState() {
  const pipeline::Wanted wanted = bench_.wanted();
  for (std::size_t i = 0; i < pipeline::kFileKinds; ++i) kinds_[i]->setChecked(wanted.kinds[i]);
  kinds_[std::size_t(pipeline::FileKind::programs)]->setEnabled(!bench_.design().output.programs.empty());
  // What is left is worked out where somebody designs it, or where more than one cut leaves it.
  const Design& design = bench_.design();
  const bool parts = design.source().surface || design.stock.size() > 1 || design.cuts.size() > 1;
  for (const pipeline::FileKind kind : {pipeline::FileKind::workshop, pipeline::FileKind::parts})
    kinds_[std::size_t(kind)]->setEnabled(parts);
  folder_->refresh();
  const QString asks = bench_.exportTo().empty() ? QStringLiteral("…") : QString();
  export_->setText((wanted == pipeline::Wanted() ? tr("Export everything") : tr("Export what is chosen")) +
                   asks);
  exportPrograms_->setText(tr("Export programs") + asks);
  // A button that goes out of use must not hand the keyboard on to the next, which Space would press then.
  const auto allow = [](QPushButton& button, bool may) {
    if (!may && button.hasFocus() && !returnKeyboard(button)) button.clearFocus();
    button.setEnabled(may);
  };
  allow(*export_, bench_.canExport());
  allow(*exportPrograms_, bench_.canExportPrograms());
  const QString folder = QString::fromStdString(bench_.exportFolder().string());
  exported_->setVisible(!folder.isEmpty());
  if (folder.isEmpty()) return;
  QString text = tr("Last export: <a href=\"%1\">%2</a>")
                     .arg(QUrl::fromLocalFile(folder).toString(), folder.toHtmlEscaped());
  // What people read comes first.
  std::vector<WrittenFile> files = bench_.exportedFiles();
  std::ranges::stable_partition(files, [](const WrittenFile& file) {
    return file.path.extension() == ".pdf" || file.path.extension() == ".html";
  });
  for (const WrittenFile& file : files) {
    const std::filesystem::path place = bench_.exportFolder() / file.path;
    QString size = QString::fromStdString(pipeline::sizeText(file.bytes));
    size.replace(' ', QChar::Nbsp);
    text += QStringLiteral("<br><a href=\"%1\">%2</a>&nbsp; %3")
                .arg(QUrl::fromLocalFile(QString::fromStdString(place.string())).toString(),
                     QString::fromStdString(file.path.generic_string()).toHtmlEscaped(), size);
  }
  exported_->setText(text);
}

}  // namespace bw::app
