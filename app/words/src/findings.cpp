// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/words/findings.h"

#include <algorithm>
#include <cctype>

#include "bw/core/text/number_text.h"
#include "sentences.h"

namespace bw::words {

namespace {

const char* wordOf(FindingKind kind) {
  switch (kind) {
    case FindingKind::fit:
      return "fit";
    case FindingKind::fitBounded:
      return "fit-bounded";
    case FindingKind::fitSteadied:
      return "fit-steadied";
    case FindingKind::curvature:
      return "curvature";
    case FindingKind::inflections:
      return "inflections";
    case FindingKind::stability:
      return "stability";
    case FindingKind::outOfPlane:
      return "out-of-plane";
    case FindingKind::clearance:
      return "clearance";
    case FindingKind::angle:
      return "angle";
    case FindingKind::speed:
      return "speed";
    case FindingKind::swing:
      return "swing";
    case FindingKind::gap:
      return "gap";
    case FindingKind::deviation:
      return "deviation";
    case FindingKind::skin:
      return "skin";
    case FindingKind::sectionShort:
      return "section-short";
    case FindingKind::sectionMissing:
      return "section-missing";
    case FindingKind::sectionBranches:
      return "section-branches";
    case FindingKind::sectionClosed:
      return "section-closed";
    case FindingKind::sectionBorder:
      return "section-border";
    case FindingKind::sectionFit:
      return "section-fit";
    case FindingKind::sectionRoute:
      return "section-route";
    case FindingKind::face:
      return "face";
    case FindingKind::direction:
      return "direction";
    case FindingKind::leftOut:
      return "left-out";
    case FindingKind::healing:
      return "healing";
    case FindingKind::source:
      return "source";
    case FindingKind::cell:
      return "cell";
    case FindingKind::cellSides:
      return "cell-sides";
    case FindingKind::program:
      return "program";
    case FindingKind::programCheck:
      return "rapid";
    case FindingKind::run:
      return "run";
  }
  return "";
}

}  // namespace

std::string kindWord(const Finding& finding) {
  if (const auto* breach = std::get_if<ProgramBreach>(&finding.cause)) return breach->rule;
  return wordOf(finding.kind());
}

std::string placeText(const Finding& finding) {
  if (finding.where.stations) return stationName(finding.where.stations->worst);
  if (const auto* side = std::get_if<WrongSide>(&finding.cause))
    return side->atStart ? "start of the cut" : "end of the cut";
  if (const auto* breach = std::get_if<ProgramBreach>(&finding.cause)) return breach->place;
  if (const auto* mismatch = std::get_if<RunMismatch>(&finding.cause)) return mismatch->file;
  return {};
}

std::string sentence(const Finding& finding, Reader reader) {
  return std::visit(Sentences{finding, reader}, finding.cause);
}

std::string listed(const Finding& finding, Reader reader) {
  std::string text = sentence(finding, reader);
  if (const std::string place = placeText(finding); !place.empty() && !finding.where.stations)
    text = place + ": " + text;
  if (!text.empty()) text[0] = char(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
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

}  // namespace bw::words
