// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Two independent routes: our sections against OCCT's BRepAlgoAPI_Section on the same shape.

#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Section.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <gp_Pln.hxx>

#include <filesystem>
#include <fstream>

#include "shapes.h"

namespace bw::geometry::test {
namespace {

struct OcctSection {
  double length = 0;
  std::vector<Eigen::Vector3d> points;
};

OcctSection occtSection(const TopoDS_Shape& shape, const Eigen::Vector3d& origin,
                        const Eigen::Vector3d& normal) {
  BRepAlgoAPI_Section section(
      shape, gp_Pln(gp_Pnt(origin.x(), origin.y(), origin.z()), gp_Dir(normal.x(), normal.y(), normal.z())),
      Standard_False);
  section.Approximation(Standard_True);
  section.Build();
  OcctSection result;
  for (TopExp_Explorer it(section.Shape(), TopAbs_EDGE); it.More(); it.Next()) {
    const BRepAdaptor_Curve curve(TopoDS::Edge(it.Current()));
    result.length += GCPnts_AbscissaPoint::Length(curve, 1e-6);
    for (int i = 0; i <= 40; ++i) {
      const gp_Pnt p =
          curve.Value(curve.FirstParameter() + (curve.LastParameter() - curve.FirstParameter()) * i / 40);
      result.points.emplace_back(p.X(), p.Y(), p.Z());
    }
  }
  return result;
}

TopoDS_Shape readBrep(const std::string& file) {
  TopoDS_Shape shape;
  BRep_Builder builder;
  BRepTools::Read(shape, file.c_str(), builder);
  return shape;
}

void compare(const std::string& file, int stations, double tolerance) {
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "occt-misc is not installed";
  const TopoDS_Shape shape = readBrep(file);
  auto model = CadModel::read(file);
  ASSERT_TRUE(model) << model.error().message;
  const auto target = Target::make(*model, {FaceChoice::Kind::all, {}});
  ASSERT_TRUE(target);
  CutSettings settings;
  settings.stations = stations;
  const Cut cut = cutOf(*target, settings);
  ASSERT_GT(cut.sections.size(), 0u);
  // Across holes and beyond steps of the border ours go on, where the other route has nothing.
  const auto bridged = [&](int station) {
    return std::ranges::any_of(cut.findings, [station](const Finding& f) {
      return (std::holds_alternative<SectionBridged>(f.cause) ||
              std::holds_alternative<SectionExtended>(f.cause)) &&
             f.where.stations->first <= station && station <= f.where.stations->last;
    });
  };
  for (const Section& s : cut.sections) {
    const OcctSection other = occtSection(shape, s.frame.origin, s.frame.normal);
    if (bridged(s.index))
      EXPECT_GT(s.curve().length(), other.length - 20 * tolerance) << "station " << s.index;
    else
      EXPECT_NEAR(s.curve().length(), other.length, 20 * tolerance) << "station " << s.index;
    for (const Eigen::Vector3d& p : other.points) {
      const Eigen::Vector3d q = s.frame.toLocal(p);
      const double t = s.curve().nearestParameter(q.head<2>());
      EXPECT_NEAR((s.curve().value(t) - q.head<2>()).norm(), 0, tolerance) << "station " << s.index;
    }
  }
}

TEST(OcctRoute, ShellOfManyFaces) { compare("/usr/share/opencascade/data/occ/shell1.brep", 7, 2e-3); }

TEST(OcctRoute, PlaneFaceWithRoundEnds) { compare("/usr/share/opencascade/data/occ/face.brep", 15, 1e-3); }

TEST(OcctRoute, PlaneFaceWithManyBorders) { compare("/usr/share/opencascade/data/occ/face2.brep", 15, 1e-3); }

}  // namespace
}  // namespace bw::geometry::test
