// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// The two ways to the curves of a plane over one face: marching squares over its grid, and OpenCASCADE's
// intersection of two surfaces.

#include <Geom2d_BSplineCurve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <GeomInt_IntSS.hxx>
#include <Geom_Plane.hxx>
#include <Precision.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "bracketed_root.h"
#include "level_curves.h"
#include "occt.h"

namespace bw::geometry {

namespace {

constexpr int kConicIntervals = 48;     // of a curve that OpenCASCADE tells by a formula
constexpr int kSlideSteps = 8;          // of Newton's method along one parameter
constexpr double kPlaneMargin = 2;      // times the face's size: so far the plane reaches about it
constexpr double kBetweenNodes = 0.25;  // of a face's range of heights: so far it may leave its grid's
constexpr double kWalkError = 1e-3;     // mm that a place of the kernel may be off

/// Where a curve lies on the face, from its start to its end: the places that the kernel walked over, or even
/// ones on a conic.
std::vector<Eigen::Vector2d> placesOf(const GeomInt_IntSS& kernel, int line) {
  std::vector<Eigen::Vector2d> places;
  if (!kernel.HasLineOnS1(line) || kernel.LineOnS1(line).IsNull()) return places;
  const Handle(Geom2d_Curve)& curve = kernel.LineOnS1(line);
  const auto add = [&](const gp_Pnt2d& p) { places.emplace_back(p.X(), p.Y()); };
  const auto walked = Handle(Geom2d_BSplineCurve)::DownCast(curve);
  if (!walked.IsNull() && walked->Degree() == 1) {
    for (int k = 1; k <= walked->NbPoles(); ++k) add(walked->Pole(k));
    return places;
  }
  // Only the curve in space is bounded.
  const double first = kernel.Line(line)->FirstParameter(), last = kernel.Line(line)->LastParameter();
  if (Precision::IsInfinite(first) || Precision::IsInfinite(last)) return places;
  for (int k = 0; k <= kConicIntervals; ++k) add(curve->Value(first + (last - first) * k / kConicIntervals));
  return places;
}

}  // namespace

LevelNode PlaneCutter::crossing(int face, double level, double ua, double va, double ub, double vb) const {
  const SurfacePatch& patch = geometryOf(face).patch();
  Jet jet;
  const auto f = [&](double s, double& slope) {
    patch.first(ua + s * (ub - ua), va + s * (vb - va), jet);
    slope = normal_.dot(jet.du) * (ub - ua) + normal_.dot(jet.dv) * (vb - va);
    return normal_.dot(jet.p) - level;
  };
  double unused = 0;
  const double fa = f(0, unused), fb = f(1, unused);
  double s = 0;
  if ((fa < 0) != (fb < 0)) {
    s = bracketedRoot(f, 0, fa, 1, fb, 0.1 * kConverged);
  } else {
    s = std::abs(fa) < std::abs(fb) ? 0 : 1;  // a node counted as above though it lies a hair below
  }
  LevelNode node;
  node.uv = {ua + s * (ub - ua), va + s * (vb - va)};
  node.p = patch.value(node.uv.x(), node.uv.y());
  return node;
}

void PlaneCutter::march(int face, double level, std::vector<LevelPiece>& chains) const {
  const FaceGeometry& geometry = geometryOf(face);
  const FaceLevels& levels = faces_[face];
  if (level < levels.low - kOnPlane || level > levels.high + kOnPlane) return;
  const int nu = int(geometry.gridU().size()), nv = int(geometry.gridV().size());
  const auto above = [&](int i, int j) { return levels.g[std::size_t(i) * nv + j] - level > -kOnPlane; };

  // Grid edges: 2·node for the one along u from the node, 2·node + 1 along v.
  struct Link {
    int gridEdge;
    int next[2] = {-1, -1};
    int count = 0;
  };
  std::vector<Link> links;
  std::unordered_map<int, int> linkOf;
  const auto linkAt = [&](int i, int j, bool alongU) {
    const int id = 2 * (i * nv + j) + (alongU ? 0 : 1);
    const auto [it, fresh] = linkOf.try_emplace(id, int(links.size()));
    if (fresh) links.push_back({id});
    return it->second;
  };
  const auto join = [&](int a, int b) {
    links[a].next[links[a].count++] = b;
    links[b].next[links[b].count++] = a;
  };
  for (int i = 0; i + 1 < nu; ++i) {
    if (level < levels.rowLow[i] - kOnPlane || level > levels.rowHigh[i] + kOnPlane) continue;
    for (int j = 0; j + 1 < nv; ++j) {
      if (!levels.active[std::size_t(i) * (nv - 1) + j]) continue;
      const bool a = above(i, j), b = above(i + 1, j), c = above(i + 1, j + 1), d = above(i, j + 1);
      if (a == b && b == c && c == d) continue;
      std::array<int, 4> hit;
      int hits = 0;
      const bool south = a != b, east = b != c, north = c != d, west = d != a;
      const int s = south ? linkAt(i, j, true) : -1, e = east ? linkAt(i + 1, j, false) : -1;
      const int n = north ? linkAt(i, j + 1, true) : -1, w = west ? linkAt(i, j, false) : -1;
      for (const int k : {s, e, n, w}) {
        if (k >= 0) hit[hits++] = k;
      }
      if (hits == 2) {
        join(hit[0], hit[1]);
      } else if (hits == 4) {
        const double u = 0.5 * (geometry.gridU()[i] + geometry.gridU()[i + 1]);
        const double v = 0.5 * (geometry.gridV()[j] + geometry.gridV()[j + 1]);
        const bool middle = normal_.dot(geometry.patch().value(u, v)) > level;
        if (middle == a) {  // the corners a and c are connected: the curves cut off b and d
          join(s, e);
          join(n, w);
        } else {
          join(s, w);
          join(e, n);
        }
      }
    }
  }

  const auto nodeOf = [&](const Link& link) {
    const int node = link.gridEdge / 2, i = node / nv, j = node % nv;
    const bool alongU = link.gridEdge % 2 == 0;
    LevelNode result = crossing(face, level, geometry.gridU()[i], geometry.gridV()[j],
                                geometry.gridU()[alongU ? i + 1 : i], geometry.gridV()[alongU ? j : j + 1]);
    const auto on = [](const std::vector<double>& creases, double t) {
      return std::binary_search(creases.begin(), creases.end(), t);
    };
    result.crease = alongU ? on(geometry.patch().creasesV(), geometry.gridV()[j])
                           : on(geometry.patch().creasesU(), geometry.gridU()[i]);
    return result;
  };
  std::vector<char> used(links.size(), 0);
  const auto walk = [&](int from, bool closed) {
    LevelPiece piece;
    piece.face = face;
    piece.closed = closed;
    int previous = -1, at = from;
    while (at >= 0 && !used[at]) {
      used[at] = 1;
      const LevelNode node = nodeOf(links[at]);
      if (piece.nodes.empty() || (node.p - piece.nodes.back().p).norm() > kSameNode) {
        piece.nodes.push_back(node);
      } else {
        piece.nodes.back().crease = piece.nodes.back().crease || node.crease;
      }
      int next = -1;
      for (int k = 0; k < links[at].count; ++k) {
        const int other = links[at].next[k];
        if (other != previous && !used[other]) next = other;
      }
      previous = at;
      at = next;
    }
    if (closed && piece.nodes.size() > 1 &&
        (piece.nodes.front().p - piece.nodes.back().p).norm() <= kSameNode) {
      piece.nodes.pop_back();
    }
    if (piece.nodes.size() >= (closed ? 3u : 2u)) chains.push_back(std::move(piece));
  };
  for (int k = 0; k < int(links.size()); ++k) {
    if (!used[k] && links[k].count == 1) walk(k, false);
  }
  for (int k = 0; k < int(links.size()); ++k) {
    if (!used[k]) walk(k, true);
  }
}

void PlaneCutter::slide(int face, double level, int along, LevelNode& node) const {
  const SurfacePatch& patch = geometryOf(face).patch();
  Jet jet;
  for (int k = 0; k < kSlideSteps; ++k) {
    patch.first(node.uv.x(), node.uv.y(), jet);
    const double f = normal_.dot(jet.p) - level, slope = normal_.dot(along == 0 ? jet.du : jet.dv);
    if (std::abs(f) < kConverged || slope == 0) break;
    node.uv[along] -= f / slope;
  }
  node.p = patch.value(node.uv.x(), node.uv.y());
}

void PlaneCutter::intersect(int face, double level, std::vector<LevelPiece>& chains) const {
  const FaceGeometry& geometry = geometryOf(face);
  const FaceLevels& levels = faces_[face];
  const double slack = kBetweenNodes * (levels.high - levels.low) + kOnPlane;
  if (level < levels.low - slack || level > levels.high + slack) return;
  const Eigen::Vector3d origin = geometry.gridPoint(0, 0) + (level - levels.g.front()) * normal_;
  double size = 0;
  for (int i = 0; i < int(geometry.gridU().size()); ++i)
    for (int j = 0; j < int(geometry.gridV().size()); ++j)
      size = std::max(size, (geometry.gridPoint(i, j) - origin).norm());
  const double reach = kPlaneMargin * size;
  const Handle(Geom_Plane) plane =
      new Geom_Plane(gp_Pln(toPoint(origin), gp_Dir(normal_.x(), normal_.y(), normal_.z())));
  GeomInt_IntSS kernel;
  kernel.Perform(new GeomAdaptor_Surface(geometry.patch().surface(), geometry.u0(), geometry.u1(),
                                         geometry.v0(), geometry.v1()),
                 new GeomAdaptor_Surface(plane, -reach, reach, -reach, reach), Precision::Confusion(),
                 Standard_False, Standard_True, Standard_False);
  if (!kernel.IsDone()) throw Standard_Failure("a face and a plane are not intersected");
  for (int line = 1; line <= kernel.NbLines(); ++line)
    if (auto places = placesOf(kernel, line); places.size() > 1)
      follow(face, level, std::move(places), chains);
}

void PlaneCutter::follow(int face, double level, std::vector<Eigen::Vector2d> places,
                         std::vector<LevelPiece>& chains) const {
  const FaceGeometry& geometry = geometryOf(face);
  const SurfacePatch& patch = geometry.patch();
  const Eigen::Vector2d low(geometry.u0(), geometry.v0()), high(geometry.u1(), geometry.v1());
  const bool wraps[2] = {geometry.wrapsU(), geometry.wrapsV()};
  const double periods[2] = {wraps[0] ? high.x() - low.x() : patch.periodU(),
                             wraps[1] ? high.y() - low.y() : patch.periodV()};
  const std::vector<double>* const creases[2] = {&patch.creasesU(), &patch.creasesV()};

  // One continuous way through the parameters, which may lead over seams.
  places.front() = geometry.wrapped(places.front());
  for (std::size_t k = 1; k < places.size(); ++k)
    for (const int axis : {0, 1})
      if (const double period = periods[axis]; period > 0)
        places[k][axis] += period * std::round((places[k - 1][axis] - places[k][axis]) / period);
  const auto turns = [&](double t, int axis) {
    return wraps[axis] ? std::floor((t - low[axis]) / periods[axis]) : 0.0;
  };
  const auto inRange = [&](Eigen::Vector2d uv) {
    for (const int axis : {0, 1}) uv[axis] -= turns(uv[axis], axis) * periods[axis];
    return uv;
  };

  LevelPiece piece{face, {}, false};
  const auto add = [&](const LevelNode& node) {
    if (!piece.nodes.empty() && (node.p - piece.nodes.back().p).norm() <= kSameNode)
      piece.nodes.back().crease = piece.nodes.back().crease || node.crease;
    else
      piece.nodes.push_back(node);
  };
  const auto finish = [&]() {
    if (piece.nodes.size() >= 2) chains.push_back(std::move(piece));
    piece = {face, {}, false};
  };
  const auto addPlace = [&](const Eigen::Vector2d& uv) {
    LevelNode node;
    node.uv = inRange(uv);
    const LevelNode walked{node.uv, patch.value(node.uv.x(), node.uv.y())};
    // Where the plane touches the face, Newton's method may lead away: the kernel's own place is as good.
    add(project(face, level, node) && (node.p - walked.p).norm() < kWalkError ? node : walked);
  };
  struct Line {
    double at;  // 0…1 between two places
    int axis;
    double value;  // of that parameter
    bool seam;
  };
  addPlace(places.front());
  for (std::size_t k = 1; k < places.size(); ++k) {
    const Eigen::Vector2d &a = places[k - 1], &b = places[k];
    std::vector<Line> lines;
    for (const int axis : {0, 1}) {
      const auto cross = [&](double value, bool seam) {
        lines.push_back({(value - a[axis]) / (b[axis] - a[axis]), axis, value, seam});
      };
      for (const double crease : *creases[axis])
        if ((a[axis] < crease) != (b[axis] < crease)) cross(crease, false);
      const double before = turns(a[axis], axis), after = turns(b[axis], axis);
      if (before != after) cross(low[axis] + std::max(before, after) * periods[axis], true);
    }
    std::ranges::sort(lines, {}, &Line::at);
    for (const Line& line : lines) {
      LevelNode node;
      node.uv = inRange(a + line.at * (b - a));
      const bool up = b[line.axis] > a[line.axis];
      node.uv[line.axis] = !line.seam ? line.value : up ? high[line.axis] : low[line.axis];
      slide(face, level, 1 - line.axis, node);
      node.crease = !line.seam;
      add(node);
      if (!line.seam) continue;
      finish();
      node.uv[line.axis] = up ? low[line.axis] : high[line.axis];
      piece.nodes.push_back(node);
    }
    addPlace(b);
  }
  auto& nodes = piece.nodes;
  piece.closed = nodes.size() > 3 && (nodes.front().p - nodes.back().p).norm() <= kSameNode &&
                 ((nodes.front().uv - nodes.back().uv).array().abs() < 0.5 * (high - low).array()).all();
  if (piece.closed) nodes.pop_back();
  finish();
}

}  // namespace bw::geometry
