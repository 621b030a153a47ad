// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/surface_curves.h"

#include <algorithm>
#include <charconv>
#include <set>

#include "bw/core/text/printable.h"

namespace bw {

namespace {

constexpr char kBefore = '/';  // the place of the curve

const DesignedSurface* surfaceOf(const Design& design, const std::string& source) {
  const Source* found = design.find(source);
  return found && found->surface ? &*found->surface : nullptr;
}

/// The source and the place, counted from 0, that an id tells, whether or not there is such a curve.
std::optional<CurveOfSource> told(const std::string& id) {
  const std::size_t at = id.rfind(kBefore);
  if (at == std::string::npos) return {};
  int place = 0;
  const char *first = id.data() + at + 1, *last = id.data() + id.size();
  const auto [end, error] = std::from_chars(first, last, place);
  if (error != std::errc() || end != last || place < 1) return {};
  CurveOfSource curve{id.substr(0, at), place - 1};
  if (curveId(curve.source, curve.curve) != id) return {};
  return curve;
}

bool isSameRow(const PolesSurface& a, int rowOfA, const PolesSurface& b, int rowOfB) {
  if (a.columns != b.columns) return false;
  for (int column = 0; column < a.columns; ++column)
    if (a.at(rowOfA, column) != b.at(rowOfB, column) || a.place(rowOfA, column) != b.place(rowOfB, column))
      return false;
  return true;
}

/// The place in `after` of a curve of `before`; nothing if it is not there.
std::optional<int> placeAfter(const DesignedSurface& before, int curve, const DesignedSurface& after) {
  for (int i = 0; i < curveCount(after); ++i)
    if (isSameCurve(before, curve, after, i)) return i;
  return {};
}

/// The place that a curve of `then` has in `now`; nothing if it is gone.
std::optional<int> placeNow(const DesignedSurface& then, int curve, const DesignedSurface& now) {
  // It may have been changed where it is.
  if (then.shape.index() == now.shape.index() && curveCount(then) == curveCount(now)) return curve;
  return placeAfter(then, curve, now);
}

std::set<std::string> followed(const std::set<std::string>& ids, const Design& before, const Design& after) {
  std::set<std::string> next;
  for (const std::string& id : ids) {
    const std::optional<CurveOfSource> curve = curveOf(before, id);
    const DesignedSurface* then = curve ? surfaceOf(before, curve->source) : nullptr;
    const DesignedSurface* now = curve ? surfaceOf(after, curve->source) : nullptr;
    if (!then || before.find(id) || (!now && !after.find(curve->source))) {
      next.insert(id);
    } else if (const auto place = now ? placeNow(*then, curve->curve, *now) : std::nullopt) {
      next.insert(curveId(curve->source, *place));
    }
  }
  return next;
}

}  // namespace

int curveCount(const DesignedSurface& surface) {
  if (const auto* poles = std::get_if<PolesSurface>(&surface.shape)) return poles->rows;
  if (const auto* loft = std::get_if<SectionsSurface>(&surface.shape)) return int(loft->sections.size());
  if (const auto* sweep = std::get_if<BladesSurface>(&surface.shape)) return int(sweep->blades.size());
  return 0;
}

std::string curveId(const std::string& source, int curve) {
  return source + kBefore + std::to_string(curve + 1);
}

std::string curveWord(const DesignedSurface& surface, int curve) {
  const char* what = std::holds_alternative<PolesSurface>(surface.shape)      ? "row "
                     : std::holds_alternative<SectionsSurface>(surface.shape) ? "section "
                                                                              : "key blade ";
  return what + std::to_string(curve + 1);
}

std::string curveTitle(const Source& source, int curve) {
  const std::string word = source.surface ? curveWord(*source.surface, curve) : std::string();
  const auto named = source.curveNames.find(curve);
  return named == source.curveNames.end() ? word : named->second + " (" + word + ")";
}

std::string whyNoCurveName(const std::string& name) {
  constexpr std::size_t kLongest = 60;  // bytes
  if (name.find_first_not_of(" \t") == std::string::npos) return "a name must not be empty";
  if (name.size() > kLongest) return "a name has " + std::to_string(kLongest) + " characters at most";
  if (printable(name) != name) return "a name is one line of text, without control characters";
  return {};
}

std::optional<CurveOfSource> curveOf(const Design& design, const std::string& id) {
  const std::optional<CurveOfSource> curve = told(id);
  const DesignedSurface* surface = curve ? surfaceOf(design, curve->source) : nullptr;
  return surface && curve->curve < curveCount(*surface) ? curve : std::nullopt;
}

bool isSameCurve(const DesignedSurface& a, int curveOfA, const DesignedSurface& b, int curveOfB) {
  if (a.shape.index() != b.shape.index() || a.origin != b.origin || a.rotation != b.rotation) return false;
  if (const auto* poles = std::get_if<PolesSurface>(&a.shape))
    return isSameRow(*poles, curveOfA, std::get<PolesSurface>(b.shape), curveOfB);
  if (const auto* loft = std::get_if<SectionsSurface>(&a.shape))
    return loft->sections[std::size_t(curveOfA)] ==
           std::get<SectionsSurface>(b.shape).sections[std::size_t(curveOfB)];
  const auto* sweep = std::get_if<BladesSurface>(&a.shape);
  return sweep && sweep->blades[std::size_t(curveOfA)] ==
                      std::get<BladesSurface>(b.shape).blades[std::size_t(curveOfB)];
}

PartMarks followed(const PartMarks& marks, const Design& before, const Design& after) {
  PartMarks next = marks;
  next.hidden.sources = followed(marks.hidden.sources, before, after);
  next.locked.sources = followed(marks.locked.sources, before, after);
  return next;
}

void followNames(const Design& before, Design& after) {
  for (Source& now : after.sources) {
    const Source* then = before.find(now.id);
    if (now.curveNames.empty() || !then || then->curveNames != now.curveNames || then->surface == now.surface)
      continue;
    now.curveNames.clear();
    for (const auto& [curve, name] : then->curveNames)
      if (const auto place =
              then->surface && now.surface ? placeNow(*then->surface, curve, *now.surface) : std::nullopt)
        now.curveNames[*place] = name;
  }
}

}  // namespace bw
