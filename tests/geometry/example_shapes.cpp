// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "example_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "bw/core/base/units.h"
#include "bw/geometry/export.h"
#include "interpolated.h"
#include "step_text.h"

namespace bw::geometry::test {

namespace {

using Eigen::Vector3d;

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

/// How an example becomes a surface: spans of a B-spline, or an exact analytic surface (degree 0).
struct Recipe {
  const char* name;
  Vector3d (*point)(double u, double v);
  int degreeU, spansU, degreeV, spansV;
};

constexpr Recipe kRecipes[] = {
    {"panel-600x670", panel, 5, 14, 5, 17},
    {"graph", graph, 5, 8, 5, 14},
    {"saddle", saddle, 2, 1, 2, 1},
    {"sphere-cap", sphereCap, 0, 0, 0, 0},
    {"torus-patch", torusPatch, 0, 0, 0, 0},
    {"wavy-wall", wavyWall, 5, 22, 5, 26},
    {"ramp-corner-hollow", rampHollow, 3, 1, 2, 1},
    {"ramp-corner-domed", rampDomed, 3, 1, 2, 1},
};

const Recipe& find(const std::string& name) {
  const Recipe* recipe = std::ranges::find(kRecipes, name, &Recipe::name);
  EXPECT_NE(recipe, std::end(kRecipes)) << name;
  return *recipe;
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

/// Poles to a millionth of a millimetre: enough for every use, and the same text wherever it is computed.
double rounded(double x) { return std::round(x * 1e6) / 1e6; }

SplineSurface interpolate(const Recipe& recipe) {
  SplineSurface s;
  s.degreeU = recipe.degreeU;
  s.degreeV = recipe.degreeV;
  s.knotsU = uniformKnots(s.degreeU, recipe.spansU);
  s.knotsV = uniformKnots(s.degreeV, recipe.spansV);
  const std::vector<double> us = greville(s.degreeU, s.knotsU), vs = greville(s.degreeV, s.knotsV);
  std::vector<Eigen::Vector3d> points;
  for (const double v : vs)
    for (const double u : us) points.push_back(recipe.point(u, v));
  bw::test::interpolate(s, us, vs, points);
  for (Eigen::Vector3d& pole : s.poles) pole = pole.unaryExpr(&rounded);
  return s;
}

/// An entity at a placement, with its radii.
int placed(StepText& text, const std::string& entity, const Vector3d& center, const Vector3d& axis,
           const Vector3d& reference, const std::string& radii) {
  const int place = text.placement(center, axis, reference);
  return text.add(entity + "(''," + "#" + std::to_string(place) + "," + radii + ")");
}

std::string sphereCapStep(const std::string& title) {
  constexpr double h = kSphereHalf;
  const double drop = std::sqrt(kSphereRadius * kSphereRadius - 2 * h * h),
               side = std::sqrt(kSphereRadius * kSphereRadius - h * h);
  StepText text;
  // The poles lie to the left and right and the seam below, so that the face has neither.
  const int surface = placed(text, "SPHERICAL_SURFACE", {0, 0, -drop}, Vector3d::UnitX(), -Vector3d::UnitZ(),
                             stepReal(kSphereRadius));
  const int a = text.vertex({-h, -h, 0}), b = text.vertex({h, -h, 0}), c = text.vertex({h, h, 0}),
            d = text.vertex({-h, h, 0});
  const auto circle = [&](const Vector3d& center, const Vector3d& axis, const Vector3d& reference) {
    return placed(text, "CIRCLE", center, axis, reference, stepReal(side));
  };
  // Each circle runs counter-clockwise about its axis over the top.
  const int south = text.edge(a, b, circle({0, -h, -drop}, Vector3d::UnitY(), -Vector3d::UnitX()));
  const int east = text.edge(b, c, circle({h, 0, -drop}, -Vector3d::UnitX(), -Vector3d::UnitY()));
  const int north = text.edge(c, d, circle({0, h, -drop}, -Vector3d::UnitY(), Vector3d::UnitX()));
  const int west = text.edge(d, a, circle({-h, 0, -drop}, Vector3d::UnitX(), Vector3d::UnitY()));
  return text.file({text.shell(surface, {{south, true}, {east, true}, {north, true}, {west, true}}, title)},
                   title);
}

std::string torusPatchStep(const std::string& title) {
  constexpr int kSpans = 16;  // a border keeps within 1e-8 mm of the torus
  StepText text;
  const int surface = placed(text, "TOROIDAL_SURFACE", Vector3d::Zero(), Vector3d::UnitZ(), Vector3d::UnitX(),
                             stepReal(kTorusMajor) + "," + stepReal(kTorusMinor));
  const std::vector<double> knots = uniformKnots(7, kSpans), at = greville(7, knots);
  const Eigen::PartialPivLU<Eigen::MatrixXd> solver(bw::test::collocation(7, knots, at));
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
  return text.file({text.shell(surface, {{s, true}, {e, true}, {n, false}, {w, false}}, title)}, title);
}

}  // namespace

Eigen::Vector3d examplePoint(const std::string& name, double u, double v) { return find(name).point(u, v); }

std::string generatedStep(const std::string& name) {
  if (name == "sphere-cap") return sphereCapStep(name);
  if (name == "torus-patch") return torusPatchStep(name);
  return stepText(interpolate(find(name)), name).value();
}

}  // namespace bw::geometry::test
