// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "section_row.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "bw/core/text/number_text.h"
#include "model_impl.h"
#include "section_ends.h"
#include "section_findings.h"
#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr double kInsetRatio = 1e-4;   // of the range: where the target ends planes keep off its very border
constexpr double kInset = 0.01;        // mm, at least
constexpr double kShortRatio = 0.01;   // of the longest section: shorter ones carry no shape
constexpr double kShort = 0.1;         // mm, likewise
constexpr double kLengthened = 1.01;   // times that: as long a section at a point is made
constexpr double kWidenedBy = 2;       // times the way from plane to plane: what a face goes on by, at least,
constexpr double kMostWidened = 0.25;  // but no more than this part of its size
constexpr int kProbePlanes = 64;       // tried when no sample of the target lies in the block
constexpr int kBisections = 16;  // halvings of the distance between a plane that hits and one that misses

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

}  // namespace

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
