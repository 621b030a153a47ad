// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "cad_format.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <vector>

namespace bw::geometry {

namespace {

constexpr std::size_t kMaxStepDigits = 9;  // of an entity's number: OCCT keeps it in 32 bits

/// The last words that a complete file of the format ends with.
bool complete(std::string_view bytes, CadFormat format) {
  const std::string_view body = trimmedRight(bytes);
  if (format == CadFormat::step) {
    const std::string_view tail = body.substr(body.size() > 400 ? body.size() - 400 : 0);
    return tail.find("END-ISO-10303-21") != std::string_view::npos;
  }
  if (format == CadFormat::iges) {
    const std::size_t line = body.rfind('\n');
    const std::string_view last = line == std::string_view::npos ? body : body.substr(line + 1);
    return last.size() > 72 && last[72] == 'T';
  }
  return true;
}

/// Passes over a string, comment or any other character of a STEP text; `at` must be inside it.
std::size_t nextStepToken(std::string_view text, std::size_t at) {
  if (text[at] == '\'') {
    const std::size_t end = text.find('\'', at + 1);
    return end == std::string_view::npos ? text.size() : end + 1;
  }
  if (text.compare(at, 2, "/*") == 0) {
    const std::size_t end = text.find("*/", at + 2);
    return end == std::string_view::npos ? text.size() : end + 2;
  }
  return at + 1;
}

/// Every entity of a STEP text has a number of its own, between 1 and 10⁹ − 1.
std::string stepFault(std::string_view text) {
  std::vector<long> numbers;
  for (std::size_t at = 0; at < text.size(); at = nextStepToken(text, at)) {
    if (text[at] != '#') continue;
    std::size_t end = at + 1;
    while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end]))) ++end;
    const std::string_view digits = text.substr(at + 1, end - at - 1);
    while (end < text.size() && std::isspace(static_cast<unsigned char>(text[end]))) ++end;
    const bool defines = end < text.size() && text[end] == '=';
    if (digits.empty() || digits.size() > kMaxStepDigits ||
        digits.find_first_not_of('0') == std::string_view::npos) {
      return "\"#" + std::string(digits) +
             "\" is not the number of an entity; the file is damaged: copy or export it again";
    }
    if (defines) numbers.push_back(std::strtol(std::string(digits).c_str(), nullptr, 10));
  }
  std::sort(numbers.begin(), numbers.end());
  const auto twice = std::adjacent_find(numbers.begin(), numbers.end());
  if (twice == numbers.end()) return {};
  return "its entity #" + std::to_string(*twice) +
         " is there twice; the file is damaged: copy or export it again";
}

/// A BREP text is complete if it names each of its tables, no table claims more entries than the file has
/// room for, the last shape of its list is closed by '*', and a reference to a shape follows.
std::string brepFault(std::string_view text) {
  std::size_t at = 0;
  for (const char* table : {"Locations", "Curve2ds", "Curves", "Polygon3D", "PolygonOnTriangulations",
                            "Surfaces", "Triangulations", "TShapes"}) {
    at = text.find(table, at);
    if (at == std::string_view::npos) {
      return std::string("its table of ") + table + " is missing; the file is cut short or not a BREP";
    }
    at += std::string_view(table).size();
    const long count = std::strtol(std::string(text.substr(at, 24)).c_str(), nullptr, 10);
    if (count < 0 || std::size_t(count) > text.size()) {
      return std::string("its table of ") + table + " claims " + std::to_string(count) +
             " entries, more than the file has room for";
    }
  }
  const std::size_t star = text.rfind('*');
  const std::string_view tail =
      star == std::string_view::npos || star < at ? "" : trimmedLeft(text.substr(star + 1));
  if (tail.empty() || (tail.front() != '+' && tail.front() != '-') || tail.size() < 4) {
    return "its list of shapes stops too early; the file is cut short";
  }
  return {};
}

}  // namespace

std::string lowerCase(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return result;
}

std::string_view trimmedRight(std::string_view text) {
  while (!text.empty() && (std::isspace(static_cast<unsigned char>(text.back())) || text.back() == '\0')) {
    text.remove_suffix(1);
  }
  return text;
}

std::string_view trimmedLeft(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  return text;
}

CadFormat formatOfContent(std::string_view bytes) {
  const std::string_view head = trimmedLeft(bytes.substr(0, 4096));
  if (head.substr(0, 12) == "ISO-10303-21") return CadFormat::step;
  if (head.substr(0, 19) == "DBRep_DrawableShape" || head.substr(0, 16) == "CASCADE Topology")
    return CadFormat::brep;
  // IGES has records of 80 columns with a section letter in column 73, the first section being S.
  if (bytes.size() > 80 && bytes[72] == 'S' && std::isdigit(static_cast<unsigned char>(bytes[79])))
    return CadFormat::iges;
  return CadFormat::unknown;
}

CadFormat formatOfSuffix(const std::string& name) {
  const std::string suffix = lowerCase(std::filesystem::path(name).extension().string());
  if (suffix == ".step" || suffix == ".stp" || suffix == ".p21") return CadFormat::step;
  if (suffix == ".iges" || suffix == ".igs") return CadFormat::iges;
  if (suffix == ".brep" || suffix == ".brp" || suffix == ".rle") return CadFormat::brep;
  return CadFormat::unknown;
}

const char* formatName(CadFormat format) {
  switch (format) {
    case CadFormat::step:
      return "STEP";
    case CadFormat::iges:
      return "IGES";
    case CadFormat::brep:
      return "BREP";
    case CadFormat::unknown:
      break;
  }
  return "CAD";
}

std::string faultOf(std::string_view bytes, CadFormat format) {
  if (!complete(bytes, format)) {
    return std::string("the ") + formatName(format) +
           " file is cut short (its end mark is missing); copy or export it again";
  }
  if (format == CadFormat::step) return stepFault(bytes);
  if (format == CadFormat::brep) return brepFault(bytes);
  return {};
}

}  // namespace bw::geometry
