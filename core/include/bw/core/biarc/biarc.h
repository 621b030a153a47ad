// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"

namespace bw {

/// A circular arc or a straight piece, travelled from its start. Lengths in mm, angles in rad.
struct CircularArc {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  double startAngle = 0;  ///< of the tangent, against the x axis
  double turning =
      0;  ///< by which the tangent turns, positive counter-clockwise, |turning| < 2π; 0 = straight
  double length = 0;  ///< > 0

  bool straight() const { return turning == 0; }
  double curvature() const { return turning / length; }
  /// Signed like the turning (positive counter-clockwise); empty for a straight piece.
  std::optional<double> radius() const;
  double endAngle() const { return startAngle + turning; }
  /// The point at arc length s from the start (not clamped).
  Eigen::Vector2d pointAt(double s) const;
  Eigen::Vector2d end() const { return pointAt(length); }
};

/// Two arcs that share their tangent where they meet.
struct Biarc {
  CircularArc first, second;
};

/// The biarc of share λ in (0, 1): θ = 2α − (1 − λ) W. The half, λ = ½, is formula (12) of the report: the
/// smallest jump of curvature. For W = 0 the share divides the chord instead: λ = ½ gives r_A = −r_B.
/// Accurate to rounding through W = 0, circles and straight lines; a piece that turns by less than 1e-12 is
/// straight. The angles of both tangents against the chord are taken in (−π, π]. Fails where the points
/// coincide, where a number is not finite, where both tangents point straight back along the chord, and on a
/// share outside (0, 1).
[[nodiscard]] Result<Biarc> makeBiarc(const Eigen::Vector2d& start, double startAngle,
                                      const Eigen::Vector2d& end, double endAngle, double share = 0.5);

/// The report's tangent angles at a chain of points: along the line from the point before to the point after;
/// at the ends of an open chain along the only edge. Where the chain turns back (by more than 150°) the
/// bisector of both edges is taken, for an exact reversal the normal to the left. Fails on fewer than 2
/// points (3 if closed), coincident neighbours, numbers that are not finite.
[[nodiscard]] Result<std::vector<double>> biarcTangents(const std::vector<Eigen::Vector2d>& points,
                                                        bool closed = false);

/// How the points between the biarcs are first chosen.
enum class BiarcSelect {
  automatic,    ///< the best of spacing, index, curvature and tube
  spacing,      ///< at equal intervals along the chain of data points
  index,        ///< data points: the given ones, or at equal steps of the index
  coordinates,  ///< the given points
  curvature,    ///< half by length, half by turning of the chain: denser where it bends
  tube,         ///< data points that are left when those within ε of the rest are dropped
};

/// What is made small.
enum class BiarcGoal { nothing, distance, curvature, combined };
/// The distance of the data points to the curve: mean of d_i, root of the mean of d_i², largest d_i.
enum class BiarcDistance { mean, rms, max };
/// energy: Σ|θ_i/r_i| = ∫κ² ds, "strain energy" in the report; angle: sqrt(Σ|θ_i|/r_i²) = sqrt(∫|κ|³ ds).
enum class BiarcCurvature { energy, angle };

struct BiarcOptions {
  BiarcSelect select = BiarcSelect::automatic;
  int points = 0;  ///< number K of chosen points (K − 1 biarcs, K if closed); 0: by `indices`, `coordinates`,
                   ///< `tube` or `tolerance`
  std::vector<int> indices = {};                  ///< for `index`, from 0, in the order of the curve
  std::vector<Eigen::Vector2d> coordinates = {};  ///< for `coordinates`, in the order of the curve
  double tube = 0;                                ///< ε of `tube`, mm; used where `points` is 0
  std::optional<std::vector<double>> tangents =
      std::nullopt;  ///< angles at the chosen points instead of `biarcTangents`
  bool closed = false;

  BiarcGoal goal = BiarcGoal::distance;
  BiarcDistance distance = BiarcDistance::rms;
  BiarcCurvature curvature = BiarcCurvature::energy;
  double weight = 0;         ///< w of (1 − w)·distance + w·curvature, for `combined`, in [0, 1]
  bool movePoints = true;    ///< the chosen points may move (never for the goal `curvature`)
  bool turnTangents = true;  ///< the tangents may turn
  bool moveJoints = false;   ///< the share of the two arcs of each biarc may change from ½
  bool keepEnds = false;     ///< the first and last point of an open curve stay where they are
  int maxIterations = 200;   ///< for each stage of the minimisation

  /// Largest distance, mm. With `points` (or given indices, coordinates, tube) it is checked; without, the
  /// fewest arcs that keep it are looked for.
  std::optional<double> tolerance = std::nullopt;
  int maxArcs = 20000;  ///< for that search
};

/// All measures of a curve of arcs against its data, always all of them.
struct BiarcMeasures {
  double mean = 0, rms = 0, max = 0;  ///< of the smallest distances of the data points to the curve, mm
  int farthest = 0;                   ///< index of the data point with the largest distance
  double energy = 0;                  ///< Σ|θ_i/r_i|, 1/mm
  double angle = 0;                   ///< sqrt(Σ|θ_i|/r_i²), 1/mm
  double length = 0;                  ///< of the curve, mm
  double turning = 0;                 ///< Σ|θ_i|, rad
  double away = 0;         ///< largest distance of the curve, sampled, to the chain of the data points, mm
  double largestJump = 0;  ///< of the curvature between neighbouring arcs, 1/mm
};

enum class BiarcStatus {
  constructed,        ///< nothing was to be minimised
  converged,          ///< a local minimum
  boundActive,        ///< settled where a tangent is held from turning farther back against its chord
  iterationLimit,     ///< the best curve so far
  toleranceExceeded,  ///< the stated tolerance is not kept
};
/// "constructed", "converged", "bound-active", "iteration-limit", "tolerance-exceeded".
const char* biarcStatusName(BiarcStatus status);

struct BiarcCurve {
  std::vector<Eigen::Vector2d> points;  ///< between the biarcs, ends included
  std::vector<double> tangents;         ///< angles at these points
  std::vector<double> shares;           ///< one a biarc
  std::vector<CircularArc> arcs;        ///< two a biarc, in order; they meet with equal tangents
  bool closed = false;
};

/// Builds the curve through points with given tangents. `shares` empty = ½ everywhere. Fails as `makeBiarc`,
/// naming the biarc.
[[nodiscard]] Result<BiarcCurve> biarcCurve(std::vector<Eigen::Vector2d> points, std::vector<double> tangents,
                                            std::vector<double> shares = {}, bool closed = false);

/// The measures of any curve against any data. O(N log A). Fails on empty or non-finite data.
[[nodiscard]] Result<BiarcMeasures> measureBiarcs(const BiarcCurve& curve,
                                                  const std::vector<Eigen::Vector2d>& data);

struct BiarcResult {
  BiarcCurve curve;
  BiarcMeasures measures;
  BiarcMeasures initial;  ///< of the first guess, before minimisation
  double objective = 0;   ///< the measure that was minimised, or 0
  int iterations = 0;
  BiarcStatus status = BiarcStatus::constructed;
  std::string message;
  double seconds = 0;
};

/// Chooses points, builds the curve, minimises. Single-threaded and deterministic. Fails on bad options or
/// data with a sentence that names the data point; a tolerance that is not kept is a status. About 1 ms for
/// 50 points and 3 biarcs.
[[nodiscard]] Result<BiarcResult> fitBiarcs(const std::vector<Eigen::Vector2d>& data,
                                            const BiarcOptions& options = {}, const RunContext& context = {});

/// A picture of the curve, its data, its points and joints as SVG text: first arcs and second arcs in
/// different colours. Numbers with 6 significant digits; the y axis points up.
std::string biarcSvg(const BiarcCurve& curve, const std::vector<Eigen::Vector2d>& data);

}  // namespace bw
