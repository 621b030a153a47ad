// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The plan of the blocks in the window, their numbers, and the table of their cuts.
#include <QAbstractItemView>
#include <QScrollArea>
#include <QWheelEvent>

#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/design/grid_change.h"
#include "bw/core/design/variables.h"
#include "bw/pipeline/scene_content.h"
#include "controls/fields.h"
#include "window_fixture.h"
#include "workbench/block_layout.h"
#include "workflow/grid_fields.h"

namespace bw::app {
namespace {

class BlockPanelTest : public WindowTest {
 protected:
  void open(const char* example) {
    ASSERT_TRUE(window().openExample(example));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
    QTest::keyClick(&window(), Qt::Key_7, Qt::ControlModifier);
    ASSERT_TRUE(QTest::qWaitFor([&] { return plan().isVisible(); }, kPatience));
    QTest::qWait(0);
  }

  BlockPlan& plan() { return window().blockPanel().plan(); }
  QPoint at(const std::string& block) { return plan().rectOf(block).center().toPoint(); }
  const std::string& chosen() { return bench().selection().block; }
  const BlockGrid& grid() { return *bench().design().grid; }

  /// Presses a boundary and pulls it by so many px.
  void pull(std::size_t way, std::size_t index, const QPoint& by, Qt::KeyboardModifiers keys = {}) {
    const QPoint from = plan().boundary(way, index).toPoint();
    QTest::mouseMove(&plan(), from);
    QTest::mousePress(&plan(), Qt::LeftButton, keys, from);
    for (int i = 1; i <= 5; ++i) {
      const QPoint to = from + by * i / 5;
      QMouseEvent move(QEvent::MouseMove, to, plan().mapToGlobal(to), Qt::NoButton, Qt::LeftButton, keys);
      QApplication::sendEvent(&plan(), &move);
      QTest::qWait(5);
    }
  }
  void release() { QTest::mouseRelease(&plan(), Qt::LeftButton); }

  template <class Field>
  Field* fieldOf(const QString& name) {
    for (auto* field : window().blockPanel().findChildren<Field*>())
      if (field->accessibleName() == name && field->isVisible()) {
        for (QWidget* above = field->parentWidget(); above; above = above->parentWidget())
          if (auto* area = qobject_cast<QScrollArea*>(above)) area->ensureWidgetVisible(field);
        QTest::qWait(0);
        return field;
      }
    return nullptr;
  }

  template <class Field = NumberField>
  void type(const QString& name, const QString& text) {
    auto* field = fieldOf<Field>(name);
    ASSERT_TRUE(field) << name.toStdString();
    QTest::mouseClick(field, Qt::LeftButton);
    QTest::keyClick(field, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
    EXPECT_FALSE(field->refused()) << field->refusal().toStdString();
    QTest::qWait(20);
  }

  /// Chooses with the keyboard from the list that a press opens.
  void choose(const QString& name, const QString& item) {
    auto* field = fieldOf<ChoiceField>(name);
    ASSERT_TRUE(field) << name.toStdString();
    ASSERT_FALSE(field->visibleRegion().isEmpty());
    const int index = field->findText(item);
    ASSERT_GE(index, 0) << item.toStdString();
    QTest::mouseClick(field, Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return field->view()->isVisible(); }, kPatience));
    QTest::keyClick(field->view(), Qt::Key_Home);
    for (int i = 0; i < index; ++i) QTest::keyClick(field->view(), Qt::Key_Down);
    QTest::keyClick(field->view(), Qt::Key_Return);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !field->view()->isVisible(); }, kPatience));
    QTest::qWait(20);
  }
};

TEST_F(BlockPanelTest, AClickChoosesABlockAndTheArrowsItsNeighbours) {
  ASSERT_NO_FATAL_FAILURE(open("three-block-wall"));
  for (const char* block : {"column-1", "column-2", "column-3"}) {
    EXPECT_FALSE(plan().rectOf(block).isEmpty()) << block;
    EXPECT_EQ(plan().wordOf(block), "cuttable") << block;
  }
  EXPECT_LT(at("column-1").x(), at("column-2").x());
  QTest::mouseClick(&plan(), Qt::LeftButton, {}, at("column-2"));
  EXPECT_EQ(chosen(), "column-2");
  EXPECT_EQ(bench().selection().cut, "cut-column-2");
  EXPECT_EQ(bench().selection().kind, Selection::Kind::block);
  EXPECT_EQ(&bench().sweep()->sweep, bench().shown()->blocks[1].cuts[0].sweep.value.get());
  picture("blocks-panel");
  QTest::keyClick(&plan(), Qt::Key_Right);
  EXPECT_EQ(chosen(), "column-3");
  QTest::keyClick(&plan(), Qt::Key_Right);
  EXPECT_EQ(chosen(), "column-3") << "the last";
  QTest::keyClick(&plan(), Qt::Key_Left);
  QTest::keyClick(&plan(), Qt::Key_Left);
  EXPECT_EQ(chosen(), "column-1");
  theme().apply(model::ThemeChoice::dark);
  picture("blocks-panel-dark");
  theme().apply(model::ThemeChoice::light);
  // What is chosen elsewhere is chosen here.
  bench().select({Selection::Kind::result, -1, "column-3", "cut-column-3"});
  QTest::qWait(0);
  EXPECT_TRUE(find<QToolButton>("Work on cut-column-3"));
}

TEST_F(BlockPanelTest, OneOfManyBlocksIsHitAndBroughtNear) {
  ASSERT_NO_FATAL_FAILURE(open("three-block-wall"));
  const BlockGrid many = withCount(grid(), 0, 60, false);
  ASSERT_TRUE(layOut(bench(), "Columns", bench().design(), grid(), many, bench().newMergeId(), false));
  bench().runner().cancel();
  QTest::qWait(0);
  for (const char* block : {"column-1", "column-30", "column-60"}) {
    QTest::mouseClick(&plan(), Qt::LeftButton, {}, at(block));
    EXPECT_EQ(chosen(), block);
  }
  const QRectF far = plan().rectOf("column-30");
  const auto turn = [&](int by) {
    QWheelEvent wheel(far.center(), plan().mapToGlobal(far.center()), {}, {0, by}, Qt::NoButton, {},
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&plan(), &wheel);
    return wheel.isAccepted();
  };
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(turn(120));
  const QRectF near = plan().rectOf("column-30");
  EXPECT_NEAR(near.width(), 16 * far.width(), 0.01 * near.width());
  EXPECT_TRUE(near.contains(far.center())) << "it stays under the hand";
  picture("blocks-plan-near");
  QTest::mouseClick(&plan(), Qt::LeftButton, {}, at("column-31"));
  EXPECT_EQ(chosen(), "column-31");
  // It is pulled by the hand, and goes with what is selected.
  const QPoint from = at("column-31"), to = from - QPoint(40, 0);
  QTest::mousePress(&plan(), Qt::LeftButton, {}, from);
  QMouseEvent move(QEvent::MouseMove, to, plan().mapToGlobal(to), Qt::NoButton, Qt::LeftButton, {});
  QApplication::sendEvent(&plan(), &move);
  QTest::mouseRelease(&plan(), Qt::LeftButton, {}, to);
  EXPECT_NEAR(at("column-31").x(), to.x(), 2);
  for (int i = 0; i < 20; ++i) QTest::keyClick(&plan(), Qt::Key_Right);
  EXPECT_EQ(chosen(), "column-51");
  EXPECT_TRUE(plan().rect().contains(at("column-51")));
  for (int i = 0; i < 8; ++i) turn(-120);
  EXPECT_GE(plan().rectOf("column-1").left(), 0);
  EXPECT_LE(plan().rectOf("column-60").right(), plan().width());
  EXPECT_FALSE(turn(-120)) << "what is around is moved then";
}

TEST_F(BlockPanelTest, ABoundaryThatIsPulledMovesSizes) {
  ASSERT_NO_FATAL_FAILURE(open("block-wall"));
  const Design before = bench().design();
  ASSERT_EQ(grid().sizes[0], (std::vector<double>{600, 600, 600}));
  pull(0, 0, {5, 0});
  const double first = grid().sizes[0][0];
  EXPECT_GT(first, 610);
  EXPECT_LT(first, 700);
  EXPECT_EQ(first, std::round(first)) << "whole mm";
  EXPECT_EQ(grid().sizes[0][1], 1200 - first);
  EXPECT_EQ(grid().sizes[0][2], 600);
  picture("blocks-panel-pulled");
  release();
  EXPECT_EQ(grid().sizes[0][0], first) << "stays as it was let go";
  // The points of the sections stay on the boundaries.
  EXPECT_EQ(std::get<SectionsSurface>(bench().source().surface->shape).sections[0].points[1].x(), first);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  EXPECT_EQ(bench().shown()->blocks[1].cuts[0].setup->block.frame.origin.x(), first);
  EXPECT_EQ(chosen(), "column-1") << "a pull chooses nothing";
  // One step for the whole pull.
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design(), before);
  EXPECT_FALSE(bench().document().undoStack().canUndo());

  pull(0, 1, {-5, 0}, Qt::ShiftModifier);
  release();
  EXPECT_LT(grid().sizes[0][1], 600);
  EXPECT_EQ(std::fmod(grid().sizes[0][1], 10), 0) << "tens";
  bench().document().undoStack().undo();
  pull(0, 1, {5, 0}, Qt::ControlModifier);
  release();
  EXPECT_GT(grid().sizes[0][1], 600);
  EXPECT_LT(grid().sizes[0][1], 612) << "a tenth of the way of the hand";
  bench().document().undoStack().undo();
  // Neither block goes.
  pull(0, 1, {-2000, 0});
  release();
  EXPECT_EQ(grid().sizes[0], (std::vector<double>{600, 10, 1190}));
  bench().document().undoStack().undo();
  // Esc gives it up.
  pull(0, 0, {5, 0});
  QTest::keyClick(&plan(), Qt::Key_Escape);
  EXPECT_EQ(bench().design(), before);
  release();
  EXPECT_EQ(bench().design(), before);
}

TEST_F(BlockPanelTest, RowsAndLayersAreNumbersAndLayersAreSwitched) {
  ASSERT_NO_FATAL_FAILURE(open("block-wall"));
  ASSERT_NO_FATAL_FAILURE(type("Rows", "2"));
  ASSERT_NO_FATAL_FAILURE(type<LengthsField>("Rows, gaps", "40"));
  EXPECT_EQ(bench().design().stock.size(), 6u);
  EXPECT_EQ(grid().gaps[1], std::vector<double>{40});
  // A second row is behind the first: above it as seen from above.
  EXPECT_LT(at("column-1-row-2").y(), at("column-1-row-1").y());
  pull(1, 0, {0, -8});
  release();
  EXPECT_GT(grid().sizes[1][0], 800);
  EXPECT_EQ(grid().sizes[1][0] + grid().sizes[1][1], 1600);
  EXPECT_EQ(grid().gaps[1], std::vector<double>{40}) << "the gap stays";
  EXPECT_FALSE(fieldOf<ChoiceField>("Layer"));
  ASSERT_NO_FATAL_FAILURE(type("Layers", "2"));
  EXPECT_EQ(plan().layers(), 2);
  ASSERT_NO_FATAL_FAILURE(choose("Layer", "Layer 2 of 2"));
  EXPECT_TRUE(plan().rectOf("column-1-row-1-layer-1").isEmpty());
  QTest::mouseClick(&plan(), Qt::LeftButton, {}, at("column-2-row-1-layer-2"));
  EXPECT_EQ(chosen(), "column-2-row-1-layer-2");
  plan().setFocus();
  QTest::keyClick(&plan(), Qt::Key_PageDown);
  EXPECT_EQ(plan().layer(), 0);
  picture("blocks-panel-layers");
  // One that is chosen in the picture brings its layer.
  bench().select({Selection::Kind::block, -1, "column-3-row-2-layer-2", "cut-column-3-row-2-layer-2"});
  EXPECT_EQ(plan().layer(), 1);
}

TEST_F(BlockPanelTest, SizesGapsAndCountsAreExpressionsToo) {
  ASSERT_NO_FATAL_FAILURE(open("block-wall"));
  bench().editDesign("Prepare", [](Design& design) {
    design.variables.push_back({"width", 600, 300, 900});
    design.variables.push_back({"blocks", 3, 1, 6});
  });
  const auto boundAt = [&](const std::string& place) {
    const auto bound = bench().design().bindings.find(place);
    return bound == bench().design().bindings.end() ? std::string() : bound->second.text;
  };
  const auto setVariable = [&](const char* name, double value) {
    const Result<Design> changed = withVariables(bench().design(), {{name, value}});
    ASSERT_TRUE(changed) << changed.error().message;
    bench().editDesign("Change variable", [&](Design& design) { design = *changed; });
  };
  QUndoStack& undo = bench().document().undoStack();
  const int before = undo.index();
  // What it comes to is what it was: one step, which binds all three.
  ASSERT_NO_FATAL_FAILURE(type<LengthsField>("Columns, sizes", "=width"));
  EXPECT_EQ(boundAt("/grid/sizes/columns"), "width");
  EXPECT_EQ(undo.index(), before + 1);
  auto* sizes = fieldOf<LengthsField>("Columns, sizes");
  EXPECT_EQ(sizes->text(), "600");
  EXPECT_EQ(sizes->expression(), "=width");
  ASSERT_NO_FATAL_FAILURE(setVariable("width", 620));
  EXPECT_EQ(grid().sizes[0], (std::vector<double>{620, 620, 620}));
  EXPECT_EQ(sizes->text(), "620");
  // One each, with brackets of their own.
  ASSERT_NO_FATAL_FAILURE(type<LengthsField>("Columns, sizes", "=max(width; 100), 50 cm; =width/2"));
  EXPECT_EQ(grid().sizes[0], (std::vector<double>{620, 500, 310}));
  EXPECT_EQ(boundAt("/grid/sizes/columns"), "");
  EXPECT_EQ(boundAt("/grid/sizes/columns/2"), "width/2");
  EXPECT_EQ(bench().design().stock[2].placement->origin.x(), 1120);
  ASSERT_NO_FATAL_FAILURE(type<LengthsField>("Columns, gaps", "=width/62; 0"));
  EXPECT_EQ(grid().gaps[0], (std::vector<double>{10, 0}));
  picture("blocks-panel-expressions");
  // With the keyboard it shows what can be typed into; to look at it is no edit.
  const int steps = undo.index();
  sizes->setFocus(Qt::TabFocusReason);
  EXPECT_EQ(sizes->text(), "=max(width; 100); 500; =width/2");
  picture("blocks-panel-expressions-typed");
  QTest::keyClick(sizes, Qt::Key_Return);
  EXPECT_EQ(undo.index(), steps);
  EXPECT_EQ(sizes->text(), "620; 500; 310");
  // Its file holds it.
  const Design again = parseDesign(designToJson(bench().design())).value();
  EXPECT_EQ(again.bindings, bench().design().bindings);
  EXPECT_EQ(again.grid, bench().design().grid);
  // A number takes the place of one of them, and a pull of a boundary of those beside it.
  ASSERT_NO_FATAL_FAILURE(type<LengthsField>("Columns, sizes", "=width; 500; 310"));
  EXPECT_EQ(boundAt("/grid/sizes/columns/0"), "width");
  EXPECT_EQ(boundAt("/grid/sizes/columns/2"), "");
  pull(0, 0, {5, 0});
  release();
  EXPECT_EQ(boundAt("/grid/sizes/columns/0"), "");
  EXPECT_EQ(sizes->expression(), "");
  undo.undo();
  EXPECT_EQ(sizes->expression(), "=width; 500; 310");
  // Counts follow where one size is told for all of them.
  ASSERT_NO_FATAL_FAILURE(type<LengthsField>("Columns, sizes", "=width"));
  ASSERT_NO_FATAL_FAILURE(type<LengthsField>("Columns, gaps", "0"));
  ASSERT_NO_FATAL_FAILURE(type("Columns", "=blocks"));
  EXPECT_EQ(boundAt("/grid/columns"), "blocks");
  EXPECT_EQ(fieldOf<NumberField>("Columns")->expression(), "blocks");
  for (const int count : {2, 1, 4}) {
    ASSERT_NO_FATAL_FAILURE(setVariable("blocks", count));
    EXPECT_EQ(grid().sizes[0], std::vector<double>(std::size_t(count), 620)) << count;
    EXPECT_EQ(fieldOf<NumberField>("Columns")->expression(), "blocks");
    EXPECT_EQ(boundAt("/grid/sizes/columns"), "width");
  }
  undo.setIndex(before);
  EXPECT_TRUE(bench().design().bindings.empty());
  EXPECT_EQ(sizes->expression(), "");
}

TEST_F(BlockPanelTest, WhereTheGridStandsIsTypedAndTakesExpressions) {
  ASSERT_NO_FATAL_FAILURE(open("block-wall"));
  bench().editDesign("Prepare", [](Design& design) { design.variables.push_back({"reach", 40, 0, 90}); });
  const auto boundAt = [&](const std::string& place) {
    const auto bound = bench().design().bindings.find(place);
    return bound == bench().design().bindings.end() ? std::string() : bound->second.text;
  };
  const Design before = bench().design();
  ASSERT_NO_FATAL_FAILURE(type("Corner X", "=-reach/4"));
  ASSERT_NO_FATAL_FAILURE(type("Corner Z", "-25"));
  ASSERT_NO_FATAL_FAILURE(type("Rotation Z", "=reach/80"));
  ASSERT_NO_FATAL_FAILURE(type<LengthsField>("Layers, sizes", "=500 + reach"));
  EXPECT_EQ(grid().origin, Eigen::Vector3d(-10, before.grid->origin.y(), -25));
  EXPECT_NEAR(grid().rotation.z(), 0.5 * kDegree, 1e-12);
  EXPECT_EQ(boundAt("/grid/origin/0"), "-reach/4");
  EXPECT_EQ(boundAt("/grid/origin/2"), "");
  EXPECT_EQ(boundAt("/grid/rotation_deg/2"), "reach/80");
  EXPECT_EQ(boundAt("/grid/sizes/layers"), "500 + reach");
  EXPECT_EQ(bench().design().stock, stockOf(grid())) << "its blocks stand there";
  EXPECT_EQ(bench().design().sources, before.sources) << "the surface stays";
  EXPECT_EQ(bench().design().cuts, before.cuts);
  const Design again = parseDesign(designToJson(bench().design())).value();
  EXPECT_EQ(again.bindings, bench().design().bindings);
  EXPECT_EQ(again.grid, bench().design().grid);
  picture("blocks-panel-corner");
  const Result<Design> moved = withVariables(bench().design(), {{"reach", 60}});
  ASSERT_TRUE(moved) << moved.error().message;
  EXPECT_EQ(moved->grid->origin.x(), -15);
  EXPECT_EQ(moved->stock.front().placement->origin.x(), -15);
  EXPECT_EQ(moved->grid->sizes[2], std::vector<double>{560});
  // A number takes the place of an expression.
  ASSERT_NO_FATAL_FAILURE(type("Corner X", "-10"));
  EXPECT_EQ(boundAt("/grid/origin/0"), "");
  EXPECT_EQ(fieldOf<NumberField>("Corner X")->expression(), "");
  bench().document().undoStack().setIndex(1);
  EXPECT_EQ(bench().design(), before);
}

TEST_F(BlockPanelTest, AWrongExpressionOfTheGridSaysWhatIsWrong) {
  ASSERT_NO_FATAL_FAILURE(open("block-wall"));
  bench().editDesign("Prepare", [](Design& design) { design.variables.push_back({"width", 600, 300, 900}); });
  const auto refusal = [&](TypedField* field, const QString& text) {
    const Design design = bench().design();
    const QString shown = field->text();
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
    EXPECT_TRUE(field->refused()) << text.toStdString();
    const std::string why = field->refusal().toStdString();
    QTest::keyClick(field, Qt::Key_Escape);
    EXPECT_EQ(field->text(), shown);
    EXPECT_EQ(bench().design(), design);
    return why;
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  auto* sizes = fieldOf<LengthsField>("Columns, sizes");
  ASSERT_TRUE(sizes);
  std::string why = refusal(sizes, "=widht");
  EXPECT_TRUE(has(why, "After its =, character 1: there is no \u201cwidht\u201d; did you mean")) << why;
  why = refusal(sizes, "600; =width*1000; 600");
  EXPECT_TRUE(has(why, "Length 2: This comes to 600000 mm, which is out of range")) << why;
  why = refusal(sizes, "=width; 600");
  EXPECT_TRUE(has(why, "there must be 3")) << why;
  why = refusal(sizes, "=max(width; 600");
  EXPECT_TRUE(has(why, "After its =")) << why;
  why = refusal(fieldOf<NumberField>("Columns"), "=width/400");
  EXPECT_TRUE(has(why, "must be a whole number")) << why;
  why = refusal(fieldOf<NumberField>("Columns"), "=width/600");
  EXPECT_TRUE(has(why, "a single block lies in no grid")) << why;
  // The file of such cuts has a list of blocks, and no grid.
  bench().editDesign("Prepare", [](Design& design) { std::swap(design.cuts[0], design.cuts[2]); });
  ASSERT_FALSE(parseDesign(designToJson(bench().design()))->grid);
  why = refusal(sizes, "=width");
  EXPECT_TRUE(has(why, "no expression can stand here")) << why;
}

TEST_F(BlockPanelTest, TheStateOfEachBlockIsAWord) {
  ASSERT_NO_FATAL_FAILURE(open("block-wall"));
  ASSERT_NO_FATAL_FAILURE(type("Columns", "4"));
  EXPECT_EQ(plan().wordOf("column-4"), "not computed");
  EXPECT_EQ(plan().wordOf("column-1"), "out of date");
  ASSERT_TRUE(settle());
  EXPECT_EQ(plan().wordOf("column-4"), "cuttable");
  bench().editDesign("Prepare", [](Design& design) {
    auto& sections = std::get<SectionsSurface>(design.source().surface->shape).sections;
    // A crest within the fourth block that is too tight for the blade.
    for (SectionCurve& section : sections) section.points.insert(section.points.begin() + 4, {2100, 480});
  });
  ASSERT_TRUE(settle());
  EXPECT_TRUE(plan().wordOf("column-4").contains("error") || plan().wordOf("column-4") == "no result")
      << plan().wordOf("column-4").toStdString();
  picture("blocks-panel-errors");
}

TEST_F(BlockPanelTest, TheCutsOfTheBlockAreATable) {
  ASSERT_NO_FATAL_FAILURE(open("two-crossing-cuts"));
  const Design before = bench().design();
  picture("blocks-panel-cuts");
  // What the heights tell is seen.
  const auto& made = bench().shown()->blocks[0].cuts;
  for (std::size_t i = 0; i < 2; ++i) {
    const QString order = "Order, " + QString::fromStdString(made[i].id);
    EXPECT_EQ(fieldOf<ChoiceField>(order)->shownText(), QString("%1 (auto)").arg(i + 1));
  }
  auto* turn = fieldOf<ChoiceField>("Turned by, north");
  ASSERT_TRUE(turn);
  EXPECT_EQ(turn->currentText(), "90°");
  EXPECT_EQ(bench().cut().id, "east");
  QTest::mouseClick(fieldOf<QToolButton>("Work on north"), Qt::LeftButton);
  EXPECT_EQ(bench().cut().id, "north");
  EXPECT_TRUE(fieldOf<QToolButton>("Work on north")->isChecked());
  EXPECT_FALSE(fieldOf<QToolButton>("Work on east")->isChecked());
  // A line that is changed is the cut at work.
  ASSERT_NO_FATAL_FAILURE(choose("Keeps what is, east", "Above"));
  EXPECT_EQ(bench().cut().id, "east");
  EXPECT_EQ(bench().cut().keep, KeptSide::above);
  ASSERT_NO_FATAL_FAILURE(choose("Turned by, north", "270°"));
  ASSERT_NO_FATAL_FAILURE(choose("Order, north", "1"));
  ASSERT_NO_FATAL_FAILURE(choose("On top, north", "Back"));
  EXPECT_EQ(bench().design().cuts[1].pose, (CutPose{BlockFace::back, 3}));
  EXPECT_EQ(bench().design().cuts[1].order, 1);
  bench().document().undoStack().setIndex(0);
  EXPECT_EQ(bench().design(), before);
  EXPECT_EQ(turn->currentText(), "90°");
}

TEST_F(BlockPanelTest, ASingleBlockBecomesAWall) {
  ASSERT_NO_FATAL_FAILURE(open("ripple-along"));
  EXPECT_FALSE(plan().rectOf("block").isEmpty());
  EXPECT_FALSE(fieldOf<ChoiceField>("Order, cut"));
  picture("blocks-panel-single");
  ASSERT_NO_FATAL_FAILURE(type("Columns", "2"));
  ASSERT_TRUE(bench().design().grid);
  EXPECT_FALSE(plan().rectOf("column-2").isEmpty());
}

TEST_F(BlockPanelTest, TheOffsetOfALoneCutIsANumberOrAnExpression) {
  ASSERT_NO_FATAL_FAILURE(open("bump"));
  const QString name = "Offset, " + QString::fromStdString(bench().cut().id);
  EXPECT_EQ(bench().cut().offset, 0);
  ASSERT_NO_FATAL_FAILURE(type(name, "12,5"));
  EXPECT_EQ(bench().cut().offset, 12.5) << "decimal comma";
  EXPECT_EQ(bench().document().undoStack().undoText(), "Change offset");
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  picture("blocks-panel-offset");
  bench().editDesign("Prepare", [](Design& design) { design.variables.push_back({"panel", 30, 10, 60}); });
  ASSERT_NO_FATAL_FAILURE(type(name, "=panel/2"));
  EXPECT_EQ(bench().cut().offset, 15);
  EXPECT_EQ(fieldOf<NumberField>(name)->expression(), "panel/2");
  EXPECT_EQ(withVariables(bench().design(), {{"panel", 40}}).value().cut().offset, 20);
  picture("blocks-panel-offset-expression");
  // An empty field means none, and frees it.
  auto* field = fieldOf<NumberField>(name);
  QTest::mouseClick(field, Qt::LeftButton);
  QTest::keyClick(field, Qt::Key_A, Qt::ControlModifier);
  QTest::keyClick(field, Qt::Key_Delete);
  QTest::keyClick(field, Qt::Key_Return);
  EXPECT_FALSE(field->refused()) << field->refusal().toStdString();
  EXPECT_EQ(bench().cut().offset, 0);
  EXPECT_EQ(field->expression(), "");
  // Esc drops what is typed, and what is too much is refused.
  QTest::mouseClick(field, Qt::LeftButton);
  QTest::keyClicks(field, "501");
  QTest::keyClick(field, Qt::Key_Return);
  EXPECT_TRUE(field->refused());
  QTest::keyClick(field, Qt::Key_Escape);
  EXPECT_EQ(bench().cut().offset, 0);
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().cut().offset, 15);
  EXPECT_EQ(field->expression(), "panel/2");
}

TEST_F(BlockPanelTest, OfSeveralCutsNoneHasAnOffsetButOneMayBeTakenAway) {
  ASSERT_NO_FATAL_FAILURE(open("two-crossing-cuts"));
  EXPECT_FALSE(fieldOf<NumberField>("Offset, north"));
  bench().editDesign("Prepare", [](Design& design) { design.cuts[1].offset = 5; });
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().runner().error()) << "only a cut that is alone in its block may";
  ASSERT_NO_FATAL_FAILURE(type("Offset, " + QString::fromStdString(bench().design().cuts[1].id), "0"));
  EXPECT_EQ(bench().design().cuts[1].offset, 0);
  QTest::qWait(0);
  EXPECT_FALSE(fieldOf<NumberField>("Offset, north"));
}

TEST_F(BlockPanelTest, ABlockGetsItsSecondMould) {
  ASSERT_NO_FATAL_FAILURE(open("bump"));
  const Design before = bench().design();
  QAction* command = window().commands()["design.moulds"];
  ASSERT_TRUE(command->isEnabled());
  // Given up.
  answer([&] { command->trigger(); }, "moulds-question",
         [](QDialog& dialog) { QTest::keyClick(&dialog, Qt::Key_Escape); });
  EXPECT_EQ(bench().design(), before);
  answer([&] { command->trigger(); }, "moulds-refused",
         [](QDialog& dialog) {
           auto* field = dialog.findChild<NumberField*>();
           // No panel has that thickness: the dialog stays.
           field->selectAll();
           QTest::keyClicks(field, "0");
           QTest::keyClick(field, Qt::Key_Return);
           EXPECT_TRUE(dialog.isVisible());
           EXPECT_TRUE(field->refused());
           field->selectAll();
           QTest::keyClicks(field, "2,45 cm");
           QTest::mouseClick(dialog.findChild<QPushButton*>("primary"), Qt::LeftButton);
         });
  ASSERT_EQ(bench().design().stock.size(), 2u);
  EXPECT_EQ(bench().document().undoStack().undoText(), "Two moulds for a panel");
  for (const Cut& cut : bench().design().cuts) EXPECT_EQ(cut.offset, 12.25) << cut.id;
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  QTest::qWait(50);
  picture("moulds-made");
  // One lies over the other: the plan shows one at a time.
  ASSERT_EQ(plan().layers(), 2);
  std::set<std::string> seen;
  for (const int layer : {0, 1}) {
    plan().setLayer(layer);
    int there = 0;
    for (const StockBlock& block : bench().design().stock) {
      if (plan().rectOf(block.id).isEmpty()) continue;
      ++there;
      seen.insert(block.id);
    }
    EXPECT_EQ(there, 1) << layer;
  }
  EXPECT_EQ(seen.size(), 2u);
  // A second time they have their offset, which is told before anything is asked.
  bool asked = false;
  window().questions().panelThickness = [&](double) {
    asked = true;
    return std::optional(30.0);
  };
  const Design made = bench().design();
  command->trigger();
  EXPECT_FALSE(asked);
  EXPECT_EQ(bench().design(), made);
  EXPECT_TRUE(window().banner().isVisible());
  bench().document().undoStack().undo();
  EXPECT_FALSE(window().banner().isVisible()) << "what was refused is of the design before";
  EXPECT_EQ(bench().design(), before);
  EXPECT_FALSE(bench().document().undoStack().canUndo());
}

TEST_F(BlockPanelTest, ABlockThatNoBladeCutsLeavesTheOthersTheirResults) {
  ASSERT_NO_FATAL_FAILURE(open("three-block-wall"));
  bench().editDesign("Wider", [](Design& design) {
    design.bindings.clear();
    design.grid->sizes[0] = {500, 800, 500};
    design.stock = stockOf(*design.grid);
  });
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current()) << "the others have results";
  EXPECT_EQ(bench().shown()->blocks.size(), 2u);
  EXPECT_EQ(pipeline::blocksLeftOut(*bench().shown()), std::vector<std::string>{"column-2"});
  EXPECT_EQ(plan().wordOf("column-2"), "not cut");
  picture("blocks-uncut");
  // Its page says why, and it can be chosen and left.
  QTest::mouseClick(&plan(), Qt::LeftButton, {}, at("column-2"));
  EXPECT_EQ(chosen(), "column-2");
  ASSERT_TRUE(settle());
  EXPECT_EQ(window().summaryLine().labels().back()->text(), "1 error") << "though it has no numbers";
  picture("blocks-uncut-chosen");
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().shown()->blocks.size(), 3u);
  EXPECT_TRUE(pipeline::blocksLeftOut(*bench().shown()).empty());
}

TEST_F(BlockPanelTest, BlocksOfAListAreChosenWhereTheyLie) {
  ASSERT_NO_FATAL_FAILURE(open("three-block-wall"));
  bench().editBlock("Move block", [](StockBlock& block) { block.placement->origin.y() = -300; });
  ASSERT_FALSE(bench().design().grid);
  QTest::qWait(20);
  EXPECT_GT(at("column-1").y(), at("column-2").y()) << "nearer";
  const Design before = bench().design();
  const QPoint edge(int(plan().rectOf("column-2").right()), at("column-2").y());
  QTest::mousePress(&plan(), Qt::LeftButton, {}, edge);
  QTest::mouseMove(&plan(), edge + QPoint(10, 0));
  release();
  EXPECT_EQ(bench().design(), before);
  QTest::mouseClick(&plan(), Qt::LeftButton, {}, at("column-3"));
  EXPECT_EQ(chosen(), "column-3");
}

TEST_F(BlockPanelTest, IsWholeInASmallWindow) {
  window().resize(960, 600);
  ASSERT_NO_FATAL_FAILURE(open("two-crossing-cuts"));
  picture("blocks-panel-small");
  for (const char* name : {"Order, north", "On top, north", "Turned by, north", "Keeps what is, north"}) {
    auto* field = fieldOf<ChoiceField>(name);
    ASSERT_TRUE(field) << name;
    EXPECT_EQ(field->visibleRegion().boundingRect(), field->rect()) << name;
    EXPECT_LE(field->fontMetrics().horizontalAdvance(field->shownText()), field->textWidth()) << name;
  }
  picture("blocks-panel-small-cuts");
}

TEST_F(BlockPanelTest, TheStepSetupLeadsToIt) {
  ASSERT_TRUE(window().openExample("block-wall"));
  ASSERT_TRUE(settle());
  window().tabs().setVisible(false);
  auto* button = window().findChild<QPushButton*>("showBlocks");
  ASSERT_TRUE(button);
  unfold(*button);
  QTest::qWait(50);
  for (QWidget* above = button->parentWidget(); above; above = above->parentWidget())
    if (auto* area = qobject_cast<QScrollArea*>(above)) area->ensureWidgetVisible(button);
  QTest::qWait(0);
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_TRUE(plan().isVisible());
}

}  // namespace
}  // namespace bw::app
