// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "section_branches.h"

namespace bw::geometry {

std::vector<SectionBranch> chainPieces(const std::vector<LevelPiece>& pieces) {
  std::vector<SectionBranch> branches;
  std::vector<int> partner(2 * pieces.size(), -1);  // end 2k = first node of piece k, 2k + 1 = last
  const auto nodeOf = [&](int end) -> const LevelNode& {
    const LevelPiece& piece = pieces[std::size_t(end / 2)];
    return end % 2 ? piece.nodes.back() : piece.nodes.front();
  };
  std::vector<int> ends;
  for (int k = 0; k < int(pieces.size()); ++k) {
    if (pieces[k].closed) continue;
    ends.push_back(2 * k);
    ends.push_back(2 * k + 1);
  }
  for (const int e : ends) {
    const int root = nodeOf(e).root;
    if (root < 0) continue;
    std::vector<int> same;
    for (const int other : ends) {
      if (nodeOf(other).root == root) same.push_back(other);
    }
    if (same.size() == 2) partner[e] = same[0] == e ? same[1] : same[0];
  }
  for (const int e : ends) {
    if (partner[e] >= 0) continue;
    int best = -1;
    double nearest = kMeet;
    for (const int other : ends) {
      if (other == e || partner[other] >= 0) continue;
      // A short piece's two ends must not meet each other.
      if (other / 2 == e / 2 && pieces[e / 2].nodes.size() < 4) continue;
      const double d = (nodeOf(other).p - nodeOf(e).p).norm();
      if (d <= nearest) {
        nearest = d;
        best = other;
      }
    }
    if (best >= 0) {
      partner[e] = best;
      partner[best] = e;
    }
  }
  std::vector<char> used(pieces.size(), 0);
  const auto walk = [&](int start, bool closed) {
    SectionBranch branch;
    branch.closed = closed;
    int end = start;  // the end at which the piece is entered
    while (end >= 0 && !used[end / 2]) {
      used[end / 2] = 1;
      branch.parts.push_back({&pieces[end / 2], end % 2 == 1});
      end = partner[end ^ 1];
    }
    branches.push_back(std::move(branch));
  };
  for (int k = 0; k < int(pieces.size()); ++k) {
    if (pieces[k].closed) {
      branches.push_back({{{&pieces[k], false}}, true});
      used[k] = 1;
    }
  }
  for (const int e : ends) {
    if (!used[e / 2] && partner[e] < 0) walk(e, false);
  }
  for (const int e : ends) {
    if (!used[e / 2]) walk(e, true);
  }
  return branches;
}

}  // namespace bw::geometry
