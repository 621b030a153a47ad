// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/words/findings.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "bw/core/text/number_text.h"
#include "sentences.h"

namespace bw::words {

namespace {

constexpr std::pair<FindingKind, const char*> kWords[] = {{FindingKind::fit, "fit"},
                                                          {FindingKind::fitBounded, "fit-bounded"},
                                                          {FindingKind::curvature, "curvature"},
                                                          {FindingKind::inflections, "inflections"},
                                                          {FindingKind::stability, "stability"},
                                                          {FindingKind::outOfPlane, "out-of-plane"},
                                                          {FindingKind::coverage, "coverage"},
                                                          {FindingKind::crossing, "crossing"},
                                                          {FindingKind::keyBlades, "key-blades"},
                                                          {FindingKind::certainty, "certainty"},
                                                          {FindingKind::entry, "entry"},
                                                          {FindingKind::lead, "lead"},
                                                          {FindingKind::motion, "motion"},
                                                          {FindingKind::weight, "weight"},
                                                          {FindingKind::length, "length"},
                                                          {FindingKind::gripErrors, "grip-errors"},
                                                          {FindingKind::clearance, "clearance"},
                                                          {FindingKind::floor, "floor"},
                                                          {FindingKind::angle, "angle"},
                                                          {FindingKind::speed, "speed"},
                                                          {FindingKind::swing, "swing"},
                                                          {FindingKind::gap, "gap"},
                                                          {FindingKind::deviation, "deviation"},
                                                          {FindingKind::skin, "skin"},
                                                          {FindingKind::sectionShort, "section-short"},
                                                          {FindingKind::sectionMissing, "section-missing"},
                                                          {FindingKind::sectionBranches, "section-branches"},
                                                          {FindingKind::sectionClosed, "section-closed"},
                                                          {FindingKind::sectionBridged, "section-bridged"},
                                                          {FindingKind::sectionBorder, "section-border"},
                                                          {FindingKind::sectionFit, "section-fit"},
                                                          {FindingKind::sectionRoute, "section-route"},
                                                          {FindingKind::kerf, "kerf"},
                                                          {FindingKind::face, "face"},
                                                          {FindingKind::direction, "direction"},
                                                          {FindingKind::leftOut, "left-out"},
                                                          {FindingKind::healing, "healing"},
                                                          {FindingKind::source, "source"},
                                                          {FindingKind::joint, "joint"},
                                                          {FindingKind::blocks, "blocks"},
                                                          {FindingKind::crease, "crease"},
                                                          {FindingKind::cuts, "cuts"},
                                                          {FindingKind::part, "part"},
                                                          {FindingKind::cell, "cell"},
                                                          {FindingKind::cellSides, "cell-sides"},
                                                          {FindingKind::program, "program"},
                                                          {FindingKind::programCheck, "rapid"},
                                                          {FindingKind::run, "run"}};

/// An overload for each remedy, so that none is forgotten.
struct Actions {
  std::string operator()(const OtherLength& r) const {
    return "Use a blade of " + shortText(r.length, 6) + " mm";
  }
  std::string operator()(const OtherMargin& r) const {
    return "Ask for a margin of " + shortText(r.margin, 2);
  }
  std::string operator()(const OtherClearance& r) const {
    return "Allow a clearance of " + shortText(r.clearance, 4) + " mm" +
           (r.length ? " with a blade of " + shortText(*r.length, 6) + " mm" : std::string());
  }
  std::string operator()(const BendingBlade& r) const {
    return r.presetBends() ? "Use " + r.title : std::string();
  }
  std::string operator()(const FlatBlade& r) const {
    return r.preset.empty() ? std::string() : "Use " + r.title;
  }
  std::string operator()(const LargerSurface&) const { return {}; }
  std::string operator()(const OtherBlock&) const { return {}; }
  std::string operator()(const CutInParts&) const { return {}; }
  std::string operator()(const MoreStations& r) const {
    return "Take " + std::to_string(r.count) + " stations";
  }
  std::string operator()(const TurnDirection&) const { return "Search the direction"; }
  std::string operator()(const OtherCell& r) const { return "Take the cell " + r.title; }
  std::string operator()(const WiderTolerance& r) const {
    return "Allow " + shortText(r.tolerance, 6) + " mm";
  }
};

}  // namespace

std::string kindWord(const Finding& finding) {
  if (const auto* breach = std::get_if<ProgramBreach>(&finding.cause)) return breach->rule;
  return std::ranges::find(kWords, finding.kind(), &std::pair<FindingKind, const char*>::first)->second;
}

std::string placeText(const Finding& finding) {
  if (finding.where.stations) return stationName(finding.where.stations->worst);
  if (const auto* side = std::get_if<WrongSide>(&finding.cause))
    return side->atStart ? "start of the cut" : "end of the cut";
  if (const auto* breach = std::get_if<ProgramBreach>(&finding.cause)) return breach->place;
  if (const auto* mismatch = std::get_if<RunMismatch>(&finding.cause)) return mismatch->file;
  return {};
}

std::string partName(const Place& place) {
  const auto& [stations, point, block, cut] = place;
  // Cuts of a grid have their block in their names.
  const bool both = !block.empty() && !cut.empty() && !cut.ends_with("-" + block);
  return both ? block + ", " + cut : cut.empty() ? block : cut;
}

namespace {

std::string inPart(const Finding& finding, const std::string& text) {
  const std::string part = partName(finding.where);
  return part.empty() ? text : part + ": " + text;
}

}  // namespace

std::string sentence(const Finding& finding, Reader reader) {
  return inPart(finding, std::visit(Sentences{finding, reader}, finding.cause));
}

std::string listed(const Finding& finding, Reader reader) {
  std::string text = std::visit(Sentences{finding, reader}, finding.cause);
  if (const std::string place = placeText(finding); !place.empty() && !finding.where.stations)
    text = place + ": " + text;
  if (!text.empty()) text[0] = char(std::toupper(static_cast<unsigned char>(text[0])));
  return inPart(finding, text);
}

std::vector<std::string> errorsOf(const Findings& findings, Reader reader) {
  std::vector<std::string> errors;
  for (const Finding& finding : findings)
    if (finding.severity == Severity::error && finding.kind() != FindingKind::program)
      errors.push_back(sentence(finding, reader));
  return errors;
}

std::string rangeText(const StationRange& range) {
  if (range.first == range.last) return stationName(range.first);
  const std::string ends = std::to_string(range.first + 1) + " to " + std::to_string(range.last + 1);
  const bool all = range.count == range.last - range.first + 1;
  return (all ? "stations " : std::to_string(range.count) + " of the stations ") + ends;
}

std::string Sentences::at() const {
  const StationRange& range = *finding.where.stations;
  if (range.first == range.last) return rangeText(range) + ": ";
  return rangeText(range) + " (worst: " + std::to_string(range.worst + 1) + "): ";
}

std::string Sentences::leftOut(const std::string& one, const std::string& several) const {
  return rangeText(*finding.where.stations) +
         (single() ? " is left out: its " + one : " are left out: their " + several);
}

std::string action(const Remedy& remedy) { return std::visit(Actions{}, remedy); }

std::string bendingBladeText(const BendingBlade& blade) {
  std::string text = "a blade that bends to " + shortText(blade.radius) + " mm";
  if (blade.preset.empty()) return text;
  const std::string radius = shortText(blade.presetRadius) + " mm)";
  if (blade.presetBends()) return text + ", such as the " + blade.title + " (" + radius;
  return text + " (none of the presets does; the " + blade.title + " bends farthest, to " + radius;
}

}  // namespace bw::words
