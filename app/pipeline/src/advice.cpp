// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "advice.h"

#include <algorithm>
#include <optional>
#include <variant>

namespace bw::pipeline {

bool lengthFails(const CutEvaluation& cut) {
  if (!cut.rest.value || !cut.sweep.value) return false;
  if (std::ranges::find(cut.rest.value->stations, Rest::lost) != cut.rest.value->stations.end()) return true;
  constexpr double kBent = 0.95;  // of the sharpest bend: less is held by its margin
  const Sweep& sweep = *cut.sweep.value;
  const double sharpest = kBent * sweep.request.blade.maxCurvature();
  for (std::size_t i = 0; i < sweep.fits.size(); ++i)
    if (sweep.fits[i].heldBack && sweep.fits[i].fit.hausdorff > sweep.request.tolerance &&
        sweep.poses[i].blade.maxCurvature() < sharpest)
      return true;
  return false;
}

bool marginFails(const CutEvaluation& cut) {
  using Lost = OtherShape::Lost;
  return cut.rest.value && std::ranges::any_of(cut.rest.value->findings, [](const Finding& finding) {
           const OtherShape* other = std::get_if<OtherShape>(&finding.cause);
           return other && (other->lost == Lost::lowMargin || other->lost == Lost::lowBarrier);
         });
}

Findings lengthFindings(const CutEvaluation& cut, const Blade& blade) {
  if (!cut.lengths.value || !cut.rest.value) return {};
  const BladeLengths& lengths = *cut.lengths.value;
  if (!blade.autoLength && !lengthFails(cut)) return {};
  using Said = ServingLengths::Said;
  if (lengths.trials.empty()) return {};
  ServingLengths cause{blade.autoLength ? Said::nearest : Said::none, blade.length,
                       lengths.trials.front().length, lengths.trials.back().length};
  Remedies remedies;
  if (lengths.best) {
    cause.said = blade.autoLength ? Said::taken : Said::others;
    cause.best = *lengths.best;
    for (const BladeLengths::Band& band : lengths.bands())
      if (band.from <= cause.best && cause.best <= band.to) {
        cause.from = band.from;
        cause.to = band.to;
      }
    if (!blade.autoLength && cause.best != blade.length) remedies = {OtherLength{cause.best}};
  }
  return {{cause.said == Said::nearest ? Severity::error : Severity::info, cause, {}, remedies}};
}

void adviseLength(Findings& findings, const CutEvaluation& cut, const Blade& blade) {
  if (!cut.lengths.value) return;
  const std::optional<double>& best = cut.lengths.value->best;
  const auto ofShape = [](const Finding& finding) {
    return std::holds_alternative<WouldSnap>(finding.cause) ||
           std::holds_alternative<WouldTwist>(finding.cause) ||
           std::holds_alternative<LowMargin>(finding.cause) ||
           std::holds_alternative<SnapsInWeight>(finding.cause);
  };
  for (Finding& finding : findings) {
    const OtherShape* other = std::get_if<OtherShape>(&finding.cause);
    const bool lost = other && other->lost != OtherShape::Lost::no;
    if (!lost && !ofShape(finding)) continue;
    std::erase_if(finding.remedies, [](const Remedy& r) { return std::holds_alternative<OtherLength>(r); });
    if (best && *best != blade.length) finding.remedies.insert(finding.remedies.begin(), OtherLength{*best});
    if (lost && !best) finding.remedies.push_back(CutInParts{});
  }
}

void adviseMargin(Findings& findings, const CutEvaluation& cut) {
  using Lost = OtherShape::Lost;
  if (!cut.margins.value || !cut.margins.value->best) return;
  const double best = *cut.margins.value->best;
  if (best == cut.margins.request.lengths.check.margin) return;
  for (Finding& finding : findings)
    if (const OtherShape* other = std::get_if<OtherShape>(&finding.cause);
        other && (other->lost == Lost::lowMargin || other->lost == Lost::lowBarrier)) {
      std::erase_if(finding.remedies, [](const Remedy& r) { return std::holds_alternative<CutInParts>(r); });
      finding.remedies.push_back(OtherMargin{best});
    }
}

}  // namespace bw::pipeline
