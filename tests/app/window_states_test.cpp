// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window_fixture.h"

namespace bw::app {
namespace {

TEST_F(WindowTest, TellsWhenTheFolderCannotBeWritten) {
  openPanel();
  window().questions().exportFolder = [] { return QString("/proc/no-place-here"); };
  window().exportEverything();
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().stepStates()[int(model::Step::output)].kind, model::StepState::Kind::error);
  EXPECT_TRUE(window().banner().text().contains("/proc/no-place-here"))
      << window().banner().text().toStdString();
}

TEST_F(WindowTest, AsksBeforeChangesAreLost) {
  openPanel();
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
  int asked = 0;
  window().questions().unsaved = [&](const QString&) {
    ++asked;
    return Questions::Unsaved::cancel;
  };
  EXPECT_FALSE(window().close());
  window().openExample("saddle");
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(bench().design().process.tolerance, 0.75);
  bench().document().undoStack().undo();
  EXPECT_TRUE(window().close());
  EXPECT_EQ(asked, 2);
}

TEST_F(WindowTest, TellsWhyABadFileDoesNotOpen) {
  const fs::path file = path("garbage.step");
  std::ofstream(file) << "ISO-10303-21; and then nothing";
  window().openFile(QString::fromStdString(file.string()));
  ASSERT_TRUE(settle());
  EXPECT_TRUE(window().banner().isVisible());
  EXPECT_FALSE(window().banner().text().isEmpty());
  EXPECT_EQ(bench().stepStates()[int(model::Step::input)].kind, model::StepState::Kind::error);
  EXPECT_EQ(window().messageList().count(), 1);
  EXPECT_FALSE(window().commands()["file.export"]->isEnabled());
  picture("bad-file");
  window().openFile(QString::fromStdString(path("missing.step").string()));
  EXPECT_TRUE(window().banner().text().contains("missing.step"));
}

TEST_F(WindowTest, StopsTheComputationAndOffersToGoOn) {
  openPanel();
  bench().editDesign("Change stations", [](Design& design) { design.cut().sections.stations = 4000; });
  EXPECT_TRUE(bench().stale());
  QTest::keyClick(&window(), Qt::Key_Escape);
  ASSERT_TRUE(settle());
  EXPECT_EQ(stationCount(), 20u) << "the earlier result vanished";
  EXPECT_TRUE(bench().stale());
  EXPECT_EQ(bench().stepStates()[int(model::Step::process)].kind, model::StepState::Kind::stale);
  EXPECT_EQ(window().banner().action()->text(), "Compute");
  ASSERT_TRUE(QTest::qWaitFor([&] { return window().sceneView().sceneStyle().stale; }, kPatience));
  picture("stale");
}

TEST_F(WindowTest, OffersALongerBladeWhenItIsTooShort) {
  openPanel();
  bench().editDesign("Change blade length", [](Design& design) { design.blade.length = 500; });
  ASSERT_TRUE(settle());
  ASSERT_TRUE(window().banner().isVisible());
  picture("short-blade");
  ASSERT_TRUE(window().banner().action()->isVisible()) << window().banner().text().toStdString();
  QTest::mouseClick(window().banner().action(), Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  EXPECT_GT(bench().design().blade.length, 600);
}

TEST_F(WindowTest, FindsCommandsByTyping) {
  openPanel();
  QTest::keyClick(&window(), Qt::Key_K, Qt::ControlModifier);
  auto* palette = window().findChild<CommandPalette*>();
  ASSERT_TRUE(palette->isVisible());
  auto* line = palette->findChild<QLineEdit*>();
  picture("palette-behind");
  palette->grab().save(BW_TEST_OUTPUT "/window/palette.png");
  QTest::keyClicks(line, "dark");
  QTest::keyClick(line, Qt::Key_Return);
  EXPECT_TRUE(theme().dark());
  EXPECT_TRUE(window().sceneView().sceneStyle().dark);
  bench().selectStation(10);
  picture("dark");
  window().commands()["tab.motion"]->trigger();
  bench().setPlayTime(0.4 * bench().playEnd());
  picture("dark-motion");
}

TEST_F(WindowTest, AsksForTheSizeOfAPicture) {
  openPanel();
  QSize size;
  answer(
      [&] {
        size = window().questions().pictureSize({1600, 1000});
      },
      "picture-size",
      [](QDialog& dialog) {
        const auto fields = dialog.findChildren<NumberField*>();
        ASSERT_EQ(fields.size(), 2);
        fields[0]->setFocus();
        fields[0]->selectAll();
        QTest::keyClicks(fields[0], "2400");
        QTest::keyClick(fields[0], Qt::Key_Return);  // takes the number, then the dialog's default button
      });
  EXPECT_EQ(size, QSize(2400, 1000));
  answer(
      [&] {
        size = window().questions().pictureSize({1600, 1000});
      },
      "picture-size", [](QDialog& dialog) { QTest::keyClick(&dialog, Qt::Key_Escape); });
  EXPECT_TRUE(size.isEmpty());
}

TEST_F(WindowTest, AsksWithButtonsThatSayWhatTheyDo) {
  openPanel();
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
  using Unsaved = Questions::Unsaved;
  const std::pair<QMessageBox::StandardButton, Unsaved> answers[] = {{QMessageBox::Save, Unsaved::save},
                                                                     {QMessageBox::Discard, Unsaved::discard},
                                                                     {QMessageBox::Cancel, Unsaved::cancel}};
  for (const auto& [button, meaning] : answers) {
    auto got = Unsaved::cancel;
    answer([&] { got = window().questions().unsaved("panel"); }, "unsaved",
           [button = button](QDialog& dialog) {
             auto* box = qobject_cast<QMessageBox*>(&dialog);
             ASSERT_TRUE(box);
             QTest::mouseClick(box->button(button), Qt::LeftButton);
           });
    EXPECT_EQ(got, meaning);
  }
}

TEST_F(WindowTest, ChoosesAFolderAndAFileInDialogs) {
  openPanel();
  QString folder = "nothing yet";
  answer([&] { folder = window().questions().exportFolder(); }, "export-folder",
         [](QDialog& dialog) { dialog.reject(); });
  EXPECT_TRUE(folder.isEmpty());
  answer([&] { folder = window().questions().openSurface(); }, "open-surface",
         [](QDialog& dialog) { dialog.reject(); });
  EXPECT_TRUE(folder.isEmpty());
  answer([&] { window().commands()["help.about"]->trigger(); }, "about",
         [](QDialog& dialog) { dialog.accept(); });
}

TEST_F(WindowTest, ShowsLongNamesAndRecentFiles) {
  const std::string name =
      "a-facade-panel-with-a-very-long-name-from-the-office-server-revision-0017-approved-by-everyone.step";
  fs::create_directories(path("a folder with a long name/and another folder within it"));
  const fs::path file = path("a folder with a long name/and another folder within it") / name;
  ASSERT_TRUE(writeFile(file, geometry::exampleStep("saddle").value()));
  window().openFile(QString::fromStdString(file.string()));
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  EXPECT_TRUE(bench().document().title().startsWith("a-facade-panel"));
  picture("long-name");
  window().commands()["file.close"]->trigger();
  picture("start-recent");
  const auto buttons = window().startPage().findChildren<QToolButton*>();
  const auto recent = std::find_if(buttons.begin(), buttons.end(), [&](QToolButton* b) {
    return b->toolTip().endsWith(QString::fromStdString(name));
  });
  ASSERT_NE(recent, buttons.end());
  EXPECT_LE((*recent)->mapTo(&window(), QPoint((*recent)->width(), 0)).x(), window().width());
  QTest::mouseClick(*recent, Qt::LeftButton);
  EXPECT_FALSE(window().onStartPage());
  ASSERT_TRUE(settle());
}

TEST_F(WindowTest, ShowsWhatRunsAndStopsItByButton) {
  openPanel();
  bench().editDesign("Change stations", [](Design& design) { design.cut().sections.stations = 3000; });
  QToolButton* stop = nullptr;
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        for (QToolButton* b : window().statusBar()->findChildren<QToolButton*>())
          if (b->isVisible()) stop = b;
        return stop != nullptr;
      },
      kPatience));
  EXPECT_EQ(bench().stepStates()[int(model::Step::process)].kind, model::StepState::Kind::running);
  window().grab().save(BW_TEST_OUTPUT "/window/running.png");
  QTest::mouseClick(stop, Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_FALSE(stop->isVisible());
  EXPECT_EQ(stationCount(), 20u);
  window().banner().action()->click();
  EXPECT_TRUE(bench().runner().busy());
  bench().editDesign("Change stations", [](Design& design) { design.cut().sections.stations = 12; });
  ASSERT_TRUE(settle());
  EXPECT_EQ(stationCount(), 12u) << "the newer change did not replace the older run";
}

TEST_F(WindowTest, HasATooltipAndAMenuEntryForEveryCommand) {
  QSet<QAction*> inMenus;
  for (QMenu* menu : window().findChildren<QMenu*>())
    for (QAction* action : menu->actions()) inMenus << action;
  QHash<QKeySequence, QString> keys;
  for (QAction* action : window().commands().all()) {
    EXPECT_FALSE(action->toolTip().isEmpty()) << action->objectName().toStdString();
    EXPECT_TRUE(inMenus.contains(action)) << action->objectName().toStdString();
    for (const QKeySequence& key : action->shortcuts()) {
      EXPECT_FALSE(keys.contains(key))
          << key.toString().toStdString() << " twice: " << action->objectName().toStdString();
      keys[key] = action->objectName();
    }
  }
}

TEST_F(WindowTest, MovesNothingWhenItTellsSomething) {
  openPanel();
  const QRect before(window().sceneView().mapTo(&window(), QPoint()), window().sceneView().size());
  bench().tell({Severity::warning,
                "A notice that is long enough to need a second line where the window is small, and then some "
                "more words",
                "Do it", [] {}});
  QTest::qWait(0);
  EXPECT_TRUE(window().banner().isVisible());
  EXPECT_EQ(QRect(window().sceneView().mapTo(&window(), QPoint()), window().sceneView().size()), before);
  EXPECT_TRUE(QRect(QPoint(), window().size())
                  .contains(QRect(window().banner().mapTo(&window(), QPoint()), window().banner().size())));
}

TEST_F(WindowTest, FitsASmallScreen) {
  makeWindow({1280, 800});
  openPanel();
  bench().selectStation(12);
  EXPECT_LE(window().minimumSizeHint().width(), 1280);
  EXPECT_LE(window().minimumSizeHint().height(), 800);
  EXPECT_EQ(window().size(), QSize(1280, 800));
  picture("small");
}

TEST(Options, RefusesWhatItDoesNotKnow) {
  QString problem;
  EXPECT_FALSE(parseOptions({"--sceenshot", "a.png"}, &problem));
  EXPECT_EQ(problem, "there is no option --sceenshot; did you mean --screenshot?");
  EXPECT_FALSE(parseOptions({"--size", "12"}, &problem));
  EXPECT_FALSE(parseOptions({"--screenshot"}, &problem));
  EXPECT_FALSE(parseOptions({"--time-changes", "many"}, &problem));
  EXPECT_EQ(problem, "--time-changes takes how many changes to time, from 1 to 1000, but got \"many\"");
  EXPECT_FALSE(parseOptions({"a.step", "b.step"}, &problem));
  EXPECT_FALSE(parseOptions({"--example", "panel"}, &problem));
  EXPECT_TRUE(problem.startsWith("there is no example \"panel\"")) << problem.toStdString();
  EXPECT_FALSE(parseOptions({"--example", "saddle", "a.step"}, &problem));
  EXPECT_EQ(parseOptions({"--example", "saddle"}, &problem)->example, "saddle");
  const std::optional<Options> good =
      parseOptions({"a.step", "--size", "1280x800", "--screenshot", "b.png"}, &problem);
  ASSERT_TRUE(good);
  EXPECT_EQ(good->size, QSize(1280, 800));
  EXPECT_EQ(good->file, "a.step");
}

}  // namespace
}  // namespace bw::app
