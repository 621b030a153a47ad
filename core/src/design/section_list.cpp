// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/section_list.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <utility>
#include <vector>

#include "bw/core/constructions/spline_constructions.h"

namespace bw {

namespace {

using Points = std::vector<Eigen::Vector2d>;
using Kind = SectionCurve::Kind;

constexpr int kHalvings = 60;  // of a parameter
constexpr std::size_t kCubic = 3;

/// Entries of a list from one on, and how many take their place.
struct Exchange {
  std::size_t from = 0, removed = 0, added = 0;
};

/// The expressions of a design some of whose entries of a list were exchanged.
void renumber(Design& design, const std::string& list, const Exchange& exchange) {
  std::map<std::string, BoundNumber> kept;
  for (const auto& [pointer, bound] : design.bindings) {
    std::size_t index = 0;
    const char *from = pointer.data() + list.size(), *to = pointer.data() + pointer.size();
    if (!pointer.starts_with(list)) {
      kept.emplace(pointer, bound);
      continue;
    }
    const auto [end, error] = std::from_chars(from, to, index);
    if (error != std::errc{} || (index >= exchange.from && index < exchange.from + exchange.removed))
      continue;
    if (index >= exchange.from) index = index + exchange.added - exchange.removed;
    kept.emplace(list + std::to_string(index) + std::string(end, to), bound);
  }
  design.bindings = std::move(kept);
}

std::string sectionsOf(std::size_t source) {
  return "/sources/" + std::to_string(source) + "/surface/sections/";
}

std::string pointsOf(std::size_t source, std::size_t section, Kind kind) {
  return sectionsOf(source) + std::to_string(section) + "/" + kSectionKinds[int(kind)] + "/";
}

std::string tangentsOf(std::size_t source, std::size_t section) {
  return sectionsOf(source) + std::to_string(section) + "/tangents_deg/";
}

SectionsSurface& loftOf(Design& design, std::size_t source) {
  return std::get<SectionsSurface>(design.sources[source].surface->shape);
}

std::string listOfBlades(std::size_t source) {
  return "/sources/" + std::to_string(source) + "/surface/blades/";
}

std::vector<KeyBlade>& bladesOf(Design& design, std::size_t source) {
  return std::get<BladesSurface>(design.sources[source].surface->shape).blades;
}

/// The list of what a surface is told by along its travel.
std::string listOf(const Design& design, std::size_t source) {
  const SurfaceShape& shape = design.sources[source].surface->shape;
  return std::holds_alternative<SectionsSurface>(shape) ? sectionsOf(source)
         : std::holds_alternative<BladesSurface>(shape)
             ? listOfBlades(source)
             : "/sources/" + std::to_string(source) + "/surface/poles/";
}

/// Gives an entry of a list the expressions of another one, but for that of its place along the travel.
void copyBindings(Design& design, const std::string& list, std::size_t from, std::size_t to) {
  const std::string source = list + std::to_string(from) + "/", target = list + std::to_string(to) + "/";
  std::erase_if(design.bindings, [&](const auto& bound) {
    return bound.first.starts_with(target) && bound.first != target + "y";
  });
  std::map<std::string, BoundNumber> copied;
  for (const auto& [pointer, bound] : design.bindings)
    if (pointer.starts_with(source) && pointer != source + "y")
      copied.emplace(target + pointer.substr(source.size()), bound);
  design.bindings.merge(copied);
}

/// Puts `points` in the place of some of a curve.
void exchange(Design& design, std::size_t source, std::size_t section, const Exchange& places,
              const Points& points) {
  SectionCurve& curve = loftOf(design, source).sections[section];
  const auto from = curve.points.begin() + std::ptrdiff_t(places.from);
  curve.points.insert(curve.points.erase(from, from + std::ptrdiff_t(places.removed)), points.begin(),
                      points.end());
  renumber(design, pointsOf(source, section, curve.kind), places);
}

/// A Bézier curve of two or three poles as a cubic.
Points asCubic(const Points& p) {
  if (p.size() == 2) return {p[0], (2 * p[0] + p[1]) / 3, (p[0] + 2 * p[1]) / 3, p[1]};
  if (p.size() == 3) return {p[0], (p[0] + 2 * p[1]) / 3, (2 * p[1] + p[2]) / 3, p[2]};
  return p;
}

/// What is between the ends of both halves of a cubic: leg, leg, joint, leg, leg.
Points halves(const Eigen::Vector2d* p) {
  const Eigen::Vector2d a = (p[0] + p[1]) / 2, middle = (p[1] + p[2]) / 2, d = (p[2] + p[3]) / 2;
  const Eigen::Vector2d b = (a + middle) / 2, c = (middle + d) / 2;
  return {a, b, (b + c) / 2, c, d};
}

/// The curve of a loft at y, in the manner of one of its sections.
Result<SectionCurve> curveAt(const SectionsSurface& loft, double y, const SectionCurve& like) {
  DesignedSurface own;
  own.shape = loft;
  const Result<SplineSurface> spline = splineOf(own);
  if (!spline) return tl::unexpected<Error>(spline.error());
  double from = spline->knotsV.front(), to = spline->knotsV.back();
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (from + to);
    (spline->value(spline->knotsU.front(), middle).y() < y ? from : to) = middle;
  }
  const double v = 0.5 * (from + to);
  SectionCurve curve{y, like.kind, {}};
  const bool alike = std::ranges::all_of(loft.sections, [&](const SectionCurve& section) {
    return section.kind == Kind::bezier && asCubic(section.points).size() == std::size_t(spline->polesU);
  });
  if (alike) {  // its poles are those of the loft there
    const auto above = std::upper_bound(spline->knotsV.begin() + spline->degreeV + 1,
                                        spline->knotsV.begin() + spline->polesV, v);
    const int span = int(above - spline->knotsV.begin()) - 1;
    const std::array<double, 4> basis = splineBasis(spline->knotsV, spline->degreeV, span, v);
    for (int column = 0; column < spline->polesU; ++column) {
      Eigen::Vector3d pole = Eigen::Vector3d::Zero();
      for (int k = 0; k <= spline->degreeV; ++k)
        pole += basis[std::size_t(k)] *
                spline->poles[std::size_t(span - spline->degreeV + k) * std::size_t(spline->polesU) +
                              std::size_t(column)];
      curve.points.emplace_back(pole.x(), pole.z());
    }
    return curve;
  }
  if (like.kind == Kind::bezier) curve.kind = Kind::spline;
  const Result<PlanarCurve> through = cubicSplineThrough(like.points);
  if (!through) return tl::unexpected<Error>(through.error());
  for (std::size_t i = 0; i < like.points.size(); ++i) {
    const double share = through->knots()[i + kCubic] / through->end();
    const double u = spline->knotsU.front() + share * (spline->knotsU.back() - spline->knotsU.front());
    const Eigen::Vector3d point = spline->value(u, v);
    curve.points.emplace_back(point.x(), point.z());
  }
  return curve;
}

}  // namespace

Result<Design> withSectionAfter(const Design& design, std::size_t source, std::size_t section) {
  Design changed = design;
  SectionsSurface& loft = loftOf(changed, source);
  const std::size_t count = loft.sections.size();
  if (count >= std::size_t(SectionsSurface::kMost))
    return fail(ErrorCode::badInput,
                "the surface has " + std::to_string(count) + " sections, as many as a loft takes", "sections",
                double(count), SectionsSurface::kMost);
  SectionCurve another = loft.sections[section];
  if (section + 1 == count) {
    another.y += section > 0 ? another.y - loft.sections[section - 1].y : 100;
  } else {
    const double y = 0.5 * (another.y + loft.sections[section + 1].y);
    Result<SectionCurve> between = curveAt(loft, y, loft.sections[section]);
    if (!between) return tl::unexpected<Error>(between.error());
    another = std::move(*between);
  }
  loft.sections.insert(loft.sections.begin() + std::ptrdiff_t(section) + 1, std::move(another));
  renumber(changed, sectionsOf(source), {section + 1, 0, 1});
  return changed;
}

Result<Design> withoutSection(const Design& design, std::size_t source, std::size_t section) {
  Design changed = design;
  SectionsSurface& loft = loftOf(changed, source);
  if (loft.sections.size() <= 2)
    return fail(ErrorCode::badInput, "a loft keeps two sections, so none of these can be taken away",
                "sections", double(loft.sections.size()), 2.0);
  loft.sections.erase(loft.sections.begin() + std::ptrdiff_t(section));
  renumber(changed, sectionsOf(source), {section, 1, 0});
  return changed;
}

Result<Design> withPointAfter(const Design& design, std::size_t source, std::size_t section,
                              std::size_t point, std::size_t* added) {
  Design changed = design;
  const SectionCurve curve = loftOf(changed, source).sections[section];
  const std::size_t count = curve.points.size();
  const bool bezier = curve.kind == Kind::bezier;
  const auto most = std::size_t(curve.kind == Kind::ducks ? SectionCurve::kMostDucks : SectionCurve::kMost);
  if (count + (bezier ? kCubic : 1) > most)
    return fail(ErrorCode::badInput,
                "section " + std::to_string(section + 1) + " has " + std::to_string(count) +
                    " points; there may be " + std::to_string(most),
                "sections", double(count), double(most));
  if (bezier) {
    const Points cubics = asCubic(curve.points);
    if (cubics.size() != count) exchange(changed, source, section, {0, count, cubics.size()}, cubics);
    const std::size_t cubic =
        std::min(cubics.size() == count ? point / kCubic : 0, cubics.size() / kCubic - 1);
    const std::size_t from = kCubic * cubic;
    exchange(changed, source, section, {from + 1, 2, 5}, halves(&cubics[from]));
    renumber(changed, tangentsOf(source, section), {cubic + 1, 0, 1});
    if (added) *added = from + kCubic;
    return changed;
  }
  const std::size_t before = std::min(point, count - 2);
  const Result<PlanarCurve> through = cubicSplineThrough(curve.points);
  if (!through) return tl::unexpected<Error>(through.error());
  const auto knot = [&](std::size_t i) { return through->knots()[i + kCubic]; };
  const Eigen::Vector2d between = through->value(0.5 * (knot(before) + knot(before + 1)));
  exchange(changed, source, section, {before + 1, 0, 1}, {between});
  if (added) *added = before + 1;
  return changed;
}

Result<Design> withoutPoint(const Design& design, std::size_t source, std::size_t section,
                            std::size_t point) {
  Design changed = design;
  const SectionCurve curve = loftOf(changed, source).sections[section];
  const std::size_t count = curve.points.size();
  if (count <= 2)
    return fail(ErrorCode::badInput,
                "section " + std::to_string(section + 1) + " keeps two points, so none can be taken away",
                "sections", double(count), 2.0);
  const std::size_t cubics = count / kCubic;
  if (curve.kind != Kind::bezier || cubics < 2) {
    exchange(changed, source, section, {point, 1, 0}, {});
    return changed;
  }
  if (point == 0 || point + 1 == count) {
    exchange(changed, source, section, {point == 0 ? 0 : count - kCubic, kCubic, 0}, {});
    renumber(changed, tangentsOf(source, section), {point == 0 ? 0 : cubics, 1, 0});
    return changed;
  }
  const std::size_t joint = kCubic * std::clamp<std::size_t>((point + 1) / kCubic, 1, cubics - 1);
  // One cubic in the place of both: legs as long as it takes if it was parted in its middle.
  const auto& p = curve.points;
  const Eigen::Vector2d first = p[joint - 3] + 2 * (p[joint - 2] - p[joint - 3]);
  const Eigen::Vector2d last = p[joint + 3] + 2 * (p[joint + 2] - p[joint + 3]);
  exchange(changed, source, section, {joint - 2, 5, 2}, {first, last});
  renumber(changed, tangentsOf(source, section), {joint / kCubic, 1, 0});
  return changed;
}

Result<Design> withBladeAfter(const Design& design, std::size_t source, std::size_t blade) {
  Design changed = design;
  std::vector<KeyBlade>& blades = bladesOf(changed, source);
  if (blades.size() >= std::size_t(BladesSurface::kMost))
    return fail(ErrorCode::badInput,
                "the surface has " + std::to_string(blades.size()) + " key blades, as many as it may have",
                "blades", double(blades.size()), BladesSurface::kMost);
  const Result<BladeSweep> sweep = BladeSweep::through(blades);
  if (!sweep) return tl::unexpected<Error>(sweep.error());
  const KeyBlade between = sweep->at(0.5 * (blades[blade].y + blades[blade + 1].y));
  blades.insert(blades.begin() + std::ptrdiff_t(blade) + 1, between);
  renumber(changed, listOfBlades(source), {blade + 1, 0, 1});
  return changed;
}

Result<Design> withoutBlade(const Design& design, std::size_t source, std::size_t blade) {
  Design changed = design;
  std::vector<KeyBlade>& blades = bladesOf(changed, source);
  if (blades.size() <= 2)
    return fail(ErrorCode::badInput, "a surface keeps two key blades, so none of these can be taken away",
                "blades", double(blades.size()), 2.0);
  blades.erase(blades.begin() + std::ptrdiff_t(blade));
  renumber(changed, listOfBlades(source), {blade, 1, 0});
  return changed;
}

Result<Design> withEntryRepeated(const Design& design, std::size_t source, std::size_t entry) {
  Design changed = design;
  SurfaceShape& shape = changed.sources[source].surface->shape;
  const std::string list = listOf(design, source);
  const auto repeat = [&](auto& entries, int most, const char* words) -> Result<Design> {
    const std::size_t count = entries.size();
    if (count >= std::size_t(most))
      return fail(ErrorCode::badInput,
                  "the surface has " + std::to_string(count) + " " + words + ", as many as it may have",
                  std::holds_alternative<SectionsSurface>(shape) ? "sections" : "blades", double(count),
                  double(most));
    auto another = entries[entry];
    if (entry + 1 == count)
      another.y += entry > 0 ? another.y - entries[entry - 1].y : 100;
    else
      another.y = 0.5 * (another.y + entries[entry + 1].y);
    entries.insert(entries.begin() + std::ptrdiff_t(entry) + 1, std::move(another));
    renumber(changed, list, {entry + 1, 0, 1});
    copyBindings(changed, list, entry, entry + 1);
    return changed;
  };
  if (auto* loft = std::get_if<SectionsSurface>(&shape))
    return repeat(loft->sections, SectionsSurface::kMost, "sections");
  return repeat(std::get<BladesSurface>(shape).blades, BladesSurface::kMost, "key blades");
}

Design withShapeCopied(const Design& design, std::size_t source, std::size_t from,
                       const std::vector<std::size_t>& to) {
  Design changed = design;
  SurfaceShape& shape = changed.sources[source].surface->shape;
  const auto copy = [&](auto& entries) {
    for (const std::size_t each : to) {
      const double y = entries[each].y;
      entries[each] = entries[from];
      entries[each].y = y;
    }
  };
  if (auto* loft = std::get_if<SectionsSurface>(&shape))
    copy(loft->sections);
  else if (auto* sweep = std::get_if<BladesSurface>(&shape))
    copy(sweep->blades);
  else if (auto* poles = std::get_if<PolesSurface>(&shape))
    for (const std::size_t row : to)
      for (int column = 0; column < poles->columns; ++column)
        poles->at(int(row), column) = poles->at(int(from), column);
  for (const std::size_t each : to)
    if (each != from) copyBindings(changed, listOf(design, source), from, each);
  return changed;
}

}  // namespace bw
