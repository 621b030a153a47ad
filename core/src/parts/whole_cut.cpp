// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/parts/whole_cut.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bw {

namespace {

using Row = std::vector<Eigen::Vector3d>;

constexpr int kColumns = 41;
constexpr double kBeyond = 10;       ///< mm that the blade goes on beyond a block
constexpr double kLeastApart = 0.5;  ///< mm between any two rows
constexpr double kAtFace = 1;        ///< mm from a face of the block: what ends there goes through it
/// mm from where the course becomes straight, on either side: rows that keep a bend where it is, and the
/// slope with which a surface goes on in a neighbouring block.
constexpr std::array kAroundBend = {1.0, 3.0, 9.0, 27.0};

/// The rows of a course at a travel near one of its ends: a cubic through the four rows there, or fewer.
Row near(const std::vector<Row>& rows, const std::vector<double>& travel, bool atEnd, double at) {
  const std::size_t count = std::min<std::size_t>(4, rows.size()), first = atEnd ? rows.size() - count : 0;
  Row row(kColumns, Eigen::Vector3d::Zero());
  for (std::size_t i = first; i < first + count; ++i) {
    double weight = 1;
    for (std::size_t k = first; k < first + count; ++k)
      if (k != i) weight *= (at - travel[k]) / (travel[i] - travel[k]);
    for (std::size_t c = 0; c < row.size(); ++c) row[c] += weight * rows[i][c];
  }
  return row;
}

}  // namespace

Result<WholeCut> wholeCut(const std::vector<BladePose>& course, const PlaneFamily& planes) {
  if (course.size() < 2)
    return fail(ErrorCode::badInput, "a cut needs two blades at least", "cut", double(course.size()), 2.0);
  std::vector<Row> rows;
  std::vector<double> travel;
  for (std::size_t i = 0; i < course.size(); ++i) {
    if (!travel.empty() && course[i].travel < travel.back() + kLeastApart) {
      if (i + 1 < course.size()) continue;
      rows.pop_back();  // the last one stays
      travel.pop_back();
    }
    travel.push_back(course[i].travel);
    rows.push_back(course[i].bladePoints(kColumns));
  }
  if (rows.size() < 2)
    return fail(ErrorCode::badInput, "the blades of a cut lie in one plane", "cut", double(rows.size()), 2.0);

  std::vector<std::pair<double, Row>> all;
  for (std::size_t i = 0; i < rows.size(); ++i) all.emplace_back(travel[i], rows[i]);
  const double length = planes.travel(planes.exit);
  for (const bool atEnd : {false, true}) {
    const double end = atEnd ? travel.back() : travel.front(), way = atEnd ? 1 : -1;
    const double beyond = atEnd ? length + kBeyond : -kBeyond;
    if ((beyond - end) * way < kLeastApart) continue;
    const Row& last = atEnd ? rows.back() : rows.front();
    const bool through = atEnd ? end > length - kAtFace : end < kAtFace;
    // Outside of the block it goes on as it comes; in it the blade is carried straight on.
    Row slope(kColumns, (atEnd ? course.back() : course.front()).frame.normal);
    if (through) {
      const Row before = near(rows, travel, atEnd, end - way * kLeastApart);
      for (std::size_t c = 0; c < slope.size(); ++c) slope[c] = way * (last[c] - before[c]) / kLeastApart;
    }
    const auto carried = [&](double to) {
      Row row = last;
      for (std::size_t c = 0; c < row.size(); ++c) row[c] += (to - end) * slope[c];
      all.emplace_back(to, std::move(row));
    };
    const double spacing = std::abs(end - travel[atEnd ? travel.size() - 2 : 1]);
    for (const double apart : kAroundBend) {
      if (apart < 0.6 * spacing)
        all.emplace_back(end - way * apart, near(rows, travel, atEnd, end - way * apart));
      if (apart < 0.6 * std::abs(beyond - end)) carried(end + way * apart);
    }
    carried(beyond);
  }
  std::ranges::sort(all, {}, &std::pair<double, Row>::first);
  WholeCut whole;
  whole.grid.rows = int(all.size());
  whole.grid.columns = kColumns;
  for (const auto& [at, row] : all) {
    whole.travel.push_back(at);
    whole.grid.points.insert(whole.grid.points.end(), row.begin(), row.end());
  }
  return whole;
}

}  // namespace bw
