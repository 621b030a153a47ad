// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace bw {

/// Names as a file has them, none as another, in their order. `written` makes of a name and what is put
/// behind it what stands in the file; it may drop and shorten what it likes of the name, but keeps all that
/// is put behind. A name that comes out as one before it, or differs from that in its spaces alone, which
/// programs may trim, has " (2)" put behind, the next one " (3)". O(n log n) for few that are equal.
std::vector<std::string> distinctNames(
    std::span<const std::string> names,
    const std::function<std::string(const std::string& name, const std::string& behind)>& written);

}  // namespace bw
