// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The Input step: in which unit a file is read, and how its faces are chosen.

#include "controls/fields.h"
#include "step_merge.h"
#include "window_fixture.h"

namespace bw::app {
namespace {

class InputStep : public WindowTest {
 protected:
  /// The saddle (600 × 800 mm), the cap of a sphere (600 × 600) and a patch of a torus in one file.
  void openThree() {
    std::vector<std::string> parts;
    for (const char* name : {"saddle", "sphere-cap", "torus-patch"})
      parts.push_back(geometry::exampleStep(name).value());
    std::ofstream(path("three.step"), std::ios::binary) << bw::test::mergedStep(parts);
    ASSERT_TRUE(window().openFile(QString::fromStdString(path("three.step").string())));
    bench().editDesign("Prepare", [](Design& design) { design.cut().sections.stations = 12; });
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  }

  /// Chooses as a user does with the keyboard, then waits for the result.
  void choose(const QString& name, int index) {
    auto* field = find<ChoiceField>(name);
    ASSERT_TRUE(field) << name.toStdString();
    ASSERT_LT(index, field->count());
    field->setCurrentIndex(index);
    emit field->activated(index);
    ASSERT_TRUE(settle());
  }

  std::vector<int> cutFaces() {
    const auto& evaluation = bench().runner().evaluation();
    return evaluation && evaluation->cut().target.value ? evaluation->cut().target.value->faces()
                                                        : std::vector<int>();
  }
};

TEST_F(InputStep, TakesTheNumbersInAnotherUnitAndShowsTheSizes) {
  openThree();
  auto* unit = find<ChoiceField>("Read as");
  ASSERT_TRUE(unit);
  ASSERT_EQ(unit->count(), 5);
  EXPECT_TRUE(unit->itemText(0).startsWith("As stated, mm: 600 × 800 ×")) << unit->itemText(0).toStdString();
  EXPECT_TRUE(unit->itemText(2).startsWith("cm: 6000 × 8000 ×")) << unit->itemText(2).toStdString();
  choose("Read as", 2);
  EXPECT_EQ(bench().design().source().unit, LengthUnit::cm);
  const auto& evaluation = bench().runner().evaluation();
  ASSERT_TRUE(evaluation && evaluation->cut().target.value);
  EXPECT_NEAR(evaluation->cut().target.value->bounds().size().x(), 6000, 1e-6);
  EXPECT_TRUE(find<ChoiceField>("Read as")->itemText(1).startsWith("mm: 600 × 800 ×"));
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  EXPECT_FALSE(bench().design().source().unit);
  EXPECT_EQ(unit->currentIndex(), 0);
}

TEST_F(InputStep, AsksAboutTheUnitWhileTheSizeCannotBeMeant) {
  openThree();
  const auto question = [&] {
    for (const Notice& notice : window().banner().notices())
      if (notice.topic == Topic::unit) return notice.text;
    return QString();
  };
  EXPECT_EQ(question(), QString());
  choose("Read as", 3);
  ASSERT_EQ(bench().design().source().unit, LengthUnit::m);
  EXPECT_TRUE(question().contains("read in m")) << question().toStdString();
  EXPECT_TRUE(question().contains("Input ▸ Read as")) << question().toStdString();
  picture("unit-question");
  choose("Read as", 2);
  EXPECT_EQ(question(), QString()) << "6 × 8 m can be meant";
  choose("Read as", 3);
  EXPECT_NE(question(), QString()) << "asked once only";
  // Answered is answered, whatever else changes.
  const auto notices = window().banner().notices();
  for (std::size_t i = 0; i < notices.size(); ++i)
    QTest::mouseClick(window().banner().cross(), Qt::LeftButton);
  bench().editDesign("Change tolerance", [](Design& design) { design.process.tolerance = 0.75; });
  ASSERT_TRUE(settle());
  EXPECT_EQ(question(), QString());
}

TEST_F(InputStep, ChoosesFacesByNameSideAndPoint) {
  openThree();
  EXPECT_EQ(cutFaces(), std::vector<int>{0});
  choose("Faces", int(FaceChoice::Kind::named));
  auto* names = find<ChoiceField>("Name");
  ASSERT_TRUE(names);
  ASSERT_EQ(names->count(), 3);
  EXPECT_EQ(names->itemText(1), "sphere-cap");
  choose("Name", 1);
  EXPECT_EQ(cutFaces(), std::vector<int>{1});
  picture("input-by-name");
  choose("Faces", int(FaceChoice::Kind::group));
  auto* sides = find<ChoiceField>("Side");
  ASSERT_TRUE(sides);
  ASSERT_EQ(sides->count(), 3);
  EXPECT_TRUE(sides->itemText(0).startsWith("1: face 0 (saddle), 0.5")) << sides->itemText(0).toStdString();
  choose("Side", 1);
  EXPECT_EQ(bench().design().cut().face.group, 1);
  picture("input-one-side");
  choose("Faces", int(FaceChoice::Kind::nearest));
  EXPECT_EQ(cutFaces().size(), 1u);
  EXPECT_TRUE(find<NumberField>("Point z"));
  choose("Faces", int(FaceChoice::Kind::indices));
  EXPECT_EQ(bench().design().cut().face.indices, cutFaces()) << "it begins with what is cut";
}

}  // namespace
}  // namespace bw::app
