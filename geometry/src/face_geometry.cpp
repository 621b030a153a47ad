// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "face_geometry.h"

#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_Line.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <Standard_DomainError.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <algorithm>
#include <cmath>

#include "occt.h"

namespace bw::geometry {

namespace {

constexpr int kGridTarget = 24;       // intervals a direction that show the shape of a face
constexpr int kGridLimit = 1500;      // intervals a direction at most
constexpr int kBins = 64;             // slices of v for the inside test
constexpr int kChordDepth = 9;        // halvings of a curve's interval at most
constexpr double kChordRatio = 2e-4;  // sagitta of samples, of the size

/// Samples of a curve such that chords keep within `tolerance` of it.
template <class Point, class Value>
void sampleCurve(const Value& value, double first, double last, int intervals, double tolerance,
                 std::vector<double>& ts, std::vector<Point>& points) {
  const auto refine = [&](const auto& self, double ta, const Point& a, double tb, const Point& b, int depth) -> void {
    const double tm = 0.5 * (ta + tb);
    const Point m = value(tm);
    if (depth > 0 && (m - 0.5 * (a + b)).norm() > tolerance) {
      self(self, ta, a, tm, m, depth - 1);
      self(self, tm, m, tb, b, depth - 1);
      return;
    }
    ts.push_back(tb);
    points.push_back(b);
  };
  ts.assign(1, first);
  points.assign(1, value(first));
  for (int i = 0; i < intervals; ++i) {
    const double tb = i + 1 == intervals ? last : first + (last - first) * (i + 1) / intervals;
    const double ta = ts.back();
    const Point a = points.back();
    refine(refine, ta, a, tb, value(tb), kChordDepth);
  }
}

bool isLine(Handle(Geom2d_Curve) curve) {
  while (const auto trimmed = Handle(Geom2d_TrimmedCurve)::DownCast(curve)) curve = trimmed->BasisCurve();
  return curve->IsKind(STANDARD_TYPE(Geom2d_Line));
}

bool isLine(Handle(Geom_Curve) curve) {
  while (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve)) curve = trimmed->BasisCurve();
  return curve->IsKind(STANDARD_TYPE(Geom_Line));
}

double segmentDistance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double& at) {
  const Eigen::Vector2d d = b - a;
  const double length2 = d.squaredNorm();
  at = length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0, 1.0) : 0.0;
  return (a + at * d - p).norm();
}

/// The extreme value of f over [a, b] near the sampled extremum m, by golden-section search.
template <class Function>
double refineExtremum(const Function& f, double a, double b, bool maximum) {
  constexpr double kGolden = 0.6180339887498949;
  const auto g = [&](double t) { return maximum ? -f(t) : f(t); };
  double x1 = b - kGolden * (b - a), x2 = a + kGolden * (b - a);
  double f1 = g(x1), f2 = g(x2);
  for (int i = 0; i < 40; ++i) {
    if (f1 < f2) {
      b = x2;
      x2 = x1;
      f2 = f1;
      x1 = b - kGolden * (b - a);
      f1 = g(x1);
    } else {
      a = x1;
      x1 = x2;
      f1 = f2;
      x2 = a + kGolden * (b - a);
      f2 = g(x2);
    }
  }
  return maximum ? -std::min(f1, f2) : std::min(f1, f2);
}

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

Eigen::Vector2d TrimEdge::value(double t) const {
  gp_Pnt2d p;
  curve->D0(t, p);
  return {p.X(), p.Y()};
}

FaceGeometry::FaceGeometry(const TopoDS_Face& face, int index)
    : index_(index), face_(face), patch_(BRep_Tool::Surface(face)), reversed_(face.Orientation() == TopAbs_REVERSED) {
  BRepTools::UVBounds(face, u0_, u1_, v0_, v1_);
  const auto finite = [](double x) { return std::isfinite(x) && !Precision::IsInfinite(x); };
  if (!finite(u0_) || !finite(u1_) || !finite(v0_) || !finite(v1_) || !(u1_ > u0_) || !(v1_ > v0_)) {
    throw Standard_DomainError("a face has no bounds");
  }
  if (patch_.isSpline()) {
    u0_ = std::max(u0_, patch_.breaksU().front());
    u1_ = std::min(u1_, patch_.breaksU().back());
    v0_ = std::max(v0_, patch_.breaksV().front());
    v1_ = std::min(v1_, patch_.breaksV().back());
    if (!(u1_ > u0_) || !(v1_ > v0_)) throw Standard_DomainError("a face lies outside its surface");
  }
  readTrims();
  findNatural();
  makeGrid();
  measureArea();
}

void FaceGeometry::readTrims() {
  const TopoDS_Face forward = TopoDS::Face(face_.Oriented(TopAbs_FORWARD));
  const Eigen::Vector2d range(u1_ - u0_, v1_ - v0_);
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
    sampleCurve<Eigen::Vector2d>(relative, trim.first, trim.last, line ? 1 : 16, line ? 1.0 : kChordRatio, ts, points);
    trim.leftInside = edge.Orientation() == TopAbs_FORWARD;
    for (std::size_t i = 1; i < ts.size(); ++i) {
      segments_.push_back({points[i - 1].cwiseProduct(range), points[i].cwiseProduct(range), int(trims_.size()),
                           ts[i - 1], ts[i]});
    }
    trims_.push_back(trim);
    trimShapes_.push_back(edge);
  }
}

void FaceGeometry::closeLoops() {
  // Where one border ends and the next begins, the parameters differ by rounding or by the file's tolerance: a ray through the gap
  // would count wrong.
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
  const double size = std::max(scale_.x() * (u1_ - u0_), scale_.y() * (v1_ - v0_));
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    const double reach = std::max(1e-6 * size, 2 * BRep_Tool::Tolerance(trimShapes_[segments_[k].trim]));
    if (k == 0 || segments_[k - 1].trim != segments_[k].trim) snap(segments_[k].a, reach);
    if (k + 1 == segments_.size() || segments_[k + 1].trim != segments_[k].trim) snap(segments_[k].b, reach);
  }
}

void FaceGeometry::findNatural() {
  const double ru = u1_ - u0_, rv = v1_ - v0_;
  const auto near = [](double a, double b, double range) { return std::abs(a - b) <= 1e-7 * range; };
  wrapsU_ = patch_.periodU() > 0 && near(ru, patch_.periodU(), ru);
  wrapsV_ = patch_.periodV() > 0 && near(rv, patch_.periodV(), rv);
  const auto sideOf = [&](const Segment& s) {
    if (near(s.a.x(), u0_, ru) && near(s.b.x(), u0_, ru)) return 0;
    if (near(s.a.x(), u1_, ru) && near(s.b.x(), u1_, ru)) return 1;
    if (near(s.a.y(), v0_, rv) && near(s.b.y(), v0_, rv)) return 2;
    if (near(s.a.y(), v1_, rv) && near(s.b.y(), v1_, rv)) return 3;
    return -1;
  };
  std::array<double, 4> covered{};
  bool along = !segments_.empty();
  for (const Segment& s : segments_) {
    const int side = sideOf(s);
    along = along && side >= 0;
    trims_[s.trim].side = side;
    if (side >= 0) covered[side] += side < 2 ? std::abs(s.b.y() - s.a.y()) / rv : std::abs(s.b.x() - s.a.x()) / ru;
  }
  natural_ = along;
  for (const double c : covered) natural_ = natural_ && std::abs(c - 1) < 1e-6;

  // The closed spline whose first and last columns coincide wraps too, though OCCT calls it not periodic.
  if (natural_ && patch_.isSpline()) {
    const auto same = [&](bool u) {
      for (int i = 0; i <= 8; ++i) {
        const double t = i / 8.0;
        const Eigen::Vector3d a = u ? patch_.value(u0_, v0_ + t * rv) : patch_.value(u0_ + t * ru, v0_);
        const Eigen::Vector3d b = u ? patch_.value(u1_, v0_ + t * rv) : patch_.value(u0_ + t * ru, v1_);
        if ((a - b).norm() > 1e-6) return false;
      }
      return true;
    };
    wrapsU_ = same(true);
    wrapsV_ = same(false);
  }

  // Typical length of a unit of u and v, from nine places.
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Jet jet;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      patch_.first(u0_ + ru * (0.2 + 0.3 * i), v0_ + rv * (0.2 + 0.3 * j), jet);
      sum += Eigen::Vector2d(jet.du.norm(), jet.dv.norm());
    }
  }
  scale_ = (sum / 9).cwiseMax(1e-12);
  band_ = 3 * kChordRatio * std::max(scale_.x() * ru, scale_.y() * rv);

  if (natural_) return;
  closeLoops();
  bins_.assign(kBins, {});
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    const Segment& s = segments_[k];
    const auto bin = [&](double v) { return std::clamp(int((v - v0_) / rv * kBins), 0, kBins - 1); };
    const int from = bin(std::min(s.a.y(), s.b.y())), to = bin(std::max(s.a.y(), s.b.y()));
    for (int b = from; b <= to; ++b) bins_[b].push_back(int(k));
  }
  // Files whose loops run the wrong way exist: look on which side of each border the face lies.
  const double step = 1e-4 * std::min(ru * scale_.x(), rv * scale_.y());
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    if (k > 0 && segments_[k].trim == segments_[k - 1].trim) continue;
    const TrimEdge& trim = trims_[segments_[k].trim];
    std::size_t end = k;
    while (end + 1 < segments_.size() && segments_[end + 1].trim == segments_[k].trim) ++end;
    const Segment& middle = segments_[(k + end) / 2];
    const Eigen::Vector2d m = 0.5 * (middle.a + middle.b);
    const Eigen::Vector2d d = (middle.b - middle.a).cwiseProduct(scale_).normalized();
    const Eigen::Vector2d left = Eigen::Vector2d(-d.y(), d.x()).cwiseQuotient(scale_) * step;
    const bool onLeft = evenOdd(m + left), onRight = evenOdd(m - left);
    if (onLeft != onRight) const_cast<TrimEdge&>(trim).leftInside = onLeft;
  }
}

bool FaceGeometry::evenOdd(const Eigen::Vector2d& uv) const {
  if (uv.y() < v0_ - 1e-9 * (v1_ - v0_) || uv.y() > v1_ + 1e-9 * (v1_ - v0_)) return false;
  const int bin = std::clamp(int((uv.y() - v0_) / (v1_ - v0_) * kBins), 0, kBins - 1);
  bool inside = false;
  for (const int k : bins_[bin]) {
    const Segment& s = segments_[k];
    if ((s.a.y() > uv.y()) == (s.b.y() > uv.y())) continue;
    const double u = s.a.x() + (s.b.x() - s.a.x()) * (uv.y() - s.a.y()) / (s.b.y() - s.a.y());
    if (u > uv.x()) inside = !inside;
  }
  return inside;
}

bool FaceGeometry::contains(const Eigen::Vector2d& uv) const {
  if (natural_) {
    const double eu = 1e-9 * (u1_ - u0_), ev = 1e-9 * (v1_ - v0_);
    return uv.x() >= u0_ - eu && uv.x() <= u1_ + eu && uv.y() >= v0_ - ev && uv.y() <= v1_ + ev;
  }
  // Near a border the polygon is replaced by the border's own curve.
  const Eigen::Vector2d p = uv.cwiseProduct(scale_);
  const double bandV = band_ / scale_.y() / (v1_ - v0_) * kBins, at = (uv.y() - v0_) / (v1_ - v0_) * kBins;
  const int from = std::clamp(int(at - bandV), 0, kBins - 1), to = std::clamp(int(at + bandV), 0, kBins - 1);
  double best = band_, where = 0;
  int nearest = -1;
  for (int b = from; b <= to; ++b) {
    for (const int k : bins_[b]) {
      double t = 0;
      const double d =
          segmentDistance(p, segments_[k].a.cwiseProduct(scale_), segments_[k].b.cwiseProduct(scale_), t);
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
    const double step = -delta.dot(tangent) / (slope > 0 ? slope : std::max(tangent.squaredNorm(), 1e-300));
    const double next = std::clamp(t + step, trim.first, trim.last);
    if (std::abs(next - t) * tangent.norm() < 1e-10) break;
    t = next;
  }
  // At a corner the foot of neither border is perpendicular; the polygon is exact there.
  const bool atEnd = t <= trim.first || t >= trim.last;
  if (atEnd && std::abs(delta.dot(tangent)) > 1e-6 * delta.norm() * tangent.norm()) return evenOdd(uv);
  const double side = tangent.x() * -delta.y() - tangent.y() * -delta.x();
  if (std::abs(side) <= 1e-7 * tangent.norm()) return true;
  return (side > 0) == trim.leftInside;
}

Eigen::Vector2d FaceGeometry::wrapped(Eigen::Vector2d uv) const {
  const auto wrap = [](double t, double t0, double t1, double period) {
    if (period <= 0) return t;
    const double middle = 0.5 * (t0 + t1);
    return t - period * std::round((t - middle) / period);
  };
  uv.x() = wrap(uv.x(), u0_, u1_, wrapsU_ && patch_.periodU() <= 0 ? u1_ - u0_ : patch_.periodU());
  uv.y() = wrap(uv.y(), v0_, v1_, wrapsV_ && patch_.periodV() <= 0 ? v1_ - v0_ : patch_.periodV());
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
      if (b > t0 + 1e-9 * (t1 - t0) && b < t1 - 1e-9 * (t1 - t0)) inner.push_back(b);
    }
    inner.push_back(t1);
    const int spans = int(inner.size());
    const int parts = spans >= 4 * kGridTarget ? 1 : std::max(2, (kGridTarget + spans - 1) / spans);
    const int skip = std::max(1, spans / kGridLimit);
    double from = t0;
    for (int i = 0; i < spans; ++i) {
      if ((i + 1) % skip != 0 && i + 1 != spans) continue;
      for (int k = 1; k <= parts; ++k) ts.push_back(k == parts ? inner[i] : from + (inner[i] - from) * k / parts);
      from = inner[i];
    }
    return ts;
  };
  const bool plane = patch_.type() == "plane";
  const bool ruled = plane || patch_.type() == "cylinder" || patch_.type() == "cone" || patch_.type() == "extrusion";
  gridU_ = line(u0_, u1_, patch_.breaksU(), plane);
  gridV_ = line(v0_, v1_, patch_.breaksV(), ruled);
  const int nu = int(gridU_.size()), nv = int(gridV_.size());
  grid_.resize(std::size_t(nu) * nv);
  inside_.assign(grid_.size(), 1);
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      grid_[std::size_t(i) * nv + j] = patch_.value(gridU_[i], gridV_[j]);
      if (!natural_) inside_[std::size_t(i) * nv + j] = contains({gridU_[i], gridV_[j]});
    }
  }
}

void FaceGeometry::measureArea() {
  if (!natural_) {
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(face_, properties, 1e-5);
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
  const Eigen::Vector3d n = jet.du.cross(jet.dv);
  const double length = n.norm();
  if (!(length > 1e-12 * jet.du.norm() * jet.dv.norm()) || length == 0) return Eigen::Vector3d::Zero();
  return (reversed_ ? -1.0 : 1.0) / length * n;
}

std::array<double, 2> FaceGeometry::extent(const Eigen::Vector3d& direction,
                                           const std::vector<EdgeGeometry>& edges) const {
  double low = 1e300, high = -1e300;
  const auto take = [&](double g) {
    low = std::min(low, g);
    high = std::max(high, g);
  };
  // Borders: samples, and the extrema between them.
  for (const TrimEdge& trim : trims_) {
    const EdgeGeometry& e = edges[trim.edge];
    const auto g = [&](double t) { return direction.dot(e.value(t)); };
    for (std::size_t i = 0; i < e.points.size(); ++i) {
      const double here = direction.dot(e.points[i]);
      take(here);
      if (i == 0 || i + 1 == e.points.size()) continue;
      const double a = direction.dot(e.points[i - 1]), b = direction.dot(e.points[i + 1]);
      if (here >= a && here >= b && here > high - 0.5 * (2 * here - a - b)) take(refineExtremum(g, e.t[i - 1], e.t[i + 1], true));
      if (here <= a && here <= b && here < low + 0.5 * (a + b - 2 * here)) take(refineExtremum(g, e.t[i - 1], e.t[i + 1], false));
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
      u = std::clamp(u + su, u0_, u1_);
      v = std::clamp(v + sv, v0_, v1_);
      if (std::abs(su) < 1e-10 * (u1_ - u0_) && std::abs(sv) < 1e-10 * (v1_ - v0_)) break;
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

std::array<double, 2> FaceGeometry::curvatureRange() const {
  double low = 1e300, high = -1e300;
  const int nu = int(gridU_.size()), nv = int(gridV_.size());
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      if (!gridInside(i, j)) continue;
      Jet s;
      patch_.second(gridU_[i], gridV_[j], s);
      const Eigen::Vector3d cross = s.du.cross(s.dv);
      const double length = cross.norm();
      if (!(length > 1e-12 * s.du.norm() * s.dv.norm()) || length == 0) continue;
      const Eigen::Vector3d n = (reversed_ ? -1.0 : 1.0) / length * cross;
      const double E = s.du.dot(s.du), F = s.du.dot(s.dv), G = s.dv.dot(s.dv);
      const double L = s.duu.dot(n), M = s.duv.dot(n), N = s.dvv.dot(n);
      const double metric = E * G - F * F;
      const double mean = 0.5 * (E * N - 2 * F * M + G * L) / metric;
      const double gauss = (L * N - M * M) / metric;
      const double root = std::sqrt(std::max(0.0, mean * mean - gauss));
      low = std::min(low, mean - root);
      high = std::max(high, mean + root);
    }
  }
  if (low > high) return {0.0, 0.0};
  return {low, high};
}

}  // namespace bw::geometry
