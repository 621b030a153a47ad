// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The tree of objects: what is shown, what is locked, and how it is called.
#include "bw/core/design/grid_change.h"
#include "bw/core/design/surface_curves.h"
#include "bw/core/design/variables.h"
#include "controls/fields.h"
#include "window/curve_handles.h"
#include "window_fixture.h"
#include "workflow/section_edits.h"

namespace bw::app {
namespace {

using Kind = Object::Kind;

class ObjectTreeTest : public WindowTest {
 protected:
  void open(const char* example) {
    window().questions().unsaved = [](const QString&) { return Questions::Unsaved::discard; };
    ASSERT_TRUE(window().openExample(example));
    ASSERT_TRUE(settleInFull());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
    QTest::qWait(0);
  }
  ObjectTree& tree() { return window().objectTree(); }
  QTreeWidgetItem* line(Kind kind, const std::string& id) { return tree().lineOf(Object{kind, id}); }

  void click(QTreeWidgetItem* item, int column) {
    ASSERT_TRUE(item);
    tree().scrollToItem(item);
    const QRect place = tree().visualItemRect(item);
    const QPoint at(tree().columnViewportPosition(column) +
                        (column == ObjectTree::name ? place.left() + 30 : tree().columnWidth(column) / 2),
                    place.center().y());
    QTest::mouseClick(tree().viewport(), Qt::LeftButton, {}, at);
    QTest::qWait(0);
  }

  bool sees(scene::Kind kind, const scene::ItemId& id) {
    return window().sceneView().sceneStyle().of(kind, id).visible;
  }

  /// F2, a name, Enter.
  void name(QTreeWidgetItem* item, const QString& text) {
    click(item, ObjectTree::name);
    QTest::keyClick(&tree(), Qt::Key_F2);
    const QPointer<QLineEdit> editor = tree().viewport()->findChild<QLineEdit*>();
    ASSERT_TRUE(editor);
    QTest::keyClick(editor, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClick(editor, Qt::Key_Delete);
    QTest::keyClicks(editor, text);
    QTest::keyClick(editor, Qt::Key_Return);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !editor || !editor->isVisible(); }, kPatience));
    QTest::qWait(20);
    QTest::qWait(0);
  }
};

TEST_F(ObjectTreeTest, BlocksOfAGridAndTheirCutsAreRenamed) {
  ASSERT_NO_FATAL_FAILURE(open("three-block-wall"));
  const Design before = bench().design();
  ASSERT_TRUE(before.grid);
  ASSERT_NO_FATAL_FAILURE(name(line(Kind::block, "column-2"), "A2"));
  ASSERT_TRUE(line(Kind::block, "A2"));
  EXPECT_TRUE(line(Kind::cut, "cut-A2")) << "its cut is called after it";
  EXPECT_EQ(bench().design().grid->names, (std::map<std::string, std::string>{{"column-2", "A2"}}));
  ASSERT_TRUE(settle());
  const auto blades = [&](const char* cut) {
    const pipeline::CutEvaluation* found = bench().shown()->find(cut);
    return found ? found->sweep.value.get() : nullptr;
  };
  const Sweep* const row = blades("cut-A2");
  ASSERT_TRUE(row);
  const Joints* const joints = bench().shown()->joints.value.get();
  ASSERT_NO_FATAL_FAILURE(name(line(Kind::cut, "cut-A2"), "roof"));
  for (const char* cut : {"roof-column-1", "roof-A2", "roof-column-3"})
    EXPECT_TRUE(line(Kind::cut, cut)) << cut;
  EXPECT_EQ(bench().selection().cut, "roof-A2");
  EXPECT_EQ(bench().selection().block, "A2");
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_EQ(blades("roof-A2"), row) << "a name is no reason to fit blades anew";
  EXPECT_EQ(bench().shown()->joints.value.get(), joints);
  picture("objects-renamed-in-grid");
  const fs::path file = path("named-wall.bladewright");
  ASSERT_TRUE(bench().saveTo(file));
  const Design saved = loadDesign(file).value();
  EXPECT_TRUE(saved.grid) << "it is still told by the grid";
  EXPECT_EQ(saved.stock, bench().design().stock);
  EXPECT_EQ(saved.cuts, bench().design().cuts);
  // Another block may not be called so; its place is its name again.
  ASSERT_NO_FATAL_FAILURE(name(line(Kind::block, "column-3"), "A2"));
  EXPECT_TRUE(line(Kind::block, "column-3"));
  // More columns keep it, fewer take it away.
  bench().editDesign("Columns", [](Design& design) {
    design = withGrid(design, *design.grid, withCount(*design.grid, 0, 4, false), "column-1").value();
  });
  EXPECT_TRUE(line(Kind::block, "A2"));
  bench().editDesign("Columns", [](Design& design) {
    design = withGrid(design, *design.grid, withCount(*design.grid, 0, 1, false), "column-1").value();
  });
  EXPECT_FALSE(line(Kind::block, "A2"));
  bench().document().undoStack().setIndex(0);
  EXPECT_EQ(bench().design(), before);
  EXPECT_TRUE(line(Kind::block, "column-2"));
  ASSERT_TRUE(settle());
}

TEST_F(ObjectTreeTest, ListsBlocksCutsSurfacesCurvesAndStations) {
  ASSERT_NO_FATAL_FAILURE(open("three-block-wall"));
  EXPECT_EQ(tree().topLevelItemCount(), 3);
  QTreeWidgetItem* surface = line(Kind::surface, "surface");
  ASSERT_TRUE(surface);
  surface->setExpanded(true);
  ASSERT_EQ(surface->childCount(), 3);
  EXPECT_EQ(surface->child(1)->text(0), "Section 2, y = 400 mm");
  QTreeWidgetItem* stations = line(Kind::stations, "cut-column-2");
  ASSERT_TRUE(stations);
  EXPECT_EQ(stations->text(0), "33 stations");
  picture("objects");
  // A click selects in the whole window.
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::block, "column-3"), ObjectTree::name));
  EXPECT_EQ(bench().selection().block, "column-3");
  EXPECT_EQ(bench().selection().kind, Selection::Kind::block);
  stations->setExpanded(true);
  ASSERT_EQ(stations->childCount(), 33);
  ASSERT_NO_FATAL_FAILURE(click(stations->child(4), ObjectTree::name));
  EXPECT_EQ(bench().selection().cut, "cut-column-2");
  EXPECT_EQ(bench().selection().station, 4);
  EXPECT_EQ(tree().currentItem(), stations->child(4));
  // And what is selected elsewhere is marked here.
  bench().select({Selection::Kind::result, -1, "column-1", "cut-column-1"});
  EXPECT_EQ(tree().currentItem(), line(Kind::cut, "cut-column-1"));
}

TEST_F(ObjectTreeTest, TheEyeLeavesThingsOutOfThePicture) {
  ASSERT_NO_FATAL_FAILURE(open("two-crossing-cuts"));
  EXPECT_TRUE(sees(scene::Kind::cut, {0, 1, 0, -1}));
  // The evaluation has the cuts in their order.
  const auto& cuts = bench().shown()->blocks[0].cuts;
  const int north = cuts[0].id == "north" ? 0 : 1;
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::cut, "north"), ObjectTree::seen));
  EXPECT_TRUE(bench().hidden({Kind::cut, "north"}));
  for (const scene::Kind kind : {scene::Kind::cut, scene::Kind::station, scene::Kind::blade})
    EXPECT_FALSE(sees(kind, {0, north, 0, -1}));
  EXPECT_FALSE(sees(scene::Kind::target, {0, north, -1, -1}));
  EXPECT_TRUE(sees(scene::Kind::cut, {0, 1 - north, 0, -1})) << "the other stays";
  EXPECT_TRUE(line(Kind::cut, "north")->toolTip(ObjectTree::seen).contains("hidden"));
  picture("objects-hidden");
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::cut, "north"), ObjectTree::seen));
  EXPECT_TRUE(sees(scene::Kind::cut, {0, north, 0, -1}));
  // By the keyboard, and the stations of one cut alone.
  tree().setCurrentItem(line(Kind::stations, "east"));
  tree().setFocus();
  QTest::keyClick(&tree(), Qt::Key_V);
  EXPECT_FALSE(sees(scene::Kind::station, {0, 1 - north, 0, -1}));
  EXPECT_TRUE(sees(scene::Kind::station, {0, north, 0, -1}));
  EXPECT_TRUE(sees(scene::Kind::cut, {0, 1 - north, 0, -1}));
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::block, "block"), ObjectTree::seen));
  EXPECT_FALSE(sees(scene::Kind::block, {0, -1, -1, -1}));
  EXPECT_FALSE(sees(scene::Kind::cut, {0, north, 0, -1})) << "with all that is in it";
  // Nothing of it is of the design.
  EXPECT_FALSE(bench().document().undoStack().canUndo());
  ASSERT_NO_FATAL_FAILURE(open("bump"));
  EXPECT_TRUE(sees(scene::Kind::block, {0, -1, -1, -1})) << "another design is seen whole";
}

TEST_F(ObjectTreeTest, ACreaseIsSeenWithWhatItIsTheEdgeOf) {
  ASSERT_NO_FATAL_FAILURE(open("two-crossing-cuts"));
  const scene::ItemId crease{0, 0, 1};
  const auto there = [&] {
    return std::ranges::any_of(window().sceneView().content().items, [&](const scene::Item& item) {
      return item.kind() == scene::Kind::crease && item.id == crease;
    });
  };
  ASSERT_TRUE(QTest::qWaitFor(there, kPatience));
  ASSERT_TRUE(bench().shown()->blocks[0].part.value);
  EXPECT_TRUE(sees(scene::Kind::crease, crease));
  // The foam that is left has that edge, whatever is seen of the cuts.
  bench().setHidden({Kind::cut, "north"}, true);
  EXPECT_TRUE(sees(scene::Kind::crease, crease));
  picture("crease-of-the-part");
  // Without it an edge of one surface alone would tell of a surface that is not there.
  const auto showPart = [this](bool on) {
    scene::Style style = window().mapBar().style();
    style[scene::Kind::part].visible = on;
    window().mapBar().setStyle(style);
    emit window().mapBar().styleEdited(style);
  };
  showPart(false);
  EXPECT_FALSE(sees(scene::Kind::crease, crease));
  picture("crease-hidden");
  bench().setHidden({Kind::cut, "north"}, false);
  EXPECT_TRUE(sees(scene::Kind::crease, crease)) << "both surfaces meet in it";
  picture("crease-of-surfaces");
  bench().setHidden({Kind::block, "block"}, true);
  EXPECT_FALSE(sees(scene::Kind::crease, crease));
  showPart(true);
  EXPECT_FALSE(sees(scene::Kind::crease, crease));
  // While a hand moves the surface no foam is left to be seen: it follows where both surfaces are.
  bench().setHidden({Kind::block, "block"}, false);
  ASSERT_TRUE(settle());
  const auto linesNow = [&] {
    std::vector<scene::Polyline> lines;
    for (const scene::Item& item : window().sceneView().content().items)
      if (const auto* creases = std::get_if<scene::Creases>(&item.data)) {
        EXPECT_TRUE(creases->beyond.empty() || !bench().sketch()) << "it is not measured";
        lines = creases->within;
      }
    return lines;
  };
  const auto pull = [this](double by, bool live) {
    const Design& design = bench().design();
    const Variable& variable = design.variables.front();
    Design next = withVariables(design, {{variable.name, variable.value + by}}).value();
    bench().editDesign(
        "Pull", [&](Design& changed) { changed = next; }, 7, live);
  };
  const auto sketched = [&](double by) {
    const auto before = linesNow();
    pull(by, true);
    return QTest::qWaitFor([&] { return bench().sketch() && linesNow() != before; }, kPatience);
  };
  ASSERT_TRUE(sketched(2));
  const auto first = linesNow();
  ASSERT_FALSE(first.empty());
  EXPECT_LT(window().sceneView().sceneStyle()[scene::Kind::crease].opacity, 1) << "pale";
  picture("crease-follows");
  ASSERT_TRUE(sketched(2));
  EXPECT_NE(linesNow(), first);
  EXPECT_TRUE(sees(scene::Kind::crease, crease));
  bench().setHidden({Kind::cut, "north"}, true);
  EXPECT_FALSE(sees(scene::Kind::crease, crease));
  bench().setHidden({Kind::cut, "north"}, false);
  const auto last = linesNow();
  ASSERT_TRUE(settle());
  EXPECT_EQ(window().sceneView().sceneStyle()[scene::Kind::crease].opacity, 1);
  EXPECT_TRUE(sees(scene::Kind::crease, crease));
  // It lay where the edge is then found to be.
  std::vector<scene::Polyline> found;
  for (const Crease& one : bench().shown()->blocks[0].together.value->creases)
    found.insert(found.end(), one.curves.begin(), one.curves.end());
  ASSERT_FALSE(found.empty());
  double length = 0, farthest = 0;
  for (const scene::Polyline& piece : last) {
    length += (piece.back() - piece.front()).norm();
    double nearest = 1e9;
    for (const scene::Polyline& curve : found)
      for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
        const Eigen::Vector3d way = curve[i + 1] - curve[i], to = piece.front() - curve[i];
        const double share = std::clamp(to.dot(way) / way.squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (to - share * way).norm());
      }
    farthest = std::max(farthest, nearest);
  }
  EXPECT_LT(farthest, 2);
  EXPECT_NEAR(length, bench().shown()->blocks[0].together.value->creases.front().length, 0.02 * length);
}

TEST_F(ObjectTreeTest, WhatIsHiddenAndLockedIsSavedWithTheDesign) {
  ASSERT_NO_FATAL_FAILURE(open("two-crossing-cuts"));
  bench().setHidden({Kind::stations, "east"}, true);
  EXPECT_FALSE(bench().document().modified()) << "a design without a file loses nothing";
  bench().setHidden({Kind::cut, "north"}, true);
  bench().setLocked({Kind::surface, "east"}, true);
  const fs::path file = path("marked.bladewright");
  ASSERT_TRUE(bench().saveTo(file));
  EXPECT_FALSE(bench().document().modified());
  bench().setHidden({Kind::stations, "east"}, false);
  EXPECT_TRUE(bench().document().modified());
  EXPECT_TRUE(window().isWindowModified());
  EXPECT_FALSE(bench().document().undoStack().canUndo()) << "it is no step of the history";
  bench().setHidden({Kind::stations, "east"}, true);
  EXPECT_FALSE(bench().document().modified()) << "as in the file";
  ASSERT_TRUE(bench().current()) << "nothing is computed for it";
  EXPECT_EQ(bench().design().marks, PartMarks()) << "nothing hangs on it";
  ASSERT_NO_FATAL_FAILURE(open("bump"));
  EXPECT_EQ(bench().document().marks(), PartMarks());
  ASSERT_TRUE(window().openFile(QString::fromStdString(file.string())));
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().hidden({Kind::stations, "east"}));
  EXPECT_TRUE(bench().hidden({Kind::cut, "north"}));
  EXPECT_TRUE(bench().locked({Kind::surface, "east"}));
  EXPECT_TRUE(line(Kind::cut, "north")->toolTip(ObjectTree::seen).contains("hidden"));
  EXPECT_TRUE(line(Kind::surface, "east")->toolTip(ObjectTree::kept).contains("locked"));
  const auto& cuts = bench().shown()->blocks[0].cuts;
  EXPECT_FALSE(sees(scene::Kind::cut, {0, cuts[0].id == "north" ? 0 : 1, 0, -1}));
  // It outlasts edits, undo and the next save.
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 1.5; });
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().hidden({Kind::cut, "north"}));
  bench().setLocked({Kind::surface, "east"}, false);
  ASSERT_TRUE(bench().saveTo(file));
  const Design saved = loadDesign(file).value();
  EXPECT_EQ(saved.marks.hidden.cuts, std::set<std::string>{"north"});
  EXPECT_EQ(saved.marks.hidden.stations, std::set<std::string>{"east"});
  EXPECT_EQ(saved.marks.locked, PartIds());
  // The same example again is seen whole, in the tree too.
  ASSERT_NO_FATAL_FAILURE(open("two-crossing-cuts"));
  EXPECT_TRUE(line(Kind::cut, "north")->toolTip(ObjectTree::seen).contains("shown"));
}

TEST_F(ObjectTreeTest, LockedStationsKeepTheirNumber) {
  ASSERT_NO_FATAL_FAILURE(open("two-crossing-cuts"));
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::stations, "east"), ObjectTree::kept));
  EXPECT_TRUE(bench().locked({Kind::stations, "east"}));
  EXPECT_TRUE(line(Kind::stations, "east")->toolTip(ObjectTree::kept).contains("locked"));
  const Design before = bench().design();
  const auto take = [&](const std::string& id, int stations) {
    bench().editDesign("Stations", [&](Design& design) {
      std::ranges::find(design.cuts, id, &Cut::id)->sections.stations = stations;
    });
  };
  take("east", 9);
  EXPECT_EQ(bench().design(), before);
  ASSERT_FALSE(window().banner().notices().empty());
  EXPECT_TRUE(window().banner().text().startsWith("Locked: stations of east stay as they are"))
      << window().banner().text().toStdString();
  // The surface that they lie on, and the stations of other cuts, may be changed.
  take("north", 9);
  EXPECT_NE(bench().design(), before);
  bench().editDesign("Tilt", [](Design& design) { design.cuts[0].offset = 1; });
  EXPECT_EQ(bench().design().cuts[0].offset, 1);
  const std::filesystem::path file = path("stations.bladewright");
  ASSERT_TRUE(bench().saveTo(file));
  EXPECT_EQ(loadDesign(file).value().marks.locked.stations, std::set<std::string>{"east"});
  // Nor is its cut kept from another name, by which they are locked then.
  ASSERT_TRUE(bench().rename({Kind::cut, "east"}, "dawn"));
  EXPECT_EQ(std::ranges::count(bench().design().cuts, "dawn", &Cut::id), 1);
  take("dawn", 9);
  EXPECT_NE(std::ranges::find(bench().design().cuts, "dawn", &Cut::id)->sections.stations, 9);
  ASSERT_TRUE(bench().rename({Kind::cut, "dawn"}, "east"));
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::stations, "east"), ObjectTree::kept));
  take("east", 9);
  EXPECT_EQ(std::ranges::find(bench().design().cuts, "east", &Cut::id)->sections.stations, 9);
  ASSERT_TRUE(settle());
}

TEST_F(ObjectTreeTest, UndoGoesBackBeyondALockAndSaysSo) {
  ASSERT_NO_FATAL_FAILURE(open("two-crossing-cuts"));
  const auto east = [](auto& design) -> auto& { return *std::ranges::find(design.cuts, "east", &Cut::id); };
  const std::optional<int> before = east(bench().design()).sections.stations;
  bench().editDesign("Stations", [&](Design& design) { east(design).sections.stations = 9; });
  bench().setLocked({Kind::stations, "east"}, true);
  window().commands()["edit.undo"]->trigger();
  EXPECT_EQ(east(bench().design()).sections.stations, before);
  EXPECT_TRUE(bench().locked({Kind::stations, "east"}));
  ASSERT_FALSE(window().banner().notices().empty());
  EXPECT_EQ(window().banner().text(),
            "The stations of east are locked, but were changed by the step that was taken back");
  picture("undone-beyond-lock");
  window().commands()["edit.redo"]->trigger();
  EXPECT_EQ(east(bench().design()).sections.stations, 9);
  EXPECT_TRUE(window().banner().text().endsWith("by the step that was made again"))
      << window().banner().text().toStdString();
  // What is not locked is undone without a word.
  bench().setLocked({Kind::stations, "east"}, false);
  window().commands()["edit.undo"]->trigger();
  EXPECT_FALSE(window().banner().isVisible() && window().banner().text().contains("locked"));
}

TEST_F(ObjectTreeTest, AMarkStaysWithItsPartWhereANameIsUndone) {
  ASSERT_NO_FATAL_FAILURE(open("two-crossing-cuts"));
  ASSERT_NO_FATAL_FAILURE(name(line(Kind::cut, "east"), "Dach"));
  bench().setLocked({Kind::cut, "Dach"}, true);
  bench().setHidden({Kind::stations, "Dach"}, true);
  window().commands()["edit.undo"]->trigger();
  ASSERT_TRUE(line(Kind::cut, "east"));
  EXPECT_TRUE(bench().locked({Kind::cut, "east"}));
  EXPECT_TRUE(bench().hidden({Kind::stations, "east"}));
  EXPECT_FALSE(window().banner().isVisible() && window().banner().text().contains("locked"))
      << "a name is no change of what is locked: " << window().banner().text().toStdString();
  window().commands()["edit.redo"]->trigger();
  EXPECT_TRUE(bench().locked({Kind::cut, "Dach"}));
  ASSERT_TRUE(settle());
}

TEST_F(ObjectTreeTest, WhatIsLockedStaysAndSaysSo) {
  ASSERT_NO_FATAL_FAILURE(open("single-block"));
  const Design before = bench().design();
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::surface, "surface"), ObjectTree::kept));
  EXPECT_TRUE(bench().locked({Kind::surface, "surface"}));
  picture("objects-locked");
  // A handle that is pulled.
  view::SceneView& view = window().sceneView();
  const QPoint at = hover(9);
  QTest::mousePress(&view, Qt::LeftButton, {}, at);
  for (int i = 1; i <= 5; ++i) QTest::mouseMove(&view, at - QPoint(0, 5 * i));
  QTest::mouseRelease(&view, Qt::LeftButton, {}, at - QPoint(0, 25));
  EXPECT_EQ(bench().design(), before);
  ASSERT_FALSE(window().banner().notices().empty());
  EXPECT_TRUE(window().banner().text().startsWith("Locked: surface stays"))
      << window().banner().text().toStdString();
  picture("objects-locked-told");
  // Its block may be changed, until it is locked too: by the key, and a field shows what is there.
  const auto type = [this](const QString& text) {
    for (auto* field : window().inspector().findChildren<NumberField*>())
      if (field->accessibleName() == "Size Z" && field->isVisible()) {
        field->setFocus();
        field->selectAll();
        QTest::keyClicks(field, text);
        QTest::keyClick(field, Qt::Key_Return);
        return field->text();
      }
    return QString();
  };
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::block, "block"), ObjectTree::name));
  EXPECT_EQ(type("450"), "450");
  EXPECT_EQ(bench().block().placement->size.z(), 450);
  tree().setFocus();
  QTest::keyClick(&tree(), Qt::Key_L);
  EXPECT_TRUE(bench().locked({Kind::block, "block"}));
  EXPECT_EQ(type("470"), "450");
  EXPECT_EQ(bench().block().placement->size.z(), 450);
  EXPECT_TRUE(window().banner().text().startsWith("Locked: block stays"));
  // It holds its cuts, and a cut its surface.
  bench().setLocked({Kind::surface, "surface"}, false);
  const auto raise = [this] {
    bench().editDesign("Raise", [](Design& design) {
      std::get<PolesSurface>(design.source().surface->shape).poles.front().height += 5;
    });
    return std::get<PolesSurface>(bench().design().source().surface->shape).poles.front().height;
  };
  const double height = std::get<PolesSurface>(bench().design().source().surface->shape).poles.front().height;
  EXPECT_EQ(raise(), height);
  EXPECT_TRUE(window().banner().text().startsWith("Locked: block stays"));
  bench().setLocked({Kind::block, "block"}, false);
  const std::string cut = bench().design().cut().id;
  bench().setLocked({Kind::cut, cut}, true);
  EXPECT_EQ(raise(), height);
  EXPECT_TRUE(window().banner().text().startsWith(QString::fromStdString("Locked: " + cut + " stays")));
  bench().setLocked({Kind::cut, cut}, false);
  EXPECT_EQ(raise(), height + 5);
  bench().setLocked({Kind::block, "block"}, true);
  // Unlocked it is changed, and the notice goes.
  tree().setFocus();
  QTest::keyClick(&tree(), Qt::Key_L);
  EXPECT_FALSE(window().banner().text().startsWith("Locked: block stays") && window().banner().isVisible());
  EXPECT_EQ(type("470"), "470");
}

TEST_F(ObjectTreeTest, AnotherNameStandsEverywhere) {
  ASSERT_NO_FATAL_FAILURE(open("two-crossing-cuts"));
  const Design before = bench().design();
  ASSERT_NO_FATAL_FAILURE(name(line(Kind::cut, "north"), "ridge"));
  EXPECT_EQ(bench().design().cuts[1].id, "ridge");
  EXPECT_EQ(bench().design().cuts[1].source, "north") << "its surface keeps its own";
  EXPECT_EQ(bench().selection().cut, "ridge") << "and it stays selected";
  ASSERT_TRUE(line(Kind::cut, "ridge"));
  ASSERT_NO_FATAL_FAILURE(name(line(Kind::block, "block"), "Corner stone"));
  for (const Cut& cut : bench().design().cuts) EXPECT_EQ(cut.block, "Corner stone");
  ASSERT_NO_FATAL_FAILURE(name(line(Kind::surface, "east"), "slope"));
  EXPECT_EQ(bench().design().cuts[0].source, "slope");
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  picture("objects-renamed");
  const fs::path file = path("named.bladewright");
  ASSERT_TRUE(bench().saveTo(file));
  EXPECT_EQ(loadDesign(file)->cuts[1].id, "ridge");
  // Names that are taken or no names are refused and told, and the line keeps its own.
  for (const char* bad : {"ridge", "a/b", " "}) {
    ASSERT_NO_FATAL_FAILURE(name(line(Kind::cut, "east"), bad));
    EXPECT_TRUE(line(Kind::cut, "east")) << bad;
    EXPECT_EQ(bench().design().cuts[0].id, "east");
  }
  bench().document().undoStack().setIndex(0);
  EXPECT_EQ(bench().design(), before);
  EXPECT_TRUE(line(Kind::cut, "north"));
}

TEST_F(ObjectTreeTest, ACurveIsChosenInTheTreeAndInThePicture) {
  ASSERT_NO_FATAL_FAILURE(open("three-block-wall"));
  const auto chosen = [&] { return window().surfaceHandles().chosen(); };
  const DesignedSurface& loft = *bench().source().surface;
  EXPECT_FALSE(line(Kind::curve, "surface/2")) << "folded away";
  line(Kind::surface, "surface")->setExpanded(true);
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::curve, "surface/2"), ObjectTree::name));
  EXPECT_EQ(bench().selection().kind, Selection::Kind::surface);
  EXPECT_EQ(chosen(), handlesOf(loft, 1));
  EXPECT_EQ(chosen().size(), std::get<SectionsSurface>(loft.shape).sections[1].points.size());
  EXPECT_EQ(window().sceneView().sceneStyle().handles.chosen, chosen());
  EXPECT_EQ(tree().currentItem(), line(Kind::curve, "surface/2"));
  picture("curve-chosen");
  // They move together, by the keyboard at the picture.
  const auto heights = [&](int curve) {
    std::vector<double> all;
    for (const Eigen::Vector2d& point :
         std::get<SectionsSurface>(bench().source().surface->shape).sections[std::size_t(curve)].points)
      all.push_back(point.y());
    return all;
  };
  const std::vector<double> before = heights(1), others = heights(2);
  window().sceneView().setFocus();
  QTest::keyClick(&window().sceneView(), Qt::Key_Up);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_NEAR(heights(1)[i] - before[i], heights(1)[0] - before[0], 1e-9);
  EXPECT_NE(heights(1), before);
  EXPECT_EQ(heights(2), others);
  EXPECT_EQ(tree().currentItem(), line(Kind::curve, "surface/2")) << "while it moves, too";
  bench().document().undoStack().undo();
  ASSERT_TRUE(settleInFull());
  // A handle of another one that is pressed in the picture.
  view::SceneView& view = window().sceneView();
  const int handle = handlesOf(*bench().source().surface, 2)[1];
  const QPoint at = hover(handle);
  QTest::mouseClick(&view, Qt::LeftButton, {}, at);
  EXPECT_EQ(chosen(), std::vector<int>{handle});
  EXPECT_EQ(tree().currentItem(), line(Kind::curve, "surface/3"));
  // Handles of two are no curve, and a station that is selected takes the mark.
  window().surfaceHandles().choose({handle, 0});
  EXPECT_EQ(tree().currentItem(), line(Kind::surface, "surface"));
  bench().selectStation(3);
  EXPECT_EQ(tree().currentItem(), line(Kind::stations, "cut-column-1"));
  // The surface itself has none chosen.
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::surface, "surface"), ObjectTree::name));
  EXPECT_TRUE(chosen().empty());
  // Where curves are folded away, their surface is marked.
  line(Kind::surface, "surface")->setExpanded(false);
  window().surfaceHandles().choose({handle});
  EXPECT_EQ(tree().currentItem(), line(Kind::surface, "surface"));
}

TEST_F(ObjectTreeTest, RowsOfPolesAndKeyBladesAreCurvesToo) {
  ASSERT_NO_FATAL_FAILURE(open("single-block"));
  line(Kind::surface, "surface")->setExpanded(true);
  ASSERT_EQ(line(Kind::surface, "surface")->childCount(), 6);
  EXPECT_EQ(line(Kind::curve, "surface/2")->text(0), "Row 2, y = 160 mm");
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::curve, "surface/2"), ObjectTree::name));
  EXPECT_EQ(window().surfaceHandles().chosen(), (std::vector<int>{4, 5, 6, 7}));
  picture("row-chosen");
  ASSERT_NO_FATAL_FAILURE(open("key-blade-fan"));
  line(Kind::surface, "surface")->setExpanded(true);
  ASSERT_EQ(line(Kind::surface, "surface")->childCount(), 4);
  EXPECT_TRUE(line(Kind::curve, "surface/4")->text(0).startsWith("Key blade 4, y = "));
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::curve, "surface/2"), ObjectTree::name));
  EXPECT_EQ(window().surfaceHandles().chosen(), (std::vector<int>{6, 7, 1})) << "ends and middle";
  // All of it goes up as it is.
  const auto blade = [&] { return std::get<BladesSurface>(bench().source().surface->shape).blades[1]; };
  const KeyBlade before = blade();
  window().sceneView().setFocus();
  QTest::keyClick(&window().sceneView(), Qt::Key_Up);
  EXPECT_GT(blade().middle.y(), before.middle.y());
  EXPECT_NEAR(blade().angle, before.angle, 1e-9);
  EXPECT_EQ(blade().middle.x(), before.middle.x());
  picture("key-blade-chosen");
  // A formula has none.
  ASSERT_NO_FATAL_FAILURE(open("ripple-along"));
  EXPECT_EQ(line(Kind::surface, "surface")->childIndicatorPolicy(),
            QTreeWidgetItem::DontShowIndicatorWhenChildless);
}

TEST_F(ObjectTreeTest, ACurveIsGivenANameThatStandsWhereverItIsTold) {
  ASSERT_NO_FATAL_FAILURE(open("twist"));
  const Design before = bench().design();
  const auto curve = [this](int place) { return line(Kind::curve, "surface/" + std::to_string(place)); };
  const auto editor = [this] { return tree().viewport()->findChild<QLineEdit*>(); };
  line(Kind::surface, "surface")->setExpanded(true);
  // F2 begins with nothing: it is called after its place so far.
  ASSERT_NO_FATAL_FAILURE(click(curve(2), ObjectTree::name));
  QTest::keyClick(&tree(), Qt::Key_F2);
  ASSERT_TRUE(editor());
  EXPECT_EQ(editor()->text(), "");
  EXPECT_EQ(editor()->placeholderText(), "section 2");
  QTest::keyClick(editor(), Qt::Key_Escape);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !editor(); }, kPatience));
  EXPECT_EQ(bench().design(), before);
  ASSERT_NO_FATAL_FAILURE(name(curve(2), "North & Ridge"));
  EXPECT_EQ(bench().source().curveNames, (std::map<int, std::string>{{1, "North & Ridge"}}));
  EXPECT_EQ(curve(2)->text(0), "North & Ridge (section 2), y = 400 mm");
  EXPECT_EQ(curve(1)->text(0), "Section 1, y = 0 mm");
  EXPECT_EQ(window().commands()["edit.undo"]->text(), "&Undo rename section 2 of surface");
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << "nothing is computed for it";
  // Where its numbers are, at its handles, and in what is done with it.
  ASSERT_NO_FATAL_FAILURE(click(curve(2), ObjectTree::name));
  const auto says = [this](const QString& text) {
    return std::ranges::any_of(window().inspector().findChildren<QLabel*>(), [&](const QLabel* label) {
      return label->isVisible() && label->text() == text;
    });
  };
  EXPECT_TRUE(says("North & Ridge (section 2), poles x, z") ||
              says("North & Ridge (section 2), points x, z"));
  const int handle = handlesOf(*bench().source().surface, 1).front();
  hover(handle);
  EXPECT_NE(window().sceneView().sceneStyle().handles.text.find("Point 1 of North & Ridge (section 2)"),
            std::string::npos)
      << window().sceneView().sceneStyle().handles.text;
  picture("curve-renamed");
  ASSERT_TRUE(removePoint(bench(), 1, 1) || addPoint(bench(), 1, 0));
  EXPECT_TRUE(window().commands()["edit.undo"]->text().endsWith("of North && Ridge (section 2)") ||
              window().commands()["edit.undo"]->text().endsWith("to North && Ridge (section 2)"))
      << window().commands()["edit.undo"]->text().toStdString();
  bench().document().undoStack().undo();
  bench().setLocked({Kind::curve, "surface/2"}, true);
  removeSection(bench(), 1);
  EXPECT_TRUE(window().banner().text().startsWith("Locked: North & Ridge (section 2) of surface stays"))
      << window().banner().text().toStdString();
  bench().setLocked({Kind::curve, "surface/2"}, false);
  // It goes with its curve, and undo brings it back where it was.
  ASSERT_TRUE(addSection(bench(), 0));
  EXPECT_EQ(bench().source().curveNames, (std::map<int, std::string>{{2, "North & Ridge"}}));
  EXPECT_EQ(curve(3)->text(0), "North & Ridge (section 3), y = 400 mm");
  bench().document().undoStack().undo();
  EXPECT_EQ(curve(2)->text(0), "North & Ridge (section 2), y = 400 mm");
  // The file keeps it.
  const fs::path file = path("named-curve.bladewright");
  ASSERT_TRUE(bench().saveTo(file));
  ASSERT_NO_FATAL_FAILURE(open("bump"));
  ASSERT_TRUE(window().openFile(QString::fromStdString(file.string())));
  ASSERT_TRUE(settle());
  line(Kind::surface, "surface")->setExpanded(true);
  EXPECT_EQ(curve(2)->text(0), "North & Ridge (section 2), y = 400 mm");
  // A double click edits the name alone; one that is taken is refused and told.
  tree().scrollToItem(curve(1));
  const QPoint at = tree().visualItemRect(curve(1)).center();
  QTest::mouseClick(tree().viewport(), Qt::LeftButton, {}, at);
  QTest::mouseDClick(tree().viewport(), Qt::LeftButton, {}, at);
  ASSERT_TRUE(editor());
  QTest::keyClicks(editor(), "North & Ridge");
  QTest::keyClick(editor(), Qt::Key_Return);
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return window().banner().text().contains("choose another name"); }, kPatience));
  EXPECT_EQ(bench().source().curveNames.size(), 1u);
  EXPECT_EQ(curve(1)->text(0), "Section 1, y = 0 mm");
  // Without one it is called after its place again.
  ASSERT_NO_FATAL_FAILURE(name(curve(2), ""));
  EXPECT_TRUE(bench().source().curveNames.empty());
  EXPECT_EQ(curve(2)->text(0), "Section 2, y = 400 mm");
  bench().document().undoStack().undo();
  EXPECT_EQ(curve(2)->text(0), "North & Ridge (section 2), y = 400 mm");
}

TEST_F(ObjectTreeTest, ACurveThatIsHiddenHasNoHandles) {
  ASSERT_NO_FATAL_FAILURE(open("key-blade-fan"));
  view::SceneView& view = window().sceneView();
  const auto handles = [&]() -> const scene::Handles& { return view.sceneStyle().handles; };
  ASSERT_EQ(handles().curves.size(), 4u);
  const QPoint at = hover(1);
  line(Kind::surface, "surface")->setExpanded(true);
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::curve, "surface/2"), ObjectTree::seen));
  EXPECT_TRUE(bench().hidden({Kind::curve, "surface/2"}));
  EXPECT_FALSE(bench().hidden({Kind::surface, "surface"}));
  EXPECT_TRUE(line(Kind::curve, "surface/2")->toolTip(ObjectTree::seen).contains("hidden"));
  EXPECT_EQ(handles().curves.size(), 3u);
  picture("curve-hidden");
  // Where its middle was nothing is to be taken hold of.
  const Design before = bench().design();
  QTest::mouseMove(&view, at + QPoint(0, 60));
  ASSERT_TRUE(QTest::qWaitFor([&] { return handles().lit == -1; }, kPatience));
  QTest::mouseMove(&view, at);
  QTest::mousePress(&view, Qt::LeftButton, {}, at);
  for (int i = 1; i <= 5; ++i) QTest::mouseMove(&view, at - QPoint(0, 5 * i));
  QTest::mouseRelease(&view, Qt::LeftButton, {}, at - QPoint(0, 25));
  EXPECT_EQ(bench().design(), before);
  EXPECT_EQ(handles().lit, -1);
  // It is kept by the file, and goes with the blade when another comes before it.
  const fs::path file = path("hidden.bladewright");
  ASSERT_TRUE(bench().saveTo(file));
  EXPECT_EQ(loadDesign(file).value().marks.hidden.sources, std::set<std::string>{"surface/2"});
  ASSERT_NO_FATAL_FAILURE(open("bump"));
  ASSERT_TRUE(window().openFile(QString::fromStdString(file.string())));
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().hidden({Kind::curve, "surface/2"}));
  ASSERT_TRUE(addBlade(bench(), 0));
  EXPECT_TRUE(bench().hidden({Kind::curve, "surface/3"}));
  EXPECT_FALSE(bench().hidden({Kind::curve, "surface/2"}));
  bench().document().undoStack().undo();
  EXPECT_TRUE(bench().hidden({Kind::curve, "surface/2"}));
  EXPECT_FALSE(bench().document().modified()) << "as in the file";
  line(Kind::surface, "surface")->setExpanded(true);
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::curve, "surface/2"), ObjectTree::seen));
  EXPECT_EQ(handles().curves.size(), 4u);
}

TEST_F(ObjectTreeTest, ACurveThatIsLockedStaysAndSaysSo) {
  ASSERT_NO_FATAL_FAILURE(open("single-block"));
  line(Kind::surface, "surface")->setExpanded(true);
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::curve, "surface/3"), ObjectTree::kept));
  EXPECT_TRUE(bench().locked({Kind::curve, "surface/3"}));
  EXPECT_TRUE(line(Kind::curve, "surface/3")->toolTip(ObjectTree::kept).contains("locked"));
  const Design before = bench().design();
  view::SceneView& view = window().sceneView();
  const auto handles = [&]() -> const scene::Handles& { return view.sceneStyle().handles; };
  const auto pull = [&](int handle) {
    const QPoint at = hover(handle);
    QTest::mousePress(&view, Qt::LeftButton, {}, at);
    for (int i = 1; i <= 5; ++i) QTest::mouseMove(&view, at - QPoint(0, 5 * i));
    QTest::mouseRelease(&view, Qt::LeftButton, {}, at - QPoint(0, 25));
  };
  pull(9);
  EXPECT_EQ(bench().design(), before);
  EXPECT_TRUE(window().banner().text().startsWith("Locked: row 3 of surface stays"))
      << window().banner().text().toStdString();
  EXPECT_NE(handles().text.find("\nLocked"), std::string::npos) << handles().text;
  picture("curve-locked");
  // Neither does a number of it change, nor its place with the surface; those beside it do.
  NumberField* number = nullptr;
  for (auto* field : window().workflow().findChildren<NumberField*>())
    if (field->accessibleName() == "pole 2 of row 3") number = field;
  ASSERT_TRUE(number);
  unfold(*number);
  number->setFocus();
  number->selectAll();
  QTest::keyClicks(number, "333");
  QTest::keyClick(number, Qt::Key_Return);
  EXPECT_EQ(bench().design(), before);
  EXPECT_NE(number->text(), "333");
  bench().editSurface("Move", [](DesignedSurface& surface) { surface.origin.z() += 5; });
  EXPECT_EQ(bench().design(), before);
  pull(5);
  EXPECT_NE(bench().design(), before);
  bench().document().undoStack().undo();
  ASSERT_NO_FATAL_FAILURE(click(line(Kind::curve, "surface/3"), ObjectTree::kept));
  pull(9);
  EXPECT_NE(bench().design(), before);
}

TEST_F(ObjectTreeTest, ALockedSectionIsNotTakenAwayAndKeepsItsLockWhereOthersCome) {
  ASSERT_NO_FATAL_FAILURE(open("twist"));
  bench().setLocked({Kind::curve, "surface/2"}, true);
  const Design before = bench().design();
  removeSection(bench(), 1);
  EXPECT_EQ(bench().design(), before);
  EXPECT_TRUE(window().banner().text().startsWith("Locked: section 2 of surface stays"));
  EXPECT_TRUE(bench().rename({Kind::curve, "surface/2"}, "ridge"));
  EXPECT_EQ(bench().design(), before) << "its name stays too";
  ASSERT_TRUE(addSection(bench(), 0));
  ASSERT_EQ(curveCount(*bench().source().surface), 4);
  EXPECT_TRUE(bench().locked({Kind::curve, "surface/3"}));
  EXPECT_FALSE(bench().locked({Kind::curve, "surface/2"}));
  EXPECT_TRUE(removeSection(bench(), 1));
  EXPECT_TRUE(bench().locked({Kind::curve, "surface/2"}));
}

}  // namespace
}  // namespace bw::app
