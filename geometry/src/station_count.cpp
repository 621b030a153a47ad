// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

// How many stations a tolerance asks for: docs/mathematics.md, Number of stations.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bw/geometry/export.h"
#include "bw/geometry/sections.h"
#include "occt.h"
#include "section_row.h"
#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr int kColumns = 33;             // places of a section that are looked at
constexpr int kFirstIntervals = 120;     // between the planes that are looked at first; doubled from then on
constexpr int kLastIntervals = 480;      // and at last
constexpr std::array kStrides = {3, 2};  // of the planes looked at, every so manieth is a station
constexpr double kShare = 0.05;          // of the tolerance, for what lies between stations
constexpr double kLeastShare = 2e-3;     // mm: sections are known to half of it
constexpr double kEndShare = 0.5;   // of the tolerance, by which a section may reach beyond its neighbours'
constexpr double kLeastEnd = 0.25;  // mm, likewise

/// One section that is followed, as what its neighbours say is held against it.
struct Look {
  double travel = 0;
  Frame frame;
  PlanarCurve curve;
  std::array<double, kColumns> parameters;  ///< about evenly by arc length
};

/// How far sections lie from what the stations of a row say of them.
struct Off {
  double across = 0;  ///< mm, along the section's normal
  double beyond = 0;  ///< mm, along the section beyond its end
};

/// By the Gauss nodes of the curve: even to some hundredths, which is enough where distances are normal ones.
std::array<double, kColumns> evenParameters(const PlanarCurve& curve) {
  const PlanarCurve::Quadrature& nodes = curve.quadrature();
  std::array<double, kColumns> parameters;
  parameters.front() = curve.start();
  parameters.back() = curve.end();
  const double length = curve.length();
  std::size_t k = 0;
  for (int c = 1; c + 1 < kColumns; ++c) {
    const double arc = length * c / (kColumns - 1);
    while (k < nodes.arc.size() && nodes.arc[k] < arc) ++k;
    const double arcBefore = k > 0 ? nodes.arc[k - 1] : 0,
                 tBefore = k > 0 ? nodes.parameter[k - 1] : curve.start();
    const bool ends = k == nodes.arc.size();
    const double arcAfter = ends ? length : nodes.arc[k], tAfter = ends ? curve.end() : nodes.parameter[k];
    const double part = arcAfter > arcBefore ? (arc - arcBefore) / (arcAfter - arcBefore) : 0;
    parameters[std::size_t(c)] = std::lerp(tBefore, tAfter, part);
  }
  return parameters;
}

/// The sections of evenly spaced planes, by their number; none where nothing is followed.
std::vector<std::optional<Look>> looksOf(const SectionRow& row, const std::vector<SectionOutcome>& outcomes) {
  std::vector<std::optional<Look>> looks(outcomes.size());
  Findings ignored;
  const auto sections = row.finish(outcomes, ignored);
  if (!sections) return looks;
  for (const Section& section : *sections)
    if (section.chosen >= 0)
      looks[std::size_t(section.index)] =
          Look{section.travel, section.frame, section.curve(), evenParameters(section.curve())};
  return looks;
}

/// How far the sections that are no station lie from the skin through every `stride`th one; none where that
/// cannot be told.
std::optional<Off> between(const std::vector<std::optional<Look>>& looks, int stride,
                           const RunContext& context) {
  SurfaceGrid grid;
  grid.columns = kColumns;
  std::vector<double> travels;
  for (std::size_t i = 0; i < looks.size(); i += std::size_t(stride)) {
    if (!looks[i]) continue;
    travels.push_back(looks[i]->travel);
    for (const double t : looks[i]->parameters)
      grid.points.push_back(looks[i]->frame.toWorld(looks[i]->curve.value(t)));
  }
  grid.rows = int(travels.size());
  if (grid.rows < 2) return {};
  const double first = travels.front(), way = travels.back() - first;
  for (double& travel : travels) travel = (travel - first) / way;
  const Result<SplineSurface> skin = loft(grid, travels);
  if (!skin) return {};

  std::vector<Off> each(looks.size());
  const auto look = [&](int i) {
    const std::size_t before = std::size_t(i / stride * stride), after = before + std::size_t(stride);
    if (i % stride == 0 || !looks[std::size_t(i)] || !looks[before] || !looks[after]) return;
    const Look& own = *looks[std::size_t(i)];
    Off& off = each[std::size_t(i)];
    for (int c = 0; c < kColumns; ++c) {
      const Eigen::Vector2d p =
          own.frame.toLocal(skin->value(double(c) / (kColumns - 1), (own.travel - first) / way)).head<2>();
      const double t = own.curve.nearestParameter(p, own.parameters[std::size_t(c)]);
      const Eigen::Vector2d away = p - own.curve.value(t), tangent = own.curve.tangent(t);
      off.across = std::max(off.across, std::abs(tangent.x() * away.y() - tangent.y() * away.x()));
      if (c == 0) off.beyond = std::max(off.beyond, own.curve.arcLength(t));
      if (c + 1 == kColumns) off.beyond = std::max(off.beyond, own.curve.length() - own.curve.arcLength(t));
    }
  };
  if (!parallelFor(context, int(looks.size()), look)) return {};
  Off all;
  for (const Off& off : each) {
    all.across = std::max(all.across, off.across);
    all.beyond = std::max(all.beyond, off.beyond);
  }
  return all;
}

}  // namespace

Result<StationCount> stationsFor(const Target& target, const Setup& setup, double tolerance,
                                 const RunContext& context) {
  return guarded(
      ErrorCode::internal, "the number of stations cannot be found", [&]() -> Result<StationCount> {
        if (auto ok = checkSetup(setup); !ok) return tl::unexpected(ok.error());
        SectionRow row(target, setup);
        if (auto ok = row.place(); !ok) return tl::unexpected(ok.error());
        const double across = std::max(kLeastShare, kShare * tolerance),
                     beyond = std::max(kLeastEnd, kEndShare * tolerance);
        StationCount count;
        std::vector<SectionOutcome> outcomes;
        for (int intervals = kFirstIntervals; intervals <= kLastIntervals; intervals *= 2) {
          row.divide(intervals + 1, StationCount::kLeast);
          std::vector<SectionOutcome> finer(std::size_t(intervals) + 1);
          const auto done = parallelFor(context, intervals + 1, [&](int i) {
            const bool known = i % 2 == 0 && !outcomes.empty();
            finer[std::size_t(i)] = known ? std::move(outcomes[std::size_t(i / 2)]) : row.cut(i, false);
            if (finer[std::size_t(i)].section) finer[std::size_t(i)].section->index = i;
          });
          if (!done) return tl::unexpected(done.error());
          if (context.stopped()) return stoppedError();
          outcomes = std::move(finer);
          const auto looks = looksOf(row, outcomes);
          for (const int stride : kStrides) {
            if (intervals / stride + 1 < StationCount::kLeast) continue;
            count.stations = intervals / stride + 1;
            const std::optional<Off> off = between(looks, stride, context);
            if (!off) continue;
            count.between = off->across;
            if (off->across <= across && off->beyond <= beyond) return count;
          }
        }
        return count;
      });
}

}  // namespace bw::geometry
