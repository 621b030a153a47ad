// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Handles that the mouse brings in line with the block and with other handles.

#include "window/handle_snap.h"

#include <algorithm>
#include <cmath>

#include "handles_fixture.h"

namespace bw::app {
namespace {

TEST(HandleSnap, TakesTheNearestOfFacesMiddlesAndPoints) {
  SnapThings things;
  Box box;
  box.size = {600, 800, 500};
  things.blocks = {{"the block", box}};
  things.points = {{"pole 1", {100, 0, 246}}, {"pole 2", {100, 700, 251}}};
  const SnapWay up{{100, 100, 200}, Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX()};
  const auto wordsAt = [&](const SnapWay& way, double by) {
    const std::optional<Snap> snap = snapTo(things, way, by, 6);
    return snap ? snap->words : QString();
  };
  EXPECT_EQ(wordsAt(up, 50.4), "half the height of the block");
  EXPECT_EQ(wordsAt(up, 51.2), "the height of pole 2");
  EXPECT_EQ(wordsAt(up, 42), "the height of pole 1");
  EXPECT_EQ(wordsAt(up, 39.5), "") << "beyond its reach";
  EXPECT_EQ(wordsAt(up, 298), "the top of the block");
  EXPECT_EQ(wordsAt(up, -203), "the bottom of the block");
  EXPECT_EQ(snapTo(things, up, 42, 6)->by, 46);
  EXPECT_EQ(snapTo(things, up, 42, 6)->line[0], things.points[0].place);
  // Of several as near the one next to it.
  things.points = {{"far", {100, 700, 220}}, {"next", {100, 150, 220}}};
  EXPECT_EQ(wordsAt(up, 21), "the height of next");
  std::ranges::reverse(things.points);
  EXPECT_EQ(wordsAt(up, 21), "the height of next");
  // Across, in a block that is turned by a right angle: its front and back lie there.
  const SnapWay across{{100, 100, 200}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), false};
  EXPECT_EQ(wordsAt(across, -99), "the left side of the block");
  EXPECT_EQ(wordsAt(across, 201), "the middle of the block between left and right");
  EXPECT_EQ(wordsAt(across, 1), "the x of next");
  things.blocks[0].box.frame.x = Eigen::Vector3d::UnitY();
  things.blocks[0].box.frame.y = -Eigen::Vector3d::UnitX();
  EXPECT_EQ(wordsAt(across, -101), "the front of the block");
  // Faces that the way does not lead to are none.
  const SnapWay askew{{100, 100, 200}, Eigen::Vector3d(1, 1, 1).normalized(), Eigen::Vector3d::UnitX()};
  things.points.clear();
  for (int by = -400; by < 400; by += 5) EXPECT_EQ(wordsAt(askew, by), "");
}

class HandleSnapTest : public HandlesTest {
 protected:
  double height(int row, int column) {
    return std::get<PolesSurface>(bench().design().source().surface->shape).at(row, column).height;
  }
  void moveTo(QWidget& in, const QPoint& to, Qt::KeyboardModifiers keys = {}) {
    QMouseEvent event(QEvent::MouseMove, to, in.mapToGlobal(to), Qt::NoButton, Qt::LeftButton, keys);
    QApplication::sendEvent(&in, &event);
  }
  /// Where the hand is that pulled a handle from where it was by so many mm.
  QPoint pulledBy(int handle, const Eigen::Vector3d& by) {
    return view().toWidget(handles().points[std::size_t(handle)] + by).toPoint();
  }
  bool told(const char* words) { return handles().text.find(words) != std::string::npos; }

  static constexpr int kPole = 2 * 4 + 1;  // pole 2 of row 3, of 340 mm
};

TEST_F(HandleSnapTest, APoleSnapsToTheHeightOfAnother) {
  open("single-block");
  const QPoint from = at(kPole), near = pulledBy(kPole, {0, 0, -6}), far = pulledBy(kPole, {0, 0, -45});
  // Only where it is asked for.
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  moveTo(view(), near);
  EXPECT_NEAR(height(2, 1), 334, 1.5);
  EXPECT_FALSE(told("Snapped")) << handles().text;
  QTest::keyClick(&view(), Qt::Key_Escape);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, near);
  ASSERT_EQ(height(2, 1), 340);
  QTest::keyClick(&view(), Qt::Key_G, Qt::ShiftModifier);
  ASSERT_TRUE(window().commands()["handles.meet"]->isChecked());
  const std::size_t lines = handles().curves.size();
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  moveTo(view(), near);
  EXPECT_EQ(height(2, 1), 335);
  EXPECT_TRUE(told("Snapped to the height of pole 2 of row ")) << handles().text;
  EXPECT_EQ(handles().curves.size(), lines + 2) << "the line to it, and a mark";
  picture("handle-snapped");
  // With Ctrl or Alt it does not, nor where nothing is near.
  for (const Qt::KeyboardModifier fine : {Qt::AltModifier, Qt::ControlModifier}) {
    moveTo(view(), near, fine);
    EXPECT_NEAR(height(2, 1), 339.4, 0.2);
    EXPECT_FALSE(told("Snapped")) << handles().text;
  }
  moveTo(view(), far);
  EXPECT_FALSE(told("Snapped")) << handles().text;
  EXPECT_EQ(handles().curves.size(), lines);
  moveTo(view(), near);
  EXPECT_EQ(height(2, 1), 335);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, near);
  EXPECT_EQ(height(2, 1), 335);
  EXPECT_FALSE(told("Snapped"));
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  bench().document().undoStack().undo();
  EXPECT_EQ(height(2, 1), 340);
  EXPECT_FALSE(bench().document().undoStack().canUndo());
  // The choice is remembered.
  makeWindow({1440, 900});
  open("single-block");
  EXPECT_TRUE(window().commands()["handles.meet"]->isChecked());
}

TEST_F(HandleSnapTest, APoleSnapsToTheMiddleOfTheBlock) {
  open("single-block");
  window().commands()["handles.meet"]->trigger();
  constexpr int kEnd = 2 * 4 + 3;  // of 260 mm
  const QPoint from = at(kEnd), near = pulledBy(kEnd, {0, 0, -9});
  ASSERT_EQ(view().handleAt(from), kEnd);
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  moveTo(view(), near);
  EXPECT_EQ(height(2, 3), 250);
  EXPECT_TRUE(told("Snapped to half the height of the block")) << handles().text;
  picture("handle-snapped-to-block");
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, near);
  EXPECT_EQ(height(2, 3), 250);
  ASSERT_TRUE(settle());
}

TEST_F(HandleSnapTest, WhatMovesWithItIsNothingToSnapTo) {
  open("single-block");
  window().commands()["handles.meet"]->trigger();
  // All that are as high, or nearly so, move with it.
  std::vector<int> chosen;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 4; ++column)
      if (std::abs(height(row, column) - 335) < 12) chosen.push_back(row * 4 + column);
  window().surfaceHandles().choose(chosen);
  ASSERT_NE(std::ranges::find(chosen, kPole), chosen.end());
  const QPoint from = at(kPole), near = pulledBy(kPole, {0, 0, -3});
  QTest::mousePress(&view(), Qt::LeftButton, {}, from);
  moveTo(view(), near);
  EXPECT_LT(height(2, 1), 340);
  EXPECT_FALSE(told("Snapped")) << handles().text;
  QTest::keyClick(&view(), Qt::Key_Escape);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, near);
}

TEST_F(HandleSnapTest, TheSectionSnapsAsThePictureDoes) {
  open("single-block");
  window().commands()["handles.meet"]->trigger();
  SectionView& section = window().sectionView();
  const auto& poses = bench().sweep()->sweep.poses;
  const Eigen::Vector3d pole = handles().points[kPole];
  const auto away = [&](const BladePose& pose) { return std::abs(pose.frame.toLocal(pole).z()); };
  bench().selectStation(int(std::ranges::min_element(poses, {}, away) - poses.begin()));
  window().tabs().setCurrentWidget(&section);
  QTest::qWait(20);
  const SectionGrips grips = section.grips();
  auto grip = std::ranges::find(grips.grips, kPole, &SectionGrips::Grip::handle);
  ASSERT_NE(grip, grips.grips.end());
  SectionGrips::Grip below = *grip;
  below.place.y() -= 5;
  const QPoint from = section.placeOf(*grip).toPoint(), near = section.placeOf(below).toPoint();
  QTest::mousePress(&section, Qt::LeftButton, {}, from);
  moveTo(section, near);
  EXPECT_EQ(height(2, 1), 335);
  ASSERT_EQ(section.grips().meetings.size(), 1u);
  EXPECT_TRUE(section.readout().join(' ').contains("Snapped to the height of pole 2 of row "))
      << section.readout().join('\n').toStdString();
  picture("section-grips-snapped");
  moveTo(section, near, Qt::AltModifier);
  EXPECT_TRUE(section.grips().meetings.empty());
  EXPECT_NEAR(height(2, 1), 339.5, 0.3);
  QTest::keyClick(&section, Qt::Key_Escape);
  QTest::mouseRelease(&section, Qt::LeftButton, {}, near);
  EXPECT_EQ(height(2, 1), 340);
}

}  // namespace
}  // namespace bw::app
