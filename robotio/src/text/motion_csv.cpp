// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Motion as CSV: the first line names the columns with their units, then one row an instant. The columns of
// the motion as a whole (blade, speed, block) are filled in the first row only; blank means "as in the row
// above".

#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/text/byte_order_mark.h"
#include "bw/core/text/number_text.h"
#include "bw/core/text/printable.h"
#include "bw/robotio/text/program_text.h"
#include "motion/motion_check.h"

namespace bw::robotio {

namespace {

constexpr std::array<const char*, 7> kPoseColumns = {"x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz"};
constexpr std::array<const char*, 17> kMotionColumns = {
    "blade_length_mm", "cutting_speed_mm_s", "block_origin_x_mm", "block_origin_y_mm", "block_origin_z_mm",
    "block_size_x_mm", "block_size_y_mm",    "block_size_z_mm",   "block_x_x",         "block_x_y",
    "block_x_z",       "block_y_x",          "block_y_y",         "block_y_z",         "block_z_x",
    "block_z_y",       "block_z_z"};
constexpr std::size_t kFirstPose = 2;  ///< columns before the poses: time_s, station
constexpr std::size_t kMaxColumns = kFirstPose + 6 * kPoseColumns.size() + kMotionColumns.size();

std::vector<std::string> columnNames(std::size_t ends) {
  std::vector<std::string> names = {"time_s", "station"};
  for (std::size_t end = 0; end < ends; ++end)
    for (const char* column : kPoseColumns) names.push_back(endName(end) + "_" + column);
  names.insert(names.end(), kMotionColumns.begin(), kMotionColumns.end());
  return names;
}

/// Where a motion keeps the values of kMotionColumns.
auto motionValues(auto& motion) {
  auto& [origin, x, y, z] = motion.block.frame;
  auto& size = motion.block.size;
  return std::array{&motion.bladeLength,
                    &motion.cuttingSpeed,
                    &origin[0],
                    &origin[1],
                    &origin[2],
                    &size[0],
                    &size[1],
                    &size[2],
                    &x[0],
                    &x[1],
                    &x[2],
                    &y[0],
                    &y[1],
                    &y[2],
                    &z[0],
                    &z[1],
                    &z[2]};
}

std::string joined(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i ? "," : "") + cells[i];
  return line + "\n";
}

std::string_view trimmed(std::string_view cell) {
  const std::size_t begin = std::min(cell.find_first_not_of(" \t"), cell.size());
  return cell.substr(begin, cell.find_last_not_of(" \t") + 1 - begin);
}

std::string shown(std::string_view cell) {
  std::string text;
  for (const char c : cell.substr(0, 40)) text += c >= ' ' && c < 127 ? c : '?';
  return text;
}

class CsvReader {
 public:
  explicit CsvReader(std::string_view text) : rest_(text) {}

  Result<Motion> run() {
    std::vector<std::string_view> cells;
    // Errors of a design stand before the header.
    while (rest_.starts_with('#')) {
      ++line_;
      rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size() - 1) + 1);
    }
    if (!nextLine(cells))
      return fail(ErrorCode::badInput, "the CSV is empty; it must begin with a header", "line 1");
    if (Result<void> ok = readHeader(cells); !ok) return tl::unexpected<Error>(ok.error());
    Motion motion;
    while (nextLine(cells)) {
      if (motion.instants.size() == kMaxInstants)
        return wrong("there are more than " + std::to_string(kMaxInstants) + " rows");
      if (Result<void> ok = readRow(cells, motion); !ok) return tl::unexpected<Error>(ok.error());
    }
    if (Result<void> ok = checkMotion(motion); !ok) return tl::unexpected<Error>(ok.error());
    return motion;
  }

 private:
  /// Takes the cells of the next line, which ends in LF or CR LF. False at the end; lines that are blank to
  /// the end of the text count as the end.
  bool nextLine(std::vector<std::string_view>& cells) {
    if (rest_.find_first_not_of(" \t\r\n") == std::string_view::npos) return false;
    ++line_;
    std::string_view text = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(text.size() + 1, rest_.size()));
    if (text.ends_with('\r')) text.remove_suffix(1);
    cells.clear();
    while (true) {
      const std::size_t comma = text.find(',');
      cells.push_back(trimmed(text.substr(0, comma)));
      if (comma == std::string_view::npos || cells.size() > kMaxColumns) return true;
      text.remove_prefix(comma + 1);
    }
  }

  tl::unexpected<Error> wrong(const std::string& message) const {
    const std::string where = "line " + std::to_string(line_);
    return fail(ErrorCode::badInput, "CSV " + where + ": " + message, where);
  }

  Result<void> readHeader(const std::vector<std::string_view>& cells) {
    const std::size_t fixed = kFirstPose + kMotionColumns.size();
    const std::size_t poseCells = cells.size() > fixed ? cells.size() - fixed : 0;
    ends_ = poseCells / kPoseColumns.size();
    if (cells.size() == 1 && cells[0].find(';') != std::string_view::npos)
      return wrong("the cells are separated by semicolons; save it with commas, and points in numbers");
    if (cells.size() > kMaxColumns || ends_ < 1 || ends_ * kPoseColumns.size() != poseCells)
      return wrong("the header has " + std::to_string(std::min(cells.size(), kMaxColumns + 1)) +
                   " columns; a motion of one end has " + std::to_string(fixed + kPoseColumns.size()) +
                   ", of two ends " + std::to_string(fixed + 2 * kPoseColumns.size()));
    names_ = columnNames(ends_);
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (cells[i] != names_[i])
        return wrong("column " + std::to_string(i + 1) + " must be \"" + names_[i] + "\", not \"" +
                     shown(cells[i]) + "\"");
    return {};
  }

  Result<double> number(std::string_view cell, std::size_t column) const {
    if (const std::optional<double> value = parseNumber(cell)) return *value;
    return wrong("\"" + shown(cell) + "\" in column " + names_[column] + " is not a finite number");
  }

  Result<void> readRow(const std::vector<std::string_view>& cells, Motion& motion) {
    if (cells.size() != names_.size())
      return wrong("the row has " + std::to_string(std::min(cells.size(), kMaxColumns + 1)) +
                   " cells but the header has " + std::to_string(names_.size()));
    MotionInstant instant;
    const Result<double> time = number(cells[0], 0), station = number(cells[1], 1);
    if (!time) return tl::unexpected<Error>(time.error());
    if (!station) return tl::unexpected<Error>(station.error());
    if (*station != std::floor(*station) || *station < -1 || *station > 1e9)
      return wrong("the station is " + shown(cells[1]) + " but must be a whole number, -1 in the leads");
    instant.time = *time;
    instant.station = int(*station);
    for (std::size_t end = 0; end < ends_; ++end) {
      std::array<double, kPoseColumns.size()> v{};
      for (std::size_t i = 0; i < v.size(); ++i) {
        const std::size_t column = kFirstPose + end * v.size() + i;
        const Result<double> value = number(cells[column], column);
        if (!value) return tl::unexpected<Error>(value.error());
        v[i] = *value;
      }
      instant.poses.push_back(Pose{{v[0], v[1], v[2]}, Eigen::Quaterniond(v[3], v[4], v[5], v[6])});
    }
    if (Result<void> ok = readMotionColumns(cells, motion); !ok) return ok;
    motion.instants.push_back(std::move(instant));
    return {};
  }

  Result<void> readMotionColumns(const std::vector<std::string_view>& cells, Motion& motion) {
    const bool first = motion.instants.empty();
    std::size_t column = kFirstPose + ends_ * kPoseColumns.size();
    for (double* known : motionValues(motion)) {
      const std::size_t at = column++;
      if (cells[at].empty() && !first) continue;
      const Result<double> value = number(cells[at], at);
      if (!value) return tl::unexpected<Error>(value.error());
      if (!first && *value != *known) return wrong(names_[at] + " must be the same in all rows");
      *known = *value;
    }
    return {};
  }

  std::string_view rest_;
  int line_ = 0;
  std::size_t ends_ = 0;
  std::vector<std::string> names_;
};

}  // namespace

Result<Program> writeCsv(const Motion& motion, const ProgramNotes& notes) {
  if (Result<void> ok = checkMotion(motion); !ok) return tl::unexpected<Error>(ok.error());
  std::string text;
  // Few and short: by the header after them it is seen to be one of ours.
  constexpr std::size_t kShown = 5, kLength = 200;
  for (std::size_t i = 0; i < std::min(kShown, notes.errors.size()); ++i)
    text += "# NOT SAFE TO RUN: " + printable(notes.errors[i].substr(0, kLength)) + "\n";
  if (notes.errors.size() > kShown)
    text += "# NOT SAFE TO RUN: " + std::to_string(notes.errors.size() - kShown) + " more errors\n";
  text += joined(columnNames(motion.instants.front().poses.size()));
  for (std::size_t i = 0; i < motion.instants.size(); ++i) {
    const MotionInstant& instant = motion.instants[i];
    std::vector<std::string> cells = {roundTripText(instant.time), std::to_string(instant.station)};
    for (const Pose& pose : instant.poses) {
      const Eigen::Quaterniond& q = pose.rotation;
      for (const double v :
           {pose.position.x(), pose.position.y(), pose.position.z(), q.w(), q.x(), q.y(), q.z()})
        cells.push_back(roundTripText(v));
    }
    for (const double* v : motionValues(motion)) cells.push_back(i == 0 ? roundTripText(*v) : std::string());
    text += joined(cells);
  }
  return Program{ProgramFile{"motion.csv", std::move(text)}};
}

Result<Motion> readCsv(std::string_view text) {
  if (isUtf16(text))
    return fail(ErrorCode::badInput, "the CSV is UTF-16 text, which is not read here; save it as CSV UTF-8",
                "line 1");
  return CsvReader(withoutByteOrderMark(text)).run();  // as spreadsheets begin UTF-8
}

}  // namespace bw::robotio
