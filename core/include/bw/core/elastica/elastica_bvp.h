// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "bw/core/elastica/elastica.h"
#include "bw/core/elastica/elastica_stability.h"

namespace bw {

/// A blade held at both ends: where the grips are, which way they point, and how much blade is between them.
/// An end without an angle is hinged: its place is held, its tangent turns freely in the plane, and the
/// curvature vanishes there. Margins are those of the ends as they are held: over the eigenvalue of the
/// straight blade between such ends.
struct ClampedProblem {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< mm
  Eigen::Vector2d end = Eigen::Vector2d::Zero();    ///< mm
  std::optional<double> startAngle = 0;             ///< tangent angle at the start, rad; empty: hinged
  /// At the end, rad, modulo 2π unless `turning` is given; empty: hinged.
  std::optional<double> endAngle = 0;
  double length = 1;  ///< mm, > 0
  /// The exact total turning from the start tangent to the end tangent, rad; must equal endAngle − startAngle
  /// modulo 2π. Not with a hinge, where it follows.
  std::optional<double> turning = std::nullopt;
};

struct ClampedOptions {
  /// All shapes are sought up to this many inflections, 0 to 12; those at hinges do not count.
  int maxInflections = 4;
  /// All shapes are sought with at most this much total turning, rad, up to 8π.
  double maxTurning = 9.5;
  /// The answer is the blade that this one becomes when its grips move evenly to where they should be.
  std::optional<Elastica> initial = std::nullopt;
  /// Whether `solveClamped` looks for the other stable shapes as well: some ms.
  bool others = false;
  /// GJ/EI for the margin out of the plane.
  double torsionRatio = kRoundTorsionRatio;
};

/// How far the curve moves where the grips are not quite where they should be: the largest singular value of
/// the map from the errors of both grips to the displacement of the curve, root mean square over its length.
/// docs/mathematics.md, 6.
struct ClampedSensitivity {
  double perMm = 0;      ///< mm of the curve a mm of both grips' positions
  double perDegree = 0;  ///< mm of the curve a degree of the angles that are held; 0 if there are none
};

/// One equilibrium of a clamped blade.
struct ClampedSolution {
  Elastica elastica;
  double energy = 0;                ///< ½ ∫ κ² ds, 1/mm
  double turning = 0;               ///< total, rad
  std::vector<double> inflections;  ///< arc lengths, mm; without those at hinges
  /// The blade rests in it: in its plane, its ends held or hinged as they are, every small change of its
  /// shape costs energy, as far as the numbers here can tell (the margin is above their uncertainty).
  bool stable = false;
  /// The blade rests but for sliding along itself into other shapes of the same energy, which nothing holds
  /// it from as far as the numbers here can tell: figures of eight whose grips are in one place, loops
  /// between taut stretches. Never `stable`.
  bool sliding = false;
  /// See `stabilityMargin`; against ends as they are held, over the eigenvalue of the straight blade between
  /// such ends: 4π²/L² held, 20.19/L² with one hinge, π²/L² with two.
  double stabilityMargin = 0;
  /// See `outOfPlaneMargin`: a hinge turns in the plane alone.
  double outOfPlaneMargin = 0;
  ClampedSensitivity sensitivity;
  bool selfIntersects = false;
  /// How far the elastica's end misses the grip, mm: rounding level.
  double endError = 0;
};

/// What else a blade may rest in between the same grips.
struct ClampedOthers {
  int stable = 0;     ///< how many other stable shapes there are
  double energy = 0;  ///< the least of theirs, 1/mm; 0 if there are none
  /// Total, rad, of that one. The blade can snap into it where it is that of the answer, or with a hinge.
  double turning = 0;
};

/// What kind of problem it was.
enum class ClampedKind {
  general,
  straight,  ///< the blade is as long as the grips are apart
  buckling,  ///< what tangents are held lie along the chord: each shape has an equal mirror image in it
};
/// "general", "straight", "buckling".
const char* clampedKindName(ClampedKind kind);

struct ClampedAnswer {
  std::vector<ClampedSolution> solutions;  ///< lowest energy first, never empty
  ClampedKind kind = ClampedKind::general;
  /// With `initial`: at which part [0, 1) of the way the blade snaps, 0 if it does not rest in that shape to
  /// begin with (a grip that is released may have held it); empty if it never does, or cannot be followed. On
  /// the way the bending moment at a hinge goes evenly from what `initial` has there to zero.
  std::optional<double> snapsAt = std::nullopt;
  std::string message = {};  ///< what a user should know besides, or empty
  /// Besides the answer, or besides the lowest stable one of all shapes, within the bounds of the options
  /// (`solveClamped`: only if asked for).
  ClampedOthers others = {};
};

/// The shape in which the blade rests: the stable one of lowest energy, or with `options.initial` the one on
/// the same branch (after a snap: the stable one nearest to `initial`). Errors: badInput for numbers that are
/// not finite or out of range, or for a turning with a hinge; noSolution if the blade is shorter than its
/// grips are apart, or just as long but not straight between them, if both ends are hinged in one place
/// (within 1e-6 of the length), or if no stable shape was found. About 0.1 ms; some ms with one hinge.
Result<ClampedAnswer> solveClamped(const ClampedProblem& problem, const ClampedOptions& options = {});

/// All equilibria, stable or not, within the bounds of the options. Same errors. Some ms.
Result<ClampedAnswer> solveAllClamped(const ClampedProblem& problem, const ClampedOptions& options = {});

/// A blade that stays on its branch while its grips move.
class ClampedBranch {
 public:
  /// Starts from a blade held as it lies. Fails (noSolution) at a fold or if it is pulled so taut that
  /// Newton's method loses it.
  static Result<ClampedBranch> from(const Elastica& blade);

  /// One motion of the grips.
  struct Move {
    bool snapped = false;  ///< the branch ends on the way: a stable blade snaps there
    double reached = 1;    ///< the part of the way that was done, 1 unless it snapped
  };
  /// Moves the grips to where `next` has them, so that their distance over the length, the direction of the
  /// chord against the start tangent and the turning change evenly; the turning by the shorter way unless
  /// `next.turning` is given, or the curvature at a hinge instead, to zero. After a snap the shape is the
  /// last one of the branch. About 10 µs for the small step of a sweep. Errors: those of `solveClamped` for
  /// `next`, and badInput if its start alone is hinged.
  Result<Move> moveTo(const ClampedProblem& next);

  /// The blade where it is now.
  const Elastica& blade() const { return blade_; }
  /// Its shape in the frame of its start with its length as unit: κ0 L, λ·t0 L², λ·n0 L².
  const Eigen::Vector3d& shape() const { return shape_; }
  /// det ∂(x, y, θ)(L)/∂(κ0, λ1, λ2), in that unit: its sign changes where the branch folds.
  double determinant() const { return determinant_; }

 private:
  ClampedBranch() = default;
  Elastica blade_;
  Eigen::Vector3d shape_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d end_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d jacobian_ = Eigen::Matrix3d::Identity();
  double determinant_ = 0;
};

}  // namespace bw
