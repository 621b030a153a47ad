// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Undo and redo by key while the focus is in a field: of the typing, then of the design.
#include "window_fixture.h"

namespace bw::app {
namespace {

class HistoryKeys : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    openPanel();
    number_ = find<NumberField>("Number");
    ASSERT_TRUE(number_);
    number_->setFocus();
    ASSERT_TRUE(number_->hasFocus());
  }

  void type(const QString& text) {
    number_->setFocus();
    number_->selectAll();
    QTest::keyClicks(number_, text);
  }

  static void undo(QWidget* field) { QTest::keyClick(field, Qt::Key_Z, Qt::ControlModifier); }
  static void redo(QWidget* field) {
    QTest::keyClick(field, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  }
  static void redoByY(QWidget* field) { QTest::keyClick(field, Qt::Key_Y, Qt::ControlModifier); }

  int changes() { return bench().document().undoStack().index(); }

  NumberField* number_ = nullptr;
};

TEST_F(HistoryKeys, UndoAFinishedNumberWithTheFocusInItsField) {
  type("5");
  QTest::keyClick(number_, Qt::Key_Return);
  ASSERT_EQ(bench().design().cut().sections.stations, 5);
  EXPECT_FALSE(number_->hasFocus());
  number_->setFocus();
  undo(number_);
  EXPECT_EQ(bench().design().cut().sections.stations, 20);
  EXPECT_EQ(number_->text(), "20");
  redo(number_);
  EXPECT_EQ(bench().design().cut().sections.stations, 5);
  EXPECT_EQ(number_->text(), "5");
  undo(number_);
  redoByY(number_);
  EXPECT_EQ(bench().design().cut().sections.stations, 5);
  EXPECT_TRUE(number_->hasFocus());
}

TEST_F(HistoryKeys, UndoTheTypingBeforeTheDesign) {
  type("5");
  QTest::keyClick(number_, Qt::Key_Return);
  type("7");
  QTest::keyClicks(number_, "1");
  undo(number_);
  EXPECT_EQ(number_->text(), "5");
  EXPECT_EQ(bench().design().cut().sections.stations, 5);
  redoByY(number_);
  EXPECT_EQ(number_->text(), "71");
  undo(number_);
  redo(number_);
  EXPECT_EQ(number_->text(), "71");
  EXPECT_EQ(changes(), 1);
  undo(number_);
  undo(number_);
  EXPECT_EQ(bench().design().cut().sections.stations, 20);
  EXPECT_EQ(number_->text(), "20");
  // Last undone, first redone.
  redo(number_);
  EXPECT_EQ(bench().design().cut().sections.stations, 5);
  EXPECT_EQ(number_->text(), "5");
}

TEST_F(HistoryKeys, LeaveTheDesignAloneWhileAFieldIsTypedIn) {
  bench().editDesign("Change clearance", [](Design& design) { design.process.clearance = 60; });
  bench().document().undoStack().undo();
  type("7");
  redoByY(number_);
  redo(number_);
  EXPECT_EQ(changes(), 0);
  EXPECT_EQ(number_->text(), "7");
}

TEST_F(HistoryKeys, UndoTheDesignFromAFieldThatWasLeftAndEnteredAgain) {
  type("5");
  QTest::keyClick(number_, Qt::Key_Tab);
  ASSERT_EQ(bench().design().cut().sections.stations, 5);
  number_->setFocus();
  undo(number_);
  EXPECT_EQ(bench().design().cut().sections.stations, 20);
  EXPECT_EQ(number_->text(), "20");
  // Nothing is left to undo, neither here nor there.
  undo(number_);
  EXPECT_EQ(number_->text(), "20");
}

TEST_F(HistoryKeys, UndoAStepOfTheArrowKeys) {
  QTest::keyClick(number_, Qt::Key_Up);
  ASSERT_EQ(bench().design().cut().sections.stations, 21);
  undo(number_);
  EXPECT_EQ(bench().design().cut().sections.stations, 20);
  EXPECT_EQ(number_->text(), "20");
}

TEST_F(HistoryKeys, UndoAChoiceWithTheFocusInIt) {
  auto* mode = find<ChoiceField>("Stations");
  ASSERT_TRUE(mode);
  mode->setFocus();
  QTest::keyClick(mode, Qt::Key_Down);
  ASSERT_TRUE(bench().design().cut().sections.spacing);
  undo(mode);
  EXPECT_FALSE(bench().design().cut().sections.spacing);
  EXPECT_EQ(mode->currentIndex(), 1);
  redoByY(mode);
  EXPECT_TRUE(bench().design().cut().sections.spacing);
  EXPECT_EQ(mode->currentIndex(), 2);
}

TEST_F(HistoryKeys, UndoTheNumbersOfFaces) {
  // Nobody knows how many faces a file has that is not there: any number may be typed.
  Design absent;
  absent.source().path = path("absent.step");
  bench().document().start(std::move(absent));
  ASSERT_TRUE(settle());
  bench().editDesign("Choose faces", [](Design& design) {
    design.cut().face = {FaceChoice::Kind::indices, {0}};
  });
  auto* faces = find<ListField>("Face numbers");
  ASSERT_TRUE(faces);
  faces->setFocus();
  faces->selectAll();
  QTest::keyClicks(faces, "0,1");
  undo(faces);
  EXPECT_EQ(faces->text(), "0");
  redoByY(faces);
  QTest::keyClick(faces, Qt::Key_Return);
  ASSERT_EQ(bench().design().cut().face.indices, (std::vector<int>{0, 1}));
  faces->setFocus();
  faces->end(false);
  EXPECT_EQ(faces->text(), "0, 1");
  QTest::keyClicks(faces, ",2");
  undo(faces);
  EXPECT_EQ(faces->text(), "0, 1") << "what was finished is undone with the typing";
  undo(faces);
  EXPECT_EQ(bench().design().cut().face.indices, std::vector<int>{0});
  EXPECT_EQ(faces->text(), "0");
  redo(faces);
  EXPECT_EQ(faces->text(), "0, 1");
}

}  // namespace
}  // namespace bw::app
