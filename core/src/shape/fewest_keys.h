// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/shape/key_blades.h"

namespace bw::detail {

using KeyList = std::vector<std::size_t>;  ///< indices of blades that are keys, ascending

/// What a sweep misses most.
struct Missed {
  double deviation = 0;   ///< mm that count; infinite where there is no such sweep
  std::size_t index = 0;  ///< of the blade that would help; a key where none does
};

/// How far the sweep through some blades is off. It may end once that is more than `bound`.
using MissedBy = std::function<Result<Missed>(const KeyList& keys, double bound)>;

struct FewestKeys {
  KeyList keys;
  Missed worst;
};

/// How much of a distance from a curve counts whose own blade lies `own` (mm) off: beyond the tolerance no
/// sweep comes much nearer than that, and keys at all curves would be a row of them that brings nothing.
double countedShare(double own, double tolerance);

/// Keys of `count` ≥ 2 blades: the first and the last, then where the sweep is farthest off until it is
/// within `tolerance`, and each that it can do without is left out again.
Result<FewestKeys> fewestKeys(std::size_t count, double tolerance, const MissedBy& missedBy,
                              const RunContext& context);

/// The elastica fitted to each of some curves as blades (y is 0), angles next to those of their neighbours.
/// `yOf` tells where a curve lies, for errors.
Result<std::vector<KeyBlade>> fittedBlades(const std::vector<const PlanarCurve*>& curves,
                                           const std::function<double(std::size_t)>& yOf,
                                           const RunContext& context);

/// Numbers of a blade that a person can read, but for its y; what is rounded moves no point by more than
/// 1e-5 mm.
KeyBlade rounded(const KeyBlade& blade);

}  // namespace bw::detail
