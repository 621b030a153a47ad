// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/maps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/base/units.h"

namespace bw {

namespace {

constexpr double kMostMoved = 100;  // mm: where a blade is about to snap it has no limit

constexpr std::array kRests = {"lost", "unknown", "held", "certain"};  // as certaintyField numbers them

constexpr std::array<MapInfo, 9> kMaps = {
    {{"deviation", "Deviation", "mm", [](const CutSample& s) { return s.deviation; }, MapRule::banded},
     {"angle", "Cutting angle", "°", [](const CutSample& s) { return toDegrees(s.angle); }, MapRule::plain,
      1},
     {"speed", "Blade speed", "mm/s", [](const CutSample& s) { return s.speed; }},
     {"relative_speed", "Relative speed", "", [](const CutSample& s) { return s.relativeSpeed; },
      MapRule::share},
     {"curvature",
      "Curvature / limit",
      "",
      [](const CutSample& s) { return s.curvature; },
      MapRule::plain,
      1e-3,
      {},
      true,
      true},
     {"stress",
      "Bending stress",
      "N/mm²",
      [](const CutSample& s) { return s.stress; },
      MapRule::plain,
      1e-3,
      {},
      true,
      true},
     {"grip_error", "Moved by grip errors", "mm",
      [](const CutSample& s) { return s.movedByGrip < kMostMoved ? s.movedByGrip : kMostMoved; }},
     {"certainty", "Certainty", "", nullptr, MapRule::words, 1, kRests},
     {"crease", "Crease off", "mm", nullptr, MapRule::plain, 1e-3, {}, false}}};

}  // namespace

std::span<const MapInfo> cutMaps() { return kMaps; }

const MapInfo* cutMap(std::string_view name) {
  const auto found = std::ranges::find_if(kMaps, [&](const MapInfo& map) { return name == map.name; });
  return found == kMaps.end() ? nullptr : &*found;
}

MapRule mapRule(std::string_view name) {
  const MapInfo* map = cutMap(name);
  return map ? map->rule : MapRule::plain;
}

const char* mapWord(std::string_view name, double value) {
  const MapInfo* map = cutMap(name);
  if (!map || map->words.empty() || !std::isfinite(value)) return nullptr;
  return map->words[std::size_t(std::clamp(value, 0.0, double(map->words.size() - 1)) + 0.5)];
}

}  // namespace bw
