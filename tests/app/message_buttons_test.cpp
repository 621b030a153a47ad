// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Buttons of messages that reach beyond the cut selected: more stations where blocks meet, and what helps
// where one end of the blade is slow: a block that is split across the blade, and other planes.

#include <algorithm>
#include <set>

#include "swinging.h"
#include "window_fixture.h"
#include "workbench/joint_stations.h"

namespace bw::app {
namespace {

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

constexpr const char* kUneven = "the slowest point of the blade moves at";

TEST_F(MessageButtons, UnevenSpeedHasABlockThatIsSplit) {
  ASSERT_TRUE(window().openExample("ripple-along"));
  bench().editDesign("Prepare", [](Design& design) {
    design = test::swinging();
    design.name = "Swinging";
  });
  ASSERT_TRUE(settle());
  window().commands()["tab.messages"]->trigger();
  ASSERT_TRUE(sought(kUneven, "Split"));
  EXPECT_GE(line("split across the blade at 300 mm along the block's x it is 41 and 54 % in the parts"), 0);
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

TEST_F(MessageButtons, BladesThatTurnFarHaveParallelPlanesAndASplit) {
  ASSERT_TRUE(window().openExample("turning-blades"));
  bench().editDesign("Prepare", [](Design& design) {
    for (Variable& variable : design.variables)
      if (variable.name == "turn") variable.value = 8;
    design = resolved(design).value();
  });
  ASSERT_TRUE(settle());
  window().commands()["tab.messages"]->trigger();
  ASSERT_TRUE(sought(kUneven, "Take parallel planes"));
  picture("speed-remedy-planes");
  const Design before = bench().design();
  QPushButton* split = sought(kUneven, "Split the block in 2 across the blade");
  ASSERT_TRUE(split);
  QTest::mouseClick(split, Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().design().stock.size(), 2u);
  EXPECT_LT(line(kUneven), 0);
  picture("speed-remedy-turning-split");
  bench().document().undoStack().undo();
  ASSERT_EQ(bench().design(), before);
  ASSERT_TRUE(settle());
  QPushButton* planes = sought(kUneven, "Take parallel planes");
  ASSERT_TRUE(planes);
  QTest::mouseClick(planes, Qt::LeftButton);
  EXPECT_EQ(bench().document().undoStack().undoText(), "Take parallel planes");
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().design().cut().direction);
  EXPECT_LT(line(kUneven), 0);
}

}  // namespace
}  // namespace bw::app
