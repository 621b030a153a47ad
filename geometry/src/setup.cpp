// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/number_text.h"
#include "bw/geometry/sections.h"
#include "model_impl.h"
#include "occt.h"

namespace bw::geometry {

namespace {

constexpr double kMargin = 5.0;           // mm of foam below and above the target
constexpr double kNearlyAsSmall = 1.5;   // an axis-parallel block up to this much larger is taken for its simplicity
constexpr double kDirectedNormal = 0.2;   // mean normal shorter than this: the target bends round, no side is "outer"

using Points = std::vector<Eigen::Vector3d>;

Points samplePoints(const Target::Impl& target) {
  Points points;
  for (const auto& face : target.faces) {
    const int nu = int(face->gridU().size()), nv = int(face->gridV().size());
    const int stepU = std::max(1, nu / 64), stepV = std::max(1, nv / 64);
    for (int i = 0; i < nu; i += stepU) {
      for (int j = 0; j < nv; j += stepV) {
        if (face->gridInside(i, j)) points.push_back(face->gridPoint(i, j));
      }
    }
    for (const TrimEdge& trim : face->trims()) {
      if (trim.edge < 0) continue;
      const auto& samples = target.model->edges[trim.edge].points;
      points.insert(points.end(), samples.begin(), samples.end());
    }
  }
  return points;
}

/// Convex hull in the plane, counter-clockwise.
std::vector<Eigen::Vector2d> hullOf(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(),
            [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  std::vector<Eigen::Vector2d> hull(2 * points.size());
  const auto turn = [](const Eigen::Vector2d& o, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
  };
  std::size_t k = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    while (k >= 2 && turn(hull[k - 2], hull[k - 1], points[i]) <= 0) --k;
    hull[k++] = points[i];
  }
  const std::size_t lower = k + 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) {
    while (k >= lower && turn(hull[k - 2], hull[k - 1], points[i]) <= 0) --k;
    hull[k++] = points[i];
  }
  hull.resize(k > 1 ? k - 1 : k);
  return hull;
}

/// The direction in the plane of x and y along which the smallest rectangle around the points lies.
Eigen::Vector2d smallestRectangle(const std::vector<Eigen::Vector2d>& hull) {
  Eigen::Vector2d best = Eigen::Vector2d::UnitX();
  double smallest = 1e300;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d side = hull[(i + 1) % hull.size()] - hull[i];
    if (!(side.norm() > 1e-9)) continue;
    const Eigen::Vector2d d = side.normalized(), n(-d.y(), d.x());
    double a0 = 1e300, a1 = -1e300, b0 = 1e300, b1 = -1e300;
    for (const Eigen::Vector2d& p : hull) {
      a0 = std::min(a0, p.dot(d));
      a1 = std::max(a1, p.dot(d));
      b0 = std::min(b0, p.dot(n));
      b1 = std::max(b1, p.dot(n));
    }
    const double area = (a1 - a0) * (b1 - b0);
    if (area < smallest * (1 - 1e-9)) {
      smallest = area;
      best = d;
    }
  }
  return best;
}

/// The side with a positive component along world z, else y, else x.
Eigen::Vector3d upward(const Eigen::Vector3d& d) {
  for (const int axis : {2, 1, 0}) {
    if (std::abs(d[axis]) > 1e-6) return d[axis] < 0 ? Eigen::Vector3d(-d) : d;
  }
  return d;
}

/// The box around the target along the given axes, with the margin along z.
Box boxAround(const Target::Impl& target, const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Eigen::Vector3d& z) {
  const auto ex = target.extent(x), ey = target.extent(y), ez = target.extent(z);
  Box box;
  box.frame.x = x;
  box.frame.y = y;
  box.frame.normal = z;
  box.frame.origin = ex[0] * x + ey[0] * y + (ez[0] - kMargin) * z;
  // A plane sheet that stands on edge would give a block without width.
  box.size = {std::max(ex[1] - ex[0], 1e-3), std::max(ey[1] - ey[0], 1e-3), ez[1] - ez[0] + 2 * kMargin};
  return box;
}

Box autoBlock(const Target::Impl& target) {
  const Points points = samplePoints(target);
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const auto& p : points) center += p;
  center /= double(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto& p : points) spread += (p - center) * (p - center).transpose();

  // The side that the target is looked at from.
  Eigen::Vector3d look = target.meanNormal;
  if (look.norm() < kDirectedNormal) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
    look = upward(solver.eigenvectors().col(0));
  }
  look.normalize();

  // Axis-parallel: z is the world axis nearest to that side.
  int axis = 0;
  look.cwiseAbs().maxCoeff(&axis);
  const Eigen::Vector3d z = (look[axis] < 0 ? -1.0 : 1.0) * Eigen::Vector3d::Unit(axis);
  Eigen::Vector3d x = axis == 0 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  Eigen::Vector3d y = z.cross(x);
  if (y.sum() < 0) {  // keep y along a positive axis
    x = -x;
    y = -y;
  }
  const Box parallel = boxAround(target, x, y, z);

  // Oriented: z is that side itself, x and y along the smallest rectangle around the shadow.
  const Eigen::Vector3d hint = std::abs(look.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d ox = (hint - hint.dot(look) * look).normalized(), oy = look.cross(ox);
  std::vector<Eigen::Vector2d> shadow;
  for (const auto& p : points) shadow.emplace_back((p - center).dot(ox), (p - center).dot(oy));
  const Eigen::Vector2d d = smallestRectangle(hullOf(std::move(shadow)));
  Eigen::Vector3d u = d.x() * ox + d.y() * oy, v = look.cross(u);
  // The quarter turn nearest to the world's x.
  for (int k = 0; k < 3 && !(u.x() >= std::abs(v.x()) - 1e-9); ++k) {
    const Eigen::Vector3d t = u;
    u = v;
    v = -t;
  }
  const Box oriented = boxAround(target, u, v, look);
  return parallel.size.prod() <= kNearlyAsSmall * oriented.size.prod() ? parallel : oriented;
}

}  // namespace

Result<Setup> resolveSetup(const Target& target, const Job& job, Issues& issues) {
  if (job.direction && !(std::isfinite(job.direction->norm()) && job.direction->norm() > 1e-9)) {
    return fail(ErrorCode::badInput,
                "the cutting direction is zero or not a number; give \"x\", \"y\", \"z\" or a vector such as [0, 1, 0]",
                "direction", job.direction->norm());
  }
  if (job.block) {
    const BlockPlacement& b = *job.block;
    if (!b.origin.allFinite() || !b.rotation.allFinite() || !b.size.allFinite() || !(b.size.minCoeff() > 0)) {
      return fail(ErrorCode::badInput,
                  "the block must have a finite place and rotation and a size above 0 mm in all three directions", "block",
                  b.size.minCoeff(), 0.0);
    }
  }
  return guarded(ErrorCode::internal, "the block cannot be placed", [&]() -> Result<Setup> {
    Setup setup;
    if (job.block) {
      setup.block = job.block->box();
      // Bounds that lie apart from the block's: nothing can be cut.
      Bounds local;
      for (const Eigen::Vector3d& p : samplePoints(target.impl())) local.add(setup.block.frame.toLocal(p));
      const Eigen::Array3d before = -local.max.array(), beyond = local.min.array() - setup.block.size.array();
      const double gap = std::max(before.maxCoeff(), beyond.maxCoeff());
      if (gap > 0.01 * local.size().norm()) {
        return fail(ErrorCode::badInput,
                    "the block misses the target by " + shortText(gap) +
                        " mm or more; move it, or choose \"auto\" for a block around the target",
                    "block", gap, 0.0);
      }
    } else {
      setup.block = autoBlock(target.impl());
    }
    if (job.direction) {
      setup.direction = job.direction->normalized();
    } else {
      const bool alongX = setup.block.size.x() > setup.block.size.y() * (1 + 1e-6);
      setup.direction = alongX ? setup.block.frame.x : setup.block.frame.y;
    }
    const double flat = std::abs(setup.direction.dot(setup.block.frame.normal));
    if (flat > 0.7) {
      issues.push_back({Severity::info, "direction",
                        "the blade travels across the surface rather than along it; a direction in the plane of the block is usual",
                        {}});
    }
    return setup;
  });
}

}  // namespace bw::geometry
