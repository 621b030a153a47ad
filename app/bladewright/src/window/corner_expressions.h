// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Where the corner of a block stands while another of its numbers follows an expression.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "bw/core/base/frame.h"

namespace bw::app {

/// Expressions of x, y and z of the corner; none of one that does not move.
using CornerExpressions = std::array<std::optional<std::string>, 3>;

/// Keeps the far face of a block where it is, while its size along an axis (0 x, 1 y, 2 z) stands for `size`:
/// the face at the corner moves.
CornerExpressions cornerOfSize(const BlockPlacement& placed, int axis, const std::string& size);

/// Keeps the middle of a block where it is, while one of its rotations (0 x, 1 y, 2 z) stands for `degrees`.
CornerExpressions cornerOfTurn(const BlockPlacement& placed, int axis, const std::string& degrees);

}  // namespace bw::app
