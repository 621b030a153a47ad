// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What the picture shows of a design, and what is done in it: faces, findings, blocks, maps, views.
#include <QLabel>
#include <cmath>

#include "bw/core/sweep/maps.h"
#include "step_merge.h"
#include "window_fixture.h"

namespace bw::app {
namespace {

class PictureTest : public WindowTest {
 protected:
  /// Opens a file of several example surfaces, which lie over each other.
  void openFaces(const std::vector<std::string>& examples) {
    std::vector<std::string> files;
    for (const std::string& name : examples) files.push_back(geometry::exampleStep(name).value());
    ASSERT_TRUE(writeFile(path("faces.step"), test::mergedStep(files)));
    ASSERT_TRUE(window().openFile(QString::fromStdString(path("faces.step").string())));
    bench().editDesign("Prepare", [](Design& design) {
      design.cut().sections.stations = 12;
      design.blade.length = 2000;
    });
    ASSERT_TRUE(settle());
    bench().document().undoStack().clear();
  }

  view::SceneView& view() { return window().sceneView(); }

  /// A place of the picture where that face is in front; none if it is seen nowhere.
  std::optional<QPoint> placeOf(int face) {
    for (int y = 6; y < view().height(); y += 6)
      for (int x = 6; x < view().width(); x += 6)
        if (view().pickAt(QPointF(x, y)).face == face) return QPoint(x, y);
    return std::nullopt;
  }

  bool inPicture(const Eigen::Vector3d& point) {
    return QRectF(view().rect()).contains(view().toWidget(point));
  }

  bool still() {
    Eigen::Vector3d last = Eigen::Vector3d::Constant(1e99);
    return QTest::qWaitFor(
        [&] {
          const Eigen::Vector3d now = view().camera().position;
          const bool same = (now - last).norm() == 0;
          last = now;
          return same && view().resting();
        },
        kPatience);
  }
};

TEST_F(PictureTest, FacesAreChosenByClickAndUndone) {
  openFaces({"saddle", "wavy-wall", "sphere-cap"});
  ASSERT_TRUE(window().faceChooser().possible());
  auto* button = window().findChild<WorkflowPanel*>()->findChild<QPushButton*>("chooseFaces");
  ASSERT_TRUE(button && button->isVisibleTo(&window()));
  window().workflow().ensureWidgetVisible(button);
  QTest::mouseClick(button, Qt::LeftButton);
  ASSERT_TRUE(window().faceChooser().choosing());
  EXPECT_TRUE(window().commands()["input.chooseFaces"]->isChecked());
  ASSERT_TRUE(still());
  std::vector<int> seen;
  for (int face = 0; face < 3; ++face)
    if (placeOf(face)) seen.push_back(face);
  ASSERT_GE(seen.size(), 2u);
  const int first = seen[0], second = seen[1];

  QTest::mouseMove(&view(), *placeOf(first));
  ASSERT_TRUE(QTest::qWaitFor([&] { return view().sceneStyle().hoveredFace == first; }, kPatience));
  EXPECT_TRUE(window().faceChooser().hint().contains(QString("Face %1").arg(first)));
  EXPECT_TRUE(window().faceChooser().hint().contains("mm"));
  picture("choose-faces");

  QTest::mouseClick(&view(), Qt::LeftButton, {}, *placeOf(first));
  EXPECT_EQ(bench().design().cut().face.kind, FaceChoice::Kind::indices);
  EXPECT_EQ(bench().design().cut().face.indices, std::vector<int>{first});
  EXPECT_EQ(view().sceneStyle().chosenFaces, std::vector<int>{first}) << "at once, before any result";
  QTest::mouseClick(&view(), Qt::LeftButton, Qt::ControlModifier, *placeOf(second));
  EXPECT_EQ(bench().design().cut().face.indices, (std::vector<int>{first, second}));
  QTest::mouseClick(&view(), Qt::LeftButton, Qt::ControlModifier, *placeOf(first));
  EXPECT_EQ(bench().design().cut().face.indices, std::vector<int>{second});
  QTest::mouseClick(&view(), Qt::LeftButton, Qt::ControlModifier, *placeOf(second));
  EXPECT_EQ(bench().design().cut().face.indices, std::vector<int>{second}) << "one face stays";
  const int edits = bench().document().undoStack().count();
  EXPECT_EQ(edits, 3);
  EXPECT_EQ(window().commands()["edit.undo"]->text(), "&Undo choose faces");
  for (int i = 0; i < edits; ++i) bench().document().undoStack().undo();
  EXPECT_EQ(bench().design().cut().face.kind, FaceChoice::Kind::largest);
  ASSERT_TRUE(settle());

  // Out of choosing a click selects as before.
  QTest::keyClick(&window(), Qt::Key_Escape);
  EXPECT_FALSE(window().faceChooser().choosing());
  EXPECT_FALSE(button->isChecked());
  EXPECT_FALSE(view().sceneStyle().chooseFaces);
  EXPECT_EQ(window().faceChooser().hint(), QString());
  const FaceChoice before = bench().design().cut().face;
  QTest::mouseClick(&view(), Qt::LeftButton, {}, view().rect().center());
  EXPECT_EQ(bench().design().cut().face, before);
}

TEST_F(PictureTest, FacesCanBeChosenWhereNothingCouldBeCut) {
  openFaces({"saddle", "wavy-wall"});
  bench().editDesign("Choose faces", [](Design& design) {
    design.cut().face.kind = FaceChoice::Kind::indices;
    design.cut().face.indices = {7};
  });
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().runner().error());
  QTest::keyClick(&window(), Qt::Key_C);
  ASSERT_TRUE(window().faceChooser().choosing());
  ASSERT_TRUE(still());
  const auto place = placeOf(1);
  ASSERT_TRUE(place);
  QTest::mouseClick(&view(), Qt::LeftButton, {}, *place);
  ASSERT_TRUE(settle());
  EXPECT_FALSE(bench().runner().error() && bench().runner().error()->where == "face");
  EXPECT_EQ(bench().design().cut().face.indices, std::vector<int>{1});
}

TEST_F(PictureTest, FacesAreNoLongerChosenWhereTheFileHasNoneLeft) {
  openFaces({"saddle", "wavy-wall"});
  QTest::keyClick(&window(), Qt::Key_C);
  ASSERT_TRUE(window().faceChooser().choosing());
  ASSERT_TRUE(writeFile(path("faces.step"), "ISO-10303-21; and then nothing"));
  QTest::keyClick(&window(), Qt::Key_R, Qt::ControlModifier);
  ASSERT_TRUE(settle());
  ASSERT_FALSE(window().faceChooser().possible());
  EXPECT_FALSE(window().faceChooser().choosing());
  EXPECT_FALSE(window().faceChooser().isVisible());
  EXPECT_FALSE(window().commands()["input.chooseFaces"]->isChecked());
  EXPECT_FALSE(view().sceneStyle().chooseFaces);
}

TEST_F(PictureTest, OneFaceLeavesNothingToChoose) {
  openPanel();
  EXPECT_FALSE(window().faceChooser().possible());
  EXPECT_FALSE(window().commands()["input.chooseFaces"]->isEnabled());
  EXPECT_FALSE(window().findChild<QPushButton*>("chooseFaces")->isVisible());
  QTest::keyClick(&window(), Qt::Key_C);
  EXPECT_FALSE(window().faceChooser().choosing());
}

TEST_F(PictureTest, FindingIsFramedAndMarkedWithItsWords) {
  openPanel();
  bench().editDesign("Change tolerance", [](Design& design) {
    design.process.tolerance = 0.001;
    design.process.clearance = 400;
  });
  ASSERT_TRUE(settleInFull()) << "the list is the last one";
  window().commands()["tab.messages"]->trigger();
  // Look elsewhere first: the finding must come into the picture from anywhere.
  Bounds away;
  away.add(Eigen::Vector3d(4e4, 4e4, 4e4));
  int marked = 0;
  MessageList& list = window().messageList();
  for (int i = 0; i < list.count(); ++i) {
    view().fitBounds(away, false);
    list.scrollToItem(list.item(i));
    QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, list.visualItemRect(list.item(i)).center());
    const auto framed = [&] {
      const auto corners = bench().shown()->cut().setup->block.corners();
      return std::ranges::all_of(corners, [&](const Eigen::Vector3d& corner) { return inPicture(corner); });
    };
    // The camera may not have left yet.
    EXPECT_TRUE(QTest::qWaitFor(framed, kPatience)) << list.item(i)->text().toStdString();
    ASSERT_TRUE(still());
    EXPECT_TRUE(framed()) << list.item(i)->text().toStdString();
    const auto& marker = view().sceneStyle().marker;
    if (!marker) continue;
    ++marked;
    EXPECT_TRUE(inPicture(marker->point));
    EXPECT_EQ(QString::fromStdString(marker->text), list.item(i)->text());
    if (bench().selection().kind == Selection::Kind::station) {
      const BladePose& station = bench().sweep()->sweep.poses[std::size_t(bench().selection().station)];
      EXPECT_TRUE(inPicture(station.leftPoint()));
      EXPECT_TRUE(inPicture(station.rightPoint()));
      // On the blade of that station, wherever along it.
      double nearest = 1e300;
      for (const Eigen::Vector2d& p : station.blade.sample(400))
        nearest = std::min(nearest, (station.frame.toWorld(p) - marker->point).norm());
      EXPECT_LT(nearest, 30) << marker->text;
    }
    if (marked == 1) picture("finding");
  }
  EXPECT_GE(marked, 2);
  // It goes with the next selection, and with the next result.
  bench().select({});
  EXPECT_FALSE(view().sceneStyle().marker);
}

TEST_F(PictureTest, BlockThatMissesIsDrawnWhereItWasPut) {
  openPanel();
  const Box before = bench().shown()->cut().block();
  bench().editDesign("Move block", [&](Design& design) {
    BlockPlacement block;
    block.origin = {3000, 100, 50};
    block.size = before.size;
    design.block().placement = block;
  });
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().runner().error());
  EXPECT_TRUE(window().banner().text().contains("misses"));
  ASSERT_TRUE(view().content().first<Box>());
  EXPECT_NEAR(view().content().first<Box>()->frame.origin.x(), 3000, 1e-9);
  ASSERT_TRUE(still());
  for (const Eigen::Vector3d& corner : view().content().first<Box>()->corners())
    EXPECT_TRUE(inPicture(corner));
  picture("block-misses");
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
  EXPECT_NEAR((view().content().first<Box>()->frame.origin - before.frame.origin).norm(), 0, 1e-9);
}

TEST_F(PictureTest, DesignWhoseBlockMissesOpensWithBlockAndSurface) {
  Design design;
  design.name = "astray";
  design.source().path = "saddle.step";
  design.source().bytes = geometry::exampleStep("saddle").value();
  BlockPlacement block;
  block.origin = {5000, 0, 0};
  design.block().placement = block;
  bench().document().start(design);
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().runner().error());
  ASSERT_TRUE(view().content().first<Box>());
  EXPECT_FALSE(view().content().first<TriangleMesh>()->triangles.empty());
  EXPECT_NEAR(view().content().first<Box>()->frame.origin.x(), 5000, 1e-9);
}

TEST_F(PictureTest, StandardViewsByKeyAreParallelAndTickTheCommand) {
  openPanel();
  ASSERT_TRUE(still());
  EXPECT_FALSE(view().parallel());
  for (const Qt::Key key : {Qt::Key_1, Qt::Key_2, Qt::Key_4, Qt::Key_7}) {
    QTest::keyClick(&window(), key);
    ASSERT_TRUE(still());
    EXPECT_TRUE(view().parallel());
    EXPECT_TRUE(window().commands()["view.parallel"]->isChecked());
    QTest::keyClick(&window(), Qt::Key_P);
    EXPECT_FALSE(view().parallel());
    EXPECT_FALSE(window().commands()["view.parallel"]->isChecked());
  }
}

TEST_F(PictureTest, EveryMapHasOneNameEverywhere) {
  openPanel();
  ASSERT_EQ(MapBar::fieldNames().size(), cutMaps().size() + 1);
  for (std::size_t i = 0; i < cutMaps().size(); ++i) {
    const MapInfo& map = cutMaps()[i];
    const QString title = QString::fromUtf8(map.title);
    EXPECT_EQ(MapBar::fieldNames()[i], map.name);
    EXPECT_EQ(window().mapBar().field().itemText(int(i)), title);
    const QAction* command = window().commands()["map." + QString(map.name)];
    EXPECT_EQ(command->text(), "Map: " + title);
    EXPECT_FALSE(command->icon().isNull());
    if (map.value) {
      const Field* field = bench().sweep()->analysis.cut.field(map.name);
      ASSERT_TRUE(field) << map.name;
      EXPECT_EQ(QString::fromStdString(field->title), title);
    }
    EXPECT_EQ(command->isEnabled(), map.ofCut) << map.name << ": the panel has no creases";
    if (!map.ofCut) continue;
    window().commands()["map." + QString(map.name)]->trigger();
    EXPECT_TRUE(view().legendRange()) << map.name;
  }
  window().commands()["map.stress"]->trigger();
  const Blade& blade = bench().design().blade;
  EXPECT_EQ(view().legendRange()->first, 0);
  EXPECT_NEAR(view().legendRange()->second, blade.stress(blade.maxCurvature()), 1e-9);
}

TEST_F(PictureTest, WordsOfWhatIsPointedAtGoWhenTheSurfaceMoves) {
  openPanel();
  window().commands()["map.deviation"]->trigger();
  ASSERT_TRUE(still());
  const auto words = [this](const QString& name) {
    for (const QLabel* label : window().findChildren<QLabel*>())
      if (label->accessibleName() == name) return label->text();
    return QString("no such label");
  };
  std::optional<QPoint> onSurface;
  for (int y = 8; y < view().height() && !onSurface; y += 8)
    for (int x = 8; x < view().width() && !onSurface; x += 8)
      if (view().pickAt(QPointF(x, y)).value) onSurface = QPoint(x, y);
  ASSERT_TRUE(onSurface);
  QTest::mouseMove(&view(), *onSurface);
  ASSERT_TRUE(QTest::qWaitFor([&] { return words("Value under the cursor") != ""; }, kPatience));
  EXPECT_TRUE(words("Value under the cursor").startsWith("Deviation "));
  EXPECT_TRUE(words("Coordinates under the cursor").endsWith(" mm"));
  bench().editDesign("Length", [](Design& design) { design.blade.length += 5; });
  ASSERT_TRUE(settle());
  EXPECT_EQ(words("Value under the cursor"), "");
  EXPECT_EQ(words("Coordinates under the cursor"), "");
}

TEST_F(PictureTest, CreasesAreColouredByHowFarTheyAreOff) {
  ASSERT_TRUE(window().openExample("two-crossing-cuts"));
  ASSERT_TRUE(settle());
  QAction* command = window().commands()["map.crease"];
  ASSERT_TRUE(command->isEnabled());
  command->trigger();
  EXPECT_TRUE(command->isChecked());
  ASSERT_TRUE(view().legendRange());
  EXPECT_EQ(view().legendRange()->first, 0);
  EXPECT_NEAR(view().legendRange()->second, bench().design().process.tolerance, 1e-9);
  const auto* creases = view().content().first<scene::Creases>();
  ASSERT_TRUE(creases);
  const Crease& own = bench().shown()->blocks.front().together.value->creases.front();
  ASSERT_EQ(creases->curves.size(), own.curves.size());
  EXPECT_EQ(creases->off[0].size(), own.curves[0].size());
  EXPECT_EQ(creases->off[0][3], own.off[0][3].value());
  picture("crease-map");
}

TEST_F(PictureTest, KeyBladesThatNoBladeCanBeAreMarked) {
  ASSERT_TRUE(window().openExample("key-blade-fan"));
  ASSERT_TRUE(settle());
  EXPECT_FALSE(view().content().first<scene::ToldMarks>()) << "the example can be cut as it opens";
  const double sharp = 1 / bench().design().blade.minRadius();
  bench().editSurface("Bend a key blade", [&](DesignedSurface& surface) {
    KeyBlade& blade = std::get<BladesSurface>(surface.shape).blades[1];
    blade.bend = std::copysign(1.15 * sharp * blade.length, blade.bend);
  });
  ASSERT_TRUE(settle());
  const auto* marks = view().content().first<scene::ToldMarks>();
  ASSERT_TRUE(marks);
  EXPECT_GT(marks->lines.size(), 3u);
  window().commands()["tab.messages"]->trigger();
  bool told = false;
  const MessageList& list = window().messageList();
  for (int i = 0; i < list.count(); ++i)
    told = told || list.item(i)->text().contains("the key blades tell shapes that bend to a radius of");
  EXPECT_TRUE(told);
  picture("told-stretch");
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  EXPECT_FALSE(view().content().first<scene::ToldMarks>());
}

}  // namespace
}  // namespace bw::app
