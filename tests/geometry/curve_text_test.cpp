// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Curves in STEP, read by OpenCASCADE.

#include <gtest/gtest.h>

#include <BRep_Tool.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <Geom_Curve.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <STEPControl_Reader.hxx>
#include <TCollection_AsciiString.hxx>
#include <TDF_Label.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

#include <cmath>
#include <map>
#include <sstream>

#include "bw/geometry/cad_curves.h"
#include "bw/geometry/export.h"

namespace bw::geometry::test {
namespace {

std::vector<TopoDS_Edge> edgesOf(const std::string& step) {
  STEPControl_Reader reader;
  std::istringstream stream(step);
  EXPECT_EQ(reader.ReadStream("curves", stream), IFSelect_RetDone);
  reader.TransferRoots();
  std::vector<TopoDS_Edge> edges;
  for (TopExp_Explorer at(reader.OneShape(), TopAbs_EDGE); at.More(); at.Next())
    edges.push_back(TopoDS::Edge(at.Current()));
  return edges;
}

TEST(CurveText, IsReadAsSplinesThroughThePoints) {
  NamedCurve wave{"wave", {}}, corner{"corner \u00e4", {}}, line{"line", {{0, 0, 0}, {1, 2, 3}}};
  for (int i = 0; i <= 60; ++i) wave.points.emplace_back(10.0 * i, 30 * std::sin(i / 9.0), 100 + 0.2 * i);
  for (int i = 0; i <= 20; ++i) corner.points.emplace_back(5.0 * i, 0, 50 - std::abs(5.0 * i - 50));
  const NamedCurve nowhere{"nowhere", {{1, 1, 1}, {1, 1, 1}}};
  const NamedCurve curves[] = {wave, corner, line, nowhere};
  const std::string text = curvesStepText(curves, "all").value();
  EXPECT_EQ(text, curvesStepText(curves, "all").value());
  const std::vector<TopoDS_Edge> edges = edgesOf(text);
  ASSERT_EQ(edges.size(), 4u) << "the corner parts its curve; two points in one place are no curve";
  double first = 0, last = 0;
  const auto onEdge = [&](const Eigen::Vector3d& p, const TopoDS_Edge& edge) {
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
    const GeomAPI_ProjectPointOnCurve foot(gp_Pnt(p.x(), p.y(), p.z()), curve, first, last);
    const auto to = [&](double t) { return curve->Value(t).Distance(gp_Pnt(p.x(), p.y(), p.z())); };
    return std::min({foot.NbPoints() > 0 ? foot.LowerDistance() : 1e9, to(first), to(last)});
  };
  for (const Eigen::Vector3d& p : wave.points) EXPECT_LT(onEdge(p, edges[0]), 1e-6);
  // Between the points it is the smooth curve, not its chords.
  EXPECT_LT(onEdge({305, 30 * std::sin(30.5 / 9.0), 106.1}, edges[0]), 2e-3);
  for (const Eigen::Vector3d& p : corner.points)
    EXPECT_LT(std::min(onEdge(p, edges[1]), onEdge(p, edges[2])), 1e-6);
}

std::string nameOf(const TDF_Label& label) {
  Handle(TDataStd_Name) name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name)) return {};
  return TCollection_AsciiString(name->Get()).ToCString();
}

std::size_t edgesIn(const TDF_Label& label) {
  std::size_t count = 0;
  for (TopExp_Explorer at(XCAFDoc_ShapeTool::GetShape(label), TopAbs_EDGE); at.More(); at.Next()) ++count;
  return count;
}

/// What an assembly consists of: names as a tree shows them, with the number of edges, and what is below.
std::string treeOf(const TDF_Label& label) {
  std::string text = nameOf(label);
  TDF_LabelSequence parts;
  if (!XCAFDoc_ShapeTool::GetComponents(label, parts)) return text + " " + std::to_string(edgesIn(label));
  text += " (";
  for (int i = 1; i <= parts.Length(); ++i) {
    TDF_Label part;
    EXPECT_TRUE(XCAFDoc_ShapeTool::GetReferredShape(parts(i), part));
    EXPECT_EQ(nameOf(parts(i)), nameOf(part)) << "the use is called as the part";
    text += (i > 1 ? ", " : "") + treeOf(part);
  }
  return text + ")";
}

TEST(CurveText, HasAPartOfEachNameInATreeOfItsLayers) {
  std::vector<Eigen::Vector3d> bent;
  for (int i = 0; i <= 20; ++i) bent.emplace_back(5.0 * i, 0, 50 - std::abs(5.0 * i - 50));
  const NamedCurve curves[] = {{"seam one | two", {{0, 0, 0}, {10, 1, 1}, {20, 0, 0}}, "seam"},
                               {"outline one start", bent, "outline"},
                               {"seam two | three", {{0, 9, 0}, {10, 9, 1}}, "seam"},
                               {"nothing", {{1, 1, 1}}, "crease"},
                               {"alone", {{0, 20, 0}, {10, 20, 1}}}};
  const std::string text = curvesStepText(curves, "curves").value();
  // As CAD programs do, with the names of products and layers.
  STEPCAFControl_Reader reader;
  reader.SetNameMode(true);
  reader.SetLayerMode(true);
  std::istringstream stream(text);
  ASSERT_EQ(reader.ChangeReader().ReadStream("curves", stream), IFSelect_RetDone);
  const Handle(TDocStd_Document) document = new TDocStd_Document("BinXCAF");
  Handle(TDocStd_Document) filled = document;
  ASSERT_TRUE(reader.Transfer(filled));
  TDF_LabelSequence roots;
  XCAFDoc_DocumentTool::ShapeTool(document->Main())->GetFreeShapes(roots);
  ASSERT_EQ(roots.Length(), 1);
  EXPECT_EQ(treeOf(roots(1)),
            "curves (seam (seam one | two 1, seam two | three 1), outline (outline one start 2), alone 1)");
  std::map<std::string, std::size_t> onLayer;
  const Handle(XCAFDoc_LayerTool) layers = XCAFDoc_DocumentTool::LayerTool(document->Main());
  TDF_LabelSequence known;
  layers->GetLayerLabels(known);
  for (int i = 1; i <= known.Length(); ++i) {
    TCollection_ExtendedString layer;
    ASSERT_TRUE(layers->GetLayer(known(i), layer));
    TDF_LabelSequence shapes;
    layers->GetShapesOfLayer(known(i), shapes);
    for (int k = 1; k <= shapes.Length(); ++k)
      onLayer[TCollection_AsciiString(layer).ToCString()] += edgesIn(shapes(k));
  }
  EXPECT_EQ(onLayer, (std::map<std::string, std::size_t>{{"seam", 2}, {"outline", 2}}));
  // Our own reader has the curves in their order, with their names.
  const Result<CadCurves> read = readCurves(text, "curves.step");
  ASSERT_TRUE(read) << read.error().message;
  std::vector<std::string> names;
  for (const SpaceCurve& curve : read->curves) names.push_back(curve.name);
  EXPECT_EQ(names, (std::vector<std::string>{"seam one | two", "seam two | three", "outline one start",
                                             "outline one start", "alone"}));
  EXPECT_TRUE(read->leftOut.empty());
  EXPECT_TRUE(namesNoFaces(text));
}

TEST(CurveText, NamesAreReadAsTheyWereGiven) {
  const std::vector<Eigen::Vector3d> line = {{0, 0, 0}, {10, 1, 1}, {20, 0, 0}};
  const NamedCurve curves[] = {
      {"Æ𝄞𝄢 ø", line}, {"a\tb", line}, {"a\\tb", line}, {"a b", line}, {"a  b", line}};
  const Result<CadCurves> read = readCurves(curvesStepText(curves, "curves").value(), "curves.step");
  ASSERT_TRUE(read) << read.error().message;
  std::vector<std::string> names;
  for (const SpaceCurve& curve : read->curves) names.push_back(curve.name);
  EXPECT_EQ(names, (std::vector<std::string>{"Æ𝄞𝄢 ø", "a\\tb", "a\\tb (2)", "a b", "a  b (2)"}));
}

}  // namespace
}  // namespace bw::geometry::test
