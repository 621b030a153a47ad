// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// Sections that go on across holes and notches over the edge of two faces: docs/mathematics.md, Bridges.

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <optional>

#include "level_curves.h"
#include "section_samples.h"
#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr int kNearestSteps = 12;  // of Newton's method along a curve
constexpr int kMeetingBits = 26;   // of the place where two curves meet

using Nodes = std::vector<LevelNode>;

/// A place on a polygon of nodes: the number of a node, and the part of the way to the next one.
double chordPlace(const Nodes& nodes, const Eigen::Vector3d& p) {
  double best = 1e300, place = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const bool last = k + 1 == nodes.size();
    const double s = last ? 0 : nearestOnSegment(p, nodes[k].p, nodes[k + 1].p);
    const Eigen::Vector3d foot =
        last ? nodes[k].p : Eigen::Vector3d(nodes[k].p + s * (nodes[k + 1].p - nodes[k].p));
    if ((foot - p).norm() >= best) continue;
    best = (foot - p).norm();
    place = double(k) + s;
  }
  return place;
}

std::size_t segmentAt(const Nodes& nodes, double place) {
  return std::min(std::size_t(place), nodes.size() < 2 ? 0 : nodes.size() - 2);
}

double lengthOf(const Nodes& nodes) {
  double length = 0;
  for (std::size_t k = 1; k < nodes.size(); ++k) length += (nodes[k].p - nodes[k - 1].p).norm();
  return length;
}

}  // namespace

/// An end of a piece at a border of its face alone, and the way on from there: the first node is the end.
struct PlaneCutter::LooseEnd {
  int piece;
  bool last;
  int branch;
  Nodes way;
  Eigen::Vector3d outward;  ///< at the end, as the piece arrives

  /// The way's direction at a place of it.
  Eigen::Vector3d direction(double place) const {
    if (way.size() < 2) return outward;
    const std::size_t k = segmentAt(way, place);
    return way[k + 1].p - way[k].p;
  }
  /// mm along the way to a place of it, where `node` lies.
  double lengthTo(double place, const LevelNode& node) const {
    Nodes part(way.begin(), way.begin() + std::ptrdiff_t(segmentAt(way, place)) + 1);
    part.push_back(node);
    return lengthOf(part);
  }
};

/// Where two curves come nearest to each other.
struct PlaneCutter::Meeting {
  double onA = 0, onB = 0;
  LevelNode a = {}, b = {};
  double distance = 1e300;
};

LevelNode PlaneCutter::nodeAt(int face, const Nodes& nodes, double place, double level) const {
  const std::size_t k = segmentAt(nodes, place);
  const double s = place - double(k);
  if (s <= 0) return nodes[k];
  if (s >= 1) return nodes[k + 1];
  LevelNode node;
  if (between(face, nodes[k], nodes[k + 1], s, level, node)) return node;
  return nodes[s < 0.5 ? k : k + 1];
}

double PlaneCutter::nearestPlace(int face, const Nodes& nodes, const Eigen::Vector3d& p, double level) const {
  double place = chordPlace(nodes, p);
  if (nodes.size() < 2) return place;
  for (int step = 0; step < kNearestSteps; ++step) {
    const std::size_t k = segmentAt(nodes, place);
    const Eigen::Vector3d chord = nodes[k + 1].p - nodes[k].p;
    const double by = (p - nodeAt(face, nodes, place, level).p).dot(chord) / chord.squaredNorm();
    const double next = std::clamp(place + by, 0.0, double(nodes.size() - 1));
    const bool settled = std::abs(next - place) * chord.norm() < kConverged;
    place = next;
    if (settled) break;
  }
  return place;
}

PlaneCutter::Meeting PlaneCutter::meetingOf(int faceA, const Nodes& a, int faceB, const Nodes& b,
                                            double level) const {
  Meeting best;
  const auto at = [&](double place) {
    Meeting meeting;
    meeting.onA = place;
    meeting.a = nodeAt(faceA, a, place, level);
    meeting.onB = nearestPlace(faceB, b, meeting.a.p, level);
    meeting.b = nodeAt(faceB, b, meeting.onB, level);
    meeting.distance = (meeting.a.p - meeting.b.p).norm();
    if (meeting.distance < best.distance) best = meeting;
    return meeting.distance;
  };
  // The first place where both run together, as they do where they are of one surface.
  for (std::size_t k = 0; k < a.size(); ++k)
    if (at(double(k)) <= kSlack) return best;
  for (const LevelNode& node : b) at(nearestPlace(faceA, a, node.p, level));
  if (best.distance <= kSlack || a.size() < 2) return best;
  const double place = best.onA, last = double(a.size() - 1);
  boost::math::tools::brent_find_minima(at, std::max(0.0, place - 1), std::min(last, place + 1),
                                        kMeetingBits);
  return best;
}

std::optional<double> PlaneCutter::jointTolerance(int faceA, int faceB) const {
  for (const Neighbour& neighbour : target_.neighbours[std::size_t(faceA)])
    if (neighbour.face == faceB) return std::max(kMeet, 10 * neighbour.tolerance);
  return {};
}

std::vector<PlaneCutter::LooseEnd> PlaneCutter::looseEnds(const std::vector<Root>& roots,
                                                          const Cut& cut) const {
  std::vector<int> branchOf(cut.pieces.size(), -1);
  const std::vector<SectionBranch> branches = chainPieces(cut.pieces);
  for (std::size_t b = 0; b < branches.size(); ++b)
    for (const SectionBranch::Part& part : branches[b].parts)
      branchOf[std::size_t(part.piece - cut.pieces.data())] = int(b);
  std::vector<LooseEnd> ends;
  if (branches.size() < 2) return ends;
  for (std::size_t k = 0; k < cut.pieces.size(); ++k) {
    const LevelPiece& piece = cut.pieces[k];
    if (piece.closed || piece.nodes.size() < 2 || target_.neighbours[std::size_t(piece.face)].empty())
      continue;
    for (const bool last : {false, true}) {
      const LevelNode& end = last ? piece.nodes.back() : piece.nodes.front();
      if (end.root < 0 || !target_.freeEdge(roots[std::size_t(end.root)].edge)) continue;
      const LevelNode& inner = last ? piece.nodes[piece.nodes.size() - 2] : piece.nodes[1];
      const Nodes& on = last ? piece.after : piece.before;
      ends.push_back({int(k), last, branchOf[k], on.empty() ? Nodes{end} : on, end.p - inner.p});
    }
  }
  return ends;
}

void PlaneCutter::lead(const LooseEnd& end, double place, LevelNode node, int root, LevelPiece& piece) {
  Nodes more;
  for (std::size_t k = 1; k < end.way.size() && double(k) < place; ++k)
    if ((end.way[k].p - node.p).norm() > kSameNode) more.push_back(end.way[k]);
  (end.last ? piece.after : piece.before).clear();
  LevelNode& border = end.last ? piece.nodes.back() : piece.nodes.front();
  if ((node.p - border.p).norm() <= kSameNode) {
    border.root = root;
    return;
  }
  border.root = -1;
  node.root = root;
  more.push_back(node);
  if (end.last)
    piece.nodes.insert(piece.nodes.end(), more.begin(), more.end());
  else
    piece.nodes.insert(piece.nodes.begin(), more.rbegin(), more.rend());
}

void PlaneCutter::bridge(const std::vector<Root>& roots, double level, Cut& cut) const {
  std::vector<LooseEnd> ends = looseEnds(roots, cut);
  struct Bridge {
    std::size_t a, b;
    Meeting meeting;
    double width;
  };
  std::vector<Bridge> bridges;
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t j = i + 1; j < ends.size(); ++j) {
      const LooseEnd &a = ends[i], &b = ends[j];
      const int faceA = cut.pieces[std::size_t(a.piece)].face, faceB = cut.pieces[std::size_t(b.piece)].face;
      const std::optional<double> joint = jointTolerance(faceA, faceB);
      if (a.branch == b.branch || !joint) continue;
      const Meeting m = meetingOf(faceA, a.way, faceB, b.way, level);
      if (m.distance > *joint || a.direction(m.onA).dot(b.direction(m.onB)) >= 0) continue;
      bridges.push_back({i, j, m, a.lengthTo(m.onA, m.a) + b.lengthTo(m.onB, m.b)});
    }
  std::ranges::stable_sort(bridges, {}, &Bridge::width);
  std::vector<char> used(ends.size(), 0);
  int root = int(roots.size());
  for (const auto& [i, j, meeting, width] : bridges) {
    const LooseEnd &a = ends[i], &b = ends[j];
    if (used[i] || used[j] || a.branch == b.branch) continue;
    used[i] = used[j] = 1;
    LevelPiece& piece = cut.pieces[std::size_t(a.piece)];
    lead(a, meeting.onA, meeting.a, root, piece);
    lead(b, meeting.onB, meeting.b, root, cut.pieces[std::size_t(b.piece)]);
    ++root;
    piece.bridged = std::max(piece.bridged, width);
    const int joined = b.branch, kept = a.branch;
    for (LooseEnd& end : ends)
      if (end.branch == joined) end.branch = kept;
  }
}

}  // namespace bw::geometry
