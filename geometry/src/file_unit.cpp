// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "file_unit.h"

#include "cad_format.h"

namespace bw::geometry {

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
