// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <QImage>

#include <cstring>

#include "bw/geometry/cad_model.h"
#include "bw/pipeline/handover.h"
#include "window_fixture.h"

namespace bw::app {

TEST(StlBytes, HoldTheTrianglesWithTheirNormals) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {1, 1, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 0, 3}};
  const std::string stl = pipeline::stlBytes(mesh, "solid thing");
  ASSERT_EQ(stl.size(), 84u + 2 * 50u);
  EXPECT_NE(stl.rfind("solid", 0), 0u) << "a reader would take it for text";
  std::uint32_t count = 0;
  std::memcpy(&count, stl.data() + 80, 4);
  EXPECT_EQ(count, 2u);
  float first[12], second[12];
  std::memcpy(first, stl.data() + 84, 48);
  std::memcpy(second, stl.data() + 84 + 50, 48);
  EXPECT_EQ(std::vector<float>(first, first + 12), (std::vector<float>{0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0}));
  EXPECT_EQ(std::vector<float>(second, second + 3), (std::vector<float>{0, 0, 0})) << "without area";
}

TEST(ReportPage, EscapesNamesFromOutside) {
  pipeline::Evaluation evaluation;
  evaluation.design.name = "<script>alert(1)</script>\n& more";
  const std::string page = pipeline::reportHtml(pipeline::reportOf(evaluation, {}, {}));
  EXPECT_EQ(page.find("<script>"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;alert(1)&lt;/script&gt;\\n&amp; more"), std::string::npos);
  EXPECT_NE(page.find("There is no result"), std::string::npos);
}

TEST_F(WindowTest, HandsOverAFolderThatAColleagueUnderstands) {
  openPanel();
  const fs::path folder = path("handover");
  QString shown;
  window().questions().exportFolder = [&] { return QString::fromStdString(folder.string()); };
  window().questions().showFolder = [&](const QString& place) { shown = place; };
  const scene::Camera camera = window().sceneView().camera();
  const scene::Style style = window().sceneView().sceneStyle();
  window().exportEverything();
  ASSERT_TRUE(settle());
  EXPECT_EQ(shown, QString::fromStdString(folder.string()));
  EXPECT_EQ(window().sceneView().sceneStyle()[scene::Kind::cut].map, style[scene::Kind::cut].map);
  EXPECT_LT((window().sceneView().camera().position - camera.position).norm(), 1e-9);

  std::uintmax_t listed = 0, there = 0;
  for (const WrittenFile& file : bench().exportedFiles()) {
    EXPECT_EQ(fs::file_size(folder / file.path), file.bytes) << file.path;
    ++listed;
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder)) there += entry.is_regular_file();
  EXPECT_EQ(listed, there);

  // The report tells the number that the window shows, with its pictures inside.
  const std::string html = readFile(folder / "report.html").value();
  const std::string deviation = lengthText(bench().sweep()->analysis.summary.deviationMax).toStdString();
  EXPECT_NE(html.find("Largest deviation"), std::string::npos);
  EXPECT_NE(html.find(deviation.substr(0, deviation.find(' '))), std::string::npos) << deviation;
  EXPECT_NE(html.find("data:image/png;base64,"), std::string::npos);
  EXPECT_NE(readFile(folder / "report.html").value().find("width=\"640\" height=\"400\""), std::string::npos)
      << "pictures keep their shape, also where only one side would be taken";
  const std::string pdf = readFile(folder / "report.pdf").value();
  EXPECT_EQ(pdf.rfind("%PDF-", 0), 0u);
  EXPECT_GT(pdf.size(), 20000u) << "pictures are in it";
  for (const char* name : {"deviation", "deviation-top", "angle", "curvature"}) {
    const QImage picture(QString::fromStdString((folder / "pictures" / name).string() + ".png"));
    EXPECT_EQ(picture.size(), QSize(1280, 800)) << name;
  }
  // Geometry opens again, and so does the design.
  const auto iges = geometry::CadModel::read(folder / "surface.iges");
  ASSERT_TRUE(iges) << iges.error().message;
  EXPECT_EQ(iges->info().faces, 1);
  EXPECT_TRUE(loadDesign(folder / pipeline::kDesignFile));
  const std::string stl = readFile(folder / "mesh.stl").value();
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, stl.data() + 80, 4);
  EXPECT_EQ(stl.size(), 84 + 50u * triangles);
  EXPECT_EQ(triangles, bench().sweep()->analysis.cut.triangles().triangles.size());
}

}  // namespace bw::app
