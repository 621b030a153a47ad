// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Numbers of a design that stand for expressions over its variables, typed into the fields of the window.

#include "bw/core/base/units.h"
#include "controls/fields.h"
#include "window_fixture.h"
#include "workflow/kerf_table_field.h"
#include "workflow/variable_fields.h"

namespace bw::app {
namespace {

class BoundFields : public WindowTest {
 protected:
  void open(const QString& name) {
    ASSERT_TRUE(window().openExample(name));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  }

  /// Types over what a field holds, as a person does, and presses Enter.
  template <class Field = NumberField>
  void type(const QString& name, const QString& text) {
    auto* field = find<Field>(name);
    ASSERT_TRUE(field) << name.toStdString();
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
  }
  void addWidth() {
    ASSERT_NO_FATAL_FAILURE(type<NewVariableField>("New variable", "width = 600 mm, 300 to 700"));
    QTest::qWait(20);  // the line that took it is on its way
  }

  double pole() { return std::get<PolesSurface>(bench().design().source().surface->shape).at(2, 1).height; }
  std::string boundAt(const std::string& place) {
    const auto bound = bench().design().bindings.find(place);
    return bound == bench().design().bindings.end() ? std::string() : bound->second.text;
  }
  int steps() { return bench().document().undoStack().index(); }
};

constexpr const char* kPole = "pole 2 of row 3";
constexpr const char* kPolePlace = "/sources/0/surface/poles/2/1";

TEST_F(BoundFields, ANumberFollowsTheVariablesOfItsExpression) {
  open("single-block");
  ASSERT_NO_FATAL_FAILURE(addWidth());
  const int before = steps();
  ASSERT_EQ(pole(), 340);
  // What it comes to is what the number was: it hangs on the variable from now on all the same.
  ASSERT_NO_FATAL_FAILURE(type(kPole, "=width/2 + 40"));
  EXPECT_EQ(boundAt(kPolePlace), "width/2 + 40");
  EXPECT_EQ(steps(), before + 1);
  EXPECT_TRUE(window().sceneView().hasFocus()) << "the keyboard stayed in the field";
  auto* field = find<NumberField>(kPole);
  EXPECT_EQ(field->expression(), "width/2 + 40");
  EXPECT_EQ(field->text(), "340");
  ASSERT_NO_FATAL_FAILURE(type("Blade length", "=width + 250"));
  ASSERT_NO_FATAL_FAILURE(type("Clearance", "=width/20"));
  ASSERT_NO_FATAL_FAILURE(type("Number", "=33"));
  EXPECT_EQ(boundAt("/blade/length"), "width + 250");
  EXPECT_EQ(bench().design().blade.length, 850);
  EXPECT_EQ(boundAt("/process/clearance"), "width/20");
  EXPECT_EQ(boundAt("/cuts/0/stations"), "33");
  ASSERT_TRUE(settle());
  picture("bound-numbers");
  ASSERT_NO_FATAL_FAILURE(type("width", "620"));
  EXPECT_EQ(pole(), 350);
  EXPECT_EQ(bench().design().blade.length, 870);
  EXPECT_EQ(bench().design().process.clearance, 31);
  EXPECT_EQ(find<NumberField>(kPole)->text(), "350");
  // Back, step by step, and forth.
  QUndoStack& undo = bench().document().undoStack();
  undo.undo();
  EXPECT_EQ(pole(), 340);
  EXPECT_EQ(find<NumberField>("Clearance")->expression(), "width/20");
  undo.setIndex(before);
  EXPECT_EQ(find<NumberField>(kPole)->expression(), "");
  EXPECT_TRUE(bench().design().bindings.empty());
  undo.redo();
  EXPECT_EQ(find<NumberField>(kPole)->expression(), "width/2 + 40");
}

TEST_F(BoundFields, AnExpressionIsSavedAndOpenedAgain) {
  open("single-block");
  ASSERT_NO_FATAL_FAILURE(addWidth());
  ASSERT_NO_FATAL_FAILURE(type(kPole, "=width/2"));
  // As it is without a word in the file.
  ASSERT_NO_FATAL_FAILURE(type("Clearance", "=width/12"));
  ASSERT_EQ(bench().design().process.clearance, Process{}.clearance);
  const fs::path file = path("bound.bladewright");
  ASSERT_TRUE(bench().saveTo(file));
  const Design saved = bench().design();
  window().showStartPage();
  ASSERT_TRUE(window().openFile(QString::fromStdString(file.string())));
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().design().bindings, saved.bindings);
  EXPECT_EQ(find<NumberField>(kPole)->expression(), "width/2");
  EXPECT_EQ(find<NumberField>("Clearance")->expression(), "width/12");
  ASSERT_NO_FATAL_FAILURE(type("width", "660"));
  EXPECT_EQ(pole(), 330);
  EXPECT_EQ(bench().design().process.clearance, 55);
}

TEST_F(BoundFields, WhatIsTypedIntoOneIsItsExpression) {
  open("single-block");
  ASSERT_NO_FATAL_FAILURE(addWidth());
  ASSERT_NO_FATAL_FAILURE(type("Clearance", "=width/20"));
  auto* field = find<NumberField>("Clearance");
  // With the keyboard it shows what can be typed into; without, the number.
  field->setFocus(Qt::TabFocusReason);
  EXPECT_EQ(field->text(), "=width/20");
  EXPECT_EQ(field->selectedText(), "=width/20");
  picture("bound-typed");
  QTest::keyClick(field, Qt::Key_End);
  QTest::keyClicks(field, " + 1");
  QTest::keyClick(field, Qt::Key_Return);
  EXPECT_EQ(boundAt("/process/clearance"), "width/20 + 1");
  EXPECT_EQ(field->text(), "31");
  // Esc brings it back.
  field->setFocus(Qt::TabFocusReason);
  QTest::keyClicks(field, "7");
  QTest::keyClick(field, Qt::Key_Escape);
  EXPECT_EQ(field->text(), "31");
  EXPECT_EQ(boundAt("/process/clearance"), "width/20 + 1");
  // It has no next number.
  field->setFocus(Qt::TabFocusReason);
  QTest::keyClick(field, Qt::Key_Up);
  EXPECT_EQ(field->value(), 31);
  EXPECT_EQ(field->text(), "=width/20 + 1");
  // To look at it is no edit.
  const int before = steps();
  QTest::keyClick(field, Qt::Key_Return);
  EXPECT_EQ(steps(), before);
  // A number takes its place, also the one that it comes to.
  ASSERT_NO_FATAL_FAILURE(type("Clearance", "31"));
  EXPECT_EQ(boundAt("/process/clearance"), "");
  EXPECT_EQ(field->expression(), "");
  EXPECT_EQ(steps(), before + 1);
  ASSERT_NO_FATAL_FAILURE(type("width", "640"));
  EXPECT_EQ(bench().design().process.clearance, 31);
}

TEST_F(BoundFields, AWrongExpressionSaysWhatIsWrong) {
  open("single-block");
  ASSERT_NO_FATAL_FAILURE(addWidth());
  const Design before = bench().design();
  const auto refusal = [&](const QString& name, const QString& text) {
    auto* field = find<NumberField>(name);
    const QString shown = field->text();
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
    EXPECT_TRUE(field->refused()) << text.toStdString();
    EXPECT_EQ(field->text(), text);
    const QString why = field->refusal();
    if (text == "=widht/2") picture("bound-refused");
    QTest::keyClick(field, Qt::Key_Escape);
    EXPECT_EQ(field->text(), shown);
    return why.toStdString();
  };
  EXPECT_EQ(refusal("Clearance", "=widht/2"),
            "After its =, character 1: there is no “widht”; did you mean “width”?\n0 to 10000 mm");
  EXPECT_NE(refusal("Clearance", "=width/").find("character 7: the formula ends"), std::string::npos);
  EXPECT_NE(refusal("Clearance", "=").find("character 1: the formula ends"), std::string::npos);
  EXPECT_NE(refusal("Clearance", "=-width").find("This comes to -600 mm, which is out of range"),
            std::string::npos);
  EXPECT_NE(refusal("Number", "=width/7").find("must be a whole number"), std::string::npos);
  EXPECT_NE(refusal("Number", "=width/0").find("character 6"), std::string::npos);
  EXPECT_NE(refusal("width", "=2*3").find("no expression can stand here"), std::string::npos)
      << "a variable is a number";
  EXPECT_EQ(bench().design(), before);
}

TEST_F(BoundFields, TheKerfOverSpeedHasExpressions) {
  open("single-block");
  ASSERT_NO_FATAL_FAILURE(addWidth());
  for (auto* button : window().workflow().findChildren<QToolButton*>())
    if (button->text().contains("Fit and lead") && !button->isChecked()) button->click();
  const int before = steps();
  auto* field = find<KerfTableField>("Kerf over speed");
  ASSERT_TRUE(field);
  const auto typed = [&](const QString& text) {
    window().workflow().ensureWidgetVisible(field);
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
    EXPECT_FALSE(field->refused()) << field->refusal().toStdString();
  };
  typed("5: =width/150; 20: =max(width; 100)/250");
  EXPECT_EQ(steps(), before + 1);
  EXPECT_EQ(boundAt("/process/kerf/0/1"), "width/150");
  EXPECT_EQ(boundAt("/process/kerf/1/1"), "max(width; 100)/250");
  EXPECT_EQ(bench().design().process.kerfTable, (KerfTable{{5, 4}, {20, 2.4}}));
  EXPECT_EQ(field->text(), "5: 4, 20: 2.4");
  EXPECT_EQ(field->expression(), "5: =width/150; 20: =max(width; 100)/250");
  const Design again = parseDesign(designToJson(bench().design())).value();
  EXPECT_EQ(again.bindings, bench().design().bindings);
  ASSERT_TRUE(settle());
  window().workflow().ensureWidgetVisible(field);
  picture("bound-kerf");
  ASSERT_NO_FATAL_FAILURE(type("width", "660"));
  EXPECT_EQ(bench().design().process.kerfTable[0].width, 4.4);
  EXPECT_EQ(field->text(), "5: 4.4, 20: 2.64");
  // With the keyboard it shows what is typed into; one number frees itself, none frees all.
  field->setFocus(Qt::TabFocusReason);
  EXPECT_EQ(field->text(), "5: =width/150; 20: =max(width; 100)/250");
  typed("5: 4.4; 20: =width/250");
  EXPECT_EQ(boundAt("/process/kerf/0/1"), "");
  EXPECT_EQ(boundAt("/process/kerf/1/1"), "width/250");
  field->setFocus();
  field->selectAll();
  QTest::keyClick(field, Qt::Key_Delete);
  QTest::keyClick(field, Qt::Key_Return);
  EXPECT_TRUE(bench().design().process.kerfTable.empty());
  for (const auto& [place, bound] : bench().design().bindings)
    EXPECT_FALSE(place.starts_with("/process/kerf")) << place;
  bench().document().undoStack().setIndex(before);
  EXPECT_EQ(field->expression(), "");
}

TEST_F(BoundFields, AFileThatIsCutHasVariablesToo) {
  openPanel();
  ASSERT_NO_FATAL_FAILURE(type("Clearance", "=60 - 10"));
  EXPECT_EQ(boundAt("/process/clearance"), "60 - 10");
  ASSERT_NO_FATAL_FAILURE(type<NewVariableField>("New variable", "reach = 40 mm"));
  QTest::qWait(20);
  ASSERT_NO_FATAL_FAILURE(type("Clearance", "=reach + 20"));
  ASSERT_NO_FATAL_FAILURE(type("reach", "50"));
  EXPECT_EQ(bench().design().process.clearance, 70);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  // The block of numbers, and the fields of the inspector.
  bench().editDesign("Prepare", [](Design& design) {
    design.block().placement = BlockPlacement{{-10, -10, -200}, {700, 700, 600}, {0, 0, 0}};
  });
  bench().select({Selection::Kind::block});
  ASSERT_NO_FATAL_FAILURE(type("Size X", "=reach*14"));
  ASSERT_NO_FATAL_FAILURE(type("Rotation Z", "=reach/10"));
  EXPECT_EQ(boundAt("/stock/0/block/size/0"), "reach*14");
  const Design again = parseDesign(designToJson(bench().design())).value();
  EXPECT_EQ(again.bindings, bench().design().bindings);
  EXPECT_NEAR(again.block().placement->rotation.z(), 5 * kDegree, 1e-12);
}

}  // namespace
}  // namespace bw::app
