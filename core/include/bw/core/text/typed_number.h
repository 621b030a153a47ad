// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/result.h"

namespace bw {

/// What a field asks for: the unit in which its number stands, and which numbers it takes.
struct NumberDemand {
  std::string
      unit;  ///< as the field shows it: "mm", "°", "mm/s", "N/mm²", "°C", …; without one a bare number
  double min = -std::numeric_limits<double>::infinity();  ///< in that unit
  double max = std::numeric_limits<double>::infinity();
  bool whole = false;  ///< whole numbers only
};

/// The number that a person means by `text`, in the unit of the field; the same in every locale.
///
/// Decimals stand after a point or a comma, thousands in groups of three (1 200, 1'200, 1.234,5, 1,234.5).
/// A single comma before exactly three digits (1,234) could be either and is refused. Exponents (1e3),
/// sums, products, quotients, brackets and pi are read. A number or bracket may carry a unit of the field's
/// kind (mm, cm, m, in, ft, µm; °, rad, gon; mm/s, m/min, …): in a product or quotient it counts for the
/// whole (600/4 cm = 1500 mm). In a sum every part needs one as soon as one part has another than the field's
/// own. What is left over, a number that is not whole where it must be, and one outside the limits are
/// errors, `badInput`, whose message is one sentence.
Result<double> readTypedNumber(std::string_view text, const NumberDemand& demand);

/// The numbers that a person means by a list such as "1, 3, 5-7", without repetitions, in the order given.
/// `count`: how many things there are to number, from `lowest` on. Anything else is an error, `badInput`,
/// whose message is one sentence about a `thing` ("face").
Result<std::vector<int>> readNumberList(std::string_view text, int count, std::string_view thing,
                                        int lowest = 0);

/// The list as text, runs of three and more joined: "1, 3, 5-7".
std::string numberListText(const std::vector<int>& numbers);

}  // namespace bw
