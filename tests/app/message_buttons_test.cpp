// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Buttons of messages that reach beyond the cut selected: more stations where blocks meet, and a block that
// is split across the blade.

#include <algorithm>
#include <set>

#include "bw/core/blade/cutting_limits.h"
#include "bw/core/design/grid_change.h"
#include "bw/pipeline/example_design.h"
#include "window_fixture.h"
#include "workbench/joint_stations.h"
#include "workbench/split_block.h"

namespace bw::app {
namespace {

/// A surface that swings along the travel, the more the farther right: there the blade goes up and down more
/// than three times as fast as at its left end.
Design swinging() {
  Design design = pipeline::exampleDesign("ripple-along").value();
  design.variables.clear();
  design.bindings.clear();
  std::get<FormulaSurface>(design.source().surface->shape).formula = "250 + 130*(x/600)*sin(2*pi*y/200)";
  design.process.weight = false;
  design.cut().sections.stations = 49;
  design.output.programs.clear();
  return resolved(design).value();
}

const Finding* unevenSpeed(const Findings& findings) {
  const auto found = std::ranges::find_if(
      findings, [](const Finding& finding) { return std::holds_alternative<UnevenSpeed>(finding.cause); });
  return found == findings.end() ? nullptr : &*found;
}

TEST(SplitBlock, KeepsThePointsOfABladeAboutAsFastAsEachOther) {
  const Design design = swinging();
  const pipeline::Outcome outcome = pipeline::evaluate(design, nullptr, {});
  const pipeline::CutEvaluation& cut = outcome.evaluation.cut();
  ASSERT_TRUE(cut.sweep.value && cut.check.value);
  ASSERT_TRUE(unevenSpeed(outcome.evaluation.findings()));
  const BlockGrid before = bw::gridOf(design, *design.block().placement).value();
  const auto split = splitForSpeed(before, design.block().id, *cut.sweep.value, *cut.check.value);
  ASSERT_TRUE(split);
  EXPECT_EQ(split->sizes[0], (std::vector<double>{300, 300})) << "across the blade, in equal parts";
  EXPECT_EQ(split->gaps[0], std::vector<double>{0});
  EXPECT_EQ(split->sizes[1], before.sizes[1]);
  EXPECT_EQ(partsOf(before, *split), 2u);
  const std::optional<Design> parted = withSplit(design, before, *split, design.block().id);
  ASSERT_TRUE(parted);
  EXPECT_EQ(parted->sources, design.sources) << "the surface stays where it is";
  ASSERT_EQ(parted->cuts.size(), 2u);
  const pipeline::Outcome after = pipeline::evaluate(*parted, nullptr, {});
  for (const pipeline::BlockEvaluation& block : after.evaluation.blocks) {
    ASSERT_TRUE(block.cuts[0].check.value);
    for (const StationCheck& station : block.cuts[0].check.value->stations)
      EXPECT_GE(station.speedRatio, kSpeedRatioLimit) << block.id;
  }
  EXPECT_FALSE(unevenSpeed(after.evaluation.findings()));
}

TEST(SplitBlock, IsNoneWhereItWouldNotHelp) {
  const Design design = swinging();
  const pipeline::Outcome outcome = pipeline::evaluate(design, nullptr, {});
  const pipeline::CutEvaluation& cut = outcome.evaluation.cut();
  ASSERT_TRUE(cut.sweep.value && cut.check.value);
  const BlockGrid before = bw::gridOf(design, *design.block().placement).value();
  // Where one end stands still no part is narrow enough.
  SweepCheck still = *cut.check.value;
  for (StationVelocity& station : still.velocities)
    for (std::size_t k = 0; k < station.relative.size(); ++k)
      station.relative[k] = 1e-4 + double(k) / double(station.relative.size());
  EXPECT_FALSE(splitForSpeed(before, design.block().id, *cut.sweep.value, still));
  // In unequal parts, narrow where the blade is slow.
  for (StationVelocity& station : still.velocities)
    for (std::size_t k = 0; k < station.relative.size(); ++k) {
      const double share = double(k) / double(station.relative.size() - 1);
      station.relative[k] = share < 0.2 ? 0.12 + 0.9 * share : 0.3 + 0.7 * (share - 0.2) / 0.8;
    }
  const auto split = splitForSpeed(before, design.block().id, *cut.sweep.value, still);
  ASSERT_TRUE(split);
  EXPECT_GT(split->sizes[0].front(), split->sizes[0].back()) << "curves begin at the right";
  // A block that lies askew to the blade.
  BlockGrid askew = before;
  askew.rotation.z() = 0.7;
  EXPECT_FALSE(splitForSpeed(askew, design.block().id, *cut.sweep.value, *cut.check.value));
}

class MessageButtons : public WindowTest {
 protected:
  int line(const QString& words) {
    const MessageList& list = window().messageList();
    for (int i = 0; i < list.count(); ++i)
      if (list.item(i)->text().contains(words)) return i;
    return -1;
  }
  /// Presses a line of the messages; the buttons that it has then.
  QList<QPushButton*> offered(int line) {
    MessageList& list = window().messageList();
    list.scrollToItem(list.item(line));
    QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, list.visualItemRect(list.item(line)).center());
    // Those before go, and what is new comes into sight.
    QTest::qWait(0);
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    QList<QPushButton*> buttons;
    for (QPushButton* button : list.parentWidget()->findChildren<QPushButton*>())
      if (button->isVisible()) buttons << button;
    return buttons;
  }
  QPushButton* offered(int line, const QString& words) {
    for (QPushButton* button : offered(line))
      if (button->text().contains(words)) return button;
    return nullptr;
  }
  /// Presses a message until it has a button, since what is added to a result moves the lines.
  QPushButton* sought(const QString& message, const QString& words) {
    QPushButton* button = nullptr;
    EXPECT_TRUE(QTest::qWaitFor(
        [&] {
          const int at = line(message);
          return at >= 0 && (button = offered(at, words));
        },
        kPatience));
    return button;
  }
  void setStations(int count) {
    bench().editDesign("Prepare", [count](Design& design) {
      for (Cut& cut : design.cuts) cut.sections.stations = count;
    });
    ASSERT_TRUE(settle());
  }
  std::set<int> stations() {
    std::set<int> counts;
    for (const Cut& cut : bench().design().cuts) counts.insert(cut.sections.stations.value_or(-1));
    return counts;
  }
};

constexpr const char* kBetween = "the stations themselves keep it";

TEST_F(MessageButtons, GapsBetweenStationsGetMoreOfThemInAllBlocksThatMeet) {
  ASSERT_TRUE(window().openExample("three-block-wall"));
  ASSERT_NO_FATAL_FAILURE(setStations(5));
  ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  window().commands()["tab.messages"]->trigger();
  ASSERT_TRUE(sought(kBetween, "stations"));
  picture("joint-remedy");
  QPushButton* button = sought(kBetween, "stations");
  ASSERT_TRUE(button);
  EXPECT_EQ(button->text(), "Take 9 stations in the 3 blocks that meet");
  const double gap = bench().shown()->joints.value->gapMax();
  const Design before = bench().design();
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_EQ(stations(), std::set<int>{9});
  EXPECT_TRUE(bench().design().grid) << "the cuts of the grid are alike";
  ASSERT_TRUE(settle());
  EXPECT_LT(bench().shown()->joints.value->gapMax(), 0.5 * gap);
  for (int round = 0; round < 3 && line(kBetween) >= 0; ++round) {
    button = sought(kBetween, "stations");
    ASSERT_TRUE(button);
    QTest::mouseClick(button, Qt::LeftButton);
    ASSERT_TRUE(settle());
  }
  EXPECT_LT(line(kBetween), 0) << "pressed again it is enough";
  bench().document().undoStack().setIndex(1);
  EXPECT_EQ(bench().design(), before);
}

TEST_F(MessageButtons, GapsAtStationsHaveNone) {
  ASSERT_TRUE(window().openExample("three-block-wall"));
  bench().editDesign("Prepare", [](Design& design) {
    for (Cut& cut : design.cuts) cut.sections.stations = 9;
    design.process.join = Join::none;
    design.process.fitLength = FitOptions::Length::free;
    design.process.jointGap = 1e-4;
  });
  ASSERT_TRUE(settle());
  window().commands()["tab.messages"]->trigger();
  const int at = line("their stations miss each other");
  ASSERT_GE(at, 0);
  EXPECT_FALSE(offered(at, "stations"));
}

TEST_F(MessageButtons, UnevenSpeedHasABlockThatIsSplit) {
  constexpr const char* kUneven = "the slowest point of the blade moves at";
  ASSERT_TRUE(window().openExample("ripple-along"));
  bench().editDesign("Prepare", [](Design& design) {
    design = swinging();
    design.name = "Swinging";
  });
  ASSERT_TRUE(settle());
  window().commands()["tab.messages"]->trigger();
  ASSERT_TRUE(sought(kUneven, "Search the direction"));
  ASSERT_TRUE(sought(kUneven, "Split"));
  picture("speed-remedy");
  const Design before = bench().design();
  QPushButton* button = sought(kUneven, "Split");
  ASSERT_TRUE(button);
  EXPECT_EQ(button->text(), "Split the block in 2 across the blade");
  QTest::mouseClick(button, Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().design().stock.size(), 2u);
  EXPECT_EQ(bench().document().undoStack().undoText(), "Split the block in 2 across the blade");
  EXPECT_LT(line(kUneven), 0);
  picture("speed-remedy-taken");
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design(), before);
}

}  // namespace
}  // namespace bw::app
