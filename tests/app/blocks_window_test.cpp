// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A design of several blocks in the window.

#include <algorithm>

#include "controls/fields.h"
#include "window_fixture.h"

namespace bw::app {
namespace {

class BlocksInTheWindow : public WindowTest {
 protected:
  void open() {
    ASSERT_TRUE(window().openExample("three-block-wall"));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  }
  void type(const QString& name, const QString& text) {
    auto* field = find<NumberField>(name);
    ASSERT_TRUE(field) << name.toStdString();
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
  }
  const pipeline::Evaluation& shown() { return *bench().shown(); }
};

TEST_F(BlocksInTheWindow, OpensWithAllOfThem) {
  open();
  ASSERT_EQ(shown().blocks.size(), 3u);
  EXPECT_TRUE(shown().complete());
  EXPECT_EQ(bench().selection().cut, "cut-column-1");
  EXPECT_EQ(stationCount(), 33u);
  for (const Finding& finding : shown().findings()) EXPECT_EQ(finding.severity, Severity::info);
  picture("three-block-wall");
  // What is clicked is what the numbers are of.
  bench().select({Selection::Kind::station, 4, "column-3", "cut-column-3"});
  ASSERT_TRUE(bench().sweep());
  EXPECT_EQ(&bench().sweep()->sweep, shown().blocks[2].cuts[0].sweep.value.get());
  picture("three-block-wall-third");
}

TEST_F(BlocksInTheWindow, FollowItsVariablesAndItsStationsTogether) {
  open();
  type("width", "560");
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_EQ(bench().design().stock[2].placement->origin.x(), 1120);
  EXPECT_EQ(shown().blocks[2].cuts[0].setup->block.frame.origin.x(), 1120);
  EXPECT_LT(shown().joints.value->gapMax(), 0.1);
  type("Number", "21");
  ASSERT_TRUE(settle());
  for (const pipeline::BlockEvaluation& block : shown().blocks)
    EXPECT_EQ(block.cuts[0].sweep.value->poses.size(), 21u) << block.id;
  const fs::path file = path("wall.bladewright");
  ASSERT_TRUE(bench().saveTo(file));
  EXPECT_EQ(loadDesign(file).value(), bench().design());
  EXPECT_TRUE(loadDesign(file)->grid);
  bench().document().undoStack().setIndex(0);
  ASSERT_TRUE(settle());
  EXPECT_EQ(stationCount(), 33u);
  EXPECT_EQ(shown().blocks[2].cuts[0].setup->block.frame.origin.x(), 1200);
}

TEST_F(BlocksInTheWindow, KeepABlockThatWasMovedAsAList) {
  open();
  bench().editBlock("Move block", [](StockBlock& block) { block.placement->origin.z() = -10; });
  ASSERT_TRUE(settle());
  EXPECT_FALSE(bench().design().grid);
  const fs::path file = path("moved.bladewright");
  ASSERT_TRUE(bench().saveTo(file));
  EXPECT_EQ(loadDesign(file)->stock, bench().design().stock);
  bench().document().undoStack().undo();
  EXPECT_TRUE(bench().design().grid);
}

TEST_F(BlocksInTheWindow, AreExportedAllTogether) {
  open();
  const fs::path folder = path("out");
  bench().exportAll(folder, {});
  ASSERT_TRUE(settle());
  ASSERT_TRUE(QTest::qWaitFor([&] { return fs::exists(folder / "report.html"); }, kPatience));
  for (const char* name : {"surface-strip-2.iges", "mesh.stl", "surface.step", "report.pdf",
                           "programs/column-2/strip-1/T_ROB1/BladeLeft.mod"})
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  const std::string page = readFile(folder / "report.html", 1 << 24).value();
  EXPECT_NE(page.find("Stations of column-3"), std::string::npos);
  EXPECT_NE(page.find("Widest gap between neighbouring blocks"), std::string::npos);
}

}  // namespace
}  // namespace bw::app
