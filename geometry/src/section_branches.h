// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "level_curves.h"

namespace bw::geometry {

inline constexpr double kMeet = 1e-3;  ///< mm: ends of pieces this close are one point

/// A chain of pieces over the faces: one connected curve of a section.
struct SectionBranch {
  struct Part {
    const LevelPiece* piece;  ///< one of those that were chained
    bool reversed;
  };
  std::vector<Part> parts;
  bool closed = false;
};

/// Joins pieces whose ends lie on the same crossing of a border, or else at the same point. Each piece
/// belongs to exactly one branch; the branches point into `pieces`.
std::vector<SectionBranch> chainPieces(const std::vector<LevelPiece>& pieces);

}  // namespace bw::geometry
