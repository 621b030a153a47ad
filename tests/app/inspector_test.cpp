// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The inspector: what the design tells is edited there, what is found is read.
#include "bw/core/base/units.h"
#include "bw/core/design/variables.h"
#include "bw/core/shape/section_tangents.h"
#include "bw/core/shape/told_stretches.h"
#include "controls/fields.h"
#include "window/curve_handles.h"
#include "window_fixture.h"
#include "workflow/grid_fields.h"
#include "workflow/variable_fields.h"

namespace bw::app {
namespace {

class InspectorTest : public WindowTest {
 protected:
  void open(const QString& name) {
    window().questions().unsaved = [](const QString&) { return Questions::Unsaved::discard; };
    ASSERT_TRUE(window().openExample(name));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  }
  void select(Selection::Kind kind) {
    bench().select({kind, -1});
    QTest::qWait(0);
  }
  /// Of the page that is seen.
  template <class Field = NumberField>
  Field* field(const QString& name) {
    for (Field* field : window().inspector().findChildren<Field*>())
      if (field->accessibleName() == name && field->isVisible()) return field;
    return nullptr;
  }
  template <class Field = NumberField>
  void type(const QString& name, const QString& text) {
    QTest::qWait(0);  // lines that are new are to be seen
    Field* typed = field<Field>(name);
    ASSERT_TRUE(typed && typed->isEnabled()) << name.toStdString();
    window().inspector().ensureWidgetVisible(typed);
    typed->setFocus();
    typed->selectAll();
    QTest::keyClicks(typed, text);
    QTest::keyClick(typed, Qt::Key_Return);
  }
  void choose(const QString& name, int item) {
    QTest::qWait(0);
    auto* choice = field<ChoiceField>(name);
    ASSERT_TRUE(choice) << name.toStdString();
    window().inspector().ensureWidgetVisible(choice);
    choice->setFocus();
    QTest::keyClick(choice, Qt::Key_Home);
    for (int i = 0; i < item; ++i) QTest::keyClick(choice, Qt::Key_Down);
    ASSERT_EQ(choice->currentIndex(), item);
  }
  void addVariable(const QString& text) {
    auto* line = find<NewVariableField>("New variable");
    ASSERT_TRUE(line);
    line->setFocus();
    QTest::keyClicks(line, text);
    QTest::keyClick(line, Qt::Key_Return);
    QTest::qWait(20);  // the line that took it is on its way
  }
  void chooseCurve(int curve) {
    select(Selection::Kind::surface);
    window().surfaceHandles().choose(handlesOf(*bench().source().surface, curve));
    QTest::qWait(0);
  }
  template <class Shape>
  const Shape& shape() {
    return std::get<Shape>(bench().source().surface->shape);
  }
  std::string boundAt(const std::string& place) {
    const auto bound = bench().design().bindings.find(place);
    return bound == bench().design().bindings.end() ? std::string() : bound->second.text;
  }
  int steps() { return bench().document().undoStack().index(); }
  /// Saved and read again it is the same.
  void expectKept() {
    const fs::path file = path("kept.bladewright");
    ASSERT_TRUE(bench().saveTo(file));
    const Result<Design> read = loadDesign(file);
    ASSERT_TRUE(read) << read.error().message;
    Design now = bench().design();
    now.marks = bench().document().marks();
    EXPECT_EQ(designToJson(*read), designToJson(now));
  }
};

TEST_F(InspectorTest, ExpressionsOfCutsOfAGridAreTyped) {
  ASSERT_NO_FATAL_FAILURE(open("three-block-wall"));
  ASSERT_NO_FATAL_FAILURE(addVariable("span = 600 mm, 300 to 700"));
  bench().select({Selection::Kind::result, -1, "column-2", "cut-column-2"});
  QTest::qWait(0);
  const auto stations = [&] {
    std::vector<int> all;
    for (const Cut& cut : bench().design().cuts) all.push_back(cut.sections.stations.value_or(0));
    return all;
  };
  const int first = steps();
  ASSERT_NO_FATAL_FAILURE(type("Number", "=span/40"));
  EXPECT_EQ(stations(), (std::vector<int>{15, 15, 15})) << "cuts that are alike stay so";
  EXPECT_EQ(steps(), first + 1);
  for (const char* place : {"/cuts/0/stations", "/cuts/1/stations", "/cuts/2/stations"})
    EXPECT_EQ(boundAt(place), "span/40") << place;
  // A length of its own is that of one cut, also where it comes to the same.
  ASSERT_NO_FATAL_FAILURE(type("Own length", "=span + 150"));
  EXPECT_EQ(boundAt("/cuts/1/blade_length"), "span + 150");
  EXPECT_EQ(boundAt("/cuts/0/blade_length"), "");
  EXPECT_EQ(bench().cut().length, 750);
  EXPECT_FALSE(bench().design().cuts[0].length);
  const Result<Design> read = parseDesign(designToJson(bench().design()));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(read->grid);
  EXPECT_EQ(read->bindings, bench().design().bindings);
  const Design longer = withVariables(bench().design(), {{"span", 640}}).value();
  EXPECT_EQ(longer.cuts[1].length, 790);
  EXPECT_EQ(longer.cuts[2].sections.stations, 16);
  // A number typed over it frees all that are alike, and undo goes back to the start.
  bench().select({Selection::Kind::result, -1, "column-1", "cut-column-1"});
  QTest::qWait(0);
  ASSERT_NO_FATAL_FAILURE(type("Number", "11"));
  EXPECT_EQ(stations(), (std::vector<int>{11, 15, 11}));
  bench().document().undoStack().setIndex(first);
  ASSERT_TRUE(settle());
}

TEST_F(InspectorTest, ACutIsEditedWhereItsResultIsRead) {
  ASSERT_NO_FATAL_FAILURE(open("single-block"));
  ASSERT_NO_FATAL_FAILURE(addVariable("width = 600 mm, 300 to 700"));
  select(Selection::Kind::result);
  picture("inspector-cut");
  const Design before = bench().design();
  const int first = steps();
  ASSERT_NO_FATAL_FAILURE(type("Number", "21"));
  EXPECT_EQ(bench().cut().sections.stations, 21);
  EXPECT_EQ(steps(), first + 1);
  ASSERT_NO_FATAL_FAILURE(type("Number", "=width/20"));
  EXPECT_EQ(bench().cut().sections.stations, 30);
  EXPECT_EQ(boundAt("/cuts/0/stations"), "width/20");
  ASSERT_NO_FATAL_FAILURE(choose("Stations", 2));
  ASSERT_TRUE(bench().cut().sections.spacing);
  ASSERT_NO_FATAL_FAILURE(type("Spacing", "4 cm"));
  EXPECT_EQ(bench().cut().sections.spacing, 40);
  ASSERT_NO_FATAL_FAILURE(choose("Direction", 4));
  ASSERT_NO_FATAL_FAILURE(type("Direction X", "0.1"));
  EXPECT_EQ(bench().cut().direction->x(), 0.1);
  ASSERT_NO_FATAL_FAILURE(type("Offset", "=width/100"));
  EXPECT_EQ(bench().cut().offset, 6);
  ASSERT_NO_FATAL_FAILURE(choose("Turned by", 2));
  EXPECT_EQ(bench().cut().pose.quarters, 2);
  ASSERT_NO_FATAL_FAILURE(choose("On top", 1));
  EXPECT_EQ(bench().cut().pose.up, BlockFace::bottom);
  EXPECT_FALSE(field<ChoiceField>("Order")) << "a single cut has none";
  EXPECT_FALSE(bench().cut().length);
  ASSERT_TRUE(field("Own length"));
  EXPECT_TRUE(field("Own length")->text().isEmpty()) << "it is that of the design";
  ASSERT_NO_FATAL_FAILURE(type("Own length", "=width + 300"));
  EXPECT_EQ(bench().cut().length, 900);
  EXPECT_EQ(boundAt("/cuts/0/blade_length"), "width + 300");
  // What cannot be is told, and the design stays.
  auto* length = field("Own length");
  length->setFocus();
  length->selectAll();
  QTest::keyClicks(length, "5");
  QTest::keyClick(length, Qt::Key_Return);
  EXPECT_TRUE(length->refused());
  QTest::keyClick(length, Qt::Key_Escape);
  EXPECT_EQ(bench().cut().length, 900);
  ASSERT_NO_FATAL_FAILURE(choose("Stations", 1));
  ASSERT_NO_FATAL_FAILURE(choose("Direction", 2));
  ASSERT_NO_FATAL_FAILURE(expectKept());
  // What is found is read, not typed.
  for (const char* name : {"Surface shown", "Mean", "Smallest radius", "Cutting time"}) {
    EXPECT_TRUE(field<ValueLabel>(name)) << name;
    EXPECT_FALSE(field(name)) << name;
  }
  bench().document().undoStack().setIndex(first);
  EXPECT_EQ(bench().design(), before);
  ASSERT_NO_FATAL_FAILURE(open("two-crossing-cuts"));
  select(Selection::Kind::result);
  ASSERT_NO_FATAL_FAILURE(choose("Order", 2));
  EXPECT_EQ(bench().cut().order, 2);
  EXPECT_FALSE(field("Offset")) << "only a cut alone in its block has one";
}

TEST_F(InspectorTest, ASectionIsEditedPointByPoint) {
  ASSERT_NO_FATAL_FAILURE(open("twist"));
  select(Selection::Kind::surface);
  EXPECT_FALSE(field("y of section 2")) << "no curve is chosen";
  ASSERT_NO_FATAL_FAILURE(chooseCurve(1));
  picture("inspector-section");
  const int first = steps();
  const auto section = [this] { return shape<SectionsSurface>().sections[1]; };
  EXPECT_FALSE(field("y of section 1"));
  ASSERT_NO_FATAL_FAILURE(type("x of point 2 of section 2", "21 cm"));
  EXPECT_EQ(section().points[1].x(), 210);
  ASSERT_NO_FATAL_FAILURE(type("z of point 2 of section 2", "=height + 2*rise"));
  EXPECT_EQ(boundAt("/sources/0/surface/sections/1/bezier/1/1"), "height + 2*rise");
  ASSERT_NO_FATAL_FAILURE(type("y of section 2", "390"));
  EXPECT_EQ(section().y, 390);
  EXPECT_EQ(steps(), first + 3);
  // Beyond the next one it cannot lie, and that is told at the field.
  ASSERT_NO_FATAL_FAILURE(type("y of section 2", "900"));
  EXPECT_EQ(section().y, 390);
  EXPECT_EQ(steps(), first + 3);
  EXPECT_TRUE(
      field("y of section 2")->refusal().startsWith("It must lie before section 3, at less than 800 mm"))
      << field("y of section 2")->refusal().toStdString();
  QTest::keyClick(field("y of section 2"), Qt::Key_Escape);
  EXPECT_EQ(field("y of section 2")->text(), "390");
  // A tangent turns its leg about the pole, which keeps its length.
  const Eigen::Vector2d leg = section().points[1] - section().points[0];
  ASSERT_NO_FATAL_FAILURE(type("tangent at pole 1 of section 2", "30"));
  const Eigen::Vector2d turned = section().points[1] - section().points[0];
  EXPECT_NEAR(std::atan2(turned.y(), turned.x()), 30 * kDegree, 1e-12);
  EXPECT_NEAR(turned.norm(), leg.norm(), 1e-9);
  EXPECT_EQ(field("tangent at pole 1 of section 2")->text(), "30");
  EXPECT_EQ(boundAt("/sources/0/surface/sections/1/bezier/1/1"), "") << "it is free";
  // And where the whole surface lies.
  ASSERT_NO_FATAL_FAILURE(type("Origin Z", "=rise/10"));
  EXPECT_EQ(boundAt("/sources/0/surface/frame/origin/2"), "rise/10");
  ASSERT_NO_FATAL_FAILURE(type("Turned about Z", "2"));
  EXPECT_NEAR(bench().source().surface->rotation.z(), 2 * kDegree, 1e-12);
  ASSERT_NO_FATAL_FAILURE(expectKept());
  ASSERT_TRUE(settle());
  picture("inspector-section-edited");
  bench().document().undoStack().setIndex(first);
  EXPECT_EQ(field("y of section 2")->text(), "400");
  // Of a joint both legs turn, and stay in line.
  ASSERT_NO_FATAL_FAILURE(open("three-block-wall"));
  ASSERT_NO_FATAL_FAILURE(chooseCurve(1));
  ASSERT_NO_FATAL_FAILURE(choose("Curve of section 2", 0));
  ASSERT_EQ(section().points.size(), 10u) << "three cubics";
  ASSERT_NO_FATAL_FAILURE(type("tangent at pole 4 of section 2", "5"));
  for (const std::size_t from : {2u, 3u}) {
    const Eigen::Vector2d along = section().points[from + 1] - section().points[from];
    EXPECT_NEAR(std::atan2(along.y(), along.x()), 5 * kDegree, 1e-9);
  }
}

TEST_F(InspectorTest, ATangentAndADirectionStandForExpressions) {
  ASSERT_NO_FATAL_FAILURE(open("twist"));
  ASSERT_NO_FATAL_FAILURE(addVariable("lean = 20, 0 to 60"));
  ASSERT_NO_FATAL_FAILURE(chooseCurve(1));
  const auto section = [this] { return shape<SectionsSurface>().sections[1]; };
  constexpr const char* kTold = "/sources/0/surface/sections/1/tangents_deg/0";
  const QString tangent = "tangent at pole 1 of section 2";
  ASSERT_NO_FATAL_FAILURE(type("z of point 2 of section 2", "=height + 2*rise"));
  ASSERT_NO_FATAL_FAILURE(type(tangent, "=lean + 10"));
  EXPECT_EQ(boundAt(kTold), "lean + 10");
  EXPECT_EQ(boundAt("/sources/0/surface/sections/1/bezier/1/1"), "") << "the leg is free of its own";
  EXPECT_EQ(field(tangent)->expression(), "lean + 10");
  EXPECT_EQ(field(tangent)->text(), "30");
  const auto angle = [&] { return *tangentAt(section(), 0); };
  EXPECT_NEAR(angle(), 30, 1e-9);
  ASSERT_NO_FATAL_FAILURE(expectKept());
  picture("inspector-tangent-bound");
  const auto setLean = [&](const QString& to) {
    auto* lean = find<NumberField>("lean");
    ASSERT_TRUE(lean);
    lean->setFocus();
    lean->selectAll();
    QTest::keyClicks(lean, to);
    QTest::keyClick(lean, Qt::Key_Return);
  };
  ASSERT_NO_FATAL_FAILURE(setLean("5"));
  EXPECT_NEAR(angle(), 15, 1e-9);
  EXPECT_EQ(field(tangent)->text(), "15");
  // Where the pole is moved the tangent stays; a leg that is typed over frees it.
  ASSERT_NO_FATAL_FAILURE(type("z of point 1 of section 2", "310"));
  EXPECT_NEAR(angle(), 15, 1e-9);
  EXPECT_EQ(boundAt(kTold), "lean + 10");
  ASSERT_NO_FATAL_FAILURE(type("z of point 2 of section 2", "300"));
  EXPECT_EQ(boundAt(kTold), "");
  EXPECT_EQ(field(tangent)->expression(), "");
  // The way of travel, and the way up.
  select(Selection::Kind::result);
  ASSERT_NO_FATAL_FAILURE(choose("Direction", 4));
  ASSERT_NO_FATAL_FAILURE(type("Direction X", "=lean/100"));
  EXPECT_EQ(boundAt("/cuts/0/direction/0"), "lean/100");
  EXPECT_EQ(bench().cut().direction->x(), 0.05);
  ASSERT_NO_FATAL_FAILURE(expectKept());
  picture("inspector-direction-bound");
  ASSERT_NO_FATAL_FAILURE(setLean("0"));
  EXPECT_EQ(bench().cut().direction->x(), 0);
  EXPECT_EQ(field<ChoiceField>("Direction")->currentIndex(), 4) << "it is an axis, but stands for more";
  EXPECT_EQ(field("Direction X")->expression(), "lean/100");
  // An axis stands for none, be it the same way.
  ASSERT_EQ(*bench().cut().direction, Eigen::Vector3d::UnitZ());
  field<ChoiceField>("Direction")->setFocus();
  QTest::keyClick(field<ChoiceField>("Direction"), Qt::Key_Up);
  EXPECT_EQ(boundAt("/cuts/0/direction/0"), "");
  EXPECT_EQ(field<ChoiceField>("Direction")->currentIndex(), 3);
  EXPECT_EQ(*bench().cut().direction, Eigen::Vector3d::UnitZ());
  bench().document().undoStack().undo();
  EXPECT_EQ(boundAt("/cuts/0/direction/0"), "lean/100");
}

TEST_F(InspectorTest, AStationTellsWhereTheKeyBladesAreNone) {
  ASSERT_NO_FATAL_FAILURE(open("key-blade-fan"));
  bench().selectStation(3);
  QTest::qWait(0);
  const auto told = [this]() -> const ValueLabel* {
    return field<ValueLabel>("Told by the key blades here");
  };
  EXPECT_FALSE(told()) << "of good ones nothing is told";
  double y = 0;
  bench().editSurface("Bend", [&](DesignedSurface& surface) {
    KeyBlade& blade = std::get<BladesSurface>(surface.shape).blades[1];
    blade.bend = std::copysign(1.1 * blade.length / bench().design().blade.minRadius(), blade.bend);
    y = blade.y;
  });
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  ASSERT_FALSE(bench().shown()->told[0].value->empty());
  const ToldStretch stretch = bench().shown()->told[0].value->front();
  ASSERT_LT(stretch.from, y);
  int in = 0, out = 0;
  const auto result = bench().sweep();
  const DesignedSurface& surface = *bench().source().surface;
  const Eigen::Vector3d along = rotationFromAngles(surface.rotation).col(1);
  for (std::size_t i = 0; i < result->size(); ++i) {
    const double at = (result->station(i).pose.frame.origin - surface.origin).dot(along);
    bench().selectStation(int(i));
    QTest::qWait(0);
    const bool within = at >= stretch.from && at <= stretch.to;
    ASSERT_EQ(told() != nullptr, within) << i;
    ++(within ? in : out);
    if (!within) continue;
    EXPECT_TRUE(told()->text().contains("the key blades tell shapes that bend to a radius of"))
        << told()->text().toStdString();
    EXPECT_TRUE(told()->text().startsWith("At y = "));
    EXPECT_TRUE(told()->broken());
    if (in == 1) picture("inspector-told");
  }
  EXPECT_GT(in, 0);
  EXPECT_GT(out, 0);
}

TEST_F(InspectorTest, KeyBladesRowsAndFormulasAreEdited) {
  ASSERT_NO_FATAL_FAILURE(open("key-blade-fan"));
  ASSERT_NO_FATAL_FAILURE(chooseCurve(1));
  picture("inspector-key-blade");
  const auto blade = [this] { return shape<BladesSurface>().blades[1]; };
  ASSERT_NO_FATAL_FAILURE(type("Length of key blade 2", "650"));
  EXPECT_EQ(blade().length, 650);
  ASSERT_NO_FATAL_FAILURE(type("Middle z of key blade 2", "=height + 5"));
  EXPECT_EQ(boundAt("/sources/0/surface/blades/1/middle/1"), "height + 5");
  ASSERT_NO_FATAL_FAILURE(type("Lean of key blade 2", "3"));
  EXPECT_NEAR(blade().angle, 3 * kDegree, 1e-12);
  ASSERT_NO_FATAL_FAILURE(type("Force along of key blade 2", "-2"));
  EXPECT_EQ(blade().force.x(), -2);
  ASSERT_NO_FATAL_FAILURE(expectKept());
  ASSERT_NO_FATAL_FAILURE(open("single-block"));
  ASSERT_NO_FATAL_FAILURE(chooseCurve(2));
  picture("inspector-row");
  ASSERT_NO_FATAL_FAILURE(type("pole 2 of row 3", "345"));
  EXPECT_EQ(shape<PolesSurface>().at(2, 1).height, 345);
  EXPECT_FALSE(field("x to")) << "it is of the whole";
  window().surfaceHandles().choose({});
  ASSERT_NO_FATAL_FAILURE(type("x to", "610"));
  EXPECT_EQ(shape<PolesSurface>().over.max.x(), 610);
  ASSERT_NO_FATAL_FAILURE(open("ripple-along"));
  select(Selection::Kind::surface);
  auto* formula = field<FormulaField>("Formula");
  ASSERT_TRUE(formula);
  formula->setFocus();
  formula->selectAll();
  QTest::keyClicks(formula, "height + x/20");
  QTest::keyClick(formula, Qt::Key_Return);
  EXPECT_EQ(shape<FormulaSurface>().formula, "height + x/20");
  picture("inspector-formula");
}

TEST_F(InspectorTest, BlocksSideBySideHaveSizesAndGaps) {
  ASSERT_NO_FATAL_FAILURE(open("single-block"));
  select(Selection::Kind::block);
  EXPECT_FALSE(field<LengthsField>("Columns, gaps"));
  ASSERT_NO_FATAL_FAILURE(type("Corner Z", "-10"));
  EXPECT_EQ(bench().block().placement->origin.z(), -10);
  ASSERT_NO_FATAL_FAILURE(open("three-block-wall"));
  select(Selection::Kind::block);
  picture("inspector-wall");
  ASSERT_NO_FATAL_FAILURE(type<LengthsField>("Columns, gaps", "4"));
  EXPECT_EQ(bench().design().grid->gaps[0], (std::vector<double>{4, 4}));
  ASSERT_NO_FATAL_FAILURE(expectKept());
}

}  // namespace
}  // namespace bw::app
