// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Handles that move with their mirror image and from line to line of a grid, and sections and points that are
// added and taken away.

#include <QMenu>
#include <QScrollArea>
#include <QToolButton>

#include "handles_fixture.h"

namespace bw::app {
namespace {

class HandleEdits : public HandlesTest {
 protected:
  void click(int handle) { QTest::mouseClick(&view(), Qt::LeftButton, {}, at(handle)); }
  void press(Qt::Key key, Qt::KeyboardModifiers keys = {}) { QTest::keyClick(&view(), key, keys); }
  void pull(int handle, int up) {
    const QPoint from = at(handle);
    QTest::mousePress(&view(), Qt::LeftButton, {}, from);
    for (int i = 1; i <= 5; ++i) QTest::mouseMove(&view(), from - QPoint(0, up * i / 5));
    QTest::mouseRelease(&view(), Qt::LeftButton, {}, from - QPoint(0, up));
  }
  double height(int row, int column) {
    return std::get<PolesSurface>(bench().design().source().surface->shape).at(row, column).height;
  }
  const std::vector<SectionCurve>& sections() {
    return std::get<SectionsSurface>(bench().design().source().surface->shape).sections;
  }
  /// A right click on a handle, and one on a line of the menu that opens there.
  void chooseFromMenu(int handle, const char* id) {
    QTest::mouseClick(&view(), Qt::RightButton, {}, at(handle));
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    ASSERT_TRUE(menu);
    ASSERT_TRUE(menu->actions().contains(command(id)) && command(id)->isEnabled());
    QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(command(id)).center());
  }
  /// Of the commands, with its menu and its key.
  QAction* command(const char* id) { return window().commands()[id]; }

  static constexpr int kPole = 2 * 4 + 1, kMirror = 2 * 4 + 2;  // poles 2 and 3 of row 3
};

TEST_F(HandleEdits, TheMirrorImageMovesWithItsHandle) {
  open("single-block");
  const double a = height(2, 1), b = height(2, 2);
  press(Qt::Key_M);
  EXPECT_TRUE(command("handles.symmetric")->isChecked());
  pull(kPole, 20);
  EXPECT_GT(height(2, 1), a + 3);
  EXPECT_NEAR(height(2, 2) - b, height(2, 1) - a, 1e-9);
  EXPECT_EQ(handles().chosen, (std::vector<int>{kPole, kMirror}));
  ASSERT_TRUE(settle());
  picture("handle-symmetric");
  const double before = height(2, 2);
  press(Qt::Key_Up);
  EXPECT_EQ(height(2, 2), before + 1);
  press(Qt::Key_M);
  press(Qt::Key_Up);
  EXPECT_EQ(height(2, 2), before + 1) << "alone again";
  bench().document().undoStack().setIndex(0);
  EXPECT_EQ(height(2, 1), a);
  EXPECT_EQ(height(2, 2), b);
}

TEST_F(HandleEdits, PointsOfASectionMirrorAcross) {
  open("twist");
  press(Qt::Key_M);
  const std::size_t last = sections()[0].points.size() - 1;
  const Eigen::Vector2d a = sections()[0].points[1], b = sections()[0].points[last - 1];
  click(1);
  press(Qt::Key_Right);
  press(Qt::Key_Up);
  const Eigen::Vector2d by = sections()[0].points[1] - a;
  EXPECT_GT(by.x(), 0);
  EXPECT_NEAR(sections()[0].points[last - 1].x() - b.x(), -by.x(), 1e-9);
  EXPECT_NEAR(sections()[0].points[last - 1].y() - b.y(), by.y(), 1e-9);
}

TEST_F(HandleEdits, AGridIsSnappedTo) {
  open("single-block");
  command("handles.grid25")->trigger();
  EXPECT_TRUE(command("handles.snap")->isChecked());
  EXPECT_TRUE(command("handles.grid25")->isChecked());
  pull(kPole, 12);
  EXPECT_NEAR(std::remainder(height(2, 1), 25), 0, 1e-9);
  EXPECT_NE(height(2, 1), 340);
  const double before = height(2, 1);
  press(Qt::Key_Up);
  EXPECT_EQ(height(2, 1), before + 25);
  press(Qt::Key_Up, Qt::AltModifier);
  EXPECT_NEAR(height(2, 1), before + 25.1, 1e-9) << "fine ones are free of it";
  press(Qt::Key_G);
  EXPECT_FALSE(command("handles.snap")->isChecked());
  press(Qt::Key_Down);
  EXPECT_EQ(height(2, 1), before + 25);
  press(Qt::Key_Down);
  EXPECT_EQ(height(2, 1), before + 24);
}

TEST_F(HandleEdits, AMenuAtTheHandleAddsAndRemovesWhatIsOfIt) {
  open("twist");
  const Design before = bench().design();
  const std::size_t points = sections()[0].points.size();
  ASSERT_FALSE(command("handles.addPoint")->isEnabled()) << "nothing is chosen";
  EXPECT_TRUE(command("handles.addPoint")->toolTip().endsWith("Not now: no handle is chosen."));
  // The menu stands at the right click, without a turn of the view.
  const Eigen::Vector3d eye = view().camera().position;
  QTest::mouseClick(&view(), Qt::RightButton, {}, at(1));
  auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
  ASSERT_TRUE(menu);
  EXPECT_EQ(view().camera().position, eye);
  EXPECT_EQ(handles().chosen, (std::vector<int>{1}));
  menu->grab().save(QString::fromStdString(BW_TEST_OUTPUT "/window/handle-menu.png"));
  EXPECT_TRUE(menu->actions().contains(command("handles.addPoint")));
  EXPECT_TRUE(command("handles.addPoint")->toolTip().endsWith("(Ins)"));
  QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(command("handles.addPoint")).center());
  ASSERT_GT(sections()[0].points.size(), points);
  ASSERT_EQ(handles().chosen.size(), 1u) << "the new one is chosen";
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  picture("handle-point-added");
  view().setFocus();
  press(Qt::Key_Delete);
  EXPECT_EQ(sections()[0].points.size(), points);
  bench().document().undoStack().undo();
  EXPECT_GT(sections()[0].points.size(), points);
  bench().document().undoStack().setIndex(0);
  EXPECT_EQ(bench().design(), before);
  // A section more and less.
  click(1);
  command("handles.addSection")->trigger();
  ASSERT_EQ(sections().size(), 4u);
  EXPECT_GT(sections()[1].y, sections()[0].y);
  EXPECT_LT(sections()[1].y, sections()[2].y);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  picture("handle-section-added");
  EXPECT_EQ(bench().design().bindings.size(), before.bindings.size());
  command("handles.removeSection")->trigger();
  EXPECT_EQ(sections().size(), 3u);
  EXPECT_EQ(bench().design(), before);
}

TEST_F(HandleEdits, ASectionIsDuplicatedAlongTheWall) {
  open("twist");
  const Design before = bench().design();
  EXPECT_FALSE(command("handles.duplicate")->isEnabled()) << "nothing is chosen";
  chooseFromMenu(1, "handles.duplicate");
  ASSERT_EQ(sections().size(), 4u);
  EXPECT_EQ(sections()[1].y, 200) << "halfway to the next one";
  EXPECT_EQ(sections()[1].points, sections()[0].points);
  EXPECT_EQ(handles().chosen, std::vector<int>{4 + 1}) << "the same point of the new one is chosen";
  EXPECT_EQ(bench().document().undoStack().undoText(), "Duplicate section 1");
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  picture("handle-section-duplicated");
  // Its expressions are those of the other.
  const double lean = sections()[1].points[0].y();
  bench().editDesign("Lean", [](Design& design) { design = withVariables(design, {{"lean", 30}}).value(); });
  EXPECT_EQ(sections()[1].points[0].y(), lean + 40);
  EXPECT_EQ(sections()[1].points, sections()[0].points);
  ASSERT_TRUE(settle());
  bench().document().undoStack().setIndex(0);
  EXPECT_EQ(bench().design(), before);
  ASSERT_TRUE(settle());
  // The last one goes on beyond.
  chooseFromMenu(2 * 4 + 1, "handles.duplicate");
  ASSERT_EQ(sections().size(), 4u);
  EXPECT_EQ(sections()[3].y, 1200);
  EXPECT_EQ(sections()[3].points, sections()[2].points);
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design(), before);
  ASSERT_TRUE(settle());
}

TEST_F(HandleEdits, AShapeIsCopiedToTheOthersChosen) {
  open("twist");
  Design before = bench().design();
  click(1);
  EXPECT_FALSE(command("handles.copyShape")->isEnabled()) << "one alone";
  QTest::mouseClick(&view(), Qt::LeftButton, Qt::ShiftModifier, at(2 * 4 + 1));
  chooseFromMenu(2 * 4 + 1, "handles.copyShape");
  EXPECT_EQ(sections()[0].points, sections()[2].points) << "that of the last one";
  EXPECT_NE(sections()[1].points, sections()[2].points);
  EXPECT_EQ(sections()[0].y, 0);
  EXPECT_EQ(handles().chosen, (std::vector<int>{1, 2 * 4 + 1}));
  EXPECT_EQ(bench().document().undoStack().undoText(), "Copy shape of section 3");
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  picture("handle-shape-copied");
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design(), before);
  // Rows of poles.
  open("single-block");
  before = bench().design();
  click(kPole);
  EXPECT_FALSE(command("handles.duplicate")->isEnabled()) << "rows lie evenly";
  QTest::mouseClick(&view(), Qt::LeftButton, Qt::ShiftModifier, at(3 * 4 + 1));
  QTest::mouseClick(&view(), Qt::LeftButton, Qt::ShiftModifier, at(4 * 4 + 2));
  command("handles.copyShape")->trigger();
  for (int column = 0; column < 4; ++column)
    for (const int row : {2, 3}) EXPECT_EQ(height(row, column), height(4, column));
  EXPECT_EQ(height(5, 1), 320);
  EXPECT_EQ(bench().document().undoStack().undoText(), "Copy shape of row 5");
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design(), before);
}

TEST_F(HandleEdits, AKeyBladeIsDuplicatedAndCopied) {
  open("key-blade-fan");
  const Design before = bench().design();
  const auto blades = [&] {
    return std::get<BladesSurface>(bench().design().source().surface->shape).blades;
  };
  const std::vector<KeyBlade> were = blades();
  chooseFromMenu(1, "handles.duplicate");
  ASSERT_EQ(blades().size(), 5u);
  KeyBlade alike = were[1];
  alike.y = 0.5 * (were[1].y + were[2].y);
  EXPECT_EQ(blades()[2], alike);
  EXPECT_EQ(handles().chosen, std::vector<int>{2});
  EXPECT_EQ(bench().document().undoStack().undoText(), "Duplicate key blade 2");
  ASSERT_TRUE(settle());
  picture("handle-key-blade-duplicated");
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design(), before);
  click(0);
  QTest::mouseClick(&view(), Qt::LeftButton, Qt::ShiftModifier, at(1));
  command("handles.copyShape")->trigger();
  alike.y = were[0].y;
  EXPECT_EQ(blades()[0], alike);
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design(), before);
  ASSERT_TRUE(settle());
}

TEST_F(HandleEdits, ThePanelAddsAndRemovesThem) {
  open("twist");
  const Design before = bench().design();
  const auto press = [&](QAbstractButton* button) {
    ASSERT_TRUE(button);
    QTest::mouseClick(button, Qt::LeftButton);
    QTest::qWait(20);  // the lines that were are on their way
  };
  ASSERT_NO_FATAL_FAILURE(press(find<QPushButton>("Add a section after section 1")));
  ASSERT_EQ(sections().size(), 4u);
  EXPECT_TRUE(find<QPushButton>("Remove section 4"));
  ASSERT_NO_FATAL_FAILURE(press(find<QPushButton>("Add a point to section 2")));
  const std::size_t points = sections()[1].points.size();
  EXPECT_GT(points, before.source().surface ? 4u : 0u);
  for (QWidget* at = find<QPushButton>("Add a point to section 2"); at; at = at->parentWidget())
    if (auto* area = qobject_cast<QScrollArea*>(at))
      area->ensureWidgetVisible(find<QPushButton>("Add a point to section 2"));
  picture("design-section-buttons");
  EXPECT_TRUE(view().hasFocus()) << "the button that had the keyboard is gone";
  ASSERT_NO_FATAL_FAILURE(press(find<QToolButton>("Remove point 4 of section 2")));
  EXPECT_LT(sections()[1].points.size(), points);
  ASSERT_NO_FATAL_FAILURE(press(find<QPushButton>("Remove section 2")));
  EXPECT_EQ(bench().design(), before);
  ASSERT_NO_FATAL_FAILURE(press(find<QPushButton>("Remove section 2")));
  ASSERT_EQ(sections().size(), 2u);
  EXPECT_FALSE(find<QPushButton>("Remove section 1")->isEnabled());
  bench().document().undoStack().setIndex(0);
  EXPECT_EQ(bench().design(), before);
}

}  // namespace
}  // namespace bw::app
