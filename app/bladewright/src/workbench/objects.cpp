// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workbench/objects.h"

#include <algorithm>

#include "bw/core/design/surface_curves.h"
#include "bw/core/text/printable.h"

namespace bw::app {

namespace {

constexpr std::size_t kLongest = 60;  // characters of a name

template <class Part>
const Part* find(const std::vector<Part>& parts, const std::string& id) {
  const auto found = std::ranges::find(parts, id, &Part::id);
  return found == parts.end() ? nullptr : &*found;
}

template <class Part>
bool same(const std::vector<Part>& before, const std::vector<Part>& after, const std::string& id) {
  const Part *then = find(before, id), *now = find(after, id);
  return !then || (now && *now == *then);
}

/// Of every part that has it.
template <class Part>
void exchange(std::vector<Part>& parts, std::string Part::*member, const std::string& from,
              const std::string& to) {
  for (Part& part : parts)
    if (part.*member == from) part.*member = to;
}

bool sameCurve(const Design& before, const Design& after, const std::string& id) {
  const std::optional<CurveOfSource> curve = curveOf(before, id);
  if (!curve) return true;
  const Source& source = *before.find(curve->source);
  const DesignedSurface& then = *source.surface;
  const Source* now = after.find(curve->source);
  // Another name is a change, too.
  const auto nameIn = [&](const Source& of) {
    const auto named = of.curveNames.find(curve->curve);
    return named == of.curveNames.end() ? std::string() : named->second;
  };
  if (now && now->surface == source.surface && nameIn(source) != nameIn(*now)) return false;
  // Others may have come before it, or gone.
  for (int i = 0; now && now->surface && i < curveCount(*now->surface); ++i)
    if (isSameCurve(then, curve->curve, *now->surface, i)) return true;
  return false;
}

template <class Part>
bool taken(const std::vector<Part>& parts, const Object& object, const std::string& name) {
  return name != object.id && find(parts, name);
}

}  // namespace

std::set<std::string>& idsOf(PartIds& marked, Object::Kind kind) {
  switch (kind) {
    case Object::Kind::block:
      return marked.stock;
    case Object::Kind::cut:
      return marked.cuts;
    case Object::Kind::surface:
    case Object::Kind::curve:
      return marked.sources;
    case Object::Kind::stations:
      break;
  }
  return marked.stations;
}

const std::set<std::string>& idsOf(const PartIds& marked, Object::Kind kind) {
  return idsOf(const_cast<PartIds&>(marked), kind);
}

std::vector<Object> objectsOf(const PartIds& marked) {
  std::vector<Object> objects;
  for (const Object::Kind kind : {Object::Kind::block, Object::Kind::cut, Object::Kind::surface,
                                  Object::Kind::curve, Object::Kind::stations})
    for (const std::string& id : idsOf(marked, kind)) objects.push_back({kind, id});
  return objects;
}

std::string nameOf(const Design& design, const Object& object) {
  const std::optional<CurveOfSource> curve =
      object.kind == Object::Kind::curve ? curveOf(design, object.id) : std::nullopt;
  if (!curve) return object.id;
  return curveTitle(*design.find(curve->source), curve->curve) + " of " + curve->source;
}

namespace {

/// The design with another name for a curve; without one it is called after its place.
Result<Design> curveRenamed(const Design& design, const CurveOfSource& curve, const std::string& name) {
  Design changed = design;
  Source& source = *std::ranges::find(changed.sources, curve.source, &Source::id);
  if (name.empty()) {
    source.curveNames.erase(curve.curve);
    return changed;
  }
  if (const std::string why = whyNoCurveName(name); !why.empty())
    return fail(ErrorCode::badInput, why, "name");
  for (const auto& [other, taken] : source.curveNames)
    if (other != curve.curve && taken == name)
      return fail(ErrorCode::badInput,
                  curveWord(*source.surface, other) + " is called \"" + name + "\"; choose another name",
                  "name");
  source.curveNames[curve.curve] = name;
  return changed;
}

}  // namespace

Result<Design> renamed(const Design& design, const Object& object, const std::string& name) {
  const auto refuse = [](const std::string& why) { return fail(ErrorCode::badInput, why, "name"); };
  if (const auto curve = object.kind == Object::Kind::curve ? curveOf(design, object.id) : std::nullopt)
    return curveRenamed(design, *curve, name);
  if (design.grid && object.kind != Object::Kind::surface)
    return refuse("blocks side by side, and their cuts, have their names from their place in the grid");
  if (name.find_first_not_of(" \t") == std::string::npos) return refuse("a name must not be empty");
  if (name.size() > kLongest) return refuse("a name has " + std::to_string(kLongest) + " characters at most");
  if (name.find_first_of("/\\:*?\"<>|") != std::string::npos || name.front() == '.' ||
      printable(name) != name)
    return refuse(
        "a name has none of / \\ : * ? \" < > |, and no point at its beginning: files are named after it");
  const bool isTaken = object.kind == Object::Kind::block     ? taken(design.stock, object, name)
                       : object.kind == Object::Kind::surface ? taken(design.sources, object, name)
                                                              : taken(design.cuts, object, name);
  if (isTaken) return refuse("there is another \"" + name + "\"; choose another name");
  Design changed = design;
  if (object.kind == Object::Kind::block) {
    exchange(changed.stock, &StockBlock::id, object.id, name);
    exchange(changed.cuts, &Cut::block, object.id, name);
  } else if (object.kind == Object::Kind::surface) {
    exchange(changed.sources, &Source::id, object.id, name);
    exchange(changed.cuts, &Cut::source, object.id, name);
  } else {
    exchange(changed.cuts, &Cut::id, object.id, name);
  }
  return changed;
}

std::optional<Object> firstChanged(const std::vector<Object>& objects, const Design& before,
                                   const Design& after) {
  const auto otherSurface = [&](const Cut& cut) { return !same(before.sources, after.sources, cut.source); };
  const auto otherCut = [&](const Cut& cut) {
    return !same(before.cuts, after.cuts, cut.id) || otherSurface(cut);
  };
  const auto changed = std::ranges::find_if(objects, [&](const Object& object) {
    const auto lies = [&](const Cut& cut) { return cut.block == object.id; };
    const auto changes = [&](const Cut& cut) { return lies(cut) && otherCut(cut); };
    const auto comes = [&](const Cut& cut) { return lies(cut) && !find(before.cuts, cut.id); };
    switch (object.kind) {
      case Object::Kind::block:
        return !same(before.stock, after.stock, object.id) || std::ranges::any_of(before.cuts, changes) ||
               std::ranges::any_of(after.cuts, comes);
      case Object::Kind::surface:
        return !same(before.sources, after.sources, object.id);
      case Object::Kind::curve:
        return !sameCurve(before, after, object.id);
      case Object::Kind::cut: {
        const Cut* cut = find(before.cuts, object.id);
        return cut && otherCut(*cut);
      }
      case Object::Kind::stations:
        break;
    }
    return false;
  });
  return changed == objects.end() ? std::nullopt : std::optional(*changed);
}

}  // namespace bw::app
