// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Curves of STEP and IGES files that OpenCASCADE wrote, and of our own.

#include <gtest/gtest.h>

#include <unistd.h>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Pln.hxx>

#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/files/file_set.h"
#include "bw/core/shape/drawn_sections.h"
#include "bw/geometry/cad_curves.h"
#include "bw/geometry/cad_model.h"
#include "bw/geometry/export.h"
#include "sheets.h"

namespace bw::geometry::test {
namespace {

std::string step(const TopoDS_Shape& shape, const char* unit = "MM") {
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.unit", unit);
  STEPControl_Writer writer;
  EXPECT_EQ(writer.Transfer(shape, STEPControl_AsIs), IFSelect_RetDone);
  // Tests run side by side.
  const std::string file = testing::TempDir() + "cad_curves_test_" + std::to_string(::getpid()) + ".step";
  EXPECT_EQ(writer.Write(file.c_str()), IFSelect_RetDone);
  Interface_Static::SetCVal("write.step.unit", "MM");
  const std::string text = readFile(file).value();
  std::filesystem::remove(file);
  return text;
}

std::string iges(const TopoDS_Shape& shape, const char* unit = "MM") {
  IGESControl_Controller::Init();
  IGESControl_Writer writer(unit, 1);
  EXPECT_TRUE(writer.AddShape(shape));
  writer.ComputeModel();
  std::ostringstream text;
  EXPECT_TRUE(writer.Write(text));
  return text.str();
}

TopoDS_Shape splineEdge(double y) {
  TColgp_Array1OfPnt poles(1, 5);
  TColStd_Array1OfReal weights(1, 5), knots(1, 3);
  TColStd_Array1OfInteger times(1, 3);
  const double heights[] = {200, 260, 240, 290, 210};
  for (int i = 1; i <= 5; ++i) {
    poles(i) = gp_Pnt(150.0 * (i - 1), y, heights[i - 1] + y / 10);
    weights(i) = i == 3 ? 0.7 : 1;
  }
  knots(1) = 0, knots(2) = 0.4, knots(3) = 1;
  times(1) = 4, times(2) = 1, times(3) = 4;
  return BRepBuilderAPI_MakeEdge(Handle(Geom_Curve)(new Geom_BSplineCurve(poles, weights, knots, times, 3)));
}

gp_Pnt onSpline(double y, double t) {
  const TopoDS_Shape edge = splineEdge(y);
  double first = 0, last = 0;
  return BRep_Tool::Curve(TopoDS::Edge(edge), first, last)->Value(t);
}

TopoDS_Shape lineAndArc(double y) {
  const gp_Pnt a(0, y, 200), b(300, y, 200), c(500, y, 280), d(600, y, 200);
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(a, b).Edge(),
                               BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(b, c, d).Value()).Edge());
  return wire.Wire();
}

TopoDS_Shape face() {
  return BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 0, 100, 0, 100).Shape();
}

double distance(const Eigen::Vector3d& p, const gp_Pnt& q) {
  return (p - Eigen::Vector3d(q.X(), q.Y(), q.Z())).norm();
}

void expectError(const std::string& bytes, ErrorCode code, const std::string& part) {
  const auto result = readCurves(bytes, "a.step");
  ASSERT_FALSE(result.has_value()) << "expected: " << part;
  EXPECT_EQ(result.error().code, code) << result.error().message;
  EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message;
}

TEST(CadCurves, SplinesLinesAndArcsOfStepAndIgesInAnyUnit) {
  const TopoDS_Shape all = together({splineEdge(0), splineEdge(400), lineAndArc(800)});
  const std::pair<std::string, std::string> files[] = {{step(all), "mm"},         {step(all, "INCH"), "inch"},
                                                       {step(all, "M"), "m"},     {iges(all), "mm"},
                                                       {iges(all, "IN"), "inch"}, {iges(all, "M"), "m"}};
  for (const auto& [text, unit] : files) {
    EXPECT_TRUE(namesNoFaces(text));
    const auto read = readCurves(text, "a");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->unit, unit);
    EXPECT_EQ(read->faces, 0);
    ASSERT_EQ(read->curves.size(), 4u) << read->format << " " << unit;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(read->curves[i].number, int(i) + 1);
      EXPECT_TRUE(checkSpaceCurve(read->curves[i]));
    }
    // IGES has chains before single curves.
    const auto order = read->curves[0].degree == 3 ? std::array{0, 1, 2, 3} : std::array{2, 3, 0, 1};
    const auto curve = [&](int i) -> const SpaceCurve& {
      return read->curves[std::size_t(order[std::size_t(i)])];
    };
    for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0})
      EXPECT_LT(distance(curve(1).value(t), onSpline(400, t)), 1e-6) << read->format << " " << unit;
    const SpaceCurve &line = curve(2), &arc = curve(3);
    EXPECT_NEAR((line.value(line.end()) - line.value(line.start())).norm(), 300, 1e-6);
    double highest = 0;
    for (const Eigen::Vector3d& p : arc.samples(500)) highest = std::max(highest, p.z());
    EXPECT_GT(highest, 280);
    EXPECT_LT(highest, 290);
  }
}

TEST(CadCurves, LoftsThatAreWrittenComeBackWithinTheTolerance) {
  SectionsSurface loft;
  std::vector<TopoDS_Shape> edges;
  for (int row = 0; row < 5; ++row) {
    SectionCurve own{200.0 * row, SectionCurve::Kind::spline, {}};
    for (int i = 0; i < 6; ++i)
      own.points.emplace_back(120.0 * i, 240 + 12 * row + 40 * std::sin(0.9 * i + 0.4 * row));
    const PlanarCurve curve = cubicSplineThrough(own.points).value();
    const int poles = int(curve.poles().size());
    TColgp_Array1OfPnt points(1, poles);
    for (int i = 0; i < poles; ++i) {
      const Eigen::Vector2d p = curve.poles()[std::size_t(i)];
      points(i + 1) = gp_Pnt(p.x(), own.y, p.y());
    }
    TColStd_Array1OfReal knots(1, poles - 2);
    TColStd_Array1OfInteger times(1, poles - 2);
    for (int i = 0; i < poles - 2; ++i) {
      knots(i + 1) = curve.knots()[std::size_t(i) + 3];
      times(i + 1) = i == 0 || i == poles - 3 ? 4 : 1;
    }
    edges.push_back(
        BRepBuilderAPI_MakeEdge(Handle(Geom_Curve)(new Geom_BSplineCurve(points, knots, times, 3))));
    loft.sections.push_back(std::move(own));
  }
  DesignedSurface designed;
  designed.shape = loft;
  const CadModel model = CadModel::of(splineOf(designed).value(), "loft").value();
  const Target target = Target::make(model, {}).value();
  const auto sampler = target.sampler();
  const TopoDS_Compound all = together(edges);
  for (const std::string& text : {step(all), step(all, "INCH"), iges(all), iges(all, "M")})
    for (const SectionCurve::Kind kind : {SectionCurve::Kind::spline, SectionCurve::Kind::bezier}) {
      const auto read = readCurves(text, "a");
      ASSERT_TRUE(read) << read.error().message;
      const auto drawn = sectionsThrough(read->curves, {kind, 0.1, 0});
      ASSERT_TRUE(drawn) << drawn.error().message;
      EXPECT_LE(drawn->deviation, 0.1);
      const SplineSurface surface = splineOf(drawn->surface).value();
      double farthest = 0;
      for (int i = 0; i <= 30; ++i)
        for (int k = 0; k <= 30; ++k) {
          const Eigen::Vector3d p = surface.value(i / 30.0, k / 30.0);
          farthest = std::max(farthest, (sampler->closest(p, nullptr)->point - p).norm());
        }
      // Between the sections too, where the loft goes on as its sections do.
      EXPECT_LE(farthest, 0.15);
    }
}

TEST(CadCurves, TheUnitIsTakenAsAskedFor) {
  const std::string text = step(together({splineEdge(0)}), "INCH");
  ReadOptions options;
  options.unit = LengthUnit::mm;
  const auto read = readCurves(text, "a", {}, options);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_NEAR(read->curves[0].value(1).x(), 600 / 25.4, 1e-6);
}

TEST(CadCurves, EdgesOfFacesAreNoCurves) {
  for (const std::string& text :
       {step(together({face(), splineEdge(0)})), iges(together({face(), splineEdge(0)}))}) {
    EXPECT_FALSE(namesNoFaces(text));
    const auto read = readCurves(text, "a");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->faces, 1);
    EXPECT_EQ(read->curves.size(), 1u);
  }
  expectError(step(face()), ErrorCode::badInput, "no curves beside its 1 face");
}

TEST(CadCurves, OurOwnFilesComeBackWithTheirNames) {
  NamedCurve wave{"strip-0 start", {}}, other{"strip-0 end", {}};
  for (int i = 0; i <= 60; ++i) {
    wave.points.emplace_back(10.0 * i, 0, 100 + 30 * std::sin(i / 9.0));
    other.points.emplace_back(10.0 * i, 800, 120 + 30 * std::sin(i / 9.0));
  }
  const NamedCurve curves[] = {wave, other};
  const std::string text = curvesStepText(curves, "all").value();
  EXPECT_TRUE(namesNoFaces(text));
  const auto read = readCurves(text, "curves.step");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->curves.size(), 2u);
  EXPECT_EQ(read->curves[0].name, "strip-0 start");
  EXPECT_EQ(read->curves[1].name, "strip-0 end");
  EXPECT_LT((read->curves[1].value(read->curves[1].end()) - other.points.back()).norm(), 1e-6);
}

TEST(CadCurves, DamagedFilesAreToldAndBreakNothing) {
  const std::string whole = step(together({splineEdge(0), splineEdge(400)})), other = iges(splineEdge(0));
  expectError(whole.substr(0, whole.size() / 2), ErrorCode::cannotRead, "cut short");
  expectError(other.substr(0, other.size() / 2), ErrorCode::cannotRead, "");
  expectError("", ErrorCode::cannotRead, "is empty");
  expectError("nothing", ErrorCode::cannotRead, "its content is not STEP");
  // Numbers of the poles that are none.
  std::string broken = whole;
  const std::size_t at = broken.find("CARTESIAN_POINT('',(0.,400.");
  ASSERT_NE(at, std::string::npos);
  broken.replace(at, 27, "CARTESIAN_POINT('',(nan,NaN");
  const auto read = readCurves(broken, "a.step");
  if (read) {
    for (const SpaceCurve& curve : read->curves)
      for (const Eigen::Vector3d& pole : curve.poles) EXPECT_TRUE(pole.allFinite());
  } else {
    EXPECT_FALSE(read.error().message.empty());
  }
}

TEST(CadCurves, ManyCurvesComeInTheOrderOfTheFile) {
  std::vector<NamedCurve> many;
  for (int i = 0; i < 1000; ++i) many.push_back({"", {{0, double(i), 0}, {10, double(i), 0}}});
  const auto read = readCurves(curvesStepText(many, "many").value(), "many.step");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->curves.size(), many.size());
  for (int i = 0; i < 1000; ++i) EXPECT_NEAR(read->curves[std::size_t(i)].value(0).y(), i, 1e-9);
}

}  // namespace
}  // namespace bw::geometry::test
