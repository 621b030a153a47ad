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

/// A turn that is told, and one that no robot makes within a move: near a half turn its sense is open.
constexpr double kToldSwing = 45 * kDegree;
constexpr double kLargestSwing = 90 * kDegree;

}  // namespace

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
