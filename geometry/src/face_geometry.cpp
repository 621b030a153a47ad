// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "face_geometry.h"

#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Precision.hxx>
#include <Standard_DomainError.hxx>

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>

#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr int kGridTarget = 24;      // intervals a direction that show the shape of a face
constexpr int kGridLimit = 1500;     // intervals a direction at most
constexpr double kAreaError = 1e-5;  // of the area of a trimmed face
constexpr double kExtremum = 1e-10;  // of the range: a shorter step has come to the extremum
constexpr double kPole = 1e-9;       // of the usual length of a derivative: a shorter one is rounding

/// The range of a face's parameters, within that of its surface. Throws Standard_DomainError if there is
/// none.
ParameterRange rangeOf(const TopoDS_Face& face, const SurfacePatch& patch) {
  ParameterRange range;
  BRepTools::UVBounds(face, range.u0, range.u1, range.v0, range.v1);
  const auto finite = [](double x) { return std::isfinite(x) && !Precision::IsInfinite(x); };
  if (!finite(range.u0) || !finite(range.u1) || !finite(range.v0) || !finite(range.v1) ||
      !(range.u1 > range.u0) || !(range.v1 > range.v0)) {
    throw Standard_DomainError("a face has no bounds");
  }
  if (patch.isSpline()) {
    range.u0 = std::max(range.u0, patch.breaksU().front());
    range.u1 = std::min(range.u1, patch.breaksU().back());
    range.v0 = std::max(range.v0, patch.breaksV().front());
    range.v1 = std::min(range.v1, patch.breaksV().back());
    if (!(range.u1 > range.u0) || !(range.v1 > range.v0))
      throw Standard_DomainError("a face lies outside its surface");
  }
  return range;
}

/// The extreme value of f over [a, b].
template <class Function>
double extremum(const Function& f, double a, double b, bool maximum) {
  const auto g = [&](double t) { return maximum ? -f(t) : f(t); };
  const double least =
      boost::math::tools::brent_find_minima(g, a, b, std::numeric_limits<double>::digits / 2).second;
  return maximum ? -least : least;
}

}  // namespace

FaceGeometry::FaceGeometry(const TopoDS_Face& face, int index)
    : index_(index),
      face_(face),
      patch_(BRep_Tool::Surface(face)),
      reversed_(face.Orientation() == TopAbs_REVERSED),
      range_(rangeOf(face, patch_)),
      borders_(face, patch_, range_) {
  makeGrid();
  measureArea();
}

Eigen::Vector2d FaceGeometry::wrapped(Eigen::Vector2d uv) const {
  const auto wrap = [](double t, double t0, double t1, double period) {
    if (period <= 0) return t;
    const double middle = 0.5 * (t0 + t1);
    return t - period * std::round((t - middle) / period);
  };
  uv.x() = wrap(uv.x(), range_.u0, range_.u1,
                wrapsU() && patch_.periodU() <= 0 ? range_.width() : patch_.periodU());
  uv.y() = wrap(uv.y(), range_.v0, range_.v1,
                wrapsV() && patch_.periodV() <= 0 ? range_.height() : patch_.periodV());
  return uv;
}

void FaceGeometry::makeGrid() {
  const auto line = [](double t0, double t1, const std::vector<double>& breaks, bool straight) {
    std::vector<double> ts = {t0};
    if (breaks.empty()) {
      const int n = straight ? 8 : 2 * kGridTarget;
      for (int i = 1; i <= n; ++i) ts.push_back(i == n ? t1 : t0 + (t1 - t0) * i / n);
      return ts;
    }
    std::vector<double> inner;
    for (const double b : breaks) {
      if (b > t0 + kSameSize * (t1 - t0) && b < t1 - kSameSize * (t1 - t0)) inner.push_back(b);
    }
    inner.push_back(t1);
    const int spans = int(inner.size());
    const int parts = spans >= 4 * kGridTarget ? 1 : std::max(2, (kGridTarget + spans - 1) / spans);
    const int skip = std::max(1, spans / kGridLimit);
    double from = t0;
    for (int i = 0; i < spans; ++i) {
      if ((i + 1) % skip != 0 && i + 1 != spans) continue;
      for (int k = 1; k <= parts; ++k)
        ts.push_back(k == parts ? inner[i] : from + (inner[i] - from) * k / parts);
      from = inner[i];
    }
    return ts;
  };
  const bool plane = patch_.type() == "plane";
  const bool ruled =
      plane || patch_.type() == "cylinder" || patch_.type() == "cone" || patch_.type() == "extrusion";
  gridU_ = line(range_.u0, range_.u1, patch_.breaksU(), plane);
  gridV_ = line(range_.v0, range_.v1, patch_.breaksV(), ruled);
  const int nu = int(gridU_.size()), nv = int(gridV_.size());
  grid_.resize(std::size_t(nu) * nv);
  inside_.assign(grid_.size(), 1);
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      grid_[std::size_t(i) * nv + j] = patch_.value(gridU_[i], gridV_[j]);
      if (!natural()) inside_[std::size_t(i) * nv + j] = contains({gridU_[i], gridV_[j]});
    }
  }
}

void FaceGeometry::measureArea() {
  if (!natural()) {
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(face_, properties, kAreaError);
    area_ = std::abs(properties.Mass());
    return;
  }
  const int nu = int(gridU_.size()) - 1, nv = int(gridV_.size()) - 1;
  // Two Gauss points a direction and cell; one where the grid is fine by itself.
  const bool fine = nu * nv > 20000;
  const double offset = fine ? 0.0 : 0.5 / std::sqrt(3.0);
  Jet jet;
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      const double hu = gridU_[i + 1] - gridU_[i], hv = gridV_[j + 1] - gridV_[j];
      const double u = gridU_[i] + 0.5 * hu, v = gridV_[j] + 0.5 * hv;
      double sum = 0;
      for (int k = 0; k < (fine ? 1 : 4); ++k) {
        patch_.first(u + (k % 2 ? offset : -offset) * hu, v + (k / 2 ? offset : -offset) * hv, jet);
        sum += jet.du.cross(jet.dv).norm();
      }
      area_ += sum * hu * hv / (fine ? 1 : 4);
    }
  }
}

Eigen::Vector3d FaceGeometry::normal(double u, double v) const {
  Jet jet;
  patch_.first(u, v, jet);
  return normal(jet);
}

Eigen::Vector3d FaceGeometry::normal(const Jet& jet) const {
  return (reversed_ ? -1.0 : 1.0) * normalOf(jet);
}

bool FaceGeometry::pole(const Jet& jet) const {
  return !(jet.du.norm() > kPole * scale().x() && jet.dv.norm() > kPole * scale().y());
}

std::array<double, 2> FaceGeometry::extent(const Eigen::Vector3d& direction,
                                           const std::vector<EdgeGeometry>& edges) const {
  double low = 1e300, high = -1e300;
  const auto take = [&](double g) {
    low = std::min(low, g);
    high = std::max(high, g);
  };
  // Borders: samples, and the extrema between them.
  for (const TrimEdge& trim : trims()) {
    const EdgeGeometry& e = edges[trim.edge];
    const auto g = [&](double t) { return direction.dot(e.value(t)); };
    for (std::size_t i = 0; i < e.points.size(); ++i) {
      const double here = direction.dot(e.points[i]);
      take(here);
      if (i == 0 || i + 1 == e.points.size()) continue;
      const double a = direction.dot(e.points[i - 1]), b = direction.dot(e.points[i + 1]);
      if (here >= a && here >= b && here > high - 0.5 * (2 * here - a - b))
        take(extremum(g, e.t[i - 1], e.t[i + 1], true));
      if (here <= a && here <= b && here < low + 0.5 * (a + b - 2 * here))
        take(extremum(g, e.t[i - 1], e.t[i + 1], false));
    }
  }
  // Inside: Newton's method on the gradient from the extreme nodes of the grid.
  const int nu = int(gridU_.size()), nv = int(gridV_.size());
  for (const double sign : {1.0, -1.0}) {
    double best = -1e300;
    int bi = -1, bj = -1;
    for (int i = 0; i < nu; ++i) {
      for (int j = 0; j < nv; ++j) {
        if (!gridInside(i, j)) continue;
        const double g = sign * direction.dot(gridPoint(i, j));
        if (g > best) {
          best = g;
          bi = i;
          bj = j;
        }
      }
    }
    if (bi < 0) continue;
    take(sign * best);
    if (patch_.type() == "plane") continue;
    double u = gridU_[bi], v = gridV_[bj];
    const double du = gridU_[std::min(bi + 1, nu - 1)] - gridU_[std::max(bi - 1, 0)];
    const double dv = gridV_[std::min(bj + 1, nv - 1)] - gridV_[std::max(bj - 1, 0)];
    for (int k = 0; k < 12; ++k) {
      Jet jet;
      patch_.second(u, v, jet);
      const double gu = direction.dot(jet.du), gv = direction.dot(jet.dv);
      const double guu = direction.dot(jet.duu), guv = direction.dot(jet.duv), gvv = direction.dot(jet.dvv);
      const double det = guu * gvv - guv * guv;
      if (!(det > 0)) break;  // no extremum here: it lies on the border
      const double su = -(gvv * gu - guv * gv) / det, sv = -(guu * gv - guv * gu) / det;
      if (std::abs(su) > du || std::abs(sv) > dv) break;
      u = std::clamp(u + su, range_.u0, range_.u1);
      v = std::clamp(v + sv, range_.v0, range_.v1);
      if (std::abs(su) < kExtremum * range_.width() && std::abs(sv) < kExtremum * range_.height()) break;
    }
    if (contains({u, v})) take(direction.dot(patch_.value(u, v)));
  }
  return {low, high};
}

Bounds FaceGeometry::bounds(const std::vector<EdgeGeometry>& edges) const {
  Bounds result;
  for (int axis = 0; axis < 3; ++axis) {
    const auto range = extent(Eigen::Vector3d::Unit(axis), edges);
    result.min[axis] = range[0];
    result.max[axis] = range[1];
  }
  return result;
}

CurvatureRange FaceGeometry::curvatureRange() const {
  double low = 1e300, high = -1e300, lesser = 0;
  const int nu = int(gridU_.size()), nv = int(gridV_.size());
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      if (!gridInside(i, j)) continue;
      Jet jet;
      patch_.second(gridU_[i], gridV_[j], jet);
      jet.normal = normal(jet);
      const Result<SurfaceCurvature> bend = curvatureOf(jet);
      if (!bend || pole(jet)) continue;
      low = std::min(low, bend->min);
      high = std::max(high, bend->max);
      lesser = std::max(lesser, std::min(std::abs(bend->min), std::abs(bend->max)));
    }
  }
  if (low > high) return {};
  return {low, high, lesser};
}

}  // namespace bw::geometry
