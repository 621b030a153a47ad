// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Points of the surface in the hand in the section view.

#include "plots/section_grips.h"

#include <algorithm>
#include <cmath>

#include "handles_fixture.h"

namespace bw::app {
namespace {

class SectionGripsTest : public HandlesTest {
 protected:
  SectionView& section() { return window().sectionView(); }
  double height(int pole) {
    return std::get<PolesSurface>(bench().design().source().surface->shape).poles[std::size_t(pole)].height;
  }
  /// Selects the station in whose plane a handle lies nearest.
  void selectStationOf(int handle) {
    const Eigen::Vector3d p = handles().points[std::size_t(handle)];
    const auto& poses = bench().sweep()->sweep.poses;
    const auto away = [&](const BladePose& pose) { return std::abs(pose.frame.toLocal(p).z()); };
    const auto next = std::ranges::min_element(poses, {}, away);
    bench().selectStation(int(next - poses.begin()));
    window().tabs().setCurrentWidget(&section());
    QTest::qWait(20);
  }
  QPoint at(int handle) {
    const SectionGrips grips = section().grips();
    const auto grip = std::ranges::find(grips.grips, handle, &SectionGrips::Grip::handle);
    return grip == grips.grips.end() ? QPoint() : section().placeOf(*grip).toPoint();
  }
  void move(const QPoint& to, Qt::KeyboardModifiers keys = {}) {
    QMouseEvent event(QEvent::MouseMove, to, section().mapToGlobal(to), Qt::NoButton, Qt::LeftButton, keys);
    QApplication::sendEvent(&section(), &event);
  }

  static constexpr int kPole = 2 * 4 + 1;  // pole 2 of row 3
};

TEST_F(SectionGripsTest, APointOfTheSectionIsPulledAsInThePicture) {
  open("single-block");
  selectStationOf(kPole);
  const SectionGrips grips = section().grips();
  ASSERT_EQ(grips.grips.size(), 4u) << "those of its row";
  EXPECT_EQ(grips.grips.front().handle, 2 * 4);
  const int station = bench().selection().station;
  const QPoint from = at(kPole);
  ASSERT_TRUE(section().sectionArea().contains(from));
  move(from);
  EXPECT_EQ(section().cursor().shape(), Qt::OpenHandCursor);
  picture("section-grips");
  QTest::mousePress(&section(), Qt::LeftButton, {}, from);
  for (int i = 1; i <= 4; ++i) {
    move(from - QPoint(0, 2 * i));
    QTest::qWait(10);
  }
  const double now = height(kPole);
  EXPECT_GT(now, 341);
  EXPECT_EQ(now, std::round(now)) << "whole mm";
  EXPECT_EQ(handles().chosen, std::vector<int>{kPole}) << "the same handle as in the picture";
  EXPECT_EQ(handles().points[kPole].z(), now);
  // It stays under the hand, whatever the drawing does.
  EXPECT_NEAR(at(kPole).y(), from.y() - 8, 4);
  ASSERT_FALSE(section().readout().isEmpty());
  EXPECT_TRUE(section().readout().front().startsWith("Pole 2 of row 3: "));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !section().grips().ways.empty(); }, kPatience));
  picture("section-grips-pulled");
  // The station stays while it is held.
  QTest::keyClick(&section(), Qt::Key_Right);
  EXPECT_EQ(bench().selection().station, station);
  QTest::mouseRelease(&section(), Qt::LeftButton, {}, from - QPoint(0, 8));
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_EQ(height(kPole), now);
  bench().document().undoStack().undo();
  EXPECT_EQ(height(kPole), 340);
  EXPECT_FALSE(bench().document().undoStack().canUndo()) << "one step for the whole pull";
}

TEST_F(SectionGripsTest, EscapeGivesItUpAndTheBorderHolds) {
  open("single-block");
  selectStationOf(kPole);
  const Design before = bench().design();
  const QPoint from = at(kPole);
  QTest::mousePress(&section(), Qt::LeftButton, {}, from);
  move(from - QPoint(0, 300));
  ASSERT_TRUE(QTest::qWaitFor([&] { return section().grips().stopped; }, kPatience));
  EXPECT_TRUE(section().readout().join(' ').contains("Goes no farther"))
      << section().readout().join('\n').toStdString();
  picture("section-grips-stopped");
  QTest::keyClick(&section(), Qt::Key_Escape);
  EXPECT_EQ(bench().design(), before);
  move(from - QPoint(0, 100));
  QTest::mouseRelease(&section(), Qt::LeftButton, {}, from);
  EXPECT_EQ(bench().design(), before) << "nothing hangs on it any more";
  ASSERT_TRUE(settle());
}

TEST_F(SectionGripsTest, AStopOnAWayAslantLeavesRoundNumbers) {
  open("block-wall");
  constexpr int kPoint = 4 + 1;  // point 2 of section 2
  const auto point = [this] {
    return std::get<SectionsSurface>(bench().design().source().surface->shape).sections[1].points[1];
  };
  selectStationOf(kPoint);
  const Eigen::Vector2d before = point();
  const QPoint from = at(kPoint);
  ASSERT_FALSE(from.isNull());
  QTest::mousePress(&section(), Qt::LeftButton, {}, from);
  move(from + QPoint(90, -140));
  ASSERT_TRUE(QTest::qWaitFor([&] { return section().grips().stopped; }, kPatience));
  QTest::qWait(200);
  QTest::mouseRelease(&section(), Qt::LeftButton, {}, from + QPoint(90, -140));
  ASSERT_TRUE(settle());
  const Eigen::Vector2d after = point();
  EXPECT_NE(after, before);
  EXPECT_EQ(after.x(), std::round(after.x()));
  EXPECT_EQ(after.y(), std::round(after.y()));
}

TEST_F(SectionGripsTest, BetweenRowsThereIsNothingToTakeHoldOf) {
  open("single-block");
  const auto& poses = bench().sweep()->sweep.poses;
  int none = -1;
  for (int i = 0; i < int(poses.size()); ++i) {
    bench().selectStation(i);
    if (section().grips().grips.empty()) none = i;
  }
  ASSERT_GE(none, 0);
  bench().selectStation(none);
  const Design before = bench().design();
  const QPoint middle = section().sectionArea().center().toPoint();
  QTest::mousePress(&section(), Qt::LeftButton, {}, middle);
  move(middle - QPoint(0, 20));
  QTest::mouseRelease(&section(), Qt::LeftButton, {}, middle - QPoint(0, 20));
  EXPECT_EQ(bench().design(), before);
  // Hidden handles are none here, either.
  selectStationOf(kPole);
  ASSERT_FALSE(section().grips().grips.empty());
  window().commands()["view.handles"]->trigger();
  EXPECT_TRUE(section().grips().grips.empty());
}

}  // namespace
}  // namespace bw::app
