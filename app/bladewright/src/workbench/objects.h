// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/design/design.h"
#include "bw/core/design/part_marks.h"
#include "bw/core/design/part_names.h"

namespace bw::app {

/// A part of a design: it is shown or hidden, locked, and renamed. Stations are neither locked nor renamed;
/// a curve (`bw/core/design/surface_curves.h`) is called after its place unless it was given a name.
struct Object {
  enum class Kind { block, cut, surface, stations, curve };
  Kind kind = Kind::block;
  std::string id;  ///< of the block, the cut, the source or the curve; for stations that of their cut
  auto operator<=>(const Object&) const = default;
};

/// The ids of objects of a kind among those that are marked.
const std::set<std::string>& idsOf(const PartIds& marked, Object::Kind kind);
std::set<std::string>& idsOf(PartIds& marked, Object::Kind kind);
/// All that are marked: of each id among those of sources both, the surface and the curve of that id.
std::vector<Object> objectsOf(const PartIds& marked);

/// What messages call it: "north", "section 2 of surface", "ridge (section 2) of surface".
std::string nameOf(const Design& design, const Object& object);

/// The design with another name for a block, a cut, a source or a curve wherever it stands; an empty one
/// calls a curve after its place again. Error `badInput`, with what to do: a name that is empty, taken,
/// longer than 60 characters or, but for curves, with one that no file can have. A block of a grid has its
/// cuts called after it; a cut of a grid is renamed with those of the other blocks, which end in their names.
Result<Design> renamed(const Design& design, const Object& object, const std::string& name);

/// Marks of parts that are called otherwise, under both names: undo brings the old ones back.
PartMarks withNewNames(PartMarks marks, const NewNames& names);

/// The first of these objects that is another in `after`, or gone, or in which something is: a cut holds its
/// surface, a block its cuts. Empty if all are as they were.
std::optional<Object> firstChanged(const std::vector<Object>& objects, const Design& before,
                                   const Design& after);

}  // namespace bw::app
