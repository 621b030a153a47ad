// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "section_row.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "bw/core/sweep/oblique_planes.h"
#include "bw/core/text/number_text.h"
#include "model_impl.h"
#include "occt.h"
#include "section_ends.h"
#include "section_samples.h"
#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr double kPromised = 1e-3;      // mm between a section and its spline
constexpr double kFitTolerance = 5e-4;  // mm between samples of a section and its spline
constexpr double kSpeck = 0.01;         // mm: a part shorter than this is rounding, not a branch
constexpr double kSliver = 0.5;         // mm: nor is one that grazes the block's face,
constexpr double kSliverRatio = 100;    // where another one is so many times as long
constexpr double kBesideBlock = 1e-3;   // mm: what is farther off has left the block by a side
constexpr double kNudge = 1e-4;         // mm that a plane along a border or plane face is moved
constexpr int kMinSamples = 96;         // of a section, before it is fitted
constexpr int kMaxSamples = 12000;
constexpr double kMostOver = 0.1;  // of the shorter side of the base: so far a bridge may rise over it
constexpr int kLeastBeyond = 24;   // samples of what is added to a section at one end

constexpr double kInsetRatio = 1e-4;   // of the range: where the target ends planes keep off its very border
constexpr double kInset = 0.01;        // mm, at least
constexpr double kShortRatio = 0.01;   // of the longest section: shorter ones carry no shape
constexpr double kShort = 0.1;         // mm, likewise
constexpr double kLengthened = 1.01;   // times that: as long a section at a point is made
constexpr double kWidenedBy = 2;       // times the way from plane to plane: what a face goes on by, at least,
constexpr double kMostWidened = 0.25;  // but no more than this part of its size
constexpr int kProbePlanes = 64;       // tried when no sample of the target lies in the block
constexpr int kTrisections = 48;       // of the way on, for the place where it turns back
constexpr int kBisections = 16;  // halvings of the distance between a plane that hits and one that misses

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

/// The first and last place along the direction where the target lies in the block.
Result<std::array<double, 2>> rangeOf(const Target::Impl& target, const PlaneFamily& planes,
                                      const Sectioner& sectioner) {
  // Where planes turn, no extent tells which of them meet the target.
  const auto extent =
      planes.turns() ? std::array<double, 2>{planes.entry, planes.exit} : target.extent(planes.direction());
  const double low = std::max(extent[0], planes.entry), high = std::min(extent[1], planes.exit);
  const auto missed = [&]() {
    return fail(ErrorCode::badInput,
                "no plane across the cutting direction meets the target inside the block; move or enlarge "
                "the block, or let it be placed around the target",
                "block");
  };
  if (!(high > low)) {
    if (extent[1] - extent[0] < kSlack && extent[0] > planes.entry && extent[0] < planes.exit) {
      return fail(ErrorCode::badInput,
                  "the target has no extent along the cutting direction; choose a direction that runs along "
                  "the surface",
                  "direction", extent[1] - extent[0]);
    }
    return missed();
  }
  if (high - low < 4 * kInset) {
    return fail(ErrorCode::badInput,
                "the target extends only " + shortText(high - low) +
                    " mm along the cutting direction inside the block; choose a direction that runs along "
                    "the surface",
                "direction", high - low, 4 * kInset);
  }
  const double inset = std::max(kInset, kInsetRatio * (high - low));
  // A plane that meets the block at a corner alone does so by rounding.
  const double slack = sectioner.slanted() ? inset : 0;
  const auto goesOn = [&](double face, double way) {
    if (sectioner.slanted()) return sectioner.hits(face + way * inset, 3 * inset);
    return way < 0 ? extent[0] < face - inset : extent[1] > face + inset;
  };
  // Where the target goes on beyond the block the row ends in its face, so that the rows of neighbours meet,
  // or beside it where it runs along a border.
  const auto besides = [&](double face, double way) {
    return sectioner.grazes(face) ? face - 2 * way * kNudge : face;
  };
  const double first = goesOn(planes.entry, -1) ? besides(planes.entry, -1) : low + inset,
               last = goesOn(planes.exit, 1) ? besides(planes.exit, 1) : high - inset;
  const auto hits = [&](double level) { return sectioner.hits(level, slack); };
  if (hits(first) && hits(last)) return std::array<double, 2>{first, last};

  // The target leaves the block by another side, or a border is ragged: look where it begins and ends.
  double a = 1e300, b = -1e300;
  for (int k = 0; k <= kProbePlanes; ++k) {
    const double level = first + (last - first) * k / kProbePlanes;
    if (!hits(level)) continue;
    a = std::min(a, level);
    b = std::max(b, level);
  }
  if (a > b) return missed();
  const auto bisect = [&](double hit, double miss) {
    for (int k = 0; k < kBisections && std::abs(miss - hit) > 0.5 * inset; ++k) {
      const double middle = 0.5 * (hit + miss);
      (hits(middle) ? hit : miss) = middle;
    }
    return hit;
  };
  if (a > first) a = bisect(a, std::max(first, a - (last - first) / kProbePlanes));
  if (b < last) b = bisect(b, std::min(last, b + (last - first) / kProbePlanes));
  if (!(b > a)) return missed();
  return std::array<double, 2>{a, b};
}

/// Makes all curves run the same way: towards +x where that is clear, else like their neighbours.
void orient(std::vector<Section>& all) {
  constexpr double kClear = 0.05;  // of the chord
  const auto chord = [](const PlanarCurve& c) -> Eigen::Vector2d {
    return c.value(c.end()) - c.value(c.start());
  };
  std::vector<PlanarCurve*> curves;
  for (Section& section : all)
    if (section.chosen >= 0) curves.push_back(&section.curve());
  int anchor = -1;
  for (int i = 0; i < int(curves.size()); ++i) {
    const Eigen::Vector2d d = chord(*curves[i]);
    if (std::abs(d.x()) <= kClear * d.norm()) continue;
    if (d.x() < 0) *curves[i] = curves[i]->reversed();
    if (anchor < 0) anchor = i;
  }
  if (anchor < 0) {
    anchor = 0;
    if (chord(*curves[0]).y() < 0) *curves[0] = curves[0]->reversed();
  }
  const auto follow = [&](int i, int neighbour) {
    const PlanarCurve &c = *curves[i], &n = *curves[neighbour];
    const Eigen::Vector2d d = chord(c);
    if (std::abs(d.x()) > kClear * d.norm()) return;
    const Eigen::Vector2d a = c.value(c.start()), b = c.value(c.end()), na = n.value(n.start()),
                          nb = n.value(n.end());
    if ((a - na).squaredNorm() + (b - nb).squaredNorm() > (b - na).squaredNorm() + (a - nb).squaredNorm()) {
      *curves[i] = c.reversed();
    }
  };
  for (int i = anchor + 1; i < int(curves.size()); ++i) follow(i, i - 1);
  for (int i = anchor - 1; i >= 0; --i) follow(i, i + 1);
}

/// How bad a cause is beside another one of its kind.
double badness(const Cause& cause) {
  if (const auto* branches = std::get_if<SectionBranches>(&cause)) return branches->most;
  if (const auto* shorter = std::get_if<SectionShort>(&cause)) return -shorter->length;
  if (const auto* bridged = std::get_if<SectionBridged>(&cause)) return bridged->width;
  if (const auto* extended = std::get_if<SectionExtended>(&cause)) return extended->length;
  if (const auto* rough = std::get_if<SectionRough>(&cause)) return rough->distance;
  if (const auto* differs = std::get_if<SectionDiffers>(&cause)) return differs->distance;
  return 0;
}

/// Adds a later finding of the same kind of cause to `all`, which keeps the worse of both.
void join(Finding& all, const Finding& one) {
  StationRange& range = *all.where.stations;
  const bool worse = badness(one.cause) > badness(all.cause);
  range.last = one.where.stations->last;
  range.count += one.where.stations->count;
  if (auto* branches = std::get_if<SectionBranches>(&all.cause)) {
    const auto& more = std::get<SectionBranches>(one.cause);
    branches->least = std::min(branches->least, more.least);
    branches->most = std::max(branches->most, more.most);
    branches->above = std::max(branches->above, more.above);
    branches->below = std::max(branches->below, more.below);
  } else if (worse) {
    all.cause = one.cause;
  }
  if (!worse) return;
  range.worst = one.where.stations->worst;
  all.where.point = one.where.point;
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

Result<void> checkSetup(const Setup& setup) {
  const Frame& plane = setup.planes.frame;
  if (!(std::abs(plane.normal.norm() - 1) < kNoLength) || !plane.x.allFinite() || !plane.y.allFinite())
    return fail(ErrorCode::badInput,
                "the cutting direction is zero or not a number; give a vector such as 0, 1, 0", "direction");
  if (!setup.block.size.allFinite() || !(setup.block.size.minCoeff() > 0) ||
      !setup.block.frame.origin.allFinite() || !setup.block.frame.x.allFinite() ||
      !setup.block.frame.y.allFinite() || !setup.block.frame.normal.allFinite()) {
    return fail(ErrorCode::badInput,
                "the block must have a finite place and a size above 0 mm in all three directions", "block",
                setup.block.size.minCoeff(), 0.0);
  }
  return {};
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
        for (int k = 0; k < 2 * kBisections; ++k) {
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

Findings gathered(const Findings& each) {
  constexpr std::size_t kMostStretches = 3;
  std::map<std::pair<std::size_t, bool>, Findings> stretches;  // by the kind of cause
  for (const Finding& one : each) {
    const auto* differs = std::get_if<SectionDiffers>(&one.cause);
    Findings& known = stretches[{one.cause.index(), differs && differs->taken}];
    if (!known.empty() && known.back().where.stations->last + 1 == one.where.stations->first)
      join(known.back(), one);
    else
      known.push_back(one);
  }
  Findings result;
  for (auto& [index, known] : stretches) {
    if (known.size() > kMostStretches) {
      for (std::size_t i = 1; i < known.size(); ++i) join(known.front(), known[i]);
      known.resize(1);
    }
    result.insert(result.end(), known.begin(), known.end());
  }
  std::ranges::stable_sort(result, {}, [](const Finding& f) { return f.where.stations->first; });
  return result;
}

Result<void> SectionRow::place() {
  const auto range = rangeOf(target_, planes_, *sectioner_);
  if (!range) return tl::unexpected(range.error());
  first_ = (*range)[0];
  last_ = (*range)[1];
  return {};
}

void SectionRow::divide(int count, int fewest) {
  count_ = count;
  const double apart = (last_ - first_) / (fewest - 1);
  if (apart != apart_ && sectioner_->slanted() && !planes_.turns()) {
    const double most = kMostWidened * target_.bounds.size().norm();
    auto widened = WidenedFace::of(target_, std::min(kWidenedBy * apart, most));
    sectioner_.emplace(target_, block_, planes_, std::move(widened));
  }
  apart_ = apart;
  sectioner_->reachBy(apart);
}

Result<void> SectionRow::divide(const SectionRequest& request) {
  if (!request.spacing) {
    divide(*request.stations, *request.stations);
    return {};
  }
  const double width = last_ - first_;
  const double gaps = std::ceil(width / *request.spacing - kSameSize);
  if (gaps + 1 > SectionRequest::kMost) {
    return fail(ErrorCode::badInput,
                "a spacing of " + shortText(*request.spacing) + " mm makes more than " +
                    std::to_string(SectionRequest::kMost) + " stations over " + shortText(width) +
                    " mm; choose " +
                    shortText(std::ceil(width / (SectionRequest::kMost - 1) * 100) / 100, 8) + " mm or more",
                "stations", gaps + 1, SectionRequest::kMost);
  }
  const int count = std::max(2, int(gaps) + 1);
  divide(count, count);
  return {};
}

void SectionRow::fillSteps(std::vector<SectionOutcome>& outcomes) const {
  std::vector<SectionOutcome*> followed;
  std::vector<RowEnd> lows, highs;
  for (SectionOutcome& outcome : outcomes) {
    if (!outcome.followed()) continue;
    const PlanarCurve& curve = outcome.section->curve();
    const double a = curve.value(curve.start()).x(), b = curve.value(curve.end()).x();
    // Sections that stand upright have no left and right end.
    if (std::abs(b - a) < 0.5 * (curve.value(curve.end()) - curve.value(curve.start())).norm()) return;
    followed.push_back(&outcome);
    lows.push_back({outcome.section->travel, -std::min(a, b)});
    highs.push_back({outcome.section->travel, std::max(a, b)});
  }
  const std::vector<double> low = withoutSteps(lows), high = withoutSteps(highs);
  for (std::size_t i = 0; i < followed.size(); ++i)
    if (!followed[i]->samples.empty() && (low[i] > lows[i].out || high[i] > highs[i].out))
      sectioner_->extend(*followed[i], -low[i], high[i]);
}

void SectionRow::fillPoints(std::vector<SectionOutcome>& outcomes, double shortest) const {
  const double wide = kLengthened * shortest;
  for (SectionOutcome& outcome : outcomes) {
    if (!outcome.followed() || outcome.length >= shortest || outcome.samples.empty()) continue;
    const PlanarCurve& curve = outcome.section->curve();
    const double a = curve.value(curve.start()).x(), b = curve.value(curve.end()).x();
    const double middle = 0.5 * (a + b);
    // Evenly; where the surface ends with the target on one side, all of it on the other.
    for (const auto& [low, high] : {std::pair(middle - 0.5 * wide, middle + 0.5 * wide),
                                    {std::min(a, b) - wide, std::max(a, b) + wide}}) {
      SectionOutcome extended = outcome;
      sectioner_->extend(extended, low, high);
      if (extended.length < shortest) continue;
      outcome = std::move(extended);
      break;
    }
  }
}

Result<std::vector<Section>> SectionRow::finish(std::vector<SectionOutcome> outcomes,
                                                Findings& findings) const {
  fillSteps(outcomes);
  double longest = 0;
  for (const SectionOutcome& outcome : outcomes) longest = std::max(longest, outcome.length);
  const double shortest = std::max(kShort, kShortRatio * longest);
  fillPoints(outcomes, shortest);
  std::vector<Section> sections;
  Findings each;
  for (SectionOutcome& outcome : outcomes) {
    each.insert(each.end(), outcome.findings.begin(), outcome.findings.end());
    if (!outcome.section) continue;
    Section& section = sections.emplace_back(std::move(*outcome.section));
    if (section.chosen >= 0 && outcome.length < shortest) {
      each.push_back({Severity::warning,
                      SectionShort{outcome.length, shortest},
                      {StationRange::of(section.index),
                       section.frame.toWorld(section.curve().value(section.curve().start()))},
                      {}});
      section.chosen = -1;
    }
  }
  for (Finding& finding : gathered(each)) findings.push_back(std::move(finding));
  if (std::ranges::all_of(sections, [](const Section& s) { return s.chosen < 0; })) {
    return fail(ErrorCode::noSolution,
                "none of the " + std::to_string(count()) +
                    " planes cuts the target in one open curve inside the block; choose another block, "
                    "direction or face",
                "sections");
  }
  orient(sections);
  return sections;
}

}  // namespace bw::geometry
