// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <QString>

#include <functional>
#include <vector>

#include "bw/core/base/frame.h"
#include "plots/section_plots.h"

class QPainter;

namespace bw::app {

/// What of the surface a hand may take hold of in the plane of a station, mm in that plane, or as it is
/// shown.
struct SectionGrips {
  struct Grip {
    int handle = -1;
    Eigen::Vector2d place;
    bool chosen = false, lit = false;
  };
  /// The way of one that is held, as far as it may go.
  struct Way {
    Eigen::Vector2d from, to;
    bool endsAtFrom = false, endsAtTo = false;
  };
  std::vector<Grip> grips;
  std::vector<Way> ways;
  /// Where the one that is held may go: a polygon, and which of its sides, from each corner to the next, are
  /// borders.
  std::vector<Eigen::Vector2d> region;
  std::vector<char> regionEnds;
  /// What the one that is held was brought in line with: its place, and the line on which both lie.
  struct Meeting {
    Eigen::Vector2d at, from, to;
  };
  std::vector<Meeting> meetings;
  QString text;          ///< of the one that is held
  bool stopped = false;  ///< it goes no farther
};
/// Those that lie within `reach` (mm) of the plane.
using FindGrips = std::function<SectionGrips(const Frame& plane, double reach)>;

/// The grip at a pixel; −1 if there is none.
int gripAt(const SectionGrips& grips, const SectionFrame& frame, const QPointF& pixel);

/// Discs at the grips, the ways of those that are moved, the region of the one that is held, and what they
/// were brought in line with.
void paintGrips(QPainter& painter, const SectionFrame& frame, const SectionGrips& grips,
                const Colours& colours);

}  // namespace bw::app
