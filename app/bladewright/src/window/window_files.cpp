// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// Opening, saving, exporting: what the window does with files, after asking where and whether it may.
#include <QDragEnterEvent>
#include <QMimeData>

#include <algorithm>
#include <utility>

#include "window/main_window.h"

namespace bw::app {

namespace {

constexpr QSize kReportPicture(pipeline::kReportPictureWidth, pipeline::kReportPictureHeight);
constexpr int kPictureScale = 2;  ///< suggested pixels of a picture, by those of the view

}  // namespace

bool MainWindow::mayLeave() {
  finishTyping(*this);
  if (bench_.document().empty() || !bench_.document().modified()) return true;
  switch (questions_.unsaved(bench_.document().title())) {
    case Questions::Unsaved::save:
      return save();
    case Questions::Unsaved::discard:
      return true;
    case Questions::Unsaved::cancel:
      return false;
  }
  return false;
}

Result<void> MainWindow::openFile(const QString& file) {
  if (!mayLeave()) return stoppedError();
  const Result<void> opened = bench_.openFile(file.toStdString());
  if (opened && !bench_.reading()) showWorkspace();
  return opened;
}

Result<void> MainWindow::openExample(const QString& name) {
  if (!mayLeave()) return stoppedError();
  const Result<void> opened = bench_.openExample(name.toStdString());
  if (opened) showWorkspace();
  return opened;
}

void MainWindow::replaceSurface(const QString& text) {
  const QString file = questions_.openSurface();
  if (!file.isEmpty()) static_cast<void>(bench_.replaceSource(file.toStdString(), text));
}

bool MainWindow::save() {
  finishTyping(*this);
  if (bench_.document().empty()) return false;
  const std::filesystem::path& file = bench_.document().file();
  if (file.empty()) return saveAs();
  if (bench_.document().changedOnDisk()) {
    switch (questions_.changedOnDisk(QString::fromStdString(file.string()))) {
      case Questions::Changed::replace:
        break;
      case Questions::Changed::otherName:
        return saveAs();
      case Questions::Changed::cancel:
        return false;
    }
  }
  return bench_.saveTo(file);
}

bool MainWindow::saveAs() {
  if (bench_.document().empty()) return false;
  const QString chosen = questions_.saveDesign(bench_.document().title() + ".bladewright");
  if (chosen.isEmpty()) return false;
  // Drawings and reports tell a design by its name: it takes that of its file, unless it was given another.
  const std::filesystem::path file = chosen.toStdString(), before = bench_.document().file();
  const bool follows = before.empty() || bench_.design().name == before.stem().string();
  return bench_.saveTo(file, follows ? std::optional(file.stem().string()) : std::nullopt);
}

bool MainWindow::numbersStand() {
  finishTyping(*this);
  TypedField* field = refusedField(*workflow_);
  const bool left = field != nullptr;
  if (!left) field = inspector_->showRefused();
  if (!field) return true;
  if (QAction* panel = commands_[left ? "panel.workflow" : "panel.inspector"]; !panel->isChecked())
    panel->trigger();
  unfold(*field);
  field->setFocus();
  // When what was folded away has its place.
  QTimer::singleShot(0, field, [field, area = left ? static_cast<QScrollArea*>(workflow_) : inspector_] {
    area->ensureWidgetVisible(field);
  });
  bench_.tell(Topic::refusal, Severity::error,
              tr("“%1” in the field %2 was not taken, so nothing was exported. Correct it, or bring the old "
                 "one back with Esc.")
                  .arg(field->text(), field->accessibleName()));
  connect(
      field, &QLineEdit::textChanged, &bench_, [this] { emit bench_.noticesOutdated(Topic::refusal); },
      Qt::SingleShotConnection);
  return false;
}

void MainWindow::exportEverything() {
  order([this](const std::filesystem::path& folder) {
    bench_.exportAll(folder, bench_.wanted().has(pipeline::FileKind::pages)
                                 ? reportPictures()
                                 : std::vector<pipeline::ReportPicture>());
  });
}

void MainWindow::order(const std::function<void(const std::filesystem::path&)>& write) {
  if (!numbersStand() || !bench_.canExport()) return;
  const QString folder = bench_.exportTo().empty() ? questions_.exportFolder()
                                                   : QString::fromStdString(bench_.exportTo().string());
  if (folder.isEmpty()) return;
  ordered_ = [write, folder] { write(folder.toStdString()); };
  if (!bench_.runner().busy()) return runOrder();
  bench_.tell(Topic::evaluation, Severity::info,
              tr("The result is being computed; the files are written as soon as it stands."));
}

void MainWindow::runOrder() {
  const auto write = std::exchange(ordered_, nullptr);
  if (!write) return;
  if (bench_.current()) return write();
  bench_.tell(Topic::declined, Severity::error,
              tr("Nothing was exported, because the design has no finished result."));
}

std::vector<pipeline::ReportPicture> MainWindow::reportPictures() {
  const scene::Style style = view_->sceneStyle();
  std::vector<pipeline::ReportPicture> pictures;
  for (const pipeline::PictureOfReport& wanted : pipeline::kReportPictures) {
    if (const auto shown = bench_.shown(); shown && !pipeline::isOf(wanted, *shown)) continue;
    // As on paper: light, with nothing chosen and no blade on its way.
    scene::Style paper;
    paper[scene::Kind::cut].map = wanted.field;
    paper.tolerance = style.tolerance;
    view_->setStyle(paper);
    const QImage image =
        view_->picture(kReportPicture, 1, wanted.above ? scene::View::top : scene::View::iso);
    if (!image.isNull()) pictures.push_back(reportPicture(wanted.name, tr(wanted.title), image));
  }
  view_->setStyle(style);
  return pictures;
}

void MainWindow::exportPrograms() {
  order([this](const std::filesystem::path& folder) { bench_.exportPrograms(folder); });
}

void MainWindow::exportPicture() {
  if (onStartPage()) return;
  const QSize size = questions_.pictureSize(view_->size() * kPictureScale);
  if (size.isEmpty()) return;
  const QString file = questions_.savePicture(bench_.document().title() + ".png");
  if (file.isEmpty()) return;
  const double ratio = std::max(1.0, double(size.width()) / std::max(1, view_->width()));
  const QImage image = beside_->picture(size, ratio);
  if (Result<void> written = writePng(image, file.toStdString()); !written)
    return bench_.tell(Topic::declined, written.error());
  bench_.tell(Topic::written, Severity::info, tr("Picture written to %1").arg(file));
}

void MainWindow::refreshRecent() {
  recentMenu_->clear();
  const auto files = settings_.recentFiles();
  for (const std::filesystem::path& file : files) {
    const QString path = QString::fromStdString(file.string());
    QAction* action = recentMenu_->addAction(QString(path).replace("&", "&&"));
    connect(action, &QAction::triggered, this, [this, path] { openFile(path); });
  }
  if (!files.empty()) {
    recentMenu_->addSeparator();
    connect(recentMenu_->addAction(tr("Clear the list")), &QAction::triggered, &settings_,
            &model::Settings::clearRecentFiles);
  }
  recentMenu_->setEnabled(!files.empty());
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls() && event->mimeData()->urls().first().isLocalFile())
    event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  if (!event->mimeData()->hasUrls()) return;
  event->acceptProposedAction();
  const QString file = event->mimeData()->urls().first().toLocalFile();
  // The question about unsaved changes must not hold up the drag.
  QTimer::singleShot(0, this, [this, file] { openFile(file); });
}

}  // namespace bw::app
