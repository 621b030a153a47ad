// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/motion/cell.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bw/core/base/units.h"
#include "bw/core/blade/blade.h"
#include "bw/core/files/file_set.h"
#include "bw/core/text/json_reader.h"
#include "bw/core/text/number_text.h"

namespace bw {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr int kVersion = 1;
constexpr double kMaxCoordinate = 1e5;         ///< mm; a cell of a hundred metres is a wrong unit
constexpr double kMaxJoint = 3600;             ///< degrees; wrists turn several times, never ten
constexpr double kQuaternionTolerance = 1e-4;  ///< of the norm, as written by people with a few decimals
constexpr std::size_t kMaxTasks = 6;           ///< what a MultiMove controller moves together

/// Names go into robot programs as identifiers: a letter, then letters, digits and underscores, at most 32.
void identifier(ObjectReader& reader, const std::string& key, std::string& out) {
  reader.text(key, out);
  const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto isRest = [&](char c) { return isLetter(c) || (c >= '0' && c <= '9') || c == '_'; };
  if (out.empty() || out.size() > 32 || !isLetter(out[0]) || !std::all_of(out.begin(), out.end(), isRest))
    reader.complain(
        key, reader.path() + "." + key + " is \"" + out +
                 "\" but must be an identifier: a letter, then letters, digits or _, at most 32 characters");
}

void require(ObjectReader& reader, const std::string& key, const char* example) {
  reader.need(key, reader.path() + " needs the key " + key + ", for instance " + example);
}

/// A list of numbers; fails with the form that is wanted.
bool numbers(ObjectReader& reader, const std::string& key, std::size_t least, std::size_t most, double limit,
             const std::string& form, std::vector<double>& out) {
  const json* value = reader.member(key);
  if (!value) return false;
  const bool shapeFits =
      value->is_array() && value->size() >= least && value->size() <= most &&
      std::all_of(value->begin(), value->end(), [](const json& v) { return v.is_number(); });
  if (!shapeFits) {
    reader.complain(key, reader.path() + "." + key + " must be " + form);
    return false;
  }
  std::vector<double> read;
  for (const json& entry : *value) {
    const double x = entry.get<double>();
    if (!std::isfinite(x) || std::abs(x) > limit) {
      reader.complain(key,
                      reader.path() + "." + key + " holds " + shortText(x, 6) +
                          " but each number must lie within ±" + shortText(limit, 6),
                      x, limit);
      return false;
    }
    read.push_back(x);
  }
  out = std::move(read);
  return true;
}

void readPose(ObjectReader& reader, const std::string& key, Pose& pose) {
  static const char* const kForm = "{\"position\": [0, 0, 0], \"quaternion\": [1, 0, 0, 0]}";
  require(reader, key, kForm);
  const json* value = reader.member(key);
  if (!value) return;
  ObjectReader inner(*value, reader.path() + "." + key);
  require(inner, "position", "[0, 0, 0]");
  require(inner, "quaternion", "[1, 0, 0, 0]");
  inner.vector3("position", pose.position, -kMaxCoordinate, kMaxCoordinate);
  std::vector<double> q;
  if (numbers(inner, "quaternion", 4, 4, 2.0, "four numbers [w, x, y, z]", q)) {
    const Eigen::Quaterniond read(q[0], q[1], q[2], q[3]);
    const double norm = read.norm();
    if (std::abs(norm - 1) > kQuaternionTolerance)
      inner.complain("quaternion",
                     inner.path() + ".quaternion has norm " + shortText(norm, 6) +
                         " but must be a unit quaternion [w, x, y, z]; give more decimals",
                     norm, 1.0);
    else
      pose.rotation = read.normalized();
  }
  reader.adopt(inner.finish());
}

void readTool(ObjectReader& reader, CellTask& task) {
  require(reader, "tool", "{\"name\": \"tBlade\", \"pose\": …, \"mass\": 2.5}");
  const json* value = reader.member("tool");
  if (!value) return;
  ObjectReader inner(*value, reader.path() + ".tool");
  require(inner, "name", "\"tBlade\"");
  identifier(inner, "name", task.toolName);
  readPose(inner, "pose", task.tool);
  require(inner, "mass", "2.5 (kg)");
  inner.number("mass", task.toolMass, 1e-3, 1000);
  inner.vector3("center", task.toolCenter, -1e4, 1e4);
  reader.adopt(inner.finish());
}

CellTask readTask(const json& value, const std::string& path, ObjectReader& outer) {
  CellTask task;
  ObjectReader reader(value, path);
  require(reader, "name", "\"T_ROB1\"");
  identifier(reader, "name", task.name);
  require(reader, "robot", "\"irb1600-10-1.45\"");
  reader.text("robot", task.robot);
  readPose(reader, "base", task.base);
  readTool(reader, task);
  require(reader, "home_deg", "[0, -20, 30, 0, 50, 0]");
  std::vector<double> degrees;
  if (numbers(reader, "home_deg", 6, 7, kMaxJoint, "six (or seven) joint angles in degrees", degrees))
    for (const double d : degrees) task.home.push_back(fromDegrees(d));
  outer.adopt(reader.finish());
  return task;
}

bool sameIgnoringCase(const std::string& a, const std::string& b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

void readTasks(ObjectReader& reader, std::vector<CellTask>& tasks) {
  require(reader, "tasks", "a list with one object per robot, left first");
  const json* value = reader.member("tasks");
  if (!value) return;
  if (!value->is_array() || value->empty() || value->size() > kMaxTasks) {
    reader.complain("tasks", reader.path() + ".tasks must be a list of 1 to " + std::to_string(kMaxTasks) +
                                 " objects, one a robot, left first");
    return;
  }
  for (std::size_t i = 0; i < value->size(); ++i) {
    const std::string path = reader.path() + ".tasks[" + std::to_string(i) + "]";
    CellTask task = readTask((*value)[i], path, reader);
    for (const CellTask& other : tasks)
      if (sameIgnoringCase(other.name, task.name))
        reader.complain("tasks",
                        path + ".name is \"" + task.name + "\", which another task has; names must differ");
    tasks.push_back(std::move(task));
  }
}

Result<fs::path> cellFolder() {
  const Result<fs::path> root = resourceFolder();
  if (!root) return tl::unexpected<Error>(root.error());
  return *root / "cells";
}

}  // namespace

Result<Cell> parseCell(std::string_view text, const std::string& name) {
  const std::string what = name.empty() ? "cell" : "cell " + name;
  const Result<json> object = parseJsonText(text, what);
  if (!object) return tl::unexpected<Error>(object.error());
  Cell cell;
  cell.name = name;
  cell.title = name;
  ObjectReader reader(*object, what);
  int version = kVersion;
  if (Result<void> ok = reader.version("version", version, kVersion, kVersion); !ok)
    return tl::unexpected<Error>(ok.error());
  reader.text("title", cell.title);
  readTasks(reader, cell.tasks);
  require(reader, "work_object", "{\"name\": \"wBlock\", \"pose\": …}");
  if (const json* value = reader.member("work_object")) {
    ObjectReader inner(*value, reader.path() + ".work_object");
    identifier(inner, "name", cell.workObjectName);
    readPose(inner, "pose", cell.workObject);
    reader.adopt(inner.finish());
  }
  if (const json* value = reader.member("heat")) {
    ObjectReader inner(*value, reader.path() + ".heat");
    require(inner, "signal", "\"doBladeHeat\"");
    identifier(inner, "signal", cell.heatSignal);
    inner.number("dwell", cell.heatDwell, 0, 600);
    reader.adopt(inner.finish());
  }
  reader.number("travel_speed", cell.travelSpeed, 1, 2000);
  reader.number("approach", cell.approach, 0, 2000);
  if (Result<void> ok = reader.finish(); !ok) return tl::unexpected<Error>(ok.error());
  return cell;
}

Result<std::vector<std::string>> cellNames() {
  const Result<fs::path> folder = cellFolder();
  if (!folder) return tl::unexpected<Error>(folder.error());
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(*folder, error), end; !error && it != end; it.increment(error))
    if (it->path().extension() == ".json") names.push_back(it->path().stem().string());
  if (error || names.empty())
    return fail(ErrorCode::cannotRead, "no robot cells in " + folder->string() + "; reinstall the resources",
                folder->string());
  std::sort(names.begin(), names.end());
  return names;
}

Result<Cell> loadCell(const std::string& nameOrPath) {
  constexpr std::size_t kLimit = 1 << 20;
  const auto load = [&](const fs::path& file) -> Result<Cell> {
    const Result<std::string> bytes = readFile(file, kLimit);
    if (!bytes) return tl::unexpected<Error>(bytes.error());
    Result<Cell> cell = parseCell(*bytes, file.stem().string());
    if (!cell) return cell;
    for (CellTask& task : cell->tasks) {
      const Result<std::optional<RobotArm>> arm = findRobotArm(task.robot);
      if (!arm) return tl::unexpected<Error>(arm.error());
      task.arm = *arm;
    }
    return cell;
  };
  if (nameOrPath.find('/') != std::string::npos || fs::path(nameOrPath).extension() == ".json")
    return load(nameOrPath);
  const Result<std::vector<std::string>> names = cellNames();
  if (!names) return tl::unexpected<Error>(names.error());
  if (std::find(names->begin(), names->end(), nameOrPath) != names->end()) {
    const Result<fs::path> folder = cellFolder();
    if (!folder) return tl::unexpected<Error>(folder.error());
    return load(*folder / (nameOrPath + ".json"));
  }
  std::string message = "there is no robot cell \"" + nameOrPath + "\"";
  const std::string nearest = nearestWord(nameOrPath, names->data(), int(names->size()));
  if (!nearest.empty()) {
    message += "; did you mean \"" + nearest + "\"?";
  } else {
    message += "; the cells are";
    for (std::size_t i = 0; i < names->size(); ++i) message += (i ? ", " : " ") + (*names)[i];
    message += ", or give the path of a .json file";
  }
  return fail(ErrorCode::badInput, message, "cell");
}

}  // namespace bw
