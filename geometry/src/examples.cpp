// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <functional>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "bw/geometry/export.h"
#include "step_text.h"

namespace bw::geometry {

namespace {

using Eigen::Vector3d;

/// How an example becomes a surface: spans of a B-spline, or an exact analytic surface.
struct Recipe {
  Example example;
  Vector3d (*point)(double u, double v);
  int degreeU, spansU, degreeV, spansV;  ///< degree 0: analytic
};

Vector3d panel(double u, double v) {
  const double x = 600 * u, y = 670 * v;
  const double a = 2 * kPi * (x - 300) / 1000, b = 2 * kPi * (y - 335) / 640;
  const double lengthwise = 46 * std::sin(b) + 12 * std::sin(2 * b);
  const double across = 22 * std::cos(0.4 * b) * (std::cos(a) + 0.06 * std::cos(3 * a));
  return {x, y, 100 + lengthwise + across + 22 * std::sin(a) * std::sin(b)};
}

Vector3d graph(double u, double v) {
  const double p = kPi * (u - 0.5), q = 1.5 * (v - 0.5);
  const double bell = std::pow(std::cos(2 * (kPi / 2 - q)), 4);
  return {200 * (p + kPi / 2), 600 * (q + 0.75), 45 * bell * std::sin(p) * std::exp(-0.1 * p * p)};
}

Vector3d saddle(double u, double v) {
  const double x = 600 * u - 300, y = 800 * v - 400;
  return {x, y, x * x / 1600 - y * y / 1200};
}

constexpr double kSphereRadius = 900, kSphereHalf = 300;

Vector3d sphereCap(double u, double v) {
  const double x = kSphereHalf * (2 * u - 1), y = kSphereHalf * (2 * v - 1),
               r2 = kSphereRadius * kSphereRadius;
  return {x, y, std::sqrt(r2 - x * x - y * y) - std::sqrt(r2 - 2 * kSphereHalf * kSphereHalf)};
}

constexpr double kTorusMajor = 1000, kTorusMinor = 450, kTorusHalf = 300;

Vector3d torusPatch(double u, double v) {
  const double x = kTorusHalf * (2 * u - 1), y = kTorusMajor + kTorusHalf * (2 * v - 1);
  const double beyond = std::hypot(x, y) - kTorusMajor;
  return {x, y, std::sqrt(kTorusMinor * kTorusMinor - beyond * beyond)};
}

Vector3d wavyWall(double u, double v) {
  const double x = 4200 * u, y = 2400 * v;
  const double phase = 2 * kPi * y / 1200 + 0.9 * std::sin(2 * kPi * x / 4200);
  return {x, y, (110 + 50 * std::cos(2 * kPi * x / 2800)) * std::sin(phase) + 60 * std::cos(kPi * x / 4200)};
}

/// The profile of a ramp: a cubic Bézier quarter that leaves the floor level and ends upright.
Eigen::Vector2d rampProfile(double u) {
  constexpr double k = 0.5523;
  const double w = 1 - u;
  const double x = 3 * w * w * u * k + 3 * w * u * u + u * u * u;
  const double z = 3 * w * u * u * (1 - k) + u * u * u;
  return {x, z};
}

constexpr double kRampHeight = 854.10, kRampWidth = 1400;
constexpr double kRampShort = 855.11,
                 kRampLong = 1001.38;  // runs whose profiles are 1342.6 and 1459.8 mm long

Vector3d ramp(double u, double v, double runMiddle, double runEnd) {
  const double t = 2 * v - 1, run = runMiddle + (runEnd - runMiddle) * t * t;
  const Eigen::Vector2d p = rampProfile(u);
  return {run * p.x(), kRampWidth * v, kRampHeight * p.y()};
}

Vector3d rampHollow(double u, double v) { return ramp(u, v, kRampShort, kRampLong); }
Vector3d rampDomed(double u, double v) { return ramp(u, v, kRampLong, kRampShort); }

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> list = {
      {{"panel-600x670", "Test panel 600 × 670 mm",
        "x = 600 u, y = 670 v, a = 2π (x − 300)/1000, b = 2π (y − 335)/640, "
        "z = 100 + 46 sin b + 12 sin 2b + 22 cos(0.4 b) (cos a + 0.06 cos 3a) + 22 sin a sin b; mm. "
        "Gaussian curvature of both signs; sections across y have at most two inflections."},
       panel,
       5,
       14,
       5,
       17},
      {{"graph", "Graph of a function",
        "p ∈ [−π/2, π/2], q ∈ [−0.75, 0.75]: x = 200 (p + π/2), y = 600 (q + 0.75), z = 45 cos⁴(2 (π/2 − q)) "
        "sin p exp(−0.1 p²); mm. "
        "The exponent 4 is read as that of the cosine, which then vanishes at q = ±π/4, just outside the "
        "domain."},
       graph,
       5,
       8,
       5,
       14},
      {{"saddle", "Saddle",
        "x ∈ [−300, 300], y ∈ [−400, 400], z = x²/1600 − y²/1200; mm. A hyperbolic paraboloid, exact."},
       saddle,
       2,
       1,
       2,
       1},
      {{"sphere-cap", "Cap of a sphere",
        "x, y ∈ [−300, 300], z = √(900² − x² − y²) − √(900² − 2·300²); mm. A sphere of radius 900 over a "
        "square, exact."},
       sphereCap,
       0,
       0,
       0,
       0},
      {{"torus-patch", "Patch of a torus",
        "x ∈ [−300, 300], y ∈ [700, 1300], z = √(450² − (√(x² + y²) − 1000)²); mm. A torus of radii 1000 and "
        "450 over a square, "
        "exact: Gaussian curvature is negative on the near half and positive on the far half."},
       torusPatch,
       0,
       0,
       0,
       0},
      {{"wavy-wall", "Wavy wall 4200 × 2400 mm",
        "x = 4200 u, y = 2400 v, f = 2π y/1200 + 0.9 sin(2π x/4200), "
        "z = (110 + 50 cos(2π x/2800)) sin f + 60 cos(π x/4200); mm. Valleys and ridges wander along x."},
       wavyWall,
       5,
       22,
       5,
       26},
      {{"ramp-corner-hollow", "Corner of a skater ramp, negative curvature",
        "x = r(v) X(u), y = 1400 v, z = 854.10 Z(u), (X, Z) the Bézier cubic (0,0) (0.5523,0) (1,0.4477) "
        "(1,1), "
        "r(v) = 855.11 + 146.27 (2v − 1)²; mm, exact. Profiles are 1342.6 mm long in the middle and 1459.8 "
        "mm at the ends."},
       rampHollow,
       3,
       1,
       2,
       1},
      {{"ramp-corner-domed", "Corner of a skater ramp, positive curvature",
        "x = r(v) X(u), y = 1400 v, z = 854.10 Z(u), (X, Z) the Bézier cubic (0,0) (0.5523,0) (1,0.4477) "
        "(1,1), "
        "r(v) = 1001.38 − 146.27 (2v − 1)²; mm, exact. Profiles are 1459.8 mm long in the middle and 1342.6 "
        "mm at the ends."},
       rampDomed,
       3,
       1,
       2,
       1},
  };
  return list;
}

Result<const Recipe*> find(const std::string& name) {
  std::vector<std::string> names;
  for (const Recipe& recipe : recipes()) {
    if (recipe.example.name == name) return &recipe;
    names.push_back(recipe.example.name);
  }
  std::string all;
  for (const std::string& n : names) all += (all.empty() ? "" : ", ") + n;
  const std::string near = nearestWord(name, names.data(), int(names.size()));
  return fail(
      ErrorCode::badInput,
      "there is no example \"" + name + "\"" +
          (near.empty() ? "; the examples are " : "; did you mean \"" + near + "\"? The examples are ") + all,
      "example");
}

std::vector<double> uniformKnots(int degree, int spans) {
  std::vector<double> knots(std::size_t(degree), 0.0);
  for (int i = 0; i <= spans; ++i) knots.push_back(double(i) / spans);
  knots.insert(knots.end(), std::size_t(degree), 1.0);
  return knots;
}

/// Greville abscissae: one interpolation point a pole.
std::vector<double> greville(int degree, const std::vector<double>& knots) {
  std::vector<double> result;
  for (std::size_t i = 0; i + degree + 1 < knots.size(); ++i) {
    double sum = 0;
    for (int k = 1; k <= degree; ++k) sum += knots[i + k];
    result.push_back(sum / degree);
  }
  return result;
}

double basisValue(const std::vector<double>& knots, int i, int degree, double t) {
  if (degree == 0) {
    const bool last = knots[i] < knots[i + 1] && knots[i + 1] == knots.back() && t == knots.back();
    return (t >= knots[i] && t < knots[i + 1]) || last ? 1.0 : 0.0;
  }
  double value = 0;
  const double a = knots[i + degree] - knots[i], b = knots[i + degree + 1] - knots[i + 1];
  if (a > 0) value += (t - knots[i]) / a * basisValue(knots, i, degree - 1, t);
  if (b > 0) value += (knots[i + degree + 1] - t) / b * basisValue(knots, i + 1, degree - 1, t);
  return value;
}

Eigen::MatrixXd collocation(int degree, const std::vector<double>& knots) {
  const std::vector<double> at = greville(degree, knots);
  const int n = int(at.size());
  Eigen::MatrixXd matrix(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) matrix(i, j) = basisValue(knots, j, degree, at[i]);
  }
  return matrix;
}

/// Poles to a millionth of a millimetre: enough for every use, and the same text wherever it is computed.
double rounded(double x) { return std::round(x * 1e6) / 1e6; }

SplineSurface interpolate(const Recipe& recipe) {
  SplineSurface s;
  s.degreeU = recipe.degreeU;
  s.degreeV = recipe.degreeV;
  s.knotsU = uniformKnots(s.degreeU, recipe.spansU);
  s.knotsV = uniformKnots(s.degreeV, recipe.spansV);
  const std::vector<double> us = greville(s.degreeU, s.knotsU), vs = greville(s.degreeV, s.knotsV);
  s.polesU = int(us.size());
  s.polesV = int(vs.size());
  const Eigen::PartialPivLU<Eigen::MatrixXd> alongU(collocation(s.degreeU, s.knotsU));
  const Eigen::PartialPivLU<Eigen::MatrixXd> alongV(collocation(s.degreeV, s.knotsV));
  s.poles.resize(std::size_t(s.polesU) * s.polesV);
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::MatrixXd values(s.polesU, s.polesV);
    for (int i = 0; i < s.polesU; ++i) {
      for (int j = 0; j < s.polesV; ++j) values(i, j) = recipe.point(us[i], vs[j])[axis];
    }
    const Eigen::MatrixXd half = alongU.solve(values);
    const Eigen::MatrixXd poles = alongV.solve(half.transpose());  // polesV × polesU
    for (int j = 0; j < s.polesV; ++j) {
      for (int i = 0; i < s.polesU; ++i) s.poles[std::size_t(j) * s.polesU + i][axis] = rounded(poles(j, i));
    }
  }
  return s;
}

std::string sphereCapStep(const std::string& title) {
  constexpr double h = kSphereHalf;
  const double drop = std::sqrt(kSphereRadius * kSphereRadius - 2 * h * h),
               side = std::sqrt(kSphereRadius * kSphereRadius - h * h);
  StepText text;
  // The poles lie to the left and right and the seam below, so that the face has neither.
  const int surface = text.sphere({0, 0, -drop}, Vector3d::UnitX(), -Vector3d::UnitZ(), kSphereRadius);
  const int a = text.vertex({-h, -h, 0}), b = text.vertex({h, -h, 0}), c = text.vertex({h, h, 0}),
            d = text.vertex({-h, h, 0});
  // Each circle runs counter-clockwise about its axis over the top.
  const int south = text.edge(a, b, text.circle({0, -h, -drop}, Vector3d::UnitY(), -Vector3d::UnitX(), side));
  const int east = text.edge(b, c, text.circle({h, 0, -drop}, -Vector3d::UnitX(), -Vector3d::UnitY(), side));
  const int north = text.edge(c, d, text.circle({0, h, -drop}, -Vector3d::UnitY(), Vector3d::UnitX(), side));
  const int west = text.edge(d, a, text.circle({-h, 0, -drop}, Vector3d::UnitX(), Vector3d::UnitY(), side));
  return text.file(surface, {{south, true}, {east, true}, {north, true}, {west, true}}, title);
}

std::string torusPatchStep(const std::string& title) {
  constexpr int kSpans = 16;  // a border keeps within 1e-8 mm of the torus
  StepText text;
  const int surface = text.torus(Vector3d::Zero(), kTorusMajor, kTorusMinor);
  const std::vector<double> knots = uniformKnots(7, kSpans), at = greville(7, knots);
  const Eigen::PartialPivLU<Eigen::MatrixXd> solver(collocation(7, knots));
  const auto border = [&](const std::function<Vector3d(double)>& point) {
    Eigen::MatrixXd values(Eigen::Index(at.size()), 3);
    for (std::size_t i = 0; i < at.size(); ++i) values.row(Eigen::Index(i)) = point(at[i]).transpose();
    const Eigen::MatrixXd solved = solver.solve(values);
    std::vector<Vector3d> poles;
    for (Eigen::Index i = 0; i < solved.rows(); ++i) {
      poles.push_back(
          solved.row(i).transpose().unaryExpr([](double x) { return std::round(x * 1e9) / 1e9; }));
    }
    return std::pair(text.splineCurve(7, knots, poles), std::pair(poles.front(), poles.back()));
  };
  const auto south = border([](double t) { return torusPatch(t, 0); });
  const auto north = border([](double t) { return torusPatch(t, 1); });
  const auto west = border([](double t) { return torusPatch(0, t); });
  const auto east = border([](double t) { return torusPatch(1, t); });
  const int a = text.vertex(south.second.first), b = text.vertex(south.second.second);
  const int c = text.vertex(north.second.second), d = text.vertex(north.second.first);
  const int s = text.edge(a, b, south.first), e = text.edge(b, c, east.first);
  const int n = text.edge(d, c, north.first), w = text.edge(a, d, west.first);
  return text.file(surface, {{s, true}, {e, true}, {n, false}, {w, false}}, title);
}

}  // namespace

std::vector<Example> exampleList() {
  std::vector<Example> list;
  for (const Recipe& recipe : recipes()) list.push_back(recipe.example);
  return list;
}

Result<std::string> exampleStep(const std::string& name) {
  const auto recipe = find(name);
  if (!recipe) return tl::unexpected(recipe.error());
  if (name == "sphere-cap") return sphereCapStep(name);
  if (name == "torus-patch") return torusPatchStep(name);
  return stepText(interpolate(**recipe), name);
}

Result<Eigen::Vector3d> examplePoint(const std::string& name, double u, double v) {
  const auto recipe = find(name);
  if (!recipe) return tl::unexpected(recipe.error());
  if (!(u >= 0 && u <= 1 && v >= 0 && v <= 1)) {
    return fail(
        ErrorCode::badInput,
        "the parameters of an example lie in [0, 1], not (" + shortText(u) + ", " + shortText(v) + ")",
        "parameters", u < 0 || u > 1 ? u : v);
  }
  return (*recipe)->point(u, v);
}

}  // namespace bw::geometry
