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
  // The menu stands at the right click, without a turn of the view.
  const Eigen::Vector3d eye = view().camera().position;
  QTest::mouseClick(&view(), Qt::RightButton, {}, at(1));
  auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
  ASSERT_TRUE(menu);
  EXPECT_EQ(view().camera().position, eye);
  EXPECT_EQ(handles().chosen, (std::vector<int>{1}));
  menu->grab().save(QString::fromStdString(BW_TEST_OUTPUT "/window/handle-menu.png"));
  EXPECT_TRUE(menu->actions().contains(command("handles.addPoint")));
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

TEST_F(HandleEdits, ThePanelAddsAndRemovesThem) {
  open("twist");
  const Design before = bench().design();
  const auto press = [&](QAbstractButton* button) {
    ASSERT_TRUE(button);
    QTest::mouseClick(button, Qt::LeftButton);
    QTest::qWait(20);  // the lines that were are on their way
  };
  ASSERT_NO_FATAL_FAILURE(press(find<QPushButton>("Add a section after 1")));
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
