// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bw::geometry {

/// Why the numbers of a STEP text's entities cannot be used: every entity has one of its own, between 1 and
/// 10⁹ − 1. Empty if nothing is found.
std::string stepNumberFault(std::string_view text);

/// Which entities of a STEP text refer to which, as written, whatever becomes of them in a reader.
class StepReferences {
 public:
  explicit StepReferences(std::string_view text);

  /// Numbers of the entities that refer to `entity`.
  std::vector<int> usersOf(int entity) const;

 private:
  std::vector<std::pair<int, int>> uses_;  // the one referred to and the one that refers, sorted
};

}  // namespace bw::geometry
