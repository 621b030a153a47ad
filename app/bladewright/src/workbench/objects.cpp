// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workbench/objects.h"

#include <algorithm>

#include "bw/core/design/cut_list.h"
#include "bw/core/design/surface_curves.h"
#include "bw/core/text/printable.h"

namespace bw::app {

namespace {

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

/// An id that several of the parts have.
template <class Part>
std::optional<std::string> twice(const std::vector<Part>& parts) {
  std::set<std::string> ids;
  for (const Part& part : parts)
    if (!ids.insert(part.id).second) return part.id;
  return std::nullopt;
}

/// Calls a block otherwise, and its cuts, which a grid calls after it, with it.
void nameBlock(Design& design, const std::string& from, const std::string& to) {
  if (design.grid)
    for (const BlockGrid::Cell& cell : design.grid->cells()) {
      if (cell.id != from) continue;
      if (cell.place == to)
        design.grid->names.erase(cell.place);
      else
        design.grid->names[cell.place] = to;
    }
  exchange(design.stock, &StockBlock::id, from, to);
  for (Cut& cut : design.cuts) {
    if (cut.block != from) continue;
    if (const std::string stem = stemOf(cut.id, from); design.grid && !stem.empty()) cut.id = stem + "-" + to;
    cut.block = to;
  }
}

/// Calls a cut otherwise, and those of other blocks of a grid that go with it alike.
void nameCut(Design& design, const std::string& from, const std::string& to) {
  const Cut cut = *find(design.cuts, from);
  const std::string stem = stemOf(to, cut.block);
  for (const Cut& one : cutsTogether(design, cut))
    exchange(design.cuts, &Cut::id, one.id,
             design.grid && !stemOf(one.id, one.block).empty() ? (stem.empty() ? to : stem) + "-" + one.block
                                                               : to);
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
  if (object.kind == Object::Kind::stations) return "stations of " + object.id;
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
  if (const std::string why = whyNoFileName(name); !why.empty()) return refuse(why);
  Design changed = design;
  std::optional<std::string> taken;
  if (object.kind == Object::Kind::surface) {
    exchange(changed.sources, &Source::id, object.id, name);
    exchange(changed.cuts, &Cut::source, object.id, name);
    taken = twice(changed.sources);
  } else if (object.kind == Object::Kind::block) {
    nameBlock(changed, object.id, name);
    taken = twice(changed.stock);
    if (!taken) taken = twice(changed.cuts);
  } else {
    nameCut(changed, object.id, name);
    taken = twice(changed.cuts);
  }
  if (taken) return refuse("there is another \"" + *taken + "\"; choose another name");
  return changed;
}

PartMarks withNewNames(PartMarks marks, const NewNames& names) {
  const auto follow = [](std::set<std::string>& marked, const std::map<std::string, std::string>& called) {
    for (const auto& [from, to] : called)
      if (marked.contains(from)) marked.insert(to);
  };
  for (PartIds* ids : {&marks.hidden, &marks.locked}) {
    follow(ids->stock, names.blocks);
    follow(ids->cuts, names.cuts);
    follow(ids->stations, names.cuts);
    follow(ids->sources, names.sources);
  }
  return marks;
}

std::optional<Object> firstChanged(const std::vector<Object>& objects, const Design& before,
                                   const Design& after) {
  const NewNames names = newNames(before, after);
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
    // Those of a cut that is called otherwise are the same.
    std::string called = object.id;
    followName(names.cuts, called);
    const Cut *then = find(before.cuts, object.id), *now = find(after.cuts, called);
    return then && (!now || now->sections != then->sections);
  });
  return changed == objects.end() ? std::nullopt : std::optional(*changed);
}

}  // namespace bw::app
