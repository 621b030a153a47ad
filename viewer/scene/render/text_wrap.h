// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace bw::scene {

/// Breaks a text at its spaces into lines of at most `width` characters; what does not fit into `most` lines
/// ends in an ellipsis.
std::vector<std::string> wrapped(const std::string& text, std::size_t width, std::size_t most);

}  // namespace bw::scene
