// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bw/core/elastica/elastica_bvp.h"
#include "bw/core/elastica/elastica_stability.h"
#include "bw/core/heavy/heavy_blade.h"

namespace bw {

namespace heavy {
class Equations;
}

/// A blade with weight, held at both ends, which lies in the plane of its grips.
struct HeavyProblem {
  ClampedProblem grips;                              ///< both tangents held
  double stiffness = 1;                              ///< EI, N mm², > 0
  Eigen::Vector2d weight = Eigen::Vector2d::Zero();  ///< a length, N/mm, in the plane's coordinates
};
/// What holds a blade of that stiffness (N mm²) as it is, its turning given.
[[nodiscard]] HeavyProblem holdOf(const HeavyBlade& blade, double stiffness);

/// One equilibrium of it.
struct HeavySolution {
  HeavyBlade blade;
  double energy = 0;   ///< of bending and weight, the start's height being zero: N mm
  double turning = 0;  ///< total, rad
  bool stable = false;
  /// Those of the weightless blade (elastica_stability.h), the weight included: the smallest eigenvalue of
  /// the second variation of the energy over 4π²/L².
  double stabilityMargin = 0;
  double outOfPlaneMargin = 0;
  ClampedSensitivity sensitivity = {};
  /// How much energy it takes to bring the blade from here into another stable shape, N mm: that of the
  /// lowest unstable shape between the two, less its own. Empty where the shape is not stable, where none was
  /// found, or where nobody asked.
  std::optional<double> barrier = std::nullopt;
  /// At which share of its weight, in [0, 1), the weightless blade that this one comes from stops to be
  /// stable; empty if it never does.
  std::optional<double> snapsAt = std::nullopt;
  double endError = 0;  ///< how far the end misses its grip, mm
};

struct HeavyAnswer {
  std::vector<HeavySolution> solutions;  ///< lowest energy first, never empty
  ClampedKind kind = ClampedKind::general;
  /// As `ClampedAnswer::snapsAt`: while the grips of the weightless blade move.
  std::optional<double> movingSnapsAt = std::nullopt;
  std::string message = {};
  int otherStable = 0;                     ///< besides the answer, or besides the lowest stable one of all
  std::optional<double> nextEnergy = {};   ///< N mm: of the lowest of those
  std::optional<double> nextTurning = {};  ///< rad: its
};

/// The shape that the weightless blade of `solveClamped` with these options becomes as its weight comes on
/// evenly. Where its branch ends it falls into another stable shape, and the way goes on from there. Where
/// each shape without turning has a mirror image as good (`buckling`), and no `initial` chooses, the one on
/// whose side the weight pulls is taken. With `options.others` also the barrier and what else is stable, some
/// ms more. Errors: those of `solveClamped`; badInput for a stiffness that is not above 0, a weight that is
/// not finite or is more than w L³/EI = 2000, or a hinge; noSolution where a branch cannot be followed, or a
/// blade is so taut that 192 modes do not resolve it. Accurate to 1e-8 of the length.
Result<HeavyAnswer> solveHeavy(const HeavyProblem& problem, const ClampedOptions& options = {});

/// All equilibria that a search finds: on the branches of all weightless ones (`solveAllClamped`) as the
/// weight comes on and up to twice of it, where blades fall from unstable ones and from across, and on the
/// branches of these; not those whose loops are tighter than about a fortieth of the length. Same errors.
/// Some 10 ms.
Result<HeavyAnswer> solveAllHeavy(const HeavyProblem& problem, const ClampedOptions& options = {});

/// How far a blade of this length, held at that distance, may sag by its slack: as high as a flat arch over
/// the whole length is. mm. At kNoSag it lies as it would without weight.
double largestSag(double length, double chord);
inline constexpr double kNoSag = 0.01;
/// mm: a blade that may sag by less has one shape.
inline constexpr double kOneShape = 0.25;

/// Work in which a blade of any shape that is not hopeless is followed: a tenth of a second (`WorkMeter`).
inline constexpr std::int64_t kBranchWork = 1'000'000;

/// A held blade that has taken on its weight.
struct Hanging {
  HeavyBlade blade;
  std::optional<double> snapsAt = std::nullopt;  ///< as that of a solution
};
/// The shape that a blade which lies as `blade` without weight becomes as its weight comes on evenly, its
/// grips held where they are. Where its branch ends, or it did not rest to begin with, it falls into another
/// stable shape; of one that may sag by less than 0.1 mm that lies beside it, and is no snap, and one that
/// may by less than kNoSag stays as it is. `stiffness` in N mm², `weight` in N/mm in the plane's coordinates.
/// Errors: those of `solveHeavy`; noSolution where it takes more work than that. Some 0.3 ms.
Result<Hanging> hang(const Elastica& blade, double stiffness, const Eigen::Vector2d& weight,
                     std::int64_t work = kBranchWork);

/// How safely a blade rests in its shape, and what a load across its plane does to it.
struct HeavyMargins {
  double inPlane = 1, outOfPlane = 1;  ///< as those of a solution
  double sideways = 0;  ///< mm, the farthest that a round blade leaves its plane under the load
};
/// Of a blade at rest. `across`: load over stiffness (1/mm³) along the normal of its plane; the answer is
/// linear in it, and infinite where nothing holds the blade in its plane. Some 0.3 ms.
HeavyMargins marginsOf(const HeavyBlade& blade, double across = 0, double torsionRatio = kRoundTorsionRatio);

/// What else a blade at rest could rest in, between the same grips and with the same turning: what no clamped
/// blade leaves in its plane.
struct HeavyRivals {
  double energy = 0;                              ///< its own, N mm: `HeavyBlade::energy`
  std::optional<HeavyBlade> next = std::nullopt;  ///< the lowest of the other stable shapes
  double nextEnergy = 0;                          ///< N mm: of that one
  std::optional<double> barrier = std::nullopt;   ///< as that of a solution
  std::vector<HeavyBlade> passes = {};            ///< the unstable shapes between it and others, lowest first
};
/// Work in which they are found for any blade that is not hopeless: a fifth of a second (`WorkMeter`).
inline constexpr std::int64_t kRivalsWork = 2'000'000;
/// `stiffness` in N mm². Errors: those of `solveAllHeavy`; noSolution where it takes more work than that.
/// Some 10 ms.
Result<HeavyRivals> rivalsOf(const HeavyBlade& blade, double stiffness, std::int64_t work = kRivalsWork);

/// What a blade could rest in between the same grips, and what is between that and the shape that it rests
/// in.
struct HeavyRests {
  std::vector<HeavyBlade> stable = {};  ///< of any turning, its own shape too; not such as turn by so much
                                        ///< that they have far more energy than that
  std::optional<double> barrier = std::nullopt;  ///< of its own shape, as that of a solution
  std::vector<HeavyBlade> passes = {};           ///< as those of `HeavyRivals`
};
/// `own`: the blade as it rests, if that is known; without it there is no barrier and no pass. Errors: those
/// of `solveAllHeavy`. Some 10 ms.
Result<HeavyRests> restsOf(const HeavyProblem& problem, const HeavyBlade* own);

/// What a blade at rest falls into from its mirror image in the chord, its ends being held as they are: what
/// lies across from an arch, if it could rest there, too. Empty where it falls back. Some 0.3 ms.
std::optional<HeavyBlade> acrossFrom(const HeavyBlade& blade);

/// How much energy an unstable shape, a pass, has more than a blade between the same grips, and how that
/// changes with these.
struct HeavyPassHeight {
  double energy = 0;  ///< N mm
  Eigen::Matrix<double, 1, 6> byGrips =
      Eigen::Matrix<double, 1, 6>::Zero();  ///< columns as those of `HeavyDerivatives`: N, N mm/rad
};
/// `stiffness` in N mm². The change of an energy is what the grips do: their forces and moments.
HeavyPassHeight heightOf(const HeavyBlade& pass, const HeavyBlade& blade, double stiffness);
/// The unstable equilibrium that this one becomes as its grips and weight move evenly to those of `held`, of
/// the same length; its turning is the nearest to that of this one. The way is parted where Newton's steps do
/// not shrink fast enough to know that both ends are on one branch. Empty where that does not help, or the
/// shape comes to rest. Some 0.1 ms for the small step of a sweep.
std::optional<HeavyBlade> passAt(const HeavyBlade& pass, const HeavyProblem& held);

/// A pass, and by how much its energy is above that of the blade that it keeps from another shape.
struct HeavyPass {
  HeavyBlade shape;
  double height = 0;  ///< N mm
};
/// What passes become where a blade is held (`passAt`), as far as they can be followed there.
[[nodiscard]] std::vector<HeavyPass> passesOver(std::span<const HeavyBlade> passes, const HeavyBlade& blade,
                                                double stiffness);

/// A stable blade with weight that stays on its branch while its grips, its weight or both move.
class HeavyBranch {
 public:
  /// From an answer to a problem. Fails (badInput) for a shape that is not stable.
  static Result<HeavyBranch> from(const HeavyProblem& problem, const HeavySolution& solution) {
    return from(solution.blade, problem.stiffness);
  }
  /// From a blade at rest.
  static Result<HeavyBranch> from(const HeavyBlade& blade, double stiffness);

  /// Moves grips and weight evenly to those of `next`, which has the same length and stiffness; the turning
  /// by the shorter way unless it is given. Where the branch ends the blade is left there, which `snapped`
  /// tells. Nothing is skipped: the whole way is followed unless Newton's steps shrink so fast that both ends
  /// of it lie on one branch. About 50 µs for the small step of a sweep. Errors: those of `solveHeavy` for
  /// `next`; noSolution where the branch cannot be followed, or not with that much work (`WorkMeter`).
  Result<ClampedBranch::Move> moveTo(const HeavyProblem& next, std::int64_t work = kBranchWork);

  HeavyBlade blade() const;

 private:
  friend class HeavySlopes;
  explicit HeavyBranch(HeavyBlade::Numbers numbers) : numbers_(std::move(numbers)) {}
  HeavyBlade::Numbers numbers_;
  std::shared_ptr<const heavy::Equations> rests_;  ///< that it stands by; null where these were not asked
  Eigen::Vector2d end_ = Eigen::Vector2d::Zero();
  double stiffness_ = 1;
};

/// How the blade at arc lengths changes with its grips.
struct HeavyDerivatives {
  /// Rows: x, y, θ (mm, mm, rad); columns: the start's x, y (mm) and angle (rad), the end's x, y and angle.
  std::vector<Eigen::Matrix<double, 3, 6>> byGrips;
};
/// At arc lengths in [0, length], by the implicit function theorem. Fails (noSolution) at a fold.
Result<HeavyDerivatives> derivativesByGrips(const HeavyBlade& blade, std::span<const double> s);

/// A margin of a blade at rest (`marginsOf`), and how it changes with the grips.
struct HeavyMarginSlope {
  double margin = 1;
  Eigen::Matrix<double, 1, 6> byGrips =
      Eigen::Matrix<double, 1, 6>::Zero();  ///< columns as above: 1/mm, 1/rad
};
/// That in the plane, as far as it is less than `below`: else that is told, and no change. Not finite at a
/// fold. Some 0.1 ms; where it is not less, a tenth of it.
HeavyMarginSlope marginByGrips(const HeavyBlade& blade,
                               double below = std::numeric_limits<double>::infinity());
/// That of a round blade out of its plane, likewise.
HeavyMarginSlope outOfPlaneByGrips(const HeavyBlade& blade,
                                   double below = std::numeric_limits<double>::infinity(),
                                   double torsionRatio = kRoundTorsionRatio);

/// All of these of one blade, what they share found once.
class HeavySlopes {
 public:
  explicit HeavySlopes(const HeavyBlade& blade);
  /// Of a branch where it stands.
  explicit HeavySlopes(const HeavyBranch& branch);
  HeavySlopes(HeavySlopes&& other) noexcept;
  HeavySlopes& operator=(HeavySlopes&& other) noexcept;
  ~HeavySlopes();

  Result<HeavyDerivatives> at(std::span<const double> s) const;  ///< `derivativesByGrips`
  HeavyMarginSlope margin(double below) const;                   ///< `marginByGrips`
  HeavyMarginSlope outOfPlane(double below,
                              double torsionRatio = kRoundTorsionRatio) const;  ///< `outOfPlaneByGrips`

 private:
  struct Work;
  std::unique_ptr<Work> work_;  ///< null only after a move
};

}  // namespace bw
