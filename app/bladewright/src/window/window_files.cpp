// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// Opening, saving, exporting: what the window does with files, after asking where and whether it may.
#include <QDragEnterEvent>
#include <QFile>
#include <QMimeData>

#include <algorithm>

#include "window/main_window.h"

namespace bw::app {

namespace {

constexpr int kPictureScale = 2;  ///< suggested pixels of a picture, by those of the view

}  // namespace

bool MainWindow::mayLeave() {
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
  banner_->hide();
  const Result<void> opened = bench_.openFile(file.toStdString());
  if (opened) showWorkspace();
  return opened;
}

Result<void> MainWindow::openExample(const QString& name) {
  if (!mayLeave()) return stoppedError();
  banner_->hide();
  const Result<void> opened = bench_.openExample(name.toStdString());
  if (opened) showWorkspace();
  return opened;
}

bool MainWindow::save() {
  if (bench_.document().empty()) return false;
  if (bench_.document().file().empty()) return saveAs();
  return bench_.saveTo(bench_.document().file());
}

bool MainWindow::saveAs() {
  if (bench_.document().empty()) return false;
  const QString file = questions_.saveDesign(bench_.document().title() + ".bladewright");
  return !file.isEmpty() && bench_.saveTo(file.toStdString());
}

void MainWindow::exportEverything() {
  if (!bench_.current()) return;
  if (const QString folder = questions_.exportFolder(); !folder.isEmpty())
    bench_.exportAll(folder.toStdString());
}

void MainWindow::exportPrograms() {
  if (!bench_.current()) return;
  if (const QString folder = questions_.exportFolder(); !folder.isEmpty())
    bench_.exportPrograms(folder.toStdString());
}

void MainWindow::exportPicture() {
  if (onStartPage()) return;
  const QSize size = questions_.pictureSize(view_->size() * kPictureScale);
  if (size.isEmpty()) return;
  const QString file = questions_.savePicture(bench_.document().title() + ".png");
  if (file.isEmpty()) return;
  const double ratio = std::max(1.0, double(size.width()) / std::max(1, view_->width()));
  const QImage image = view_->picture(size, ratio);
  // Written beside its place first: a full disk leaves no half picture.
  const QString part = file + ".part";
  if (image.isNull() || !image.save(part, "PNG") || (QFile::exists(file) && !QFile::remove(file)) ||
      !QFile::rename(part, file)) {
    QFile::remove(part);
    bench_.tell({Severity::error,
                 tr("The picture could not be written to %1; choose another folder.").arg(file),
                 {},
                 {}});
    return;
  }
  bench_.tell({Severity::info, tr("Picture written to %1").arg(file), {}, {}});
}

void MainWindow::recover() {
  std::optional<model::Recovered> found = model::takeRecovered(recoveryFolder_);
  if (!found) return;
  bench_.document().recover(std::move(found->design), found->file);
  showWorkspace();
  bench_.tell({Severity::info, tr("Unsaved work on “%1” was recovered.").arg(bench_.document().title()),
               tr("Discard it"), [this] { showStartPage(); }});
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
