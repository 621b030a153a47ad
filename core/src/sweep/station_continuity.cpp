// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "bw/core/base/units.h"
#include "fit/fit_distance.h"
#include "sweep/remedies.h"
#include "sweep/station_fit.h"
#include "sweep/sweep_findings.h"

namespace bw::sweep {

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
/// A turn that is told, and one that no robot makes within a move: near a half turn its sense is open.
constexpr double kToldSwing = 45 * kDegree;
constexpr double kLargestSwing = 90 * kDegree;

double turn(double from, double to) { return std::abs(std::remainder(to - from, 2 * kPi)); }

double swing(const Elastica& from, const Elastica& to) {
  return std::max(turn(from.startAngle(), to.startAngle()),
                  turn(from.at(from.length()).angle, to.at(to.length()).angle));
}

/// A blade told by its middle: curvature and the force against the tangent and the normal there.
using Middle = Eigen::Vector3d;

Middle middleOf(const Elastica& elastica) {
  const Elastica::State state = elastica.at(0.5 * elastica.length());
  Middle middle;
  middle << state.curvature, Eigen::Rotation2Dd(-state.angle) * elastica.force();
  return middle;
}

/// `length` of that blade about its middle, somewhere.
Result<Elastica> aboutMiddle(const Middle& middle, double length) {
  const Result<Elastica> half =
      Elastica::make(Vector2d::Zero(), 0, middle(0), middle.tail<2>(), 0.5 * length);
  return half ? half->segment(-0.5 * length, 0.5 * length) : half;
}

/// The shapes on the way from the neighbour's to the nearest one, each laid onto the section and judged once.
struct ShapeSteps {
  struct Shape {
    Elastica laid;
    double turned = 0;                              ///< rad, what the blade's ends turn from the neighbour's
    std::optional<double> distance = std::nullopt;  ///< mm, to the section, once it was asked for
  };

  const StationFit& nearest;
  Middle from, to;
  const Elastica& neighbour;
  const Places& places;
  const PlanarCurve& section;
  const FitRequest& request;
  std::array<std::optional<std::optional<Shape>>, kShapeSteps> shapes = {};

  /// The k-th of kShapeSteps shapes, or null where no blade holds it.
  const Shape* at(int k) {
    std::optional<std::optional<Shape>>& shape = shapes[std::size_t(k)];
    if (!shape) shape = make(k);
    return *shape ? &**shape : nullptr;
  }

  /// mm from the section to a shape that `at` gives.
  double distance(int k) {
    Shape& shape = **shapes[std::size_t(k)];
    if (!shape.distance) shape.distance = fit::oneSidedHausdorff(shape.laid, section);
    return *shape.distance;
  }

  StationFit fitOf(const Shape& shape) const {
    StationFit result = nearest;
    result.fit.elastica = shape.laid;
    result.fit.hausdorff = *shape.distance;
    result.fit.R4 = places.residual(shape.laid);
    result.fit.status = FitStatus::constraintsActive;
    result.fit.message = "kept near the shape of its neighbour";
    result.steadied = true;
    return result;
  }

  std::optional<Shape> make(int k) const {
    const Result<Elastica> free =
        aboutMiddle(from + double(k) / kShapeSteps * (to - from), nearest.fit.elastica.length());
    if (!free) return {};
    const Elastica laid = places.laid(*free);
    if (!bladeHolds(laid, request.blade)) return {};
    return Shape{laid, swing(neighbour, *extendedBlade(laid, request.blade.length))};
  }
};

}  // namespace

StationFit besideNeighbour(StationFit nearest, const StationFit& neighbour, const PlanarCurve& section,
                           const FitRequest& request) {
  // Ends that are given leave no freedom.
  if (request.fitEndpoints || request.fitTangents || nearest.fit.status == FitStatus::infeasible)
    return nearest;
  const Result<Elastica> from = extendedBlade(neighbour.fit.elastica, request.blade.length);
  const Result<Elastica> to = extendedBlade(nearest.fit.elastica, request.blade.length);
  if (!from || !to) return nearest;
  const double easy = std::max(kEasySwing, kLeverage * swing(neighbour.fit.elastica, nearest.fit.elastica));
  const double wanted = swing(*from, *to);
  const bool holds = bladeHolds(nearest.fit.elastica, request.blade);
  const bool told = section.length() > kTellsTheEnds * request.blade.length;
  if (holds && (told || wanted <= easy)) return nearest;
  const Places places(section);
  const Middle a = middleOf(*from), b = middleOf(*to);
  ShapeSteps steps{nearest, a, b, *from, places, section, request};
  // The largest step towards the nearest shape that turns the ends easily, or else that which turns them
  // least.
  const auto steadied = [&](double allowed) {
    const ShapeSteps::Shape* best = nullptr;
    double least = holds ? wanted : std::numeric_limits<double>::infinity();
    for (int k = kShapeSteps - 1; k >= 0 && least > easy; --k) {
      const ShapeSteps::Shape* shape = steps.at(k);
      if (!shape || shape->turned >= least || steps.distance(k) > allowed) continue;
      best = shape;
      least = shape->turned;
    }
    return std::pair(best, least);
  };
  const double allowed = std::max(request.tolerance, nearest.fit.hausdorff);
  auto [best, least] = steadied(allowed);
  if (least > kToldSwing) {
    auto [farther, turned] = steadied(kForWholeness * allowed);
    if (farther && turned < least) best = farther;
  }
  return best ? steps.fitOf(*best) : nearest;
}

void addSwingFindings(const Sweep& sweep, Findings& findings) {
  struct Swing {
    std::size_t station = 0;  ///< the second of the two
    double angle = 0;
  };
  Swing worst;
  int count = 0;
  for (std::size_t i = 1; i < sweep.poses.size(); ++i) {
    const BladePose &a = sweep.poses[i - 1], &b = sweep.poses[i];
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
  const BladePose &a = sweep.poses[worst.station - 1], &b = sweep.poses[worst.station];
  const Severity severity = worst.angle > kLargestSwing ? Severity::error : Severity::warning;
  findings.push_back({severity,
                      EndsSwing{worst.angle, b.travel - a.travel, kToldSwing, count},
                      {StationRange{a.index, b.index, b.index, 2}, b.leftPoint()},
                      twiceAsMany(sweep, sweep.request.clearance)});
}

}  // namespace bw::sweep
