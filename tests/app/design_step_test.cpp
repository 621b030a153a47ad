// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A surface that is designed in the window: its kind, its numbers, its formula, the variables.

#include <QApplication>
#include <QScrollArea>
#include <QScrollBar>

#include <algorithm>

#include "bw/core/base/units.h"
#include "controls/fields.h"
#include "window_fixture.h"
#include "workflow/surface_fields.h"
#include "workflow/workflow_panel.h"

namespace bw::app {
namespace {

class DesignStep : public WindowTest {
 protected:
  void open(const QString& name) {
    ASSERT_TRUE(window().openExample(name));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  }

  /// Types into a field as a person does.
  template <class Field>
  void type(const QString& name, const QString& text) {
    auto* field = find<Field>(name);
    ASSERT_TRUE(field) << name.toStdString();
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
  }

  template <class Shape>
  const Shape& shape() {
    return std::get<Shape>(bench().design().source().surface->shape);
  }
};

TEST_F(DesignStep, ANewSingleBlockStandsAtOneClick) {
  for (QPushButton* button : window().startPage().findChildren<QPushButton*>())
    if (button->text() == "New single block") QTest::mouseClick(button, Qt::LeftButton);
  ASSERT_FALSE(window().onStartPage());
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current());
  EXPECT_EQ(stationCount(), 33u);
  EXPECT_EQ(shape<PolesSurface>().columns, 4);
  EXPECT_EQ(shape<PolesSurface>().rows, 6);
  EXPECT_FALSE(find<QPushButton>("Reload"));
  EXPECT_FALSE(find<ChoiceField>("Faces")) << "of files";
  for (const Finding& finding : bench().runner().evaluation()->findings())
    EXPECT_NE(finding.severity, Severity::error);
  const Design before = bench().design();
  type<NumberField>("pole 2 of row 3", "36 cm");
  EXPECT_EQ(shape<PolesSurface>().at(2, 1).height, 360);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  picture("design-poles");
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design(), before);
  EXPECT_EQ(find<NumberField>("pole 2 of row 3")->value(), 340);
}

TEST_F(DesignStep, TheGripsAreHeldByTheExtendedSectionWhereThatIsChosen) {
  open("bump");
  bench().editDesign("Prepare", [](Design& design) {
    design.block().placement->origin.x() += 100;
    design.block().placement->size.x() -= 200;
    design.blade.length = 560;
  });
  for (QToolButton* fold : window().findChildren<QToolButton*>())
    if (fold->isCheckable() && fold->isVisible() && !fold->isChecked() && fold->text() == "Fit and lead")
      fold->click();
  auto* grips = find<ChoiceField>("Grips");
  ASSERT_TRUE(grips);
  EXPECT_EQ(grips->currentIndex(), 0);
  auto* length = find<ChoiceField>("Length");
  ASSERT_TRUE(length);
  EXPECT_TRUE(length->isEnabled());
  const Design before = bench().design();
  grips->setFocus();
  QTest::keyClick(grips, Qt::Key_Down);
  EXPECT_EQ(bench().design().process.extend, Extension::surface);
  EXPECT_FALSE(length->isEnabled()) << "nothing else is asked of the fit";
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  ASSERT_TRUE(bench().row());
  for (const StationFit& fit : bench().row()->fits) EXPECT_TRUE(fit.extended);
  picture("design-extended");
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design(), before);
  EXPECT_EQ(grips->currentIndex(), 0);
  EXPECT_TRUE(length->isEnabled());
}

TEST_F(DesignStep, AnotherNumberOfPolesKeepsTheSurface) {
  open("bump");
  const Eigen::Vector3d size = bench().newestTarget()->bounds().size();
  type<NumberField>("Poles across", "6");
  ASSERT_TRUE(settle());
  type<NumberField>("Poles along", "9");
  ASSERT_TRUE(settle());
  EXPECT_EQ(shape<PolesSurface>().columns, 6);
  EXPECT_EQ(shape<PolesSurface>().rows, 9);
  EXPECT_TRUE(find<NumberField>("pole 6 of row 9"));
  EXPECT_TRUE(bench().design().bindings.empty()) << "the poles of expressions are gone";
  EXPECT_LT((bench().newestTarget()->bounds().size() - size).norm(), 2);
  picture("design-more-poles");
  type<NumberField>("Poles across", "3");
  EXPECT_TRUE(find<NumberField>("Poles across")->refused());
  bench().document().undoStack().setIndex(0);
  ASSERT_TRUE(settle());
  auto* along = find<NumberField>("Poles along");
  ASSERT_TRUE(along);
  EXPECT_EQ(along->value(), 6);
}

TEST_F(DesignStep, VariablesAreNumbersAndSliders) {
  open("ripple-along");
  type<NumberField>("amplitude", "15");
  EXPECT_EQ(bench().design().variables[0].value, 15);
  EXPECT_EQ(shape<FormulaSurface>().numbers[0].value, 15);
  ASSERT_TRUE(settle());
  picture("design-variables");
  auto* slider = find<HandSlider>("amplitude");
  ASSERT_TRUE(slider);
  slider->setValue(slider->maximum());
  EXPECT_EQ(bench().design().variables[0].value, 60);
  EXPECT_EQ(find<NumberField>("amplitude")->value(), 60);
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design().variables[0].value, 15);
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design().variables[0].value, 25);
  type<NumberField>("amplitude", "61");
  EXPECT_TRUE(find<NumberField>("amplitude")->refused());
  EXPECT_EQ(bench().design().variables[0].value, 25);
  // A design without variables has no such fields.
  window().openExample("saddle");
  ASSERT_TRUE(settle());
  EXPECT_FALSE(find<NumberField>("amplitude"));
  EXPECT_TRUE(find<ChoiceField>("Faces"));
}

TEST_F(DesignStep, EscapeGivesTheDragOfASliderUp) {
  open("ripple-along");
  // A value between two steps of the slider, and a computation that Esc would stop.
  type<NumberField>("amplitude", "25.13");
  auto* best = window().workflow().findChild<QCheckBox*>("bestLength");
  ASSERT_TRUE(best);
  QTest::mouseClick(best, Qt::LeftButton, {}, QPoint(10, best->height() / 2));
  ASSERT_TRUE(bench().design().blade.autoLength);
  ASSERT_TRUE(settle());
  const Design before = bench().design();
  const int steps = bench().document().undoStack().count();
  auto* slider = find<HandSlider>("amplitude");
  ASSERT_TRUE(slider);
  const int stood = slider->value();
  window().workflow().ensureWidgetVisible(slider);
  const QPoint from(slider->width() / 2, slider->height() / 2);
  QTest::mousePress(slider, Qt::LeftButton, {}, from);
  for (int i = 1; i <= 6; ++i) QTest::mouseMove(slider, from + QPoint(10 * i, 0));
  EXPECT_GT(bench().design().variables[0].value, 30);
  EXPECT_TRUE(bench().runner().busy());
  EXPECT_EQ(QApplication::focusWidget(), slider);
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
  EXPECT_EQ(bench().design(), before);
  EXPECT_EQ(bench().document().undoStack().count(), steps);
  EXPECT_EQ(slider->value(), stood);
  EXPECT_EQ(find<NumberField>("amplitude")->value(), 25.13);
  // The hand may go on: nothing hangs on it.
  QTest::mouseMove(slider, from + QPoint(90, 0));
  QTest::mouseRelease(slider, Qt::LeftButton, {}, from + QPoint(90, 0));
  EXPECT_EQ(bench().design(), before);
  EXPECT_EQ(slider->value(), stood);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << "the computation of the design was stopped";
}

TEST_F(DesignStep, TheKeyboardStaysWhereAKindOfSurfaceIsChosen) {
  makeWindow({1280, 800});
  open("ripple-along");
  auto& panel = window().workflow();
  const auto where = [] {
    const QWidget* widget = QApplication::focusWidget();
    return widget ? widget->accessibleName().toStdString() + " (" + widget->metaObject()->className() + ")"
                  : std::string("nowhere");
  };
  const auto laidOut = [] {
    QTest::qWait(20);
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    QCoreApplication::sendPostedEvents(nullptr, QEvent::LayoutRequest);
  };
  auto* kind = find<ChoiceField>("Surface");
  ASSERT_TRUE(kind);
  panel.ensureWidgetVisible(kind, 0, 200);
  laidOut();
  kind->setFocus(Qt::TabFocusReason);
  ASSERT_EQ(QApplication::focusWidget(), kind) << where();
  const auto place = [&] { return kind->mapTo(&panel, QPoint()).y(); };
  const int stood = place();
  // From kind to kind by keys to whatever has the keyboard.
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Down);
  ASSERT_TRUE(std::holds_alternative<SectionsSurface>(bench().design().source().surface->shape));
  laidOut();
  EXPECT_EQ(QApplication::focusWidget(), kind) << where();
  EXPECT_EQ(kind->currentText(), "Sections");
  EXPECT_EQ(place(), stood) << "the panel was scrolled";
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Up);
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Up);
  ASSERT_TRUE(std::holds_alternative<PolesSurface>(bench().design().source().surface->shape)) << where();
  laidOut();
  EXPECT_EQ(QApplication::focusWidget(), kind) << where();
  EXPECT_EQ(find<ChoiceField>("Surface"), kind);
  picture("kind-by-keys");
  // Also when the result comes.
  ASSERT_TRUE(settle());
  laidOut();
  EXPECT_EQ(QApplication::focusWidget(), kind) << where();
  // Tab goes on to its numbers, and back.
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab);
  EXPECT_EQ(QApplication::focusWidget()->accessibleName(), "Poles across") << where();
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Backtab, Qt::ShiftModifier);
  EXPECT_EQ(QApplication::focusWidget(), kind) << where();
  // Enter gives it back to the picture, as after any choice.
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Return);
  EXPECT_EQ(QApplication::focusWidget(), &window().sceneView()) << where();
}

TEST_F(DesignStep, AFormulaIsTakenOrRefusedWithItsCharacter) {
  open("ripple-along");
  type<FormulaField>("Formula", "300 - 50*((x - 300)/300)^2 + amplitud");
  EXPECT_TRUE(find<FormulaField>("Formula")->refused());
  EXPECT_TRUE(find<FormulaField>("Formula")->refusal().contains("Character 30: there is no “amplitud”"))
      << find<FormulaField>("Formula")->refusal().toStdString();
  picture("design-formula-refused");
  type<FormulaField>("Formula", "300 - 50*((x - 300)/300)^2 + waves");
  EXPECT_FALSE(find<FormulaField>("Formula")->refused());
  EXPECT_EQ(shape<FormulaSurface>().formula, "300 - 50*((x - 300)/300)^2 + waves");
  ASSERT_EQ(shape<FormulaSurface>().numbers.size(), 1u);
  EXPECT_EQ(shape<FormulaSurface>().numbers[0].name, "waves");
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
}

TEST_F(DesignStep, KeyBladesOfAnotherKindTellHowNearTheyCome) {
  open("ripple-along");
  std::vector<Notice> told;
  QObject::connect(&bench(), &Workbench::noticed, &window(), [&told](const Notice& n) { told.push_back(n); });
  emit find<ChoiceField>("Surface")->activated(3);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  const std::size_t count = shape<BladesSurface>().blades.size();
  EXPECT_GE(count, 8u) << "seven of them miss the surface by more than a quarter of the tolerance";
  const auto near = std::ranges::find_if(told, [&](const Notice& n) {
    return n.text.startsWith(QString("%1 key blades, within 0.").arg(count));
  });
  ASSERT_NE(near, told.end());
  EXPECT_EQ(near->severity, Severity::info);
  QTest::qWait(50);
  picture("design-key-blades-told");
}

TEST_F(DesignStep, AnotherKindBeginsNearTheOneBefore) {
  open("twist");
  EXPECT_TRUE(find<ChoiceField>("Loft"));
  picture("design-sections");
  auto* kind = find<ChoiceField>("Surface");
  ASSERT_TRUE(kind);
  EXPECT_EQ(kind->currentIndex(), 2);
  emit kind->activated(0);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  EXPECT_NEAR(shape<PolesSurface>().at(0, 0).height, 180, 1e-6);
  EXPECT_FALSE(find<ChoiceField>("Loft"));
  EXPECT_TRUE(find<NumberField>("pole 4 of row 6"));
  emit find<ChoiceField>("Surface")->activated(1);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  EXPECT_TRUE(find<FormulaField>("Formula"));
  bench().document().undoStack().setIndex(0);
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().design().source().surface->shape.index(), 2u);
}

TEST_F(DesignStep, KeyBladesAreTypedAddedAndTakenAway) {
  open("key-blade-fan");
  const Design before = bench().design();
  EXPECT_EQ(find<ChoiceField>("Surface")->currentIndex(), 3);
  EXPECT_NEAR(find<NumberField>("Lean of key blade 1")->value(), -7, 1e-9) << "in degrees";
  picture("design-key-blades");
  type<NumberField>("Lean of key blade 1", "-4");
  EXPECT_NEAR(shape<BladesSurface>().blades[0].angle, -4 * kDegree, 1e-12);
  type<NumberField>("Bend of key blade 2", "-0,75");
  EXPECT_EQ(shape<BladesSurface>().blades[1].bend, -0.75);
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current());
  // One more changes nothing of the surface but that it can be changed there.
  const auto height = [&] { return bench().newestTarget()->bounds().max.z(); };
  const double high = height();
  auto* add = find<QPushButton>("Add a key blade after key blade 2");
  ASSERT_TRUE(add);
  add->click();
  ASSERT_TRUE(settle());
  ASSERT_EQ(shape<BladesSurface>().blades.size(), 5u);
  EXPECT_EQ(shape<BladesSurface>().blades[2].y, 405);
  EXPECT_NEAR(height(), high, 0.02);
  find<QPushButton>("Remove key blade 5")->click();
  ASSERT_TRUE(settle());
  EXPECT_EQ(shape<BladesSurface>().blades.size(), 4u);
  EXPECT_FALSE(find<QPushButton>("Add a key blade after key blade 4")->isEnabled());
  bench().document().undoStack().setIndex(0);
  EXPECT_EQ(bench().design(), before);
}

TEST_F(DesignStep, KeyBladesAreTurned) {
  open("turning-blades");
  EXPECT_NEAR(find<NumberField>("Turn of key blade 2")->value(), 5, 1e-9) << "in degrees";
  ASSERT_TRUE(bench().sweep());
  EXPECT_TRUE(bench().sweep()->sweep.planes.turns());
  picture("design-turning-blades");
  type<NumberField>("Turn of key blade 3", "2");
  EXPECT_NEAR(shape<BladesSurface>().blades[2].turn, 2 * kDegree, 1e-12);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  EXPECT_NEAR(bench().sweep()->sweep.planes.angle(400), 2 * kDegree, 1e-9);
}

TEST_F(DesignStep, NumbersThatMakeNoSurfaceAreRefused) {
  // Without expressions nothing but the fields themselves stands between them and the file.
  open("key-blade-fan");
  bench().editDesign("Prepare", [](Design& design) { design.bindings.clear(); });
  const Design before = bench().design();
  type<NumberField>("At y of key blade 3", "0");
  EXPECT_EQ(bench().design(), before);
  std::vector<Notice> told;
  QObject::connect(&bench(), &Workbench::noticed, &window(), [&told](const Notice& n) { told.push_back(n); });
  for (const auto& [name, text] :
       {std::pair("Length of key blade 1", "-5"), {"Bend of key blade 2", "-60"}}) {
    type<NumberField>(name, text);
    EXPECT_EQ(bench().design(), before);
    const auto* field = find<NumberField>(name);
    EXPECT_TRUE(field->refused()) << name;
    EXPECT_NE(field->refusal().indexOf("key blade"), -1) << field->refusal().toStdString();
  }
  EXPECT_TRUE(told.empty()) << "it is told where it is typed";
  // A number that can be takes the refusal away.
  type<NumberField>("Length of key blade 1", "650");
  EXPECT_FALSE(find<NumberField>("Length of key blade 1")->refused());
  EXPECT_EQ(shape<BladesSurface>().blades[0].length, 650);
  EXPECT_EQ(find<NumberField>("At y of key blade 3")->value(), 540) << "the field shows what holds";
  type<NumberField>("At y of key blade 3", "500");
  EXPECT_EQ(shape<BladesSurface>().blades[2].y, 500);
  ASSERT_TRUE(bench().saveTo(path("fan.bladewright")));
  EXPECT_TRUE(loadDesign(path("fan.bladewright")));
}

TEST_F(DesignStep, ASurfaceBecomesKeyBladesAndTheResultTheDesign) {
  open("bump");
  emit find<ChoiceField>("Surface")->activated(3);
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current());
  EXPECT_LT(shape<BladesSurface>().blades.size(), 14u);
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  for (const char* command : {"design.keys", "design.adopt"}) {
    ASSERT_TRUE(window().commands()[command]->isEnabled()) << command;
    window().commands()[command]->trigger();
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << command;
    EXPECT_TRUE(std::holds_alternative<BladesSurface>(bench().design().source().surface->shape));
    picture(command);
    bench().document().undoStack().undo();
    ASSERT_TRUE(settle());
  }
  EXPECT_TRUE(std::holds_alternative<PolesSurface>(bench().design().source().surface->shape));
}

TEST_F(DesignStep, ACutWhosePlanesTurnBecomesKeyBladesThatTurnAndItsResultTheDesign) {
  open("turning-blades");
  std::vector<Notice> told;
  QObject::connect(&bench(), &Workbench::noticed, &window(), [&told](const Notice& n) { told.push_back(n); });
  for (const char* command : {"design.keys", "design.adopt"}) {
    ASSERT_TRUE(window().commands()[command]->isEnabled()) << command;
    told.clear();
    window().commands()[command]->trigger();
    const bool said =
        std::ranges::any_of(told, [](const Notice& n) { return n.text.contains("key blades, within"); });
    EXPECT_TRUE(said) << command;
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << command;
    EXPECT_TRUE(bench().sweep()->sweep.planes.turns());
    const std::vector<KeyBlade>& blades = shape<BladesSurface>().blades;
    EXPECT_TRUE(std::ranges::any_of(blades, [](const KeyBlade& blade) { return blade.turn != 0; }));
    picture(std::string("turning-") + command);
    bench().document().undoStack().undo();
    ASSERT_TRUE(settle());
  }
  EXPECT_EQ(shape<BladesSurface>().blades[1].y, 200);
}

TEST_F(DesignStep, AnotherDesignBeginsAtTheFirstStep) {
  open("three-block-wall");
  auto* panel = window().findChild<WorkflowPanel*>();
  ASSERT_TRUE(panel);
  panel->verticalScrollBar()->setValue(panel->verticalScrollBar()->maximum());
  ASSERT_GT(panel->verticalScrollBar()->value(), 0);
  open("ripple-along");
  EXPECT_EQ(panel->verticalScrollBar()->value(), 0);
}

TEST_F(DesignStep, TheCurveOfASectionIsChosen) {
  open("three-block-wall");
  auto* curve = find<ChoiceField>("Curve of section 1");
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->currentIndex(), 1);
  const std::vector<Eigen::Vector2d> points = shape<SectionsSurface>().sections[0].points;
  // The line that is chosen in stays where it is, and no other one gets the keyboard.
  QScrollArea* area = nullptr;
  for (QWidget* at = curve; at && !area; at = at->parentWidget()) area = qobject_cast<QScrollArea*>(at);
  ASSERT_TRUE(area);
  area->ensureWidgetVisible(find<ChoiceField>("Curve of section 2"));
  const int scrolled = area->verticalScrollBar()->value();
  curve->setFocus();
  emit curve->activated(0);
  ASSERT_TRUE(settle());
  EXPECT_EQ(area->verticalScrollBar()->value(), scrolled);
  EXPECT_EQ(QApplication::focusWidget(), find<ChoiceField>("Curve of section 1"));
  ASSERT_TRUE(bench().current());
  const std::vector<Eigen::Vector2d> poles = shape<SectionsSurface>().sections[0].points;
  ASSERT_EQ(poles.size(), 3 * (points.size() - 1) + 1);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(poles[3 * i], points[i]);
  picture("design-chain");
  emit find<ChoiceField>("Curve of section 1")->activated(2);
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current());
  EXPECT_EQ(shape<SectionsSurface>().sections[0].points, points);
  EXPECT_EQ(find<ChoiceField>("Curve of section 1")->currentIndex(), 2);
}

TEST_F(DesignStep, ABoundNumberTellsItsExpressionAndIsFreedByTyping) {
  open("bump");
  auto* pole = find<NumberField>("pole 2 of row 3");
  ASSERT_TRUE(pole);
  EXPECT_EQ(pole->expression(), "height + bump");
  type<NumberField>("pole 2 of row 3", "300");
  type<NumberField>("bump", "100");
  EXPECT_EQ(shape<PolesSurface>().at(2, 1).height, 300);
  EXPECT_EQ(shape<PolesSurface>().at(2, 2).height, 320);
}

TEST_F(DesignStep, IsSavedAndReplacedByAFile) {
  open("bump");
  const fs::path file = path("bump.bladewright");
  ASSERT_TRUE(bench().saveTo(file));
  EXPECT_EQ(loadDesign(file).value(), bench().design());
  ASSERT_TRUE(writeFile(path("saddle.step"), geometry::exampleStep("saddle").value()));
  ASSERT_TRUE(bench().replaceSource(path("saddle.step"), "Replace surface"));
  EXPECT_FALSE(bench().design().source().surface);
  bench().document().undoStack().undo();
  EXPECT_TRUE(bench().design().source().surface);
}

}  // namespace
}  // namespace bw::app
