// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/cut_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "bw/core/text/byte_order_mark.h"
#include "bw/core/text/number_text.h"
#include "bw/core/text/printable.h"
#include "design/design_keys.h"

namespace bw {

namespace {

using nlohmann::json;

constexpr std::array<const char*, 15> kColumns = {
    "block",    "id",   "source", "face",     "near",     "direction",    "planes", "face_up",
    "turn_deg", "keep", "order",  "stations", "sections", "blade_length", "offset"};

/// A cut of a design with all its keys, also those that are as usual, and the expressions of its numbers.
json rowOf(const Design& design, std::size_t index) {
  const Cut& cut = design.cuts[index];
  json row = {{"id", cut.id}, {"source", cut.source}, {"block", cut.block}};
  detail::writeCutKeys(cut, row);
  row["face_up"] = kBlockFaces[0];
  row["turn_deg"] = 0;
  row["keep"] = kKeptSides[0];
  row["order"] = "auto";
  row["blade_length"] = "blade";
  row["offset"] = 0;
  detail::writeBlockCutKeys(
      cut, row, [](const std::string&) -> const BoundNumber* { return nullptr; });  // its number stands there
  const std::string place = "/cuts/" + std::to_string(index);
  for (auto bound = design.bindings.lower_bound(place + "/");
       bound != design.bindings.end() && bound->first.starts_with(place + "/"); ++bound) {
    const json::json_pointer at(bound->first.substr(place.size()));
    if (row.contains(at) && row[at].is_number() && row[at].get<double>() == bound->second.value)
      row[at] = "=" + bound->second.text;
  }
  return row;
}

std::string cellOf(const json& value) {
  if (value.is_null()) return {};
  std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  if (text.find_first_of(",;\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

using Line = std::vector<std::string>;

/// Cells, with quotes as RFC 4180 has them. Empty where a quote is not closed.
std::optional<std::vector<Line>> linesOf(std::string_view text, char separator) {
  std::vector<Line> lines(1, Line(1));
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c != '"') {
        lines.back().back() += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        lines.back().back() += text[++i];
      } else {
        quoted = false;
      }
    } else if (c == '"' && lines.back().back().empty()) {
      quoted = true;
    } else if (c == separator) {
      lines.back().emplace_back();
    } else if (c == '\n') {
      lines.emplace_back(1);
    } else if (c != '\r') {
      lines.back().back() += c;
    }
  }
  if (quoted) return {};
  std::erase_if(lines, [](const Line& line) {
    return std::ranges::all_of(
        line, [](const std::string& cell) { return cell.find_first_not_of(" \t") == std::string::npos; });
  });
  return lines;
}

std::string trimmed(const std::string& text) {
  const std::size_t from = text.find_first_not_of(" \t");
  return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of(" \t") + 1 - from);
}

std::optional<double> numberOf(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

json numberJson(double value) {
  constexpr double kExact = 9e15;
  return value == std::floor(value) && std::abs(value) < kExact ? json(std::int64_t(value)) : json(value);
}

/// What a cell stands for: JSON where it looks like it, a number, or a word.
json valueOf(const std::string& column, std::string cell, bool commas) {
  if (cell.starts_with('[') || cell.starts_with('{'))
    if (json value = json::parse(cell, nullptr, false); !value.is_discarded()) return value;
  if (column == "planes") return {{"type", cell}};
  // Names stay what they are.
  if (column == "id" || column == "block" || column == "source") return cell;
  std::string number = cell;
  if (commas) std::ranges::replace(number, ',', '.');
  if (const std::optional<double> value = numberOf(number)) return numberJson(*value);
  if (column != "direction") return cell;
  // "0 1 0"
  json parts = json::array();
  for (std::size_t at = 0; at < number.size();) {
    const std::size_t end = std::min(number.find(' ', at), number.size());
    if (end > at) {
      const std::optional<double> value = numberOf(number.substr(at, end - at));
      if (!value) return cell;
      parts.push_back(numberJson(*value));
    }
    at = end + 1;
  }
  return parts;
}

Result<json> cutsFromCsv(std::string_view text) {
  const std::string_view head = text.substr(0, text.find('\n'));
  const bool semicolons = head.find(';') != std::string_view::npos;
  const std::optional<std::vector<Line>> lines = linesOf(text, semicolons ? ';' : ',');
  if (!lines)
    return fail(ErrorCode::badInput, "the table of cuts ends inside of a quote; close it with \"", "table");
  if (lines->size() < 2)
    return fail(ErrorCode::badInput,
                "the table of cuts needs a line of column names and one line a cut at least", "table");
  std::vector<std::string> columns;
  for (const std::string& cell : lines->front()) {
    columns.push_back(trimmed(cell));
    const std::string& column = columns.back();
    if (std::ranges::find(kColumns, column) == kColumns.end()) {
      const std::vector<std::string> names(kColumns.begin(), kColumns.end());
      const std::string nearest = nearestWord(column, names.data(), int(names.size()));
      std::string all;
      for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
      return fail(ErrorCode::badInput,
                  "the table of cuts has no column \"" + column + "\"" +
                      (nearest.empty() ? "; the columns are " + all : "; did you mean \"" + nearest + "\"?"),
                  "table");
    }
    if (std::ranges::count(columns, column) > 1)
      return fail(ErrorCode::badInput, "the column \"" + column + "\" stands twice in the table of cuts",
                  "table");
  }
  json cuts = json::array();
  for (std::size_t i = 1; i < lines->size(); ++i) {
    const Line& line = (*lines)[i];
    if (line.size() > columns.size())
      return fail(ErrorCode::badInput,
                  "cut " + std::to_string(i) + " of the table has " + std::to_string(line.size()) +
                      " cells, but there are " + std::to_string(columns.size()) +
                      " columns; put cells that hold a " + (semicolons ? "semicolon" : "comma") +
                      " into quotes",
                  "table", double(line.size()), double(columns.size()));
    json cut = json::object();
    for (std::size_t c = 0; c < line.size(); ++c)
      if (const std::string cell = trimmed(line[c]); !cell.empty())
        cut[columns[c]] = valueOf(columns[c], cell, semicolons);
    cuts.push_back(std::move(cut));
  }
  return cuts;
}

Result<json> cutsFromJson(std::string_view text) {
  Result<json> table = parseJsonText(text, "table");
  if (!table) return table;
  if (table->is_array()) return table;
  if (!table->contains("cuts") || table->size() != 1)
    return fail(ErrorCode::badInput, "the table of cuts must be a list, or an object with the key cuts alone",
                "table");
  return json((*table)["cuts"]);
}

}  // namespace

std::string cutTableCsv(const Design& design) {
  std::string text;
  for (const char* column : kColumns) text += (text.empty() ? "" : ",") + std::string(column);
  text += "\n";
  for (std::size_t i = 0; i < design.cuts.size(); ++i) {
    const Cut& cut = design.cuts[i];
    json row = rowOf(design, i);
    const bool told = row["direction"].is_array() &&
                      std::ranges::any_of(row["direction"], [](const json& n) { return n.is_string(); });
    if (cut.direction && !told) {
      const Eigen::Vector3d& d = *cut.direction;
      row["direction"] =
          numberJson(d.x()).dump() + " " + numberJson(d.y()).dump() + " " + numberJson(d.z()).dump();
    }
    row["planes"] = row["planes"]["type"];
    std::string line;
    for (const char* column : kColumns)
      line += (column == kColumns.front() ? "" : ",") + cellOf(row.value(column, json()));
    text += line + "\n";
  }
  return text;
}

std::string cutTableJson(const Design& design) {
  json rows = json::array();
  for (std::size_t i = 0; i < design.cuts.size(); ++i) rows.push_back(rowOf(design, i));
  return json({{"cuts", rows}}).dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

Result<Design> withCutTable(const Design& design, std::string_view table) {
  if (!isUtf8(table))
    return fail(ErrorCode::badInput, "the table of cuts is no UTF-8 text; save it as CSV UTF-8", "table");
  table = withoutByteOrderMark(table);  // as spreadsheets begin UTF-8
  const std::size_t first = table.find_first_not_of(" \t\r\n");
  const bool isJson = first != std::string_view::npos && (table[first] == '{' || table[first] == '[');
  const Result<json> cuts = isJson ? cutsFromJson(table) : cutsFromCsv(table);
  if (!cuts) return tl::unexpected<Error>(cuts.error());
  if (design.sources.size() > 1 && cuts->is_array())
    for (std::size_t i = 0; i < cuts->size(); ++i)
      if ((*cuts)[i].is_object() && !(*cuts)[i].contains("source"))
        return fail(ErrorCode::badInput,
                    "cut " + std::to_string(i + 1) + " of the table names no source, but the design has " +
                        std::to_string(design.sources.size()) + "; give each its own in the column source",
                    "table");
  nlohmann::ordered_json object = detail::designJson(design);
  object["cuts"] = *cuts;
  Result<Design> made = detail::designFrom(json::parse(object.dump()), nullptr);
  if (!made) return made;
  // Files name their CAD file relative to where they lie; this one stays as it is.
  made->sources = design.sources;
  return made;
}

}  // namespace bw
