// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "advice.h"

#include <algorithm>
#include <optional>
#include <variant>

namespace bw::pipeline {

namespace {

using Lost = OtherShape::Lost;

template <class T>
bool has(const Remedies& remedies) {
  return remedyOf<T>(remedies) != nullptr;
}

template <class T>
void drop(Remedies& remedies) {
  std::erase_if(remedies, [](const Remedy& remedy) { return std::holds_alternative<T>(remedy); });
}

template <class... T>
bool isOneOf(const Finding& finding) {
  return (std::holds_alternative<T>(finding.cause) || ...);
}

bool isLost(const Finding& finding) {
  const OtherShape* other = std::get_if<OtherShape>(&finding.cause);
  return other && other->lost != Lost::no;
}

/// True for what a blade does that leaves its shape from station to station.
bool leavesOnTheWay(const Finding& finding) { return isOneOf<SnapsOnTheWay, ArrivesOtherwise>(finding); }

/// True for what a blade does that does not rest, or cannot be led where it does.
bool restFails(const Finding& finding) {
  return isLost(finding) || leavesOnTheWay(finding) || isSnapByGrip(finding) ||
         isOneOf<WouldSnap, WouldTwist, LowMargin, SnapsInWeight, NoWay>(finding);
}

/// True for what a blade of another length may mend.
bool isOfLength(const Finding& finding) {
  return isOneOf<Overbent, BladeCrosses, GripTooNear>(finding) || restFails(finding);
}

/// True for what a blade of another length is advised against by what stations need, each for itself.
bool advisesLength(const Finding& finding) {
  return has<OtherLength>(finding.remedies) && !fallsLittleShort(finding) && isOfLength(finding);
}

/// True for what a blade does that rests too little firmly.
bool restsLoosely(const Finding& finding) {
  const OtherShape* other = std::get_if<OtherShape>(&finding.cause);
  return (other && (other->lost == Lost::lowMargin || other->lost == Lost::lowBarrier)) ||
         leavesOnTheWay(finding) || isSnapByGrip(finding) || isOneOf<WouldSnap, WouldTwist, NoWay>(finding);
}

/// True for a grip too near to the block that no longer blade takes away from it.
bool staysTooNear(const Finding& finding) {
  return isOneOf<GripTooNear>(finding) && !has<OtherLength>(finding.remedies);
}

bool anyOf(const CutEvaluation& cut, bool (*what)(const Finding&)) {
  for (const Findings* list : {&cut.analysis.findings, &cut.way.findings, &cut.ends.findings,
                               &cut.rest.findings, &cut.simulated.findings, &cut.barriers.findings})
    if (std::ranges::any_of(*list, what)) return true;
  return false;
}

/// True for what is not cut, or too far off, for what no length of a blade decides.
bool staysWithLength(const Finding& finding) {
  const FindingKind kind = finding.kind();
  return finding.severity != Severity::info && (kind == FindingKind::coverage || kind == FindingKind::gap ||
                                                isOneOf<TooFarOnTheWay, OffTheSurfaceShown>(finding));
}

/// What is known of lengths, so that it may be advised: that one serves is known when its design is computed.
const BladeLengths* knownLengths(const CutEvaluation& cut) {
  const BladeLengths* lengths = cut.lengths.value.get();
  return lengths && (!lengths->best || lengths->designed) ? lengths : nullptr;
}

/// What serves with grips nearer to the block, where nothing does with the clearance asked for; else null.
const RowTrial* nearerGrips(const CutEvaluation& cut) {
  if (!cut.lengths.value || cut.lengths.value->best || !cut.clearances.value) return nullptr;
  return cut.clearances.value->best ? &*cut.clearances.value->best : nullptr;
}

OtherClearance remedyBy(const RowTrial& trial, const CutEvaluation& cut) {
  const Blade& asked = cut.clearances.request.lengths.fit.blade;
  OtherClearance remedy{trial.clearance};
  if (asked.autoLength || trial.length != asked.length) remedy.length = trial.length;
  return remedy;
}

/// The margin that serves in place of the one asked for.
std::optional<double> otherMargin(const CutEvaluation& cut) {
  if (!cut.margins.value) return {};
  const std::optional<double>& best = cut.margins.value->best;
  return best && *best != cut.margins.request.lengths.check.margin ? best : std::nullopt;
}

}  // namespace

bool fallsLittleShort(const Finding& finding) {
  constexpr double kLittle = 0.9;  // of what is asked for
  const LowMargin* low = std::get_if<LowMargin>(&finding.cause);
  const std::optional<StationRange>& at = finding.where.stations;
  return low && at && at->count == 0 && low->margin > kLittle * low->asked;
}

bool lengthFails(const CutEvaluation& cut) {
  if (!cut.rest.value || !cut.sweep.value) return false;
  if (std::ranges::find(cut.rest.value->stations, Rest::lost) != cut.rest.value->stations.end()) return true;
  if (anyOf(cut, &staysTooNear) || anyOf(cut, &leavesOnTheWay) || hasErrors(cut.ends.findings)) return true;
  if (anyOf(cut, &advisesLength)) return true;
  // Between the stations its run tells.
  if (std::ranges::any_of(cut.barriers.findings, [](const Finding& finding) {
        return restFails(finding) && !fallsLittleShort(finding);
      }))
    return true;
  constexpr double kBent = 0.95;  // of the sharpest bend: less is held by its margin
  const Sweep& sweep = *cut.sweep.value;
  const double sharpest = kBent * sweep.request.blade.maxCurvature();
  for (std::size_t i = 0; i < sweep.fits.size(); ++i)
    if (sweep.fits[i].heldBack && sweep.fits[i].fit.hausdorff > sweep.request.tolerance &&
        sweep.poses[i].blade.maxCurvature() < sharpest)
      return true;
  return false;
}

bool clearanceMayHelp(const CutEvaluation& cut, const Blade& blade) {
  if (!cut.lengths.value || cut.lengths.value->best) return false;
  return blade.autoLength || lengthFails(cut);
}

bool marginFails(const CutEvaluation& cut) { return cut.rest.value && anyOf(cut, &restsLoosely); }

Findings lengthFindings(const CutEvaluation& cut, const Blade& blade) {
  const BladeLengths* known = knownLengths(cut);
  if (!known || known->trials.empty() || !cut.rest.value) return {};
  const BladeLengths& lengths = *known;
  if (!blade.autoLength && !lengthFails(cut)) return {};
  using Said = ServingLengths::Said;
  ServingLengths cause{blade.autoLength ? Said::nearest : Said::none, blade.length,
                       lengths.trials.front().length, lengths.trials.back().length};
  Remedies remedies;
  if (const std::optional<double>& best = lengths.best) {
    cause.said = blade.autoLength ? Said::taken : Said::others;
    cause.best = *best;
    for (const Findings* told : {&cut.analysis.findings, &cut.coverage.findings, &cut.way.findings,
                                 &cut.motion.findings, &cut.simulated.findings})
      cause.atStationsAlone =
          cause.atStationsAlone ||
          (blade.autoLength ? exceedsLimit(*told) : std::ranges::any_of(*told, &staysWithLength));
    for (const BladeLengths::Band& band : lengths.bands())
      if (band.from <= cause.best && cause.best <= band.to) {
        cause.from = band.from;
        cause.to = band.to;
      }
    if (!blade.autoLength && cause.best != blade.length) remedies = {OtherLength{cause.best}};
  } else {
    if (cut.clearances.value) cause.leastClearance = cut.clearances.value->least();
    if (const RowTrial* trial = nearerGrips(cut)) remedies.push_back(remedyBy(*trial, cut));
    if (const std::optional<double> margin = otherMargin(cut); margin && marginFails(cut))
      remedies.push_back(OtherMargin{*margin});
  }
  return {{cause.said == Said::nearest ? Severity::error : Severity::info, cause, {}, remedies}};
}

void adviseLength(Findings& findings, const CutEvaluation& cut, const Blade& blade) {
  const BladeLengths* known = knownLengths(cut);
  if (!known) return;
  const std::optional<double>& best = known->best;
  for (Finding& finding : findings) {
    if (!isOfLength(finding)) continue;
    if (const OtherLength* longer = remedyOf<OtherLength>(finding.remedies); longer && !best)
      if (GripTooNear* near = std::get_if<GripTooNear>(&finding.cause)) near->unheldLength = longer->length;
    drop<OtherLength>(finding.remedies);
    if (best && *best != blade.length) finding.remedies.insert(finding.remedies.begin(), OtherLength{*best});
    if ((isLost(finding) || leavesOnTheWay(finding) || isSnapByGrip(finding) || isOneOf<NoWay>(finding)) &&
        !best)
      finding.remedies.push_back(CutInParts{});
  }
}

void adviseClearance(Findings& findings, const CutEvaluation& cut) {
  const RowTrial* trial = nearerGrips(cut);
  if (!trial) return;
  for (Finding& finding : findings) {
    if (!restFails(finding) && !staysTooNear(finding)) continue;
    drop<CutInParts>(finding.remedies);
    finding.remedies.push_back(remedyBy(*trial, cut));
  }
}

void adviseMargin(Findings& findings, const CutEvaluation& cut) {
  const std::optional<double> best = otherMargin(cut);
  if (!best) return;
  for (Finding& finding : findings) {
    if (!restsLoosely(finding)) continue;
    drop<CutInParts>(finding.remedies);
    finding.remedies.push_back(OtherMargin{*best});
  }
}

void adviseUnrested(Findings& findings, const CutEvaluation& cut) {
  const bool lost = cut.rest.value && std::ranges::count(cut.rest.value->stations, Rest::lost) > 0;
  if (!lost && std::ranges::none_of(findings, leavesOnTheWay)) return;
  for (Finding& finding : findings) {
    auto* far = std::get_if<TooFarOnTheWay>(&finding.cause);
    auto* off = std::get_if<OffTheSurfaceShown>(&finding.cause);
    if (!far && !off) continue;
    (far ? far->unrested : off->unrested) = true;
    drop<MoreStations>(finding.remedies);
  }
}

}  // namespace bw::pipeline
