// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The block that is selected in the hand: its faces, its rotation, the cutting direction and the planes.

#include "window/block_handles.h"

#include <Eigen/Geometry>

#include <QStatusBar>

#include <cmath>

#include "bw/core/base/units.h"
#include "handles_fixture.h"
#include "workbench/block_layout.h"

namespace bw::app {
namespace {

class BlockHandlesTest : public HandlesTest {
 protected:
  /// Opens an example and clicks one of its blocks in the plan.
  void openBlock(const QString& example, const std::string& block = {}) {
    open(example);
    QTest::keyClick(&window(), Qt::Key_7, Qt::ControlModifier);
    BlockPlan& plan = window().blockPanel().plan();
    ASSERT_TRUE(QTest::qWaitFor([&] { return plan.isVisible(); }, kPatience));
    QTest::qWait(20);
    const std::string& which = block.empty() ? bench().design().block().id : block;
    QTest::mouseClick(&plan, Qt::LeftButton, {}, plan.rectOf(which).center().toPoint());
    ASSERT_EQ(bench().selection().kind, Selection::Kind::block);
    ASSERT_TRUE(QTest::qWaitFor([&] { return view().resting(); }, kPatience));
    ASSERT_GE(handle(BlockPart::direction), 0);
  }
  int handle(BlockPart part) { return window().blockHandles().handleOf(part); }
  Eigen::Vector3d place(BlockPart part) { return handles().points[std::size_t(handle(part))]; }
  QPoint on(BlockPart part) { return view().toWidget(place(part)).toPoint(); }
  Box box() { return bench().block().placement->box(); }
  /// Presses a part and moves the hand to where a point of space is seen.
  void pull(BlockPart part, const Eigen::Vector3d& to, Qt::KeyboardModifiers keys = {}) {
    const QPoint from = on(part), end = view().toWidget(to).toPoint();
    ASSERT_EQ(view().handleAt(from), handle(part)) << "nothing lies before it";
    QTest::mousePress(&view(), Qt::LeftButton, keys, from);
    for (int i = 1; i <= 5; ++i) {
      const QPoint at = from + (end - from) * i / 5;
      QMouseEvent move(QEvent::MouseMove, at, view().mapToGlobal(at), Qt::NoButton, Qt::LeftButton, keys);
      QApplication::sendEvent(&view(), &move);
      QTest::qWait(5);
    }
  }
  void release() { QTest::mouseRelease(&view(), Qt::LeftButton); }
  void press(Qt::Key key, Qt::KeyboardModifiers keys = {}) { QTest::keyClick(&view(), key, keys); }
  void type(const QString& text) {
    for (const QChar c : text) QTest::keyClick(QApplication::focusWidget(), c.toLatin1());
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Return);
  }
};

TEST_F(BlockHandlesTest, AFaceIsPulledAlongItsNormal) {
  openBlock("ripple-along");
  const Design before = bench().design();
  const std::size_t poles = std::size_t(window().surfaceHandles().count());
  EXPECT_EQ(handles().points.size(), poles + 14);
  EXPECT_EQ(handles().quiet, poles) << "those of the surface stand back";
  const Box was = placementOf(bench())->box();
  hover(handle(BlockPart::right));
  EXPECT_EQ(handles().text.find("Right face: size X "), 0u) << handles().text;
  picture("block-handles");
  ASSERT_NO_FATAL_FAILURE(pull(BlockPart::right, place(BlockPart::right) + 40 * was.frame.x));
  EXPECT_NEAR(box().size.x(), was.size.x() + 40, 4);
  EXPECT_EQ(box().size.x(), std::round(box().size.x())) << "whole mm";
  EXPECT_EQ(box().frame.origin, was.frame.origin) << "the other face stays";
  picture("block-handles-pulled");
  release();
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_NEAR(view().content().first<Box>()->size.x(), box().size.x(), 1e-9);
  EXPECT_EQ(bench().document().undoStack().undoText(), "Resize block");
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design(), before);
  EXPECT_FALSE(bench().document().undoStack().canUndo()) << "one step for the whole pull";
  // The left face takes the corner with it, and the right one stays.
  ASSERT_NO_FATAL_FAILURE(
      pull(BlockPart::left, place(BlockPart::left) - 33 * was.frame.x, Qt::ShiftModifier));
  release();
  EXPECT_NEAR(std::remainder(box().size.x(), 10), 0, 1e-9) << "coarse";
  EXPECT_NEAR(
      (box().frame.origin + box().size.x() * box().frame.x - (was.frame.origin + was.size.x() * was.frame.x))
          .norm(),
      0, 1e-9);
  bench().document().undoStack().undo();
  // Esc gives a pull up.
  ASSERT_NO_FATAL_FAILURE(pull(BlockPart::top, place(BlockPart::top) + 30 * was.frame.normal));
  EXPECT_NE(bench().design(), before);
  press(Qt::Key_Escape);
  EXPECT_EQ(bench().design(), before);
  release();
  EXPECT_EQ(bench().design(), before);
  ASSERT_TRUE(settle());
  // A click elsewhere selects no block, and its handles are gone.
  QTest::mouseClick(&view(), Qt::LeftButton, {}, QPoint(10, view().height() - 10));
  EXPECT_EQ(handles().points.size(), poles);
}

TEST_F(BlockHandlesTest, AFaceSnapsToOtherBlocksAndToTheEndsOfTheSurface) {
  openBlock("ripple-along");
  const Box was = placementOf(bench())->box();
  // A block beside it that is lower, and ends elsewhere.
  bench().editDesign("Prepare", [&](Design& design) {
    StockBlock other{"beside", bw::placementOf(was)};
    other.placement->origin.x() += was.size.x() + 100;
    other.placement->size.z() = was.size.z() - 57.3;
    design.stock.push_back(other);
    Cut cut = design.cuts.front();
    cut.id = "beside";
    cut.block = other.id;
    design.cuts.push_back(cut);
  });
  ASSERT_TRUE(settle());
  bench().select({Selection::Kind::block, -1, bench().design().stock[0].id, bench().design().cuts[0].id});
  ASSERT_TRUE(QTest::qWaitFor([&] { return view().resting(); }, kPatience));
  if (!window().surfaceHandles().meeting()) window().commands()["handles.meet"]->trigger();
  ASSERT_TRUE(window().surfaceHandles().meeting());
  const double top = was.size.z() - 57.3;
  ASSERT_NO_FATAL_FAILURE(pull(BlockPart::top, place(BlockPart::top) - 56 * was.frame.normal));
  EXPECT_NEAR(box().size.z(), top, 1e-9) << "not the grid";
  EXPECT_NE(handles().text.find("Snapped to the top of beside"), std::string::npos) << handles().text;
  picture("block-handles-snapped");
  release();
  EXPECT_NEAR(box().size.z(), top, 1e-9);
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  // Up to the other block.
  ASSERT_TRUE(QTest::qWaitFor([&] { return view().resting(); }, kPatience));
  ASSERT_NO_FATAL_FAILURE(pull(BlockPart::right, place(BlockPart::right) + 99 * was.frame.x));
  EXPECT_NEAR(box().size.x(), was.size.x() + 100, 1e-9);
  EXPECT_NE(handles().text.find("Snapped to the left side of beside"), std::string::npos) << handles().text;
  release();
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  // Fine steps, and a hand that wants none of it, are free.
  ASSERT_TRUE(QTest::qWaitFor([&] { return view().resting(); }, kPatience));
  window().commands()["handles.meet"]->trigger();
  ASSERT_FALSE(window().surfaceHandles().meeting());
  ASSERT_NO_FATAL_FAILURE(pull(BlockPart::right, place(BlockPart::right) + 98 * was.frame.x));
  EXPECT_EQ(handles().text.find("Snapped"), std::string::npos) << handles().text;
  release();
  bench().document().undoStack().undo();
  window().commands()["handles.meet"]->trigger();
  ASSERT_TRUE(settle());
  // The ends of the surface, along the axes of the block.
  const TriangleMesh& mesh = *bench().shownCut()->targetMesh.value;
  double highest = -1e300;
  for (const Eigen::Vector3d& point : mesh.points) highest = std::max(highest, was.frame.toLocal(point).z());
  ASSERT_LT(highest, was.size.z() - 10);
  ASSERT_TRUE(QTest::qWaitFor([&] { return view().resting(); }, kPatience));
  ASSERT_NO_FATAL_FAILURE(
      pull(BlockPart::top, place(BlockPart::top) - (was.size.z() - highest - 0.7) * was.frame.normal));
  EXPECT_NEAR(box().size.z(), highest, 1e-6);
  EXPECT_NE(handles().text.find("Snapped to the top of the surface"), std::string::npos) << handles().text;
  press(Qt::Key_Escape);
  release();
  EXPECT_EQ(box().size.z(), was.size.z());
}

TEST_F(BlockHandlesTest, NumbersAreTypedAndKeysCount) {
  openBlock("ripple-along");
  const Design before = bench().design();
  const Box was = placementOf(bench())->box();
  QTest::mouseClick(&view(), Qt::LeftButton, {}, on(BlockPart::left));
  EXPECT_EQ(bench().design(), before) << "a press moves nothing";
  type("70,5 cm");
  EXPECT_EQ(box().size.x(), 705);
  EXPECT_NEAR(box().center().x() + 352.5, was.center().x() + 0.5 * was.size.x(), 1e-9) << "to the left";
  press(Qt::Key_Up);
  EXPECT_EQ(box().size.x(), 706);
  press(Qt::Key_Up, Qt::ControlModifier);
  EXPECT_NEAR(box().size.x(), 706.1, 1e-9);
  press(Qt::Key_Down, Qt::ShiftModifier);
  EXPECT_EQ(box().size.x(), 700);
  press(Qt::Key_Escape);
  EXPECT_EQ(box().size.x(), 705) << "what the keys did";
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design(), before);
  // An expression stands where the size alone moves the face.
  bench().editDesign("Prepare", [](Design& design) { design.variables.push_back({"high", 480, 300, 900}); });
  QTest::mouseClick(&view(), Qt::LeftButton, {}, on(BlockPart::top));
  press(Qt::Key_Return);
  ASSERT_TRUE(window().blockHandles().field().isVisible());
  auto* field = find<NumberField>("Size Z of " + QString::fromStdString(bench().block().id));
  ASSERT_TRUE(field);
  picture("block-handles-typed");
  QTest::keyClick(field, Qt::Key_A, Qt::ControlModifier);
  type("=high + 20");
  EXPECT_EQ(box().size.z(), 500);
  EXPECT_EQ(withVariables(bench().design(), {{"high", 500}}).value().block().placement->size.z(), 520);
  ASSERT_TRUE(settle());
}

TEST_F(BlockHandlesTest, EveryFaceAndTheRingTakeExpressions) {
  openBlock("ripple-along");
  bench().editDesign("Prepare", [](Design& design) {
    design.block().placement = BlockPlacement{{10, -20, 5}, {580, 840, 480}, {0, 0, 0.1}};
    design.variables.push_back({"wide", 640, 300, 900});
    design.variables.push_back({"turn", 12, -90, 90});
  });
  ASSERT_TRUE(settle());
  ASSERT_TRUE(QTest::qWaitFor([&] { return view().resting(); }, kPatience));
  const Box was = box();
  const auto right = [](const Box& of) {
    return Eigen::Vector3d(of.frame.origin + of.size.x() * of.frame.x);
  };
  QUndoStack& undo = bench().document().undoStack();
  const int steps = undo.index();
  QTest::mouseClick(&view(), Qt::LeftButton, {}, on(BlockPart::left));
  type("=wide - 20");
  EXPECT_EQ(box().size.x(), 620);
  EXPECT_NEAR((right(box()) - right(was)).norm(), 0, 1e-9) << "the face opposite stays";
  EXPECT_EQ(undo.index(), steps + 1);
  EXPECT_EQ(undo.undoText(), "Resize block");
  const Box wider = withVariables(bench().design(), {{"wide", 700}}).value().block().placement->box();
  EXPECT_EQ(wider.size.x(), 680);
  EXPECT_NEAR((right(wider) - right(was)).norm(), 0, 1e-9) << "also when the variable changes";
  const Design again = parseDesign(designToJson(bench().design())).value();
  EXPECT_EQ(again.bindings, bench().design().bindings);
  // The ring turns the block about its middle.
  ASSERT_TRUE(QTest::qWaitFor([&] { return view().resting(); }, kPatience));
  const Eigen::Vector3d middle = box().center();
  QTest::mouseClick(&view(), Qt::LeftButton, {}, on(BlockPart::turnZ));
  type("=turn");
  EXPECT_NEAR(bench().block().placement->rotation.z(), 12 * kDegree, 1e-12);
  EXPECT_NEAR((box().center() - middle).norm(), 0, 1e-9);
  EXPECT_EQ(undo.index(), steps + 2);
  const Box turned = withVariables(bench().design(), {{"turn", -30}}).value().block().placement->box();
  EXPECT_NEAR((turned.center() - middle).norm(), 0, 1e-9);
  EXPECT_NEAR(turned.frame.x.y(), std::sin(-30 * kDegree), 1e-12);
  // Reopened, the field shows it; a number frees it.
  press(Qt::Key_Return);
  auto* field = find<NumberField>("Rotation Z of " + QString::fromStdString(bench().block().id));
  ASSERT_TRUE(field);
  EXPECT_EQ(field->expression(), "turn");
  picture("block-handles-ring-typed");
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_A, Qt::ControlModifier);
  type("15");
  EXPECT_NEAR((box().center() - middle).norm(), 0, 1e-9);
  EXPECT_FALSE(bench().design().bindings.contains("/stock/0/block/rotation_deg/2"));
  undo.setIndex(steps);
  EXPECT_TRUE(bench().design().bindings.empty());
  ASSERT_TRUE(settle());
}

TEST_F(BlockHandlesTest, AHandleThatWasChosenIsNotThatOfAnotherBlock) {
  openBlock("three-block-wall");
  bench().editDesign("As a list", [](Design& design) { design.grid.reset(); });
  ASSERT_TRUE(settle());
  QTest::mouseClick(&view(), Qt::LeftButton, {}, on(BlockPart::top));
  ASSERT_FALSE(handles().chosen.empty());
  type("1x");  // refused, so that its field stays in sight
  ASSERT_TRUE(window().blockHandles().field().isVisible());
  const Design before = bench().design();
  BlockPlan& plan = window().blockPanel().plan();
  const std::string& other = bench().design().stock.back().id;
  ASSERT_NE(other, bench().selection().block);
  QTest::mouseClick(&plan, Qt::LeftButton, {}, plan.rectOf(other).center().toPoint());
  ASSERT_EQ(bench().selection().block, other);
  EXPECT_TRUE(handles().chosen.empty());
  EXPECT_FALSE(window().blockHandles().field().isVisible());
  press(Qt::Key_Up);
  EXPECT_EQ(bench().design(), before);
}

TEST_F(BlockHandlesTest, TheRingTurnsTheBlockAboutItsMiddle) {
  openBlock("ripple-along");
  const Box was = placementOf(bench())->box();
  const Eigen::Vector3d middle = was.center();
  const auto turned = [&](double degrees) {
    const Eigen::Vector3d from = place(BlockPart::turnZ) - middle;
    return Eigen::Vector3d(middle + Eigen::AngleAxisd(fromDegrees(degrees), was.frame.normal) * from);
  };
  ASSERT_NO_FATAL_FAILURE(pull(BlockPart::turnZ, turned(27)));
  EXPECT_NEAR(toDegrees(bench().block().placement->rotation.z()), 30, 1e-9) << "steps of 15°";
  EXPECT_NEAR((box().center() - middle).norm(), 0, 1e-9);
  picture("block-handles-turned");
  press(Qt::Key_Escape);
  release();
  ASSERT_NO_FATAL_FAILURE(pull(BlockPart::turnZ, turned(-7), Qt::ControlModifier));
  release();
  const double fine = toDegrees(bench().block().placement->rotation.z());
  EXPECT_NEAR(fine, -7, 2.1);
  EXPECT_NEAR(fine, std::round(fine), 1e-9);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_EQ(bench().document().undoStack().undoText(), "Rotate block");
}

TEST_F(BlockHandlesTest, RingsOfAllThreeAxesTurnItAboutItsMiddle) {
  openBlock("ripple-along");
  const Box was = placementOf(bench())->box();
  const Eigen::Vector3d middle = was.center();
  picture("block-handles-rings");
  const auto turned = [&](BlockPart part, const Eigen::Vector3d& axis, double degrees) {
    return Eigen::Vector3d(middle + Eigen::AngleAxisd(fromDegrees(degrees), axis) * (place(part) - middle));
  };
  hover(handle(BlockPart::turnX));
  EXPECT_EQ(handles().text, "Rotation X: 0°");
  ASSERT_NO_FATAL_FAILURE(
      pull(BlockPart::turnX, turned(BlockPart::turnX, Eigen::Vector3d::UnitX(), 16), Qt::ControlModifier));
  const double x = toDegrees(bench().block().placement->rotation.x());
  EXPECT_NEAR(x, 16, 2.1);
  EXPECT_NEAR(x, std::round(x), 1e-9);
  EXPECT_NEAR((box().center() - middle).norm(), 0, 1e-9);
  picture("block-handles-ring-x");
  release();
  ASSERT_TRUE(settle());
  // The next turns about the axis that the first has turned.
  ASSERT_TRUE(QTest::qWaitFor([&] { return view().resting(); }, kPatience));
  const Eigen::Vector3d next(0, std::cos(fromDegrees(x)), std::sin(fromDegrees(x)));
  ASSERT_NO_FATAL_FAILURE(pull(BlockPart::turnY, turned(BlockPart::turnY, next, -14)));
  EXPECT_NEAR(toDegrees(bench().block().placement->rotation.y()), -15, 1e-9);
  EXPECT_NEAR(toDegrees(bench().block().placement->rotation.x()), x, 1e-9);
  EXPECT_NEAR((box().center() - middle).norm(), 0, 1e-9);
  release();
  ASSERT_TRUE(settle());
  // Typed as an expression, each keeps the middle when its variable changes.
  bench().editDesign("Variable", [](Design& design) { design.variables.push_back({"tilt", 5, -40, 40}); });
  ASSERT_TRUE(settle());
  for (const BlockPart part : {BlockPart::turnX, BlockPart::turnY}) {
    ASSERT_TRUE(QTest::qWaitFor([&] { return view().resting(); }, kPatience));
    QTest::mouseClick(&view(), Qt::LeftButton, {}, on(part));
    type("=tilt");
    const Box bound = withVariables(bench().design(), {{"tilt", -20}}).value().block().placement->box();
    EXPECT_NEAR((bound.center() - middle).norm(), 0, 1e-9);
    const Eigen::Index axis = part == BlockPart::turnX ? 0 : 1;
    EXPECT_NEAR(bench().block().placement->rotation[axis], 5 * kDegree, 1e-12);
    bench().document().undoStack().undo();  // they would both hang on it
    ASSERT_TRUE(settle());
  }
}

TEST_F(BlockHandlesTest, AMiddleThatAnExpressionKeepsIsKeptWhereTheBlockIsPulledAfterwards) {
  openBlock("ripple-along");
  bench().editDesign("Variable", [](Design& design) { design.variables.push_back({"tilt", 10, -40, 40}); });
  ASSERT_TRUE(settle());
  ASSERT_TRUE(QTest::qWaitFor([&] { return view().resting(); }, kPatience));
  QTest::mouseClick(&view(), Qt::LeftButton, {}, on(BlockPart::turnZ));
  type("=tilt");
  const auto wanders = [&] {
    const Box bound = withVariables(bench().design(), {{"tilt", -20}}).value().block().placement->box();
    return (bound.center() - box().center()).norm();
  };
  EXPECT_NEAR(wanders(), 0, 1e-9);
  // Keys, another ring, a spoke and a face.
  for (const BlockPart part : {BlockPart::turnX, BlockPart::moveY, BlockPart::left}) {
    ASSERT_TRUE(settle());
    ASSERT_TRUE(QTest::qWaitFor([&] { return view().resting(); }, kPatience));
    QTest::mouseClick(&view(), Qt::LeftButton, {}, on(part));
    const Box before = box();
    press(Qt::Key_Up);
    EXPECT_NE(box(), before);
    EXPECT_NEAR(wanders(), 0, 1e-9) << int(part);
    EXPECT_TRUE(bench().design().bindings.contains("/stock/0/block/rotation_deg/2"));
  }
  // Two that turn it at once keep no middle: the corner stays.
  QTest::mouseClick(&view(), Qt::LeftButton, {}, on(BlockPart::turnX));
  type("=tilt/2");
  for (const char* axis : {"0", "1", "2"})
    EXPECT_FALSE(bench().design().bindings.contains(std::string("/stock/0/block/origin/") + axis));
  ASSERT_TRUE(settle());
  ASSERT_TRUE(QTest::qWaitFor([&] { return view().resting(); }, kPatience));
  QTest::mouseClick(&view(), Qt::LeftButton, {}, on(BlockPart::moveZ));
  press(Qt::Key_Up);
  const Box bound = withVariables(bench().design(), {{"tilt", -20}}).value().block().placement->box();
  EXPECT_EQ(bound.frame.origin, box().frame.origin);
  ASSERT_TRUE(settle());
}

TEST_F(BlockHandlesTest, SpokesMoveItsCorner) {
  openBlock("ripple-along");
  const Box was = placementOf(bench())->box();
  hover(handle(BlockPart::moveX));
  EXPECT_EQ(handles().text.substr(0, 10), "Corner X: ") << handles().text;
  for (const auto& [part, way] :
       {std::pair{BlockPart::moveX, 21.3}, {BlockPart::moveY, -12.2}, {BlockPart::moveZ, 7.7}}) {
    const int axis = int(part) - int(BlockPart::moveX);
    ASSERT_TRUE(QTest::qWaitFor([&] { return view().resting(); }, kPatience));
    ASSERT_NO_FATAL_FAILURE(pull(part, place(part) + way * Eigen::Vector3d::Unit(axis)));
    EXPECT_NEAR(box().frame.origin[axis] - was.frame.origin[axis], way, 2.1);
    EXPECT_NEAR(box().frame.origin[axis], std::round(box().frame.origin[axis]), 1e-9) << "whole millimetres";
    EXPECT_EQ(box().size, was.size);
    if (part == BlockPart::moveX) picture("block-handles-moved");
    release();
    EXPECT_EQ(bench().document().undoStack().undoText(), "Move block");
    ASSERT_TRUE(settle());
  }
  // Esc gives it up; numbers are typed; a face comes in line with an end of the surface.
  const Design before = bench().design();
  ASSERT_TRUE(QTest::qWaitFor([&] { return view().resting(); }, kPatience));
  ASSERT_NO_FATAL_FAILURE(pull(BlockPart::moveY, place(BlockPart::moveY) + 40 * Eigen::Vector3d::UnitY()));
  ASSERT_NE(bench().design(), before);
  press(Qt::Key_Escape);
  release();
  EXPECT_EQ(bench().design(), before);
  QTest::mouseClick(&view(), Qt::LeftButton, {}, on(BlockPart::moveY));
  type("-3,5");
  EXPECT_EQ(box().frame.origin.y(), -3.5);
  ASSERT_TRUE(settle());
}

TEST_F(BlockHandlesTest, TheArrowTurnsTheCuttingDirection) {
  openBlock("ripple-along");
  const Design before = bench().design();
  const Box was = placementOf(bench())->box();
  const Eigen::Vector3d foot = was.center() + 0.5 * was.size.z() * was.frame.normal;
  const double began = bench().shownCut()->setup->planes.direction().dot(was.frame.y);
  ASSERT_NEAR(began, 1, 1e-9) << "along y";
  const Eigen::Vector3d tip = place(BlockPart::direction) - foot;
  ASSERT_NO_FATAL_FAILURE(
      pull(BlockPart::direction, foot + Eigen::AngleAxisd(fromDegrees(-13), was.frame.normal) * tip));
  ASSERT_TRUE(bench().cut().direction);
  const Eigen::Vector3d now = *bench().cut().direction;
  EXPECT_NEAR(toDegrees(std::atan2(now.dot(was.frame.y), now.dot(was.frame.x))), 75, 1e-9);
  picture("block-handles-direction");
  release();
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().shown());
  press(Qt::Key_Up);
  EXPECT_NEAR((*bench().cut().direction - was.frame.y).norm(), 0, 1e-12) << "90°";
  EXPECT_EQ(bench().cut().direction->x(), 0) << "no digits of a sine are left";
  bench().document().undoStack().setIndex(0);
  EXPECT_EQ(bench().design(), before);
}

TEST_F(BlockHandlesTest, TheMastLeansThePlanes) {
  openBlock("ripple-along");
  const Design before = bench().design();
  const Box was = placementOf(bench())->box();
  ASSERT_NEAR(bench().shownCut()->setup->planes.direction().dot(was.frame.y), 1, 1e-9) << "along y, upright";
  const Eigen::Vector3d mast = place(BlockPart::lean) - was.center();
  EXPECT_NEAR(mast.normalized().dot(was.frame.normal), 1, 1e-9);
  hover(handle(BlockPart::lean));
  EXPECT_EQ(handles().text, "Lean of the planes: 0°");
  // The tops of the planes stay behind: they lean back, and the blade rises as it goes.
  ASSERT_NO_FATAL_FAILURE(
      pull(BlockPart::lean, was.center() + Eigen::AngleAxisd(fromDegrees(11), was.frame.x) * mast));
  ASSERT_TRUE(bench().cut().direction);
  const Eigen::Vector3d now = *bench().cut().direction;
  EXPECT_NEAR(
      (now - (std::cos(fromDegrees(10)) * was.frame.y + std::sin(fromDegrees(10)) * was.frame.normal)).norm(),
      0, 1e-9)
      << now.transpose();
  EXPECT_EQ(handles().text, "Lean of the planes: 10° (+10)");
  picture("block-handles-lean");
  release();
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_NEAR(bench().shownCut()->setup->planes.direction().dot(now), 1, 1e-9);
  EXPECT_EQ(bench().document().undoStack().undoText(), "Lean planes");
  // The arrow keeps the lean, and the mast the direction.
  ASSERT_NO_FATAL_FAILURE(press(Qt::Key_Down));
  EXPECT_NEAR(toDegrees(std::asin(bench().cut().direction->z())), 5, 1e-9);
  type("-7.5");
  EXPECT_NEAR(toDegrees(std::asin(bench().cut().direction->z())), -7.5, 1e-9);
  EXPECT_NEAR(bench().cut().direction->x(), 0, 1e-12);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  bench().document().undoStack().setIndex(0);
  EXPECT_EQ(bench().design(), before);
}

TEST_F(BlockHandlesTest, BlocksOfAGridKeepTheirSizesAndSayWhy) {
  openBlock("block-wall", "column-2");
  const Design before = bench().design();
  ASSERT_TRUE(before.grid);
  const QPoint face = on(BlockPart::front);
  ASSERT_EQ(view().handleAt(face), handle(BlockPart::front));
  QTest::mousePress(&view(), Qt::LeftButton, {}, face);
  EXPECT_FALSE(view().holding());
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("column-2 lies in a grid"))
      << window().statusBar()->currentMessage().toStdString();
  QTest::mouseMove(&view(), face + QPoint(-30, 30));
  release();
  EXPECT_EQ(bench().design(), before);
  hover(handle(BlockPart::front));
  EXPECT_TRUE(handles().stopped);
  picture("block-handles-grid");
  // Neither keys nor numbers do.
  press(Qt::Key_Up);
  type("700");
  EXPECT_EQ(bench().design(), before);
  // The direction is that of all of them.
  const Box was = placementOf(bench())->box();
  const Eigen::Vector3d foot = was.center() + 0.5 * was.size.z() * was.frame.normal;
  const Eigen::Vector3d tip = place(BlockPart::direction) - foot;
  ASSERT_NO_FATAL_FAILURE(
      pull(BlockPart::direction, foot + Eigen::AngleAxisd(fromDegrees(16), was.frame.normal) * tip));
  release();
  for (const Cut& cut : bench().design().cuts) {
    ASSERT_TRUE(cut.direction) << cut.id;
    EXPECT_EQ(*cut.direction, *bench().cut().direction) << cut.id;
  }
  EXPECT_TRUE(bench().design().grid) << "they still lie in it";
  ASSERT_TRUE(settle());
}

}  // namespace
}  // namespace bw::app
