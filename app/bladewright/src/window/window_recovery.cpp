// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// Unsaved work: its picture, how it is kept when the program ends, and what a crash left behind.
#include <QDialog>
#include <QDialogButtonBox>
#include <QScrollArea>

#include <algorithm>

#include "window/main_window.h"
#include "window/recovery_list.h"

namespace bw::app {

namespace {

constexpr QSize kThumbnail(480, 300);
constexpr QSize kDialogSize(760, 420);

}  // namespace

QImage MainWindow::thumbnail() {
  const auto shown = bench_.shown();
  if (shown && shown != pictured_ && view_->isVisible() && view_->resting()) {
    thumbnail_ = view_->picture(kThumbnail, double(kThumbnail.width()) / std::max(1, view_->width()));
    pictured_ = shown;
  }
  return thumbnail_;
}

void MainWindow::keepWork() {
  finishTyping(*this);
  bench_.document().autosaveNow(true);
}

void MainWindow::recover() {
  recovery_->refresh();
  const auto& copies = recovery_->copies();
  if (copies.empty() || onStartPage()) return;
  bench_.tell({Severity::info,
               copies.size() == 1 ? tr("An earlier session left unsaved work.")
                                  : tr("Earlier sessions left %1 unsaved designs.").arg(copies.size()),
               tr("Show…"), [this] { showUnsaved(); }, Topic::recovery});
}

void MainWindow::showUnsaved() {
  QDialog dialog(this);
  dialog.setWindowTitle(tr("Unsaved work"));
  dialog.resize(kDialogSize);
  auto* layout = new QVBoxLayout(&dialog);
  auto* list = new RecoveryList(theme_, recoveryFolder_, &dialog);
  auto* none = makeNote(tr("There is no unsaved work of earlier sessions."));
  none->setVisible(list->copies().empty());
  layout->addWidget(none);
  auto* scroll = new QScrollArea(&dialog);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  auto* page = new QWidget;
  auto* column = makeBox<QVBoxLayout>(page);
  column->addWidget(list);
  column->addStretch();
  scroll->setWidget(page);
  layout->addWidget(scroll, 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, &dialog);
  connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
  layout->addWidget(buttons);
  connect(list, &RecoveryList::openRequested, this, [&](const QString& copy) {
    if (goOnWith(copy)) dialog.accept();
  });
  connect(list, &RecoveryList::discardRequested, this, [&](const QString& copy, const QString& name) {
    discardUnsaved(copy, name);
    list->refresh();
    none->setVisible(list->copies().empty());
  });
  dialog.exec();
}

bool MainWindow::goOnWith(const QString& copy) {
  if (!mayLeave()) return false;
  if (!bench_.recover(copy.toStdString())) return false;
  showWorkspace();
  recovery_->refresh();
  return true;
}

void MainWindow::discardUnsaved(const QString& copy, const QString& name) {
  if (!questions_.discardCopy(name)) return;
  if (!model::discardRecovery(copy.toStdString()))
    bench_.tell(Topic::recovery, Severity::warning, tr("Another window works on %1; it stays.").arg(name));
  recovery_->refresh();
}

}  // namespace bw::app
