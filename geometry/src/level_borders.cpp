// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// Where the borders of faces cross a plane, and the curves cut there.

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bracketed_root.h"
#include "level_curves.h"

namespace bw::geometry {

namespace {

constexpr double kOnCrossing =
    1e-5;  // mm from the crossing of a border at which a curve ends, besides the edge's tolerance
constexpr double kOffBorder = 1e-4;  // mm between that crossing and the face, besides ten times the tolerance

/// mm, of the polygon through its nodes.
double lengthOf(const LevelPiece& piece) {
  double length = 0;
  for (std::size_t k = 1; k < piece.nodes.size(); ++k)
    length += (piece.nodes[k].p - piece.nodes[k - 1].p).norm();
  return length;
}

/// The piece goes on with another one, which begins where it ends; the border between them is none any more.
void append(LevelPiece& piece, LevelPiece more) {
  if (piece.nodes.empty()) {
    piece.nodes = std::move(more.nodes);
    return;
  }
  if (more.nodes.empty()) return;
  piece.nodes.back().root = more.nodes.front().root = -1;
  piece.nodes.insert(piece.nodes.end(), more.nodes.begin() + 1, more.nodes.end());
}

}  // namespace

std::vector<PlaneCutter::Root> PlaneCutter::crossings(double level) const {
  std::vector<Root> roots;
  for (const EdgeLevels& e : edges_) {
    // At a corner of the border one of its edges has the crossing, however both are rounded.
    if (level < e.low - kOnPlane || level > e.high + kOnPlane) continue;
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
        t = bracketedRoot(f, e.t[i - 1], fa, e.t[i], fb, 0.1 * kConverged);
      } else {
        t = std::abs(fa) < std::abs(fb) ? e.t[i - 1] : e.t[i];
      }
      roots.push_back({e.edge, t, edge.value(t)});
    }
  }
  return roots;
}

void PlaneCutter::split(int face, const std::vector<Root>& roots, double level,
                        std::vector<LevelPiece>& chains, Cut& cut) const {
  const FaceGeometry& geometry = *target_.faces[face];
  if (geometry.natural()) {
    // The curves end on the borders by themselves; they only learn which crossing that is.
    for (LevelPiece& chain : chains) {
      if (!chain.closed) {
        for (LevelNode* end : {&chain.nodes.front(), &chain.nodes.back()}) {
          double best = kOnCrossing;
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
      node.uv = {std::clamp(node.uv.x(), geometry.u0(), geometry.u1()),
                 std::clamp(node.uv.y(), geometry.v0(), geometry.v1())};
      const Eigen::Vector2d raw = trim.value(std::clamp(roots[r].t, trim.first, trim.last));
      if (raw.x() >= geometry.u0() && raw.x() <= geometry.u1() && raw.y() >= geometry.v0() &&
          raw.y() <= geometry.v1()) {
        node.uv = raw;
      }
      // The face's own point; the crossing on the shared edge differs from it by the file's tolerance.
      const Eigen::Vector2d onBorder = node.uv;
      if (!project(face, level, node) ||
          (node.p - roots[r].p).norm() > 10 * target_.model->edges[trim.edge].tolerance + kOffBorder) {
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
          const double s = nearestOnSegment(q, a, b), distance = (a + s * (b - a) - q).norm();
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

  // Between its stops a part lies within the borders or outside of them, but may touch them in a place: of
  // two that differ a third one decides.
  const auto insideAt = [&](const LevelPiece& part, double share) {
    const double place = share * double(part.nodes.size() - 1);
    const std::size_t k = std::min(std::size_t(place), part.nodes.size() - 2);
    LevelNode node;
    if (!between(face, part.nodes[k], part.nodes[k + 1], place - double(k), level, node))
      node.uv = part.nodes[k].uv + (place - double(k)) * (part.nodes[k + 1].uv - part.nodes[k].uv);
    return geometry.contains(node.uv);
  };
  const auto inside = [&](const LevelPiece& part) {
    const bool one = insideAt(part, 0.5), other = insideAt(part, 0.271);
    return one == other ? one : insideAt(part, 0.683);
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
    const auto cleaned = [](LevelPiece part) {
      std::vector<LevelNode> clean;
      for (const LevelNode& node : part.nodes) {
        if (!clean.empty() && (node.p - clean.back().p).norm() <= 10 * kSameNode) {
          if (node.root >= 0) clean.back() = node;
          continue;
        }
        clean.push_back(node);
      }
      part.nodes = std::move(clean);
      return part;
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
      std::optional<LevelPiece> open;
      LevelPiece gap;
      bool free = true;  // of other faces are all borders since `open`
      for (std::size_t k = 0; k <= stops.size(); ++k) {
        const Place* from = k > 0 ? &stops[k - 1] : nullptr;
        const Place* to = k < stops.size() ? &stops[k] : nullptr;
        LevelPiece part = cleaned(partFrom(from ? from->at : 0, from ? &from->node : nullptr, to ? to->at : 0,
                                           to ? &to->node : nullptr));
        free = free && from && target_.freeEdge(roots[std::size_t(from->node.root)].edge);
        if (part.nodes.size() < 2 || !inside(part)) {
          append(gap, std::move(part));
          continue;
        }
        if (open && free) {
          open->bridged = std::max(open->bridged, lengthOf(gap));
          append(*open, std::move(gap));
          append(*open, std::move(part));
        } else {
          if (open) cut.pieces.push_back(std::move(*open));
          const bool first = !open;
          open = std::move(part);
          if (first && from && gap.nodes.size() > 1 &&
              target_.freeEdge(roots[std::size_t(from->node.root)].edge))
            open->before = {{face, std::vector<LevelNode>(gap.nodes.rbegin(), gap.nodes.rend())}};
        }
        gap = {};
        free = true;
      }
      if (open && free && gap.nodes.size() > 1) open->after = {{face, std::move(gap.nodes)}};
      if (open) cut.pieces.push_back(cleaned(std::move(*open)));
    } else {
      for (std::size_t k = 0; k < stops.size(); ++k) {
        const bool wraps = k + 1 == stops.size();
        const Place& to = stops[wraps ? 0 : k + 1];
        LevelPiece part =
            cleaned(partFrom(stops[k].at, &stops[k].node, to.at + (wraps ? count : 0), &to.node));
        if (part.nodes.size() >= 2 && inside(part)) cut.pieces.push_back(std::move(part));
      }
    }
  }
}

}  // namespace bw::geometry
