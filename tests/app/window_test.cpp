// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <QMenu>
#include <QTextLayout>

#include "window_fixture.h"

namespace bw::app {
namespace {

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
  EXPECT_EQ(bench().design().cut().sections.stations, 33);
  EXPECT_EQ(window().commands()["edit.undo"]->text(), "&Undo change stations");
  ASSERT_TRUE(settle());
  EXPECT_EQ(stationCount(), 33u);
}

class SliderTest : public WindowTest {
 protected:
  /// Grabs a slider and pulls it to the right; the place where it is held then.
  QPoint dragged(HandSlider& slider) {
    window().workflow().ensureWidgetVisible(&slider);
    const QPoint from(int(slider.width() * 0.4), slider.height() / 2);
    QTest::mousePress(&slider, Qt::LeftButton, {}, from);
    for (int i = 1; i <= 8; ++i) QTest::mouseMove(&slider, from + QPoint(4 * i, 0));
    return from + QPoint(32, 0);
  }
};

TEST_F(SliderTest, FollowsTheStationSliderAndUndoesItAsOneStep) {
  openPanel();
  auto* slider = find<HandSlider>("Number of stations");
  ASSERT_TRUE(slider);
  const QPoint at = dragged(*slider);
  QTest::mouseRelease(slider, Qt::LeftButton, {}, at);
  const int after = bench().design().cut().sections.stations.value();
  EXPECT_NE(after, 20);
  ASSERT_TRUE(settle());
  EXPECT_EQ(stationCount(), std::size_t(after));
  EXPECT_EQ(bench().document().undoStack().count(), 1);
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(bench().design().cut().sections.stations, 20);
  ASSERT_TRUE(settle());
  EXPECT_EQ(stationCount(), 20u);
}

TEST_F(SliderTest, EscapeGivesTheDragOfTheStationSliderUp) {
  openPanel();
  auto* slider = find<HandSlider>("Number of stations");
  ASSERT_TRUE(slider);
  const QPoint at = dragged(*slider);
  EXPECT_NE(bench().design().cut().sections.stations, 20);
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
  QTest::mouseRelease(slider, Qt::LeftButton, {}, at);
  EXPECT_EQ(bench().design().cut().sections.stations, 20);
  EXPECT_FALSE(bench().document().undoStack().canUndo());
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  EXPECT_EQ(stationCount(), 20u);
}

TEST_F(WindowTest, EscapeGivesTheDragOfAnOpacityUp) {
  openPanel();
  HandSlider* slider = nullptr;
  for (HandSlider* each : window().findChildren<HandSlider*>())
    if (each->accessibleName() == "Opacity of Cut surface") slider = each;
  ASSERT_TRUE(slider);
  auto* menu = qobject_cast<QMenu*>(slider->window());
  ASSERT_TRUE(menu);
  menu->popup(window().mapToGlobal(QPoint(400, 100)));
  ASSERT_TRUE(QTest::qWaitFor([&] { return slider->isVisible(); }, kPatience));
  const auto opacity = [this] { return window().sceneView().sceneStyle()[scene::Kind::cut].opacity; };
  const double before = opacity();
  const int stood = slider->value();
  const QPoint from(slider->width() / 2, slider->height() / 2);
  QTest::mousePress(slider, Qt::LeftButton, {}, from);
  QTest::mouseMove(slider, from - QPoint(30, 0));
  EXPECT_NE(opacity(), before);
  QTest::keyClick(slider, Qt::Key_Escape);
  EXPECT_EQ(opacity(), before);
  EXPECT_EQ(slider->value(), stood);
  EXPECT_TRUE(menu->isVisible());
  QTest::mouseRelease(slider, Qt::LeftButton, {}, from - QPoint(30, 0));
  menu->close();
}

TEST_F(WindowTest, BeginsWithinItsScreen) {
  window_ = std::make_unique<MainWindow>(*settings_, theme(), fs::path());
  window().show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window()));
  const QRect room = window().screen()->availableGeometry(), place = window().frameGeometry();
  EXPECT_LE(place.width(), room.width());
  EXPECT_LE(place.height(), room.height());
  // Nor is it smaller than it has to be.
  EXPECT_GE(window().width(), std::min(1440, room.width() - 40));
  EXPECT_GE(window().height(), std::min(900, room.height() - 40));
  picture("begins");
}

TEST_F(WindowTest, CountsStationsByTheTolerance) {
  openPanel();
  auto* mode = find<ChoiceField>("Stations");
  auto* number = find<NumberField>("Number");
  ASSERT_TRUE(mode && number);
  const auto choose = [&](int index) {
    mode->setCurrentIndex(index);
    emit mode->activated(index);
    ASSERT_TRUE(settle());
  };
  EXPECT_EQ(mode->currentIndex(), 1) << "twenty are asked for";
  choose(0);
  EXPECT_TRUE(bench().design().cut().sections.byTolerance());
  const int found = bench().shownCut()->count.value->stations;
  EXPECT_EQ(stationCount(), std::size_t(found));
  EXPECT_EQ(number->value(), found) << "as found";
  EXPECT_FALSE(number->isEnabled());
  EXPECT_FALSE(find<HandSlider>("Number of stations"));
  choose(2);
  EXPECT_GT(bench().design().cut().sections.spacing.value(), 0);
  choose(0);
  choose(1);
  EXPECT_EQ(bench().design().cut().sections.stations, found) << "the number stays as it was found";
  EXPECT_TRUE(number->isEnabled());
}

TEST_F(WindowTest, SelectsStationsInTheSectionView) {
  openPanel();
  SectionView& section = window().sectionView();
  QTest::mouseClick(&section, Qt::LeftButton, {}, section.barRect(7).center().toPoint());
  EXPECT_EQ(bench().selection().kind, Selection::Kind::station);
  EXPECT_EQ(bench().selection().station, 7);
  EXPECT_EQ(window().sceneView().sceneStyle().selected.station, 7);
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
  const QPoint from(int(timeline.xOf(0.2 * bench().playEnd())), 40),
      to(int(timeline.xOf(0.5 * bench().playEnd())), 40);
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
  for (const char* file :
       {"report.json", "sweep.json", "surface.step", "mesh.obj", "stations.csv", "deviation.csv"})
    EXPECT_TRUE(fs::is_regular_file(path("out") / file)) << file;
  EXPECT_TRUE(fs::is_directory(path("out") / "programs"));
  EXPECT_EQ(bench().stepStates()[int(model::Step::output)].kind, model::StepState::Kind::done);
  EXPECT_TRUE(window().banner().isVisible());
  picture("exported");
}

TEST_F(WindowTest, RepeatsWhatTheCheckOfTheProgramsWarnsOf) {
  openPanel();
  // Targets that follow each other faster than a controller takes them.
  bench().editDesign("Change stations", [](Design& design) {
    design.cut().sections.stations = 120;
    design.process.cuttingSpeed = 1000;
  });
  ASSERT_TRUE(settle());
  const std::size_t before = bench().messages().size();
  const QString folder = QString::fromStdString(path("programs").string());
  window().questions().exportFolder = [folder] { return folder; };
  window().commands()["file.programs"]->trigger();
  ASSERT_TRUE(settle());
  EXPECT_TRUE(fs::is_directory(path("programs") / "T_ROB1"));
  EXPECT_TRUE(window().banner().text().contains("The check of the programs warns"))
      << window().banner().text().toStdString();
  EXPECT_GT(bench().messages().size(), before);
  EXPECT_EQ(window().messageList().count(), int(bench().messages().size()));
  picture("exported-warning");
  // They hold for these programs only.
  bench().editDesign("Change cutting speed", [](Design& design) { design.process.cuttingSpeed = 10; });
  ASSERT_TRUE(settle());
  EXPECT_TRUE(std::ranges::none_of(bench().messages(), [](const Message& message) {
    return message.finding && message.finding->kind() == FindingKind::programCheck;
  }));
}

TEST_F(WindowTest, WritesNoRobotProgramOfADesignWithErrors) {
  openPanel();
  // The block is wider than the blade is long.
  bench().editDesign("Change block", [](Design& design) {
    design.cut().direction = Eigen::Vector3d::UnitY();
    design.block().placement = BlockPlacement{{-150, 0, -300}, {900, 670, 600}, Eigen::Vector3d::Zero()};
  });
  ASSERT_TRUE(settle());
  const QString folder = QString::fromStdString(path("out").string());
  window().questions().exportFolder = [folder] { return folder; };
  window().exportEverything();
  ASSERT_TRUE(settle());
  EXPECT_TRUE(fs::is_regular_file(path("out") / "report.json"));
  EXPECT_FALSE(fs::exists(path("out") / "programs/strip-0/T_ROB1"));
  EXPECT_TRUE(window().banner().text().contains("no RAPID program is written", Qt::CaseInsensitive))
      << window().banner().text().toStdString();
  EXPECT_FALSE(window().banner().text().contains("--"));
  picture("export-without-programs");
  // Where programs alone are asked for, motions remain, and without those nothing.
  bench().editDesign("Change programs", [](Design& design) { design.output.programs = {"rapid"}; });
  ASSERT_TRUE(settle());
  const QString alone = QString::fromStdString(path("alone").string());
  window().questions().exportFolder = [alone] { return alone; };
  window().exportPrograms();
  ASSERT_TRUE(settle());
  EXPECT_FALSE(fs::exists(path("alone")));
  EXPECT_EQ(bench().stepStates()[int(model::Step::output)].kind, model::StepState::Kind::error);
  EXPECT_TRUE(window().banner().text().contains("no RAPID program is written", Qt::CaseInsensitive))
      << window().banner().text().toStdString();
}

TEST_F(WindowTest, SavesAndOpensAgain) {
  openPanel();
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
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
  EXPECT_EQ(bench().design().process.tolerance, 0.75);
  EXPECT_EQ(stationCount(), 20u);
  EXPECT_EQ(settings_->recentFiles().front(), fs::path(file.toStdString()));
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

TEST_F(WindowTest, SelectsThePlaceOfAMessage) {
  openPanel();
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.001; });
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

TEST_F(WindowTest, MessagesAreReadWholeInEveryWidth) {
  openPanel();
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.001; });
  ASSERT_TRUE(settle());
  window().commands()["tab.messages"]->trigger();
  MessageList& list = window().messageList();
  ASSERT_GT(list.count(), 1);
  const int margin = list.style()->pixelMetric(QStyle::PM_FocusFrameHMargin, nullptr, &list) + 1;
  for (int width = 1200; width < 1400; width += 13) {
    window().resize(width, 800);
    QTest::qWait(150);  // a list that wraps is laid out a tenth of a second after it
    for (int i = 0; i < list.count(); ++i) {
      const QListWidgetItem& item = *list.item(i);
      QStyleOptionViewItem option;
      option.initFrom(&list);
      option.font = list.font();
      option.fontMetrics = list.fontMetrics();
      option.rect = list.visualItemRect(&item);
      option.features = QStyleOptionViewItem::HasDecoration | QStyleOptionViewItem::HasDisplay |
                        QStyleOptionViewItem::WrapText;
      option.icon = item.icon();
      option.decorationSize = list.iconSize();
      option.text = item.text();
      option.displayAlignment = Qt::AlignLeft | Qt::AlignVCenter;
      const QRect room = list.style()->subElementRect(QStyle::SE_ItemViewItemText, &option, &list);
      QTextLayout text(item.text(), list.font());
      QTextOption wrapped;
      wrapped.setWrapMode(QTextOption::WordWrap);
      text.setTextOption(wrapped);
      text.beginLayout();
      double height = 0;
      for (QTextLine line = text.createLine(); line.isValid(); line = text.createLine()) {
        line.setLineWidth(room.width() - 2 * margin);
        height += line.height();
      }
      text.endLayout();
      EXPECT_LE(height, room.height() + 0.5) << width << ": " << item.text().toStdString();
      EXPECT_LE(option.rect.right(), list.viewport()->width()) << width;
    }
  }
}

TEST_F(WindowTest, DoesWhatAMessageAdvises) {
  openPanel();
  // The tolerance of the stations themselves; then grips too near to the block, of a blade that serves where
  // it is longer.
  const auto choose = [&](double tolerance, const char* blade) {
    bench().editDesign("Change tolerance", [&](Design& design) { design.process.tolerance = tolerance; });
    bench().editDesign("Change clearance", [](Design& design) { design.process.clearance = 120; });
    bench().editDesign("Choose blade", [&](Design& design) {
      design.blade = bladePreset(blade).value_or(design.blade);
      design.process.weight = false;
    });
    ASSERT_TRUE(settleInFull());
  };
  choose(0.5, "nicr-flat-5x1");
  window().commands()["tab.messages"]->trigger();
  MessageList& list = window().messageList();
  std::set<QString> seen;
  const auto buttons = [&] { return list.parentWidget()->findChildren<QPushButton*>(); };
  const auto followAll = [&] {
    for (int round = 0; round < 6; ++round) {
      bool done = true;
      for (int i = 0; i < list.count() && done; ++i) {
        QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, list.visualItemRect(list.item(i)).center());
        // While it is drawn more may be known, and buttons are others.
        picture("remedies");
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        for (QPushButton* button : buttons()) {
          const QString text = button->text();
          if (!button->isVisible() || text.startsWith("Search") || !seen.insert(text).second) continue;
          const Design before = bench().design();
          QTest::mouseClick(button, Qt::LeftButton);
          EXPECT_FALSE(before == bench().design()) << text.toStdString() << " does nothing";
          EXPECT_EQ(bench().document().undoStack().undoText(), text);
          ASSERT_TRUE(settleInFull());
          EXPECT_FALSE(bench().runner().error()) << text.toStdString() << " leads to a refusal";
          done = false;
          break;
        }
      }
      if (done) break;
    }
  };
  followAll();
  EXPECT_FALSE(seen.empty());
  choose(2, "steel-tube-3-2.5");
  followAll();
  const bool longer =
      std::ranges::any_of(seen, [](const QString& text) { return text.startsWith("Use a blade of"); });
  EXPECT_TRUE(longer);
  EXPECT_GE(bench().sweep()->check.stations.front().clearance, 120);
}

TEST_F(WindowTest, ChoosesMapsByKeyAndByChoice) {
  openPanel();
  for (const std::string& name : MapBar::fieldNames()) {
    QAction* command = window().commands()[QString::fromStdString("map." + name)];
    // One cut meets no other.
    EXPECT_EQ(command->isEnabled(), name != "crease") << name;
    if (!command->isEnabled()) continue;
    command->trigger();
    EXPECT_EQ(window().sceneView().sceneStyle()[scene::Kind::cut].map, name);
    picture("map-" + name);
  }
  QTest::keyClick(&window(), Qt::Key_1, Qt::AltModifier);
  EXPECT_EQ(window().sceneView().sceneStyle()[scene::Kind::cut].map, "deviation");
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

TEST_F(WindowTest, UndoesByMenuAndTellsTheName) {
  openPanel();
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
  bench().editDesign("Change clearance", [](Design& design) { design.process.clearance = 60; });
  EXPECT_EQ(window().commands()["edit.undo"]->text(), "&Undo change clearance");
  window().commands()["edit.undo"]->trigger();
  window().commands()["edit.undo"]->trigger();
  EXPECT_EQ(bench().design().process.tolerance, 2);
  EXPECT_FALSE(window().commands()["edit.undo"]->isEnabled());
  EXPECT_EQ(window().commands()["edit.redo"]->text(), "&Redo change tolerance");
  QTest::keyClick(&window(), Qt::Key_Y, Qt::ControlModifier);
  EXPECT_EQ(bench().design().process.tolerance, 0.75);
  ASSERT_TRUE(settle());
}

TEST_F(WindowTest, KeepsTheGeometryInTheFileWhenAsked) {
  const fs::path file = path("saddle.step");
  ASSERT_TRUE(writeFile(file, geometry::exampleStep("saddle").value()));
  window().openFile(QString::fromStdString(file.string()));
  ASSERT_TRUE(settle());
  QCheckBox* keep = nullptr;
  for (QCheckBox* box : window().workflow().findChildren<QCheckBox*>())
    if (box->text().startsWith("Keep the geometry")) keep = box;
  ASSERT_TRUE(keep && keep->isEnabled());
  window().workflow().ensureWidgetVisible(keep);
  QTest::mouseClick(keep, Qt::LeftButton, {}, QPoint(8, keep->height() / 2));
  EXPECT_FALSE(bench().document().design()->source().bytes.empty());
  const QString design = QString::fromStdString(path("saddle.bladewright").string());
  window().questions().saveDesign = [design](const QString&) { return design; };
  ASSERT_TRUE(window().save());
  fs::remove(file);
  window().commands()["file.close"]->trigger();
  window().openFile(design);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << "the design needs the file that is gone";
}

TEST_F(WindowTest, PicksAStationInTheScene) {
  openPanel();
  view::SceneView& view = window().sceneView();
  ASSERT_TRUE(QTest::qWaitFor([&] { return view.resting(); }, kPatience));
  const BladePose& station = bench().sweep()->sweep.poses[9];
  const double middle = 0.5 * station.cut.length();
  const QPointF place = view.toWidget(station.frame.toWorld(station.cut.at(middle).point));
  QTest::mouseMove(&view, place.toPoint());
  QTest::mouseClick(&view, Qt::LeftButton, {}, place.toPoint());
  EXPECT_EQ(bench().selection().kind, Selection::Kind::station);
  EXPECT_EQ(bench().selection().station, 9);
}

TEST_F(WindowTest, FollowsTheMovingBladeWithTheSection) {
  openPanel();
  QTest::keyClick(&window(), Qt::Key_X);
  QTest::keyClick(&window(), Qt::Key_Space);
  ASSERT_TRUE(QTest::qWaitFor([&] { return bench().playTime() > 0.3 * bench().playEnd(); }, kPatience));
  const auto first = window().sceneView().sceneStyle().section;
  window().grab().save(BW_TEST_OUTPUT "/window/playing.png");
  if (window().motionView().playing()) QTest::keyClick(&window(), Qt::Key_Space);
  bench().setPlayTime(0.25 * bench().playEnd());
  EXPECT_NE(window().sceneView().sceneStyle().section, first);
  picture("section-motion");
  window().commands()["theme.dark"]->trigger();
  picture("section-motion-dark");
}

TEST_F(WindowTest, CutsTheSceneOpenAtTheSelectedStation) {
  openPanel();
  EXPECT_FALSE(window().sceneView().sceneStyle().section);
  bench().selectStation(6);
  QTest::keyClick(&window(), Qt::Key_X);
  const auto section = window().sceneView().sceneStyle().section;
  ASSERT_TRUE(section);
  const Frame& frame = bench().sweep()->sweep.poses[6].frame;
  EXPECT_NEAR((section->point - frame.origin).norm(), 0, 1e-9);
  EXPECT_NEAR(std::abs(section->normal.dot(frame.normal)), 1, 1e-12);
  EXPECT_GT((window().sceneView().camera().position - section->point).dot(section->normal), 0)
      << "the half behind the cut was taken away";
  window().commands()["map.none"]->trigger();
  picture("section");
  bench().selectStation(12);
  EXPECT_NEAR(
      (window().sceneView().sceneStyle().section->point - bench().sweep()->sweep.poses[12].frame.origin)
          .norm(),
      0, 1e-9);
  QTest::keyClick(&window(), Qt::Key_X, Qt::ShiftModifier);
  EXPECT_LT(window().sceneView().sceneStyle().section->normal.dot(section->normal), 0);
  QTest::keyClick(&window(), Qt::Key_X);
  EXPECT_FALSE(window().sceneView().sceneStyle().section);
}

}  // namespace
}  // namespace bw::app
