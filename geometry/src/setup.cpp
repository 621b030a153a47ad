// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bw/core/text/number_text.h"
#include "bw/geometry/sections.h"
#include "model_impl.h"
#include "occt.h"
#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr double kThinnest = 1e-3;    // mm of a block's sides
constexpr double kAsLong = 1e-6;      // of a side: one longer by less is as long
constexpr double kMargin = 5.0;       // mm of foam below and above the target
constexpr double kMostBetween = 0.1;  // of the base: more is not added for holes and notches
constexpr double kNearlyAsSmall =
    1.5;  // an axis-parallel block up to this much larger is taken for its simplicity
constexpr double kDirectedNormal =
    0.2;  // mean normal shorter than this: the target bends round, no side is "outer"

constexpr std::size_t kShadowPoints = 2000;  // more tell no more of the shadow
constexpr double kFirstTilt = 0.07;  // rad, first and last steps in the search for the squarest shadow
constexpr double kLastTilt = 3e-4;
constexpr double kMostTilted = 0.9;        // cosine of the largest angle to the mean normal
constexpr double kBetterFilled = 1e-5;     // part of the rectangle by which a direction is better
constexpr double kSameDirection = 0.9962;  // cosine of 5°

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
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
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

/// A plane box seen along `z`: its sides and how much of its rectangle the shadow fills.
struct Shadow {
  Eigen::Vector3d x, y, z;
  double filled = 0;
};

/// The smallest rectangle around the shadow of the points in the direction `z`.
Shadow shadowAlong(const Points& points, const Eigen::Vector3d& z) {
  const Eigen::Vector3d hint = std::abs(z.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d ox = (hint - hint.dot(z) * z).normalized(), oy = z.cross(ox);
  std::vector<Eigen::Vector2d> flat;
  flat.reserve(points.size());
  for (const auto& p : points) flat.emplace_back((p - points.front()).dot(ox), (p - points.front()).dot(oy));
  const std::vector<Eigen::Vector2d> hull = hullOf(std::move(flat));
  const auto rectangleAlong = [&](const Eigen::Vector2d& d) {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& p : hull)
      box.extend(Eigen::Vector2d(p.dot(d), p.dot(Eigen::Vector2d(-d.y(), d.x()))));
    return box.volume();
  };
  // It lies along a side of the hull.
  Eigen::Vector2d d = Eigen::Vector2d::UnitX();
  double smallest = 1e300, area = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d &p = hull[i], &q = hull[(i + 1) % hull.size()];
    area += 0.5 * (p.x() * q.y() - p.y() * q.x());
    if (!((q - p).norm() > kNoLength)) continue;
    const Eigen::Vector2d side = (q - p).normalized();
    const double rectangle = rectangleAlong(side);
    if (rectangle >= smallest * (1 - kSameSize)) continue;
    smallest = rectangle;
    d = side;
  }
  const double rectangle = rectangleAlong(d);
  return {d.x() * ox + d.y() * oy, -d.y() * ox + d.x() * oy, z, rectangle > 0 ? area / rectangle : 0};
}

/// The direction near `look` from which the target looks most like a rectangle. A panel that is one in its
/// own frame, but bulges to one side, has a mean normal that leans, and a block along it would cut slivers
/// off the corners.
Shadow squarest(const Points& points, const Eigen::Vector3d& look) {
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kShadowPoints);
  Points some;
  for (std::size_t i = 0; i < points.size(); i += stride) some.push_back(points[i]);
  Shadow best = shadowAlong(some, look);
  for (double step = kFirstTilt; step > kLastTilt; step *= 0.5) {
    for (bool moved = true; moved;) {
      moved = false;
      for (const auto& [axis, sign] :
           {std::pair(best.x, 1.0), {best.x, -1.0}, {best.y, 1.0}, {best.y, -1.0}}) {
        const Eigen::Vector3d z = Eigen::AngleAxisd(sign * step, axis) * best.z;
        if (z.dot(look) < kMostTilted) continue;
        const Shadow there = shadowAlong(some, z.normalized());
        if (there.filled < best.filled + kBetterFilled) continue;
        best = there;
        moved = true;
        break;
      }
    }
  }
  return best;
}

/// The side with a positive component along world z, else y, else x.
Eigen::Vector3d upward(const Eigen::Vector3d& d) {
  for (const int axis : {2, 1, 0}) {
    if (std::abs(d[axis]) > kParallel) return d[axis] < 0 ? Eigen::Vector3d(-d) : d;
  }
  return d;
}

/// Points of the surfaces under the faces in what the target leaves free between its parts: sections may go
/// on across holes and notches there. Of a face alone those with some of it on both sides of them along a
/// parameter; of what several lie on all.
Points pointsBetween(const Target::Impl& target) {
  Points points;
  for (const auto& face : target.faces) {
    const int nu = int(face->gridU().size()), nv = int(face->gridV().size());
    const auto along = [&](int lines, int nodes, const auto& at) {
      for (int line = 0; line < lines; ++line) {
        int last = -1;
        for (int k = 0; k < nodes; ++k) {
          const auto [i, j] = at(line, k);
          if (!face->gridInside(i, j)) continue;
          for (int between = last + 1; last >= 0 && between < k; ++between) {
            const auto [bi, bj] = at(line, between);
            points.push_back(face->gridPoint(bi, bj));
          }
          last = k;
        }
      }
    };
    if (face->natural()) continue;
    along(nu, nv, [](int line, int k) { return std::pair(line, k); });
    along(nv, nu, [](int line, int k) { return std::pair(k, line); });
  }
  for (const Carrier& carrier : target.carriers)
    for (int i = 0; i < int(carrier.surface->gridU().size()); ++i)
      for (int j = 0; j < int(carrier.surface->gridV().size()); ++j)
        points.push_back(carrier.surface->gridPoint(i, j));
  return points;
}

/// `extent` along z with what lies between the parts of the target, as seen along z.
std::array<double, 2> withBetween(std::array<double, 2> extent, const Points& points, const Points& between,
                                  const Eigen::Vector3d& x, const Eigen::Vector3d& y,
                                  const Eigen::Vector3d& z) {
  std::vector<Eigen::Vector2d> flat;
  if (between.empty()) return extent;
  flat.reserve(points.size());
  for (const auto& p : points) flat.emplace_back(p.dot(x), p.dot(y));
  const std::vector<Eigen::Vector2d> hull = hullOf(std::move(flat));
  const auto within = [&](const Eigen::Vector2d& p) {
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Eigen::Vector2d side = hull[(i + 1) % hull.size()] - hull[i], to = p - hull[i];
      if (side.x() * to.y() - side.y() * to.x() < 0) return false;
    }
    return hull.size() > 2;
  };
  std::array<double, 2> all = extent;
  for (const Eigen::Vector3d& p : between) {
    const double height = p.dot(z);
    if ((height < all[0] || height > all[1]) && within({p.dot(x), p.dot(y)}))
      all = {std::min(all[0], height), std::max(all[1], height)};
  }
  // A surface that rises so steeply in a hole leads nowhere.
  Eigen::AlignedBox2d base;
  for (const Eigen::Vector2d& p : hull) base.extend(p);
  const double most = kMostBetween * base.sizes().minCoeff();
  if (extent[0] - all[0] <= most) extent[0] = all[0];
  if (all[1] - extent[1] <= most) extent[1] = all[1];
  return extent;
}

/// The box around the target along the given axes, with the margin along z. `points` are of the target,
/// `between` what lies between its parts.
Box boxAround(const Target::Impl& target, const Points& points, const Points& between,
              const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Eigen::Vector3d& z) {
  const auto ex = target.extent(x), ey = target.extent(y),
             ez = withBetween(target.extent(z), points, between, x, y, z);
  Box box;
  box.frame.x = x;
  box.frame.y = y;
  box.frame.normal = z;
  box.frame.origin = ex[0] * x + ey[0] * y + (ez[0] - kMargin) * z;
  // A plane sheet that stands on edge would give a block without width.
  box.size = {std::max(ex[1] - ex[0], kThinnest), std::max(ey[1] - ey[0], kThinnest),
              ez[1] - ez[0] + 2 * kMargin};
  return box;
}

/// The axes along which the points spread least, more and most.
Eigen::Matrix3d principalAxes(const Points& points) {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const auto& p : points) center += p / double(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto& p : points) spread += (p - center) * (p - center).transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
}

Box autoBlock(const Target::Impl& target) {
  const Points points = samplePoints(target), between = pointsBetween(target);
  // The side that the target is looked at from.
  Eigen::Vector3d look = target.meanNormal;
  if (look.norm() < kDirectedNormal) look = upward(principalAxes(points).col(0));
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
  const Box parallel = boxAround(target, points, between, x, y, z);

  // Oriented: z is near that side, x and y along the smallest rectangle around the shadow.
  const Shadow shadow = squarest(points, look);
  Eigen::Vector3d u = shadow.x, v = shadow.y;
  // The quarter turn nearest to the world's x.
  for (int k = 0; k < 3 && !(u.x() >= std::abs(v.x()) - 1e-9); ++k) {
    const Eigen::Vector3d t = u;
    u = v;
    v = -t;
  }
  const Box oriented = boxAround(target, points, between, u, v, shadow.z);
  return parallel.size.prod() <= kNearlyAsSmall * oriented.size.prod() ? parallel : oriented;
}

/// The way along the longer side of a block's base; y of a square.
Eigen::Vector3d longerSide(const Box& block) {
  return block.size.x() > block.size.y() * (1 + kAsLong) ? block.frame.x : block.frame.y;
}

/// Of both ways along an axis the one on the positive side of the block's axis nearest to it.
Eigen::Vector3d alongBlock(const Box& block, const Eigen::Vector3d& axis) {
  Eigen::Matrix3d R_WB;
  R_WB << block.frame.x, block.frame.y, block.frame.normal;
  const Eigen::Vector3d local = R_WB.transpose() * axis;
  int largest = 0;
  local.cwiseAbs().maxCoeff(&largest);
  return local[largest] < 0 ? Eigen::Vector3d(-axis) : axis;
}

}  // namespace

std::vector<NamedDirection> directionsToTry(const Target& target, const Box& block) {
  std::vector<NamedDirection> tries;
  const auto add = [&](const char* name, const Eigen::Vector3d& axis) {
    const Eigen::Vector3d direction = alongBlock(block, axis.normalized());
    const bool known = std::any_of(tries.begin(), tries.end(), [&](const NamedDirection& t) {
      return std::abs(t.direction.dot(direction)) > kSameDirection;
    });
    if (!known) tries.push_back({name, direction});
  };
  const Eigen::Vector3d longer = longerSide(block);
  add("longer side of the block", longer);
  add("shorter side of the block", block.frame.normal.cross(longer));
  const Eigen::Matrix3d axes = principalAxes(samplePoints(target.impl()));
  add("longest axis of the surface", axes.col(2));
  add("middle axis of the surface", axes.col(1));
  add("diagonal of the block", block.frame.x + block.frame.y);
  add("other diagonal of the block", block.frame.x - block.frame.y);
  add("x of the file", Eigen::Vector3d::UnitX());
  add("y of the file", Eigen::Vector3d::UnitY());
  add("z of the file", Eigen::Vector3d::UnitZ());
  add("height of the block", block.frame.normal);
  return tries;
}

Result<Setup> resolveSetup(const Target& target, const SetupRequest& request, Findings& findings) {
  if (request.direction &&
      !(std::isfinite(request.direction->norm()) && request.direction->norm() > kNoLength)) {
    return fail(ErrorCode::badInput,
                "the cutting direction is zero or not a number; give a vector such as "
                "0, 1, 0",
                "direction", request.direction->norm());
  }
  if (request.block) {
    const BlockPlacement& b = *request.block;
    if (!b.origin.allFinite() || !b.rotation.allFinite() || !b.size.allFinite() || !(b.size.minCoeff() > 0)) {
      return fail(
          ErrorCode::badInput,
          "the block must have a finite place and rotation and a size above 0 mm in all three directions",
          "block", b.size.minCoeff(), 0.0);
    }
  }
  return guarded(ErrorCode::internal, "the block cannot be placed", [&]() -> Result<Setup> {
    Setup setup;
    if (request.block) {
      setup.block = request.block->box();
      // Bounds that lie apart from the block's: nothing can be cut.
      Bounds local;
      for (const Eigen::Vector3d& p : samplePoints(target.impl())) local.add(setup.block.frame.toLocal(p));
      const Eigen::Array3d before = -local.max.array(), beyond = local.min.array() - setup.block.size.array();
      const double gap = std::max(before.maxCoeff(), beyond.maxCoeff());
      if (gap > 0.01 * local.size().norm()) {
        return fail(ErrorCode::badInput,
                    "the block misses the target by " + shortText(gap) +
                        " mm or more; move it, or let it be placed around the target",
                    "block", gap, 0.0);
      }
    } else {
      setup.block = autoBlock(target.impl());
    }
    setup.block = lying(setup.block, request.pose);
    if (request.turning && !request.direction) {
      Result<PlaneFamily> planes = PlaneFamily::turning(setup.block, *request.turning);
      if (!planes) return tl::unexpected<Error>(planes.error());
      setup.planes = std::move(*planes);
      return setup;
    }
    const Eigen::Vector3d direction =
        request.direction ? request.direction->normalized() : longerSide(setup.block);
    setup.planes = PlaneFamily::across(setup.block, direction);
    if (std::abs(direction.dot(setup.block.frame.normal)) > 0.7)
      findings.push_back({Severity::info, TravelAcross{}, {}, {TurnDirection{}}});
    if (request.turning) {
      const PlaneTurn& turn = request.turning->turn;
      PlanesNotTurned cause{turn.at(turn.to).angle[0], turn.at(turn.to).angle[0]};
      for (const PlaneTurn::Span& span : turn.spans) {
        cause.least = std::min(cause.least, span.angle[0]);
        cause.most = std::max(cause.most, span.angle[0]);
      }
      findings.push_back({Severity::info, cause, {}, {}});
    }
    return setup;
  });
}

}  // namespace bw::geometry
