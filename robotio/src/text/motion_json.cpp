// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bw/core/text/byte_order_mark.h"
#include "bw/core/text/number_text.h"
#include "bw/robotio/text/program_text.h"
#include "motion/motion_check.h"

namespace bw::robotio {

namespace {

using nlohmann::json;

constexpr const char* kSchema = "bladewright-motion";
constexpr int kVersion = 1;

std::string numbers(std::initializer_list<double> values) {
  std::string text = "[";
  for (const double v : values) text += (text.size() > 1 ? ", " : "") + roundTripText(v);
  return text + "]";
}

std::string vector3(const Eigen::Vector3d& v) { return numbers({v.x(), v.y(), v.z()}); }

std::string poseText(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  return "{\"position\": " + vector3(pose.position) +
         ", \"quaternion\": " + numbers({q.w(), q.x(), q.y(), q.z()}) + "}";
}

std::string quoted(const std::string& text) {
  return json(text).dump(-1, ' ', true, json::error_handler_t::replace);
}

// Of what is read the first fault throws, which readJson turns into its error.

[[noreturn]] void wrong(std::string message, std::string where, std::optional<double> value = std::nullopt,
                        std::optional<double> limit = std::nullopt) {
  throw Error{ErrorCode::badInput, std::move(message), std::move(where), value, limit};
}

void keys(const json& object, const std::string& path, const std::vector<std::string>& known) {
  if (!object.is_object()) wrong(path + " must be an object, not " + object.type_name(), path);
  for (const auto& item : object.items()) {
    if (std::find(known.begin(), known.end(), item.key()) != known.end()) continue;
    const std::string nearest = nearestWord(item.key(), known.data(), int(known.size()));
    wrong(path + " has no key \"" + item.key() + "\"" +
              (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"),
          path + "." + item.key());
  }
}

const json& at(const json& object, std::string_view path, const char* key) {
  const auto it = object.find(key);
  if (it == object.end()) wrong(std::string(path) + " needs the key " + key, std::string(path) + "." + key);
  return *it;
}

double number(const json& value, const std::string& path) {
  if (!value.is_number()) wrong(path + " must be a number, not " + value.type_name(), path);
  return value.get<double>();
}

template <std::size_t n>
std::array<double, n> list(const json& value, const std::string& path) {
  if (!value.is_array() || value.size() != n)
    wrong(path + " must be a list of " + std::to_string(n) + " numbers", path);
  std::array<double, n> result{};
  for (std::size_t i = 0; i < n; ++i) result[i] = number(value[i], path);
  return result;
}

Eigen::Vector3d vector(const json& value, const std::string& path) {
  const std::array<double, 3> v = list<3>(value, path);
  return {v[0], v[1], v[2]};
}

MotionInstant instant(const json& value, const std::string& path) {
  keys(value, path, {"time", "station", "poses"});
  MotionInstant result;
  result.time = number(at(value, path, "time"), path + ".time");
  const double station = number(at(value, path, "station"), path + ".station");
  if (station != std::floor(station) || station < -1 || station > 1e9)
    wrong(path + ".station is " + shortText(station, 9) + " but must be a whole number, -1 in the leads",
          path + ".station", station);
  result.station = int(station);
  const json& poses = at(value, path, "poses");
  if (!poses.is_array()) wrong(path + ".poses must be a list with one pose an end", path + ".poses");
  for (const json& pose : poses) {
    keys(pose, path + ".poses", {"position", "quaternion"});
    const std::array<double, 4> q =
        list<4>(at(pose, path + ".poses", "quaternion"), path + ".poses.quaternion");
    result.poses.push_back(Pose{vector(at(pose, path + ".poses", "position"), path + ".poses.position"),
                                Eigen::Quaterniond(q[0], q[1], q[2], q[3])});
  }
  return result;
}

Motion readMotion(const json& root) {
  keys(root, "motion",
       {"schema", "version", "not_safe_to_run", "units", "frame", "cell", "blade_length", "cutting_speed",
        "corner_tolerance", "approach", "retreat", "block", "ends", "instants"});
  if (const json& schema = at(root, "motion", "schema");
      !schema.is_string() || schema.get<std::string>() != kSchema)
    wrong("motion.schema must be \"" + std::string(kSchema) + "\"; this is another kind of file",
          "motion.schema");
  const double version = number(at(root, "motion", "version"), "motion.version");
  if (version != kVersion)
    wrong("motion.version is " + shortText(version, 9) + " but this program reads version " +
              std::to_string(kVersion),
          "motion.version", version, kVersion);
  Motion result;
  result.bladeLength = number(at(root, "motion", "blade_length"), "motion.blade_length");
  result.cuttingSpeed = number(at(root, "motion", "cutting_speed"), "motion.cutting_speed");
  if (root.contains("corner_tolerance")) {
    result.cornersWithin = number(root["corner_tolerance"], "motion.corner_tolerance");
    if (!(result.cornersWithin > 0))
      wrong("motion.corner_tolerance must be greater than 0 mm", "motion.corner_tolerance",
            result.cornersWithin, 0);
  }
  if (root.contains("approach")) result.approach = vector(root["approach"], "motion.approach");
  if (root.contains("retreat")) result.retreat = vector(root["retreat"], "motion.retreat");
  const json& block = at(root, "motion", "block");
  keys(block, "motion.block", {"origin", "size", "x", "y", "z"});
  result.block.frame.origin = vector(at(block, "motion.block", "origin"), "motion.block.origin");
  result.block.size = vector(at(block, "motion.block", "size"), "motion.block.size");
  result.block.frame.x = vector(at(block, "motion.block", "x"), "motion.block.x");
  result.block.frame.y = vector(at(block, "motion.block", "y"), "motion.block.y");
  result.block.frame.normal = vector(at(block, "motion.block", "z"), "motion.block.z");
  const json& instants = at(root, "motion", "instants");
  if (!instants.is_array()) wrong("motion.instants must be a list", "motion.instants");
  for (std::size_t i = 0; i < instants.size(); ++i)
    result.instants.push_back(instant(instants[i], "motion.instants[" + std::to_string(i) + "]"));
  return result;
}

}  // namespace

Result<Program> writeJson(const Motion& motion, const Cell& cell, const ProgramNotes& notes) {
  if (Result<void> ok = checkMotion(motion); !ok) return tl::unexpected<Error>(ok.error());
  std::string tasks, ends, unsafe;
  for (const std::string& error : notes.errors) unsafe += (unsafe.empty() ? "" : ", ") + quoted(error);
  if (!unsafe.empty()) unsafe = ",\n  \"not_safe_to_run\": [" + unsafe + "]";
  for (const CellTask& task : cell.tasks) tasks += (tasks.empty() ? "" : ", ") + quoted(task.name);
  for (std::size_t i = 0; i < motion.instants.front().poses.size(); ++i)
    ends += (ends.empty() ? "" : ", ") + quoted(endName(i));
  const auto way = [](const char* key, const std::optional<Eigen::Vector3d>& direction) {
    return direction ? ",\n  \"" + std::string(key) + "\": " + vector3(*direction) : std::string();
  };
  const Frame& f = motion.block.frame;
  std::string text =
      "{\n  \"schema\": \"" + std::string(kSchema) + "\",\n  \"version\": " + std::to_string(kVersion) +
      unsafe +
      ",\n  \"units\": \"mm, s; quaternions w first\",\n  \"frame\": \"block\",\n  \"cell\": {\"name\": " +
      quoted(cell.name) + ", \"tasks\": [" + tasks + "], \"work_object\": " + poseText(cell.workObject) +
      "},\n  \"blade_length\": " + roundTripText(motion.bladeLength) +
      ",\n  \"cutting_speed\": " + roundTripText(motion.cuttingSpeed) +
      (motion.cornersWithin == kMostCornerCut
           ? std::string()
           : ",\n  \"corner_tolerance\": " + roundTripText(motion.cornersWithin)) +
      way("approach", motion.approach) + way("retreat", motion.retreat) +
      ",\n  \"block\": {\"origin\": " + vector3(f.origin) + ", \"size\": " + vector3(motion.block.size) +
      ", \"x\": " + vector3(f.x) + ", \"y\": " + vector3(f.y) + ", \"z\": " + vector3(f.normal) +
      "},\n  \"ends\": [" + ends + "],\n  \"instants\": [\n";
  for (std::size_t i = 0; i < motion.instants.size(); ++i) {
    const MotionInstant& instant = motion.instants[i];
    text += "    {\"time\": " + roundTripText(instant.time) +
            ", \"station\": " + std::to_string(instant.station) + ", \"poses\": [";
    for (std::size_t end = 0; end < instant.poses.size(); ++end)
      text += (end ? ", " : "") + poseText(instant.poses[end]);
    text += i + 1 < motion.instants.size() ? "]},\n" : "]}\n";
  }
  text += "  ]\n}\n";
  return Program{ProgramFile{"motion.json", std::move(text)}};
}

Result<Motion> readJson(std::string_view text) {
  try {
    const json root = json::parse(text.begin(), text.end());
    Motion motion = readMotion(root);
    if (Result<void> ok = checkMotion(motion); !ok) return tl::unexpected<Error>(ok.error());
    return motion;
  } catch (const Error& error) {
    return tl::unexpected<Error>(error);
  } catch (const json::parse_error& error) {
    if (isUtf16(text))
      return fail(ErrorCode::badInput, "the motion is UTF-16 text, which is not read here; save it as UTF-8",
                  "line 1");
    const std::size_t byte = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(byte), '\n');
    return fail(ErrorCode::badInput, "the motion is not valid JSON: line " + std::to_string(line),
                "line " + std::to_string(line));
  } catch (const std::exception& error) {
    return fail(ErrorCode::badInput, std::string("the motion cannot be read: ") + error.what(), "motion");
  }
}

}  // namespace bw::robotio
