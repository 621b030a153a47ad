// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// CAD files that hold curves alone, opened in the window.
#include <cmath>

#include "bw/geometry/export.h"
#include "bw/pipeline/drawn_design.h"
#include "window_fixture.h"

namespace bw::app {
namespace {

class CurvesInTheWindow : public WindowTest {
 protected:
  geometry::NamedCurve section(double y, const std::string& layer = "roof", double up = 0) const {
    geometry::NamedCurve curve{layer, {}};
    for (int i = 0; i <= 60; ++i)
      curve.points.emplace_back(10.0 * i, y,
                                260 + up + 30 * std::sin(i / 20.0) + 15 * std::sin(i / 30.0 + y / 400));
    return curve;
  }

  std::string dxf(const std::vector<geometry::NamedCurve>& curves, const std::string& more = "") const {
    std::string text = "0\nSECTION\n2\nENTITIES\n" + more;
    for (const geometry::NamedCurve& curve : curves) {
      text += "0\nPOLYLINE\n8\n" + curve.name + "\n66\n1\n70\n8\n";
      for (const Eigen::Vector3d& p : curve.points)
        text += "0\nVERTEX\n10\n" + std::to_string(p.x()) + "\n20\n" + std::to_string(p.y()) + "\n30\n" +
                std::to_string(p.z()) + "\n";
      text += "0\nSEQEND\n";
    }
    return text + "0\nENDSEC\n0\nEOF\n";
  }

  Result<void> open(const std::string& name, const std::string& bytes) {
    EXPECT_TRUE(writeFile(path(name), bytes));
    return window().openFile(QString::fromStdString(path(name).string()));
  }

  /// Waits until what is read in the background is open, or is not.
  bool readToItsEnd() {
    return QTest::qWaitFor([&] { return !bench().reading(); }, kPatience);
  }

  /// Waits until the banner says so.
  bool told(const QString& words) {
    return QTest::qWaitFor(
        [&] { return window().banner().isVisible() && window().banner().text().contains(words); }, kPatience);
  }

  /// Puts another drawing in the place of walls.dxf, as programs that draw do.
  void save(const std::string& bytes) {
    ASSERT_TRUE(writeFile(path("walls.tmp"), bytes));
    fs::rename(path("walls.tmp"), path("walls.dxf"));
  }

  static QStringList itemsOf(const ChoiceField& field) {
    QStringList items;
    for (int i = 0; i < field.count(); ++i) items << field.itemText(i);
    return items;
  }

  /// Chooses an item as a hand does.
  void choose(ChoiceField& field, int index) {
    field.setCurrentIndex(index);
    emit field.activated(index);
    ASSERT_TRUE(settle());
  }

  std::size_t sections() {
    return std::get<SectionsSurface>(bench().design().source().surface->shape).sections.size();
  }
};

TEST_F(CurvesInTheWindow, BecomeANewDesignThatIsCutAndTellHowNearItIs) {
  const std::vector<geometry::NamedCurve> curves = {section(0), section(400), section(800)};
  for (const auto& [name, bytes] :
       {std::pair<std::string, std::string>("roof.step", geometry::curvesStepText(curves, "roof").value()),
        {"roof.dxf", dxf(curves)}}) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(open(name, bytes));
    EXPECT_TRUE(bench().reading()) << "the window goes on while a file is read";
    EXPECT_TRUE(window().onStartPage());
    ASSERT_TRUE(settle());
    EXPECT_FALSE(bench().reading());
    EXPECT_FALSE(window().onStartPage());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
    const auto& surface = bench().design().source().surface;
    ASSERT_TRUE(surface);
    EXPECT_EQ(std::get<SectionsSurface>(surface->shape).sections.size(), 3u);
    EXPECT_EQ(bench().design().name, "roof");
    EXPECT_TRUE(bench().document().file().empty()) << "it is not saved yet";
    EXPECT_TRUE(window().banner().isVisible());
    EXPECT_TRUE(window().banner().text().contains("3 sections")) << window().banner().text().toStdString();
    EXPECT_TRUE(window().banner().text().contains("within 0.")) << window().banner().text().toStdString();
    EXPECT_TRUE(window().banner().text().contains("lengths were taken in mm"))
        << window().banner().text().toStdString();
    EXPECT_TRUE(bench().sweep());
    picture(("curves-" + fs::path(name).extension().string().substr(1)).c_str());
    window().questions().unsaved = [](const QString&) { return Questions::Unsaved::discard; };
    window().commands()["file.close"]->trigger();
    ASSERT_TRUE(window().onStartPage());
  }
}

TEST_F(CurvesInTheWindow, ThatMakeNoLoftAreToldAndTheDesignStays) {
  ASSERT_TRUE(open("roof.dxf", dxf({section(0), section(800)})));
  ASSERT_TRUE(settle());
  window().questions().unsaved = [](const QString&) { return Questions::Unsaved::discard; };
  ASSERT_TRUE(open("one.dxf", dxf({section(0)})));
  ASSERT_TRUE(readToItsEnd());
  ASSERT_TRUE(bench().readingError());
  EXPECT_NE(bench().readingError()->message.find("there is one curve"), std::string::npos);
  EXPECT_TRUE(window().banner().text().contains("there is one curve"))
      << window().banner().text().toStdString();
  EXPECT_EQ(bench().design().name, "roof");
  EXPECT_TRUE(bench().current()) << "its result stands";
}

TEST_F(CurvesInTheWindow, AreReadInTheBackgroundAndStopped) {
  ASSERT_TRUE(open("roof.dxf", dxf({section(0), section(800)})));
  ASSERT_TRUE(settle());
  // So much that it is still being read when Stop is pressed; what stands before the curves is passed over.
  std::string text;
  for (int i = 0; i < 1'500'000; ++i) text += "0\nPOINT\n8\nx\n";
  ASSERT_TRUE(open("large.dxf", dxf({section(0), section(400), section(800)}, text)));
  QStringList told;
  QObject::connect(&bench().runner(), &model::EvaluationRunner::progressed, &window(),
                   [&told](double, const QString& step) { told << step; });
  ASSERT_TRUE(QTest::qWaitFor([&] { return !told.isEmpty(); }, kPatience)) << "its progress is told";
  EXPECT_EQ(told.first(), "reading curves");
  EXPECT_EQ(bench().stepStates()[int(model::Step::input)].kind, model::StepState::Kind::running);
  EXPECT_TRUE(bench().reading());
  EXPECT_TRUE(window().commands()["edit.cancel"]->isEnabled());
  window().commands()["edit.cancel"]->trigger();
  ASSERT_TRUE(readToItsEnd());
  EXPECT_EQ(bench().design().name, "roof");
  EXPECT_EQ(sections(), 2u);
  EXPECT_TRUE(bench().current()) << "its result stands";
  EXPECT_TRUE(window().banner().text().contains("The reading of large.dxf was stopped"))
      << window().banner().text().toStdString();
  // And again, to its end.
  ASSERT_TRUE(open("large.dxf", dxf({section(0), section(400), section(800)}, text)));
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().design().name, "large");
  EXPECT_EQ(sections(), 3u);
}

TEST_F(CurvesInTheWindow, AnotherFileTakesThePlaceOfTheOneThatIsRead) {
  ASSERT_TRUE(open("roof.dxf", dxf({section(0), section(800)})));
  ASSERT_TRUE(open("other.dxf", dxf({section(0), section(400), section(800)})));
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().design().name, "other");
  ASSERT_TRUE(open("roof.dxf", dxf({section(0), section(800)})));
  ASSERT_TRUE(window().openExample("saddle"));
  EXPECT_FALSE(bench().reading());
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().design().name, "Saddle");
}

TEST_F(CurvesInTheWindow, WhatIsEditedWhileAFileIsReadIsAskedFor) {
  ASSERT_TRUE(open("roof.dxf", dxf({section(0), section(800)})));
  ASSERT_TRUE(settle());
  int asked = 0;
  auto answer = Questions::Unsaved::cancel;
  window().questions().unsaved = [&](const QString&) { return ++asked, answer; };
  for (const bool may : {false, true}) {
    answer = Questions::Unsaved::discard;  // of what stands before
    ASSERT_TRUE(open("other.dxf", dxf({section(0), section(400), section(800)})));
    asked = 0;
    bench().editDesign("Prepare", [&](Design& design) { design.cut().sections.stations = may ? 21 : 20; });
    answer = may ? Questions::Unsaved::discard : Questions::Unsaved::cancel;
    ASSERT_TRUE(readToItsEnd());
    EXPECT_EQ(asked, 1);
    EXPECT_EQ(bench().design().name, may ? "other" : "roof");
  }
}

TEST_F(CurvesInTheWindow, TheLayerOfADrawingIsChosen) {
  // A circle lies on one of its layers, so that all together give no surface.
  const std::string circle = "0\nCIRCLE\n8\nholes\n10\n0\n20\n0\n40\n5\n";
  ASSERT_TRUE(open("walls.dxf", dxf({section(0), section(400), section(800), section(100, "ceiling", 60),
                                     section(700, "ceiling", 60)},
                                    circle)));
  ASSERT_TRUE(settle());
  ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_EQ(sections(), 3u) << "the layer with the most curves";
  const QString told = window().banner().text();
  EXPECT_TRUE(told.contains("The layer “roof” alone was taken, since all together give no surface"))
      << told.toStdString();
  EXPECT_TRUE(told.contains("a circle on the layer holes")) << told.toStdString();
  auto* layer = find<ChoiceField>("Layer");
  ASSERT_NE(layer, nullptr);
  EXPECT_EQ(itemsOf(*layer),
            (QStringList{"All layers: 6 curves", "ceiling: 2 curves", "holes: 1 curve", "roof: 3 curves"}));
  EXPECT_EQ(layer->currentText(), "roof: 3 curves");
  picture("curves-layer");

  bench().editDesign("Length", [](Design& design) { design.blade.length = 1200; });
  const Design before = bench().design();
  choose(*layer, 1);
  EXPECT_EQ(sections(), 2u);
  EXPECT_EQ(layer->currentText(), "ceiling: 2 curves");
  EXPECT_EQ(bench().design().blade.length, 1200) << "what was set by hand stays";
  EXPECT_NE(bench().design().block().placement, before.block().placement) << "the block lies around it";
  EXPECT_EQ(bench().document().undoStack().undoText(), "Take layer ceiling");

  // What gives no surface is told, and nothing changes.
  choose(*layer, 2);
  EXPECT_TRUE(window().banner().text().contains("is closed")) << window().banner().text().toStdString();
  EXPECT_EQ(layer->currentText(), "ceiling: 2 curves");

  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().design(), before);
  EXPECT_EQ(layer->currentText(), "roof: 3 curves");
  bench().document().undoStack().redo();
  EXPECT_EQ(layer->currentText(), "ceiling: 2 curves");

  // A surface that a hand has changed is of no layer, until one is taken again.
  bench().editSurface("Pull", [](DesignedSurface& surface) {
    std::get<SectionsSurface>(surface.shape).sections[0].points[1].y() += 3;
  });
  EXPECT_EQ(layer->currentText(), "Changed since");
  choose(*layer, 1);
  EXPECT_EQ(layer->currentText(), "ceiling: 2 curves");
  EXPECT_EQ(layer->count(), 4);
}

TEST_F(CurvesInTheWindow, AreReadAgainWhenTheDrawingChanges) {
  const std::vector<geometry::NamedCurve> roof = {section(0), section(400), section(800)};
  std::vector<geometry::NamedCurve> all = roof;
  all.push_back(section(100, "ceiling", 60));
  all.push_back(section(700, "ceiling", 60));
  const std::string circle = "0\nCIRCLE\n8\nholes\n10\n0\n20\n0\n40\n5\n";
  ASSERT_TRUE(open("walls.dxf", dxf(all, circle)));
  ASSERT_TRUE(settle());
  choose(*find<ChoiceField>("Layer"), 1);
  ASSERT_EQ(sections(), 2u);
  bench().editDesign("Length", [](Design& design) { design.blade.length = 1200; });
  ASSERT_TRUE(settle());
  const Design before = bench().design();
  // A section more on the layer that was chosen.
  all.push_back(section(400, "ceiling", 90));
  save(dxf(all, circle));
  ASSERT_TRUE(told("walls.dxf has changed on disk and was read again at"))
      << window().banner().text().toStdString();
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  EXPECT_EQ(sections(), 3u);
  EXPECT_EQ(find<ChoiceField>("Layer")->currentText(), "ceiling: 3 curves");
  EXPECT_EQ(bench().design().blade.length, 1200) << "what was set by hand stays";
  EXPECT_EQ(bench().document().undoStack().undoText(), "Read walls.dxf again");
  picture("curves-read-again");
  const Design after = bench().design();
  // What is no drawing, or half of one, changes nothing.
  const std::string whole = dxf(all, circle);
  for (const std::string& bytes : {std::string("no drawing"), whole.substr(0, whole.size() / 2)}) {
    window().banner().outdate(Topic::source);
    save(bytes);
    ASSERT_TRUE(told("cannot be used as it is now")) << window().banner().text().toStdString();
    EXPECT_EQ(bench().design(), after);
  }
  fs::remove(path("walls.dxf"));
  ASSERT_TRUE(told("walls.dxf is no longer there; the design holds its surface"));
  EXPECT_EQ(bench().design(), after);
  // The step is undone as any other; then the surface is one that a person chose.
  bench().document().undoStack().undo();
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().design(), before);
  EXPECT_EQ(find<ChoiceField>("Layer")->currentText(), "Changed since");
  save(whole);
  ASSERT_TRUE(told("was changed here since")) << window().banner().text().toStdString();
  EXPECT_EQ(bench().design(), before);
  QTest::mouseClick(window().banner().action(), Qt::LeftButton);
  ASSERT_TRUE(told("was read again at"));
  ASSERT_TRUE(settle());
  EXPECT_EQ(bench().design(), after) << "the block and the travel follow, too";
}

TEST_F(CurvesInTheWindow, TheDesignKeepsItsDrawingAndItsLayer) {
  std::vector<geometry::NamedCurve> all = {section(0), section(400), section(800),
                                           section(100, "ceiling", 60), section(700, "ceiling", 60)};
  const std::string circle = "0\nCIRCLE\n8\nholes\n10\n0\n20\n0\n40\n5\n";
  ASSERT_TRUE(open("walls.dxf", dxf(all, circle)));
  ASSERT_TRUE(settle());
  choose(*find<ChoiceField>("Layer"), 1);
  ASSERT_TRUE(settle());
  const fs::path file = path("walls.bladewright");
  ASSERT_TRUE(bench().saveTo(file));
  const Design saved = bench().design();
  ASSERT_TRUE(saved.source().drawing);
  EXPECT_EQ(saved.source().drawing->layer, "ceiling");
  const auto reopen = [&] {
    window().questions().unsaved = [](const QString&) { return Questions::Unsaved::discard; };
    window().commands()["file.close"]->trigger();
    ASSERT_TRUE(window().openFile(QString::fromStdString(file.string())));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
  };
  // Opened again its layers are there, and nothing has changed.
  ASSERT_NO_FATAL_FAILURE(reopen());
  EXPECT_FALSE(bench().document().modified());
  auto* layer = find<ChoiceField>("Layer");
  ASSERT_TRUE(layer);
  EXPECT_EQ(itemsOf(*layer),
            (QStringList{"All layers: 6 curves", "ceiling: 2 curves", "holes: 1 curve", "roof: 3 curves"}));
  EXPECT_EQ(layer->currentText(), "ceiling: 2 curves");
  picture("curves-layer-reopened");
  // A drawing that changes is read again with that layer.
  all.push_back(section(400, "ceiling", 90));
  save(dxf(all, circle));
  ASSERT_TRUE(told("walls.dxf has changed on disk and was read again at"))
      << window().banner().text().toStdString();
  ASSERT_TRUE(settle());
  EXPECT_EQ(sections(), 3u);
  EXPECT_EQ(layer->currentText(), "ceiling: 3 curves");
  EXPECT_NE(bench().design().block().placement, saved.block().placement) << "the block lies around it";
  // And so it is where it had changed before the design was opened; without the window, too.
  const auto followed = [&] {
    return pipeline::followDrawing(loadDesign(file).value()).value_or(pipeline::FollowedDesign{});
  };
  EXPECT_EQ(followed().severity, Severity::info);
  EXPECT_NE(followed().told.find("was read again: 3 curves of walls.dxf"), std::string::npos)
      << followed().told;
  EXPECT_EQ(designToJson(followed().design), designToJson(bench().design()));
  EXPECT_EQ(pipeline::followDrawing(followed().design)->told, "") << "now it is as it was read";
  ASSERT_NO_FATAL_FAILURE(reopen());
  ASSERT_TRUE(told("walls.dxf has changed on disk and was read again at"))
      << window().banner().text().toStdString();
  ASSERT_TRUE(settle());
  EXPECT_EQ(sections(), 3u);
  EXPECT_EQ(bench().document().undoStack().undoText(), "Read walls.dxf again");
  bench().document().undoStack().undo();
  EXPECT_EQ(sections(), 2u);
  // Of another layer, too.
  choose(*find<ChoiceField>("Layer"), 3);
  EXPECT_EQ(find<ChoiceField>("Layer")->currentText(), "roof: 3 curves");
  EXPECT_EQ(bench().design().source().drawing->layer, "roof");
  // What a hand has changed is asked for.
  bench().editSurface("Pull", [](DesignedSurface& surface) {
    std::get<SectionsSurface>(surface.shape).sections[0].points[1].y() += 3;
  });
  ASSERT_TRUE(bench().saveTo(file));
  all.front() = section(0, "roof", 5);
  save(dxf(all, circle));
  EXPECT_EQ(followed().severity, Severity::warning);
  EXPECT_NE(followed().told.find("was changed by hand since"), std::string::npos) << followed().told;
  EXPECT_EQ(followed().design, loadDesign(file).value());
  ASSERT_NO_FATAL_FAILURE(reopen());
  ASSERT_TRUE(told("was changed here since")) << window().banner().text().toStdString();
  EXPECT_FALSE(bench().document().modified());
  EXPECT_EQ(find<ChoiceField>("Layer")->currentText(), "Changed since");
  QTest::mouseClick(window().banner().action(), Qt::LeftButton);
  ASSERT_TRUE(told("was read again at")) << window().banner().text().toStdString();
  ASSERT_TRUE(settle());
  EXPECT_EQ(find<ChoiceField>("Layer")->currentText(), "roof: 3 curves");
  ASSERT_TRUE(bench().saveTo(file));
  // Without the drawing the design goes on, and keeps what it knows of it.
  fs::rename(path("walls.dxf"), path("away.dxf"));
  EXPECT_NE(followed().told.find("cannot be read; the surface that the design holds is cut"),
            std::string::npos)
      << followed().told;
  ASSERT_NO_FATAL_FAILURE(reopen());
  ASSERT_TRUE(told("is no longer there; the design holds its surface"))
      << window().banner().text().toStdString();
  EXPECT_EQ(sections(), 3u);
  ASSERT_TRUE(bench().design().source().drawing);
  EXPECT_EQ(bench().design().source().drawing->layer, "roof");
}

TEST_F(CurvesInTheWindow, ADrawingOfOneLayerHasNoneToChoose) {
  ASSERT_TRUE(open("roof.dxf", dxf({section(0), section(800)})));
  ASSERT_TRUE(settle());
  EXPECT_EQ(find<ChoiceField>("Layer"), nullptr);
  EXPECT_FALSE(window().banner().text().contains("layer")) << window().banner().text().toStdString();
}

TEST_F(CurvesInTheWindow, LargeFilesWithFacesAreLookedAtInTheBackground) {
  std::string text = geometry::exampleStep("saddle").value();
  const std::size_t data = text.find("DATA;");
  ASSERT_NE(data, std::string::npos);
  std::string beside;
  while (beside.size() < 5'000'000) beside += "\n/* What a file may tell beside its entities. */";
  text.insert(data + 5, beside);
  ASSERT_TRUE(open("large.step", text));
  EXPECT_TRUE(bench().reading());
  ASSERT_TRUE(readToItsEnd());
  EXPECT_FALSE(bench().readingError());
  EXPECT_FALSE(window().onStartPage());
  EXPECT_EQ(bench().design().source().path, path("large.step"));
  ASSERT_TRUE(settle());
  EXPECT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
}

TEST_F(CurvesInTheWindow, FacesAreOpenedAsEver) {
  ASSERT_TRUE(open("saddle.step", geometry::exampleStep("saddle").value()));
  EXPECT_FALSE(bench().design().source().surface);
  EXPECT_EQ(bench().design().source().path, path("saddle.step"));
}

}  // namespace
}  // namespace bw::app
