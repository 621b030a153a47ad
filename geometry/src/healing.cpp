// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "healing.h"

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepLib.hxx>
#include <BRepTools_ReShape.hxx>
#include <BRep_Tool.hxx>
#include <ShapeBuild_ReShape.hxx>
#include <ShapeFix_Shape.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>

#include "bw/core/text/number_text.h"
#include "open_edges.h"

namespace bw::geometry {

namespace {

constexpr int kCheckLimit =
    2000;  // faces up to which a file is checked for faults: the check costs about 1 ms a face

/// Edges that bound one face only.
int openEdgeCount(const TopoDS_Shape& shape) {
  TopTools_IndexedDataMapOfShapeListOfShape faces;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces);
  int count = 0;
  for (int i = 1; i <= faces.Extent(); ++i) count += faces(i).Extent() == 1;
  return count;
}

/// True if no two faces share an edge.
bool loose(const TopoDS_Shape& shape) {
  TopTools_IndexedDataMapOfShapeListOfShape faces;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) {
    for (const TopoDS_Shape& face : faces(i)) {
      if (!face.IsSame(faces(i).First())) return false;
    }
  }
  return true;
}

/// Takes over a changed shape. `changed(face)` gives what a face became. Where that is not told for each
/// face, order and names are those in which the new shape is met, or none.
template <class Changed>
void follow(ReadShape& read, const TopoDS_Shape& shape, const Changed& changed) {
  TopTools_IndexedMapOfShape present;
  TopExp::MapShapes(shape, TopAbs_FACE, present);
  std::vector<TopoDS_Shape> faces;
  std::vector<std::string> names;
  TopTools_IndexedMapOfShape taken;
  for (std::size_t i = 0; i < read.faces.size(); ++i) {
    TopoDS_Shape face = changed(read.faces[i]);
    if (face.IsNull()) continue;
    TopTools_IndexedMapOfShape parts;  // a face may have been split
    TopExp::MapShapes(face, TopAbs_FACE, parts);
    for (int k = 1; k <= parts.Extent(); ++k) {
      if (!present.Contains(parts(k)) || taken.Contains(parts(k))) continue;
      taken.Add(parts(k));
      faces.push_back(parts(k));
      names.push_back(read.names[i]);
    }
  }
  for (int i = 1; i <= present.Extent(); ++i) {
    if (taken.Contains(present(i))) continue;
    faces.push_back(present(i));
    names.emplace_back();
  }
  read.shape = shape;
  read.faces = std::move(faces);
  read.names = std::move(names);
}

void repair(ReadShape& read) {
  if (int(read.faces.size()) > kCheckLimit || BRepCheck_Analyzer(read.shape).IsValid()) return;
  ShapeFix_Shape fixer(read.shape);
  if (!fixer.Perform()) {
    read.healing.push_back("some faces or edges have faults that could not be repaired");
    return;
  }
  const Handle(ShapeBuild_ReShape) changes = fixer.Context();
  follow(read, fixer.Shape(), [&](const TopoDS_Shape& face) { return changes->Apply(face); });
  read.healing.push_back(BRepCheck_Analyzer(read.shape).IsValid()
                             ? "faces or edges with faults were repaired"
                             : "faces or edges with faults were repaired in part; some faults remain");
}

void sew(ReadShape& read, double tolerance) {
  if (!(tolerance > 0) || read.faces.size() < 2 || openEdgeCount(read.shape) < 2) return;
  Gaps gaps = measureGaps(read.shape, read.faces, tolerance);
  if (gaps.within > 0) {
    const bool apart = loose(read.shape);
    const int open = openEdgeCount(read.shape);
    BRepBuilderAPI_Sewing sewing(tolerance);
    sewing.Add(read.shape);
    sewing.Perform();
    const TopoDS_Shape sewn = sewing.SewedShape();
    if (!sewn.IsNull() && facesOf(sewn).size() == read.faces.size() && openEdgeCount(sewn) < open) {
      read.healing.push_back(
          (apart ? std::to_string(read.faces.size()) + " separate faces were sewn together where their edges"
                 : std::to_string(open - openEdgeCount(sewn)) + " open edges were sewn together where they") +
          " meet within " + shortText(tolerance) + " mm; the widest gap was " + shortText(gaps.widestWithin) +
          " mm");
      follow(read, sewn, [&](const TopoDS_Shape& face) {
        return sewing.IsModifiedSubShape(face) ? sewing.ModifiedSubShape(face) : face;
      });
    } else {
      read.healing.push_back(std::to_string(gaps.within) + " open edges meet within " +
                             shortText(gaps.widestWithin) + " mm, but could not be sewn together");
    }
  }
  if (gaps.narrowestOpen > 0) {
    const std::string wide = shortText(gaps.narrowestOpen);
    read.healing.push_back("a gap of " + wide + " mm between faces " + std::to_string(gaps.faces[0]) +
                           " and " + std::to_string(gaps.faces[1]) +
                           " stays open: it is wider than the sewing tolerance of " + shortText(tolerance) +
                           " mm");
  }
}

}  // namespace

void heal(ReadShape& read, double sewing) {
  repair(read);
  sew(read, sewing);
  BRepLib::BuildCurves3d(read.shape);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(read.shape, TopAbs_EDGE, edges);
  int bare = 0;
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    double first = 0, last = 0;
    if (!BRep_Tool::Degenerated(edge) && BRep_Tool::Curve(edge, first, last).IsNull()) ++bare;
  }
  if (bare > 0)
    read.healing.push_back(std::to_string(bare) + " edges have no curve in space and are passed over");
}

}  // namespace bw::geometry
