// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Several cuts of a block in the window: which one is at work, how the block lies for it, what is left.

#include <QCheckBox>

#include "bw/pipeline/scene_content.h"
#include "controls/fields.h"
#include "window_fixture.h"
#include "workflow/surface_fields.h"

namespace bw::app {
namespace {

class CutFieldsTest : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    ASSERT_TRUE(window().openExample("two-crossing-cuts"));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  }

  /// Chooses as a person does.
  void choose(const char* field, int index) {
    auto* choice = window().findChild<ChoiceField*>(field);
    ASSERT_TRUE(choice) << field;
    choice->setCurrentIndex(index);
    emit choice->activated(index);
  }
  /// The index of a choice in the table of cuts.
  int chosen(const QString& name) {
    for (const auto* choice : window().blockPanel().findChildren<ChoiceField*>())
      if (choice->accessibleName() == name) return choice->currentIndex();
    return -1;
  }
  const pipeline::BlockEvaluation& block() { return bench().shown()->blocks.front(); }
};

TEST_F(CutFieldsTest, TheChoiceOfACutLeadsAllFields) {
  auto* cut = window().findChild<ChoiceField*>("cut");
  ASSERT_TRUE(cut);
  ASSERT_EQ(cut->count(), 2);
  EXPECT_EQ(cut->itemText(0), "east");
  EXPECT_EQ(bench().cut().id, "east");
  choose("cut", 1);
  EXPECT_EQ(bench().cut().id, "north");
  EXPECT_EQ(bench().source().id, "north");
  EXPECT_EQ(chosen("Turned by, north"), 1);
  auto* formula = find<QLineEdit>("Formula");
  ASSERT_TRUE(formula);
  EXPECT_TRUE(formula->text().contains("cos")) << formula->text().toStdString();
  picture("cuts-north");
  choose("cut", 0);
  EXPECT_FALSE(find<QLineEdit>("Formula")->text().contains("cos"));
}

TEST_F(CutFieldsTest, HowTheBlockLiesIsEditedAndUndone) {
  const Design before = bench().design();
  choose("faceUp", 5);
  EXPECT_EQ(bench().cut().pose.up, BlockFace::back);
  choose("keep", 1);
  EXPECT_EQ(bench().cut().keep, KeptSide::above);
  choose("order", 2);
  EXPECT_EQ(bench().cut().order, 2);
  choose("order", 0);
  EXPECT_FALSE(bench().cut().order);
  EXPECT_EQ(bench().design().cuts[1], before.cuts[1]) << "the other cut stays";
  bench().document().undoStack().setIndex(0);
  EXPECT_EQ(bench().design(), before);
  EXPECT_EQ(chosen("On top, east"), 0);
}

TEST_F(CutFieldsTest, ACutHasABladeOfItsOwnLength) {
  const Design before = bench().design();
  const auto type = [&](const QString& text) {
    auto* field = find<NumberField>("Own length");
    field->setFocus();
    field->selectAll();
    QTest::keyClick(field, Qt::Key_Delete);
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
    const bool taken = !field->refused();
    if (!taken) QTest::keyClick(field, Qt::Key_Escape);
    return taken;
  };
  ASSERT_TRUE(find<NumberField>("Own length"));
  EXPECT_EQ(find<NumberField>("Own length")->text(), "");
  choose("cut", 1);
  EXPECT_TRUE(type("85 cm"));
  EXPECT_EQ(bench().design().cuts[1].length, 850);
  EXPECT_EQ(bench().design().cuts[0], before.cuts[0]);
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().shown()->find("north")->sweep.value->request.blade.length, 850);
  EXPECT_EQ(bench().shown()->find("east")->sweep.value->request.blade.length, 800);
  // The table of cuts has it, too, once a cut has one.
  auto* inTable = [&]() -> NumberField* {
    for (auto* field : window().blockPanel().findChildren<NumberField*>("ownLength"))
      if (field->accessibleName() == "Blade, north") return field;
    return nullptr;
  }();
  ASSERT_TRUE(inTable);
  EXPECT_EQ(inTable->value(), 850);
  EXPECT_FALSE(inTable->isHidden());
  window().commands()["tab.blocks"]->trigger();
  picture("cuts-own-length");
  choose("cut", 0);
  EXPECT_EQ(find<NumberField>("Own length")->text(), "");
  choose("cut", 1);
  EXPECT_EQ(find<NumberField>("Own length")->text(), "850");
  EXPECT_TRUE(type("=800 + 60"));
  EXPECT_EQ(bench().cut().length, 860);
  EXPECT_EQ(bench().design().bindings.at("/cuts/1/blade_length").text, "800 + 60");
  EXPECT_EQ(parseDesign(designToJson(bench().design()))->bindings, bench().design().bindings);
  for (const char* text : {"=0", "=5", "5", "=1e9", "=abc"}) EXPECT_FALSE(type(text)) << text;
  EXPECT_EQ(bench().cut().length, 860);
  // An empty field is that of the blade, and frees it.
  EXPECT_TRUE(type(""));
  EXPECT_FALSE(bench().cut().length);
  EXPECT_TRUE(bench().design().bindings.empty() ||
              !bench().design().bindings.contains("/cuts/1/blade_length"));
  bench().document().undoStack().setIndex(0);
  EXPECT_EQ(bench().design(), before);
}

TEST_F(CutFieldsTest, WhatASingleCutLeavesIsKnownWhenTheHandRests) {
  ASSERT_TRUE(window().openExample("ripple-along"));
  ASSERT_TRUE(settleInFull());
  ASSERT_TRUE(QTest::qWaitFor([&] { return block().part.value != nullptr; }, kPatience));
  ASSERT_TRUE(block().part.value && block().part.value->solid);
  const double left = block().part.value->solid->volume();
  EXPECT_GT(left, 0.2 * block().part.value->solid->blockVolume());
  EXPECT_LT(left, 0.9 * block().part.value->solid->blockVolume());
  const scene::Content content = pipeline::sceneContent(*bench().shown());
  ASSERT_TRUE(content.first<scene::FoamPart>());
  EXPECT_TRUE(content.first<scene::FoamPart>()->ofOneCut);
  // It stands in the inspector, and in the picture where it is asked for.
  bench().select({Selection::Kind::block, -1, bench().design().stock[0].id, bench().design().cuts[0].id});
  QTest::qWait(50);
  picture("cut-single-part-numbers");
  QCheckBox* shows = nullptr;
  for (QCheckBox* box : window().findChildren<QCheckBox*>())
    if (box->text() == "Part of a single cut") shows = box;
  ASSERT_TRUE(shows);
  EXPECT_FALSE(shows->isChecked());
  shows->click();
  EXPECT_TRUE(window().mapBar().style().partsOfOneCut);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window().sceneView().resting(); }, kPatience));
  picture("cut-single-part");
  // What does not change the blades lets it stand.
  const auto was = block().part.value;
  bench().editDesign("Limit", [](Design& design) { design.process.jointGap = 0.2; });
  ASSERT_TRUE(settle());
  EXPECT_EQ(block().part.value, was);
}

TEST_F(CutFieldsTest, WhatIsLeftIsSeenWhenTheHandRests) {
  ASSERT_TRUE(settleInFull());
  ASSERT_TRUE(block().part.value && block().part.value->solid);
  picture("cuts-part");
  const scene::Content content = pipeline::sceneContent(*bench().shown());
  const auto* part = content.first<scene::FoamPart>();
  ASSERT_TRUE(part);
  EXPECT_FALSE(part->mesh.triangles.empty());
  const auto* cut = content.first<scene::CutSurface>();
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->depths.size(), cut->grid.points.size());
  EXPECT_TRUE(std::ranges::any_of(cut->depths, [](double depth) { return depth < -50; }));
  // The crease is as designed; by a narrower tolerance it would not be everywhere.
  const auto* creases = content.first<scene::Creases>();
  ASSERT_TRUE(creases);
  EXPECT_FALSE(creases->within.empty());
  EXPECT_TRUE(creases->beyond.empty());
  pipeline::Evaluation strict = *bench().shown();
  strict.design.process.tolerance = 0.5 * block().together.value->creases.front().offMean;
  const scene::Content held = pipeline::sceneContent(strict);
  ASSERT_TRUE(held.first<scene::Creases>());
  EXPECT_FALSE(held.first<scene::Creases>()->beyond.empty());
}

TEST_F(CutFieldsTest, ACutIsAddedAndTakenAway) {
  ASSERT_TRUE(window().openExample("bump"));
  ASSERT_TRUE(settle());
  const Design before = bench().design();
  auto* remove = window().findChild<QPushButton*>("removeCut");
  EXPECT_FALSE(remove->isVisibleTo(&window()));
  QTest::mouseClick(window().findChild<QPushButton*>("addCut"), Qt::LeftButton);
  ASSERT_EQ(bench().design().cuts.size(), 2u);
  EXPECT_EQ(bench().cut().id, bench().design().cuts[1].id) << "the new one is at work";
  EXPECT_TRUE(std::holds_alternative<PolesSurface>(bench().source().surface->shape));
  ASSERT_TRUE(settleInFull());
  ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_EQ(block().together.value->creases.size(), 1u);
  picture("cuts-added");
  ASSERT_TRUE(remove->isVisibleTo(&window()));
  QTest::mouseClick(remove, Qt::LeftButton);
  EXPECT_EQ(bench().design().cuts, before.cuts);
  EXPECT_EQ(bench().design().sources, before.sources);
  EXPECT_EQ(bench().cut().id, before.cut().id);
  ASSERT_TRUE(settle());
  bench().document().undoStack().undo();
  EXPECT_EQ(bench().design().cuts.size(), 2u);
}

TEST_F(CutFieldsTest, AnotherDesignMayBeOpenedWhileWorkIsUnderWay) {
  choose("cut", 1);
  for (const char* name : {"bump", "two-crossing-cuts", "saddle", "three-block-wall"}) {
    ASSERT_TRUE(window().openExample(name));
    EXPECT_EQ(bench().cut().id, bench().design().cut().id) << name;
    EXPECT_TRUE(bench().runner().busy());
    QTest::qWait(40);
  }
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current());
}

TEST_F(CutFieldsTest, OneCutHasNoChoice) {
  ASSERT_TRUE(window().openExample("ripple-along"));
  ASSERT_TRUE(settle());
  window().commands()["tab.blocks"]->trigger();
  EXPECT_FALSE(window().findChild<ChoiceField*>("cut")->isVisibleTo(&window()));
  EXPECT_TRUE(window().findChild<ChoiceField*>("turn")->isVisibleTo(&window()));
  EXPECT_FALSE(window().findChild<ChoiceField*>("order")->isVisibleTo(&window()));
}

}  // namespace
}  // namespace bw::app
