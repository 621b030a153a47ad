// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "design/design_keys.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "bw/core/base/units.h"
#include "bw/core/blade/blade_json.h"
#include "bw/core/design/process_numbers.h"
#include "bw/core/design/program_formats.h"
#include "bw/core/sweep/kerf_text.h"

namespace bw::detail {

using nlohmann::json;

namespace {

constexpr double kMaxSewing = 100;  ///< mm
constexpr const char* kFileUnit = "file";
constexpr double kMaxBlock = 1e6;  ///< mm
/// Coordinates of designs are at most this large, mm: ten kilometres.
constexpr double kFarthest = 1e7;

void readUnit(ObjectReader& reader, std::optional<LengthUnit>& unit) {
  std::vector<std::string> words = {kFileUnit};
  for (const LengthUnit u : kLengthUnits) words.push_back(lengthUnitName(u));
  int index = -1;
  reader.word("unit", words, index);
  if (index >= 0) unit = index == 0 ? std::nullopt : std::optional(kLengthUnits[std::size_t(index) - 1]);
}

void readSewing(ObjectReader& reader, std::optional<double>& sewing) {
  const json* value = reader.member("sewing");
  if (!value) return;
  if (*value == "auto")
    sewing.reset();
  else
    reader.number("sewing", sewing, 0, kMaxSewing);
}

void readBlock(ObjectReader& reader, std::optional<BlockPlacement>& block) {
  const json* value = reader.member("block");
  if (!value) return;
  if (value->is_string()) {
    if (value->get<std::string>() == "auto")
      block.reset();
    else
      reader.complain(
          "block", reader.path() + ".block must be \"auto\" or an object with origin, size and rotation_deg");
    return;
  }
  ObjectReader inner(*value, reader.path() + ".block", reader.scope());
  BlockPlacement placement;
  Eigen::Vector3d degrees = Eigen::Vector3d::Zero();
  inner.need("origin",
             inner.path() + " needs the key origin: its corner [x, y, z] in the file's frame, in mm");
  inner.need("size", inner.path() + " needs the key size: [dx, dy, dz] in mm");
  inner.vector3("origin", placement.origin, -kFarthest, kFarthest);
  inner.vector3("size", placement.size, 1.0, kMaxBlock);
  inner.vector3("rotation_deg", degrees, -360, 360);
  placement.rotation = degrees * kDegree;
  if (reader.adopt(inner.finish())) block = placement;
}

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

/// The keys "face" and "near".
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
      ObjectReader inner(*value, reader.path() + ".face", reader.scope());
      chosen.kind = FaceChoice::Kind::group;
      inner.need("group",
                 inner.path() + " needs the key group: the number of a group, as blade info lists it");
      inner.integer("group", chosen.group, 0, 100000000);
      if (!reader.adopt(inner.finish())) return;
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

/// Three numbers for a direction; of length one, unless some are told by expressions, which stand for them as
/// they are. Nothing where they lead nowhere, or are none.
std::optional<Eigen::Vector3d> readWay(ObjectReader& reader, const char* key, const char* remedy) {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  const json& value = *reader.member(key);
  reader.vector3(key, v, -1e12, 1e12);
  const double length = v.norm();
  if (length < 1e-9) {
    reader.complain(key, reader.path() + "." + key + " has length zero; " + remedy, length, 1e-9);
    return {};
  }
  const bool told =
      value.is_array() && std::ranges::any_of(value, [](const json& entry) { return entry.is_string(); });
  return told ? v : Eigen::Vector3d(v / length);
}

void readDirection(ObjectReader& reader, std::optional<Eigen::Vector3d>& direction) {
  const json* value = reader.member("direction");
  if (!value) return;
  if (value->is_string()) {
    const std::string word = value->get<std::string>();
    if (word == "auto") {
      direction.reset();
    } else if (word == "x" || word == "y" || word == "z") {
      direction = Eigen::Vector3d::Unit(word[0] - 'x');
    } else {
      reader.complain("direction",
                      reader.path() +
                          ".direction must be \"auto\", \"x\", \"y\", \"z\" or three numbers, not \"" + word +
                          "\"");
    }
    return;
  }
  if (const auto way = readWay(reader, "direction", "give the way the blade travels")) direction = way;
}

void readStations(ObjectReader& reader, SectionRequest& sections) {
  const json* value = reader.member("stations");
  if (!value) return;
  if (value->is_object()) {
    ObjectReader inner(*value, reader.path() + ".stations", reader.scope());
    double spacing = 0;
    inner.number("spacing", spacing, 0.01, 1e5);
    inner.need("spacing", inner.path() + " needs the key spacing in mm");
    if (reader.adopt(inner.finish())) sections.spacing = spacing;
    return;
  }
  sections.spacing.reset();
  const std::string word = value->is_string() ? value->get<std::string>() : std::string();
  if (word == "auto") return sections.stations.reset();
  if (value->is_string() && !word.starts_with('=')) {
    reader.complain("stations", reader.path() +
                                    ".stations must be \"auto\", a number from 2, or an "
                                    "object with spacing, not \"" +
                                    word + "\"");
    return;
  }
  int stations = 0;
  reader.integer("stations", stations, 2, SectionRequest::kMost);
  sections.stations = stations;
}

/// The key "turn_deg".
void readTurn(ObjectReader& reader, int& quarters) {
  constexpr int kQuarter = 90;
  int degrees = kQuarter * quarters;
  reader.integer("turn_deg", degrees, 0, 3 * kQuarter);
  if (degrees % kQuarter != 0)
    reader.complain("turn_deg",
                    reader.path() + ".turn_deg must be 0, 90, 180 or 270, not " + std::to_string(degrees) +
                        ": a block lies on one of its faces along the work object",
                    degrees, kQuarter * ((degrees + kQuarter / 2) / kQuarter));
  quarters = degrees / kQuarter;
}

void readOrder(ObjectReader& reader, std::optional<int>& order) {
  const json* value = reader.member("order");
  if (!value) return;
  if (*value == "auto") return order.reset();
  int place = 1;
  reader.integer("order", place, 1, Cut::kMostOrder);
  order = place;
}

void readCutLength(ObjectReader& reader, std::optional<double>& length) {
  const json* value = reader.member("blade_length");
  if (!value) return;
  if (*value == "blade") return length.reset();
  reader.number("blade_length", length, 10, Blade::kLongest);
}

/// The key "up".
void readUp(ObjectReader& reader, std::optional<Eigen::Vector3d>& up) {
  const json* told = reader.member("up");
  if (!told) return;
  if (told->is_string()) {
    int block = 0;
    reader.word("up", {kUpOfBlock}, block);
    return up.reset();
  }
  Eigen::Vector3d v = Eigen::Vector3d::UnitZ();
  reader.vector3("up", v, -1e12, 1e12);
  const double length = v.norm();
  if (length < 1e-9)
    reader.complain("up",
                    reader.path() + ".up has length zero; give the way up in the file's frame, or \"block\"",
                    length, 1e-9);
  else
    up = v;  // as it is told: only its direction counts
}

/// The key "kerf" where it is a list: pairs of speed and width.
void readKerfTable(ObjectReader& reader, const json& list, KerfTable& table) {
  const std::string path = reader.path() + ".kerf";
  if (list.size() < kLeastKerfEntries || list.size() > kMostKerfEntries)
    return reader.complain("kerf",
                           path + " must be a width in mm, or a list of " +
                               std::to_string(kLeastKerfEntries) + " to " + std::to_string(kMostKerfEntries) +
                               " pairs [speed in mm/s, width in mm], not of " + std::to_string(list.size()),
                           double(list.size()),
                           double(list.size() < kLeastKerfEntries ? kLeastKerfEntries : kMostKerfEntries));
  KerfTable read;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string entry = "kerf[" + std::to_string(i) + "]";
    if (!list[i].is_array() || list[i].size() != 2)
      return reader.complain("kerf", reader.path() + "." + entry +
                                         " must be a pair [speed in mm/s, width in mm], as in [20, 2.6]");
    KerfAt at;
    if (!reader.number("kerf", entry + "[0]", list[i][0], at.speed, 0, kFastestKerfEntry) ||
        !reader.number("kerf", entry + "[1]", list[i][1], at.width, 0, kWidestKerf))
      return;
    read.push_back(at);
  }
  if (const std::optional<std::string> fault = faultOf(read))
    return reader.complain("kerf", path + ": " + *fault);
  table = std::move(read);
}

/// The key "grip_error" where it is an object: mm and degrees.
void readGripError(ObjectReader& reader, const json& object, Process& process) {
  ObjectReader inner(object, reader.path() + ".grip_error", reader.scope());
  for (const ProcessNumber& number : processNumbers()) {
    const bool turn = number.member == &Process::gripAngle;
    if (turn && inner.member("deg") && reader.member(number.key))
      return reader.complain(
          number.key, reader.path() + "." + number.key + ": it is told by grip_error, too; tell it once");
    if (turn || number.member == &Process::gripError)
      inner.number(turn ? "deg" : "mm", process.*number.member, number.min, number.max);
  }
  reader.adopt(inner.finish());
}

/// The numbers of the process that stand in an object of that key; null: in none.
void readNumbers(ObjectReader& reader, const char* object, Process& process) {
  for (const ProcessNumber& number : processNumbers()) {
    if (object ? !number.object || std::string_view(number.object) != object : number.object != nullptr)
      continue;
    const bool either = number.member == &Process::kerf || number.member == &Process::gripError;
    const json* value = either ? reader.member(number.key) : nullptr;
    if (value && value->is_array() && number.member == &Process::kerf)
      readKerfTable(reader, *value, process.kerfTable);
    else if (value && value->is_object() && number.member == &Process::gripError)
      readGripError(reader, *value, process);
    else
      reader.number(number.key, process.*number.member, number.min, number.max);
  }
}

void readFit(ObjectReader& reader, Process& process) {
  const json* value = reader.member("fit");
  if (!value) return;
  ObjectReader inner(*value, reader.path() + ".fit", reader.scope());
  int length = int(process.fitLength);
  inner.word("length", {"free", "exact"}, length);
  process.fitLength = FitOptions::Length(length);
  inner.boolean("endpoints", process.fitEndpoints);
  inner.boolean("tangents", process.fitTangents);
  int extend = int(process.extend);
  inner.word("extend", {kExtensions.begin(), kExtensions.end()}, extend);
  process.extend = Extension(extend);
  readNumbers(inner, "fit", process);
  reader.adopt(inner.finish());
}

void readJoin(ObjectReader& reader, Process& process) {
  const json* value = reader.member("join");
  if (!value) return;
  ObjectReader inner(*value, reader.path() + ".join", reader.scope());
  int type = int(process.join);
  inner.word("type", {kJoins.begin(), kJoins.end()}, type);
  process.join = Join(type);
  readNumbers(inner, "join", process);
  reader.adopt(inner.finish());
}

void readPrograms(ObjectReader& reader, std::vector<std::string>& programs) {
  const json* value = reader.member("programs");
  if (!value) return;
  if (!value->is_array()) {
    reader.complain("programs", reader.path() + ".programs must be a list such as [\"rapid\", \"csv\"]");
    return;
  }
  std::vector<std::string> result;
  for (const json& entry : *value) {
    const std::string word = entry.is_string() ? entry.get<std::string>() : entry.dump();
    if (!entry.is_string() || !programFormat(word)) {
      const std::string nearest = nearestProgramFormat(word);
      reader.complain("programs", reader.path() + ".programs: the formats are " + programFormatWords() +
                                      ", not " + word +
                                      (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
      return;
    }
    if (std::find(result.begin(), result.end(), word) == result.end()) result.push_back(word);
  }
  programs = std::move(result);
}

void readPlanes(ObjectReader& reader) {
  const json* planes = reader.member("planes");
  if (!planes) return;
  ObjectReader inner(*planes, reader.path() + ".planes", reader.scope());
  int type = 0;
  inner.word("type", {"parallel"}, type);
  reader.adopt(inner.finish());
}

json stationsJson(const SectionRequest& sections) {
  if (sections.spacing) return {{"spacing", *sections.spacing}};
  return sections.stations ? json(*sections.stations) : json("auto");
}

json vectorJson(const Eigen::Vector3d& v) { return json::array({v.x(), v.y(), v.z()}); }

}  // namespace

double degreesThatRead(double angle) {
  const double degrees = angle / kDegree;
  constexpr double kAll = std::numeric_limits<double>::infinity();
  for (const double near : {degrees, std::nextafter(degrees, kAll), std::nextafter(degrees, -kAll)})
    if (near * kDegree == angle) return near;
  return degrees;
}

Eigen::Vector3d degreesThatRead(const Eigen::Vector3d& angles) {
  return angles.unaryExpr([](double angle) { return degreesThatRead(angle); });
}

void readSourceKeys(ObjectReader& reader, Source& source) {
  readUnit(reader, source.unit);
  readSewing(reader, source.sewing);
}

void readPlacement(ObjectReader& reader, StockBlock& block) { readBlock(reader, block.placement); }

void readCutKeys(ObjectReader& reader, Cut& cut) {
  readFaceChoice(reader, cut.face);
  readDirection(reader, cut.direction);
  readPlanes(reader);
  readStations(reader, cut.sections);
  int route = int(cut.sections.route);
  reader.word("sections", {kSectionRoutes.begin(), kSectionRoutes.end()}, route);
  cut.sections.route = SectionRoute(route);
}

void readBlockCutKeys(ObjectReader& reader, Cut& cut) {
  int face = int(cut.pose.up), keep = int(cut.keep);
  reader.word("face_up", {kBlockFaces.begin(), kBlockFaces.end()}, face);
  cut.pose.up = BlockFace(face);
  readTurn(reader, cut.pose.quarters);
  reader.word("keep", {kKeptSides.begin(), kKeptSides.end()}, keep);
  cut.keep = KeptSide(keep);
  readOrder(reader, cut.order);
  readCutLength(reader, cut.length);
  reader.number("offset", cut.offset, 0, Cut::kMostOffset);
}

void readProcessKeys(ObjectReader& reader, Process& process) {
  readFit(reader, process);
  readJoin(reader, process);
  readNumbers(reader, nullptr, process);
  reader.boolean("weight", process.weight);
  readUp(reader, process.up);
}

void readOutputKeys(ObjectReader& reader, Output& output) {
  readPrograms(reader, output.programs);
  reader.text("cell", output.cell);
}

Result<void> readBladeKeys(ObjectReader& reader, const json& object, Blade& blade) {
  // A blade that is written whole (as designs store it) needs no preset.
  const bool whole = object.is_object() && object.contains("blade") && object["blade"].is_object() &&
                     object["blade"].contains("name");
  if (Result<Blade> preset = bladePreset(blade.name))
    blade = std::move(*preset);
  else if (!whole)
    return tl::unexpected<Error>(preset.error());
  readBlade(reader, blade);
  return {};
}

void writeSourceKeys(const Source& source, json& object) {
  object["unit"] = source.unit ? lengthUnitName(*source.unit) : kFileUnit;
  object["sewing"] = source.sewing ? json(*source.sewing) : json("auto");
}

void writePlacement(const StockBlock& block, json& object) {
  object["block"] = "auto";
  if (block.placement)
    object["block"] = {{"origin", vectorJson(block.placement->origin)},
                       {"size", vectorJson(block.placement->size)},
                       {"rotation_deg", vectorJson(degreesThatRead(block.placement->rotation))}};
}

void writeCutKeys(const Cut& cut, json& object) {
  writeFaceChoice(cut.face, object);
  object["direction"] = cut.direction ? vectorJson(*cut.direction) : json("auto");
  object["planes"] = {{"type", "parallel"}};
  object["stations"] = stationsJson(cut.sections);
  object["sections"] = kSectionRoutes[std::size_t(cut.sections.route)];
}

void writeBlockCutKeys(const Cut& cut, json& object, const BoundBelow& isBound) {
  if (cut.pose.up != BlockFace::top) object["face_up"] = kBlockFaces[std::size_t(cut.pose.up)];
  if (cut.pose.quarters != 0 || isBound("/turn_deg")) object["turn_deg"] = 90 * cut.pose.quarters;
  if (cut.keep != KeptSide::below) object["keep"] = kKeptSides[std::size_t(cut.keep)];
  if (cut.order) object["order"] = *cut.order;
  if (cut.length) object["blade_length"] = *cut.length;
  if (cut.offset != 0 || isBound("/offset")) object["offset"] = cut.offset;
}

void writeProcessKeys(const Process& process, json& object) {
  object["fit"] = {{"length", process.fitLength == FitOptions::Length::exact ? "exact" : "free"},
                   {"endpoints", process.fitEndpoints},
                   {"tangents", process.fitTangents}};
  if (process.extend != Extension::none) object["fit"]["extend"] = kExtensions[std::size_t(process.extend)];
  object["join"] = {{"type", kJoins[std::size_t(process.join)]}};
  for (const ProcessNumber& number : processNumbers())
    (number.object ? object[number.object] : object)[number.key] = process.*number.member;
  if (!process.kerfTable.empty()) {
    object["kerf"] = json::array();
    for (const KerfAt& entry : process.kerfTable)
      object["kerf"].push_back(json::array({entry.speed, entry.width}));
  }
  object["weight"] = process.weight;
  object["up"] = process.up ? vectorJson(*process.up) : json(kUpOfBlock);
}

}  // namespace bw::detail
