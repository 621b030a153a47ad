// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Points of section curves that the mouse pulls in their plane, across as well as up and down.

#include <algorithm>
#include <cmath>

#include "handles_fixture.h"

namespace bw::app {
namespace {

class HandlePlaneTest : public HandlesTest {
 protected:
  SectionView& section() { return window().sectionView(); }
  const std::vector<SectionCurve>& sections() {
    return std::get<SectionsSurface>(bench().design().source().surface->shape).sections;
  }
  Eigen::Vector2d point() { return sections()[1].points[1]; }
  /// Selects the station in whose plane the handle lies.
  void showInSection() {
    const Eigen::Vector3d p = handles().points[kPoint];
    const auto& poses = bench().sweep()->sweep.poses;
    const auto away = [&](const BladePose& pose) { return std::abs(pose.frame.toLocal(p).z()); };
    bench().selectStation(int(std::ranges::min_element(poses, {}, away) - poses.begin()));
    window().tabs().setCurrentWidget(&section());
    QTest::qWait(20);
    // Nearer, so that some mm are some pixels.
    const QPointF on = inSection();
    QWheelEvent wheel(on, section().mapToGlobal(on), {}, {0, 5 * 120}, Qt::NoButton, {}, Qt::NoScrollPhase,
                      false);
    QApplication::sendEvent(&section(), &wheel);
  }
  /// Where the point is in the section, or would be if it was moved by so many mm across and up the surface.
  QPoint inSection(const Eigen::Vector2d& by = {0, 0}) {
    const SectionGrips grips = section().grips();
    auto grip = std::ranges::find(grips.grips, kPoint, &SectionGrips::Grip::handle);
    if (grip == grips.grips.end()) return {};
    SectionGrips::Grip moved = *grip;
    moved.place += by;  // x runs to the right, as seen from the front
    return section().placeOf(moved).toPoint();
  }
  void moveTo(QWidget& in, const QPoint& to, Qt::KeyboardModifiers keys = {}) {
    QMouseEvent event(QEvent::MouseMove, to, in.mapToGlobal(to), Qt::NoButton, Qt::LeftButton, keys);
    QApplication::sendEvent(&in, &event);
  }
  /// A loft of one height, on which points move across without a change of the surface.
  void flatten() {
    bench().editDesign("Flat", [](Design& design) {
      for (SectionCurve& curve : std::get<SectionsSurface>(design.source().surface->shape).sections)
        for (Eigen::Vector2d& p : curve.points) p.y() = 250;
    });
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
    bench().document().undoStack().clear();
  }
  bool told(const char* words) { return handles().text.find(words) != std::string::npos; }

  static constexpr int kPoint = 4 + 1;  // point 2 of section 2
};

TEST_F(HandlePlaneTest, TheSectionPullsAPointAcrossAndUp) {
  open("twist");
  showInSection();
  const Design before = bench().design();
  const Eigen::Vector2d was = point();
  const QPoint from = inSection(), across = inSection({-35, 2}), both = inSection({-35, 30});
  ASSERT_GT(std::abs(across.x() - from.x()), 10);
  QTest::mousePress(&section(), Qt::LeftButton, {}, from);
  moveTo(section(), across);
  EXPECT_LT(point().x(), was.x() - 20);
  EXPECT_EQ(point().x(), std::round(point().x())) << "whole mm";
  EXPECT_EQ(point().y(), was.y()) << "nearly across is across";
  EXPECT_TRUE(told(", across 1") && told(" mm (−")) << handles().text;
  // The way that is free leads across, and is known ever farther.
  const auto ways = [&] { return section().grips().ways; };
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return !ways().empty() && std::abs(ways()[0].from.x() - ways()[0].to.x()) > 1; }, kPatience));
  EXPECT_NEAR(ways()[0].from.y(), ways()[0].to.y(), 1e-6);
  picture("section-grips-across");
  moveTo(section(), both);
  EXPECT_LT(point().x(), was.x() - 5);
  EXPECT_GT(point().y(), was.y() + 5);
  EXPECT_TRUE(told(" (+")) << handles().text;
  EXPECT_TRUE(told(", across 1") && told(" mm (−")) << handles().text;
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return !ways().empty() && std::abs(ways()[0].from.y() - ways()[0].to.y()) > 1; }, kPatience))
      << "now it is the way that it was pulled";
  picture("section-grips-in-plane");
  // Straight up again.
  moveTo(section(), inSection(was - point()) - QPoint(2, 12));
  EXPECT_EQ(point().x(), was.x());
  EXPECT_GT(point().y(), was.y());
  moveTo(section(), both);
  QTest::mouseRelease(&section(), Qt::LeftButton, {}, both);
  const Eigen::Vector2d now = point();
  EXPECT_LT(now.x(), was.x() - 5);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_EQ(point(), now);
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design(), before);
  EXPECT_FALSE(bench().document().undoStack().canUndo()) << "one step for the whole pull";
}

TEST_F(HandlePlaneTest, ItStopsAtTheBorderOfTheWayThatItIsPulled) {
  open("twist");
  showInSection();
  const Eigen::Vector2d was = point();
  const QPoint from = inSection(), far = from + QPoint(25, -120);
  QTest::mousePress(&section(), Qt::LeftButton, {}, from);
  moveTo(section(), far);
  const auto& reach = bench().runner().reach();
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return handles().stopped && reach && reach->ends[1].bar != pipeline::Bar::none; }, kPatience));
  EXPECT_TRUE(told("Goes no farther")) << handles().text;
  picture("section-grips-stopped-in-plane");
  const Eigen::Vector2d by = point() - was;
  EXPECT_LE(by.norm(), reach->ends[1].free + 1e-6);
  QTest::mouseRelease(&section(), Qt::LeftButton, {}, far);
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_LE(bench().sweep()->analysis.summary.deviationMax, bench().design().process.tolerance);
  EXPECT_GE(bench().sweep()->analysis.summary.minRadius, bench().design().blade.minRadius());
}

TEST_F(HandlePlaneTest, APointDoesNotOvertakeItsNeighbour) {
  open("twist");
  flatten();
  showInSection();
  ASSERT_EQ(point(), Eigen::Vector2d(200, 250));
  const QPoint from = inSection(), beyond = inSection({260, 0});
  QTest::mousePress(&section(), Qt::LeftButton, {}, from);
  moveTo(section(), beyond);
  EXPECT_EQ(point(), Eigen::Vector2d(399, 250)) << "1 mm before the next one";
  EXPECT_TRUE(handles().stopped);
  EXPECT_TRUE(told("Goes no farther: a point may not overtake its neighbour")) << handles().text;
  const auto bothEnds = [&] {
    const std::vector<SectionGrips::Way> ways = section().grips().ways;
    return !ways.empty() && ways.front().endsAtFrom && ways.front().endsAtTo;
  };
  ASSERT_TRUE(QTest::qWaitFor(bothEnds, kPatience)) << "its neighbours are seen as the ends of its way";
  picture("section-grips-overtaking");
  QTest::mouseRelease(&section(), Qt::LeftButton, {}, beyond);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  // With its mirror image it meets that in the middle, whatever moves it.
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  window().commands()["handles.symmetric"]->trigger();
  QTest::mouseClick(&view(), Qt::LeftButton, {}, at(kPoint));
  for (int i = 0; i < 12; ++i) QTest::keyClick(&view(), Qt::Key_Right, Qt::ShiftModifier);
  EXPECT_EQ(point(), Eigen::Vector2d(290, 250)) << "steps of ten";
  EXPECT_EQ(sections()[1].points[2], Eigen::Vector2d(310, 250));
  EXPECT_TRUE(told("a point may not overtake its neighbour")) << handles().text;
  for (int i = 0; i < 12; ++i) QTest::keyClick(&view(), Qt::Key_Right);
  EXPECT_EQ(point(), Eigen::Vector2d(299, 250));
}

TEST_F(HandlePlaneTest, ThePictureDoesWhereItLooksAlongTheTravel) {
  open("twist");
  const Design before = bench().design();
  const Eigen::Vector2d was = point();
  // Elsewhere up and down alone.
  QPoint from = at(kPoint), to = from - QPoint(40, 6);
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  moveTo(view(), to);
  EXPECT_EQ(point().x(), was.x());
  QTest::keyClick(&view(), Qt::Key_Escape);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, to);
  ASSERT_EQ(bench().design(), before);
  ASSERT_TRUE(lookFromFront());
  from = at(kPoint);
  to = view().toWidget(handles().points[kPoint] + Eigen::Vector3d(-40, 0, 20)).toPoint();
  ASSERT_EQ(view().handleAt(from), kPoint);
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  moveTo(view(), to);
  EXPECT_LT(point().x(), was.x() - 5);
  EXPECT_GT(point().y(), was.y() + 5);
  EXPECT_TRUE(told(", across 1") && told(" mm (−")) << handles().text;
  ASSERT_TRUE(QTest::qWaitFor([&] { return !handles().ways.empty(); }, kPatience));
  picture("handle-in-plane");
  QTest::keyClick(&view(), Qt::Key_Escape);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, to);
  EXPECT_EQ(bench().design(), before);
}

TEST_F(HandlePlaneTest, ItSnapsAcrossToo) {
  open("twist");
  flatten();
  showInSection();
  window().commands()["handles.meet"]->trigger();
  const QPoint from = inSection(), middle = inSection({96, 0});
  QTest::mousePress(&section(), Qt::LeftButton, {}, from);
  moveTo(section(), middle);
  EXPECT_EQ(point(), Eigen::Vector2d(300, 250));
  EXPECT_TRUE(told("Snapped to the middle of the block between left and right")) << handles().text;
  picture("section-grips-snapped-across");
  QTest::mouseRelease(&section(), Qt::LeftButton, {}, middle);
  EXPECT_EQ(point(), Eigen::Vector2d(300, 250));
  ASSERT_TRUE(settle());
}

}  // namespace
}  // namespace bw::app
