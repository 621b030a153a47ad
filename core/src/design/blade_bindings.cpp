// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/blade_bindings.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <variant>

#include "bw/core/shape/blade_ends.h"
#include "bw/core/shape/section_tangents.h"

namespace bw {

namespace {

/// Between a section of a pointer and the number at its end or before the next slash.
std::optional<std::size_t> numberAfter(const std::string& pointer, std::size_t at) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(pointer.data() + at, pointer.data() + pointer.size(), number);
  return error == std::errc() ? std::optional(number) : std::nullopt;
}

/// A tangent leaves no room for expressions of the poles beside it, nor these for one.
void freeTangents(std::map<std::string, BoundNumber>& bindings, const std::string& place) {
  constexpr std::string_view kList = "/surface/sections/", kTangents = "/tangents_deg/", kPoles = "/bezier/";
  const std::size_t list = place.find(kList);
  const std::size_t end = list == std::string::npos ? list : place.find('/', list + kList.size());
  if (end == std::string::npos) return;
  const std::string section = place.substr(0, end);
  const auto numberIn = [&section](const std::string& pointer, std::string_view key) {
    return pointer.starts_with(section) && pointer.compare(section.size(), key.size(), key) == 0
               ? numberAfter(pointer, section.size() + key.size())
               : std::nullopt;
  };
  const auto isLeg = [](std::size_t pole, std::size_t joint) {
    return pole + 1 == poleOfJoint(joint) || pole == poleOfJoint(joint) + 1;
  };
  if (const auto joint = numberIn(place, kTangents))
    std::erase_if(bindings, [&](const auto& bound) {
      const auto pole = numberIn(bound.first, kPoles);
      return pole && isLeg(*pole, *joint);
    });
  if (const auto pole = numberIn(place, kPoles))
    std::erase_if(bindings, [&](const auto& bound) {
      const auto joint = numberIn(bound.first, kTangents);
      return joint && isLeg(*pole, *joint);
    });
}

}  // namespace

void freeRivals(std::map<std::string, BoundNumber>& bindings, const std::string& place) {
  freeTangents(bindings, place);
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

void holdTangents(Design& design, const Design& before) {
  const auto loftOf = [](auto& source) {
    return source.surface ? std::get_if<SectionsSurface>(&source.surface->shape) : nullptr;
  };
  for (std::size_t s = 0; s < design.sources.size() && s < before.sources.size(); ++s) {
    auto* now = loftOf(design.sources[s]);
    const auto* then = loftOf(before.sources[s]);
    if (!now || !then || now->sections.size() != then->sections.size()) continue;
    for (std::size_t i = 0; i < now->sections.size(); ++i) {
      SectionCurve& curve = now->sections[i];
      const SectionCurve& old = then->sections[i];
      if (curve == old || curve.kind != old.kind || curve.points.size() != old.points.size()) continue;
      for (std::size_t joint = 0; joint < jointCount(curve); ++joint) {
        const std::size_t pole = poleOfJoint(joint);
        const auto bound = design.bindings.find("/sources/" + std::to_string(s) + "/surface/sections/" +
                                                std::to_string(i) + "/tangents_deg/" + std::to_string(joint));
        if (bound == design.bindings.end() || curve.points[pole] == old.points[pole]) continue;
        const auto was = tangentAt(old, joint, bound->second.value);
        if (was && std::abs(*was - bound->second.value) <= kTangentMiss)
          curve = withTangent(std::move(curve), joint, bound->second.value);
      }
    }
  }
}

}  // namespace bw
