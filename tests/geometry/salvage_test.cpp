// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Files that are not quite as the standard wants them: what is usable is read, and the rest is told.

#include <algorithm>

#include "step_parts.h"

namespace bw::geometry::test {
namespace {

TEST(Salvage, CurvesWithoutANameAreReadAsTheyAre) {
  // As Rhino 8 writes them.
  for (const char* name : {"sphere-cap", "saddle", "torus-patch"}) {
    const std::string step = exampleStep(name).value();
    std::string rhino = step;
    for (const char* curve : {"CIRCLE(", "LINE(", "B_SPLINE_CURVE_WITH_KNOTS("})
      rhino = replaced(rhino, std::string(curve) + "''", std::string(curve) + "$");
    ASSERT_NE(rhino, step) << name;
    const CadModel as = modelOf(rhino), was = modelOf(step);
    EXPECT_EQ(as.info().faces, was.info().faces) << name;
    EXPECT_EQ(as.info().bounds.min, was.info().bounds.min) << name;
    EXPECT_EQ(as.info().bounds.max, was.info().bounds.max) << name;
    EXPECT_TRUE(as.info().leftOut.empty()) << name;
    ASSERT_EQ(as.info().healing.size(), 1u) << name;
    EXPECT_EQ(as.info().healing[0].rfind("4 entities have no name where STEP asks for one (#", 0), 0u)
        << as.info().healing[0];
  }
}

TEST(Salvage, ShapesWithoutAnyNameAreRead) {
  std::string step = exampleStep("saddle").value();
  for (const char* type :
       {"CARTESIAN_POINT", "DIRECTION", "AXIS2_PLACEMENT_3D", "VERTEX_POINT", "B_SPLINE_CURVE_WITH_KNOTS",
        "B_SPLINE_SURFACE_WITH_KNOTS", "EDGE_CURVE", "ORIENTED_EDGE", "EDGE_LOOP", "FACE_OUTER_BOUND"})
    step = replaced(step, std::string(type) + "(''", std::string(type) + "($");
  for (const char* type : {"ADVANCED_FACE", "OPEN_SHELL", "SHELL_BASED_SURFACE_MODEL"})
    step = replaced(step, std::string(type) + "('saddle'", std::string(type) + "($");
  const CadModel model = modelOf(step);
  EXPECT_EQ(model.info().faces, 1);
  EXPECT_EQ(model.info().faceList[0].name, "");
  EXPECT_EQ(model.info().bounds.min, modelOf(exampleStep("saddle").value()).info().bounds.min);
}

TEST(Salvage, TextsThatOtherProgramsBeginAndEndWithDoNotMatter) {
  const std::string step = exampleStep("saddle").value();
  const Bounds bounds = modelOf(step).info().bounds;
  for (const std::string& text :
       {"\xef\xbb\xbf" + step, "\xef\xbb\xbf\r\n" + step, "/* written by a program; #1= */\n" + step,
        replaced(step, "\n", "\r\n"), replaced(step, "\n", "\n\n"), step + "\x1a",
        step + std::string(512, '\0'), replaced(step, "=", " = "),
        replaced(step, "ISO-10303-21;\nHEADER;", "ISO-10303-21;\n/* made\n by */\nHEADER;"),
        replaced(
            step, "FILE_DESCRIPTION((''),'2;1')",
            "FILE_DESCRIPTION(\n/* description */ ('B\xe4umer', 'CAx-IF \\X\\E4'),\n/* level */ '2;1')")}) {
    const auto model = CadModel::readBytes(text, "program.stp");
    ASSERT_TRUE(model) << model.error().message << text.substr(0, 60);
    EXPECT_EQ(model->info().bounds.min, bounds.min);
    EXPECT_TRUE(model->info().healing.empty());
  }
  std::string iges(72, ' ');
  EXPECT_FALSE(CadModel::readBytes("\xef\xbb\xbf", "mark.step"));
}

TEST(Salvage, FaceOfADamagedEntityIsLeftOutAndTold) {
  const std::string whole = threeFaces();
  ASSERT_EQ(modelOf(whole).info().faces, 3);
  // The first surface loses its degree; then a point of the second face, and a reference of its borders.
  const auto damage = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  for (const std::string& text :
       {damage("B_SPLINE_SURFACE_WITH_KNOTS('',3", "B_SPLINE_SURFACE_WITH_KNOTS('','3'"),
        damage("CARTESIAN_POINT('',(0.,0.,0.))", "CARTESIAN_POINT('',$)"),
        damage("EDGE_LOOP('',(#", "EDGE_LOOP('',(#99"),
        damage("VERTEX_POINT('',#", "VERTEX_POINT('',#9999")}) {
    const auto model = CadModel::readBytes(text, "damaged.step");
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_EQ(model->info().faces, 2);
    EXPECT_EQ(model->info().faceList[0].name, "gutter");
    EXPECT_EQ(model->info().faceList[1].name, "tile");
    ASSERT_EQ(model->info().leftOut.size(), 1u);
    EXPECT_NE(model->info().leftOut[0].find("1 entity is damaged (#"), std::string::npos)
        << model->info().leftOut[0];
    EXPECT_NE(model->info().leftOut[0].find("1 of 3 faces is left out (#"), std::string::npos)
        << model->info().leftOut[0];
  }
}

TEST(Salvage, ShellWithAReferenceThatLeadsNowhereKeepsItsOtherFaces) {
  const std::string whole = threeFaces();
  std::string text = whole;
  const std::size_t at = text.find(",(#", text.find("OPEN_SHELL('gutter'"));
  text.insert(at + 3, "9999");
  const CadModel model = modelOf(text);
  EXPECT_EQ(model.info().faces, 2);
  ASSERT_EQ(model.info().leftOut.size(), 1u);
  EXPECT_NE(model.info().leftOut[0].find("1 of 3 faces is left out (#"), std::string::npos)
      << model.info().leftOut[0];
}

TEST(Salvage, DamagedUnitIsTold) {
  const std::string text =
      replaced(exampleStep("saddle").value(), "SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT(.MILLI.)");
  const CadModel model = modelOf(text);
  ASSERT_EQ(model.info().leftOut.size(), 1u);
  EXPECT_NE(model.info().leftOut[0].find("its unit #"), std::string::npos) << model.info().leftOut[0];
  EXPECT_NE(model.info().leftOut[0].find("read in " + model.info().unit), std::string::npos)
      << model.info().leftOut[0];
}

TEST(Salvage, DamagedDimensionTakesNoFace) {
  std::string text = exampleStep("saddle").value();
  const int faces = modelOf(text).info().faces;
  text.insert(text.find("#1="), "#99000=DIMENSIONAL_SIZE(#1,$);\n");
  const auto model = CadModel::readBytes(text, "dimension.step");
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->info().faces, faces);
}

TEST(Salvage, FileOfWhichNothingIsUsableIsUnreadable) {
  const std::string step = exampleStep("saddle").value();
  const auto model = CadModel::readBytes(
      replaced(step, "B_SPLINE_SURFACE_WITH_KNOTS('',", "B_SPLINE_SURFACE_WITH_KNOTS('',$,"), "none.step");
  expectError(model, ErrorCode::cannotRead, "none.step");
  EXPECT_NE(model.error().message.find("no face can be used"), std::string::npos) << model.error().message;
}

}  // namespace
}  // namespace bw::geometry::test
