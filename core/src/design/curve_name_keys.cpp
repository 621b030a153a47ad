// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <charconv>
#include <set>

#include "bw/core/design/surface_curves.h"
#include "design/design_keys.h"

namespace bw::detail {

using nlohmann::json;

namespace {

constexpr const char* kKey = "curve_names";

/// The place that a key tells, counted from 0; nothing where a surface of so many curves has none such.
std::optional<int> placeOf(const std::string& key, int count) {
  int place = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), place);
  const bool isPlace = error == std::errc() && end == key.data() + key.size() && place >= 1 && place <= count;
  return isPlace && std::to_string(place) == key ? std::optional(place - 1) : std::nullopt;
}

}  // namespace

void readCurveNames(ObjectReader& reader, Source& source) {
  const json* value = reader.member(kKey);
  if (!value) return;
  const std::string path = reader.path() + "." + kKey;
  if (!value->is_object())
    return reader.complain(kKey, path + " must tell names by the places of curves, as {\"2\": \"ridge\"}");
  const int count = source.surface ? curveCount(*source.surface) : 0;
  std::set<std::string> taken;
  for (const auto& [key, name] : value->items()) {
    const std::optional<int> place = placeOf(key, count);
    if (!place)
      return reader.complain(kKey, path + " names the curve \"" + key + "\", but " +
                                       (count > 0 ? "the surface has the curves 1 to " + std::to_string(count)
                                                  : "the source has no curves") +
                                       "; take it out");
    if (!name.is_string()) return reader.complain(kKey, path + "." + key + " must be a text");
    const std::string text = name.get<std::string>();
    if (const std::string why = whyNoCurveName(text); !why.empty())
      return reader.complain(kKey, path + "." + key + ": " + why);
    if (!taken.insert(text).second)
      return reader.complain(kKey, path + " calls two curves \"" + text + "\"; give each a name of its own");
    source.curveNames[*place] = text;
  }
}

void writeCurveNames(const Source& source, json& object) {
  const int count = source.surface ? curveCount(*source.surface) : 0;
  for (const auto& [curve, name] : source.curveNames)
    if (curve >= 0 && curve < count) object[kKey][std::to_string(curve + 1)] = name;
}

}  // namespace bw::detail
