// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/maps.h"

#include <algorithm>
#include <array>

namespace bw {

namespace {

constexpr std::array<MapInfo, 6> kMaps = {{{"deviation", "Deviation", "mm", MapRule::banded},
                                           {"angle", "Cutting angle", "°", MapRule::plain, 1},
                                           {"speed", "Blade speed", "mm/s"},
                                           {"relative_speed", "Relative speed", "", MapRule::share},
                                           {"curvature", "Curvature / limit", ""},
                                           {"stress", "Bending stress", "N/mm²"}}};

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

}  // namespace bw
