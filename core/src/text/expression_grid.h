// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bw/core/text/expression.h"

namespace bw {

/// An expression over a grid of two of its names, row by row: what does not hang on the inner one is computed
/// once a row, what does not hang on the outer one once for all rows. Its values are those of
/// `Expression::value`, bit by bit, at some 2 to 20 ns for each step that hangs on both.
class ExpressionGrid {
 public:
  /// `values` are those of all names; those of `inner` and `outer` are told by `row`.
  ExpressionGrid(const Expression& expression, std::vector<double> values, std::size_t inner,
                 std::size_t outer);

  /// The values at one of the outer name, for many of the inner one. False if one of them, or a number on the
  /// way there, is not finite: `Expression::value` tells of that one what is wrong.
  bool row(double outer, std::span<const double> inner, std::span<double> out);

 private:
  struct Node {
    std::uint8_t op;
    int left = -1, right = -1;  ///< nodes of its operands, `right` the one of a single operand
    int name = 0;
    bool byInner = false, byOuter = false;
    std::vector<double> values;  ///< for each of the inner name, or one
  };
  bool compute(Node& node) const;
  void setColumns(std::span<const double> inner);

  std::vector<Node> nodes_;
  std::vector<double> values_, columns_;
  std::size_t inner_, outer_;
  bool columnsAreFinite_ = true;  ///< of what does not hang on the outer name
};

}  // namespace bw
