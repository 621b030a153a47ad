// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// Sections that go on across holes and notches over the edges of faces: docs/mathematics.md, Bridges.

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

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

/// The part of a polygon before a place of it, where `node` lies.
Nodes until(const Nodes& nodes, double place, const LevelNode& node) {
  Nodes part;
  for (std::size_t k = 0; k < nodes.size() && double(k) < place; ++k)
    if ((nodes[k].p - node.p).norm() > kSameNode) part.push_back(nodes[k]);
  part.push_back(node);
  return part;
}

/// The part after it, or what comes before it, backwards.
Nodes beyond(Nodes nodes, double place, const LevelNode& node, bool forward) {
  if (forward) {
    std::ranges::reverse(nodes);
    place = double(nodes.size() - 1) - place;
  }
  Nodes part = until(nodes, place, node);
  std::ranges::reverse(part);
  return part;
}

double lengthOf(const Nodes& nodes) {
  double length = 0;
  for (std::size_t k = 1; k < nodes.size(); ++k) length += (nodes[k].p - nodes[k - 1].p).norm();
  return length;
}

}  // namespace

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
  const int faces = int(target_.faces.size());
  const auto on = [&](int face) {
    return face < faces ? std::vector<int>{face} : target_.carriers[std::size_t(face - faces)].faces;
  };
  const std::vector<int> others = on(faceB);
  std::optional<double> joint;
  if (faceA == faceB) return joint;
  for (const int face : on(faceA))
    for (const Neighbour& neighbour : target_.neighbours[std::size_t(face)])
      if (std::ranges::find(others, neighbour.face) != others.end())
        joint = std::max(joint.value_or(kMeet), 10 * neighbour.tolerance);
  return joint;
}

/// An end of a piece at a border of its face alone.
struct PlaneCutter::LooseEnd {
  int piece;
  bool last;
  int branch;
  Eigen::Vector3d outward;   ///< as the piece arrives
  std::size_t stretch = {};  ///< that leads on from it
};

/// A stretch of a curve on a surface, outside all faces that lie on it.
struct PlaneCutter::Stretch {
  static constexpr int kOpen = -1;   ///< its surface ends there
  static constexpr int kTaken = -2;  ///< a face ends there beside which another one goes on

  int face;
  Nodes nodes;
  std::array<int, 2> ends;                             ///< the loose ends that it begins and ends with
  Eigen::Vector3d outward = Eigen::Vector3d::UnitX();  ///< of a single node, away from its loose end

  /// Its direction at a place of it.
  static Eigen::Vector3d direction(const Nodes& nodes, double place, const Eigen::Vector3d& ofOne) {
    if (nodes.size() < 2) return ofOne;
    const std::size_t k = segmentAt(nodes, place);
    return nodes[k + 1].p - nodes[k].p;
  }
};

/// A way over stretches from a loose end on.
struct PlaneCutter::Path {
  std::vector<LevelWay> steps = {};
  double length = 0;  ///< mm
  int from = -1, to = Stretch::kOpen;

  Path with(int face, Nodes nodes) const {
    Path more = *this;
    more.length += lengthOf(nodes);
    if (nodes.size() > 1) more.steps.push_back({face, std::move(nodes)});
    return more;
  }
};

/// Where the ways from one loose end lead.
struct PlaneCutter::Paths {
  std::vector<Path> bridges = {};  ///< to other loose ends
  Path open = {};                  ///< until the surfaces end
};

/// The stretches of one plane, and the paths over them.
class PlaneCutter::Bridging {
 public:
  Bridging(const PlaneCutter& cutter, const std::vector<Root>& roots, double level, bool byKernel, Cut& cut)
      : cutter_(cutter), level_(level), byKernel_(byKernel), cut_(cut), nextRoot_(int(roots.size())) {
    const std::vector<SectionBranch> branches = chainPieces(cut.pieces);
    branches_ = branches.size();
    std::vector<int> branchOf(cut.pieces.size(), -1);
    for (std::size_t b = 0; b < branches.size(); ++b)
      for (const SectionBranch::Part& part : branches[b].parts)
        branchOf[std::size_t(part.piece - cut.pieces.data())] = int(b);
    for (std::size_t k = 0; k < cut.pieces.size(); ++k) {
      const LevelPiece& piece = cut.pieces[k];
      if (piece.closed || piece.nodes.size() < 2 ||
          cutter.target_.neighbours[std::size_t(piece.face)].empty())
        continue;
      for (const bool last : {false, true}) {
        const LevelNode& end = last ? piece.nodes.back() : piece.nodes.front();
        if (end.root < 0 || !cutter.target_.freeEdge(roots[std::size_t(end.root)].edge)) continue;
        const LevelNode& inner = last ? piece.nodes[piece.nodes.size() - 2] : piece.nodes[1];
        ends_.push_back({int(k), last, branchOf[k], end.p - inner.p});
      }
    }
  }

  void run() {
    const bool carried = !cutter_.target_.carriers.empty();
    if (ends_.empty() || (branches_ < 2 && !carried)) return;
    if (carried) findStretches();
    findOwnStretches();
    std::vector<Paths> paths;
    for (std::size_t i = 0; i < ends_.size(); ++i) paths.push_back(pathsFrom(int(i)));
    std::vector<char> used(ends_.size(), 0);
    join(paths, used);
    for (std::size_t i = 0; i < ends_.size(); ++i)
      if (used[i])
        wayOf(ends_[i]).clear();
      else if (carried)
        wayOf(ends_[i]) = std::move(paths[i].open.steps);
  }

 private:
  LevelPiece& pieceOf(const LooseEnd& end) const { return cut_.pieces[std::size_t(end.piece)]; }
  LevelNode& nodeOf(const LooseEnd& end) const {
    return end.last ? pieceOf(end).nodes.back() : pieceOf(end).nodes.front();
  }
  std::vector<LevelWay>& wayOf(const LooseEnd& end) const {
    return end.last ? pieceOf(end).after : pieceOf(end).before;
  }
  int looseEnd(std::size_t piece, bool last) const {
    for (std::size_t i = 0; i < ends_.size(); ++i)
      if (std::size_t(ends_[i].piece) == piece && ends_[i].last == last) return int(i);
    return Stretch::kTaken;
  }

  /// A part of a carrier's curve that a piece takes.
  struct Taken {
    double from, to;
    int first, last;  // the loose ends there, or kTaken
  };

  void findStretches() {
    const int faces = int(cutter_.target_.faces.size());
    for (int c = 0; c < int(cutter_.target_.carriers.size()); ++c) {
      std::vector<LevelPiece> chains;
      if (byKernel_)
        cutter_.intersect(faces + c, level_, chains);
      else
        cutter_.march(faces + c, level_, chains);
      std::vector<std::vector<Taken>> taken(chains.size());
      // Where a piece is not found on its carrier's curve nobody knows what is free.
      const std::vector<int>& on = cutter_.target_.carriers[std::size_t(c)].faces;
      bool all = true;
      for (std::size_t k = 0; k < cut_.pieces.size() && all; ++k)
        if (std::ranges::find(on, cut_.pieces[k].face) != on.end()) all = take(faces + c, chains, k, taken);
      if (!all) continue;
      for (std::size_t chain = 0; chain < chains.size(); ++chain)
        if (!chains[chain].closed) addStretches(faces + c, chains[chain].nodes, std::move(taken[chain]));
    }
  }

  /// Marks the part of a carrier's curves that a piece takes; false if it lies on none of them.
  bool take(int carrier, const std::vector<LevelPiece>& chains, std::size_t piece,
            std::vector<std::vector<Taken>>& taken) const {
    if (cut_.pieces[piece].closed) return false;
    const Nodes& nodes = cut_.pieces[piece].nodes;
    for (std::size_t chain = 0; chain < chains.size(); ++chain) {
      if (chains[chain].closed) continue;
      const auto place = [&](const LevelNode& node) -> std::optional<double> {
        const double at = cutter_.nearestPlace(carrier, chains[chain].nodes, node.p, level_);
        const LevelNode there = cutter_.nodeAt(carrier, chains[chain].nodes, at, level_);
        return (there.p - node.p).norm() <= kMeet ? std::optional(at) : std::nullopt;
      };
      const std::optional<double> first = place(nodes.front()), last = place(nodes.back());
      if (!first || !last) continue;
      Taken part{*first, *last, looseEnd(piece, false), looseEnd(piece, true)};
      if (part.from > part.to) {
        std::swap(part.from, part.to);
        std::swap(part.first, part.last);
      }
      taken[chain].push_back(part);
      return true;
    }
    return false;
  }

  void addStretches(int carrier, const Nodes& nodes, std::vector<Taken> taken) {
    std::ranges::sort(taken, {}, &Taken::from);
    taken.push_back({double(nodes.size() - 1), double(nodes.size() - 1), Stretch::kOpen, Stretch::kOpen});
    double from = 0;
    int first = Stretch::kOpen;
    for (const Taken& next : taken) {
      const LevelNode start = cutter_.nodeAt(carrier, nodes, from, level_),
                      end = cutter_.nodeAt(carrier, nodes, next.from, level_);
      if (next.from > from && (end.p - start.p).norm() > kMeet) {
        Nodes part = until(nodes, next.from, end);
        part = beyond(std::move(part), std::min(from, double(part.size() - 1)), start, true);
        for (LevelNode& node : part) node.root = -1;
        const std::size_t index = stretches_.size();
        for (const int one : {first, next.first})
          if (one >= 0) led_[std::size_t(one)] = index;
        stretches_.push_back({carrier, std::move(part), {first, next.first}});
      }
      if (next.to < from) continue;
      from = next.to;
      first = next.last;
    }
  }

  /// Of the ends that no carrier leads on from: as far as the surface under their own face goes.
  void findOwnStretches() {
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      LooseEnd& end = ends_[i];
      const LevelPiece& piece = pieceOf(end);
      if (const auto known = led_.find(i); known != led_.end()) {
        end.stretch = known->second;
        continue;
      }
      const std::vector<LevelWay>& on = wayOf(end);
      end.stretch = stretches_.size();
      stretches_.push_back({piece.face,
                            on.empty() ? Nodes{nodeOf(end)} : on.front().nodes,
                            {int(i), Stretch::kOpen},
                            end.outward});
    }
  }

  Paths pathsFrom(int start) const {
    Paths paths;
    const LooseEnd& end = ends_[std::size_t(start)];
    std::vector<char> visited(stretches_.size(), 0);
    std::size_t at = end.stretch;
    const bool onward = stretches_[at].ends[0] == start;
    Nodes nodes = stretches_[at].nodes;
    if (!onward) std::ranges::reverse(nodes);
    Eigen::Vector3d direction = end.outward;
    Path path;
    path.from = start;
    if (const int other = stretches_[at].ends[onward ? 1 : 0]; other >= 0) {
      Path bridge = path.with(stretches_[at].face, std::move(nodes));
      bridge.to = other;
      paths.bridges.push_back(std::move(bridge));
      return paths;
    }
    for (;;) {
      visited[at] = 1;
      const int face = stretches_[at].face;
      struct Step {
        std::size_t stretch;
        Path path;
        Nodes nodes;
        Eigen::Vector3d direction;
      };
      std::optional<Step> step;
      for (std::size_t t = 0; t < stretches_.size(); ++t) {
        const Stretch& next = stretches_[t];
        const std::optional<double> joint = cutter_.jointTolerance(face, next.face);
        if (visited[t] || !joint) continue;
        const Meeting m = cutter_.meetingOf(face, nodes, next.face, next.nodes, level_);
        if (m.distance > *joint) continue;
        const Eigen::Vector3d arriving = Stretch::direction(nodes, m.onA, direction);
        const Path here = path.with(face, until(nodes, m.onA, m.a));
        for (const bool forward : {true, false}) {
          const Eigen::Vector3d leaving =
              (forward ? 1.0 : -1.0) * Stretch::direction(next.nodes, m.onB, next.outward);
          if (arriving.dot(leaving) <= 0) continue;
          const int ahead = next.ends[forward ? 1 : 0], behind = next.ends[forward ? 0 : 1];
          Nodes rest = beyond(next.nodes, m.onB, m.b, forward);
          if (ahead >= 0) {
            Path bridge = here.with(next.face, std::move(rest));
            bridge.to = ahead;
            if (ahead != start) paths.bridges.push_back(std::move(bridge));
          } else if (ahead == Stretch::kOpen && behind == Stretch::kOpen && rest.size() > 1 &&
                     (!step || here.length < step->path.length)) {
            step = Step{t, here, std::move(rest), arriving};
          }
        }
      }
      if (!step) break;
      at = step->stretch;
      path = std::move(step->path);
      nodes = std::move(step->nodes);
      direction = step->direction;
    }
    paths.open = path.with(stretches_[at].face, std::move(nodes));
    return paths;
  }

  /// Bridges between different branches, the shortest first.
  void join(const std::vector<Paths>& paths, std::vector<char>& used) {
    std::vector<const Path*> bridges;
    for (const Paths& some : paths)
      for (const Path& bridge : some.bridges) bridges.push_back(&bridge);
    std::ranges::stable_sort(bridges, {}, [](const Path* bridge) { return bridge->length; });
    for (const Path* bridge : bridges) {
      const LooseEnd &a = ends_[std::size_t(bridge->from)], &b = ends_[std::size_t(bridge->to)];
      if (used[std::size_t(bridge->from)] || used[std::size_t(bridge->to)] || a.branch == b.branch) continue;
      used[std::size_t(bridge->from)] = used[std::size_t(bridge->to)] = 1;
      pieceOf(a).bridged = std::max(pieceOf(a).bridged, bridge->length);
      nodeOf(a).root = nextRoot_;
      for (const LevelWay& step : bridge->steps) {
        LevelPiece piece{step.face, step.nodes};
        for (LevelNode& node : piece.nodes) node.root = -1;
        piece.nodes.front().root = nextRoot_;
        piece.nodes.back().root = ++nextRoot_;
        cut_.pieces.push_back(std::move(piece));
      }
      nodeOf(b).root = nextRoot_++;
      const int joined = b.branch, kept = a.branch;
      for (LooseEnd& end : ends_)
        if (end.branch == joined) end.branch = kept;
    }
  }

  const PlaneCutter& cutter_;
  double level_;
  bool byKernel_;
  Cut& cut_;
  int nextRoot_;
  std::size_t branches_ = 0;
  std::vector<LooseEnd> ends_;
  std::vector<Stretch> stretches_;
  std::map<std::size_t, std::size_t> led_;  // by loose end: the stretch of a carrier that leads on from it
};

void PlaneCutter::bridge(const std::vector<Root>& roots, double level, bool byKernel, Cut& cut) const {
  Bridging(*this, roots, level, byKernel, cut).run();
}

}  // namespace bw::geometry
