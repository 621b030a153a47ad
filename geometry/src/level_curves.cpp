// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "level_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace bw::geometry {

namespace {

constexpr double kOnPlane = 1e-9;     // mm: a grid node this close counts as above the plane, so that rounding has no say
constexpr double kGraze = 1e-7;       // mm: a border all of whose samples are this close runs along the plane
constexpr double kConverged = 1e-9;   // mm from the plane
constexpr double kSameNode = 1e-7;    // mm: nodes closer than this are one
constexpr int kRootIterations = 60;

/// A root of f (value and slope) in [a, b] with a change of sign: Newton's method, kept within the bracket by bisection.
template <class Function>
double bracketedRoot(const Function& f, double a, double fa, double b, double fb) {
  if (fa == 0) return a;
  if (fb == 0) return b;
  double t = a + (b - a) * (fa / (fa - fb));
  for (int i = 0; i < kRootIterations; ++i) {
    double slope = 0;
    const double ft = f(t, slope);
    if (std::abs(ft) < 0.1 * kConverged) break;
    if ((ft < 0) == (fa < 0)) {
      a = t;
      fa = ft;
    } else {
      b = t;
      fb = ft;
    }
    double next = slope != 0 ? t - ft / slope : a;
    if (!(next > std::min(a, b) && next < std::max(a, b))) next = 0.5 * (a + b);
    if (next == t || std::abs(b - a) <= 1e-15 * (std::abs(a) + std::abs(b))) break;
    t = next;
  }
  return t;
}

}  // namespace

PlaneCutter::PlaneCutter(const Target::Impl& target, const Eigen::Vector3d& normal, const Box& region)
    : target_(target), normal_(normal), size_(target.bounds.size().norm()) {
  for (int e = 0; e < int(target.edgeUses.size()); ++e) {
    const EdgeGeometry& edge = target.model->edges[e];
    if (target.edgeUses[e] == 0 || edge.degenerate()) continue;
    EdgeLevels levels;
    levels.edge = e;
    const auto g = [&](double t) { return normal.dot(edge.value(t)); };
    for (std::size_t i = 0; i < edge.t.size(); ++i) {
      levels.t.push_back(edge.t[i]);
      levels.g.push_back(normal.dot(edge.points[i]));
    }
    // Insert the extrema between samples, so that each interval has at most one crossing.
    for (std::size_t i = 1; i + 1 < levels.t.size(); ++i) {
      const double before = levels.g[i] - levels.g[i - 1], after = levels.g[i + 1] - levels.g[i];
      if (before * after >= 0) continue;
      const bool peak = before > 0;
      double a = levels.t[i - 1], b = levels.t[i + 1];
      for (int k = 0; k < 50 && b - a > 1e-12 * (edge.last - edge.first); ++k) {
        const double x1 = a + 0.382 * (b - a), x2 = b - 0.382 * (b - a);
        if ((g(x1) > g(x2)) == peak) {
          b = x2;
        } else {
          a = x1;
        }
      }
      const double t = 0.5 * (a + b);
      if (t == levels.t[i]) continue;
      const std::size_t at = t < levels.t[i] ? i : i + 1;
      levels.t.insert(levels.t.begin() + std::ptrdiff_t(at), t);
      levels.g.insert(levels.g.begin() + std::ptrdiff_t(at), g(t));
      ++i;
    }
    levels.low = *std::min_element(levels.g.begin(), levels.g.end());
    levels.high = *std::max_element(levels.g.begin(), levels.g.end());
    edges_.push_back(std::move(levels));
  }

  for (const auto& face : target.faces) {
    FaceLevels levels;
    const int nu = int(face->gridU().size()), nv = int(face->gridV().size());
    levels.g.resize(std::size_t(nu) * nv);
    levels.low = 1e300;
    levels.high = -1e300;
    for (int i = 0; i < nu; ++i) {
      for (int j = 0; j < nv; ++j) {
        const double g = normal.dot(face->gridPoint(i, j));
        levels.g[std::size_t(i) * nv + j] = g;
        levels.low = std::min(levels.low, g);
        levels.high = std::max(levels.high, g);
      }
    }
    levels.active.assign(std::size_t(nu - 1) * (nv - 1), 1);
    levels.rowLow.assign(std::size_t(nu - 1), 1e300);
    levels.rowHigh.assign(std::size_t(nu - 1), -1e300);
    for (int i = 0; i + 1 < nu; ++i) {
      for (int j = 0; j + 1 < nv; ++j) {
        Bounds cell, local;
        for (const int a : {0, 1}) {
          for (const int b : {0, 1}) {
            const Eigen::Vector3d& p = face->gridPoint(i + a, j + b);
            cell.add(p);
            local.add(region.frame.toLocal(p));
          }
        }
        const double slack = 0.5 * cell.size().norm() + 1e-6;
        const bool far = ((local.min.array() - slack) > region.size.array()).any() || ((local.max.array() + slack) < 0).any();
        if (far) {
          levels.active[std::size_t(i) * (nv - 1) + j] = 0;
          continue;
        }
        for (const int a : {0, 1}) {
          for (const int b : {0, 1}) {
            const double g = levels.g[std::size_t(i + a) * nv + (j + b)];
            levels.rowLow[i] = std::min(levels.rowLow[i], g);
            levels.rowHigh[i] = std::max(levels.rowHigh[i], g);
          }
        }
      }
    }
    faces_.push_back(std::move(levels));
  }
}

bool PlaneCutter::grazes(double level) const {
  const auto close = [&](double low, double high) { return std::abs(low - level) < kGraze && std::abs(high - level) < kGraze; };
  return std::any_of(edges_.begin(), edges_.end(), [&](const EdgeLevels& e) { return close(e.low, e.high); }) ||
         std::any_of(faces_.begin(), faces_.end(), [&](const FaceLevels& f) { return close(f.low, f.high); });
}

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
    s = bracketedRoot(f, 0, fa, 1, fb);
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
    if (closed && piece.nodes.size() > 1 && (piece.nodes.front().p - piece.nodes.back().p).norm() <= kSameNode) {
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

bool PlaneCutter::project(int face, double level, LevelNode& node) const {
  const FaceGeometry& geometry = *target_.faces[face];
  Jet jet;
  for (int k = 0; k < 12; ++k) {
    geometry.patch().first(node.uv.x(), node.uv.y(), jet);
    const double f = normal_.dot(jet.p) - level;
    node.p = jet.p;
    if (std::abs(f) < kConverged) return true;
    // The shortest way in space along the surface to the plane.
    const double gu = normal_.dot(jet.du), gv = normal_.dot(jet.dv);
    const double E = jet.du.squaredNorm(), F = jet.du.dot(jet.dv), G = jet.dv.squaredNorm();
    const double det = E * G - F * F;
    if (!(det > 1e-14 * E * G) || det == 0) return false;
    const double hu = (G * gu - F * gv) / det, hv = (E * gv - F * gu) / det;
    const double slope = gu * hu + gv * hv;
    if (!(slope > 1e-12)) return false;
    node.uv -= (f / slope) * Eigen::Vector2d(hu, hv);
    if (geometry.patch().isSpline()) {
      node.uv.x() = std::clamp(node.uv.x(), geometry.u0(), geometry.u1());
      node.uv.y() = std::clamp(node.uv.y(), geometry.v0(), geometry.v1());
    }
  }
  return std::abs(normal_.dot(node.p) - level) < 1e-6;
}

bool PlaneCutter::between(int face, const LevelNode& a, const LevelNode& b, double at, double level,
                          LevelNode& node) const {
  node = {};
  node.uv = a.uv + at * (b.uv - a.uv);
  if (!project(face, level, node)) return false;
  // A foot far from the chord belongs to another branch.
  const double chord = (b.p - a.p).norm();
  return (node.p - (a.p + at * (b.p - a.p))).norm() <= chord + 1e-6;
}

Eigen::Vector3d PlaneCutter::tangent(int face, const LevelNode& node) const {
  Jet jet;
  target_.faces[face]->patch().first(node.uv.x(), node.uv.y(), jet);
  const Eigen::Vector3d n = jet.du.cross(jet.dv);
  const Eigen::Vector3d t = normal_.cross(n);
  const double length = t.norm();
  if (!(length > 1e-8 * n.norm()) || length == 0) return Eigen::Vector3d::Zero();
  return t / length;
}

PlaneCutter::Cut PlaneCutter::cut(double level) const {
  std::vector<Root> roots;
  for (const EdgeLevels& e : edges_) {
    if (level < e.low || level > e.high) continue;
    const EdgeGeometry& edge = target_.model->edges[e.edge];
    const auto f = [&](double t, double& slope) {
      gp_Pnt p;
      gp_Vec d;
      edge.curve->D1(t, p, d);
      slope = normal_.x() * d.X() + normal_.y() * d.Y() + normal_.z() * d.Z();
      return normal_.x() * p.X() + normal_.y() * p.Y() + normal_.z() * p.Z() - level;
    };
    for (std::size_t i = 1; i < e.t.size(); ++i) {
      const double fa = e.g[i - 1] - level, fb = e.g[i] - level;
      if ((fa > -kOnPlane) == (fb > -kOnPlane)) continue;
      double t = 0;
      if ((fa < 0) != (fb < 0)) {
        t = bracketedRoot(f, e.t[i - 1], fa, e.t[i], fb);
      } else {
        t = std::abs(fa) < std::abs(fb) ? e.t[i - 1] : e.t[i];
      }
      roots.push_back({e.edge, t, edge.value(t)});
    }
  }
  Cut result;
  for (int face = 0; face < int(faces_.size()); ++face) {
    std::vector<LevelPiece> chains;
    march(face, level, chains);
    split(face, roots, level, chains, result);
  }
  return result;
}

void PlaneCutter::split(int face, const std::vector<Root>& roots, double level, std::vector<LevelPiece>& chains,
                        Cut& cut) const {
  const FaceGeometry& geometry = *target_.faces[face];
  if (geometry.natural()) {
    // The curves end on the borders by themselves; they only learn which crossing that is.
    for (LevelPiece& chain : chains) {
      if (!chain.closed) {
        for (LevelNode* end : {&chain.nodes.front(), &chain.nodes.back()}) {
          double best = 1e-5;
          for (const TrimEdge& trim : geometry.trims()) {
            if (trim.edge < 0 || target_.model->edges[trim.edge].degenerate()) continue;
            for (int r = 0; r < int(roots.size()); ++r) {
              if (roots[r].edge != trim.edge) continue;
              const double d = (roots[r].p - end->p).norm();
              if (d > best + target_.model->edges[trim.edge].tolerance) continue;
              best = d;
              end->root = r;
            }
          }
        }
      }
      cut.pieces.push_back(std::move(chain));
    }
    return;
  }

  // Where the borders cross the curves: segment number + fraction along each chain.
  struct Place {
    double at;
    LevelNode node;
  };
  std::vector<std::vector<Place>> places(chains.size());
  const double reach = 0.25 * std::max(geometry.scale().x() * (geometry.u1() - geometry.u0()),
                                       geometry.scale().y() * (geometry.v1() - geometry.v0()));
  for (const TrimEdge& trim : geometry.trims()) {
    for (int r = 0; r < int(roots.size()); ++r) {
      if (roots[r].edge != trim.edge) continue;
      LevelNode node;
      node.uv = geometry.wrapped(trim.value(std::clamp(roots[r].t, trim.first, trim.last)));
      // Of the two lines of a seam, `wrapped` may pick the wrong one.
      node.uv = {std::clamp(node.uv.x(), geometry.u0(), geometry.u1()), std::clamp(node.uv.y(), geometry.v0(), geometry.v1())};
      const Eigen::Vector2d raw = trim.value(std::clamp(roots[r].t, trim.first, trim.last));
      if (raw.x() >= geometry.u0() && raw.x() <= geometry.u1() && raw.y() >= geometry.v0() && raw.y() <= geometry.v1()) {
        node.uv = raw;
      }
      // The face's own point; the crossing on the shared edge differs from it by the file's tolerance.
      const Eigen::Vector2d onBorder = node.uv;
      if (!project(face, level, node) || (node.p - roots[r].p).norm() > 10 * target_.model->edges[trim.edge].tolerance + 1e-4) {
        node.uv = onBorder;
        node.p = roots[r].p;
      }
      node.root = r;
      const Eigen::Vector2d q = node.uv.cwiseProduct(geometry.scale());
      double best = reach, where = 0;
      int chosen = -1;
      for (int c = 0; c < int(chains.size()); ++c) {
        const auto& nodes = chains[c].nodes;
        const int segments = int(nodes.size()) - (chains[c].closed ? 0 : 1);
        for (int k = 0; k < segments; ++k) {
          const Eigen::Vector2d a = nodes[k].uv.cwiseProduct(geometry.scale());
          const Eigen::Vector2d b = nodes[(k + 1) % nodes.size()].uv.cwiseProduct(geometry.scale());
          const Eigen::Vector2d d = b - a;
          const double length2 = d.squaredNorm();
          const double s = length2 > 0 ? std::clamp((q - a).dot(d) / length2, 0.0, 1.0) : 0.0;
          const double distance = (a + s * d - q).norm();
          if (distance < best) {
            best = distance;
            where = k + s;
            chosen = c;
          }
        }
      }
      if (chosen < 0) {
        cut.doubtful = cut.doubtful || !chains.empty();
        continue;
      }
      places[chosen].push_back({where, node});
    }
  }

  const auto inside = [&](const LevelPiece& part) {
    LevelNode middle;
    const std::size_t k = (part.nodes.size() - 1) / 2;
    if (part.nodes.size() % 2 == 1 && part.nodes.size() > 2) {
      middle = part.nodes[part.nodes.size() / 2];
    } else if (!between(face, part.nodes[k], part.nodes[k + 1], 0.5, level, middle)) {
      middle.uv = 0.5 * (part.nodes[k].uv + part.nodes[k + 1].uv);
    }
    return geometry.contains(middle.uv);
  };
  for (std::size_t c = 0; c < chains.size(); ++c) {
    LevelPiece& chain = chains[c];
    auto& stops = places[c];
    std::sort(stops.begin(), stops.end(), [](const Place& a, const Place& b) { return a.at < b.at; });
    const int count = int(chain.nodes.size());
    if (stops.empty()) {
      if (inside(chain)) cut.pieces.push_back(std::move(chain));
      continue;
    }
    const auto addPart = [&](LevelPiece part) {
      std::vector<LevelNode> clean;
      for (const LevelNode& node : part.nodes) {
        if (!clean.empty() && (node.p - clean.back().p).norm() <= 10 * kSameNode) {
          if (node.root >= 0) clean.back() = node;
          continue;
        }
        clean.push_back(node);
      }
      part.nodes = std::move(clean);
      if (part.nodes.size() >= 2 && inside(part)) cut.pieces.push_back(std::move(part));
    };
    const auto partFrom = [&](double from, const LevelNode* first, double to, const LevelNode* last) {
      LevelPiece part;
      part.face = face;
      if (first) part.nodes.push_back(*first);
      const int begin = first ? int(std::floor(from)) + 1 : 0;
      const int end = last ? int(std::ceil(to)) - 1 : count - 1;
      for (int k = begin; k <= end; ++k) part.nodes.push_back(chain.nodes[std::size_t(k % count)]);
      if (last) part.nodes.push_back(*last);
      return part;
    };
    if (!chain.closed) {
      addPart(partFrom(0, nullptr, stops.front().at, &stops.front().node));
      for (std::size_t k = 1; k < stops.size(); ++k) {
        addPart(partFrom(stops[k - 1].at, &stops[k - 1].node, stops[k].at, &stops[k].node));
      }
      addPart(partFrom(stops.back().at, &stops.back().node, 0, nullptr));
    } else {
      for (std::size_t k = 0; k < stops.size(); ++k) {
        const bool wraps = k + 1 == stops.size();
        const Place& to = stops[wraps ? 0 : k + 1];
        addPart(partFrom(stops[k].at, &stops[k].node, to.at + (wraps ? count : 0), &to.node));
      }
    }
  }
}

}  // namespace bw::geometry
