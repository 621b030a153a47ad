// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/text/expression.h"

namespace bw {

struct Design;

/// A named number of a design. Formulas and numbers that are told by expressions ("=amplitude/2" in files)
/// may use it.
struct Variable {
  std::string name;
  double value = 0;
  double min = 0, max = 0;  ///< the value lies between
  std::string unit = {};  ///< for people, and the units that are understood where it is typed: "mm", "°", …
  bool operator==(const Variable&) const = default;
};

/// True for what a variable may be named: `isExpressionName`, and neither x nor y.
bool isVariableName(std::string_view name);

/// The design with every number that an expression stands for, and with what its formulas use, as its
/// variables are now. Numbers that were changed since they were read are no longer bound. Errors
/// (`badInput`): what the reader of designs says of a number out of range, an expression with no value, or a
/// name that is gone.
Result<Design> resolved(const Design& design);

/// The same with some variables set. Errors besides: there is no such variable (with the nearest), or a value
/// lies outside its range, which is told.
Result<Design> withVariables(const Design& design, const std::vector<NamedNumber>& values);

}  // namespace bw
