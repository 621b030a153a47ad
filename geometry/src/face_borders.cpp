// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "face_borders.h"

#include <BRep_Tool.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_Line.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <algorithm>
#include <array>
#include <cmath>

#include "occt.h"
#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr int kBins = 64;           // slices of v for the inside test
constexpr double kSameLine = 1e-7;  // of a range: parameters so near are one
constexpr double kCovered = 1e-6;   // of a side of the rectangle that borders may leave open or cover twice
constexpr double kLeastScale = 1e-12;  // mm of a unit of u or v, so that it can be divided by
constexpr double kSnap = 1e-6;         // of the face's size: ends of borders so near are one corner
constexpr double kBorderStep = 1e-4;   // of the face's size: so far from a border its sides are looked at
constexpr double kFootStep = 1e-10;    // mm of a step along a border that changes nothing any more
constexpr double kOnBorder = 1e-7;     // mm from a border that count as on it

/// Whether two parameters are one, against the range that they lie in.
bool near(double a, double b, double range) { return std::abs(a - b) <= kSameLine * range; }

}  // namespace

EdgeGeometry::EdgeGeometry(const TopoDS_Edge& shape) : edge(shape), tolerance(BRep_Tool::Tolerance(shape)) {
  if (BRep_Tool::Degenerated(shape)) return;
  curve = BRep_Tool::Curve(shape, first, last);
  if (curve.IsNull()) return;
  if (Precision::IsInfinite(first) || Precision::IsInfinite(last) || !(last > first)) {
    curve.Nullify();
    return;
  }
  const auto at = [this](double s) { return value(s); };
  if (isLine(curve)) {
    sampleCurve<Eigen::Vector3d>(at, first, last, 1, 1.0, t, points);
  } else {
    sampleCurve<Eigen::Vector3d>(at, first, last, 16, 1e300, t, points);
    for (const auto& p : points) bounds.add(p);
    sampleCurve<Eigen::Vector3d>(at, first, last, 16, kChordRatio * bounds.size().norm(), t, points);
  }
  for (const auto& p : points) bounds.add(p);
}

Eigen::Vector3d EdgeGeometry::value(double s) const {
  gp_Pnt p;
  curve->D0(s, p);
  return toEigen(p);
}

void EdgeGeometry::second(double s, Eigen::Vector3d& p, Eigen::Vector3d& d1, Eigen::Vector3d& d2) const {
  gp_Pnt q;
  gp_Vec a, b;
  curve->D2(s, q, a, b);
  p = toEigen(q);
  d1 = toEigen(a);
  d2 = toEigen(b);
}

bool isLine(Handle(Geom2d_Curve) curve) {
  while (const auto trimmed = Handle(Geom2d_TrimmedCurve)::DownCast(curve)) curve = trimmed->BasisCurve();
  return curve->IsKind(STANDARD_TYPE(Geom2d_Line));
}

bool isLine(Handle(Geom_Curve) curve) {
  while (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve)) curve = trimmed->BasisCurve();
  return curve->IsKind(STANDARD_TYPE(Geom_Line));
}

Eigen::Vector2d TrimEdge::value(double t) const {
  gp_Pnt2d p;
  curve->D0(t, p);
  return {p.X(), p.Y()};
}

FaceBorders::FaceBorders(const TopoDS_Face& face, const SurfacePatch& patch, const ParameterRange& range)
    : range_(range) {
  readTrims(face);
  findNatural();
  findWraps(patch);
  findScale(patch);
  if (natural_) return;
  closeLoops();
  fillBins();
  findInnerSides();
}

void FaceBorders::readTrims(const TopoDS_Face& face) {
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const Eigen::Vector2d range(range_.width(), range_.height());
  for (TopExp_Explorer it(forward, TopAbs_EDGE); it.More(); it.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(it.Current());
    if (edge.Orientation() != TopAbs_FORWARD && edge.Orientation() != TopAbs_REVERSED) continue;
    TrimEdge trim;
    trim.curve = BRep_Tool::CurveOnSurface(edge, forward, trim.first, trim.last);
    if (trim.curve.IsNull() || !(trim.last > trim.first)) continue;
    std::vector<double> ts;
    std::vector<Eigen::Vector2d> points;
    const auto relative = [&](double t) -> Eigen::Vector2d { return trim.value(t).cwiseQuotient(range); };
    const bool line = isLine(trim.curve);
    sampleCurve<Eigen::Vector2d>(relative, trim.first, trim.last, line ? 1 : 16, line ? 1.0 : kChordRatio, ts,
                                 points);
    trim.leftInside = edge.Orientation() == TopAbs_FORWARD;
    for (std::size_t i = 1; i < ts.size(); ++i) {
      segments_.push_back({points[i - 1].cwiseProduct(range), points[i].cwiseProduct(range),
                           int(trims_.size()), ts[i - 1], ts[i]});
    }
    trims_.push_back(trim);
    trimShapes_.push_back(edge);
  }
}

void FaceBorders::findNatural() {
  const double ru = range_.width(), rv = range_.height();
  const auto sideOf = [&](const Segment& s) {
    if (near(s.a.x(), range_.u0, ru) && near(s.b.x(), range_.u0, ru)) return 0;
    if (near(s.a.x(), range_.u1, ru) && near(s.b.x(), range_.u1, ru)) return 1;
    if (near(s.a.y(), range_.v0, rv) && near(s.b.y(), range_.v0, rv)) return 2;
    if (near(s.a.y(), range_.v1, rv) && near(s.b.y(), range_.v1, rv)) return 3;
    return -1;
  };
  std::array<double, 4> covered{};
  bool along = !segments_.empty();
  for (const Segment& s : segments_) {
    const int side = sideOf(s);
    along = along && side >= 0;
    trims_[s.trim].side = side;
    if (side >= 0)
      covered[side] += side < 2 ? std::abs(s.b.y() - s.a.y()) / rv : std::abs(s.b.x() - s.a.x()) / ru;
  }
  natural_ = along;
  for (const double c : covered) natural_ = natural_ && std::abs(c - 1) < kCovered;
}

void FaceBorders::findWraps(const SurfacePatch& patch) {
  const double ru = range_.width(), rv = range_.height();
  wrapsU_ = patch.periodU() > 0 && near(ru, patch.periodU(), ru);
  wrapsV_ = patch.periodV() > 0 && near(rv, patch.periodV(), rv);
  // The closed spline whose first and last columns coincide wraps too, though OCCT calls it not periodic.
  if (natural_ && patch.isSpline()) {
    const auto same = [&](bool u) {
      for (int i = 0; i <= 8; ++i) {
        const double t = i / 8.0;
        const Eigen::Vector3d a =
            u ? patch.value(range_.u0, range_.v0 + t * rv) : patch.value(range_.u0 + t * ru, range_.v0);
        const Eigen::Vector3d b =
            u ? patch.value(range_.u1, range_.v0 + t * rv) : patch.value(range_.u0 + t * ru, range_.v1);
        if ((a - b).norm() > kSlack) return false;
      }
      return true;
    };
    wrapsU_ = same(true);
    wrapsV_ = same(false);
  }
}

void FaceBorders::findScale(const SurfacePatch& patch) {
  const double ru = range_.width(), rv = range_.height();
  // Typical length of a unit of u and v, from nine places.
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Jet jet;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      patch.first(range_.u0 + ru * (0.2 + 0.3 * i), range_.v0 + rv * (0.2 + 0.3 * j), jet);
      sum += Eigen::Vector2d(jet.du.norm(), jet.dv.norm());
    }
  }
  scale_ = (sum / 9).cwiseMax(kLeastScale);
  band_ = 3 * kChordRatio * std::max(scale_.x() * ru, scale_.y() * rv);
}

void FaceBorders::closeLoops() {
  // Where one border ends and the next begins, the parameters differ by rounding or by the file's tolerance:
  // a ray through the gap would count wrong.
  std::vector<Eigen::Vector2d> corners;
  const auto snap = [&](Eigen::Vector2d& p, double reach) {
    for (const Eigen::Vector2d& c : corners) {
      if ((c - p).cwiseProduct(scale_).norm() <= reach) {
        p = c;
        return;
      }
    }
    corners.push_back(p);
  };
  const double size = std::max(scale_.x() * range_.width(), scale_.y() * range_.height());
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    const double reach = std::max(kSnap * size, 2 * BRep_Tool::Tolerance(trimShapes_[segments_[k].trim]));
    if (k == 0 || segments_[k - 1].trim != segments_[k].trim) snap(segments_[k].a, reach);
    if (k + 1 == segments_.size() || segments_[k + 1].trim != segments_[k].trim) snap(segments_[k].b, reach);
  }
}

void FaceBorders::fillBins() {
  const double rv = range_.height();
  bins_.assign(kBins, {});
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    const Segment& s = segments_[k];
    const auto bin = [&](double v) { return std::clamp(int((v - range_.v0) / rv * kBins), 0, kBins - 1); };
    const int from = bin(std::min(s.a.y(), s.b.y())), to = bin(std::max(s.a.y(), s.b.y()));
    for (int b = from; b <= to; ++b) bins_[b].push_back(int(k));
  }
}

void FaceBorders::findInnerSides() {
  // Files whose loops run the wrong way exist: look on which side of each border the face lies.
  const double step = kBorderStep * std::min(range_.width() * scale_.x(), range_.height() * scale_.y());
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    if (k > 0 && segments_[k].trim == segments_[k - 1].trim) continue;
    TrimEdge& trim = trims_[segments_[k].trim];
    std::size_t end = k;
    while (end + 1 < segments_.size() && segments_[end + 1].trim == segments_[k].trim) ++end;
    const Segment& middle = segments_[(k + end) / 2];
    const Eigen::Vector2d m = 0.5 * (middle.a + middle.b);
    const Eigen::Vector2d d = (middle.b - middle.a).cwiseProduct(scale_).normalized();
    const Eigen::Vector2d left = Eigen::Vector2d(-d.y(), d.x()).cwiseQuotient(scale_) * step;
    const bool onLeft = evenOdd(m + left), onRight = evenOdd(m - left);
    if (onLeft != onRight) trim.leftInside = onLeft;
  }
}

bool FaceBorders::evenOdd(const Eigen::Vector2d& uv) const {
  if (uv.y() < range_.v0 - kSameSize * range_.height() || uv.y() > range_.v1 + kSameSize * range_.height())
    return false;
  const int bin = std::clamp(int((uv.y() - range_.v0) / range_.height() * kBins), 0, kBins - 1);
  bool inside = false;
  for (const int k : bins_[bin]) {
    const Segment& s = segments_[k];
    if ((s.a.y() > uv.y()) == (s.b.y() > uv.y())) continue;
    const double u = s.a.x() + (s.b.x() - s.a.x()) * (uv.y() - s.a.y()) / (s.b.y() - s.a.y());
    if (u > uv.x()) inside = !inside;
  }
  return inside;
}

bool FaceBorders::contains(const Eigen::Vector2d& uv) const {
  if (natural_) {
    const double eu = kSameSize * range_.width(), ev = kSameSize * range_.height();
    return uv.x() >= range_.u0 - eu && uv.x() <= range_.u1 + eu && uv.y() >= range_.v0 - ev &&
           uv.y() <= range_.v1 + ev;
  }
  // Near a border the polygon is replaced by the border's own curve.
  const Eigen::Vector2d p = uv.cwiseProduct(scale_);
  const double bandV = band_ / scale_.y() / range_.height() * kBins,
               at = (uv.y() - range_.v0) / range_.height() * kBins;
  const int from = std::clamp(int(at - bandV), 0, kBins - 1), to = std::clamp(int(at + bandV), 0, kBins - 1);
  double best = band_, where = 0;
  int nearest = -1;
  for (int b = from; b <= to; ++b) {
    for (const int k : bins_[b]) {
      const Eigen::Vector2d start = segments_[k].a.cwiseProduct(scale_),
                            end = segments_[k].b.cwiseProduct(scale_);
      const double t = nearestOnSegment(p, start, end), d = (start + t * (end - start) - p).norm();
      if (d < best) {
        best = d;
        nearest = k;
        where = t;
      }
    }
  }
  if (nearest < 0) return evenOdd(uv);
  const Segment& s = segments_[nearest];
  const TrimEdge& trim = trims_[s.trim];
  double t = s.ta + where * (s.tb - s.ta);
  gp_Pnt2d q;
  gp_Vec2d d1, d2;
  Eigen::Vector2d delta, tangent;
  for (int i = 0; i < 6; ++i) {
    trim.curve->D2(t, q, d1, d2);
    delta = (Eigen::Vector2d(q.X(), q.Y()) - uv).cwiseProduct(scale_);
    tangent = Eigen::Vector2d(d1.X(), d1.Y()).cwiseProduct(scale_);
    const Eigen::Vector2d bend = Eigen::Vector2d(d2.X(), d2.Y()).cwiseProduct(scale_);
    const double slope = tangent.squaredNorm() + delta.dot(bend);
    const double step =
        -delta.dot(tangent) / (slope > 0 ? slope : std::max(tangent.squaredNorm(), kVanishing));
    const double next = std::clamp(t + step, trim.first, trim.last);
    if (std::abs(next - t) * tangent.norm() < kFootStep) break;
    t = next;
  }
  // At a corner the foot of neither border is perpendicular; the polygon is exact there.
  const bool atEnd = t <= trim.first || t >= trim.last;
  if (atEnd && std::abs(delta.dot(tangent)) > kParallel * delta.norm() * tangent.norm()) return evenOdd(uv);
  const double side = tangent.x() * -delta.y() - tangent.y() * -delta.x();
  if (std::abs(side) <= kOnBorder * tangent.norm()) return true;
  return (side > 0) == trim.leftInside;
}

}  // namespace bw::geometry
