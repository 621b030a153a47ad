// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A handle of a designed surface under the keyboard: arrow keys, and numbers typed beside it.

#include "window/handle_keys.h"
#include "bw/core/shape/blade_ends.h"
#include "handles_fixture.h"
#include "workflow/variable_fields.h"

namespace bw::app {
namespace {

class HandleKeysTest : public HandlesTest {
 protected:
  void click(int handle, Qt::KeyboardModifiers keys = {}) {
    QTest::mouseClick(&view(), Qt::LeftButton, keys, at(handle));
  }
  void press(Qt::Key key, Qt::KeyboardModifiers keys = {}) { QTest::keyClick(&view(), key, keys); }
  /// What has the keyboard gets the keys.
  void type(const QString& text) {
    for (const QChar c : text) QTest::keyClick(QApplication::focusWidget(), c.toLatin1());
  }
  void pressThere(Qt::Key key) { QTest::keyClick(QApplication::focusWidget(), key); }
  double height(int row = 2, int column = 1) {
    return std::get<PolesSurface>(bench().design().source().surface->shape).at(row, column).height;
  }
  Eigen::Vector2d point(int section, int index) {
    return std::get<SectionsSurface>(bench().design().source().surface->shape)
        .sections[std::size_t(section)]
        .points[std::size_t(index)];
  }
  int steps() { return bench().document().undoStack().index(); }
  const QFrame& field() { return window().handleKeys().field(); }

  static constexpr int kPole = 2 * 4 + 1;  // pole 2 of row 3
};

TEST_F(HandleKeysTest, ArrowsMoveTheHandleChosenAndEscapeTakesItBack) {
  open("single-block");
  const Design before = bench().design();
  press(Qt::Key_Up);
  EXPECT_EQ(bench().design(), before) << "nothing is chosen";
  ASSERT_EQ(height(), 340);
  click(kPole);
  for (int i = 0; i < 3; ++i) press(Qt::Key_Up);
  EXPECT_EQ(height(), 343);
  press(Qt::Key_Down);
  EXPECT_EQ(height(), 342);
  press(Qt::Key_Up, Qt::ControlModifier);
  EXPECT_EQ(height(), 342.1) << "fine, as with the mouse";
  press(Qt::Key_Up, Qt::ShiftModifier);
  EXPECT_EQ(height(), 350) << "the next round number";
  press(Qt::Key_Up, Qt::ShiftModifier);
  EXPECT_EQ(height(), 360);
  press(Qt::Key_Up, Qt::AltModifier);
  EXPECT_NEAR(height(), 360.1, 1e-9);
  press(Qt::Key_Down);
  EXPECT_EQ(height(), 360);
  press(Qt::Key_Left);
  press(Qt::Key_Right);
  EXPECT_EQ(height(), 360) << "a pole stands where it stands";
  EXPECT_NE(handles().text.find("Pole 2 of row 3: 360"), std::string::npos) << handles().text;
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  picture("handle-nudged");
  EXPECT_EQ(steps(), 1) << "one step for all of them";
  // Back to where it was, as if nothing had been.
  press(Qt::Key_Escape);
  EXPECT_EQ(bench().design(), before);
  EXPECT_FALSE(bench().document().undoStack().canUndo());
  // Once more Esc chooses nothing, and arrows move nothing.
  ASSERT_TRUE(settle());
  press(Qt::Key_Escape);
  EXPECT_TRUE(handles().chosen.empty());
  press(Qt::Key_Up);
  EXPECT_EQ(bench().design(), before);
}

TEST_F(HandleKeysTest, ArrowsStopWhereTheSurfaceCanNoLongerBeCut) {
  open("single-block");
  click(kPole);
  press(Qt::Key_Up);
  const auto& reach = bench().runner().reach();
  ASSERT_TRUE(QTest::qWaitFor([&] { return reach && reach->ends[1].bar != pipeline::Bar::none; }, kPatience));
  for (int i = 0; i < 40; ++i) {
    press(Qt::Key_Up, Qt::ShiftModifier);
    QTest::qWait(10);
  }
  ASSERT_TRUE(QTest::qWaitFor([&] { return handles().stopped; }, kPatience));
  EXPECT_NE(handles().text.find("Goes no farther"), std::string::npos) << handles().text;
  EXPECT_LE(height(), 340 + reach->ends[1].free + 1e-9);
  EXPECT_GT(height(), 345);
  EXPECT_NEAR(std::remainder(height(), 10), 0, 1e-9) << "the last round number before it";
  // Finer steps lead nearer to it, and no farther, as soon as it is known to the end.
  ASSERT_TRUE(settle());
  for (int i = 0; i < 15; ++i) press(Qt::Key_Up);
  EXPECT_LE(height(), 340 + reach->ends[1].free + 1e-9);
  ASSERT_TRUE(settle());
  // Meanwhile the border may have been found a little farther on: then the next steps lead there.
  for (int i = 0; i < 15 && !handles().stopped; ++i) {
    press(Qt::Key_Up);
    ASSERT_TRUE(settle());
    QTest::qWait(100);
  }
  EXPECT_TRUE(handles().stopped);
  EXPECT_LE(height(), 340 + reach->ends[1].free + 1e-9);
  picture("handle-nudged-to-the-border");
  ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_LE(bench().sweep()->analysis.summary.deviationMax, bench().design().process.tolerance);
  EXPECT_EQ(steps(), 1);
  press(Qt::Key_Escape);
  EXPECT_EQ(height(), 340);
  EXPECT_FALSE(handles().stopped);
}

TEST_F(HandleKeysTest, ATypedNumberComesBackToTheBorderAndAnExpressionDoesNot) {
  open("single-block");
  click(kPole);
  type("900");
  pressThere(Qt::Key_Return);
  ASSERT_TRUE(QTest::qWaitFor([&] { return handles().stopped; }, kPatience));
  EXPECT_NE(handles().text.find("Goes no farther"), std::string::npos) << handles().text;
  // While its border is looked at once more it stays there.
  const auto& reach = bench().runner().reach();
  double highest = height();
  const auto watch =
      QObject::connect(&bench(), &Workbench::changed, [&] { highest = std::max(highest, height()); });
  ASSERT_TRUE(QTest::qWaitFor([&] { return reach && reach->ends[1].known; }, kPatience));
  EXPECT_LE(highest, 340 + reach->ends[1].free + 1e-9);
  QObject::disconnect(watch);
  ASSERT_TRUE(settle());
  EXPECT_GT(height(), 340 + reach->ends[1].free - 1.5);
  picture("handle-typed-beyond");
  EXPECT_LE(height(), 340 + reach->ends[1].free + 1e-9);
  EXPECT_EQ(height(), std::round(height()));
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_EQ(steps(), 1);
  // The field tells what came of it.
  const double border = height();
  press(Qt::Key_Return);
  EXPECT_EQ(find<NumberField>("Height of pole 2 of row 3")->value(), border);
  pressThere(Qt::Key_Escape);
  bench().document().undoStack().undo();
  EXPECT_EQ(height(), 340);
  // What is meant as an expression is not cut short.
  type("=900");
  pressThere(Qt::Key_Return);
  EXPECT_EQ(height(), 900);
  ASSERT_TRUE(settle());
  QTest::qWait(300);
  EXPECT_EQ(height(), 900);
  EXPECT_EQ(find<NumberField>("pole 2 of row 3")->expression(), "900");
}

TEST_F(HandleKeysTest, SymmetryAndGridAreRemembered) {
  open("single-block");
  window().commands()["handles.symmetric"]->trigger();
  window().commands()["handles.grid25"]->trigger();
  makeWindow({1440, 900});
  open("single-block");
  EXPECT_TRUE(window().commands()["handles.symmetric"]->isChecked());
  EXPECT_TRUE(window().commands()["handles.snap"]->isChecked());
  EXPECT_TRUE(window().commands()["handles.grid25"]->isChecked());
  const double other = height(2, 2);
  click(kPole);
  press(Qt::Key_Up);
  EXPECT_EQ(height(), 350);
  EXPECT_EQ(height(2, 2), other + 10);
  // A spacing that somebody wrote there and that is none is not taken.
  QSettings(QSettings::IniFormat, QSettings::UserScope, "bladewright", "bladewright")
      .setValue("handles/grid", -3);
  EXPECT_EQ(model::Settings().handles().grid, 10);
}

TEST_F(HandleKeysTest, UndoEndsWhatEscapeTakesBack) {
  open("single-block");
  click(kPole);
  press(Qt::Key_Up);
  press(Qt::Key_Up);
  bench().document().undoStack().undo();
  ASSERT_EQ(height(), 340);
  press(Qt::Key_Up);
  EXPECT_EQ(height(), 341);
  bench().editDesign("Another", [](Design& design) { design.process.clearance = 60; });
  press(Qt::Key_Up);
  EXPECT_EQ(height(), 342);
  press(Qt::Key_Escape);
  EXPECT_EQ(height(), 341);
  EXPECT_EQ(bench().design().process.clearance, 60);
}

TEST_F(HandleKeysTest, ANumberTypedOpensAFieldBesideTheHandle) {
  open("single-block");
  click(kPole);
  const scene::Camera camera = view().camera();
  type("3");
  ASSERT_TRUE(field().isVisible()) << "3 is the front view only where nothing is chosen";
  type("5");
  picture("handle-typed");
  EXPECT_TRUE(view().rect().contains(field().geometry()));
  EXPECT_EQ(height(), 340) << "not before it is finished";
  type("2.25");
  pressThere(Qt::Key_Return);
  EXPECT_EQ(height(), 352.25);
  EXPECT_FALSE(field().isVisible());
  EXPECT_TRUE(view().hasFocus());
  EXPECT_EQ(view().camera().position, camera.position);
  EXPECT_EQ(steps(), 1);
  // Enter shows the number; units and sums are understood as everywhere.
  press(Qt::Key_Return);
  ASSERT_TRUE(field().isVisible());
  EXPECT_EQ(find<NumberField>("Height of pole 2 of row 3")->text(), "352.25");
  type("36 cm + 5mm");
  pressThere(Qt::Key_Return);
  EXPECT_EQ(height(), 365);
  // Esc drops what is typed.
  press(Qt::Key_Return);
  type("12");
  pressThere(Qt::Key_Escape);
  EXPECT_FALSE(field().isVisible());
  EXPECT_EQ(height(), 365);
  // What is refused stays in sight, and is no part of the design.
  press(Qt::Key_Return);
  type("12 kg");
  pressThere(Qt::Key_Return);
  EXPECT_TRUE(field().isVisible());
  EXPECT_TRUE(find<NumberField>("Height of pole 2 of row 3")->refused());
  picture("handle-refused");
  pressThere(Qt::Key_Escape);
  EXPECT_FALSE(field().isVisible());
  EXPECT_EQ(refusedField(window()), nullptr);
  EXPECT_EQ(steps(), 2);
}

TEST_F(HandleKeysTest, AnExpressionTypedThereBindsTheHandle) {
  open("single-block");
  auto* fresh = find<NewVariableField>("New variable");
  ASSERT_TRUE(fresh);
  fresh->setFocus();
  type("rise = 20 mm, 0 to 60");
  pressThere(Qt::Key_Return);
  click(kPole);
  type("=320 + rise");
  pressThere(Qt::Key_Return);
  EXPECT_EQ(bench().design().bindings.at("/sources/0/surface/poles/2/1").text, "320 + rise");
  EXPECT_EQ(find<NumberField>("pole 2 of row 3")->expression(), "320 + rise");
  press(Qt::Key_Return);
  EXPECT_EQ(find<NumberField>("Height of pole 2 of row 3")->text(), "=320 + rise");
  picture("handle-expression");
  pressThere(Qt::Key_Escape);
  EXPECT_EQ(withVariables(bench().design(), {{"rise", 30}}).value().bindings.size(), 1u);
  // An arrow frees it, and Esc binds it again.
  press(Qt::Key_Up);
  EXPECT_EQ(height(), 341);
  EXPECT_EQ(find<NumberField>("pole 2 of row 3")->expression(), "");
  press(Qt::Key_Escape);
  EXPECT_EQ(find<NumberField>("pole 2 of row 3")->expression(), "320 + rise");
  // So does another number, and the same number.
  type("360");
  pressThere(Qt::Key_Return);
  EXPECT_EQ(height(), 360);
  EXPECT_EQ(find<NumberField>("pole 2 of row 3")->expression(), "");
  press(Qt::Key_Escape);
  EXPECT_EQ(height(), 340);
  EXPECT_EQ(find<NumberField>("pole 2 of row 3")->expression(), "320 + rise");
  type("340");
  pressThere(Qt::Key_Return);
  EXPECT_EQ(find<NumberField>("pole 2 of row 3")->expression(), "");
  EXPECT_TRUE(bench().design().bindings.empty());
}

TEST_F(HandleKeysTest, TheHeightOfAnEndOfAKeyBladeTakesAnExpression) {
  open("key-blade-fan");
  const auto ends = [&] {
    return bladeEnds(std::get<BladesSurface>(bench().design().source().surface->shape).blades[0]).value();
  };
  const auto expression = [&](const char* name) {
    auto* shown = find<NumberField>(name);
    return shown ? shown->expression() : QString("there is no such field");
  };
  const Eigen::Vector2d right = ends()[1];
  const Design before = bench().design();
  EXPECT_EQ(expression("Lean of key blade 1"), "-lean");
  click(4);
  type("=height - 40");
  pressThere(Qt::Key_Return);
  const std::string place = "/sources/0/surface/blades/0/end_heights/0";
  ASSERT_TRUE(bench().design().bindings.contains(place));
  EXPECT_EQ(bench().design().bindings.at(place).text, "height - 40");
  EXPECT_NEAR(ends()[0].y(), 250, 1e-9);
  EXPECT_LT((ends()[1] - right).norm(), 1e-9) << "the other end stays";
  EXPECT_EQ(expression("−x end z of key blade 1"), "height - 40");
  EXPECT_EQ(expression("+x end z of key blade 1"), "");
  EXPECT_EQ(expression("Lean of key blade 1"), "") << "which the end turns";
  EXPECT_EQ(expression("Lean of key blade 2"), "-lean/3");
  press(Qt::Key_Return);
  EXPECT_EQ(find<NumberField>("Height of −x end of key blade 1")->text(), "=height - 40");
  picture("handle-end-expression");
  pressThere(Qt::Key_Escape);
  // It follows its variable, and keeps its height where the blade is made longer.
  const Design other = withVariables(bench().design(), {{"height", 300}}).value();
  EXPECT_NEAR(bladeEnds(std::get<BladesSurface>(other.source().surface->shape).blades[0]).value()[0].y(), 260,
              1e-9);
  auto* length = find<NumberField>("Length of key blade 1");
  length->setFocus();
  length->selectAll();
  type("640");
  pressThere(Qt::Key_Return);
  EXPECT_EQ(std::get<BladesSurface>(bench().design().source().surface->shape).blades[0].length, 640);
  EXPECT_NEAR(ends()[0].y(), 250, 1e-9);
  EXPECT_EQ(expression("−x end z of key blade 1"), "height - 40");
  // An expression in the other field of the same end, and one for the middle, which frees the ends.
  auto* left = find<NumberField>("−x end z of key blade 1");
  left->setFocus();
  left->selectAll();
  type("=height - 30");
  pressThere(Qt::Key_Return);
  EXPECT_NEAR(ends()[0].y(), 260, 1e-9);
  auto* middle = find<NumberField>("Middle z of key blade 1");
  middle->setFocus();
  middle->selectAll();
  type("=height");
  pressThere(Qt::Key_Return);
  EXPECT_EQ(expression("Middle z of key blade 1"), "height");
  EXPECT_EQ(expression("−x end z of key blade 1"), "");
  ASSERT_TRUE(bench().saveTo(path("fan.bladewright")));
  EXPECT_TRUE(loadDesign(path("fan.bladewright")));
  // What cannot be is told, and nothing changes.
  const Design now = bench().design();
  for (const char* text : {"=2000", "2000"}) {
    auto* high = find<NumberField>("−x end z of key blade 1");
    high->setFocus();
    high->selectAll();
    type(text);
    pressThere(Qt::Key_Return);
    EXPECT_EQ(bench().design(), now) << text;
    EXPECT_TRUE(window().banner().text().contains("mm apart")) << window().banner().text().toStdString();
    EXPECT_NEAR(high->value(), ends()[0].y(), 1e-9);
  }
  bench().document().undoStack().setIndex(0);
  EXPECT_EQ(bench().design(), before);
  EXPECT_EQ(expression("Lean of key blade 1"), "-lean");
}

TEST_F(HandleKeysTest, SeveralHandlesMoveByAsMuchAsTheLast) {
  open("single-block");
  const double other = height(3, 2);
  click(3 * 4 + 2);
  click(kPole, Qt::ShiftModifier);
  type("350");
  pressThere(Qt::Key_Return);
  EXPECT_EQ(height(), 350);
  EXPECT_EQ(height(3, 2), other + 10);
  press(Qt::Key_Up);
  EXPECT_EQ(height(), 351);
  EXPECT_EQ(height(3, 2), other + 11);
  // A click elsewhere chooses none of them any more.
  QTest::mouseClick(&view(), Qt::LeftButton, {}, QPoint(20, view().height() - 20));
  EXPECT_TRUE(handles().chosen.empty());
}

TEST_F(HandleKeysTest, PointsOfSectionsMoveAcrossToo) {
  open("twist");
  ASSERT_TRUE(window().surfaceHandles().possible());
  const int handle = 1;
  const Eigen::Vector2d before = point(0, handle);
  click(handle);
  press(Qt::Key_Right, Qt::AltModifier);
  press(Qt::Key_Up);
  EXPECT_GT(point(0, handle).x(), before.x());
  EXPECT_GT(point(0, handle).y(), before.y());
  press(Qt::Key_Escape);
  EXPECT_EQ(point(0, handle), before);
  press(Qt::Key_Return);
  auto* across = find<NumberField>("x of point 2 of section 1");
  ASSERT_TRUE(across);
  across->setFocus();
  across->selectAll();
  QTest::keyClicks(across, QString::number(before.x() + 5));
  QTest::keyClick(across, Qt::Key_Tab);
  EXPECT_NEAR(point(0, handle).x(), before.x() + 5, 1e-9);
  EXPECT_TRUE(field().isVisible()) << "the next number is in it";
  EXPECT_TRUE(find<NumberField>("Height of point 2 of section 1")->hasFocus());
  picture("handle-typed-point");
  pressThere(Qt::Key_Return);
  EXPECT_FALSE(field().isVisible());
}

}  // namespace
}  // namespace bw::app
