// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/LU>

#include <functional>
#include <memory>
#include <optional>

#include "heavy/heavy_equations.h"

namespace bw::heavy {

/// Grips and load on their way: `from` at 0, `to` at 1, evenly.
struct Way {
  Hold from, to;

  Hold at(double part) const { return from + part * (to - from); }
};

/// A shape at a part of the way.
struct WayPoint {
  double part = 0;
  Shape shape;
};

/// Follows equilibria along a way by their arc length, over folds, where the part of the way turns back.
class Path {
 public:
  /// From an equilibrium at `start`, which goes to parts above `start.part` first, and ends at `last` > 0.
  Path(const Way& way, const WayPoint& start, double last);

  /// The next equilibrium on the path: at most `longest` away, at 0 or `last` where it would pass them. Empty
  /// if the path cannot be followed any further.
  std::optional<WayPoint> next(double longest);
  const WayPoint& here() const { return here_; }

  /// A point in the coordinates of the path's arc length, and back.
  Eigen::VectorXd scaled(const WayPoint& point) const;
  WayPoint pointOf(const Eigen::VectorXd& v) const;

 private:
  /// Takes a place for the next start: its derivative, bordered with the direction so far, whose solution is
  /// the direction there. False where it has none, or turns too sharply.
  bool stand(const WayPoint& point);
  std::optional<WayPoint> corrected(const Eigen::VectorXd& predicted, bool& quick) const;

  Way way_;
  double last_, angles_;  ///< the part where it ends; rad, the scale of the coefficients
  WayPoint here_;
  Eigen::VectorXd border_, tangent_;  ///< in (coefficients / angles_, force / kForceScale, part), of length 1
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
  double step_;
};

/// Where the way of a blade at rest ends, if it does.
struct Followed {
  WayPoint end;                                      ///< at part 1, or the last stable one
  bool snapped = false;                              ///< the blade is stable up to there and not beyond
  std::shared_ptr<const Equations> rests = nullptr;  ///< there, factors found; null where not asked for
};

/// The end of the way of a blade at rest where Newton's steps shrink so fast that all of it lies on one
/// branch, and the blade is stable there, too. Empty elsewhere, which tells nothing. `rests`: the equations
/// that it obeys at the start, or null; of one thread unless their factors are found.
std::optional<Followed> atOnce(const Way& way, const Shape& start,
                               std::shared_ptr<const Equations> rests = nullptr);

/// Follows a stable blade along the way as long as it is stable. A blade that is not stable to begin with
/// snaps at once. Empty if the path is lost or takes too long, which is not silent: nothing is said then.
std::optional<Followed> follow(const Way& way, const Shape& start);

/// All equilibria at part 1 of the way that its path meets, from `start` on: over folds and up to part 2,
/// until the path comes back to part 0 or is lost.
void allAlong(const Way& way, const Shape& start, const std::function<void(const Shape&)>& found);

/// The other equilibrium at the start of the way that hangs together with this one by a fold on it. Empty if
/// its path goes on to part 1, or is lost.
std::optional<Shape> overFold(const Way& way, const Shape& start);

}  // namespace bw::heavy
