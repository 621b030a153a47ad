// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/things.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

#include "bw/core/sweep/maps.h"

namespace bw::scene {

namespace {

/// Whether the corners of a triangle are there and finite.
bool drawable(const std::array<int, 3>& triangle, const TriangleMesh& mesh) {
  return std::ranges::all_of(triangle, [&](int i) {
    return i >= 0 && i < int(mesh.points.size()) && mesh.points[std::size_t(i)].allFinite();
  });
}

/// Drops what cannot be drawn, so that the rest can.
void cleanMesh(TriangleMesh& mesh) {
  std::erase_if(mesh.triangles, [&](const std::array<int, 3>& t) { return !drawable(t, mesh); });
  // Points that no triangle uses must still be numbers, for the bounds and for the graphics card.
  for (Eigen::Vector3d& p : mesh.points) {
    if (!p.allFinite())
      p = mesh.triangles.empty() ? Eigen::Vector3d::Zero() : mesh.points[std::size_t(mesh.triangles[0][0])];
  }
  if (mesh.normals.size() != mesh.points.size()) mesh.normals.clear();
  if (mesh.triangles.empty()) mesh = {};
}

/// Whether all of it can be drawn and every triangle has its face.
bool sound(const FaceMesh& faces) {
  const TriangleMesh& mesh = faces.mesh;
  return !mesh.triangles.empty() && faces.faces.size() == mesh.triangles.size() &&
         (mesh.normals.empty() || mesh.normals.size() == mesh.points.size()) &&
         std::ranges::all_of(faces.faces, [](int face) { return face >= 0; }) &&
         std::ranges::all_of(mesh.points, [](const Eigen::Vector3d& p) { return p.allFinite(); }) &&
         std::ranges::all_of(mesh.triangles, [&](const auto& t) { return drawable(t, mesh); });
}

/// Of each point the third of the triangles around it, mm².
std::vector<double> pointAreas(const TriangleMesh& mesh) {
  std::vector<double> areas(mesh.points.size(), 0.0);
  for (const auto& triangle : mesh.triangles) {
    const auto corner = [&](std::size_t i) { return mesh.points[std::size_t(triangle[i])]; };
    const double area = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    for (const int i : triangle) areas[std::size_t(i)] += area / 3;
  }
  return areas;
}

/// Has a mesh end where the depths of its points fall to 0: triangles below are dropped, and points of those
/// on the border that lie below are moved to it, along their edges.
void endWhereLeft(TriangleMesh& mesh, const std::vector<double>& depths) {
  const auto gone = [&](int corner) { return depths[std::size_t(corner)] < 0; };
  std::erase_if(mesh.triangles, [&](const std::array<int, 3>& t) { return std::ranges::all_of(t, gone); });
  std::map<int, std::pair<Eigen::Vector3d, int>> border;  // the sum of places, and how many they are
  for (const std::array<int, 3>& t : mesh.triangles)
    for (const int out : t)
      for (const int in : t) {
        if (!gone(out) || gone(in)) continue;
        const double part = depths[std::size_t(in)] / (depths[std::size_t(in)] - depths[std::size_t(out)]);
        const Eigen::Vector3d &a = mesh.points[std::size_t(in)], &b = mesh.points[std::size_t(out)];
        if (!std::isfinite(part) || !a.allFinite() || !b.allFinite()) continue;
        auto& [sum, count] = border.try_emplace(out, Eigen::Vector3d::Zero(), 0).first->second;
        sum += a + part * (b - a);
        ++count;
      }
  for (const auto& [point, places] : border) mesh.points[std::size_t(point)] = places.first / places.second;
}

/// The mesh of a row's cut surface.
void makeMesh(Row& row) {
  row.mesh = {};
  row.areas.clear();
  row.summaries.clear();
  if (!row.cut) return;
  const SurfaceGrid& grid = row.cut->grid;
  if (grid.rows < 2 || grid.columns < 2 ||
      grid.points.size() != std::size_t(grid.rows) * std::size_t(grid.columns))
    return;
  row.mesh = grid.triangles();
  if (row.cut->depths.size() == grid.points.size()) endWhereLeft(row.mesh, row.cut->depths);
  cleanMesh(row.mesh);
  row.areas = pointAreas(row.mesh);
}

/// The cut surfaces of a block, together.
void makeCuts(Stock& stock) {
  stock.cuts = {};
  for (const Row* row : stock.rows) {
    const int first = int(stock.cuts.points.size());
    stock.cuts.points.insert(stock.cuts.points.end(), row->mesh.points.begin(), row->mesh.points.end());
    for (const std::array<int, 3>& t : row->mesh.triangles)
      stock.cuts.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

}  // namespace

bool drawable(Item& item) {
  if (TriangleMesh* target = std::get_if<TriangleMesh>(&item.data)) {
    cleanMesh(*target);
    return !target->triangles.empty();
  }
  if (FoamPart* part = std::get_if<FoamPart>(&item.data)) {
    cleanMesh(part->mesh);
    return !part->mesh.triangles.empty();
  }
  if (Creases* creases = std::get_if<Creases>(&item.data)) {
    for (std::vector<Polyline>* lines : {&creases->within, &creases->beyond})
      std::erase_if(*lines, [](const Polyline& line) {
        return line.size() < 2 || !std::ranges::all_of(line, [](const auto& p) { return p.allFinite(); });
      });
    for (std::size_t i = creases->curves.size(); i-- > 0;) {
      const Polyline& curve = creases->curves[i];
      const bool good = i < creases->off.size() && creases->off[i].size() == curve.size() &&
                        curve.size() >= 2 &&
                        std::ranges::all_of(curve, [](const auto& p) { return p.allFinite(); });
      if (good) continue;
      creases->curves.erase(creases->curves.begin() + std::ptrdiff_t(i));
      if (i < creases->off.size()) creases->off.erase(creases->off.begin() + std::ptrdiff_t(i));
    }
    creases->off.resize(creases->curves.size());
    return !creases->within.empty() || !creases->beyond.empty();
  }
  if (ToldMarks* marks = std::get_if<ToldMarks>(&item.data)) {
    std::erase_if(marks->lines, [](const Polyline& line) {
      return line.size() < 2 || !std::ranges::all_of(line, [](const auto& p) { return p.allFinite(); });
    });
    return !marks->lines.empty();
  }
  if (const Box* box = std::get_if<Box>(&item.data))
    return box->size.allFinite() && box->frame.origin.allFinite() && (box->size.array() > 0).all();
  if (const Faces* faces = std::get_if<Faces>(&item.data)) return faces->mesh && sound(*faces->mesh);
  return true;
}

namespace {

Row& rowOf(Things& things, const ItemId& id) {
  static const std::vector<Polyline> kNone;
  for (Row& row : things.rows)
    if (row.id == id.row()) return row;
  Row row;
  row.id = id.row();
  row.stations = row.blades = &kNone;
  return things.rows.emplace_back(std::move(row));
}

Stock& stockOf(Things& things, int block) {
  for (Stock& stock : things.stocks)
    if (stock.id.block == block) return stock;
  Stock& stock = things.stocks.emplace_back();
  stock.id.block = block;
  return stock;
}

const FieldSummary& summaryOf(Row& row, const Field& field) {
  const auto [place, added] = row.summaries.try_emplace(field.name);
  if (added) place->second = summarize(field.values);
  return place->second;
}

}  // namespace

Things::Things(Content& content) {
  std::erase_if(content.items, [](Item& item) { return !drawable(item); });
  for (const Item& item : content.items) {
    if (const auto* target = std::get_if<TriangleMesh>(&item.data)) targets.push_back({item.id, target});
    if (const auto* stations = std::get_if<Stations>(&item.data))
      rowOf(*this, item.id).stations = &stations->lines;
    if (const auto* blades = std::get_if<Blades>(&item.data)) rowOf(*this, item.id).blades = &blades->lines;
    if (const auto* box = std::get_if<Box>(&item.data)) stockOf(*this, item.id.block).box = box;
    if (const auto* travel = std::get_if<Travel>(&item.data))
      stockOf(*this, item.id.block).travels[item.id.cut] = travel;
    if (const auto* part = std::get_if<FoamPart>(&item.data)) stockOf(*this, item.id.block).part = part;
    if (const auto* creases = std::get_if<Creases>(&item.data))
      stockOf(*this, item.id.block).creases[item.id] = creases;
    if (const auto* all = std::get_if<Faces>(&item.data); all && !faces) faces = all->mesh;
    if (const auto* marks = std::get_if<ToldMarks>(&item.data)) told[item.id] = marks;
    if (const auto* cut = std::get_if<CutSurface>(&item.data)) {
      Row& row = rowOf(*this, item.id);
      row.cut = cut;
      makeMesh(row);
    }
  }
  for (Row& row : rows) {
    Stock& stock = stockOf(*this, row.id.block);
    row.block = stock.box;
    stock.rows.push_back(&row);
  }
  for (Stock& stock : stocks) makeCuts(stock);
}

Things::Changes Things::renew(const Content& items) {
  Changes changes;
  for (const Item& item : items.items) {
    switch (item.kind()) {
      case Kind::target:
        for (std::size_t i = 0; i < targets.size(); ++i)
          if (targets[i].id == item.id) changes.targets.insert(i);
        break;
      case Kind::cut:
      case Kind::station:
      case Kind::blade:
        for (std::size_t i = 0; i < rows.size(); ++i) {
          if (rows[i].id != item.id.row()) continue;
          changes.rows.insert(i);
          if (item.kind() != Kind::cut) continue;
          changes.former.push_back(std::move(rows[i].mesh));
          makeMesh(rows[i]);
        }
        break;
      default:
        break;
    }
    for (std::size_t i = 0; i < stocks.size(); ++i)
      if (stocks[i].id.block == item.id.block && item.kind() != Kind::target) changes.stocks.insert(i);
    // Blades are drawn otherwise within their block.
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (item.kind() == Kind::block && rows[i].id.block == item.id.block) changes.rows.insert(i);
  }
  for (const std::size_t i : changes.stocks) makeCuts(stocks[i]);
  return changes;
}

namespace {

/// How far creases lie off, of those in sight where there are any, else of all.
void addCreaseMap(Things& things, const Style& style, std::map<std::string, ShownMap>& maps) {
  ShownMap map;
  for (const bool hiddenToo : {false, true})
    for (const Stock& stock : things.stocks)
      for (const auto& [id, creases] : stock.creases)
        if (!creases->curves.empty() &&
            (hiddenToo ? map.creases.empty() : style.of(Kind::crease, id).visible))
          map.creases.emplace_back(id, creases);
  Field& field = things.creaseField;
  const MapInfo* info = cutMap(kCreaseMap);
  field = {kCreaseMap, info->title, info->unit, {}};
  for (const auto& [id, creases] : map.creases)
    for (const std::vector<double>& off : creases->off)
      field.values.insert(field.values.end(), off.begin(), off.end());
  map.summary = summarize(field.values);
  if (map.summary.count == 0) return;
  map.field = &field;
  if (style.tolerance > 0) map.colors.limit = style.tolerance;
  maps[kCreaseMap] = std::move(map);
}

}  // namespace

std::map<std::string, ShownMap> shownMaps(Things& things, const Style& style) {
  std::map<std::string, ShownMap> maps;
  for (const bool hiddenToo : {false, true}) {
    const std::map<std::string, ShownMap> seen = maps;
    for (Row& row : things.rows) {
      const Look& look = style.of(Kind::cut, row.id);
      const Field* field = row.cut ? row.cut->grid.field(look.map) : nullptr;
      if (row.mesh.points.empty() || !field || field->values.size() != row.mesh.points.size() ||
          look.visible == hiddenToo || seen.contains(look.map))
        continue;
      const FieldSummary& summary = summaryOf(row, *field);
      if (summary.count == 0) continue;
      ShownMap& map = maps[look.map];
      const FieldSummary& known = map.summary;
      map.summary = map.rows.empty()
                        ? summary
                        : FieldSummary{std::min(known.min, summary.min), std::max(known.max, summary.max),
                                       known.count + summary.count};
      if (!map.field) map.field = field;
      map.rows.push_back(&row);
      const auto limit = row.cut->limits.find(field->name);
      if (limit != row.cut->limits.end() && limit->second > 0 && std::isfinite(limit->second))
        map.colors.limit = std::max(map.colors.limit.value_or(0), limit->second);
    }
  }
  if (style[Kind::cut].map == kCreaseMap) addCreaseMap(things, style, maps);
  for (Row& row : things.rows) row.map = nullptr;
  for (auto& [word, map] : maps) {
    map.colors = {word, legendRangeOf(word, map.summary, style, map.colors.limit), style.tolerance,
                  map.colors.limit};
    for (Row* row : map.rows) row->map = &map;
  }
  const auto ofCreases = maps.find(kCreaseMap);
  for (Stock& stock : things.stocks) stock.map = ofCreases == maps.end() ? nullptr : &ofCreases->second;
  return maps;
}

}  // namespace bw::scene
