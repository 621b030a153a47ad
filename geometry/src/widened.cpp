// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "widened.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "bw/core/base/line_in_box.h"
#include "occt.h"
#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr double kTolerance = 1e-6;  // mm, of the face's border on its surface
constexpr int kProbes = 9;           // of a border
constexpr double kLeastSpeed =
    0.1;  // of the usual length of a derivative: a border that is slower is a point
constexpr double kLeastWeight = 0.25;  // of a pole's, that one beyond the border keeps

/// The length of the derivative across a border of the face, mm per unit of the parameter: the least and the
/// largest of its places.
std::array<double, 2> speedAcross(const FaceGeometry& face, bool alongU, double at) {
  std::array<double, 2> speed = {1e300, 0};
  for (int k = 0; k < kProbes; ++k) {
    const double part = double(k) / (kProbes - 1);
    Jet jet;
    if (alongU)
      face.patch().first(at, std::lerp(face.v0(), face.v1(), part), jet);
    else
      face.patch().first(std::lerp(face.u0(), face.u1(), part), at, jet);
    const double length = (alongU ? jet.du : jet.dv).norm();
    speed = {std::min(speed[0], length), std::max(speed[1], length)};
  }
  return speed;
}

/// The spline with one more span at the end or the beginning of v, `more` long. There it goes on as it ends,
/// with curvature that falls evenly to none (straight, where its degree is below 3). Null where it cannot.
Handle(Geom_BSplineSurface) goneOn(const Handle(Geom_BSplineSurface) & spline, bool atEnd, double more) {
  const int nu = spline->NbUPoles(), nv = spline->NbVPoles(), p = spline->VDegree(),
            knots = spline->NbVKnots();
  if (spline->VMultiplicity(atEnd ? knots : 1) != p + 1) return {};
  const bool rational = spline->IsURational() || spline->IsVRational();
  const TColStd_Array1OfReal& flat = spline->VKnotSequence();
  const auto knot = [&](int k) {  // from the border
    return atEnd ? flat(flat.Upper()) - flat(flat.Upper() - k) : flat(flat.Lower() + k) - flat(flat.Lower());
  };
  TColgp_Array2OfPnt poles(1, nu, 1, nv + p);
  TColStd_Array2OfReal weights(1, nu, 1, nv + p);
  for (int i = 1; i <= nu; ++i) {
    const auto at = [&](int j) -> Eigen::Vector4d {  // from the border
      const int v = atEnd ? nv - j : 1 + j;
      const double weight = rational ? spline->Weight(i, v) : 1;
      const Eigen::Vector3d point = toEigen(spline->Pole(i, v));
      return {weight * point.x(), weight * point.y(), weight * point.z(), weight};
    };
    // Outward, by the differences of the outermost poles.
    const Eigen::Vector4d border = at(0), slope = p * (at(0) - at(1)) / knot(p + 1);
    Eigen::Vector4d bend = Eigen::Vector4d::Zero();
    if (p >= 3) bend = (p - 1) * (slope - p * (at(1) - at(2)) / knot(p + 2)) / knot(p + 1);
    for (int k = 0; k < nv + p; ++k) {
      // The poles of a + b t + c t² + d t³ in degree p are its blossoms.
      const auto beyond = [&](int n) -> Eigen::Vector4d {
        const double share = double(n) / p;
        Eigen::Vector4d pole = border + share * more * slope;
        if (p < 3) return pole;
        const double two = n * (n - 1.0) / (p * (p - 1.0)), three = two * (n - 2.0) / (p - 2.0);
        return pole + more * more * (two / 2 - three / 6) * bend;
      };
      const Eigen::Vector4d pole = k < p ? beyond(p - k) : at(k - p);
      if (k < p && !(pole.w() > kLeastWeight * border.w())) return {};
      const int v = atEnd ? nv + p - k : 1 + k;
      poles(i, v) = toPoint(Eigen::Vector3d(pole.head<3>() / pole.w()));
      weights(i, v) = pole.w();
    }
  }
  TColStd_Array1OfReal places(1, knots + 1), us(1, spline->NbUKnots());
  TColStd_Array1OfInteger counts(1, knots + 1), countsU(1, spline->NbUKnots());
  for (int k = 1; k <= knots; ++k) {
    places(atEnd ? k : k + 1) = spline->VKnot(k);
    counts(atEnd ? k : k + 1) = spline->VMultiplicity(k);
  }
  const int border = atEnd ? knots : 2, outer = atEnd ? knots + 1 : 1;
  counts(border) = p;
  counts(outer) = p + 1;
  places(outer) = places(border) + (atEnd ? more : -more);
  spline->UKnots(us);
  spline->UMultiplicities(countsU);
  return rational ? new Geom_BSplineSurface(poles, weights, us, places, countsU, counts, spline->UDegree(), p)
                  : new Geom_BSplineSurface(poles, us, places, countsU, counts, spline->UDegree(), p);
}

}  // namespace

std::shared_ptr<const WidenedFace> WidenedFace::of(const Target::Impl& target, double by) {
  if (target.faces.size() != 1 || !(by > 0)) return {};
  const FaceGeometry& face = *target.faces.front();
  const SurfacePatch& patch = face.patch();
  if (!face.natural() || face.wrapsU() || face.wrapsV()) return {};
  const ParameterRange own{face.u0(), face.u1(), face.v0(), face.v1()};
  ParameterRange range = own;
  // By parameters that are `by` mm at the slowest place of the border; a border that is a point stays.
  for (const bool alongU : {true, false})
    for (const bool end : {false, true}) {
      double& at = alongU ? (end ? range.u1 : range.u0) : (end ? range.v1 : range.v0);
      const auto [least, most] = speedAcross(face, alongU, at);
      if (!(least > kLeastSpeed * most)) continue;
      at += (end ? 1 : -1) * by / least;
    }
  const double periodU = patch.periodU(), periodV = patch.periodV();
  if ((periodU > 0 && range.width() >= periodU) || (periodV > 0 && range.height() >= periodV)) return {};
  try {
    Handle(Geom_Surface) surface = patch.surface();
    if (const auto bezier = Handle(Geom_BezierSurface)::DownCast(surface); !bezier.IsNull())
      surface = GeomConvert::SurfaceToBSplineSurface(bezier);
    if (auto spline = Handle(Geom_BSplineSurface)::DownCast(surface); !spline.IsNull()) {
      if (spline->IsUPeriodic() || spline->IsVPeriodic()) return {};
      for (const bool alongU : {true, false}) {
        if (alongU) {
          spline = Handle(Geom_BSplineSurface)::DownCast(spline->Copy());
          spline->ExchangeUV();
        }
        const double low = alongU ? range.u0 : range.v0, high = alongU ? range.u1 : range.v1;
        const double first = spline->VKnot(1), last = spline->VKnot(spline->NbVKnots());
        if (low < first) spline = goneOn(spline, false, first - low);
        if (!spline.IsNull() && high > last) spline = goneOn(spline, true, high - last);
        if (spline.IsNull()) return {};
        if (alongU) spline->ExchangeUV();
      }
      surface = spline;
    } else if (const std::string& type = patch.type(); type != "plane" && type != "cylinder" &&
                                                       type != "cone" && type != "sphere" &&
                                                       type != "torus") {
      return {};
    }
    const TopoDS_Face wider =
        BRepBuilderAPI_MakeFace(surface, range.u0, range.u1, range.v0, range.v1, kTolerance).Face();
    const auto model = modelOf(wider, "the face as it goes on");
    if (!model) return {};
    auto widened = std::make_shared<WidenedFace>();
    widened->target_ = targetOf(*model, {0});
    widened->face_ = own;
    return widened;
  } catch (const Standard_Failure&) {
    return {};
  }
}

bool WidenedFace::reachedFromFace(const LevelNode& node, const Eigen::Vector3d& way) const {
  const ParameterRange& face = face_;
  const Eigen::Vector2d from = node.uv - Eigen::Vector2d(face.u0, face.v0);
  const Eigen::Vector2d size(face.width(), face.height());
  if ((from.array() >= 0).all() && (from.array() <= size.array()).all()) return true;
  Jet jet;
  target_->faces.front()->patch().first(node.uv.x(), node.uv.y(), jet);
  // What of the parameters the way takes, as far as it runs along the surface.
  Eigen::Matrix2d metric;
  metric << jet.du.dot(jet.du), jet.du.dot(jet.dv), jet.du.dot(jet.dv), jet.dv.dot(jet.dv);
  const double det = metric.determinant();
  if (!(det > kSameSize * metric(0, 0) * metric(1, 1))) return false;
  const Eigen::Vector2d along = metric.inverse() * Eigen::Vector2d(jet.du.dot(way), jet.dv.dot(way));
  const auto flat = [](const Eigen::Vector2d& uv) { return Eigen::Vector3d(uv.x(), uv.y(), 0); };
  return lineInBox(flat(size), flat(from - along), flat(from + along), 0).has_value();
}

}  // namespace bw::geometry
