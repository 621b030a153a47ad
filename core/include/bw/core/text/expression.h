// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/result.h"

namespace bw {

/// A number that expressions know by name.
struct NamedNumber {
  std::string name;
  double value = 0;
  bool operator==(const NamedNumber&) const = default;
};

/// A number that stands for an expression, and what that came to when it was read.
struct BoundNumber {
  std::string text;  ///< without the = before it in files
  double value = 0;
  bool operator==(const BoundNumber&) const = default;
};

/// A formula of named numbers, read once and computed often: + − * / ^, brackets, the constant pi, and
/// sin, cos, tan, asin, acos, atan, atan2, sqrt, exp, log (natural), abs, min, max; angles in radians. −a^2
/// is −(a^2), a^b^c is a^(b^c). Unlike what `readTypedNumber` reads, it has no units, and what it means does
/// not depend on the field that it stands in: decimals stand after a point, arguments are parted by a comma
/// or a semicolon, and a comma between two digits, which could be either, is refused.
class Expression {
 public:
  static constexpr std::size_t kLongest = 1000;  ///< bytes of a text

  /// Reads `text` over `names`. Errors: `badInput` with the number of the character (from 1), what stands
  /// there and what is expected; a name that there is not, with the nearest; a text that is too long, or has
  /// more than 32 brackets within each other.
  static Result<Expression> parse(std::string_view text, const std::vector<std::string>& names);

  /// Its value for `values` of the names, in their order: finite, or an error, `noSolution`, that tells the
  /// character and what has no finite value there. Takes some 5 ns a step.
  Result<double> value(std::span<const double> values) const;

  /// True if it has the name of that index in it.
  bool uses(std::size_t name) const;

 private:
  friend class ExpressionParser;
  enum class Op : std::uint8_t {
    number,
    name,
    negate,
    add,
    subtract,
    multiply,
    divide,
    power,
    sin,
    cos,
    tan,
    asin,
    acos,
    atan,
    sqrt,
    exp,
    log,
    abs,
    atan2,
    min,
    max  // as the table of functions
  };
  struct Step {
    Op op;
    int name = 0;       ///< of Op::name
    int character = 0;  ///< where it stands, from 1
    double number = 0;  ///< of Op::number
  };
  static constexpr int kStack = 160;  ///< numbers that wait for their operator; four for each bracket

  std::vector<Step> steps_;  ///< each after the operands that it takes
};

/// True for what a number may be named: a letter and then letters, digits or _, at most 40, in ASCII, and no
/// function or constant.
bool isExpressionName(std::string_view text);

/// The value of `text` over `numbers`. Errors: those of `Expression`.
Result<double> evaluateExpression(std::string_view text, std::span<const NamedNumber> numbers);

}  // namespace bw
