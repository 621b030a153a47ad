// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// Where a finding is (what is selected, framed and marked for it), and what its remedies change in the
// design.
#include <algorithm>
#include <cmath>

#include "bw/core/text/number_text.h"
#include "bw/core/text/printable.h"
#include "bw/pipeline/lower_block.h"
#include "bw/pipeline/speed_remedies.h"
#include "workbench/block_layout.h"
#include "workbench/joint_stations.h"
#include "workbench/workbench.h"

namespace bw::app {

namespace {

/// How far a point lies inside the block, mm; negative outside.
double depthIn(const Box& block, const Eigen::Vector3d& point) {
  const Eigen::Array3d p = block.frame.toLocal(point).array();
  return std::min(p.minCoeff(), (block.size.array() - p).minCoeff());
}

/// The point of a station that a finding of that kind is about.
Eigen::Vector3d pointOf(FindingKind kind, const BladePose& station, const Box& block) {
  if (kind == FindingKind::clearance) {
    const Eigen::Vector3d left = station.leftPoint(), right = station.rightPoint();
    return depthIn(block, left) >= depthIn(block, right) ? left : right;
  }
  if (kind == FindingKind::curvature) {
    // Where the blade bends most.
    constexpr int kSteps = 200;
    double arc = 0.5 * station.blade.length(), most = -1;
    for (int i = 0; i <= kSteps; ++i) {
      const double s = station.blade.length() * i / kSteps, bend = std::abs(station.blade.at(s).curvature);
      if (bend > most) {
        most = bend;
        arc = s;
      }
    }
    return station.frame.toWorld(station.blade.point(arc));
  }
  return station.frame.toWorld(station.cut.point(0.5 * station.cut.length()));
}

Selection::Kind partOf(FindingKind kind) {
  switch (model::stepOf(kind)) {
    case model::Step::input:
      return Selection::Kind::surface;
    case model::Step::setup:
      return Selection::Kind::block;
    default:
      return kind == FindingKind::curvature ? Selection::Kind::blade : Selection::Kind::result;
  }
}

void takePreset(Design& design, const std::string& name) {
  Result<Blade> blade = bladePreset(name);
  if (!blade) return;
  blade->length = design.blade.length;
  blade->autoLength = design.blade.autoLength;
  design.blade = std::move(*blade);
}

/// An overload for each remedy; those that only a person can do change nothing.
struct Mend {
  Design& design;
  Cut& cut;

  void operator()(const OtherLength& remedy) const {
    if (cut.length) {
      cut.length = remedy.length;
      return;
    }
    design.blade.length = remedy.length;
    design.blade.autoLength = false;
  }
  void operator()(const OtherMargin& remedy) const { design.process.margin = remedy.margin; }
  void operator()(const OtherClearance& remedy) const {
    design.process.clearance = remedy.clearance;
    if (remedy.length) operator()(OtherLength{*remedy.length});
  }
  void operator()(const BendingBlade& remedy) const {
    if (remedy.presetBends()) takePreset(design, remedy.preset);
  }
  void operator()(const FlatBlade& remedy) const {
    if (!remedy.preset.empty()) takePreset(design, remedy.preset);
  }
  void operator()(const LargerSurface&) const {}
  void operator()(const OtherBlock&) const {}
  void operator()(const CutInParts&) const {}
  void operator()(const MoreStations& remedy) const {
    cut.sections.stations = remedy.count;
    cut.sections.spacing.reset();
  }
  void operator()(const TurnDirection&) const {
    if (!design.grid) cut.direction.reset();  // its blocks are cut along their rows
  }
  void operator()(const OtherCell& remedy) const { design.output.cell = remedy.name; }
  void operator()(const WiderTolerance& remedy) const { design.process.tolerance = remedy.tolerance; }
};

}  // namespace

void Workbench::showPlace(const Message& message) {
  const Place place = message.finding ? message.finding->where : Place{};
  // Numbers of stations, and what a remedy changes, are those of its cut.
  const auto concerned = std::ranges::find_if(design().cuts, [&place](const Cut& own) {
    return place.cut.empty() ? own.block == place.block : own.id == place.cut;
  });
  if (concerned != design().cuts.end() && (!place.cut.empty() || concerned->block != cut().block))
    select({Selection::Kind::result, -1, concerned->block, concerned->id});
  const auto result = sweep();
  Spot spot{message.severity, message.text, {}, {}};
  const auto add = [&](const Box& block) {
    for (const Eigen::Vector3d& corner : block.corners())
      if (corner.allFinite()) spot.bounds.add(corner);
  };
  if (place.point && place.point->allFinite()) spot.point = place.point;
  const BladePose* station = nullptr;
  if (place.stations && result) {
    const auto& stations = result->sweep.poses;
    const auto found = std::ranges::find(stations, place.stations->worst, &BladePose::index);
    if (found != stations.end()) {
      station = &*found;
      selectStation(int(found - stations.begin()));
    }
  }
  if (station) {
    const FindingKind kind = message.finding->kind();
    const bool middleOnly =
        kind == FindingKind::clearance || std::holds_alternative<Overbent>(message.finding->cause);
    if (!spot.point || middleOnly) spot.point = pointOf(kind, *station, result->sweep.block);
    for (const Eigen::Vector2d& p : station->blade.sample(33)) spot.bounds.add(station->frame.toWorld(p));
  } else if (!place.stations) {
    // What failed lies in the step that was not finished; where no plane meets the target, in the block.
    const auto& newest = runner_.evaluation();
    const model::Step failed =
        model::failedStep(newest.get(), newest ? newest->find(selection_.cut) : nullptr);
    select({message.finding                 ? partOf(message.finding->kind())
            : failed == model::Step::input  ? Selection::Kind::surface
            : block().placement.has_value() ? Selection::Kind::block
                                            : Selection::Kind::result,
            -1});
  }
  const pipeline::CutEvaluation* cut = shownCut();
  // The block as the person placed it, where no result has one.
  if (block().placement) {
    add(block().placement->box());
    if (!spot.point && selection_.kind == Selection::Kind::block) {
      const Box box = block().placement->box();
      spot.point = box.frame.toWorld(0.5 * box.size.head<2>(), 0.5 * box.size.z());
    }
  } else if (cut && cut->setup) {
    add(cut->block());
  }
  if (!station && cut && cut->target.value) {
    spot.bounds.add(cut->target.value->bounds().min);
    spot.bounds.add(cut->target.value->bounds().max);
  }
  if (spot.point) spot.bounds.add(*spot.point);
  emit spotShown(spot);
}

bool Workbench::canApply(const Remedy& remedy) const {
  Design changed = design();
  std::visit(Mend{changed, cutOf(changed)}, remedy);
  return changed != design();
}

std::vector<Offer> Workbench::offersOf(const Message& message) const {
  std::vector<Offer> offers;
  // How blocks meet is no matter of the cut selected alone.
  const bool joint = message.finding && message.finding->kind() == FindingKind::joint;
  for (const Remedy& remedy : message.remedies)
    if (!joint && canApply(remedy))
      offers.push_back({QString::fromStdString(words::action(remedy)), [this, remedy](Design& design) {
                          std::visit(Mend{design, cutOf(design)}, remedy);
                        }});
  if (!message.finding) return offers;
  for (std::optional<Offer> offer : {offerStations(*message.finding), offerSplit(*message.finding),
                                     offerPlanes(*message.finding), offerLowerBlock(*message.finding)})
    if (offer) offers.push_back(std::move(*offer));
  return offers;
}

std::optional<Offer> Workbench::offerStations(const Finding& finding) const {
  const auto& newest = runner_.evaluation();
  const auto stations = newest ? stationsForJoint(*newest, finding) : std::nullopt;
  if (!stations || stations->in(design()) == design()) return {};
  const int blocks = stations->blocks, count = stations->count;
  return Offer{blocks == 2 ? tr("Take %1 stations in both blocks").arg(count)
                           : tr("Take %1 stations in the %2 blocks that meet").arg(count).arg(blocks),
               [stations](Design& design) { design = stations->in(design); }};
}

std::optional<Offer> Workbench::offerSplit(const Finding& finding) const {
  const UnevenSpeed* uneven = std::get_if<UnevenSpeed>(&finding.cause);
  const auto& newest = runner_.evaluation();
  const pipeline::CutEvaluation* own = newest ? newest->find(cut().id) : nullptr;
  if (!uneven || uneven->parts.empty() || !own || !own->speeds.value || !own->speeds.value->split) return {};
  const auto& [before, split, parts] = *own->speeds.value->split;
  // What it was computed for may be another design by now.
  if (gridOf(*this) != before || !pipeline::withSplit(design(), before, split.grid, block().id)) return {};
  const QString which = before.count() == 1 ? tr("the block") : tr("the blocks in line");
  return Offer{tr("Split %1 in %2 across the blade").arg(which).arg(parts.size()),
               [before, grid = split.grid, id = block().id](Design& design) {
                 if (std::optional<Design> parted = pipeline::withSplit(design, before, grid, id))
                   design = std::move(*parted);
               }};
}

std::optional<Offer> Workbench::offerPlanes(const Finding& finding) const {
  const UnevenSpeed* uneven = std::get_if<UnevenSpeed>(&finding.cause);
  if (!uneven || !uneven->planes) return {};
  const Design other = pipeline::withPlanes(design(), cut().id, *uneven->planes);
  if (other == design()) return {};
  return Offer{
      uneven->planes->turning ? tr("Turn the planes with the key blades") : tr("Take parallel planes"),
      [planes = *uneven->planes, id = cut().id](Design& design) {
        design = pipeline::withPlanes(design, id, planes);
      }};
}

std::optional<Offer> Workbench::offerLowerBlock(const Finding& finding) const {
  const NearBottom* low = std::get_if<NearBottom>(&finding.cause);
  if (!low || low->lower != NearBottom::Lower::keeps) return {};
  const double by = low->lowerBy;
  if (!pipeline::withLowerBlock(design(), cut().id, by)) return {};
  const QString which = design().stock.size() == 1 ? tr("the block")
                        : design().grid            ? tr("the blocks")
                                                   : QString::fromStdString(printable(block().id));
  const QString text = tr("Let %1 reach %2 mm lower").arg(which, QString::fromStdString(fixedText(by, 0)));
  return Offer{text, [id = cut().id, by](Design& design) {
                 if (std::optional<Design> lower = pipeline::withLowerBlock(design, id, by))
                   design = std::move(*lower);
               }};
}

void Workbench::apply(const Remedy& remedy) {
  editDesign(QString::fromStdString(words::action(remedy)), [&](Design& design) {
    std::visit(Mend{design, cutOf(design)}, remedy);
  });
  if (std::holds_alternative<TurnDirection>(remedy)) directionAsked_ = cut().id;
}

void Workbench::tellDirection() {
  const std::string asked = std::exchange(directionAsked_, {});
  const pipeline::CutEvaluation* made =
      asked.empty() || !runner_.evaluation() ? nullptr : runner_.evaluation()->find(asked);
  if (!made || !made->directions.value) return;
  const pipeline::DirectionSearch& search = *made->directions.value;
  const QString best = QString::fromStdString(search.trials[search.chosen].name);
  tell(Topic::evaluation, Severity::info,
       search.trials.size() == 1
           ? tr("The direction was searched: it goes along the %1, and no other can be clearly better.")
                 .arg(best)
       : search.chosen == 0
           ? tr("%1 directions were tried; none is clearly better than the %2, along which it goes.")
                 .arg(search.trials.size())
                 .arg(best)
           : tr("%1 directions were tried; it goes along the %2 now, the best of them.")
                 .arg(search.trials.size())
                 .arg(best));
}

}  // namespace bw::app
