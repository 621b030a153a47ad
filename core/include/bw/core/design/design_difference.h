// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bw/core/design/design.h"

namespace bw {

/// One thing in which two designs differ.
struct DesignDifference {
  /// JSON pointer of it in the file of the later design; of what only the earlier one has, in that of that.
  std::string pointer;
  std::string what;           ///< in plain words: "Tolerance", "Cut cut-1: stations"
  std::string before, after;  ///< numbers with their units, expressions, words; empty where it is not there
  bool many = false;  ///< stands for many numbers: `after` tells how many, and by how much they differ
  bool operator==(const DesignDifference&) const = default;
};

/// The same in one line: "Tolerance: 2 mm → 1 mm".
std::string sentenceOf(const DesignDifference& difference);

/// In what designs differ, in the order of their files: nothing for equal ones. Blocks, cuts, surfaces and
/// variables are compared with those of the same name. Many numbers of one list, such as the poles of a
/// surface, are one difference. What a linked CAD file was when it was saved is none, and neither are
/// versions.
std::vector<DesignDifference> differences(const Design& before, const Design& after);

}  // namespace bw
