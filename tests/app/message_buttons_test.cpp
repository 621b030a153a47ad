// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Buttons of messages that reach beyond the cut selected: more stations where blocks meet.

#include <algorithm>
#include <set>

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

}  // namespace
}  // namespace bw::app
