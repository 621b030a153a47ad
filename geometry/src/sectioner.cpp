// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sectioner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <set>

#include "bw/core/sweep/oblique_planes.h"
#include "model_impl.h"
#include "occt.h"
#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr double kPromised = 1e-3;      // mm between a section and its spline
constexpr double kFitTolerance = 5e-4;  // mm between samples of a section and its spline
constexpr double kSpeck = 0.01;         // mm: a part shorter than this is rounding, not a branch
constexpr double kSliver = 0.5;         // mm: nor is one that grazes the block's face,
constexpr double kSliverRatio = 100;    // where another one is so many times as long
constexpr double kBesideBlock = 1e-3;   // mm: what is farther off has left the block by a side
constexpr int kMinSamples = 96;         // of a section, before it is fitted
constexpr int kMaxSamples = 12000;
constexpr double kMostOver = 0.1;  // of the shorter side of the base: so far a bridge may rise over it
constexpr int kLeastBeyond = 24;   // samples of what is added to a section at one end
constexpr int kTrisections = 48;   // of the way on, for the place where it turns back
constexpr int kHalvings = 32;      // of the last step of a way on, for its end

/// Whether no plane is parallel to a face of the block.
bool isSlanted(const PlaneFamily& planes, const Box& block) {
  return planes.turns() || areOblique(planes, block);
}

/// The block with all that it may be carried over along the direction of slanted planes.
Box regionOf(const PlaneFamily& planes, const Box& block) {
  if (!isSlanted(planes, block)) return block;
  Box region = block;
  const double far = planes.exit - planes.entry;
  const std::array axes = {block.frame.x, block.frame.y, block.frame.normal};
  for (int k = 0; k < 3; ++k) {
    const double by = far * std::abs(planes.direction().dot(axes[std::size_t(k)]));
    region.frame.origin -= by * axes[std::size_t(k)];
    region.size[k] += 2 * by;
  }
  return region;
}

/// The parts of each interval between the nodes of a curve that give it `kMinSamples` samples.
int divisionOf(const SectionBranch& branch) {
  std::size_t nodes = 0;
  for (const auto& part : branch.parts) nodes += part.piece->nodes.size();
  return std::max(2, int((kMinSamples + nodes - 1) / nodes));
}

}  // namespace

Box grown(Box box, double by) {
  box.frame.origin -= by * (box.frame.x + box.frame.y + box.frame.normal);
  box.size.array() += 2 * by;
  return box;
}

Sectioner::Sectioner(const Target::Impl& target, const Box& block, const PlaneFamily& planes,
                     std::shared_ptr<const WidenedFace> widened)
    : widened_(std::move(widened)),
      target_(widened_ ? widened_->target() : target),
      planes_(planes),
      region_(regionOf(planes, block)),
      window_{block},
      block_{block},
      slanted_(isSlanted(planes, block)) {
  if (!planes.turns()) parallel_.emplace(target_, planes.direction(), region_);
}

void Sectioner::reachBy(double apart) {
  const double all = planes_.exit - planes_.entry;
  if (slanted_) window_.way = (planes_.turns() ? all : std::min(apart, all)) * planes_.direction();
}

bool Sectioner::holds(const LevelNode& node) const {
  return window_.holds(node.p) && (!widened_ || widened_->reachedFromFace(node, window_.way));
}

Sectioner::Cutting Sectioner::at(double level) const {
  if (parallel_) return {{}, &*parallel_, level};
  const Frame plane = planes_.at(level);
  auto own = std::make_shared<const PlaneCutter>(target_, plane.normal, region_);
  const PlaneCutter* cutter = own.get();
  return {std::move(own), cutter, plane.normal.dot(plane.origin)};
}

bool Sectioner::hits(double level, double slack) const {
  const BlockWindow block{grown(block_.box, slack)};
  const Cutting cutting = at(level);
  const PlaneCutter::Cut cut = cutting.cutter->cut(cutting.level);
  for (const LevelPiece& piece : cut.pieces) {
    for (const LevelNode& node : piece.nodes) {
      if (block.holds(node.p)) return true;
    }
  }
  // A corner of the block may come between two nodes.
  for (const LevelPiece& piece : cut.pieces)
    for (std::size_t k = piece.closed ? 0 : 1; k < piece.nodes.size(); ++k) {
      const LevelNode &a = piece.nodes[k > 0 ? k - 1 : piece.nodes.size() - 1], &b = piece.nodes[k];
      const Frame& frame = block.box.frame;
      const auto part = lineInBox(block.box.size, frame.toLocal(a.p), frame.toLocal(b.p), 0);
      LevelNode node;
      if (part &&
          cutting.cutter->between(piece.face, a, b, std::midpoint((*part)[0], (*part)[1]), cutting.level,
                                  node) &&
          block.holds(node.p))
        return true;
    }
  return false;
}

SectionOutcome Sectioner::cut(double level, int station, bool byKernel,
                              const Eigen::Vector3d* through) const {
  Cutting cutting = at(level);
  if (cutting.cutter->grazes(cutting.level)) {
    level += kNudge;
    cutting = at(level);
  }
  const PlaneCutter& cutter = *cutting.cutter;
  const double own = cutting.level;
  SectionOutcome outcome;
  const Frame frame = planes_.at(level);
  const auto tell = [&](Severity severity, Cause cause, const Eigen::Vector3d& point) {
    outcome.findings.push_back({severity, std::move(cause), {StationRange::of(station), point}, {}});
  };

  const auto cut = guarded(ErrorCode::internal, "OpenCASCADE finds no section",
                           [&]() -> Result<PlaneCutter::Cut> { return cutter.cut(own, byKernel); });
  if (!cut) {
    tell(Severity::warning, SectionUnfit{cut.error().message}, frame.origin);
    return outcome;
  }
  const std::vector<SectionBranch> branches = chainPieces(cut->pieces);

  struct Part {
    const SectionBranch* branch;
    std::vector<SectionSample> samples;
    bool closed, clipped;
    double length;
  };
  std::vector<Part> parts;
  double speck = 0;
  for (const SectionBranch& branch : branches) {
    bool clipped = false;
    auto pieces = geometry::clipped(
        cutter, sampleBranch(cutter, branch, own, divisionOf(branch)), branch.closed, own,
        [this](const LevelNode& node) { return holds(node); }, clipped);
    for (auto& piece : pieces) {
      const double length = lengthOf(piece);
      if (length < kSpeck) {
        speck = std::max(speck, length);
        continue;
      }
      parts.push_back({&branch, std::move(piece), branch.closed && !clipped, clipped, length});
    }
  }
  // What stays beside the block does not count, unless that is all.
  const auto comesIn = [&](const Part& part) {
    return std::ranges::any_of(part.samples, [&](const SectionSample& s) { return block_.holds(s.node.p); });
  };
  if (slanted() && std::ranges::any_of(parts, comesIn)) std::erase_if(parts, std::not_fn(comesIn));
  double longest = 0;
  for (const Part& part : parts) longest = std::max(longest, part.length);
  std::erase_if(parts,
                [&](const Part& part) { return part.length < std::min(kSliver, longest / kSliverRatio); });
  for (const Part& part : parts) outcome.found += part.length;
  outcome.curves = int(parts.size());
  if (parts.empty()) {
    tell(Severity::warning, speck > 0 ? Cause(SectionPoint{}) : Cause(SectionMissing{}), frame.origin);
    return outcome;
  }
  if (through) {
    const auto distance = [&](const Part& part) {
      double nearest = 1e300;
      for (const SectionSample& sample : part.samples)
        nearest = std::min(nearest, (sample.node.p - *through).norm());
      return nearest;
    };
    std::swap(parts.front(), *std::ranges::min_element(parts, {}, distance));
    parts.erase(parts.begin() + 1, parts.end());
  }
  const Eigen::Vector3d place = parts.front().samples.front().node.p;
  outcome.section = Section{station, planes_.travel(level), frame, {}, -1};
  if (parts.size() > 1 || parts.front().closed) {
    for (const Part& part : parts) {
      std::vector<Eigen::Vector2d> points;
      for (const SectionSample& sample : part.samples)
        points.push_back(frame.toLocal(sample.node.p).head<2>());
      if (auto chain = PlanarCurve::points(std::move(points))) outcome.section->branches.push_back(*chain);
    }
  }
  std::optional<JoinedParts> all;
  bool over = false;
  if (parts.size() > 1) {
    all = overTop(cutter.normal(), own, byKernel);
    over = all.has_value();
    if (over) {
      outcome.found = lengthOf(all->samples);
      outcome.curves = 1;
    }
    // What the block's own faces part is not joined over a gap.
    std::vector<std::vector<SectionSample>> open;
    std::set<const SectionBranch*> whole;
    for (const Part& part : parts)
      if (!part.closed && whole.insert(part.branch).second) open.push_back(part.samples);
    if (!all && open.size() == parts.size()) all = joined(cutter, open, frame);
    if (!all) {
      SectionBranches several{int(parts.size()), int(parts.size())};
      tellHeights(cutter.normal(), own, frame, several);
      tell(Severity::warning, several, place);
      return outcome;
    }
    outcome.section->branches.clear();
  } else if (parts.front().closed) {
    tell(Severity::warning, SectionClosed{}, place);
    return outcome;
  } else {
    all = JoinedParts{parts.front().samples};
  }
  if (cut->doubtful) tell(Severity::info, SectionBorder{}, place);
  double bridged = all->widest;
  for (const Part& part : parts)
    for (const SectionBranch::Part& piece : part.branch->parts)
      bridged = std::max(bridged, piece.piece->bridged);
  if (bridged > kSpeck) tell(Severity::info, SectionBridged{bridged}, place);

  const auto goesOn = [&](std::size_t number, bool last) -> std::vector<SectionSample> {
    if (over) return {};
    const Part& part = parts[number];
    const SectionBranch::Part& end = last ? part.branch->parts.back() : part.branch->parts.front();
    const std::vector<LevelWay>& way = last == end.reversed ? end.piece->before : end.piece->after;
    const SectionSample& from = last ? part.samples.back() : part.samples.front();
    if (way.empty() || (way.front().nodes.front().p - from.node.p).norm() > kMeet) return {};
    std::vector<LevelPiece> pieces;
    for (const LevelWay& step : way) pieces.push_back({step.face, step.nodes});
    SectionBranch branch;
    for (const LevelPiece& piece : pieces) branch.parts.push_back({&piece, false});
    return sampleBranch(cutter, branch, own, divisionOf(branch));
  };
  outcome.level = level;
  outcome.beyond = {goesOn(all->first, all->firstTurned), goesOn(all->last, !all->lastTurned)};
  if (!outcome.beyond[0].empty() || !outcome.beyond[1].empty()) outcome.samples = all->samples;
  fit(outcome, std::move(all->samples));
  return outcome;
}

std::shared_ptr<const PlaneCutter> Sectioner::tallCutter(const Eigen::Vector3d& normal) const {
  const auto tall = [&] {
    Box box = region_;
    const double reach = (target_.bounds.max - target_.bounds.min).norm();
    box.frame.origin -= reach * box.frame.normal;
    box.size.z() += 2 * reach;
    return std::make_shared<const PlaneCutter>(target_, normal, box);
  };
  if (!parallel_) return tall();
  std::call_once(tallOnce_, [&] { tall_ = tall(); });
  return tall_;
}

std::optional<JoinedParts> Sectioner::overTop(const Eigen::Vector3d& normal, double level,
                                              bool byKernel) const {
  if (slanted()) return {};
  BlockWindow open = block_;
  open.box.size.z() += kMostOver * block_.box.size.head<2>().minCoeff();
  const std::shared_ptr<const PlaneCutter> cutter = tallCutter(normal);
  const PlaneCutter::Cut cut = cutter->cut(level, byKernel);
  std::optional<JoinedParts> found;
  for (const SectionBranch& branch : chainPieces(cut.pieces)) {
    if (branch.closed) return {};
    bool clipped = false;
    for (const std::vector<SectionSample>& part : geometry::clipped(
             *cutter, sampleBranch(*cutter, branch, level, divisionOf(branch)), false, level,
             [&open](const LevelNode& node) { return open.holds(node.p); }, clipped)) {
      const auto in = [this](const SectionSample& sample) { return holds(sample.node); };
      const auto first = std::ranges::find_if(part, in);
      if (first == part.end()) continue;
      const auto last = std::ranges::find_if(part.rbegin(), part.rend(), in).base();
      const auto ofTarget = [this](const SectionSample& sample) {
        return sample.face < int(target_.faces.size()) &&
               target_.faces[std::size_t(sample.face)]->contains(sample.node.uv);
      };
      if (std::any_of(first, last, [&](const auto& sample) { return !in(sample) && ofTarget(sample); }))
        return {};
      const auto pieces = geometry::clipped(
          *cutter, part, false, level, [this](const LevelNode& node) { return holds(node); }, clipped);
      double within = 0;
      for (const auto& piece : pieces) within += lengthOf(piece);
      if (within < kSpeck) continue;
      JoinedParts whole;
      whole.samples.push_back(pieces.front().front());
      for (auto sample = first; sample != last; ++sample)
        if ((sample->node.p - whole.samples.back().node.p).norm() > kSameNode)
          whole.samples.push_back(*sample);
      const SectionSample& end = pieces.back().back();
      if ((end.node.p - whole.samples.back().node.p).norm() > kSameNode) whole.samples.push_back(end);
      for (const SectionBranch::Part& piece : branch.parts)
        whole.widest = std::max(whole.widest, piece.piece->bridged);
      if (found || lengthOf(whole.samples) > 2 * within) return {};
      found = std::move(whole);
    }
  }
  return found;
}

void Sectioner::tellHeights(const Eigen::Vector3d& normal, double level, const Frame& frame,
                            SectionBranches& several) const {
  const std::shared_ptr<const PlaneCutter> tall = tallCutter(normal);
  const PlaneCutter& cutter = *tall;
  const PlaneCutter::Cut cut = cutter.cut(level);
  for (const SectionBranch& branch : chainPieces(cut.pieces)) {
    if (branch.closed) continue;
    double above = 0, below = 0, nowAbove = 0, nowBelow = 0;
    bool begun = false, beside = false;
    for (const SectionSample& sample : sampleBranch(cutter, branch, level, divisionOf(branch))) {
      if (holds(sample.node)) {
        if (beside) {  // and comes back, perhaps by that side
          above = below = 0;
          break;
        }
        begun = true;
        above = std::max(above, nowAbove);
        below = std::max(below, nowBelow);
      } else if (begun) {
        const Eigen::Vector3d local = block_.box.frame.toLocal(sample.node.p), &size = block_.box.size;
        const Eigen::Vector2d off = (local.head<2>() - size.head<2>()).cwiseMax(-local.head<2>());
        beside = beside || off.maxCoeff() > kBesideBlock;
        nowAbove = std::max(nowAbove, local.z() - size.z());
        nowBelow = std::max(nowBelow, -local.z());
      }
    }
    several.above = std::max(several.above, above);
    several.below = std::max(several.below, below);
  }
  if (several.above > 0 || several.below > 0) return;
  // Or sheets end beyond it, beside a gap over which they would be joined.
  BlockWindow open = block_;
  const double reach = (target_.bounds.max - target_.bounds.min).norm() + block_.box.size.norm();
  open.box.frame.origin -= reach * open.box.frame.normal;
  open.box.size.z() += 2 * reach;
  std::vector<std::vector<SectionSample>> sheets;
  for (const SectionBranch& branch : chainPieces(cut.pieces)) {
    bool clipped = false;
    auto pieces = geometry::clipped(
        cutter, sampleBranch(cutter, branch, level, divisionOf(branch)), branch.closed, level,
        [&open](const LevelNode& node) { return open.holds(node.p); }, clipped);
    std::erase_if(pieces, [](const auto& piece) { return lengthOf(piece) < kSpeck; });
    if (pieces.empty()) continue;
    if (branch.closed || pieces.size() > 1) return;
    sheets.push_back(std::move(pieces.front()));
  }
  const std::optional<JoinedParts> all = sheets.size() > 1 ? joined(cutter, sheets, frame) : std::nullopt;
  if (!all) return;
  for (const SectionSample& sample : all->samples) {
    const double height = block_.box.frame.toLocal(sample.node.p).z();
    several.above = std::max(several.above, height - block_.box.size.z());
    several.below = std::max(several.below, -height);
  }
}

bool Sectioner::fit(SectionOutcome& outcome, std::vector<SectionSample> samples) const {
  Section& section = *outcome.section;
  const double length = lengthOf(samples);
  const Eigen::Vector3d place = samples.front().node.p;
  const auto tell = [&](Cause cause) {
    outcome.findings.push_back(
        {Severity::warning, std::move(cause), {StationRange::of(section.index), place}, {}});
  };
  const Cutting cutting = at(outcome.level);
  // With more samples where the curve asks for more spans.
  std::optional<CurveFit> best;
  for (int round = 0;; ++round) {
    auto fit = fitCurve(runsOf(*cutting.cutter, samples, section.frame), kFitTolerance);
    if (!fit) {
      tell(SectionUnfit{fit.error().message});
      return false;
    }
    if (!best || fit->deviation < best->deviation) best = std::move(*fit);
    if (best->enough || int(samples.size()) > kMaxSamples / 3 || round == 8) break;
    samples = refined(*cutting.cutter, samples, cutting.level, 3);
  }
  if (best->deviation > kPromised) tell(SectionRough{best->deviation});
  outcome.length = length;
  section.branches = {std::move(best->curve)};
  section.chosen = 0;
  return true;
}

void Sectioner::extend(SectionOutcome& outcome, double low, double high) const {
  const Cutting cutting = at(outcome.level);
  const auto xOf = [&](const LevelNode& node) { return outcome.section->frame.toLocal(node.p).x(); };
  std::vector<SectionSample> samples = outcome.samples;
  double length = 0;
  for (const bool last : {false, true}) {
    if (last) std::ranges::reverse(samples);
    const bool up = xOf(samples.front().node) > xOf(samples.back().node);
    const auto left = [&](const LevelNode& node) { return up ? high - xOf(node) : xOf(node) - low; };
    const auto within = [&](const LevelNode& node) { return left(node) >= 0 && holds(node); };
    const auto at = [&](const SectionSample& a, const SectionSample& b, double part) {
      SectionSample sample = b;
      if (!cutting.cutter->between(b.face, a.node, b.node, part, cutting.level, sample.node)) sample = a;
      return sample;
    };
    std::vector<SectionSample> more = {samples.front()};
    for (SectionSample next : outcome.beyond[last ? 1 : 0]) {
      if (next.face != more.back().face) {
        // The same place on the next surface.
        more.push_back(next);
        continue;
      }
      if ((next.node.p - more.back().node.p).norm() <= kSameNode) continue;
      const bool turns = !(left(next.node) < left(more.back().node));
      if (turns) {
        // Where the surface turns back nothing is to be followed: the place lies beside the farthest sample.
        const auto farthest = [&](const SectionSample& a, const SectionSample& b) {
          double from = 0, to = 1;
          for (int k = 0; k < kTrisections; ++k) {
            const double third = (to - from) / 3;
            if (left(at(a, b, from + third).node) < left(at(a, b, to - third).node))
              to -= third;
            else
              from += third;
          }
          return at(a, b, 0.5 * (from + to));
        };
        next = farthest(more.back(), next);
        if (more.size() > 2 && more[more.size() - 2].face == more.back().face) {
          const SectionSample earlier = farthest(more[more.size() - 2], more.back());
          if (left(earlier.node) < left(next.node)) {
            more.pop_back();
            next = earlier;
          }
        }
      }
      if (!within(next.node)) {
        double in = 0, out = 1;
        for (int k = 0; k < kHalvings; ++k) {
          const double middle = 0.5 * (in + out);
          (within(at(more.back(), next, middle).node) ? in : out) = middle;
        }
        const SectionSample end = at(more.back(), next, in);
        if ((end.node.p - more.back().node.p).norm() > kSameNode) more.push_back(end);
        break;
      }
      if ((next.node.p - more.back().node.p).norm() > kSameNode) more.push_back(next);
      if (turns) break;
    }
    if (more.size() < 2) continue;
    if (int(more.size()) < kLeastBeyond)
      more = refined(*cutting.cutter, more, cutting.level, 1 + kLeastBeyond / int(more.size()));
    samples.front().corner = more.front().corner = false;
    length = std::max(length, lengthOf(more));
    std::ranges::reverse(more);
    samples.insert(samples.begin(), more.begin(), more.end() - 1);
  }
  std::ranges::reverse(samples);
  for (std::size_t k = 1; k < samples.size(); ++k)
    samples[k].corner = samples[k].corner || samples[k].face != samples[k - 1].face;
  if (length < kSpeck) return;
  SectionOutcome extended = outcome;
  if (!fit(extended, std::move(samples))) return;
  extended.findings.push_back({Severity::info,
                               SectionExtended{length},
                               {StationRange::of(outcome.section->index), outcome.samples.front().node.p},
                               {}});
  outcome = std::move(extended);
}

}  // namespace bw::geometry
