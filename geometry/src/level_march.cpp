// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// Marching squares: the curves of a plane over the grid of one face.

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "bracketed_root.h"
#include "level_curves.h"

namespace bw::geometry {

LevelNode PlaneCutter::crossing(int face, double level, double ua, double va, double ub, double vb) const {
  const SurfacePatch& patch = target_.faces[face]->patch();
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
  const FaceGeometry& geometry = *target_.faces[face];
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

}  // namespace bw::geometry
