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
  geometry::NamedCurve section(double y) const {
    geometry::NamedCurve curve{"profile", {}};
    for (int i = 0; i <= 60; ++i)
      curve.points.emplace_back(10.0 * i, y,
                                260 + 30 * std::sin(i / 20.0) + 15 * std::sin(i / 30.0 + y / 400));
    return curve;
  }

  std::string dxf(const std::vector<geometry::NamedCurve>& curves) const {
    std::string text = "0\nSECTION\n2\nENTITIES\n";
    for (const geometry::NamedCurve& curve : curves) {
      text += "0\nPOLYLINE\n8\nroof\n66\n1\n70\n8\n";
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
};

TEST_F(CurvesInTheWindow, BecomeANewDesignThatIsCutAndTellHowNearItIs) {
  const std::vector<geometry::NamedCurve> curves = {section(0), section(400), section(800)};
  for (const auto& [name, bytes] :
       {std::pair<std::string, std::string>("roof.step", geometry::curvesStepText(curves, "roof").value()),
        {"roof.dxf", dxf(curves)}}) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(open(name, bytes));
    ASSERT_TRUE(settle());
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
  const Result<void> opened = open("one.dxf", dxf({section(0)}));
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message.find("there is one curve"), std::string::npos) << opened.error().message;
  EXPECT_EQ(bench().design().name, "roof");
}

TEST_F(CurvesInTheWindow, FacesAreOpenedAsEver) {
  ASSERT_TRUE(open("saddle.step", geometry::exampleStep("saddle").value()));
  EXPECT_FALSE(bench().design().source().surface);
  EXPECT_EQ(bench().design().source().path, path("saddle.step"));
}

}  // namespace
}  // namespace bw::app
