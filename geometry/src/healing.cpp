// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <BRepAdaptor_Curve.hxx>
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

#include <algorithm>
#include <cmath>

#include "bw/core/text/number_text.h"
#include "cad_reader.h"
#include "face_borders.h"
#include "occt.h"
#include "point_tree.h"

namespace bw::geometry {

namespace {

/// How the open edges of a shape (those with one face) run along one another.
struct Gaps {
  int within = 0;            ///< open edges that run along another face's within the limit
  double widestWithin = 0;   ///< mm, the widest of their gaps
  double narrowestOpen = 0;  ///< mm, the narrowest gap beyond the limit but below ten times it; 0 = none
  int faces[2] = {-1, -1};   ///< of that gap, as indices into the faces given
};

constexpr int kProbes = 9;        // points of an edge at which its gap is measured
constexpr int kLeastSamples = 8;  // of an edge
constexpr int kMostSamples = 200;
constexpr double kLookAround = 10;  // times the limit: gaps up to this are told,
constexpr double kFarthest = 10;    // but none wider than this, mm, unless the limit is
constexpr double kAcross = 0.4;     // of an edge's length: what is wider is no gap along it
constexpr int kSteps = 12;          // of Newton's method, which is quick where the gap is small
constexpr double kAtRest = 1e-10;   // of the interval: a shorter step changes nothing
constexpr double kBow = 0.1;        // of a piece between samples: how far it may leave its chord

struct OpenEdge {
  BRepAdaptor_Curve curve;
  int face = -1;
  double first = 0, step = 0, length = 0;
  int samples = 0;

  Eigen::Vector3d at(double t) const { return toEigen(curve.Value(t)); }
  double parameter(int i) const { return first + step * i; }
};

/// The distance from a point to the curve about its sample number i.
double distanceNear(const OpenEdge& edge, int i, const Eigen::Vector3d& p) {
  const double a = edge.parameter(std::max(i - 1, 0)), b = edge.parameter(std::min(i + 1, edge.samples - 1));
  double t = edge.parameter(i), best = 1e300;
  gp_Pnt point;
  gp_Vec tangent;
  for (int k = 0; k < kSteps; ++k) {
    edge.curve.D1(t, point, tangent);
    const Eigen::Vector3d away = toEigen(point) - p, along = toEigen(tangent);
    best = std::min(best, away.norm());
    const double speed2 = along.squaredNorm();
    if (!(speed2 > 0)) break;
    const double next = std::clamp(t - away.dot(along) / speed2, a, b);
    if (std::abs(next - t) <= kAtRest * (b - a)) break;
    t = next;
  }
  return best;
}

double distanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a + nearestOnSegment(p, a, b) * (b - a) - p).norm();
}

std::vector<OpenEdge> openEdges(const TopoDS_Shape& shape, const std::vector<TopoDS_Shape>& faces) {
  TopTools_IndexedDataMapOfShapeListOfShape facesOfEdge;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, facesOfEdge);
  TopTools_IndexedMapOfShape index;
  for (const TopoDS_Shape& face : faces) index.Add(face);
  std::vector<OpenEdge> result;
  for (int i = 1; i <= facesOfEdge.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(facesOfEdge.FindKey(i));
    if (facesOfEdge(i).Extent() != 1 || BRep_Tool::Degenerated(edge)) continue;
    double first = 0, last = 0;
    if (BRep_Tool::Curve(edge, first, last).IsNull() || !(std::isfinite(last - first) && last > first))
      continue;
    OpenEdge open;
    open.curve.Initialize(edge);
    open.face = index.FindIndex(facesOfEdge(i).First()) - 1;
    open.first = first;
    open.samples = kLeastSamples + 1;
    open.step = (last - first) / kLeastSamples;
    for (int k = 0; k < kLeastSamples; ++k)
      open.length += (open.at(open.parameter(k + 1)) - open.at(open.parameter(k))).norm();
    result.push_back(std::move(open));
  }
  return result;
}

/// Measures the gaps between open edges of different faces. The gap of an edge is the largest distance from
/// it to the nearest other open edges.
Gaps measureGaps(const TopoDS_Shape& shape, const std::vector<TopoDS_Shape>& faces, double limit) {
  Gaps gaps;
  std::vector<OpenEdge> edges = openEdges(shape, faces);
  if (edges.size() < 2) return gaps;
  const double around = std::max(limit, std::min(kLookAround * limit, kFarthest));
  // Samples about evenly spaced over all edges, so that one long edge does not widen every search.
  std::vector<double> lengths;
  for (const OpenEdge& edge : edges) lengths.push_back(edge.length);
  std::nth_element(lengths.begin(), lengths.begin() + long(lengths.size() / 2), lengths.end());
  const double spacing = lengths[lengths.size() / 2] / kLeastSamples;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::pair<int, int>> owner;  // edge and number of its sample
  double reach = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    OpenEdge& edge = edges[e];
    const double span = edge.step * (edge.samples - 1);
    const double wanted = spacing > 0 ? edge.length / spacing : kLeastSamples;
    edge.samples = 1 + int(std::clamp(wanted, double(kLeastSamples), double(kMostSamples)));
    edge.step = span / (edge.samples - 1);
    for (int i = 0; i < edge.samples; ++i) {
      points.push_back(edge.at(edge.parameter(i)));
      owner.emplace_back(int(e), i);
      if (i > 0) reach = std::max(reach, (points.back() - points[points.size() - 2]).norm());
    }
  }
  const PointTree tree(points);
  std::vector<int> found;
  std::vector<double> chords;
  const auto chordsAt = [&](const Eigen::Vector3d& p, int sample) {
    const auto [e, i] = owner[sample];
    double d = 1e300;
    if (i > 0) d = distanceToSegment(p, points[sample - 1], points[sample]);
    if (i + 1 < edges[e].samples) d = std::min(d, distanceToSegment(p, points[sample], points[sample + 1]));
    return d;
  };
  // Whether an edge of this face lies at a sample of another one.
  const auto reaches = [&](int face, int sample) {
    std::vector<int> near;
    tree.within(points[sample], reach + limit, near);
    return std::ranges::any_of(near, [&](int own) {
      return edges[owner[own].first].face == face && chordsAt(points[sample], own) <= limit;
    });
  };
  for (const OpenEdge& edge : edges) {
    double widest = 0;
    int other = -1, across = -1;
    for (int k = 0; k < kProbes && widest <= around; ++k) {
      const Eigen::Vector3d p = edge.at(edge.first + edge.step * (edge.samples - 1) * k / (kProbes - 1));
      found.clear();
      tree.within(p, reach + around, found);
      // By the chords first: few pieces are near enough to be looked at as curves.
      chords.clear();
      double least = 1e300;
      for (const int sample : found) {
        const double d = edges[owner[sample].first].face != edge.face ? chordsAt(p, sample) : 1e300;
        chords.push_back(d);
        least = std::min(least, d);
      }
      double nearest = 1e300;
      int nearestFace = -1, nearestSample = -1;
      for (std::size_t c = 0; c < found.size(); ++c) {
        if (chords[c] > least + kBow * reach || chords[c] == 1e300) continue;
        const auto [e, i] = owner[found[c]];
        const double d = distanceNear(edges[e], i, p);
        if (d < nearest) nearest = d, nearestFace = edges[e].face, nearestSample = found[c];
      }
      if (nearest > widest || k == 0) widest = nearest, other = nearestFace, across = nearestSample;
    }
    // The end of a narrow face, which others meet at both of its corners, is no gap.
    if (widest > kAcross * edge.length) continue;
    if (widest <= limit) {
      ++gaps.within;
      gaps.widestWithin = std::max(gaps.widestWithin, widest);
    } else if (widest <= around && (gaps.narrowestOpen == 0 || widest < gaps.narrowestOpen) &&
               !reaches(edge.face, across)) {  // else it is a narrow face itself that lies between
      gaps.narrowestOpen = widest;
      gaps.faces[0] = std::min(edge.face, other);
      gaps.faces[1] = std::max(edge.face, other);
    }
  }
  return gaps;
}

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
