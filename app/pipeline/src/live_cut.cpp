// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "live_cut.h"

#include <algorithm>
#include <utility>

#include "bw/core/curve/same_curve.h"
#include "bw/core/shape/iso_sections.h"
#include "bw/core/surface/spline_change.h"
#include "bw/core/sweep/lowest_place.h"
#include "cut_stages.h"

namespace bw::pipeline {

namespace {

bool sameSections(const std::vector<Section>& a, const std::vector<Section>& b) {
  return std::ranges::equal(a, b, [](const Section& one, const Section& other) {
    return one.index == other.index && one.travel == other.travel && one.frame == other.frame &&
           one.chosen == other.chosen && std::ranges::equal(one.branches, other.branches, sameCurve) &&
           one.beyond.has_value() == other.beyond.has_value() &&
           (!one.beyond || sameCurve(*one.beyond, *other.beyond));
  });
}

/// mm by which a blade of a row lies off its section, at most.
double farthestOf(const Sweep& row) {
  double farthest = 0;
  for (const StationFit& fit : row.fits) farthest = std::max(farthest, fit.fit.hausdorff);
  return farthest;
}
constexpr double kNear = 0.05;    // of the tolerance,
constexpr double kAsNear = 1.25;  // or of what it was

/// True if they have more in common than a border.
bool overlap(const Eigen::AlignedBox2d& a, const Eigen::AlignedBox2d& b) {
  return !a.isEmpty() && !b.isEmpty() && (a.min().array() < b.max().array()).all() &&
         (b.min().array() < a.max().array()).all();
}

}  // namespace

LiveCut::LiveCut(const CutEvaluation& cut, std::shared_ptr<const SplineSurface> spline)
    : cut_(cut),
      began_(cut.sweep.value),
      planes_(cut.sections.request),
      sections_(cut.sections.value),
      spline_(std::move(spline)) {}

void LiveCut::beginOn(std::vector<Section> sections) {
  Sweep row = *began_;
  std::size_t i = 0;
  for (const Section& section : sections)
    if (section.chosen >= 0 && i < row.fits.size()) row.fits[i++].target = section.curve();
  began_ = std::make_shared<const Sweep>(std::move(row));
  sections_ = std::make_shared<const std::vector<Section>>(std::move(sections));
}

bool LiveCut::take(const LiveOrder& order, const RunContext& context) {
  Findings unsaid;
  PlanesRequest planes{{}, order.cut.sections};
  const Result<geometry::Setup> setup = geometry::resolveSetup(
      *order.target,
      {order.placement, order.cut.direction, order.cut.pose, turningOf(order.design, order.cut)}, unsaid);
  if (!setup) return false;
  planes.setup = *setup;
  if (!order.cut.direction && !setup->planes.turns())
    planes.setup.planes = PlaneFamily::across(setup->block, planes_.setup.planes.direction());
  if (planes.sections.byTolerance()) planes.sections.stations = cut_.sections.request.sections.stations;
  const FitRequest& before = began_->request;
  Asked asked{fitRequest(order.design, order.cut, setup->block, before.fitEndpoints && before.fitTangents),
              trialCheckRequest(order.design, order.cut), kerfOf(order.design, order.cut, setup->block)};
  planes.beyond = reachBeyond(asked.fit, bladeOf(order.design, order.cut), setup->block);

  const bool moved = spline_ != order.spline, turned = planes != planes_;
  const auto curvesOf = [&](const SplineSurface& spline) {
    return isoSections(spline, *spline_, *sections_, planes.setup.block);
  };
  const bool across = spline_ && order.spline && planes.beyond == 0 && !planes.setup.planes.turns();
  // Before anything is held against them the curves of the spline take the place of the traced ones, to which
  // they are next to equal: the blades stay on them.
  if (!asked_ && across && !turned && asked.kerf == Kerf())
    if (std::optional<std::vector<Section>> own = curvesOf(*spline_)) beginOn(std::move(*own));
  bool stays = look_ && !turned;
  if (moved || turned) {
    std::optional<std::vector<Section>> sections;
    if (across && !turned) sections = curvesOf(*order.spline);
    if (!sections) {
      Result<std::vector<Section>> traced =
          geometry::cutSections(*order.target, planes.setup, planes.sections, context, unsaid);
      if (!traced) return false;
      if (planes.beyond > 0 &&
          !geometry::followBeyond(*order.target, planes.setup, planes.beyond, *traced, context))
        return false;
      sections = std::move(*traced);
    }
    stays = stays && spline_ && order.spline && sameSections(*sections, *sections_) &&
            !overlap(changedPart(*spline_, *order.spline), look_->feet);
    sections_ = std::make_shared<const std::vector<Section>>(std::move(*sections));
    planes_ = planes;
    spline_ = order.spline;
  }
  made_ = !stays || asked_ != asked;
  if (asked_ != asked) {
    melted_.reset();
    if (!asked.kerf.table.empty())
      melted_ = std::make_shared<const KerfField>(
          KerfField::of(*began_, asked.check.cuttingSpeed, asked.kerf.table));
  }
  asked_ = std::move(asked);
  if (made_) look_.reset();
  return true;
}

bool LiveCut::follow(const LiveOrder& order, const RunContext& context) {
  const std::optional<double> room = roomBelow(order.design, order.cut);
  // As much deeper below its blades as it was for the ways of those.
  const auto standing = [&](const Sweep& row) {
    if (!room) return planes_.setup.block;
    const Sweep& first = *began_;
    const double ways = first.block.size.z() - standingBelow(cut_.setup->block, first.poses, *room).size.z();
    return deeper(standingBelow(planes_.setup.block, row.poses, *room), ways);
  };
  const Box block = standing(sweep_ ? *sweep_ : *began_);
  const PlaneFamily& planes = planes_.setup.planes;
  Findings unsaid;
  // What the middle of the blade is to sweep.
  std::shared_ptr<const std::vector<Section>> sections = sections_;
  MiddleSections middle;
  const Kerf& kerf = asked_->kerf;
  if (kerf != Kerf()) {
    Result<MiddleSections> found =
        middleOf(*order.target, *sections_, planes, kerf, context, unsaid, melted_);
    if (!found) return false;
    middle = std::move(*found);
    sections = std::make_shared<const std::vector<Section>>(std::move(middle.sections));
  }

  // From where the hand began, with what is known there.
  const Sweep& began = *began_;
  const auto begin = [&] {
    row_ = LiveRow::of(began, context);
    const bool held = began.request.extend != Extension::none;
    if (row_ || (held && !sketcher_)) sketcher_.emplace(began, *cut_.certainty.value, *cut_.rest.value);
  };
  const auto follows = [&] {
    return row_ && row_->sweep().request == asked_->fit && row_->follow(*sections, block, planes, context);
  };
  // A hand that was far away, or where nothing followed it, comes back to where blades are known; one that
  // goes on is not laid worse by that.
  const auto wayFrom = [&](const Sweep& row) { return LiveRow::wayTo(row, *sections); };
  bool back = false;
  if (row_) {
    const double way = wayFrom(*sweep_), stride = LiveRow::kStride * began.request.blade.length;
    if (lostAt_ > 0 || way > stride) back = wayFrom(began) < std::max(lostAt_, way);
  }
  const bool onward = row_ && !back;
  if (!onward) begin();
  bool followed = follows();
  if (!followed && onward && !context.stopped() && wayFrom(began) < wayFrom(*sweep_)) {
    begin();
    const double tolerance = asked_->fit.tolerance;
    followed =
        follows() && farthestOf(row_->sweep()) <= std::max(kNear * tolerance, kAsNear * farthestOf(began));
  }
  if (followed && back) lostAt_ = 0;
  if (followed) {
    sweep_ = std::make_shared<const Sweep>(row_->sweep());
  } else {
    row_.reset();
    if (context.stopped()) return false;
    Result<Sweep> anew = buildSweep(*sections, asked_->fit, block, planes, context, unsaid);
    if (!anew) return false;
    sweep_ = std::make_shared<const Sweep>(std::move(*anew));
    row_ = LiveRow::of(*sweep_, context);
    // A row that is held by its sections is found anew each time, in the shapes that it had.
    const bool same =
        asked_->fit.extend != Extension::none && sketcher_ && sketcher_->stations() == sweep_->poses.size();
    if (!same) sketcher_.emplace(*sweep_);
    lostAt_ = wayFrom(began);
  }
  Result<RowSketch> look =
      sketcher_->look(*sweep_, asked_->check, *middleSampler(*order.target, middle, kerf, melted_), context);
  if (!look) return false;
  look->cut = melted_ ? standingBeside(std::move(look->cut), kerf, *melted_)
                      : standingBeside(std::move(look->cut), kerf);
  geometry::Setup placed = planes_.setup;
  if (room) {
    Sweep row = *sweep_;
    placed.block = row.block = standing(row);
    sweep_ = std::make_shared<const Sweep>(std::move(row));
  }
  setup_ = std::make_shared<const geometry::Setup>(std::move(placed));
  look_ = std::make_shared<const RowSketch>(std::move(*look));
  return true;
}

int LiveCut::left() const {
  // Of a row that is divided otherwise, only those within it are known.
  const auto leftOf = [&](const Sweep& row) {
    const bool counted =
        !planes_.sections.spacing && planes_.sections.stations == cut_.sections.request.sections.stations;
    const int within = row.poses.back().index - row.poses.front().index + 1;
    return (counted ? planes_.sections.stations.value_or(within) : within) - int(row.poses.size());
  };
  return sweep_ ? std::max(0, leftOf(*sweep_) - leftOf(*began_)) : 0;
}

}  // namespace bw::pipeline
