// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>

#include "bw/core/base/frame.h"
#include "bw/core/sweep/sweep.h"

namespace bw::sweep {

/// A radius is told in three digits, which may be the larger ones.
inline constexpr double kRadiusReserve = 0.99;

/// A blade that bends to `radius` mm.
[[nodiscard]] BendingBlade bladeThatBendsTo(double radius);

/// A flat preset that bends to all blades of the row.
[[nodiscard]] FlatBlade flatBladeFor(const Sweep& sweep);

/// Stations at half the spacing, where so many are possible; or, where a section between these may be longer
/// than the blade, first a blade for that, which keeps `clearance` mm.
[[nodiscard]] Remedies twiceAsMany(const Sweep& sweep, double clearance);

/// Whether a heavy blade goes over from taut to slack, or back, between a station and the next, or between
/// those beside them: it swings by that as the root of its slack, however close the stations are.
[[nodiscard]] bool slackensNear(const Sweep& sweep, std::size_t station);

/// The blade length to order for a longest cut of `longest` mm with grips `clearance` mm beyond it: whole mm,
/// with a reserve, because another length bends the blade a little otherwise; empty above Blade::kLongest.
[[nodiscard]] std::optional<double> lengthFor(double longest, double clearance);

/// A blade shorter than the sweep's, whole mm, with which `holds` is true of the blade at all stations from
/// `first` to `last`: about the longest to which their curves may be continued, tried out by new fits of some
/// of them. Empty where none is found, or where a cut of the sweep would be too long for it.
[[nodiscard]] std::optional<double> shorterBlade(const Sweep& sweep, std::size_t first, std::size_t last,
                                                 const std::function<bool(const Elastica&)>& holds);

/// What a longer blade would do for grips that lie in or near the block.
struct GripReach {
  std::optional<double> length = std::nullopt;  ///< mm, whole; empty if no length up to Blade::kLongest does
  bool holds = false;  ///< at that length, no blade bends below its radius, snaps or leaves its plane
};

/// The shortest blade, to a hundredth of its length, with which both grips of all stations keep `clearance`
/// mm to the block if their curves are continued as they are. `worst` is the station whose grip is deepest.
/// Cost: some ten evaluations a station, and one of its stability.
[[nodiscard]] GripReach lengthThatClears(const Sweep& sweep, const BladePose& worst, double clearance);

}  // namespace bw::sweep
