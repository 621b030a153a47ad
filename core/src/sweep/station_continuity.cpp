// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sweep/station_continuity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "bw/core/elastica_stability.h"
#include "bw/core/number_text.h"
#include "bw/core/units.h"
#include "fit/fit_distance.h"

namespace bw::detail {

namespace {

using Eigen::Vector2d;

/// What the ends of a blade may turn from one station to the next without being looked at.
constexpr double kEasySwing = 15 * kDegree;
/// The ends may turn so much more than those of the cut itself, since they lie farther out.
constexpr double kLeverage = 1.5;
/// A section of more than this part of the blade tells well where its ends go.
constexpr double kTellsTheEnds = 0.5;
/// Where the nearest curve breaks the blade or flings its ends, another may lie this much farther from the
/// section.
constexpr double kForWholeness = 2;
/// Steps between the neighbour's shape and the nearest one.
constexpr int kShapeSteps = 20;
/// Places along the cut at which a shape is laid onto the section and measured.
constexpr int kPlaces = 101;
/// A turn that is told, and one that no robot makes within a move: near a half turn its sense is open.
constexpr double kToldSwing = 45 * kDegree;
constexpr double kLargestSwing = 90 * kDegree;

double turn(double from, double to) { return std::abs(std::remainder(to - from, 2 * std::numbers::pi)); }

double swing(const Elastica& from, const Elastica& to) {
  return std::max(turn(from.startAngle(), to.startAngle()),
                  turn(from.at(from.length()).angle, to.at(to.length()).angle));
}

/// A blade told by its middle: curvature and the force against the tangent and the normal there.
struct Middle {
  double curvature = 0;
  Vector2d force = Vector2d::Zero();
};

Middle middleOf(const Elastica& elastica) {
  const Elastica::State state = elastica.at(0.5 * elastica.length());
  return {state.curvature, Eigen::Rotation2Dd(-state.angle) * elastica.force()};
}

Middle between(const Middle& a, const Middle& b, double share) {
  return {a.curvature + share * (b.curvature - a.curvature), a.force + share * (b.force - a.force)};
}

/// `length` of that blade about its middle, somewhere.
Result<Elastica> aboutMiddle(const Middle& middle, double length) {
  const Result<Elastica> half =
      Elastica::make(Vector2d::Zero(), 0, middle.curvature, middle.force, 0.5 * length);
  return half ? half->segment(-0.5 * length, 0.5 * length) : half;
}

/// A section as points at equal arc length.
struct Places {
  std::vector<Vector2d> points;
  Vector2d centre = Vector2d::Zero();

  explicit Places(std::vector<Vector2d> all) : points(std::move(all)) {
    for (const Vector2d& p : points) centre += p / double(points.size());
  }
};

/// Moves `elastica` to where its points lie nearest to those of the section, by least squares.
Elastica laidOnto(const Places& section, const Elastica& elastica) {
  const Places own(elastica.sample(kPlaces));
  double along = 0, across = 0;
  for (std::size_t i = 0; i < own.points.size(); ++i) {
    const Vector2d p = own.points[i] - own.centre, q = section.points[i] - section.centre;
    along += p.dot(q);
    across += p.x() * q.y() - p.y() * q.x();
  }
  const double angle = std::atan2(across, along);
  return elastica.transformed(angle, 1, section.centre - Eigen::Rotation2Dd(angle) * own.centre);
}

/// R4 of thesis (3.2) by the trapezoidal rule.
double residual(const Places& section, const Elastica& elastica) {
  const std::vector<Vector2d> points = elastica.sample(kPlaces);
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double weight = i == 0 || i + 1 == points.size() ? 0.5 : 1;
    sum += weight * (points[i] - section.points[i]).squaredNorm();
  }
  return std::sqrt(sum / (kPlaces - 1)) / elastica.length();
}

std::vector<Vector2d> atEqualLengths(const PlanarCurve& curve) {
  std::vector<Vector2d> points;
  points.reserve(kPlaces);
  for (int i = 0; i < kPlaces; ++i)
    points.push_back(curve.value(curve.parameterAt(curve.length() * i / (kPlaces - 1))));
  return points;
}

}  // namespace

StationFit besideNeighbour(StationFit nearest, const StationFit& neighbour, const PlanarCurve& section,
                           const Job& job) {
  // Ends that are given leave no freedom.
  if (job.fitEndpoints || job.fitTangents || nearest.fit.status == FitStatus::infeasible) return nearest;
  const Result<Elastica> from = extendedBlade(neighbour.fit.elastica, job.blade.length);
  const Result<Elastica> to = extendedBlade(nearest.fit.elastica, job.blade.length);
  if (!from || !to) return nearest;
  const double easy = std::max(kEasySwing, kLeverage * swing(neighbour.fit.elastica, nearest.fit.elastica));
  const double wanted = swing(*from, *to);
  const bool holds = bladeHolds(nearest.fit, job.blade);
  const bool told = section.length() > kTellsTheEnds * job.blade.length;
  if (holds && (told || wanted <= easy)) return nearest;
  const Places places(atEqualLengths(section));
  const double length = nearest.fit.elastica.length();
  const Middle a = middleOf(*from), b = middleOf(*to);
  // The largest step towards the nearest shape that turns the ends easily, or else that which turns them
  // least.
  const auto steadied = [&](double allowed) {
    std::optional<StationFit> best;
    double least = holds ? wanted : std::numeric_limits<double>::infinity();
    for (int k = kShapeSteps - 1; k >= 0 && least > easy; --k) {
      const Result<Elastica> shape = aboutMiddle(between(a, b, double(k) / kShapeSteps), length);
      if (!shape) continue;
      StationFit laid = nearest;
      laid.fit.elastica = laidOnto(places, *shape);
      if (!bladeHolds(laid.fit, job.blade)) continue;
      const double turned = swing(*from, *extendedBlade(laid.fit.elastica, job.blade.length));
      if (turned >= least) continue;
      laid.fit.hausdorff = oneSidedHausdorff(laid.fit.elastica, section);
      if (laid.fit.hausdorff > allowed) continue;
      laid.fit.R4 = residual(places, laid.fit.elastica);
      laid.fit.status = FitStatus::constraintsActive;
      laid.fit.message = "kept near the shape of its neighbour";
      laid.steadied = true;
      best = std::move(laid);
      least = turned;
    }
    return std::pair(std::move(best), least);
  };
  const double allowed = std::max(job.tolerance, nearest.fit.hausdorff);
  auto [best, least] = steadied(allowed);
  if (least > kToldSwing) {
    auto [farther, turned] = steadied(kForWholeness * allowed);
    if (farther && turned < least) best = std::move(farther);
  }
  return best ? std::move(*best) : nearest;
}

void addSwingFindings(const Sweep& sweep, Issues& issues) {
  struct Swing {
    std::size_t station = 0;  ///< the second of the two
    double angle = 0;
  };
  Swing worst;
  int count = 0;
  for (std::size_t i = 1; i < sweep.stations.size(); ++i) {
    const Station &a = sweep.stations[i - 1], &b = sweep.stations[i];
    const auto angle = [](const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
      return std::atan2(u.cross(v).norm(), u.dot(v));
    };
    const double larger =
        std::max(angle(a.leftTangent(), b.leftTangent()), angle(a.rightTangent(), b.rightTangent()));
    if (larger <= kToldSwing) continue;
    ++count;
    if (larger > worst.angle) worst = {i, larger};
  }
  if (count == 0) return;
  const Station &a = sweep.stations[worst.station - 1], &b = sweep.stations[worst.station];
  const std::string pair = "stations " + std::to_string(a.index + 1) + " to " + std::to_string(b.index + 1);
  issues.push_back({worst.angle > kLargestSwing ? Severity::error : Severity::warning, "swing",
                    pair + ": an end of the blade turns by " + fixedText(toDegrees(worst.angle), 0) +
                        "° on " + shortText(b.travel - a.travel) + " mm of travel" +
                        (count > 1 ? " (more than " + fixedText(toDegrees(kToldSwing), 0) + "° at " +
                                         std::to_string(count) + " places)"
                                   : std::string()) +
                        "; take more stations, a shorter blade, or a block in which the sections change less",
                    Place{stationName(b.index), 0, b.index, b.leftPoint()}});
}

}  // namespace bw::detail
