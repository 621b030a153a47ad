// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "design/face_choice.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace bw {

using nlohmann::json;

namespace {

std::optional<int> indexOf(const json& value) {
  if (!value.is_number_integer()) return std::nullopt;
  const double x = value.get<double>();
  if (x < 0 || x > 1e8) return std::nullopt;
  return int(x);
}

/// A list of indices, or of names; false if it is neither.
bool readList(const json& list, FaceChoice& face) {
  for (const json& entry : list) {
    if (const std::optional<int> i = indexOf(entry)) {
      face.indices.push_back(*i);
    } else if (entry.is_string() && !entry.get<std::string>().empty()) {
      face.names.push_back(entry.get<std::string>());
    } else {
      return false;
    }
  }
  if (face.indices.empty() == face.names.empty()) return false;
  face.kind = face.names.empty() ? FaceChoice::Kind::indices : FaceChoice::Kind::named;
  std::sort(face.indices.begin(), face.indices.end());
  face.indices.erase(std::unique(face.indices.begin(), face.indices.end()), face.indices.end());
  return true;
}

}  // namespace

void readFaceChoice(ObjectReader& reader, FaceChoice& face) {
  if (const json* value = reader.member("face")) {
    FaceChoice chosen;
    bool good = true;
    if (value->is_string() && !value->get<std::string>().empty()) {
      const std::string word = value->get<std::string>();
      if (word == "all") {
        chosen.kind = FaceChoice::Kind::all;
      } else if (word != "largest") {
        chosen.kind = FaceChoice::Kind::named;
        chosen.names = {word};
      }
    } else if (value->is_array()) {
      good = readList(*value, chosen);
    } else if (value->is_object()) {
      ObjectReader inner(*value, reader.path() + ".face");
      chosen.kind = FaceChoice::Kind::group;
      inner.need("group",
                 inner.path() + " needs the key group: the number of a group, as blade info lists it");
      inner.integer("group", chosen.group, 0, 100000000);
      if (Result<void> ok = inner.finish(); !ok) {
        reader.adopt(inner);
        return;
      }
    } else {
      good = readList(json::array({*value}), chosen);
    }
    if (!good) {
      reader.complain("face",
                      reader.path() +
                          ".face must be \"largest\", \"all\", an index from 0 or a list of indices, a "
                          "name or a list of names, or {\"group\": number}");
      return;
    }
    face = std::move(chosen);
  }
  const json* near = reader.member("near");
  if (!near || near->is_null()) return;
  if (face.kind != FaceChoice::Kind::largest) {
    reader.complain("near", reader.path() + " chooses faces twice, by face and by near; keep one of them");
    return;
  }
  face.kind = FaceChoice::Kind::nearest;
  reader.vector3("near", face.point, -kFarthest, kFarthest);
}

void writeFaceChoice(const FaceChoice& face, json& object) {
  object["near"] = nullptr;
  switch (face.kind) {
    case FaceChoice::Kind::largest:
      object["face"] = "largest";
      break;
    case FaceChoice::Kind::all:
      object["face"] = "all";
      break;
    case FaceChoice::Kind::indices:
      object["face"] = face.indices;
      break;
    case FaceChoice::Kind::named:
      object["face"] = face.names;
      break;
    case FaceChoice::Kind::group:
      object["face"] = {{"group", face.group}};
      break;
    case FaceChoice::Kind::nearest:
      object["face"] = "largest";
      object["near"] = {face.point.x(), face.point.y(), face.point.z()};
      break;
  }
}

}  // namespace bw
