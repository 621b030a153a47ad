// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Saved is safe: recovery, notices that stay, files that others wrote, earlier exports.
#include <sys/resource.h>

#include <QDialogButtonBox>
#include <QSessionManager>

#include <csignal>
#include <cstddef>

#include "bw/model/recovery.h"
#include "window/desktop.h"
#include "window/start_page.h"
#include "window_fixture.h"

namespace bw::app {
namespace {

class SavedWork : public WindowTest {
 protected:
  fs::path recovery() const { return path("recovery"); }

  /// A window that copies its work to `recovery()`.
  void makeKeepingWindow() {
    window_ = std::make_unique<MainWindow>(*settings_, theme(), recovery());
    window_->questions().showFolder = [](const QString&) {};
    window_->resize(1440, 900);
    window_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
    window_->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
  }

  /// Ends the window as a crash does: nobody is asked, the copy stays.
  void crash() {
    bench().document().autosaveNow(true);
    window_.reset();
  }

  QPushButton* button(QWidget& parent, const QString& accessibleName) {
    for (QPushButton* b : parent.findChildren<QPushButton*>())
      if (b->accessibleName() == accessibleName) return b;
    return nullptr;
  }

  /// Types over the number of stations, then gives the keyboard to another window without Enter.
  void typeAndLookAway(const QString& text) {
    auto* number = find<NumberField>("Number");
    ASSERT_TRUE(number);
    number->setFocus();
    number->selectAll();
    QTest::keyClicks(number, text);
    other_.show();
    other_.activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&other_));
    ASSERT_FALSE(number->hasFocus());
    ASSERT_EQ(number->text(), text);
    ASSERT_EQ(bench().design().cut().sections.stations, 20) << "a glance at another window takes nothing yet";
  }

  QWidget other_;
};

TEST_F(SavedWork, IsKeptWhenTheSessionEnds) {
  makeKeepingWindow();
  openPanel();
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
  const EndOfSession ending(window());
  // Only the desktop makes such a manager; what hears of it does not look into it.
  alignas(QSessionManager) std::byte room[sizeof(QSessionManager)] = {};
  emit qApp->commitDataRequest(reinterpret_cast<QSessionManager&>(room));
  ASSERT_TRUE(fs::exists(recovery()));
  EXPECT_FALSE(fs::is_empty(recovery()));
  ASSERT_TRUE(settle());
}

TEST(DisplayCheck, TellsInABoxWhatIsMissing) {
  bool told = false;
  QTimer timer;
  timer.setInterval(20);
  QObject::connect(&timer, &QTimer::timeout, [&] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (!box) return;
    told = box->text() == "There is no OpenGL.";
    box->accept();
  });
  timer.start();
  testing::internal::CaptureStderr();
  tellOpenGlProblem("There is no OpenGL.", true);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "bladewright: There is no OpenGL.\n");
  EXPECT_TRUE(told);
}

TEST_F(SavedWork, IsListedAfterACrashAndGoneOnWith) {
  makeKeepingWindow();
  openPanel();
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
  ASSERT_TRUE(settle());
  ASSERT_TRUE(QTest::qWaitFor([&] { return window().sceneView().resting(); }, kPatience));
  crash();
  makeKeepingWindow();
  window().recover();
  ASSERT_TRUE(window().onStartPage());
  RecoveryList& list = window().recoveryList();
  ASSERT_TRUE(list.isVisible());
  ASSERT_EQ(list.copies().size(), 1u);
  EXPECT_FALSE(list.copies()[0].picture.isNull());
  picture("unsaved-start");
  auto* open = button(list, "Go on with " + list.copies()[0].name);
  ASSERT_TRUE(open);
  QTest::mouseClick(open, Qt::LeftButton);
  EXPECT_FALSE(window().onStartPage());
  EXPECT_EQ(bench().design().process.tolerance, 0.75);
  EXPECT_TRUE(window().isWindowModified());
  EXPECT_TRUE(list.copies().empty());
  ASSERT_TRUE(settle());
  EXPECT_TRUE(window().banner().text().contains("is not saved yet")) << "the notice went with the evaluation";
  picture("unsaved-recovered");
  const QString file = QString::fromStdString(path("panel.bladewright").string());
  window().questions().saveDesign = [file](const QString&) { return file; };
  ASSERT_TRUE(window().save());
  EXPECT_TRUE(fs::is_empty(recovery()));
  EXPECT_FALSE(window().banner().isVisible()) << window().banner().text().toStdString();
}

TEST_F(SavedWork, IsToldAsRecoveredOfItsDesignOnly) {
  makeKeepingWindow();
  openPanel();
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
  crash();
  makeKeepingWindow();
  window().recover();
  auto* open = button(window().recoveryList(), "Go on with " + window().recoveryList().copies().at(0).name);
  ASSERT_TRUE(open);
  QTest::mouseClick(open, Qt::LeftButton);
  EXPECT_TRUE(window().banner().text().contains("is not saved yet"));
  window().questions().unsaved = [](const QString&) { return Questions::Unsaved::discard; };
  window().openExample("saddle");
  EXPECT_FALSE(window().banner().isVisible()) << window().banner().text().toStdString();
  ASSERT_TRUE(settle());
}

TEST_F(SavedWork, IsToldWhenAFileWasNamedOnTheCommandLine) {
  for (const char* name : {"saddle", "panel-600x670"}) {
    makeKeepingWindow();
    window().openExample(name);
    bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
    crash();
  }
  makeKeepingWindow();
  openPanel();
  window().recover();
  EXPECT_EQ(window().banner().text(), "Earlier sessions left 2 unsaved designs.");
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.5; });
  ASSERT_TRUE(settle());
  EXPECT_EQ(window().banner().text(), "Earlier sessions left 2 unsaved designs.");
  picture("unsaved-notice");
  bench().document().undoStack().undo();
  // The newest first; one is discarded, after a question.
  window().questions().discardCopy = [](const QString&) { return true; };
  answer([&] { QTest::mouseClick(window().banner().action(), Qt::LeftButton); }, "unsaved-dialog",
         [&](QDialog& dialog) {
           auto* list = dialog.findChild<RecoveryList*>();
           ASSERT_TRUE(list);
           ASSERT_EQ(list->copies().size(), 2u);
           EXPECT_GE(list->copies()[0].time, list->copies()[1].time);
           auto* discard = button(*list, "Discard " + list->copies()[1].name);
           ASSERT_TRUE(discard);
           QTest::mouseClick(discard, Qt::LeftButton);
           EXPECT_EQ(list->copies().size(), 1u);
           dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Close)->click();
         });
  EXPECT_EQ(model::listRecovery(recovery()).size(), 1u);
}

TEST_F(SavedWork, LeavesNoCopyWhereThePersonGaveItUp) {
  makeKeepingWindow();
  openPanel();
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
  bench().document().autosaveNow(true);
  ASSERT_FALSE(fs::is_empty(recovery()));
  window().questions().unsaved = [](const QString&) { return Questions::Unsaved::cancel; };
  EXPECT_FALSE(window().close());
  EXPECT_FALSE(fs::is_empty(recovery()));
  window().questions().unsaved = [](const QString&) { return Questions::Unsaved::discard; };
  EXPECT_TRUE(window().close());
  EXPECT_TRUE(fs::is_empty(recovery()));
}

TEST_F(SavedWork, KeepsWhatIsBeingTypedWhenTheProgramEnds) {
  makeKeepingWindow();
  openPanel();
  auto* number = find<NumberField>("Number");
  ASSERT_TRUE(number);
  number->setFocus();
  number->selectAll();
  QTest::keyClicks(number, "33");
  window().keepWork();
  window_.reset();
  const std::vector<model::RecoveryCopy> copies = model::listRecovery(recovery());
  ASSERT_EQ(copies.size(), 1u);
  EXPECT_EQ(loadDesign(copies[0].copy)->cut().sections.stations, 33);
}

TEST_F(SavedWork, KeepsWhatIsBeingTypedWhileAnotherProgramHasTheKeyboard) {
  makeKeepingWindow();
  openPanel();
  typeAndLookAway("33");
  window().keepWork();
  window_.reset();
  const std::vector<model::RecoveryCopy> copies = model::listRecovery(recovery());
  ASSERT_EQ(copies.size(), 1u);
  EXPECT_EQ(loadDesign(copies[0].copy)->cut().sections.stations, 33);
}

TEST_F(SavedWork, IsAskedForByAFileDroppedFromAnotherProgram) {
  openPanel();
  typeAndLookAway("33");
  int asked = 0;
  window().questions().unsaved = [&](const QString&) {
    ++asked;
    return Questions::Unsaved::cancel;
  };
  ASSERT_TRUE(writeFile(path("other.step"), geometry::exampleStep("saddle").value()));
  QMimeData files;
  files.setUrls({QUrl::fromLocalFile(QString::fromStdString(path("other.step").string()))});
  QDragEnterEvent enter({300, 300}, Qt::CopyAction, &files, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window(), &enter);
  QDropEvent drop({300, 300}, Qt::CopyAction, &files, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window(), &drop);
  EXPECT_TRUE(QTest::qWaitFor([&] { return asked > 0 || bench().document().title() == "other"; }, kPatience));
  EXPECT_EQ(asked, 1) << "opened without a question";
  EXPECT_EQ(bench().design().cut().sections.stations, 33);
  ASSERT_TRUE(settle());
}

TEST_F(SavedWork, NamesACopyThatCannotBeRead) {
  fs::create_directories(recovery());
  ASSERT_TRUE(writeFile(recovery() / "6b4c7a0e-0d7c-4a0e-8f0e-1f2a3b4c5d6e.bladewright", "{ half a desi"));
  makeKeepingWindow();
  window().recover();
  ASSERT_EQ(window().recoveryList().copies().size(), 1u);
  EXPECT_FALSE(window().recoveryList().copies()[0].problem.isEmpty());
  QString words;
  for (QLabel* label : window().recoveryList().findChildren<QLabel*>()) words += label->text() + "\n";
  EXPECT_TRUE(words.contains("6b4c7a0e-0d7c-4a0e-8f0e-1f2a3b4c5d6e")) << words.toStdString();
  picture("unsaved-unreadable");
  window().openExample("saddle");
  window().commands()["file.close"]->trigger();
  EXPECT_EQ(window().recoveryList().copies().size(), 1u) << "it was not kept";
}

TEST_F(SavedWork, IsReachedByKeysPastACopyThatCannotBeRead) {
  fs::create_directories(recovery());
  makeKeepingWindow();
  openPanel();
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
  crash();
  const fs::path damaged = recovery() / "6b4c7a0e-0d7c-4a0e-8f0e-1f2a3b4c5d6e.bladewright";
  ASSERT_TRUE(writeFile(damaged, "{ half a desi"));
  fs::last_write_time(damaged, fs::file_time_type::clock::now() + std::chrono::hours(1));
  makeKeepingWindow();
  window().recover();
  picture("unsaved-keys");
  RecoveryList& list = window().recoveryList();
  ASSERT_EQ(list.copies().size(), 2u);
  ASSERT_FALSE(list.copies()[0].problem.isEmpty()) << "the damaged one stands first";
  auto* open = button(list, "Go on with " + list.copies()[1].name);
  ASSERT_TRUE(open);
  auto* discard = button(list, "Discard " + list.copies()[1].name);
  ASSERT_TRUE(discard);
  const auto press = [](Qt::Key key) { QTest::keyClick(QApplication::focusWidget(), key); };
  discard->setFocus();
  press(Qt::Key_Left);
  ASSERT_TRUE(open->hasFocus()) << "the keys of the page lead through it";
  press(Qt::Key_Up);
  EXPECT_FALSE(open->hasFocus()) << "stuck below a button that is switched off";
  EXPECT_TRUE(QApplication::focusWidget()->isEnabled());
  open->setFocus();
  press(Qt::Key_Return);
  EXPECT_FALSE(window().onStartPage()) << "Enter does nothing";
  EXPECT_EQ(bench().design().process.tolerance, 0.75);
  ASSERT_TRUE(settle());
}

TEST_F(SavedWork, AsksBeforeItReplacesWhatAnotherWrote) {
  openPanel();
  const fs::path file = path("panel.bladewright"), other = path("mine.bladewright");
  window().questions().saveDesign = [&](const QString&) { return QString::fromStdString(file.string()); };
  ASSERT_TRUE(window().save());
  Design theirs = *loadDesign(file);
  theirs.cut().sections.stations = 77;
  ASSERT_TRUE(saveDesign(theirs, file));
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
  using Changed = Questions::Changed;
  Changed reply = Changed::cancel;
  int asked = 0;
  window().questions().changedOnDisk = [&](const QString&) {
    ++asked;
    return reply;
  };
  QTest::keyClick(&window(), Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(loadDesign(file)->cut().sections.stations, 77);
  EXPECT_TRUE(window().isWindowModified());
  reply = Changed::otherName;
  window().questions().saveDesign = [&](const QString&) { return QString::fromStdString(other.string()); };
  QTest::keyClick(&window(), Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(loadDesign(file)->cut().sections.stations, 77);
  EXPECT_EQ(loadDesign(other)->process.tolerance, 0.75);
  EXPECT_EQ(asked, 2);
  // Its own writing is no reason to ask.
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.6; });
  QTest::keyClick(&window(), Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(loadDesign(other)->process.tolerance, 0.6);
  ASSERT_TRUE(saveDesign(theirs, other));
  reply = Changed::replace;
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.4; });
  QTest::keyClick(&window(), Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(asked, 3);
  EXPECT_EQ(loadDesign(other)->process.tolerance, 0.4);
}

TEST_F(SavedWork, AsksInWordsAndButtons) {
  openPanel();
  const QString file = QString::fromStdString(path("panel.bladewright").string());
  ASSERT_TRUE(writeFile(file.toStdString(), "{}"));
  auto changed = Questions::Changed::replace;
  answer([&] { changed = window().questions().changedOnDisk(file); }, "changed-on-disk",
         [](QDialog& dialog) { dialog.reject(); });
  EXPECT_EQ(changed, Questions::Changed::cancel);
  auto earlier = Workbench::Earlier::replace;
  answer(
      [&] {
        earlier = window().questions().earlierExport("/x/out", {"report.json", "mesh.obj"}, "/x/out 2");
      },
      "earlier-export",
      [](QDialog& dialog) {
        auto* box = qobject_cast<QMessageBox*>(&dialog);
        ASSERT_TRUE(box);
        QTest::mouseClick(box->defaultButton(), Qt::LeftButton);
      });
  EXPECT_EQ(earlier, Workbench::Earlier::newFolder);
  bool replace = true;
  answer([&] { replace = window().questions().replaceFile(file); }, "replace-file",
         [](QDialog& dialog) { QTest::keyClick(&dialog, Qt::Key_Escape); });
  EXPECT_FALSE(replace);
  bool discard = true;
  answer([&] { discard = window().questions().discardCopy("panel"); }, "discard-copy",
         [](QDialog& dialog) { QTest::keyClick(&dialog, Qt::Key_Return); });
  EXPECT_FALSE(discard) << "Enter discards";
}

TEST_F(SavedWork, GetsItsSuffixWhateverPointsTheNameHas) {
  openPanel();
  const auto typed = [&](const QString& name) {
    QString file;
    answer([&] { file = window().questions().saveDesign("panel.bladewright"); }, "save-design",
           [&](QDialog& dialog) {
             auto* line = dialog.findChild<QLineEdit*>("fileNameEdit");
             ASSERT_TRUE(line);
             line->setText(QString::fromStdString(path(name.toStdString()).string()));
             QTest::keyClick(line, Qt::Key_Return);
           });
    return QFileInfo(file).fileName();
  };
  EXPECT_EQ(typed("panel v1.2"), "panel v1.2.bladewright");
  EXPECT_EQ(typed("panel"), "panel.bladewright");
  EXPECT_EQ(typed("panel.bladewright"), "panel.bladewright");
}

TEST_F(SavedWork, KeepsEarlierExports) {
  openPanel();
  const fs::path folder = path("out");
  window().questions().exportFolder = [&] { return QString::fromStdString(folder.string()); };
  window().exportEverything();
  ASSERT_TRUE(settle());
  const Result<std::string> before = readFile(folder / "report.json");
  ASSERT_TRUE(before);
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
  ASSERT_TRUE(settle());
  using Earlier = Workbench::Earlier;
  Earlier reply = Earlier::cancel;
  std::size_t files = 0;
  window().questions().earlierExport = [&](const fs::path&, const std::vector<fs::path>& earlier,
                                           const fs::path&) {
    files = earlier.size();
    return reply;
  };
  window().exportEverything();
  ASSERT_TRUE(settle());
  EXPECT_GT(files, 5u);
  EXPECT_EQ(readFile(folder / "report.json").value(), *before);
  EXPECT_FALSE(bench().exporting());
  reply = Earlier::newFolder;
  window().exportEverything();
  ASSERT_TRUE(settle());
  EXPECT_EQ(readFile(folder / "report.json").value(), *before);
  EXPECT_TRUE(fs::is_regular_file(path("out 2") / "report.json"));
  EXPECT_EQ(bench().exportFolder(), path("out 2"));
  reply = Earlier::replace;
  window().exportEverything();
  ASSERT_TRUE(settle());
  EXPECT_NE(readFile(folder / "report.json").value(), *before);
  EXPECT_FALSE(fs::exists(path("out 3")));
}

TEST_F(SavedWork, NoticesStayUntilTheyAreAnswered) {
  openPanel();
  window().questions().saveDesign = [](const QString&) {
    return QString("/proc/no-place-here/a.bladewright");
  };
  EXPECT_FALSE(window().saveAs());
  const QString failed = window().banner().text();
  EXPECT_TRUE(failed.contains("/proc/no-place-here")) << failed.toStdString();
  for (int stations : {12, 14}) {
    bench().editDesign("Change stations", [&](Design& design) { design.cut().sections.stations = stations; });
    ASSERT_TRUE(settle());
    EXPECT_EQ(window().banner().text(), failed);
    EXPECT_TRUE(window().banner().isVisible());
  }
  // What the evaluation tells stands before it, and goes with the next evaluation.
  bench().editDesign("Change blade length", [](Design& design) { design.blade.length = 500; });
  ASSERT_TRUE(settle());
  EXPECT_NE(window().banner().text(), failed);
  picture("two-notices");
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  EXPECT_EQ(window().banner().text(), failed);
  // A save that fails takes nothing from the history either.
  EXPECT_FALSE(window().saveAs());
  EXPECT_TRUE(bench().document().undoStack().canRedo());
  EXPECT_NE(bench().design().name, "a");
  // A new page does not take them either.
  window().showMeasurePage();
  EXPECT_FALSE(window().banner().isVisible());
  window().measurePage().left();
  EXPECT_TRUE(window().banner().isVisible());
  QTest::mouseClick(window().banner().cross(), Qt::LeftButton);
  EXPECT_FALSE(window().banner().isVisible());
  // A save that works takes back that one failed.
  EXPECT_FALSE(window().saveAs());
  const QString file = QString::fromStdString(path("a.bladewright").string());
  window().questions().saveDesign = [file](const QString&) { return file; };
  EXPECT_NE(bench().design().name, "a");
  EXPECT_TRUE(window().saveAs());
  EXPECT_FALSE(window().banner().isVisible());
  // Drawings and reports call it as its file is called, until it is given another name.
  EXPECT_EQ(bench().design().name, "a");
  EXPECT_EQ(loadDesign(path("a.bladewright"))->name, "a");
  EXPECT_FALSE(window().isWindowModified());
  bench().editDesign("Name", [](Design& design) { design.name = "Roof, north"; });
  window().questions().saveDesign = [&](const QString&) {
    return QString::fromStdString(path("b.bladewright").string());
  };
  EXPECT_TRUE(window().saveAs());
  EXPECT_EQ(bench().design().name, "Roof, north");
}

TEST_F(SavedWork, SurvivesAFullDiskAndALimitOnTheSizeOfFiles) {
  makeKeepingWindow();
  openPanel();
  const fs::path file = path("panel.bladewright");
  window().questions().saveDesign = [&](const QString&) { return QString::fromStdString(file.string()); };
  ASSERT_TRUE(window().save());
  const std::string before = readFile(file).value();
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
  bench().document().autosaveNow(true);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);  // as the program does
  const rlimit small{4096, limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const bool saved = window().save();
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_FALSE(saved);
  EXPECT_TRUE(window().banner().text().contains("no larger file")) << window().banner().text().toStdString();
  EXPECT_TRUE(window().isWindowModified());
  EXPECT_EQ(readFile(file).value(), before);
  EXPECT_FALSE(fs::is_empty(recovery())) << "the copy went with a save that failed";
  // The device that is always full.
  window().questions().saveDesign = [](const QString&) { return QString("/dev/full"); };
  EXPECT_FALSE(window().saveAs());
  EXPECT_TRUE(window().banner().text().contains("free some space")) << window().banner().text().toStdString();
  EXPECT_EQ(bench().document().file(), file);
  EXPECT_TRUE(window().save());
  EXPECT_EQ(loadDesign(file)->process.tolerance, 0.75);
  EXPECT_FALSE(window().banner().isVisible());
}

TEST_F(SavedWork, TellsWhatWasWrittenUntilItIsRead) {
  openPanel();
  window().questions().exportFolder = [&] { return QString::fromStdString(path("out").string()); };
  window().exportEverything();
  ASSERT_TRUE(settle());
  const QString written = window().banner().text();
  EXPECT_TRUE(written.contains(QString::fromStdString(path("out").string())));
  bench().editDesign("Change stations", [](Design& design) { design.cut().sections.stations = 14; });
  ASSERT_TRUE(settle());
  EXPECT_EQ(window().banner().text(), written);
}

}  // namespace
}  // namespace bw::app
