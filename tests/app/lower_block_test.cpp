// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A block that reaches lower, so that the blade keeps the floor: what it comes to, and its button.
#include "bw/pipeline/lower_block.h"
#include "window_fixture.h"

namespace bw::app {
namespace {

using pipeline::goesOnBelow;
using pipeline::withLowerBlock;

Design blockOf(const BlockPlacement& placement, CutPose pose = {}) {
  Design design;
  design.block().placement = placement;
  design.cut().pose = pose;
  return design;
}

TEST(LowerBlock, ReachesLowerAsItLiesAndStaysElsewhere) {
  const BlockPlacement placed{{100, -50, 20}, {600, 800, 500}, {0.1, -0.2, 0.7}};
  for (const BlockFace up : {BlockFace::top, BlockFace::bottom, BlockFace::left, BlockFace::right,
                             BlockFace::front, BlockFace::back}) {
    const CutPose pose{up, 1};
    const Design design = blockOf(placed, pose);
    const std::optional<Design> lower = withLowerBlock(design, "cut-1", 12);
    ASSERT_TRUE(lower);
    const Box was = lying(placed.box(), pose), is = lying(lower->block().placement->box(), pose);
    EXPECT_NEAR(is.size.z(), was.size.z() + 12, 1e-9);
    EXPECT_NEAR((is.size - was.size).head<2>().norm(), 0, 1e-9);
    EXPECT_NEAR((is.frame.origin - (was.frame.origin - 12 * was.frame.normal)).norm(), 0, 1e-9);
    EXPECT_EQ(lower->block().placement->rotation, placed.rotation);
    EXPECT_EQ(lower->cuts, design.cuts);
  }
  Design around = blockOf(placed);
  around.block().placement.reset();
  EXPECT_FALSE(withLowerBlock(around, "cut-1", 12));
  EXPECT_FALSE(withLowerBlock(blockOf(placed), "another", 12));
  EXPECT_FALSE(withLowerBlock(blockOf(placed), "cut-1", 1e6)) << "no block is as large";
}

TEST(LowerBlock, IsNoneWhereSomethingLiesBelow) {
  Design design = blockOf({{0, 0, 500}, {600, 800, 500}});
  design.stock.push_back({"other", BlockPlacement{{600, 0, 0}, {600, 800, 1000}}});
  EXPECT_TRUE(withLowerBlock(design, "cut-1", 12)) << "one that stands beside it";
  design.stock[1].placement = BlockPlacement{{590, 0, 0}, {600, 800, 500}};
  EXPECT_FALSE(withLowerBlock(design, "cut-1", 12));
  design.stock[1].placement = BlockPlacement{{590, 0, 0}, {600, 800, 480}};
  EXPECT_TRUE(withLowerBlock(design, "cut-1", 12)) << "there is room enough";
  EXPECT_FALSE(withLowerBlock(design, "cut-1", 21));
}

TEST(LowerBlock, IsTheLowestLayerOfAGrid) {
  Design design;
  design.grid = BlockGrid{{0, 0, 0}, {0, 0, 0.3}, {{{600, 600}, {800}, {500, 400}}}, {{{0}, {}, {0}}}};
  design.stock = stockOf(*design.grid);
  Cut cut;
  cut.id = "c";
  design.cuts = cutsOf(design.stock, {cut}, {});
  const std::optional<Design> lower = withLowerBlock(design, "c-" + design.stock[1].id, 30);
  ASSERT_TRUE(lower && lower->grid);
  EXPECT_EQ(lower->stock, stockOf(*lower->grid));
  EXPECT_EQ(lower->grid->sizes[2], (std::vector<double>{530, 400}));
  EXPECT_EQ(lower->grid->origin, Eigen::Vector3d(0, 0, -30));
  // The layer above stays.
  EXPECT_EQ(lower->stock[2].placement->size, design.stock[2].placement->size);
  EXPECT_NEAR((lower->stock[2].placement->origin - design.stock[2].placement->origin).norm(), 0, 1e-9);
  EXPECT_FALSE(withLowerBlock(design, "c-" + design.stock[2].id, 30)) << "the layer below is there";
  // Turned another face up, what is below it belongs to its neighbours.
  for (Cut& one : design.cuts) one.pose.up = BlockFace::left;
  EXPECT_FALSE(withLowerBlock(design, design.cuts.front().id, 30));
}

TEST(LowerBlock, IsNotHelpedBySurfacesThatGoOnBelow) {
  const Box box = BlockPlacement{{0, 0, 0}, {600, 800, 500}}.box();
  const auto triangle = [](double z, double x) {
    return TriangleMesh{{{x, 0, 100}, {x + 50, 0, z}, {x, 50, 100}}, {}, {{0, 1, 2}}};
  };
  EXPECT_FALSE(goesOnBelow(triangle(10, 0), box));
  EXPECT_TRUE(goesOnBelow(triangle(-10, 0), box));
  EXPECT_FALSE(goesOnBelow(triangle(-10, 700), box)) << "beside the block";
  // Of a large one what counts is the part over the bottom.
  EXPECT_FALSE(goesOnBelow({{{-100, 400, 100}, {1300, 0, -40}, {1300, 800, -40}}, {}, {{0, 1, 2}}}, box));
  EXPECT_TRUE(goesOnBelow({{{-100, 400, 100}, {1200, 0, -90}, {1200, 800, -90}}, {}, {{0, 1, 2}}}, box));
}

class LowMessage : public WindowTest {
 protected:
  /// Moves the whole surface down, so that its lowest pole lies at that height.
  void sink(double lowest) {
    bench().editSurface("Lower surface", [=](DesignedSurface& surface) {
      auto& poles = std::get<PolesSurface>(surface.shape).poles;
      const double by = std::ranges::min_element(poles, {}, &SurfacePole::height)->height - lowest;
      for (SurfacePole& pole : poles) pole.height -= by;
    });
    ASSERT_TRUE(settle());
  }
  int floorLine() {
    const MessageList& list = window().messageList();
    for (int i = 0; i < list.count(); ++i)
      if (list.item(i)->text().contains("face that the block lies on")) return i;
    return -1;
  }
  QPushButton* offered(int line) {
    MessageList& list = window().messageList();
    list.scrollToItem(list.item(line));
    QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, list.visualItemRect(list.item(line)).center());
    return offered();
  }
  /// Of the message that was chosen.
  QPushButton* offered() {
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    for (QPushButton* button : window().messageList().parentWidget()->findChildren<QPushButton*>())
      if (button->isVisible() && button->text().contains(" lower")) return button;
    return nullptr;
  }
};

TEST_F(LowMessage, HasAButtonThatLetsTheBlockReachLower) {
  ASSERT_TRUE(window().openExample("single-block"));
  ASSERT_TRUE(settle());
  ASSERT_NO_FATAL_FAILURE(sink(5));
  ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  window().commands()["tab.messages"]->trigger();
  ASSERT_GE(floorLine(), 0);
  const QString text = window().messageList().item(floorLine())->text();
  ASSERT_TRUE(offered(floorLine())) << text.toStdString();
  // What becomes known a moment later leaves the message chosen, and its button.
  ASSERT_TRUE(settleInFull());
  theme().apply(model::ThemeChoice::dark);
  theme().apply(model::ThemeChoice::light);
  picture("floor-remedy");
  ASSERT_GE(floorLine(), 0);
  EXPECT_EQ(window().messageList().currentRow(), floorLine());
  QPushButton* button = offered();
  ASSERT_TRUE(button) << text.toStdString();
  const Design before = bench().design();
  const double by = button->text().section(' ', -3, -3).toDouble();
  EXPECT_GT(by, 0);
  EXPECT_TRUE(text.contains(QString("reaches %1 mm lower").arg(by))) << text.toStdString();
  const QString words = button->text();
  EXPECT_EQ(words, QString("Let the block reach %1 mm lower").arg(by));
  QTest::mouseClick(button, Qt::LeftButton);
  const BlockPlacement &was = *before.block().placement, &is = *bench().design().block().placement;
  EXPECT_EQ(is.size, was.size + Eigen::Vector3d(0, 0, by));
  EXPECT_EQ(is.origin, was.origin - Eigen::Vector3d(0, 0, by));
  EXPECT_EQ(bench().document().undoStack().undoText(), words);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  // The message is gone; another, of a way beside the stations, asks for no more than it says.
  for (int round = 0; round < 3 && floorLine() >= 0; ++round) {
    EXPECT_FALSE(window().messageList().item(floorLine())->text() == text);
    QPushButton* next = offered(floorLine());
    ASSERT_TRUE(next);
    QTest::mouseClick(next, Qt::LeftButton);
    ASSERT_TRUE(settle());
  }
  EXPECT_EQ(floorLine(), -1);
  bench().document().undoStack().setIndex(bench().document().undoStack().index() - 1);
  while (bench().document().undoStack().undoText() != "Lower surface") bench().document().undoStack().undo();
  EXPECT_EQ(bench().design(), before);
  // What is locked stays, and says so.
  ASSERT_TRUE(settle());
  bench().setLocked({Object::Kind::block, bench().block().id}, true);
  button = offered(floorLine());
  ASSERT_TRUE(button);
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_EQ(bench().design(), before);
  EXPECT_TRUE(window().banner().text().startsWith("Locked:")) << window().banner().text().toStdString();
}

TEST_F(LowMessage, HasNoneWhereTheSurfaceGoesOnBelow) {
  ASSERT_TRUE(window().openExample("single-block"));
  ASSERT_TRUE(settle());
  ASSERT_NO_FATAL_FAILURE(sink(-60));
  window().commands()["tab.messages"]->trigger();
  const int line = floorLine();
  ASSERT_GE(line, 0);
  EXPECT_FALSE(offered(line));
  const QString text = window().messageList().item(line)->text();
  EXPECT_TRUE(text.contains("the surface goes on below the block")) << text.toStdString();
  EXPECT_FALSE(text.contains("a block that reaches")) << text.toStdString();
}

}  // namespace
}  // namespace bw::app
