// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/blade_bindings.h"

#include <cmath>
#include <string_view>
#include <variant>

#include "bw/core/shape/blade_ends.h"

namespace bw {

void freeRivals(std::map<std::string, BoundNumber>& bindings, const std::string& place) {
  constexpr std::string_view kList = "/surface/blades/";
  const std::size_t list = place.find(kList);
  if (list == std::string::npos) return;
  const std::size_t end = place.find('/', list + kList.size());
  if (end == std::string::npos) return;
  const std::string blade = place.substr(0, end);
  const auto isOf = [&blade](const std::string& pointer, const char* key) {
    return pointer.starts_with(blade + key);
  };
  if (isOf(place, "/end_heights/"))
    std::erase_if(bindings, [&](const auto& bound) {
      return isOf(bound.first, "/middle/") || isOf(bound.first, "/angle_deg");
    });
  if (isOf(place, "/middle/") || isOf(place, "/angle_deg"))
    std::erase_if(bindings, [&](const auto& bound) { return isOf(bound.first, "/end_heights/"); });
}

Result<void> holdEnds(Design& design, const Design& before) {
  const auto bladesOf = [](auto& source) {
    return source.surface ? std::get_if<BladesSurface>(&source.surface->shape) : nullptr;
  };
  for (std::size_t s = 0; s < design.sources.size() && s < before.sources.size(); ++s) {
    auto* now = bladesOf(design.sources[s]);
    const auto* then = bladesOf(before.sources[s]);
    if (!now || !then || now->blades.size() != then->blades.size()) continue;
    for (std::size_t b = 0; b < now->blades.size(); ++b) {
      KeyBlade& blade = now->blades[b];
      const KeyBlade& old = then->blades[b];
      if (blade == old || blade.middle != old.middle || blade.angle != old.angle) continue;
      const Result<std::array<Eigen::Vector2d, 2>> ends = bladeEnds(old);
      if (!ends) continue;
      EndHeights heights;
      for (const std::size_t end : {0u, 1u}) {
        const auto bound = design.bindings.find("/sources/" + std::to_string(s) + "/surface/blades/" +
                                                std::to_string(b) + "/end_heights/" + std::to_string(end));
        if (bound != design.bindings.end() && std::abs((*ends)[end].y() - bound->second.value) <= kEndMiss)
          heights[end] = bound->second.value;
      }
      const Result<KeyBlade> turned = withEndHeights(blade, heights);
      if (!turned) return tl::unexpected<Error>(turned.error());
      blade = *turned;
    }
  }
  return {};
}

}  // namespace bw
