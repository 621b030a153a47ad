// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "bw/pipeline/reach.h"

namespace bw::pipeline {

/// Where in a plane something of a design may be moved to, by straight ways from where it is, as far as
/// sketches tell.
struct Region {
  struct Ray {
    Eigen::Vector2d way = Eigen::Vector2d::UnitX();  ///< unit
    double free = 0;                                 ///< mm, so far it may, as far as was looked
    Bar bar = Bar::none;                             ///< what bars it beyond; none where nothing was found to
  };
  std::vector<Ray> rays = {};  ///< counter-clockwise, of those looked along; none where it is barred as it is
};

/// Seeks that look by look, all ways around: the first looks tell little of each, the next ones more.
class RegionSearch {
 public:
  static constexpr std::size_t kLines = 8;      ///< through where it is, two rays each
  static constexpr double kFarthest = 200;      ///< mm: beyond that nobody looks
  static constexpr double kWithinShare = 0.05;  ///< of a ray, as near as its end is sought

  /// `at` makes the design that is moved by so many mm along both axes of the plane.
  RegionSearch(const std::shared_ptr<const Evaluation>& from,
               std::function<Design(const Eigen::Vector2d&)> at);

  /// One more look along the line that was looked along least; false where none finds more.
  bool look(const RunContext& context);
  bool looking() const;
  Region region() const;

 private:
  struct Line {
    std::optional<ReachSearch> search;
    Reach reach;
    int looks = 0;
    bool done = false;
  };
  static Eigen::Vector2d wayOf(std::size_t line);

  std::shared_ptr<const Evaluation> from_;
  std::function<Design(const Eigen::Vector2d&)> at_;
  std::vector<Line> lines_;
};

}  // namespace bw::pipeline
