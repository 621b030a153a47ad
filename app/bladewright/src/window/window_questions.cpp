// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// The questions of the window to its user, as dialogs, and unsaved work: its picture, how it is kept when the
// program ends, and what a crash left behind.
#include <QDesktopServices>
#include <QDialog>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QLineEdit>
#include <QLocale>
#include <QMessageBox>
#include <QPushButton>
#include <QScrollArea>
#include <QUrl>

#include <algorithm>

#include "window/main_window.h"

namespace bw::app {

namespace {

QString cadFilter() {
  return MainWindow::tr("CAD files (*.step *.stp *.stpz *.iges *.igs *.brep *.brp *.dxf);;All files (*)");
}
QString designFilter() { return MainWindow::tr("Bladewright designs (*.bladewright)"); }

/// A question with Cancel, about something that replaces or removes what somebody made.
struct Question {
  Question(const QString& title, const QString& text, QWidget* window)
      : box(QMessageBox::NoIcon, title, text, QMessageBox::Cancel, window) {}

  /// True if the person wants it: the button `act`.
  bool ask(const QString& act) { return ask<bool>({}, false, act, true, false); }
  /// The answer that belongs to the button pressed; the harmless way, if there is one, is proposed.
  template <class Answer>
  Answer ask(const QString& harmless, Answer ifHarmless, const QString& act, Answer ifAct, Answer otherwise) {
    QPushButton* spare = harmless.isEmpty() ? nullptr : box.addButton(harmless, QMessageBox::AcceptRole);
    const QPushButton* done = box.addButton(act, QMessageBox::DestructiveRole);
    if (spare) box.setDefaultButton(spare);
    box.exec();
    if (spare && box.clickedButton() == spare) return ifHarmless;
    return box.clickedButton() == done ? ifAct : otherwise;
  }

  QMessageBox box;
};

/// A question for numbers: fields with Cancel and a button that takes them below.
struct NumbersQuestion {
  NumbersQuestion(const QString& title, QWidget* window) : dialog(window), column(new FormColumn(&dialog)) {
    constexpr int kButtons = 160;  // px beside the title, of what closes the dialog
    dialog.setWindowTitle(title);
    dialog.setMinimumWidth(dialog.fontMetrics().horizontalAdvance(title) + kButtons);
  }

  /// True if the person took them with the button `act`; what is refused is not taken.
  bool ask(const QString& act) {
    auto* layout = new QVBoxLayout(&dialog);
    layout->addWidget(column);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, &dialog);
    auto* go = buttons->addButton(act, QDialogButtonBox::AcceptRole);
    go->setObjectName("primary");
    go->style()->unpolish(go);  // the name came after the first polish
    go->style()->polish(go);
    layout->addSpacing(kGap);
    layout->addWidget(buttons);
    QObject::connect(buttons, &QDialogButtonBox::accepted, &dialog, [this] {
      // Wherever the keyboard is: a press of the button may have taken it from the field.
      for (TypedField* field : dialog.findChildren<TypedField*>()) field->finish();
      if (TypedField* field = refusedField(dialog))
        field->setFocus();
      else
        dialog.accept();
    });
    QObject::connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
    return dialog.exec() == QDialog::Accepted;
  }

  QDialog dialog;
  FormColumn* column;
};

/// A question for a folder; one that is typed and not there yet is made, if what it lies in is there. Without
/// a meta-object of its own, so that the desktop may show its own dialog in its place.
class FolderQuestion : public QFileDialog {
 public:
  using QFileDialog::QFileDialog;

  void accept() override {
    // Qt's own dialog says of such a name that there is nothing.
    const auto* typed = findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
    const QString name = typed && typed->isVisible() ? typed->text().trimmed() : QString();
    if (!name.isEmpty() && !name.startsWith('~') && !QFileInfo::exists(directory().absoluteFilePath(name)))
      directory().mkdir(name);
    QFileDialog::accept();
  }
};

constexpr QSize kThumbnail(480, 300);
constexpr QSize kDialogSize(760, 420);
constexpr double kThinnestPanel = 0.1;  // mm

}  // namespace

void MainWindow::setDefaultQuestions() {
  const auto remember = [this](const QString& use, const QString& file) {
    if (!file.isEmpty())
      settings_.setFolder(use, QFileInfo(file).isDir() ? file : QFileInfo(file).absolutePath());
    return file;
  };
  // The dialog asked about the name that was typed, not about the one with the suffix.
  const auto completed = [this](const QString& file, const QString& suffix) {
    if (file.isEmpty() || file.endsWith(suffix, Qt::CaseInsensitive)) return file;
    return QFileInfo::exists(file + suffix) && !questions_.replaceFile(file + suffix) ? QString()
                                                                                      : file + suffix;
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
    const QString file = QFileDialog::getSaveFileName(
        this, tr("Save design"), settings_.folder("design") + "/" + suggestion, designFilter());
    return remember("design", completed(file, ".bladewright"));
  };
  questions_.savePicture = [=, this](const QString& suggestion) {
    const QString file = QFileDialog::getSaveFileName(
        this, tr("Export picture"), settings_.folder("export") + "/" + suggestion, tr("PNG (*.png)"));
    return remember("export", completed(file, ".png"));
  };
  questions_.exportFolder = [=, this] {
    FolderQuestion question(this, tr("Folder for the files"), settings_.folder("export"));
    question.setFileMode(QFileDialog::Directory);
    question.setOption(QFileDialog::ShowDirsOnly);
    if (question.exec() != QDialog::Accepted || question.selectedFiles().isEmpty()) return QString();
    return remember("export", question.selectedFiles().front());
  };
  questions_.showFolder = [](const QString& folder) {
    QDesktopServices::openUrl(QUrl::fromLocalFile(folder));
  };
  questions_.pictureSize = [this](const QSize& suggestion) {
    NumbersQuestion question(tr("Export picture"), this);
    auto* width = question.column->add(tr("Width"), new NumberField({16, 16384, 0, 100, "px"}));
    auto* height = question.column->add(tr("Height"), new NumberField({16, 16384, 0, 100, "px"}));
    width->show(suggestion.width());
    height->show(suggestion.height());
    return question.ask(tr("Choose file…")) ? QSize(int(width->value()), int(height->value())) : QSize();
  };
  questions_.panelThickness = [this](double suggestion) {
    NumbersQuestion question(tr("Two moulds for a panel"), this);
    auto* thickness = question.column->add(
        tr("Thickness"), new NumberField({kThinnestPanel, 2 * Cut::kMostOffset, 2, 1, "mm"}),
        tr("Of the panel; its middle is the surface"));
    thickness->show(suggestion);
    thickness->selectAll();
    return question.ask(tr("Make moulds")) ? std::optional(thickness->value()) : std::nullopt;
  };
  questions_.changedOnDisk = [this](const QString& file) {
    Question question(tr("Changed on disk"),
                      tr("Somebody else changed “%1” on %2, after it was opened here.")
                          .arg(QFileInfo(file).fileName(),
                               QLocale().toString(QFileInfo(file).lastModified(), QLocale::ShortFormat)),
                      this);
    question.box.setInformativeText(tr("Saving here would undo those changes."));
    return question.ask<Questions::Changed>(tr("Save under another name…"), Questions::Changed::otherName,
                                            tr("Replace"), Questions::Changed::replace,
                                            Questions::Changed::cancel);
  };
  questions_.replaceFile = [this](const QString& file) {
    Question question(tr("Replace a file"), tr("“%1” exists already.").arg(file), this);
    return question.ask(tr("Replace"));
  };
  questions_.discardCopy = [this](const QString& name) {
    Question question(tr("Discard unsaved work"),
                      tr("The unsaved changes of “%1” cannot be brought back.").arg(name), this);
    question.box.setDefaultButton(QMessageBox::Cancel);
    return question.ask(tr("Discard"));
  };
  questions_.earlierExport = [this](const auto& folder, const auto& files, const auto& other) {
    const QString name = QString::fromStdString(folder.filename().string());
    Question question(
        tr("Earlier export"),
        files.size() == 1
            ? tr("“%1” holds a file that this export would replace.").arg(name)
            : tr("“%1” holds %2 files that this export would replace.").arg(name).arg(files.size()),
        this);
    QStringList list;
    for (const std::filesystem::path& file : files) list << QString::fromStdString(file.string());
    question.box.setDetailedText(list.join("\n"));
    return question.ask<Workbench::Earlier>(
        tr("Write to “%1”").arg(QString::fromStdString(other.filename().string())),
        Workbench::Earlier::newFolder, tr("Replace"), Workbench::Earlier::replace,
        Workbench::Earlier::cancel);
  };
  questions_.unsaved = [this](const QString& title) {
    QMessageBox box(QMessageBox::NoIcon, tr("Unsaved changes"),
                    tr("“%1” has changes that are not saved.").arg(title),
                    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, this);
    box.setDefaultButton(QMessageBox::Save);
    const int answer = box.exec();
    return answer == QMessageBox::Save      ? Questions::Unsaved::save
           : answer == QMessageBox::Discard ? Questions::Unsaved::discard
                                            : Questions::Unsaved::cancel;
  };
}

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
