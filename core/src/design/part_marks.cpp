// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/part_marks.h"

#include <algorithm>

#include "bw/core/design/surface_curves.h"
#include "design/design_keys.h"

namespace bw {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

using Ids = std::set<std::string>;

template <class Part>
Ids idsOf(const std::vector<Part>& parts) {
  Ids ids;
  for (const Part& part : parts) ids.insert(part.id);
  return ids;
}

Ids curveIds(const Design& design) {
  Ids ids;
  for (const Source& source : design.sources)
    for (int i = 0; source.surface && i < curveCount(*source.surface); ++i) ids.insert(curveId(source.id, i));
  return ids;
}

/// One of the lists: its key, and what messages call an entry.
struct List {
  const char* key;
  Ids PartIds::*member;
  const char* what;
  Ids there;  ///< the ids that the design has
};

std::vector<List> listsOf(const Design& design) {
  return {{"stock", &PartIds::stock, "block", idsOf(design.stock)},
          {"cuts", &PartIds::cuts, "cut", idsOf(design.cuts)},
          {"sources", &PartIds::sources, "source", idsOf(design.sources)},
          {"curves", &PartIds::sources, "curve", curveIds(design)},
          {"stations", &PartIds::stations, "cut", idsOf(design.cuts)}};
}

void readIds(ObjectReader& reader, const List& list, Ids& ids) {
  const json* value = reader.member(list.key);
  if (!value) return;
  const std::string path = reader.path() + "." + list.key;
  if (!value->is_array() || !std::ranges::all_of(*value, [](const json& id) { return id.is_string(); }))
    return reader.complain(list.key, path + " must be a list of ids");
  for (const json& entry : *value) {
    const std::string id = entry.get<std::string>();
    if (!list.there.contains(id))
      return reader.complain(list.key, path + " names \"" + id + "\", but the design has no " + list.what +
                                           " of that id; take it out of the list");
    ids.insert(id);
  }
}

void read(ObjectReader& reader, const char* key, const std::vector<List>& lists, PartIds& marked) {
  const json* value = reader.member(key);
  if (!value) return;
  ObjectReader inner(*value, reader.path() + "." + key);
  for (const List& list : lists) readIds(inner, list, marked.*list.member);
  reader.adopt(inner.finish());
}

void write(ordered_json& object, const char* key, const std::vector<List>& lists, const PartIds& marked) {
  ordered_json written = ordered_json::object();
  for (const List& list : lists) {
    json ids = json::array();
    for (const std::string& id : marked.*list.member)
      if (list.there.contains(id)) ids.push_back(id);
    if (!ids.empty()) written[list.key] = ids;
  }
  if (!written.empty()) object[key] = std::move(written);
}

}  // namespace

void detail::readMarks(ObjectReader& reader, Design& design) {
  read(reader, "hidden", listsOf(design), design.marks.hidden);
  read(reader, "locked", listsOf(design), design.marks.locked);
}

void detail::writeMarks(const Design& design, ordered_json& object) {
  write(object, "hidden", listsOf(design), design.marks.hidden);
  write(object, "locked", listsOf(design), design.marks.locked);
}

}  // namespace bw
