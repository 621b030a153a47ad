// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/text/number_text.h"
#include "sentences.h"

namespace bw::words {

namespace {

/// An overload for each remedy, so that none is forgotten.
struct Actions {
  std::string operator()(const OtherLength& r) const {
    return "Use a blade of " + shortText(r.length, 6) + " mm";
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
  std::string operator()(const WiderTolerance& r) const {
    return "Allow " + shortText(r.tolerance, 6) + " mm";
  }
};

}  // namespace

std::string action(const Remedy& remedy) { return std::visit(Actions{}, remedy); }

std::string bendingBladeText(const BendingBlade& blade) {
  std::string text = "a blade that bends to " + shortText(blade.radius) + " mm";
  if (blade.preset.empty()) return text;
  const std::string radius = shortText(blade.presetRadius) + " mm)";
  if (blade.presetBends()) return text + ", such as the " + blade.title + " (" + radius;
  return text + " (none of the presets does; the " + blade.title + " bends farthest, to " + radius;
}

}  // namespace bw::words
