// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/grid_lines.h"

#include <algorithm>
#include <cmath>

namespace bw::scene {

namespace {

/// Lines of a grid in one direction, and what is told of their points.
class Lines {
 public:
  /// `alongRows`: the lines are the rows of the grid, else its columns.
  Lines(const SurfaceGrid& grid, const std::vector<Eigen::Vector3d>& normals,
        const std::vector<double>* values, const Unseen& unseen, bool alongRows)
      : points_(grid.points),
        normals_(normals),
        values_(values),
        unseen_(unseen),
        count_(alongRows ? grid.rows : grid.columns),
        length_(alongRows ? grid.columns : grid.rows),
        step_(alongRows ? grid.columns : 1),
        along_(alongRows ? 1 : grid.columns) {}

  /// Each as far as possible from the one before.
  std::vector<int> kept() const {
    std::vector<int> lines = {0};
    while (lines.back() + 1 < count_) {
      const int from = lines.back(), most = count_ - 1 - from;
      int good = 1, bad = most + 1;
      for (int next = 2; next <= most && bad > most; next = std::min(2 * next, next < most ? most : most + 1))
        (served(from, from + next) ? good : bad) = next;
      while (bad - good > 1) {
        const int middle = good + (bad - good) / 2;
        (served(from, from + middle) ? good : bad) = middle;
      }
      lines.push_back(from + good);
    }
    return lines;
  }

 private:
  std::size_t at(int line, int k) const {
    return std::size_t(line) * std::size_t(step_) + std::size_t(k) * std::size_t(along_);
  }

  /// Whether straight ways from one line to another pass the lines between within what is unseen.
  bool served(int from, int to) const {
    bool near = true;
    for (int k = 0; k < length_ && near; ++k)
      near = (points_[at(to, k)] - points_[at(from, k)]).squaredNorm() <= unseen_.gap * unseen_.gap;
    if (near) return true;
    for (int line = from + 1; line < to; ++line)
      for (int k = 0; k < length_; ++k)
        if (!passes(at(from, k), at(line, k), at(to, k))) return false;
    return true;
  }

  bool passes(std::size_t from, std::size_t at, std::size_t to) const {
    const Eigen::Vector3d way = points_[to] - points_[from], there = points_[at] - points_[from];
    const double square = way.squaredNorm(),
                 share = square > 0 ? std::clamp(there.dot(way) / square, 0.0, 1.0) : 0;
    // Written so that what is not a number does not pass.
    if (!((there - share * way).squaredNorm() <= unseen_.place * unseen_.place)) return false;
    const auto off = [&](const auto& of) { return of[at] - of[from] - share * (of[to] - of[from]); };
    const Eigen::Vector3d normal = off(normals_);
    if (!(normal.squaredNorm() <= unseen_.normal * unseen_.normal)) return false;
    return !values_ || std::abs(off(*values_)) <= unseen_.value;
  }

  const std::vector<Eigen::Vector3d>&points_, &normals_;
  const std::vector<double>* values_;
  const Unseen& unseen_;
  int count_, length_, step_, along_;
};

}  // namespace

std::vector<int> everySoMany(int count, int stride) {
  std::vector<int> places;
  for (int i = 0; i + 1 < count; i += stride) places.push_back(i);
  places.push_back(count - 1);
  return places;
}

KeptLines unseenLines(const SurfaceGrid& grid, const std::vector<Eigen::Vector3d>& normals,
                      const std::vector<double>* values, const Unseen& unseen) {
  return {Lines(grid, normals, values, unseen, true).kept(),
          Lines(grid, normals, values, unseen, false).kept()};
}

}  // namespace bw::scene
