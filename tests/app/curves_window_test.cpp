// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// CAD files that hold curves alone, opened in the window.
#include <cmath>

#include "bw/geometry/export.h"
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

TEST_F(CurvesInTheWindow, FacesAreOpenedAsEver) {
  ASSERT_TRUE(open("saddle.step", geometry::exampleStep("saddle").value()));
  EXPECT_FALSE(bench().design().source().surface);
  EXPECT_EQ(bench().design().source().path, path("saddle.step"));
}

}  // namespace
}  // namespace bw::app
