// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/parts/whole_cut.h"

namespace bw {

namespace {

constexpr int kColumns = 41;
constexpr double kBeyond = 10;       ///< mm that the blade goes on beyond a block
constexpr double kApart = 20;        ///< mm, about, between rows of its straight travel
constexpr double kLeastApart = 0.5;  ///< mm between any two rows

}  // namespace

Result<WholeCut> wholeCut(const std::vector<BladePose>& course, const PlaneFamily& planes) {
  if (course.size() < 2)
    return fail(ErrorCode::badInput, "a cut needs two blades at least", "cut", double(course.size()), 2.0);
  WholeCut whole;
  std::vector<std::vector<Eigen::Vector3d>> rows;
  const auto add = [&](double travel, std::vector<Eigen::Vector3d> row) {
    whole.travel.push_back(travel);
    rows.push_back(std::move(row));
  };
  /// A blade carried to the travels from `from` to `to`.
  const auto carry = [&](const BladePose& blade, double from, double to, bool first, bool last) {
    const std::vector<Eigen::Vector3d> points = blade.bladePoints(kColumns);
    const int steps = std::max(1, int((to - from) / kApart));
    for (int k = first ? 0 : 1; k <= (last ? steps : steps - 1); ++k) {
      const double travel = from + (to - from) * k / steps;
      std::vector<Eigen::Vector3d> row = points;
      for (Eigen::Vector3d& p : row) p += (travel - blade.travel) * planes.direction();
      add(travel, std::move(row));
    }
  };
  const double begins = -kBeyond, ends = planes.travel(planes.exit) + kBeyond;
  if (course.front().travel > begins + kLeastApart)
    carry(course.front(), begins, course.front().travel, true, false);
  for (std::size_t i = 0; i < course.size(); ++i) {
    const bool last = i + 1 == course.size();
    if (!rows.empty() && course[i].travel < whole.travel.back() + kLeastApart && !last) continue;
    if (last && i > 0 && course[i].travel < whole.travel.back() + kLeastApart && rows.size() > 1) {
      rows.pop_back();
      whole.travel.pop_back();
    }
    add(course[i].travel, course[i].bladePoints(kColumns));
  }
  if (course.back().travel < ends - kLeastApart)
    carry(course.back(), course.back().travel, ends, false, true);
  whole.grid.rows = int(rows.size());
  whole.grid.columns = kColumns;
  for (const std::vector<Eigen::Vector3d>& row : rows)
    whole.grid.points.insert(whole.grid.points.end(), row.begin(), row.end());
  return whole;
}

}  // namespace bw
