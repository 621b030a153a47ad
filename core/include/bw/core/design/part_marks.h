// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>

namespace bw {

/// Parts of a design, by their ids.
struct PartIds {
  std::set<std::string> stock = {}, cuts = {}, sources = {};
  std::set<std::string> stations = {};  ///< all those of a cut, by its id
  bool operator==(const PartIds&) const = default;
};

/// What a person marked of a design: parts that pictures of the window leave out, and parts that no edit in
/// it changes. Nothing that is computed hangs on it. Ids of parts that are not there mark nothing, and are
/// not written.
struct PartMarks {
  PartIds hidden = {};
  PartIds locked = {};  ///< of stations their number, and how sections are laid through the surface
  bool operator==(const PartMarks&) const = default;
};

}  // namespace bw
