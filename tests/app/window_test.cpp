// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <QApplication>
#include <QDropEvent>
#include <QMimeData>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <filesystem>
#include <fstream>

#include "bw/core/file_set.h"
#include "bw/geometry/export.h"
#include "main_window.h"
#include "options.h"

namespace bw::app {
namespace {

namespace fs = std::filesystem;

constexpr int kPatience = 30000;  // ms: a bound against hanging, not a timing

/// A window on settings of its own.
class WindowTest : public ::testing::Test {
 protected:
  void SetUp() override {
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path());
    settings_ = std::make_unique<model::Settings>();
    settings_->setTheme(model::ThemeChoice::light);
    theme().apply(model::ThemeChoice::light);
    makeWindow({1440, 900});
  }

  void TearDown() override {
    if (window_) window_->questions().unsaved = [](const QString&) { return Questions::Unsaved::discard; };
  }

  static Theme& theme() {
    static Theme theme;
    return theme;
  }

  void makeWindow(const QSize& size) {
    window_ = std::make_unique<MainWindow>(*settings_, theme(), fs::path());
    window_->resize(size);
    window_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
    // Shortcuts reach the active window only.
    window_->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
  }

  MainWindow& window() { return *window_; }
  Workbench& bench() { return window_->bench(); }
  fs::path path(const std::string& name) const { return fs::path(folder_.path().toStdString()) / name; }

  /// Waits until the result of the newest design stands.
  bool settle() {
    return QTest::qWaitFor([&] { return !bench().runner().busy(); }, kPatience);
  }

  void openPanel(int stations = 20) {
    window().openExample("panel-600x670");
    bench().editJob("Prepare", [stations](Job& job) { job.stations = stations; });
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
    bench().document().undoStack().clear();
  }

  std::size_t stationCount() { return bench().sweep() ? bench().sweep()->sweep.stations.size() : 0; }

  template <class T>
  T* find(const QString& accessibleName) {
    for (T* widget : window_->findChildren<T*>())
      if (widget->accessibleName() == accessibleName && widget->isVisible()) return widget;
    return nullptr;
  }

  /// The window as the user sees it, kept for the eye.
  QImage picture(const std::string& name) {
    EXPECT_TRUE(QTest::qWaitFor([&] { return window_->onStartPage() || window_->sceneView().resting(); }, kPatience));
    QTest::qWait(0);
    const QImage image = window_->grab().toImage();
    fs::create_directories(BW_TEST_OUTPUT "/window");
    const char* scale = qEnvironmentVariableIsSet("QT_SCALE_FACTOR") ? "-200" : "";
    image.save(QString::fromStdString(BW_TEST_OUTPUT "/window/" + name + scale + ".png"));
    return image;
  }

  QTemporaryDir folder_;
  std::unique_ptr<model::Settings> settings_;
  std::unique_ptr<MainWindow> window_;
};

TEST_F(WindowTest, OpensAnExampleWithOneClick) {
  ASSERT_TRUE(window().onStartPage());
  picture("start");
  QTest::mouseClick(window().startPage().cards().front(), Qt::LeftButton);
  EXPECT_FALSE(window().onStartPage());
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_GT(stationCount(), 1u);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window().pictureDelay() > 0; }, kPatience));
  picture("deviation");
}

TEST_F(WindowTest, ChangesTheStationsByTyping) {
  openPanel();
  auto* number = find<NumberField>("Number");
  ASSERT_TRUE(number);
  number->setFocus();
  number->selectAll();
  QTest::keyClicks(number, "33");
  QTest::keyClick(number, Qt::Key_Return);
  EXPECT_EQ(bench().job().stations, 33);
  EXPECT_EQ(window().commands()["edit.undo"]->text(), "&Undo change stations");
  ASSERT_TRUE(settle());
  EXPECT_EQ(stationCount(), 33u);
}

TEST_F(WindowTest, FollowsTheStationSliderAndUndoesItAsOneStep) {
  openPanel();
  auto* slider = find<HandSlider>("Number of stations");
  ASSERT_TRUE(slider);
  window().workflow().ensureWidgetVisible(slider);
  const QPoint from(int(slider->width() * 0.4), slider->height() / 2);
  QTest::mousePress(slider, Qt::LeftButton, {}, from);
  for (int i = 1; i <= 8; ++i) QTest::mouseMove(slider, from + QPoint(4 * i, 0));
  QTest::mouseRelease(slider, Qt::LeftButton, {}, from + QPoint(32, 0));
  const int after = bench().job().stations;
  EXPECT_NE(after, 20);
  ASSERT_TRUE(settle());
  EXPECT_EQ(stationCount(), std::size_t(after));
  EXPECT_EQ(bench().document().undoStack().count(), 1);
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(bench().job().stations, 20);
  ASSERT_TRUE(settle());
  EXPECT_EQ(stationCount(), 20u);
}

TEST_F(WindowTest, SelectsStationsInTheSectionView) {
  openPanel();
  SectionView& section = window().sectionView();
  QTest::mouseClick(&section, Qt::LeftButton, {}, section.barRect(7).center().toPoint());
  EXPECT_EQ(bench().selection().kind, Selection::Kind::station);
  EXPECT_EQ(bench().selection().station, 7);
  EXPECT_EQ(window().sceneView().sceneStyle().selectedStation, 7);
  section.setFocus();
  QTest::keyClick(&section, Qt::Key_Right);
  QTest::keyClick(&section, Qt::Key_Right);
  EXPECT_EQ(bench().selection().station, 9);
  QTest::keyClick(&section, Qt::Key_Left);
  EXPECT_EQ(bench().selection().station, 8);
  QTest::keyClick(&section, Qt::Key_End);
  QTest::keyClick(&section, Qt::Key_Right);
  EXPECT_EQ(bench().selection().station, 19);
  bench().selectStation(8);
  picture("station");
  section.setExaggeration(20);
  picture("station-20");
}

TEST_F(WindowTest, ScrubsTheTimeline) {
  openPanel();
  window().commands()["tab.motion"]->trigger();
  Timeline& timeline = window().motionView().timeline();
  const QPoint from(int(timeline.xOf(0.2 * bench().playEnd())), 40), to(int(timeline.xOf(0.5 * bench().playEnd())), 40);
  QTest::mousePress(&timeline, Qt::LeftButton, {}, from);
  QTest::mouseMove(&timeline, to);
  QTest::mouseRelease(&timeline, Qt::LeftButton, {}, to);
  EXPECT_NEAR(bench().playTime(), timeline.timeAt(to.x()), 1e-9);
  const double playhead = window().sceneView().sceneStyle().playhead;
  EXPECT_GT(playhead, 0.35 * double(stationCount()));
  EXPECT_LT(playhead, 0.65 * double(stationCount()));
  picture("motion");
  timeline.setFocus();
  const double before = bench().playTime();
  QTest::keyClick(&timeline, Qt::Key_Right);
  EXPECT_GT(bench().playTime(), before);
}

TEST_F(WindowTest, PlaysTheBladeAndPauses) {
  openPanel();
  QTest::keyClick(&window(), Qt::Key_Space);
  EXPECT_TRUE(window().motionView().playing());
  ASSERT_TRUE(QTest::qWaitFor([&] { return bench().playTime() > 0; }, kPatience));
  QTest::keyClick(&window(), Qt::Key_Space);
  EXPECT_FALSE(window().motionView().playing());
}

TEST_F(WindowTest, ExportsEverythingToAFolder) {
  openPanel();
  const QString folder = QString::fromStdString(path("out").string());
  window().questions().exportFolder = [folder] { return folder; };
  QTest::keyClick(&window(), Qt::Key_E, Qt::ControlModifier);
  ASSERT_TRUE(settle());
  for (const char* file : {"report.json", "sweep.json", "surface.step", "mesh.obj", "stations.csv", "deviation.csv"})
    EXPECT_TRUE(fs::is_regular_file(path("out") / file)) << file;
  EXPECT_TRUE(fs::is_directory(path("out") / "programs"));
  EXPECT_EQ(bench().stepStates()[int(model::Step::output)].kind, model::StepState::Kind::done);
  EXPECT_TRUE(window().banner().isVisible());
  picture("exported");
}

TEST_F(WindowTest, TellsWhenTheFolderCannotBeWritten) {
  openPanel();
  window().questions().exportFolder = [] { return QString("/proc/no-place-here"); };
  window().exportEverything();
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().stepStates()[int(model::Step::output)].kind, model::StepState::Kind::error);
  EXPECT_TRUE(window().banner().text().contains("/proc/no-place-here")) << window().banner().text().toStdString();
}

TEST_F(WindowTest, SavesAndOpensAgain) {
  openPanel();
  bench().editJob("Change tolerance", [](Job& job) { job.tolerance = 0.75; });
  EXPECT_TRUE(window().isWindowModified());
  const QString file = QString::fromStdString(path("panel.bladewright").string());
  window().questions().saveDesign = [file](const QString&) { return file; };
  QTest::keyClick(&window(), Qt::Key_S, Qt::ControlModifier);
  EXPECT_FALSE(window().isWindowModified());
  ASSERT_TRUE(fs::is_regular_file(file.toStdString()));
  window().commands()["file.close"]->trigger();
  EXPECT_TRUE(window().onStartPage());
  window().openFile(file);
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().job().tolerance, 0.75);
  EXPECT_EQ(stationCount(), 20u);
  EXPECT_EQ(settings_->recentFiles().front(), fs::path(file.toStdString()));
}

TEST_F(WindowTest, AsksBeforeChangesAreLost) {
  openPanel();
  bench().editJob("Change tolerance", [](Job& job) { job.tolerance = 0.75; });
  int asked = 0;
  window().questions().unsaved = [&](const QString&) {
    ++asked;
    return Questions::Unsaved::cancel;
  };
  EXPECT_FALSE(window().close());
  window().openExample("saddle");
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(bench().job().tolerance, 0.75);
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

TEST_F(WindowTest, OpensADroppedFile) {
  const fs::path file = path("saddle.step");
  ASSERT_TRUE(writeFile(file, geometry::exampleStep("saddle").value()));
  QMimeData mime;
  mime.setUrls({QUrl::fromLocalFile(QString::fromStdString(file.string()))});
  QDragEnterEvent enter(QPoint(200, 200), Qt::CopyAction, &mime, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window(), &enter);
  EXPECT_TRUE(enter.isAccepted());
  QDropEvent drop(QPointF(200, 200), Qt::CopyAction, &mime, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window(), &drop);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !bench().document().empty(); }, kPatience));
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().document().design()->name, "saddle");
}

TEST_F(WindowTest, StopsTheComputationAndOffersToGoOn) {
  openPanel();
  bench().editJob("Change stations", [](Job& job) { job.stations = 4000; });
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
  bench().editJob("Change blade length", [](Job& job) { job.blade.length = 500; });
  ASSERT_TRUE(settle());
  ASSERT_TRUE(window().banner().isVisible());
  picture("short-blade");
  ASSERT_TRUE(window().banner().action()->isVisible()) << window().banner().text().toStdString();
  QTest::mouseClick(window().banner().action(), Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  EXPECT_GT(bench().job().blade.length, 600);
}

TEST_F(WindowTest, SelectsThePlaceOfAMessage) {
  openPanel();
  bench().editJob("Change tolerance", [](Job& job) { job.tolerance = 0.001; });
  ASSERT_TRUE(settle());
  MessageList& list = window().messageList();
  window().commands()["tab.messages"]->trigger();
  ASSERT_GT(list.count(), 0);
  int clicked = -1;
  for (int i = 0; i < list.count() && clicked < 0; ++i) {
    QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, list.visualItemRect(list.item(i)).center());
    if (bench().selection().kind == Selection::Kind::station) clicked = i;
  }
  EXPECT_GE(clicked, 0) << "no message leads to a station";
  picture("messages");
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

TEST_F(WindowTest, ChoosesMapsByKeyAndByChoice) {
  openPanel();
  for (const std::string& name : MapBar::fieldNames()) {
    window().commands()[QString::fromStdString("map." + name)]->trigger();
    EXPECT_EQ(window().sceneView().sceneStyle().field, name);
    picture("map-" + name);
  }
  QTest::keyClick(&window(), Qt::Key_1, Qt::AltModifier);
  EXPECT_EQ(window().sceneView().sceneStyle().field, "deviation");
  QTest::keyClick(&window(), Qt::Key_I);
  EXPECT_TRUE(window().sceneView().sceneStyle().isolines);
  picture("isolines");
}

TEST_F(WindowTest, KeepsALegendRangeThatWasTyped) {
  openPanel();
  auto* upper = find<NumberField>("Upper end of the legend");
  ASSERT_TRUE(upper);
  upper->setFocus();
  upper->selectAll();
  QTest::keyClicks(upper, "5");
  QTest::keyClick(upper, Qt::Key_Return);
  ASSERT_TRUE(window().sceneView().sceneStyle().rangeMax);
  EXPECT_EQ(*window().sceneView().sceneStyle().rangeMax, 5);
  bench().setPlayTime(0.5 * bench().playEnd());
  EXPECT_EQ(*window().sceneView().sceneStyle().rangeMax, 5);
}

TEST_F(WindowTest, WritesAPictureOfTheSizeAskedFor) {
  openPanel();
  const QString file = QString::fromStdString(path("view.png").string());
  window().questions().pictureSize = [](const QSize&) { return QSize(900, 500); };
  window().questions().savePicture = [file](const QString&) { return file; };
  window().exportPicture();
  EXPECT_EQ(QImage(file).size(), QSize(900, 500));
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
      EXPECT_FALSE(keys.contains(key)) << key.toString().toStdString() << " twice: " << action->objectName().toStdString();
      keys[key] = action->objectName();
    }
  }
}

TEST_F(WindowTest, CutsTheSceneOpenAtTheSelectedStation) {
  openPanel();
  EXPECT_FALSE(window().sceneView().sceneStyle().section);
  bench().selectStation(6);
  QTest::keyClick(&window(), Qt::Key_X);
  const auto section = window().sceneView().sceneStyle().section;
  ASSERT_TRUE(section);
  const Frame& frame = bench().sweep()->sweep.stations[6].frame;
  EXPECT_NEAR((section->point - frame.origin).norm(), 0, 1e-9);
  EXPECT_NEAR(std::abs(section->normal.dot(frame.normal)), 1, 1e-12);
  EXPECT_GT((window().sceneView().camera().position - section->point).dot(section->normal), 0) << "the half behind the cut was taken away";
  window().commands()["map.none"]->trigger();
  picture("section");
  bench().selectStation(12);
  EXPECT_NEAR((window().sceneView().sceneStyle().section->point - bench().sweep()->sweep.stations[12].frame.origin).norm(), 0, 1e-9);
  QTest::keyClick(&window(), Qt::Key_X, Qt::ShiftModifier);
  EXPECT_LT(window().sceneView().sceneStyle().section->normal.dot(section->normal), 0);
  QTest::keyClick(&window(), Qt::Key_X);
  EXPECT_FALSE(window().sceneView().sceneStyle().section);
}

TEST_F(WindowTest, MovesNothingWhenItTellsSomething) {
  openPanel();
  const QRect before(window().sceneView().mapTo(&window(), QPoint()), window().sceneView().size());
  bench().tell({Severity::warning, "A notice that is long enough to need a second line where the window is small, and then some more words", "Do it", [] {}});
  QTest::qWait(0);
  EXPECT_TRUE(window().banner().isVisible());
  EXPECT_EQ(QRect(window().sceneView().mapTo(&window(), QPoint()), window().sceneView().size()), before);
  EXPECT_TRUE(QRect(QPoint(), window().size()).contains(QRect(window().banner().mapTo(&window(), QPoint()), window().banner().size())));
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
  EXPECT_FALSE(parseOptions({"a.step", "b.step"}, &problem));
  const std::optional<Options> good = parseOptions({"a.step", "--size", "1280x800", "--screenshot", "b.png"}, &problem);
  ASSERT_TRUE(good);
  EXPECT_EQ(good->size, QSize(1280, 800));
  EXPECT_EQ(good->file, "a.step");
}

}  // namespace
}  // namespace bw::app

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  QSurfaceFormat::setDefaultFormat(bw::view::SceneView::surfaceFormat());
  QApplication application(argc, argv);
  QApplication::setApplicationVersion(BW_VERSION);
  return RUN_ALL_TESTS();
}
