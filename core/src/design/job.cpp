// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/job.h"

#include <algorithm>
#include <cmath>

#include "blade/blade_json.h"
#include "bw/core/base/units.h"
#include "bw/core/design/job_numbers.h"
#include "bw/core/design/program_formats.h"
#include "bw/core/text/number_text.h"
#include "design/face_choice.h"
#include "design/job_json.h"
#include "text/json_reader.h"

namespace bw {

using nlohmann::json;

namespace {

constexpr double kMaxSewing = 100;  ///< mm
constexpr const char* kFileUnit = "file";
constexpr double kMaxBlock = 1e6;  ///< mm

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
  ObjectReader inner(*value, reader.path() + ".block");
  BlockPlacement placement;
  Eigen::Vector3d degrees = Eigen::Vector3d::Zero();
  inner.need("origin",
             inner.path() + " needs the key origin: its corner [x, y, z] in the file's frame, in mm");
  inner.need("size", inner.path() + " needs the key size: [dx, dy, dz] in mm");
  inner.vector3("origin", placement.origin, -kFarthest, kFarthest);
  inner.vector3("size", placement.size, 1.0, kMaxBlock);
  inner.vector3("rotation_deg", degrees, -360, 360);
  placement.rotation = degrees * kDegree;
  if (Result<void> ok = inner.finish(); !ok) {
    reader.adopt(inner);
    return;
  }
  block = placement;
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
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  reader.vector3("direction", v, -1e12, 1e12);
  const double length = v.norm();
  if (length < 1e-9) {
    reader.complain("direction", reader.path() + ".direction has length zero; give the way the blade travels",
                    length, 1e-9);
    return;
  }
  direction = v / length;
}

void readStations(ObjectReader& reader, Job& job) {
  const json* value = reader.member("stations");
  if (!value) return;
  if (value->is_object()) {
    ObjectReader inner(*value, reader.path() + ".stations");
    double spacing = 0;
    inner.number("spacing", spacing, 0.01, 1e5);
    inner.need("spacing", inner.path() + " needs the key spacing in mm");
    if (Result<void> ok = inner.finish(); !ok) {
      reader.adopt(inner);
      return;
    }
    job.spacing = spacing;
    return;
  }
  reader.integer("stations", job.stations, 2, SectionRequest::kMost);
  job.spacing.reset();
}

void readFit(ObjectReader& reader, Job& job) {
  const json* value = reader.member("fit");
  if (!value) return;
  ObjectReader inner(*value, reader.path() + ".fit");
  int length = int(job.fitLength);
  inner.word("length", {"free", "exact"}, length);
  job.fitLength = FitOptions::Length(length);
  inner.boolean("endpoints", job.fitEndpoints);
  inner.boolean("tangents", job.fitTangents);
  for (const JobNumber& number : jobNumbers())
    if (number.ofFit) inner.number(number.key, job.*number.member, number.min, number.max);
  if (Result<void> ok = inner.finish(); !ok) reader.adopt(inner);
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

}  // namespace

const char* lengthUnitName(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::mm:
      return "mm";
    case LengthUnit::cm:
      return "cm";
    case LengthUnit::m:
      return "m";
    case LengthUnit::inch:
      return "in";
  }
  return "";
}

double millimetres(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::mm:
      return 1;
    case LengthUnit::cm:
      return 10;
    case LengthUnit::m:
      return 1000;
    case LengthUnit::inch:
      return 25.4;
  }
  return 1;
}

double Job::sewingTolerance() const {
  return sewing.value_or(std::min(tolerance / 10, ReadOptions::kMostSewing));
}

Box BlockPlacement::box() const {
  const Eigen::Matrix3d r = rotationFromAngles(rotation);
  return Box{Frame{origin, r.col(0), r.col(1), r.col(2)}, size};
}

Result<Job> jobFromJson(const json& object, const std::string& path, int& threads) {
  Job job;
  // A blade that is written whole (as designs store it) needs no preset.
  const bool wholeBlade = object.is_object() && object.contains("blade") && object["blade"].is_object() &&
                          object["blade"].contains("name");
  if (Result<Blade> preset = bladePreset(job.blade.name))
    job.blade = std::move(*preset);
  else if (!wholeBlade)
    return tl::unexpected<Error>(preset.error());
  ObjectReader reader(object, path);
  readUnit(reader, job.unit);
  readSewing(reader, job.sewing);
  readFaceChoice(reader, job.face);
  readBlock(reader, job.block);
  readDirection(reader, job.direction);
  if (const json* planes = reader.member("planes")) {
    ObjectReader inner(*planes, reader.path() + ".planes");
    int type = 0;
    inner.word("type", {"parallel"}, type);
    if (Result<void> ok = inner.finish(); !ok) reader.adopt(inner);
  }
  readStations(reader, job);
  int route = int(job.sections);
  reader.word("sections", {kSectionRoutes.begin(), kSectionRoutes.end()}, route);
  job.sections = SectionRoute(route);
  readBlade(reader, job.blade);
  readFit(reader, job);
  for (const JobNumber& number : jobNumbers())
    if (!number.ofFit) reader.number(number.key, job.*number.member, number.min, number.max);
  readPrograms(reader, job.programs);
  reader.text("cell", job.cell);
  reader.integer("threads", threads, 0, 1024);
  if (Result<void> ok = reader.finish(); !ok) return tl::unexpected<Error>(ok.error());
  return job;
}

json jobToJsonObject(const Job& job) {
  json object;
  object["unit"] = job.unit ? lengthUnitName(*job.unit) : kFileUnit;
  if (job.sewing)
    object["sewing"] = *job.sewing;
  else
    object["sewing"] = "auto";
  writeFaceChoice(job.face, object);
  const auto vector = [](const Eigen::Vector3d& v) { return json::array({v.x(), v.y(), v.z()}); };
  if (job.block) {
    object["block"] = {{"origin", vector(job.block->origin)},
                       {"size", vector(job.block->size)},
                       {"rotation_deg", vector(job.block->rotation / kDegree)}};
  } else {
    object["block"] = "auto";
  }
  if (job.direction)
    object["direction"] = vector(*job.direction);
  else
    object["direction"] = "auto";
  object["planes"] = {{"type", "parallel"}};
  if (job.spacing)
    object["stations"] = {{"spacing", *job.spacing}};
  else
    object["stations"] = job.stations;
  object["sections"] = kSectionRoutes[std::size_t(job.sections)];
  object["blade"] = bladeToJson(job.blade);
  object["fit"] = {{"length", job.fitLength == FitOptions::Length::exact ? "exact" : "free"},
                   {"endpoints", job.fitEndpoints},
                   {"tangents", job.fitTangents}};
  for (const JobNumber& number : jobNumbers())
    (number.ofFit ? object["fit"] : object)[number.key] = job.*number.member;
  object["programs"] = job.programs;
  object["cell"] = job.cell;
  return object;
}

Result<Job> parseJob(std::string_view text, int* threads) {
  const Result<json> object = parseJsonText(text, "job");
  if (!object) return tl::unexpected<Error>(object.error());
  int unused = 0;
  return jobFromJson(*object, "job", threads ? *threads : unused);
}

std::string jobToJson(const Job& job) {
  return jobToJsonObject(job).dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace bw
