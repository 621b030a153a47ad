// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bw/scene/scene.h"
#include "scene/legend/legend_range.h"

namespace bw::scene {

struct Row;

/// One map as it is shown: its field in every row that has it, under one range; or, of creases, in them.
struct ShownMap {
  const Field* field = nullptr;  ///< of one of the rows, for its words
  std::vector<Row*> rows;
  std::vector<std::pair<ItemId, const Creases*>> creases;  ///< in sight, where it is theirs
  FieldSummary summary;
  ColorMap colors;
};

/// A row of blades: what the items of one path (block, cut, strip) are together.
struct Row {
  ItemId id;
  const CutSurface* cut = nullptr;
  TriangleMesh mesh;          ///< of the cut surface; empty if it has none that can be drawn
  std::vector<double> areas;  ///< of each of its points the third of the triangles around it, mm²
  const std::vector<Polyline>*stations, *blades;
  const Box* block = nullptr;
  std::map<std::string, FieldSummary> summaries;  ///< of the fields asked for so far
  const ShownMap* map = nullptr;                  ///< that the style wants, or none

  const TriangleMesh& surface() const { return mesh; }
  const Field* field() const { return map ? cut->grid.field(map->colors.field) : nullptr; }
  /// Whether the cut surface is seen.
  bool covered(const Style& style) const {
    const Look& look = style.of(Kind::cut, id);
    return !mesh.triangles.empty() && look.visible && look.opacity > 0;
  }
};

/// A block and what belongs to it; without a box it holds the rows that stand in none.
struct Stock {
  ItemId id;
  const Box* box = nullptr;
  std::map<int, const Travel*> travels;      ///< of its cuts, by their number
  const FoamPart* part = nullptr;            ///< what is left of it
  std::map<ItemId, const Creases*> creases;  ///< between its cuts
  std::vector<const Row*> rows;
  TriangleMesh cuts;              ///< of its rows together
  const ShownMap* map = nullptr;  ///< of its creases, where the style wants it
};

struct ShownTarget {
  ItemId id;
  const TriangleMesh* mesh;
  const TriangleMesh& surface() const { return *mesh; }
};

/// The items of a content, put together by what is drawn of them. Points into the content.
struct Things {
  /// Places of those that are other things than before.
  struct Changes {
    std::set<std::size_t> targets, rows, stocks;
    std::vector<TriangleMesh> former;  ///< what their meshes were
  };

  Things() = default;
  /// Takes away what cannot be drawn, and sorts the rest.
  explicit Things(Content& content);
  /// Takes in that items of the content, in their places, have other data; `items` says which.
  Changes renew(const Content& items);

  std::vector<ShownTarget> targets;
  std::deque<Row> rows;
  std::vector<Stock> stocks;
  std::shared_ptr<const FaceMesh> faces;
  std::map<ItemId, const ToldMarks*> told;
  Field creaseField;  ///< words of the map of creases, made where it is shown
};

/// Takes away of an item what cannot be drawn; false where nothing is left of it.
bool drawable(Item& item);

/// The word of the map of creases, which is theirs and no cut surface's.
inline constexpr const char* kCreaseMap = "crease";

/// The maps that a style asks for, by their word; tells each row its own. A map's range is that of all rows
/// in sight that have it, of all that have it where none is. That of creases is asked for as that of all cut
/// surfaces is; its limit is the tolerance.
std::map<std::string, ShownMap> shownMaps(Things& things, const Style& style);

}  // namespace bw::scene
