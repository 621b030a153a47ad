// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "cad_format.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>

#include "step_scan.h"

namespace bw::geometry {

namespace {

constexpr char kEndOfFile = 0x1a;  // some programs close a text with it

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

/// Without the blanks and comments that a text begins with.
std::string_view withoutComments(std::string_view text) {
  text = trimmedLeft(text);
  while (text.substr(0, 2) == "/*") {
    const std::size_t end = text.find("*/", 2);
    text = end == std::string_view::npos ? std::string_view() : trimmedLeft(text.substr(end + 2));
  }
  return text;
}

}  // namespace

std::string lowerCase(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return result;
}

std::string_view trimmedRight(std::string_view text) {
  while (!text.empty() && (std::isspace(static_cast<unsigned char>(text.back())) || text.back() == '\0' ||
                           text.back() == kEndOfFile)) {
    text.remove_suffix(1);
  }
  return text;
}

std::string_view trimmedLeft(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  return text;
}

std::string_view withoutMark(std::string_view text) {
  return text.substr(0, 3) == "\xef\xbb\xbf" ? text.substr(3) : text;
}

CadFormat formatOfContent(std::string_view bytes) {
  const std::string_view head = withoutComments(bytes.substr(0, 65536));
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
  if (suffix == ".step" || suffix == ".stp" || suffix == ".p21" || suffix == ".stpz") return CadFormat::step;
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
  if (format == CadFormat::step) return stepNumberFault(bytes);
  if (format == CadFormat::brep) return brepFault(bytes);
  return {};
}

}  // namespace bw::geometry
