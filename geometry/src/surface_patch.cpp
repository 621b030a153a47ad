// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "surface_patch.h"

#include <GeomConvert.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>

#include <algorithm>
#include <array>

#include "occt.h"

namespace bw::geometry {

namespace {

constexpr int kTableDegree = 9;  // above this the coefficients lose digits

/// The basis functions that do not vanish at a parameter, with their first and second derivatives.
using Basis = std::array<std::array<double, kTableDegree + 1>, 3>;

int findSpan(const std::vector<double>& knots, int degree, int poles, double t) {
  const auto it = std::upper_bound(knots.begin() + degree + 1, knots.begin() + poles, t);
  return int(it - knots.begin()) - 1;
}

/// The basis functions of `span` as polynomials in τ = (t − middle)/half, by the recurrence of de Boor on
/// their coefficients: coefficient k of function j at [k (degree + 1) + j].
void appendPolynomials(const std::vector<double>& knots, int degree, int span, std::vector<double>& out) {
  const double middle = 0.5 * (knots[span] + knots[span + 1]), half = 0.5 * (knots[span + 1] - knots[span]);
  using Polynomial = std::array<double, kTableDegree + 1>;
  std::array<Polynomial, kTableDegree + 1> n{};
  n[0][0] = 1;
  const auto times = [&](const Polynomial& p, double constant, double slope) {
    Polynomial q{};
    for (int k = 0; k <= degree; ++k) {
      q[k] += constant * p[k];
      if (k < degree) q[k + 1] += slope * p[k];
    }
    return q;
  };
  for (int j = 1; j <= degree; ++j) {
    Polynomial saved{};
    for (int r = 0; r < j; ++r) {
      const double low = knots[span + 1 - (j - r)], high = knots[span + r + 1], gap = high - low;
      const Polynomial up = times(n[r], (high - middle) / gap, -half / gap);
      const Polynomial down = times(n[r], (middle - low) / gap, half / gap);
      for (int k = 0; k <= degree; ++k) n[r][k] = saved[k] + up[k];
      saved = down;
    }
    n[j] = saved;
  }
  for (int k = 0; k <= degree; ++k) {
    for (int j = 0; j <= degree; ++j) out.push_back(n[j][k]);
  }
}

/// The basis functions of `span` at t, from its part of the table of polynomials.
void basisAt(const std::vector<double>& knots, const std::vector<double>& all, int degree, int span, double t,
             Basis& out) {
  const double middle = 0.5 * (knots[span] + knots[span + 1]), half = 0.5 * (knots[span + 1] - knots[span]);
  const double* table = &all[std::size_t(span - degree) * std::size_t(degree + 1) * std::size_t(degree + 1)];
  const int count = degree + 1;
  const double tau = (t - middle) / half;
  for (int j = 0; j < count; ++j) {
    double value = table[degree * count + j], d1 = 0, d2 = 0;
    for (int k = degree - 1; k >= 0; --k) {
      d2 = d2 * tau + d1;
      d1 = d1 * tau + value;
      value = value * tau + table[k * count + j];
    }
    out[0][j] = value;
    out[1][j] = d1 / half;
    out[2][j] = 2 * d2 / (half * half);
  }
}

void findBreaks(const std::vector<double>& knots, int degree, int poles, std::vector<double>& breaks,
                std::vector<double>& creases) {
  for (int i = degree; i <= poles;) {
    int multiplicity = 1;
    while (i + multiplicity < int(knots.size()) && knots[i + multiplicity] == knots[i]) ++multiplicity;
    breaks.push_back(knots[i]);
    if (i > degree && i < poles && multiplicity > degree - 2) creases.push_back(knots[i]);
    i += multiplicity;
  }
  if (breaks.size() < 2) breaks = {knots[degree], knots[poles]};
}

/// One table a knot interval, empty ones included so that the span is the index.
void makeTable(const std::vector<double>& knots, int degree, int poles, std::vector<double>& table) {
  const std::size_t size = std::size_t(degree + 1) * std::size_t(degree + 1);
  for (int span = degree; span < poles; ++span) {
    if (knots[span + 1] > knots[span]) {
      appendPolynomials(knots, degree, span, table);
    } else {
      table.resize(table.size() + size, 0.0);
    }
  }
}

std::string typeName(const Handle(Geom_Surface) & s) {
  if (s->IsKind(STANDARD_TYPE(Geom_Plane))) return "plane";
  if (s->IsKind(STANDARD_TYPE(Geom_CylindricalSurface))) return "cylinder";
  if (s->IsKind(STANDARD_TYPE(Geom_ConicalSurface))) return "cone";
  if (s->IsKind(STANDARD_TYPE(Geom_SphericalSurface))) return "sphere";
  if (s->IsKind(STANDARD_TYPE(Geom_ToroidalSurface))) return "torus";
  if (s->IsKind(STANDARD_TYPE(Geom_BSplineSurface))) return "bspline";
  if (s->IsKind(STANDARD_TYPE(Geom_BezierSurface))) return "bezier";
  if (s->IsKind(STANDARD_TYPE(Geom_SurfaceOfRevolution))) return "revolution";
  if (s->IsKind(STANDARD_TYPE(Geom_SurfaceOfLinearExtrusion))) return "extrusion";
  if (s->IsKind(STANDARD_TYPE(Geom_OffsetSurface))) return "offset";
  return "other";
}

}  // namespace

SurfacePatch::SurfacePatch(const Handle(Geom_Surface) & given) : surface_(given) {
  while (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface_)) {
    surface_ = trimmed->BasisSurface();
  }
  type_ = typeName(surface_);
  if (surface_->IsUPeriodic()) periodU_ = surface_->UPeriod();
  if (surface_->IsVPeriodic()) periodV_ = surface_->VPeriod();

  Handle(Geom_BSplineSurface) spline = Handle(Geom_BSplineSurface)::DownCast(surface_);
  if (spline.IsNull() && surface_->IsKind(STANDARD_TYPE(Geom_BezierSurface))) {
    spline = GeomConvert::SurfaceToBSplineSurface(surface_);
  }
  // A periodic spline keeps OCCT's evaluation: its faces may reach beyond one period.
  if (spline.IsNull() || spline->IsUPeriodic() || spline->IsVPeriodic()) return;

  polesU_ = spline->NbUPoles();
  polesV_ = spline->NbVPoles();
  knotsU_.assign(spline->UKnotSequence().begin(), spline->UKnotSequence().end());
  knotsV_.assign(spline->VKnotSequence().begin(), spline->VKnotSequence().end());
  degreeU_ = spline->UDegree();
  degreeV_ = spline->VDegree();
  rational_ = spline->IsURational() || spline->IsVRational();
  poles_.reserve(std::size_t(polesU_) * polesV_);
  for (int i = 1; i <= polesU_; ++i) {
    for (int j = 1; j <= polesV_; ++j) {
      const double w = rational_ ? spline->Weight(i, j) : 1.0;
      const Eigen::Vector3d p = toEigen(spline->Pole(i, j));
      poles_.emplace_back(w * p.x(), w * p.y(), w * p.z(), w);
    }
  }
  if (std::max(degreeU_, degreeV_) <= kTableDegree) {
    makeTable(knotsU_, degreeU_, polesU_, tableU_);
    makeTable(knotsV_, degreeV_, polesV_, tableV_);
  }
  findBreaks(knotsU_, degreeU_, polesU_, breaksU_, creasesU_);
  findBreaks(knotsV_, degreeV_, polesV_, breaksV_, creasesV_);
}

void SurfacePatch::evaluate(double u, double v, int order, Jet& jet) const {
  if (tableU_.empty()) {
    gp_Pnt p;
    gp_Vec du, dv, duu, dvv, duv;
    if (order == 0) surface_->D0(u, v, p);
    if (order == 1) surface_->D1(u, v, p, du, dv);
    if (order == 2) surface_->D2(u, v, p, du, dv, duu, dvv, duv);
    jet = {toEigen(p), toEigen(du), toEigen(dv), toEigen(duu), toEigen(duv), toEigen(dvv), jet.normal};
    return;
  }
  Basis bu, bv;
  const int spanU = findSpan(knotsU_, degreeU_, polesU_, u);
  const int spanV = findSpan(knotsV_, degreeV_, polesV_, v);
  basisAt(knotsU_, tableU_, degreeU_, spanU, u, bu);
  basisAt(knotsV_, tableV_, degreeV_, spanV, v, bv);
  using V4 = Eigen::Vector4d;
  V4 s = V4::Zero(), su = V4::Zero(), sv = V4::Zero(), suu = V4::Zero(), suv = V4::Zero(), svv = V4::Zero();
  for (int i = 0; i <= degreeU_; ++i) {
    const V4* row = &poles_[std::size_t(spanU - degreeU_ + i) * polesV_ + (spanV - degreeV_)];
    V4 r0 = V4::Zero(), r1 = V4::Zero(), r2 = V4::Zero();
    for (int j = 0; j <= degreeV_; ++j) r0 += bv[0][j] * row[j];
    s += bu[0][i] * r0;
    if (order < 1) continue;
    for (int j = 0; j <= degreeV_; ++j) r1 += bv[1][j] * row[j];
    su += bu[1][i] * r0;
    sv += bu[0][i] * r1;
    if (order < 2) continue;
    for (int j = 0; j <= degreeV_; ++j) r2 += bv[2][j] * row[j];
    suu += bu[2][i] * r0;
    suv += bu[1][i] * r1;
    svv += bu[0][i] * r2;
  }
  if (!rational_) {
    jet.p = s.head<3>();
    if (order < 1) return;
    jet.du = su.head<3>();
    jet.dv = sv.head<3>();
    if (order < 2) return;
    jet.duu = suu.head<3>();
    jet.duv = suv.head<3>();
    jet.dvv = svv.head<3>();
    return;
  }
  const double w = 1.0 / s.w();
  jet.p = s.head<3>() * w;
  if (order < 1) return;
  jet.du = (su.head<3>() - su.w() * jet.p) * w;
  jet.dv = (sv.head<3>() - sv.w() * jet.p) * w;
  if (order < 2) return;
  jet.duu = (suu.head<3>() - 2 * su.w() * jet.du - suu.w() * jet.p) * w;
  jet.dvv = (svv.head<3>() - 2 * sv.w() * jet.dv - svv.w() * jet.p) * w;
  jet.duv = (suv.head<3>() - su.w() * jet.dv - sv.w() * jet.du - suv.w() * jet.p) * w;
}

}  // namespace bw::geometry
