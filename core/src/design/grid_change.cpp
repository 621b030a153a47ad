// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/grid_change.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "bw/core/design/cut_list.h"
#include "bw/core/design/variables.h"
#include "design/grid_cuts.h"
#include "shape/shapes.h"

namespace bw {

namespace {

constexpr double kSame = 1e-6;  // mm

/// Without the name of its block in its own.
Cut withoutBlock(Cut cut) {
  if (std::string stem = stemOf(cut.id, cut.block); !stem.empty()) cut.id = std::move(stem);
  cut.block.clear();
  return cut;
}

/// Whether a cut is one of those that all blocks have.
bool isOfAll(const Design& design, const Cut& cut) {
  return !design.grid || cutsTogether(design, cut).size() == design.stock.size();
}

/// The cuts that all blocks have, as a block has them and without its name; where there are none, its own.
std::vector<Cut> cutsLike(const Design& design, const std::string& block) {
  std::vector<Cut> like, own;
  for (const Cut& cut : design.cuts)
    if (cut.block == block) (isOfAll(design, cut) ? like : own).push_back(withoutBlock(cut));
  return like.empty() ? own : like;
}

/// What the blocks of a grid are called in another one, where they have the same column, row and layer in it.
std::map<std::string, std::string> idsAfter(const BlockGrid& before, const BlockGrid& after) {
  const std::vector<BlockGrid::Cell> from = before.cells(), to = after.cells();
  const auto placeIn = [](const BlockGrid& grid, std::size_t column, std::size_t row, std::size_t layer) {
    return (layer * grid.sizes[1].size() + row) * grid.sizes[0].size() + column;
  };
  std::array<std::size_t, 3> both;
  for (std::size_t way = 0; way < 3; ++way)
    both[way] = std::min(before.sizes[way].size(), after.sizes[way].size());
  std::map<std::string, std::string> ids;
  for (std::size_t layer = 0; layer < both[2]; ++layer)
    for (std::size_t row = 0; row < both[1]; ++row)
      for (std::size_t column = 0; column < both[0]; ++column)
        ids[from[placeIn(before, column, row, layer)].id] = to[placeIn(after, column, row, layer)].id;
  return ids;
}

/// The grid with the names that blocks of the same column, row and layer had, unless it has others already.
BlockGrid named(BlockGrid grid, const BlockGrid& before) {
  if (grid.names != before.names) return grid;
  grid.names.clear();
  BlockGrid plain = before;
  plain.names.clear();
  const std::map<std::string, std::string> places = idsAfter(plain, grid);
  for (const auto& [place, name] : before.names)
    if (const auto there = places.find(place); there != places.end()) grid.names[there->second] = name;
  return grid;
}

/// A cut in the block that its own is called now, and called after it where it was before; none where that
/// block is gone.
std::optional<Cut> carried(Cut cut, const std::map<std::string, std::string>& ids) {
  const auto block = ids.find(cut.block);
  if (block == ids.end()) return {};
  const Cut bare = withoutBlock(cut);
  if (bare.id != cut.id) cut.id = bare.id + "-" + block->second;
  cut.block = block->second;
  return cut;
}

/// Where the blocks of a grid end along a way, after where the first begins, mm.
std::vector<double> boundaries(const BlockGrid& grid, std::size_t way, double from) {
  std::vector<double> places = {from};
  for (std::size_t i = 0; i < grid.sizes[way].size(); ++i) {
    from += grid.sizes[way][i];
    places.push_back(from);
    if (i < grid.gaps[way].size()) from += grid.gaps[way][i];
  }
  return places;
}

/// Boundaries before and afterwards along one way.
struct Move {
  std::vector<double> before, after;

  std::size_t kept() const { return std::min(before.size(), after.size()) - 1; }
  /// True where there are fewer, and those that are left are where they were.
  bool endsSooner() const {
    return after.size() < before.size() &&
           std::equal(after.begin(), after.end(), before.begin(),
                      [](double a, double b) { return std::abs(a - b) < kSame; });
  }
  bool covers(double first, double last) const {
    return std::abs(first - before.front()) < kSame && std::abs(last - before.back()) < kSame;
  }
  bool stays(double place) const { return place <= before[kept()] + kSame; }
  /// Between boundaries a place keeps its share of the way.
  double operator()(double place) const {
    std::size_t next = 1;
    while (next < kept() && place > before[next]) ++next;
    const double share = (place - before[next - 1]) / (before[next] - before[next - 1]);
    return after[next - 1] + share * (after[next] - after[next - 1]);
  }
  /// The same over the whole.
  double stretched(double place) const {
    return after.front() +
           (place - before.front()) / (before.back() - before.front()) * (after.back() - after.front());
  }
};

constexpr std::size_t kNew = std::size_t(-1);

/// What lies along a way, in its order, on other boundaries: `at` is its place. What ends before the last
/// boundary goes on to it: with what is `between` such things, in new blocks as in a mirror on the boundary
/// before them; where nothing is, the last is repeated. `origins` gets of each the place in the list that it
/// had, or that of which it is a copy has; `kNew` of others.
template <class Thing>
std::vector<Thing> moved(const std::vector<Thing>& things, const Move& move,
                         const std::function<double&(Thing&)>& at,
                         const std::function<Thing(double)>& between = nullptr,
                         std::vector<std::size_t>* origins = nullptr) {
  std::vector<Thing> next;
  std::vector<std::size_t> of;
  for (std::size_t i = 0; i < things.size(); ++i) {
    Thing thing = things[i];
    double& place = at(thing);
    if (!move.stays(place)) continue;
    place = move(place);
    next.push_back(std::move(thing));
    of.push_back(i);
  }
  const std::size_t kept = move.kept();
  for (std::size_t i = kept; i < move.after.size(); ++i) {
    if (between && i > kept) {
      const double first = move.after[i - 2], mirror = move.after[i - 1];
      const double share = (move.after[i] - mirror) / (mirror - first);
      for (std::size_t k = next.size(); k-- > 0;) {
        Thing again = next[k];
        double& place = at(again);
        if (place < first - kSame) break;
        if (place > mirror - kSame) continue;
        place = mirror + share * (mirror - place);
        next.push_back(std::move(again));
        of.push_back(of[k]);
      }
    }
    if (!next.empty() && at(next.back()) > move.after[i] - kSame) continue;
    // Of the blocks that are new the first is a mirror of one that was there, the next one of the first.
    next.push_back(between ? between(move.before[i == kept ? kept : kept - 1]) : next.back());
    at(next.back()) = move.after[i];
    of.push_back(between ? kNew : of.back());
  }
  if (origins) *origins = std::move(of);
  return next;
}

bool covers(const std::vector<Eigen::Vector2d>& points, const Move& x) {
  return !points.empty() && x.covers(points.front().x(), points.back().x());
}

/// The share of a way, 0 to 1, where what grows along it comes to `place`.
double shareWhere(double place, const std::function<double(double)>& at) {
  constexpr int kHalvings = 60;
  double from = 0, to = 1;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (from + to);
    (at(middle) < place ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

double& placeOf(Eigen::Vector2d& point) { return point.x(); }

/// What tells the points of a section that goes on along x; where it is none, its ends go on.
std::function<Eigen::Vector2d(double)> pointsOf(const SectionCurve& section) {
  const Result<PlanarCurve> curve = shape::curveOf(section);
  if (!curve)
    return [ends = std::pair(section.points.front(), section.points.back())](double x) {
      return x < ends.second.x() ? ends.first : ends.second;
    };
  return [curve = *curve](double x) {
    const auto at = [&](double share) { return curve.value(std::lerp(curve.start(), curve.end(), share)); };
    return at(shareWhere(x, [&](double share) { return at(share).x(); }));
  };
}

/// A spline ends without curvature: where one that was cut would leave the curve by that, one or two points
/// beside its end keep it there. `was` tells the points of the curve.
void keepBeforeEnd(SectionCurve& section, const std::function<Eigen::Vector2d(double)>& was,
                   std::vector<std::size_t>& origins) {
  constexpr double kSeen = 0.1;                    // mm
  constexpr std::array kBeside = {0.25, 1 / 16.};  // of the way from the last point before
  constexpr int kPlaces = 16;
  std::vector<Eigen::Vector2d>& points = section.points;
  const int most = section.kind == SectionCurve::Kind::ducks ? SectionCurve::kMostDucks : SectionCurve::kMost;
  if (points.size() < 2) return;
  const double end = points.back().x(), before = points[points.size() - 2].x();
  for (const double share : kBeside) {
    const std::function<Eigen::Vector2d(double)> is = pointsOf(section);
    double off = 0;
    for (int k = 1; k < kPlaces; ++k) {
      const double x = std::lerp(before, end, double(k) / kPlaces);
      off = std::max(off, std::abs(is(x).y() - was(x).y()));
    }
    if (off <= kSeen || int(points.size()) >= most) return;
    const double x = std::lerp(end, before, share);
    points.insert(points.end() - 1, Eigen::Vector2d(x, was(x).y()));
    origins.insert(origins.end() - 1, kNew);
  }
}

/// The chain of cubics as far as x, where one of them is divided if no joint is there.
std::vector<Eigen::Vector2d> chainTo(double x, std::vector<Eigen::Vector2d> chain) {
  std::size_t first = 0;
  while (first + 6 < chain.size() && chain[first + 3].x() < x - kSame) first += 3;
  chain.resize(first + 4);
  std::array<Eigen::Vector2d, 4> p;
  std::ranges::copy(chain.end() - 4, chain.end(), p.begin());
  if (p[3].x() <= x + kSame) return chain;
  std::array<Eigen::Vector2d, 4> part;
  const auto divide = [&](double share) {
    std::array<Eigen::Vector2d, 4> rest = p;
    for (std::size_t n = 0; n < 4; ++n) {
      part[n] = rest[0];
      for (std::size_t k = 0; k + n + 1 < 4; ++k) rest[k] = (1 - share) * rest[k] + share * rest[k + 1];
    }
    return part[3].x();
  };
  divide(shareWhere(x, divide));
  part[3].x() = x;
  std::ranges::copy(part, chain.end() - 4);
  return chain;
}

/// A chain of cubics whose joints go where `x` puts them. The legs of a cubic grow with it, along and across,
/// so that two of them stay in line; a cubic over a new block is level at its end.
std::vector<Eigen::Vector2d> chainMoved(const SectionCurve& section, const Move& x) {
  const std::vector<Eigen::Vector2d> chain = chainTo(x.before[x.kept()], section.points);
  std::vector<Eigen::Vector2d> joints;
  for (std::size_t i = 0; i < chain.size(); i += 3) joints.push_back(chain[i]);
  const std::vector<Eigen::Vector2d> ends = moved<Eigen::Vector2d>(joints, x, &placeOf, pointsOf(section));
  std::vector<Eigen::Vector2d> next = {ends.front()};
  for (std::size_t k = 1; k < ends.size(); ++k) {
    const double width = ends[k].x() - ends[k - 1].x();
    Eigen::Vector2d out, back(-width / 3, 0);
    if (k < joints.size()) {
      const double grown = width / (joints[k].x() - joints[k - 1].x());
      out = grown * (chain[3 * k - 2] - joints[k - 1]);
      back = grown * (chain[3 * k - 1] - joints[k]);
    } else {
      const Eigen::Vector2d before = next.back() - next[next.size() - 2];
      out = width / 3 / before.x() * before;
    }
    next.insert(next.end(), {Eigen::Vector2d(ends[k - 1] + out), Eigen::Vector2d(ends[k] + back), ends[k]});
  }
  return next;
}

/// True for cubics whose joints go on along x, and their legs with them.
bool isChainAlong(const SectionCurve& section) {
  const std::vector<Eigen::Vector2d>& p = section.points;
  if (section.kind != SectionCurve::Kind::bezier || p.size() <= 4) return false;
  for (std::size_t i = 3; i < p.size(); i += 3)
    if (!(p[i].x() > p[i - 1].x()) || !(p[i].x() > p[i - 3].x())) return false;
  return true;
}

void reachOver(BladesSurface& surface, const Move& y) {
  std::vector<KeyBlade>& blades = surface.blades;
  if (blades.empty() || !y.covers(blades.front().y, blades.back().y)) return;
  blades = moved<KeyBlade>(blades, y, [](KeyBlade& blade) -> double& { return blade.y; });
}

/// Points of splines by their section, and of each the point that it had been, or is a copy of, or `kNew`.
using Origins = std::vector<std::vector<std::size_t>>;

void reachOver(SectionsSurface& surface, const Move& x, const Move& y, Origins& origins) {
  std::vector<SectionCurve>& sections = surface.sections;
  const bool whole = !sections.empty() && y.covers(sections.front().y, sections.back().y) &&
                     std::ranges::all_of(sections, [&](const auto& one) { return covers(one.points, x); });
  if (!whole) return;
  origins.resize(sections.size());
  for (std::size_t i = 0; i < sections.size(); ++i) {
    SectionCurve& section = sections[i];
    if (isChainAlong(section)) {
      section.points = chainMoved(section, x);
    } else if (section.kind == SectionCurve::Kind::bezier) {
      for (Eigen::Vector2d& point : section.points) point.x() = x.stretched(point.x());
    } else {
      const std::function<Eigen::Vector2d(double)> was = pointsOf(section);
      section.points = moved<Eigen::Vector2d>(section.points, x, &placeOf, was, &origins[i]);
      if (x.endsSooner()) keepBeforeEnd(section, was, origins[i]);
    }
  }
  sections = moved<SectionCurve>(sections, y, [](SectionCurve& section) -> double& { return section.y; });
}

void reachOver(Rectangle& over, const Move& x, const Move& y) {
  if (!x.covers(over.min.x(), over.max.x()) || !y.covers(over.min.y(), over.max.y())) return;
  over = {{x.after.front(), y.after.front()}, {x.after.back(), y.after.back()}};
}

/// A surface that reached over all of a grid reaches over all of another one.
Origins reachOver(DesignedSurface& surface, const BlockGrid& before, const BlockGrid& grid) {
  Origins origins;
  if (surface.rotation != before.rotation || grid.rotation != before.rotation) return origins;
  const Eigen::Matrix3d turn = rotationFromAngles(before.rotation);
  const auto moveAlong = [&](std::size_t way) {
    const auto from = [&](const BlockGrid& of) -> double {
      return (turn.transpose() * (of.origin - surface.origin))(Eigen::Index(way));
    };
    return Move{boundaries(before, way, from(before)), boundaries(grid, way, from(grid))};
  };
  const Move x = moveAlong(0), y = moveAlong(1);
  if (auto* poles = std::get_if<PolesSurface>(&surface.shape)) reachOver(poles->over, x, y);
  if (auto* formula = std::get_if<FormulaSurface>(&surface.shape)) reachOver(formula->over, x, y);
  if (auto* sections = std::get_if<SectionsSurface>(&surface.shape)) reachOver(*sections, x, y, origins);
  if (auto* blades = std::get_if<BladesSurface>(&surface.shape)) reachOver(*blades, y);
  return origins;
}

/// Expressions of points go with these; heights of those that are copies are told as those of which they are.
void followPoints(Design& design, std::size_t source, const Origins& origins) {
  const std::map<std::string, BoundNumber> before = design.bindings;
  for (std::size_t i = 0; i < origins.size(); ++i)
    for (const char* kind : {"spline", "ducks"}) {
      if (origins[i].empty()) continue;
      const std::string points =
          "/sources/" + std::to_string(source) + "/surface/sections/" + std::to_string(i) + "/" + kind + "/";
      std::erase_if(design.bindings, [&](const auto& bound) { return bound.first.starts_with(points); });
      for (std::size_t point = 0; point < origins[i].size(); ++point)
        for (const char* number : {"/0", "/1"}) {
          const std::size_t of = origins[i][point];
          if (of != point && number[1] == '0') continue;  // it lies elsewhere
          const auto bound = before.find(points + std::to_string(of) + number);
          if (bound != before.end()) design.bindings[points + std::to_string(point) + number] = bound->second;
        }
    }
}

/// Places of copies that lie on boundaries are told by the expression of the width of all columns, where
/// those of points before them are told by one.
void tellPlaces(Design& design, std::size_t source, const Origins& origins) {
  const auto width = design.bindings.find("/grid/sizes/columns");
  const std::optional<DesignedSurface>& surface = design.sources[source].surface;
  if (width == design.bindings.end() || !design.grid || !surface) return;
  const auto* shape = std::get_if<SectionsSurface>(&surface->shape);
  const bool fromThere = (design.grid->origin - surface->origin).norm() < kSame;
  if (!shape || !fromThere ||
      design.grid->extent(0) > width->second.value * double(design.grid->sizes[0].size()) + kSame)
    return;
  const std::string& text = width->second.text;
  const std::string one = isVariableName(text) ? text : "(" + text + ")";
  for (std::size_t i = 0; i < origins.size() && i < shape->sections.size(); ++i)
    for (const char* kind : {"spline", "ducks"}) {
      const std::string points =
          "/sources/" + std::to_string(source) + "/surface/sections/" + std::to_string(i) + "/" + kind + "/";
      bool told = false;
      for (std::size_t point = 0; point < origins[i].size(); ++point) {
        const std::string place = points + std::to_string(point) + "/0";
        told = told || design.bindings.contains(place);
        const double x = shape->sections[i].points[point].x(), columns = std::round(x / width->second.value);
        if (told && origins[i][point] != point && std::abs(x - columns * width->second.value) < kSame)
          design.bindings[place] = {std::to_string(int(columns)) + "*" + one, x};
      }
    }
}

Result<void> judge(const BlockGrid& grid, std::size_t cutsEach) {
  const std::size_t blocks = grid.count();
  if (blocks > std::size_t(BlockGrid::kMostBlocks))
    return fail(ErrorCode::badInput,
                std::to_string(blocks) + " blocks are too many; there may be " +
                    std::to_string(BlockGrid::kMostBlocks),
                "grid", double(blocks), double(BlockGrid::kMostBlocks));
  if (blocks * cutsEach > std::size_t(Design::kMostCuts))
    return fail(ErrorCode::badInput,
                std::to_string(blocks) + " blocks with " + std::to_string(cutsEach) +
                    " cuts each are too many; there may be " + std::to_string(Design::kMostCuts) + " cuts",
                "cuts", double(blocks * cutsEach), double(Design::kMostCuts));
  return {};
}

/// Whether the expression at `pointer` is of a length that `list`, which the file tells at `place`, no longer
/// has.
bool isGone(const std::string& pointer, const std::string& place, const std::vector<double>& list) {
  if (!pointer.starts_with(place)) return false;
  return list.empty() ||
         (pointer.size() > place.size() + 1 && std::stoul(pointer.substr(place.size() + 1)) >= list.size());
}

/// What tells where a block alone lies, and how large it is, tells the same of a grid, and the other way.
std::map<std::string, BoundNumber> carriedPlacement(const Design& design, bool wasGrid) {
  if (wasGrid == design.grid.has_value()) return {};
  const std::string stock = "/stock/0/block/", grid = "/grid/";
  std::map<std::string, BoundNumber> carried;
  const auto carry = [&](const std::string& inStock, const std::vector<std::string>& inGrid) {
    for (const std::string& place : wasGrid ? inGrid : std::vector{stock + inStock})
      if (const auto bound = design.bindings.find(place); bound != design.bindings.end())
        carried.emplace(wasGrid ? stock + inStock : inGrid.front(), bound->second);
  };
  for (std::size_t way = 0; way < 3; ++way) {
    const std::string axis = "/" + std::to_string(way), sizes = grid + "sizes/" + kGridWays[way];
    carry("size" + axis, {sizes, sizes + "/0"});
    for (const std::string key : {"origin", "rotation_deg"}) carry(key + axis, {grid + key + axis});
  }
  return carried;
}

/// Expressions of blocks that are counted otherwise now, and of lengths that are gone. One that is told for
/// all lengths of a way goes on for those that there are.
void dropBindings(Design& design, const BlockGrid& before, const BlockGrid& grid) {
  const bool counted = before.count() != grid.count();
  std::erase_if(design.bindings, [&](const auto& bound) {
    const auto in = [&](const std::string& part) { return bound.first.starts_with(part); };
    if (counted && in("/stock/")) return true;
    if (!design.grid) return in("/grid/");
    for (std::size_t way = 0; way < 3; ++way) {
      const std::string name = kGridWays[way];
      if (isGone(bound.first, "/grid/sizes/" + name, grid.sizes[way]) ||
          isGone(bound.first, "/grid/gaps/" + name, grid.gaps[way]))
        return true;
    }
    return false;
  });
}

/// Expressions go with their cuts where blocks stay; those of new blocks are told as those of the block
/// `like`.
void carryBindings(Design& changed, const Design& from, const std::map<std::string, std::string>& ids,
                   const std::string& like) {
  const std::vector<Cut> each = cutsLike(from, like);
  std::map<std::string, std::size_t> kept, alike;  // by the ids that they have now, and without blocks
  for (std::size_t i = 0; i < from.cuts.size(); ++i) {
    const Cut& cut = from.cuts[i];
    const std::string bare = withoutBlock(cut).id;
    if (cut.block == like && std::ranges::find(each, bare, &Cut::id) != each.end())
      alike.try_emplace(bare, i);
    if (const std::optional<Cut> now = from.grid ? carried(cut, ids) : std::nullopt)
      kept.try_emplace(changed.grid ? now->id : bare, i);
  }
  const auto placeIn = [](const std::map<std::string, std::size_t>& places, const std::string& id) {
    const auto found = places.find(id);
    return found == places.end() ? std::nullopt : std::optional(found->second);
  };
  changed.bindings = detail::withCutBindings(changed.bindings, changed.cuts.size(), [&](std::size_t index) {
    const Cut& cut = changed.cuts[index];
    // A block alone is the block `like`.
    const std::optional<std::size_t> own = placeIn(kept, cut.id),
                                     other = placeIn(alike, changed.grid ? withoutBlock(cut).id : cut.id);
    return changed.grid ? (own ? own : other) : (other ? other : own);
  });
}

}  // namespace

std::optional<BlockGrid> gridOf(const Design& design, const BlockPlacement& placed) {
  if (design.grid) return design.grid;
  if (design.stock.size() > 1) return std::nullopt;
  BlockGrid one;
  one.origin = placed.origin;
  one.rotation = placed.rotation;
  for (std::size_t way = 0; way < 3; ++way) one.sizes[way] = {placed.size[Eigen::Index(way)]};
  return one;
}

BlockGrid withCount(BlockGrid grid, std::size_t way, int count, bool divided) {
  std::vector<double>&sizes = grid.sizes[way], &gaps = grid.gaps[way];
  if (divided) {
    const double whole = grid.extent(way);
    sizes.assign(std::size_t(count), whole / count);
    gaps.assign(std::size_t(count) - 1, 0);
    return grid;
  }
  const double gap = gaps.empty() ? 0 : gaps.back();
  sizes.resize(std::size_t(count), sizes.back());
  gaps.resize(std::size_t(count) - 1, gap);
  return grid;
}

Result<Design> withGrid(const Design& design, const BlockGrid& before, const BlockGrid& grid,
                        const std::string& selected) {
  // A block that is left alone keeps its cuts.
  const std::string first = before.cells().front().id;
  const std::string& like = design.grid && grid.count() == 1 ? first : selected;
  const std::vector<Cut> each = cutsLike(design, like);
  if (Result<void> ok = judge(grid, each.size()); !ok) return tl::unexpected<Error>(ok.error());
  for (const auto& way : grid.sizes)
    for (const double size : way)
      if (!(size > 0)) return fail(ErrorCode::badInput, "a block must be larger than 0 mm", "grid", size, 0);
  Design changed = design;
  std::vector<Origins> origins(changed.sources.size());
  for (std::size_t i = 0; i < changed.sources.size(); ++i)
    if (std::optional<DesignedSurface>& surface = changed.sources[i].surface)
      followPoints(changed, i, origins[i] = reachOver(*surface, before, grid));
  const BlockGrid kept = named(grid, before);
  const std::map<std::string, std::string> ids = idsAfter(before, kept);
  changed.stock = stockOf(kept);
  std::vector<Cut> own;
  for (const Cut& cut : design.grid ? design.cuts : std::vector<Cut>())
    if (std::optional<Cut> there = carried(cut, ids))
      if (grid.count() > 1 || !isOfAll(design, cut)) own.push_back(std::move(*there));
  if (grid.count() == 1) {
    changed.grid.reset();
    changed.cuts = each;
    for (Cut& cut : own) changed.cuts.push_back(withoutBlock(std::move(cut)));
    for (Cut& cut : changed.cuts) cut.block = changed.block().id;
  } else {
    changed.grid = kept;
    changed.cuts = cutsOf(changed.stock, each, own);
  }
  carryBindings(changed, design, ids, like);
  std::map<std::string, BoundNumber> placed = carriedPlacement(changed, design.grid.has_value());
  dropBindings(changed, before, grid);
  changed.bindings.merge(placed);
  for (std::size_t i = 0; i < origins.size(); ++i) tellPlaces(changed, i, origins[i]);
  return changed;
}

}  // namespace bw
