// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <QScrollArea>
#include <QToolButton>
#include <QWheelEvent>

#include "window_fixture.h"
#include "workflow/length_band.h"
#include "workflow/margin_plot.h"
#include "workflow/workflow_panel.h"

namespace bw::app {

namespace {

void turnWheel(QWidget& widget, const QPointF& at, int notches, Qt::KeyboardModifiers keys = Qt::NoModifier) {
  QWheelEvent event(at, widget.mapToGlobal(at), {}, {0, 120 * notches}, Qt::NoButton, keys, Qt::NoScrollPhase,
                    false);
  QApplication::sendEvent(&widget, &event);
}

/// Moves the pointer with no button held, whatever a test before pressed.
void moveTo(QWidget& widget, const QPointF& at) {
  QMouseEvent event(QEvent::MouseMove, at, widget.mapToGlobal(at), Qt::NoButton, Qt::NoButton,
                    Qt::NoModifier);
  QApplication::sendEvent(&widget, &event);
}

}  // namespace

TEST(AxisRange, ZoomKeepsTheValueUnderTheCursorInsideTheWhole) {
  const AxisRange whole{0, 100};
  const AxisRange near = whole.zoomed(20, 0.5, whole);
  EXPECT_DOUBLE_EQ(near.low, 10);
  EXPECT_DOUBLE_EQ(near.high, 60);
  EXPECT_EQ(near.zoomed(20, 2, whole), whole);
  EXPECT_EQ(near.zoomed(20, 1e9, whole), whole) << "never farther than all";
  EXPECT_NEAR(whole.zoomed(50, 1e-9, whole).span(), 0.1, 1e-9) << "never nearer than a thousandth";
  EXPECT_DOUBLE_EQ(near.moved(1e9, whole).high, 100);
  EXPECT_DOUBLE_EQ(near.moved(-1e9, whole).low, 0);
}

TEST(AxisTicks, AreRoundAndLieInTheRange) {
  for (const AxisRange range : {AxisRange{0, 1}, {-3.2, 7.9}, {812.3, 812.9}, {-1e-4, 2e-4}, {0, 2e6}}) {
    const AxisTicks ticks = axisTicks(range, 5);
    ASSERT_GE(ticks.values.size(), 4u);
    ASSERT_LE(ticks.values.size(), 14u);
    for (const double value : ticks.values) {
      EXPECT_GE(value, range.low - 1e-9 * range.span());
      EXPECT_LE(value, range.high + 1e-9 * range.span());
      EXPECT_NEAR(axisText(value, ticks.decimals).replace(QChar(0x2212), '-').toDouble(), value,
                  1e-6 * range.span());
    }
  }
  EXPECT_TRUE(axisTicks({3, 3}, 5).values.empty());
}

TEST_F(WindowTest, SectionZoomsToTheCursorAndTellsWhatLiesThere) {
  openPanel();
  bench().selectStation(7);
  SectionView& section = window().sectionView();
  window().tabs().setCurrentWidget(&section);
  const AxisRange all = section.seenAcross();
  const QPointF at(section.sectionArea().left() + 0.25 * section.sectionArea().width(),
                   section.sectionArea().center().y());
  const double under = all.low + 0.25 * all.span();
  turnWheel(section, at, 5);
  EXPECT_EQ(bench().selection().station, 7) << "the wheel over the section does not change the station";
  const AxisRange near = section.seenAcross();
  EXPECT_LT(near.span(), 0.5 * all.span());
  EXPECT_NEAR(near.low + 0.25 * near.span(), under, 1e-6 * all.span());

  moveTo(section, at);
  ASSERT_EQ(section.readout().size(), 2);
  EXPECT_TRUE(section.readout()[0].endsWith("mm")) << section.readout()[0].toStdString();

  bench().selectStation(8);
  EXPECT_NEAR(section.seenAcross().low, near.low, 1e-9 * all.span())
      << "the zoom stays from station to station";
  EXPECT_NEAR(section.seenAcross().high, near.high, 1e-9 * all.span());
  const QPoint from = section.sectionArea().center().toPoint();
  QTest::mousePress(&section, Qt::LeftButton, {}, from);
  QTest::mouseMove(&section, from + QPoint(40, 0));
  QTest::mouseRelease(&section, Qt::LeftButton, {}, from + QPoint(40, 0));
  EXPECT_NEAR(section.seenAcross().low, near.low - 40 * near.span() / section.sectionArea().width(),
              2 * near.span() / section.sectionArea().width());
  QTest::mouseDClick(&section, Qt::LeftButton, {}, from);
  const AxisRange whole = section.seenAcross();
  EXPECT_NEAR(whole.span(), all.span(), 0.1 * all.span()) << "another station has other bounds";
  turnWheel(section, from, -5);
  EXPECT_EQ(section.seenAcross(), whole) << "no farther than all";

  turnWheel(section, {section.barRect(8).center().x(), 10}, 1);
  EXPECT_EQ(bench().selection().station, 7) << "over the bars it does";
}

TEST_F(WindowTest, SectionTellsTheDeviationAsItIsHoweverLargeItIsDrawn) {
  openPanel();
  bench().selectStation(7);
  SectionView& section = window().sectionView();
  window().tabs().setCurrentWidget(&section);
  const PlanarCurve& target = bench().sweep()->sweep.fits[7].target;
  const ShownPlane plane(bench().sweep()->sweep.poses[7].frame);
  auto* factor = find<ChoiceField>("Deviation drawn");
  ASSERT_TRUE(factor);
  for (const auto& [index, times] : {std::pair(0, 1), std::pair(1, 5), std::pair(2, 20)}) {
    factor->setCurrentIndex(index);
    emit factor->activated(index);
    moveTo(section, {section.sectionArea().center().x(), section.sectionArea().top() + 10});
    ASSERT_EQ(section.readout().size(), 2);
    const QStringList place = section.readout()[0].chopped(3).replace(QChar(0x2212), '-').split(", ");
    const Eigen::Vector2d at = plane.inPlane({place[0].toDouble(), place[1].toDouble()});
    const double drawn = (at - target.value(target.nearestParameter(at))).norm();
    ASSERT_GT(drawn, 1);
    EXPECT_NEAR(section.readout()[1].section(' ', 0, 0).toDouble(), drawn / times, 0.02 * drawn / times);
  }
}

TEST_F(WindowTest, CurvatureZoomsAlongTheBladeAndTellsTheRadius) {
  openPanel();
  const double length = bench().design().blade.length;
  bench().selectStation(3);
  SectionView& section = window().sectionView();
  window().tabs().setCurrentWidget(&section);
  EXPECT_NEAR(section.seenAlong().span(), length, 1e-6);
  turnWheel(section, section.curvatureArea().center(), 3);
  EXPECT_NEAR(section.seenAlong().span(), length * 0.512, 1e-6);
  EXPECT_NEAR(section.seenAlong().low + 0.5 * section.seenAlong().span(), 0.5 * length, 1);
  moveTo(section, section.curvatureArea().center());
  ASSERT_EQ(section.readout().size(), 2);
  EXPECT_TRUE(section.readout()[1].contains("radius")) << section.readout()[1].toStdString();
  section.setFocus();
  QTest::keyClick(&section, Qt::Key_0);
  EXPECT_NEAR(section.seenAlong().span(), length, 1e-6);
}

TEST_F(WindowTest, TimelineZoomsToTheCursorAndKeepsThePlayheadInSight) {
  openPanel();
  Timeline& timeline = window().motionView().timeline();
  window().tabs().setCurrentWidget(&window().motionView());
  const double end = bench().playEnd();
  ASSERT_GT(end, 0);
  const double x = timeline.xOf(0.3 * end);
  turnWheel(timeline, {x, 40}, 4);
  EXPECT_LT(timeline.seen().span(), 0.5 * end);
  EXPECT_NEAR(timeline.timeAt(x), 0.3 * end, 1e-6 * end);
  moveTo(timeline, {x, 40});
  ASSERT_GE(timeline.readout().size(), 3);
  EXPECT_TRUE(timeline.readout()[1].contains("mm/s")) << timeline.readout()[1].toStdString();
  EXPECT_TRUE(timeline.readout()[2].contains("N/mm²"));
  bench().setPlayTime(end);
  EXPECT_GE(timeline.seen().high, end - 1e-9) << "the playhead is in sight";
  turnWheel(timeline, {x, 40}, 3, Qt::ShiftModifier);
  EXPECT_LT(timeline.seen().high, end) << "moved";
  QTest::mouseDClick(&timeline, Qt::LeftButton, {}, QPoint(int(x), 40));
  EXPECT_NEAR(timeline.seen().span(), end, 1e-9);
}

TEST_F(WindowTest, TimelinePlaysTheBladeAsTheMotionIsRun) {
  openPanel(12);
  ASSERT_TRUE(QTest::qWaitFor([&] { return bench().shownCut()->run.value != nullptr; }, kPatience));
  Timeline& timeline = window().motionView().timeline();
  window().tabs().setCurrentWidget(&window().motionView());
  moveTo(timeline, {timeline.xOf(0.5 * bench().playEnd()), 40});
  ASSERT_EQ(timeline.readout().size(), 4);
  EXPECT_TRUE(timeline.readout()[3].startsWith("margin")) << timeline.readout()[3].toStdString();
  const double length = bench().design().blade.length;
  const auto shown = [&] { return window().sceneView().sceneStyle().movingBlade; };
  // It begins as the arc that its grips decide, which is of no station.
  bench().setPlayTime(0);
  ASSERT_GE(shown().size(), 2u);
  double along = 0;
  for (std::size_t k = 1; k < shown().size(); ++k) along += (shown()[k] - shown()[k - 1]).norm();
  EXPECT_NEAR(along, length, 0.05);
  const BladePose& first = bench().sweep()->sweep.poses.front();
  EXPECT_GT((shown()[60] - first.bladePoints(121)[60]).norm(), 10);
  // At a station it is the blade of the row, but for the corner that the robots cut there.
  bench().setPlayTime(bench().timeOfStation(5));
  const std::vector<Eigen::Vector3d> own = bench().sweep()->sweep.poses[5].bladePoints(121);
  ASSERT_EQ(shown().size(), own.size());
  for (std::size_t k = 0; k < own.size(); ++k) EXPECT_LT((shown()[k] - own[k]).norm(), 0.05) << k;
  picture("timeline-run");
}

TEST_F(WindowTest, TimelineShowsTheBarrierWhereAnotherShapeIsAsLow) {
  openPanel(12);
  ASSERT_TRUE(QTest::qWaitFor([&] { return bench().shownCut()->barriers.value != nullptr; }, kPatience));
  Timeline& timeline = window().motionView().timeline();
  window().tabs().setCurrentWidget(&window().motionView());
  const auto toldAt = [&](double seconds) {
    moveTo(timeline, {timeline.xOf(seconds), 40});
    return timeline.readout().filter("barrier");
  };
  for (const BarrierLook& look : *bench().shownCut()->barriers.value)
    EXPECT_TRUE(toldAt(look.time).isEmpty()) << "its shape is the only one";
  // A blade that may rest in another shape but for the way into it and out of it.
  bench().editDesign("Prepare", [](Design& design) {
    design.blade = bladePreset("nicr-flat-5x1").value();
    design.blade.length = 720;
  });
  ASSERT_TRUE(settle());
  ASSERT_TRUE(QTest::qWaitFor([&] { return bench().shownCut()->barriers.value != nullptr; }, kPatience));
  const std::vector<BarrierLook> looks = *bench().shownCut()->barriers.value;
  const BarrierLook* least = leastBarrier(looks);
  ASSERT_TRUE(least);
  const QStringList told = toldAt(least->time);
  ASSERT_EQ(told.size(), 1);
  EXPECT_NEAR(told[0].section(' ', 1, 1).toDouble(), *least->barrier, 0.2 * *least->barrier)
      << told[0].toStdString();
  EXPECT_TRUE(told[0].endsWith("N mm"));
  ASSERT_FALSE(looks.front().unsure);
  EXPECT_TRUE(toldAt(looks.front().time).isEmpty()) << "the arc at home";
  picture("timeline-barrier");
}

TEST_F(WindowTest, LengthsThatServeStandBelowTheLength) {
  openPanel(20);
  ASSERT_TRUE(QTest::qWaitFor([&] { return bench().shownCut()->lengths.value != nullptr; }, kPatience));
  const BladeLengths lengths = *bench().shownCut()->lengths.value;
  ASSERT_TRUE(lengths.best);
  auto* band = find<LengthBand>("Lengths that serve");
  ASSERT_TRUE(band);
  picture("lengths");
  // A press takes a length; the result that stands keeps what is known of the others.
  const double taken = lengths.bands().front().to;
  QTest::mouseClick(band, Qt::LeftButton, {}, QPoint(int(std::lround(band->xOf(taken))), 12));
  EXPECT_NEAR(bench().design().blade.length, taken, 5);
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().shownCut()->lengths.value->best, lengths.best);
  auto* best = window().findChild<WorkflowPanel*>()->findChild<QCheckBox*>("bestLength");
  ASSERT_TRUE(best);
  QTest::mouseClick(best, Qt::LeftButton, {}, QPoint(8, best->height() / 2));
  EXPECT_TRUE(bench().design().blade.autoLength);
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current());
  EXPECT_EQ(bench().sweep()->sweep.request.blade.length, *lengths.best);
  EXPECT_TRUE(std::ranges::any_of(bench().messages(),
                                  [](const Message& m) { return m.text.contains("length was left open"); }));
  picture("lengths-best");
  bench().document().undoStack().undo();
  EXPECT_FALSE(bench().design().blade.autoLength);
  EXPECT_NEAR(bench().design().blade.length, taken, 5);
  // What is too short says so beside the lengths that serve; those of another design are none.
  const auto told = [&](const QString& words) {
    return std::ranges::any_of(window().workflow().findChildren<QLabel*>(),
                               [&](const QLabel* label) { return label->text().contains(words); });
  };
  bench().editDesign("Change blade length", [](Design& design) { design.blade.length = 500; });
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().failed());
  EXPECT_TRUE(told("stations tried, best"));
  bench().editDesign("Change clearance", [](Design& design) { design.process.clearance = 40; });
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().failed());
  EXPECT_FALSE(told("stations tried, best"));
  EXPECT_TRUE(told("not known yet"));
}

TEST_F(WindowTest, TakesAClearanceAndItsBladeInOneStep) {
  openPanel(20);
  const Design before = bench().design();
  const Remedy remedy = OtherClearance{15, 690};
  ASSERT_TRUE(bench().canApply(remedy));
  bench().apply(remedy);
  EXPECT_EQ(bench().design().process.clearance, 15);
  EXPECT_EQ(bench().design().blade.length, 690);
  EXPECT_FALSE(bench().canApply(remedy)) << "it is done";
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design(), before);
  // The clearance alone, where the blade in use serves.
  bench().apply(OtherClearance{20});
  EXPECT_EQ(bench().design().process.clearance, 20);
  EXPECT_EQ(bench().design().blade, before.blade);
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
}

TEST_F(WindowTest, DeviationAgainstMarginStandsBelowTheMargin) {
  openPanel(20);
  ASSERT_TRUE(QTest::qWaitFor([&] { return bench().shownCut()->margins.value != nullptr; }, kPatience));
  const MarginTrade trade = *bench().shownCut()->margins.value;
  ASSERT_TRUE(trade.best);
  for (QToolButton* fold : window().findChildren<QToolButton*>())
    if (fold->isVisible() && fold->text() == "Fit and lead" && !fold->isChecked()) fold->click();
  auto* plot = find<MarginPlot>("Deviation against margin");
  ASSERT_TRUE(plot);
  ASSERT_TRUE(QTest::qWaitFor([&] { return plot->width() > 100 && plot->pos().y() > 0; }, kPatience));
  QTest::qWait(50);  // the fold lays itself out
  for (QWidget* about = plot; about; about = about->parentWidget())
    if (auto* scroll = qobject_cast<QScrollArea*>(about)) scroll->ensureWidgetVisible(plot);
  QTest::qWait(0);
  // Right after the margin, before what else stands in the fold.
  const auto topOf = [&](QWidget* widget) { return widget->mapTo(&window(), QPoint()).y(); };
  auto *margin = find<NumberField>("Stability margin"), *next = find<NumberField>("Motion tolerance");
  ASSERT_TRUE(margin && next);
  EXPECT_LT(topOf(margin) + margin->height(), topOf(plot));
  EXPECT_LT(topOf(plot) - topOf(margin), 2 * margin->height());
  EXPECT_GT(topOf(next), topOf(plot) + plot->height());
  picture("margins");
  // A press takes the margin that is drawn there; one that serves as well as another may lie at the same
  // place.
  const auto other = std::ranges::find_if(trade.trials, [&](const RowTrial& trial) {
    return trial.deviation < 100 && std::ranges::count_if(trade.trials, [&](const RowTrial& t) {
                                      const QPointF off = plot->placeOf(t) - plot->placeOf(trial);
                                      return std::hypot(off.x(), off.y()) < 2;
                                    }) == 1;
  });
  ASSERT_NE(other, trade.trials.end());
  QTest::mouseClick(plot, Qt::LeftButton, {}, plot->placeOf(*other).toPoint());
  EXPECT_EQ(bench().design().process.margin, other->asked);
  ASSERT_TRUE(settle());
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
}

}  // namespace bw::app
