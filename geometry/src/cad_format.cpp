// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "cad_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <filesystem>

namespace bw::geometry {

namespace {

constexpr std::size_t kMaxDigits = 9;  // of an entity's number: OCCT keeps it in 32 bits

/// Passes over a string, comment or any other character of a STEP text; `at` must be inside it.
std::size_t nextToken(std::string_view text, std::size_t at) {
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

/// Calls `visit(digits, defines)` for every number of an entity in the text, until it returns false.
template <class Visit>
void eachNumber(std::string_view text, const Visit& visit) {
  for (std::size_t at = 0; at < text.size(); at = nextToken(text, at)) {
    if (text[at] != '#') continue;
    std::size_t end = at + 1;
    while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end]))) ++end;
    const std::string_view digits = text.substr(at + 1, end - at - 1);
    while (end < text.size() && std::isspace(static_cast<unsigned char>(text[end]))) ++end;
    if (!visit(digits, end < text.size() && text[end] == '=')) return;
  }
}

int numberOf(std::string_view digits) {
  int number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

/// Why the numbers of a STEP text's entities cannot be used: every entity has one of its own, between 1 and
/// 10⁹ − 1. Empty if nothing is found.
std::string stepNumberFault(std::string_view text) {
  std::vector<int> numbers;
  std::string fault;
  eachNumber(text, [&](std::string_view digits, bool defines) {
    if (digits.empty() || digits.size() > kMaxDigits ||
        digits.find_first_not_of('0') == std::string_view::npos) {
      fault = "\"#" + std::string(digits) +
              "\" is not the number of an entity; the file is damaged: copy or export it again";
      return false;
    }
    if (defines) numbers.push_back(numberOf(digits));
    return true;
  });
  if (!fault.empty()) return fault;
  std::sort(numbers.begin(), numbers.end());
  const auto twice = std::adjacent_find(numbers.begin(), numbers.end());
  if (twice == numbers.end()) return {};
  return "its entity #" + std::to_string(*twice) +
         " is there twice; the file is damaged: copy or export it again";
}

}  // namespace

StepReferences::StepReferences(std::string_view text) {
  int user = 0;
  eachNumber(text, [&](std::string_view digits, bool defines) {
    if (defines) {
      user = numberOf(digits);
    } else {
      uses_.emplace_back(numberOf(digits), user);
    }
    return true;
  });
  std::sort(uses_.begin(), uses_.end());
}

std::vector<int> StepReferences::usersOf(int entity) const {
  std::vector<int> users;
  for (auto it = std::lower_bound(uses_.begin(), uses_.end(), std::pair(entity, 0));
       it != uses_.end() && it->first == entity; ++it) {
    users.push_back(it->second);
  }
  return users;
}

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
  constexpr std::array kNames = {"STEP", "IGES", "BREP", "CAD"};
  return kNames[std::size_t(format)];
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

std::string unitName(std::string text) {
  text = lowerCase(text);
  if (text.find("millimet") != std::string::npos || text == "mm") return "mm";
  if (text.find("centimet") != std::string::npos || text == "cm") return "cm";
  if (text.find("kilomet") != std::string::npos || text == "km") return "km";
  if (text.find("micromet") != std::string::npos || text == "um") return "um";
  if (text == "metre" || text == "meter" || text == "m") return "m";
  if (text.find("inch") != std::string::npos || text == "in") return "inch";
  if (text.find("foot") != std::string::npos || text.find("feet") != std::string::npos || text == "ft")
    return "foot";
  if (text == "mil" || text == "mils") return "mil";
  if (text.find("mi") == 0) return "mile";
  return text.empty() ? "mm (assumed)" : text;
}

double unitLength(const std::string& name) {
  struct Known {
    const char* name;
    double mm;
  };
  for (const Known& unit : {Known{"mm", 1}, Known{"mm (assumed)", 1}, Known{"cm", 10}, Known{"m", 1000},
                            Known{"km", 1e6}, Known{"um", 1e-3}, Known{"inch", 25.4}, Known{"foot", 304.8},
                            Known{"mil", 0.0254}, Known{"mile", 1609344}}) {
    if (name == unit.name) return unit.mm;
  }
  return 0;
}

}  // namespace bw::geometry
