// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// The questions of the window to its user, as dialogs.
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>

#include "window/main_window.h"

namespace bw::app {

namespace {

QString cadFilter() {
  return MainWindow::tr("CAD surfaces (*.step *.stp *.iges *.igs *.brep *.brp);;All files (*)");
}
QString designFilter() { return MainWindow::tr("Bladewright designs (*.bladewright)"); }

}  // namespace

void MainWindow::setDefaultQuestions() {
  const auto remember = [this](const QString& use, const QString& file) {
    if (!file.isEmpty())
      settings_.setFolder(use, QFileInfo(file).isDir() ? file : QFileInfo(file).absolutePath());
    return file;
  };
  questions_.openSurface = [=, this] {
    return remember("open", QFileDialog::getOpenFileName(this, tr("Open CAD surface"),
                                                         settings_.folder("open"), cadFilter()));
  };
  questions_.openDesign = [=, this] {
    return remember("design", QFileDialog::getOpenFileName(this, tr("Open design"),
                                                           settings_.folder("design"), designFilter()));
  };
  questions_.saveDesign = [=, this](const QString& suggestion) {
    QString file = QFileDialog::getSaveFileName(
        this, tr("Save design"), settings_.folder("design") + "/" + suggestion, designFilter());
    if (!file.isEmpty() && QFileInfo(file).suffix().isEmpty()) file += ".bladewright";
    return remember("design", file);
  };
  questions_.savePicture = [=, this](const QString& suggestion) {
    QString file = QFileDialog::getSaveFileName(
        this, tr("Export picture"), settings_.folder("export") + "/" + suggestion, tr("PNG (*.png)"));
    if (!file.isEmpty() && QFileInfo(file).suffix().isEmpty()) file += ".png";
    return remember("export", file);
  };
  questions_.exportFolder = [=, this] {
    return remember("export", QFileDialog::getExistingDirectory(this, tr("Folder for the files"),
                                                                settings_.folder("export")));
  };
  questions_.pictureSize = [this](const QSize& suggestion) {
    QDialog dialog(this);
    dialog.setWindowTitle(tr("Export picture"));
    auto* layout = new QVBoxLayout(&dialog);
    auto* column = new FormColumn(&dialog);
    auto* width = new NumberField({16, 16384, 0, 100, "px"});
    auto* height = new NumberField({16, 16384, 0, 100, "px"});
    width->show(suggestion.width());
    height->show(suggestion.height());
    column->add(tr("Width"), width);
    column->add(tr("Height"), height);
    layout->addWidget(column);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, &dialog);
    auto* go = buttons->addButton(tr("Choose file…"), QDialogButtonBox::AcceptRole);
    go->setObjectName("primary");
    go->style()->unpolish(go);  // the name came after the first polish
    go->style()->polish(go);
    layout->addSpacing(kGap);
    layout->addWidget(buttons);
    connect(buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
    return dialog.exec() == QDialog::Accepted ? QSize(int(width->value()), int(height->value())) : QSize();
  };
  questions_.unsaved = [this](const QString& title) {
    QMessageBox box(QMessageBox::NoIcon, tr("Unsaved changes"),
                    tr("“%1” has changes that are not saved.").arg(title),
                    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, this);
    box.setDefaultButton(QMessageBox::Save);
    switch (box.exec()) {
      case QMessageBox::Save:
        return Questions::Unsaved::save;
      case QMessageBox::Discard:
        return Questions::Unsaved::discard;
      default:
        return Questions::Unsaved::cancel;
    }
  };
}

}  // namespace bw::app
