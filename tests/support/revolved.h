// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

namespace bw::test {

/// A design as the text of its file: key blades of one shape in planes through an upright line that stands
/// `before` mm before the block, beside its corner in the middle of its length, turned by `half` degrees to
/// either side. The block is 600 mm wide, as long as these planes are apart at 300 mm, and 500 mm high.
/// `more` goes into its one cut.
inline std::string revolved(double before, double half, const std::string& more = {}) {
  const double middle = 300 + before, reach = middle * std::tan(half * std::numbers::pi / 180);
  std::ostringstream text;
  text.precision(17);
  text << R"({"bladewright_design": 2, "name": "Revolved",
    "sources": [{"id": "surface", "surface": {"type": "blades", "blades": [)";
  for (int k = -2; k <= 2; ++k) {
    const double turn = 0.5 * k * half, angle = turn * std::numbers::pi / 180;
    text << (k > -2 ? ", " : "") << R"({"y": )" << 400 + middle * std::tan(angle)
         << R"(, "middle": [300, 290], "angle_deg": 0, "turn_deg": )" << turn << R"(, "length_mm": )"
         << 660 / std::cos(angle) << R"(, "bend": -0.6, "force": [1, 0]})";
  }
  text << R"(]}}], "stock": [{"id": "block", "block": {"origin": [0, )" << 400 - reach
       << R"(, 0], "size": [600, )" << 2 * reach << R"(, 500]}}],
    "cuts": [{"id": "cut", "source": "surface", "block": "block", "stations": 33)"
       << more << R"(}],
    "blade": {"preset": "nicr-flat-5x1", "length": 900}})";
  return text.str();
}

}  // namespace bw::test
