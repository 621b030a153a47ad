// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <sstream>

#include "bw/core/base/units.h"
#include "bw/core/biarc/biarc.h"
#include "bw/core/files/file_set.h"

namespace bw {

namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

/// The example of the report, section 4.1.
const Points kSeven = {{1, 0}, {0, 2}, {1, 4}, {2, 6}, {3, 5}, {4, 4}, {5.5, 3}};

BiarcOptions throughOneFourSeven() {
  BiarcOptions options;
  options.select = BiarcSelect::index;
  options.indices = {0, 3, 6};
  return options;
}

Points lamp() {
  std::istringstream text(readFile(std::string(BW_TEST_DATA) + "/lamp-53.csv").value());
  for (int heads = 2; heads > 0; --heads) text.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  Points points;
  char comma;
  for (Vector2d p; text >> p.x() >> comma >> p.y();) points.push_back(p);
  return points;
}

Points ellipse(int count) {
  Points points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(100 * std::cos(2 * kPi * i / count), 40 * std::sin(2 * kPi * i / count));
  return points;
}

/// The smallest distance by brute force, independent of the solver's.
double distanceTo(const BiarcCurve& curve, const Vector2d& p) {
  double best = 1e300;
  for (const CircularArc& arc : curve.arcs) {
    const int steps = 2000;
    int at = 0;
    double near = 1e300;
    for (int i = 0; i <= steps; ++i)
      if (const double d = (arc.pointAt(arc.length * i / steps) - p).norm(); d < near) {
        near = d;
        at = i;
      }
    double a = arc.length * std::max(0, at - 1) / steps, b = arc.length * std::min(steps, at + 1) / steps;
    for (int i = 0; i < 60; ++i) {
      const double c = a + (b - a) / 3, d = b - (b - a) / 3;
      ((arc.pointAt(c) - p).norm() < (arc.pointAt(d) - p).norm() ? b : a) =
          (arc.pointAt(c) - p).norm() < (arc.pointAt(d) - p).norm() ? d : c;
    }
    best = std::min(best, (arc.pointAt((a + b) / 2) - p).norm());
  }
  return best;
}

/// The simplex method of Nelder and Mead; returns the lowest value.
double simplex(const std::vector<double>& start, double step, int iterations,
               const std::function<double(const std::vector<double>&)>& f) {
  using Vertex = std::pair<double, std::vector<double>>;
  const std::size_t n = start.size();
  std::vector<Vertex> all{{f(start), start}};
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> u = start;
    u[i] += step;
    all.emplace_back(f(u), u);
  }
  for (int k = 0; k < iterations; ++k) {
    std::sort(all.begin(), all.end());
    std::vector<double> middle(n, 0);
    for (std::size_t v = 0; v < n; ++v)
      for (std::size_t i = 0; i < n; ++i) middle[i] += all[v].second[i] / double(n);
    const auto along = [&](double t) {
      std::vector<double> u(n);
      for (std::size_t i = 0; i < n; ++i) u[i] = middle[i] + t * (all[n].second[i] - middle[i]);
      return Vertex(f(u), u);
    };
    const Vertex mirrored = along(-1);
    if (mirrored.first < all[0].first) {
      all[n] = std::min(mirrored, along(-2));
    } else if (mirrored.first < all[n - 1].first) {
      all[n] = mirrored;
    } else if (const Vertex inside = along(mirrored.first < all[n].first ? -0.5 : 0.5);
               inside.first < std::min(mirrored.first, all[n].first)) {
      all[n] = inside;
    } else {
      for (std::size_t v = 1; v <= n; ++v) {
        for (std::size_t i = 0; i < n; ++i) all[v].second[i] = (all[v].second[i] + all[0].second[i]) / 2;
        all[v].first = f(all[v].second);
      }
    }
  }
  return std::min_element(all.begin(), all.end())->first;
}

void expectSmooth(const BiarcCurve& curve) {
  double size = 0;
  for (const CircularArc& arc : curve.arcs) size += arc.length;
  for (std::size_t i = 0; i + (curve.closed ? 0 : 1) < curve.arcs.size(); ++i) {
    const CircularArc &arc = curve.arcs[i], &next = curve.arcs[(i + 1) % curve.arcs.size()];
    EXPECT_LT((arc.end() - next.start).norm(), 1e-12 * size);
    EXPECT_LT(std::abs(std::remainder(arc.endAngle() - next.startAngle, 2 * kPi)), 1e-12);
    EXPECT_GT(arc.length, 0);
  }
}

}  // namespace

TEST(BiarcFit, MeasuresTheReportsExampleAsConstructed) {
  BiarcOptions options = throughOneFourSeven();
  options.goal = BiarcGoal::nothing;
  const BiarcResult r = fitBiarcs(kSeven, options).value();
  ASSERT_EQ(r.curve.arcs.size(), 4u);
  EXPECT_EQ(r.status, BiarcStatus::constructed);
  EXPECT_EQ(r.curve.points[1], Vector2d(2, 6));
  EXPECT_NEAR(r.curve.tangents[0], std::atan2(6, 1), 1e-14);
  EXPECT_NEAR(r.curve.tangents[1], std::atan2(3, 4.5), 1e-14);
  EXPECT_NEAR(r.curve.tangents[2], std::atan2(-3, 3.5), 1e-14);
  expectSmooth(r.curve);
  double sum = 0, squares = 0, largest = 0, energy = 0, angle = 0;
  for (const Vector2d& p : kSeven) {
    const double d = distanceTo(r.curve, p);
    sum += d;
    squares += d * d;
    largest = std::max(largest, d);
  }
  for (const CircularArc& arc : r.curve.arcs) {
    energy += std::abs(arc.turning / *arc.radius());
    angle += std::abs(arc.turning) / (*arc.radius() * *arc.radius());
  }
  EXPECT_NEAR(r.measures.mean, sum / 7, 1e-9);
  EXPECT_NEAR(r.measures.rms, std::sqrt(squares / 7), 1e-9);
  EXPECT_NEAR(r.measures.max, largest, 1e-9);
  EXPECT_NEAR(r.measures.energy, energy, 1e-12);
  EXPECT_NEAR(r.measures.angle, std::sqrt(angle), 1e-12);
}

TEST(BiarcFit, EachMeasureIsSmallestWhereItIsTheGoal) {
  for (const Points& data : {kSeven, lamp()}) {
    BiarcResult results[3];
    for (int i = 0; i < 3; ++i) {
      BiarcOptions options = throughOneFourSeven();
      if (data.size() == 53) options.indices = {0, 16, 34, 52};
      options.distance = BiarcDistance(i);
      results[i] = fitBiarcs(data, options).value();
      expectSmooth(results[i].curve);
      EXPECT_LT(results[i].objective, 0.5 * fitBiarcs(data, options)->initial.max);
    }
    for (int i = 0; i < 3; ++i) {
      EXPECT_LE(results[0].measures.mean, results[i].measures.mean * (1 + 1e-3));
      EXPECT_LE(results[1].measures.rms, results[i].measures.rms * (1 + 1e-6));
      EXPECT_LE(results[2].measures.max, results[i].measures.max * (1 + 1e-3));
    }
  }
}

TEST(BiarcFit, NoSmallChangeLowersTheMeasure) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 1);
  for (const BiarcGoal goal : {BiarcGoal::distance, BiarcGoal::combined, BiarcGoal::curvature}) {
    for (const BiarcCurvature kind : {BiarcCurvature::energy, BiarcCurvature::angle}) {
      BiarcOptions options = throughOneFourSeven();
      options.goal = goal;
      options.weight = goal == BiarcGoal::combined ? 0.2 : 0;
      options.curvature = kind;
      options.keepEnds = true;
      const BiarcResult r = fitBiarcs(kSeven, options).value();
      EXPECT_EQ(r.status, BiarcStatus::converged);
      for (int i = 0; i < 300; ++i) {
        const double step = std::pow(10.0, -1 - 4.0 * i / 300);
        Points points = r.curve.points;
        std::vector<double> tangents = r.curve.tangents;
        if (goal != BiarcGoal::curvature) points[1] += step * Vector2d(normal(random), normal(random));
        for (double& angle : tangents) angle += step * normal(random);
        const Result<BiarcCurve> curve = biarcCurve(points, tangents);
        if (!curve) continue;
        const BiarcMeasures m = measureBiarcs(*curve, kSeven).value();
        const double bend = kind == BiarcCurvature::energy ? m.energy : m.angle;
        const double value = goal == BiarcGoal::distance    ? m.rms
                             : goal == BiarcGoal::curvature ? bend
                                                            : 0.8 * m.rms + 0.2 * bend;
        EXPECT_GT(value, r.objective * (1 - 1e-7)) << "goal " << int(goal) << " step " << step;
      }
    }
  }
}

TEST(BiarcFit, IsNotBeatenByTheSimplexMethod) {
  // The report's own way, from its own start: points and tangents are moved by the method of Nelder and Mead.
  for (const int kind : {0, 1, 2}) {
    BiarcOptions options = throughOneFourSeven();
    options.distance = BiarcDistance(kind);
    const auto value = [&](const std::vector<double>& u) {
      const Result<BiarcCurve> curve =
          biarcCurve({{u[0], u[1]}, {u[2], u[3]}, {u[4], u[5]}}, {u[6], u[7], u[8]});
      if (!curve) return 1e9;
      const BiarcMeasures m = measureBiarcs(*curve, kSeven).value();
      return kind == 0 ? m.mean : kind == 1 ? m.rms : m.max;
    };
    const std::vector<double> start = {
        1, 0, 2, 6, 5.5, 3, std::atan2(6, 1), std::atan2(3, 4.5), std::atan2(-3, 3.5)};
    const double reached = simplex(start, 0.2, 4000, value);
    const BiarcResult r = fitBiarcs(kSeven, options).value();
    EXPECT_LT(r.objective, reached * (1 + 1e-3)) << kind;
    EXPECT_LT(reached, 0.7 * value(start));
  }
}

TEST(BiarcFit, MovesTurnsScalesAndReverses) {
  Points data = lamp();
  BiarcOptions options;
  options.points = 4;
  const BiarcResult r = fitBiarcs(data, options).value();
  const double angle = 0.7, scale = 1e4;
  Points moved;
  for (const Vector2d& p : data)
    moved.emplace_back(3e5 + scale * (std::cos(angle) * p.x() - std::sin(angle) * p.y()),
                       -1e5 + scale * (std::sin(angle) * p.x() + std::cos(angle) * p.y()));
  const BiarcResult m = fitBiarcs(moved, options).value();
  EXPECT_NEAR(m.measures.rms / (scale * r.measures.rms), 1, 1e-6);
  EXPECT_NEAR(m.measures.energy * scale / r.measures.energy, 1, 1e-3);
  std::reverse(data.begin(), data.end());
  EXPECT_NEAR(fitBiarcs(data, options)->measures.rms / r.measures.rms, 1, 1e-6);
  for (Vector2d& p : data) p.y() = -p.y();
  EXPECT_NEAR(fitBiarcs(data, options)->measures.rms / r.measures.rms, 1, 1e-6);
}

TEST(BiarcFit, ChoosesPointsInEveryWay) {
  const Points data = lamp();
  BiarcOptions options;
  options.goal = BiarcGoal::nothing;
  options.points = 6;
  for (const BiarcSelect select :
       {BiarcSelect::spacing, BiarcSelect::index, BiarcSelect::curvature, BiarcSelect::tube}) {
    options.select = select;
    const BiarcResult r = fitBiarcs(data, options).value();
    ASSERT_EQ(r.curve.points.size(), 6u);
    EXPECT_LT((r.curve.points.front() - data.front()).norm(), 1e-12);
    EXPECT_LT((r.curve.points.back() - data.back()).norm(), 1e-12);
  }
  options.select = BiarcSelect::spacing;
  const BiarcResult even = fitBiarcs({{0, 0}, {1, 0}, {1, 4}, {6, 4}}, options).value();
  EXPECT_LT((even.curve.points[1] - Vector2d(1, 1)).norm(), 1e-12);
  EXPECT_LT((even.curve.points[3] - Vector2d(2, 4)).norm(), 1e-12);
  options.select = BiarcSelect::coordinates;
  options.coordinates = {{0, 1}, {10, 5}, {38, -2}};
  EXPECT_LT((fitBiarcs(data, options)->curve.points[1] - Vector2d(10, 5)).norm(), 1e-12);
  // The tube: what is dropped lies within ε of the chain of the rest.
  options.select = BiarcSelect::tube;
  options.points = 0;
  options.tube = 0.5;
  const BiarcResult tube = fitBiarcs(data, options).value();
  EXPECT_LT(tube.curve.points.size(), 15u);
  for (const Vector2d& p : data) {
    double near = 1e300;
    for (std::size_t i = 1; i < tube.curve.points.size(); ++i) {
      const Vector2d a = tube.curve.points[i - 1], edge = tube.curve.points[i] - a;
      const double t = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
      near = std::min(near, (p - a - t * edge).norm());
    }
    EXPECT_LE(near, 0.5 + 1e-12);
  }
}

TEST(BiarcFit, TheTubeDropsThePointsThatMatterLeast) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0, 0.3);
  for (const bool closed : {false, true}) {
    Points data;
    for (int i = 0; i < 90; ++i) {
      const double t = 2 * kPi * i / 90;
      data.push_back({40 * std::cos(t) + noise(random), 25 * std::sin(t) + noise(random)});
    }
    const auto gapOf = [&](const Points& kept) {
      // How far the dropped points lie from the edge that bridges them.
      double worst = 0;
      std::size_t k = 0;
      for (std::size_t i = 0; i < data.size(); ++i) {
        if (k + 1 < kept.size() && (data[i] - kept[k + 1]).norm() < 1e-9) ++k;
        const Vector2d a = kept[k], edge = kept[(k + 1) % kept.size()] - a;
        const double t = std::clamp((data[i] - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
        worst = std::max(worst, (data[i] - a - t * edge).norm());
      }
      return worst;
    };
    BiarcOptions options;
    options.closed = closed;
    options.goal = BiarcGoal::nothing;
    options.select = BiarcSelect::tube;
    options.tube = 1.2;
    const Points tube = fitBiarcs(data, options).value().curve.points;
    EXPECT_LE(closed ? 0 : gapOf(tube), options.tube + 1e-9);
    // One fewer would not do, whichever is dropped.
    for (std::size_t i = 1; !closed && i + 1 < tube.size(); ++i) {
      Points fewer = tube;
      fewer.erase(fewer.begin() + std::ptrdiff_t(i));
      EXPECT_GT(gapOf(fewer), options.tube);
    }
    // Fewer points are among more.
    options.tube = 0;
    Points before;
    for (const int count : {40, 20, 8, 4}) {
      options.points = count;
      const Points kept = fitBiarcs(data, options).value().curve.points;
      ASSERT_EQ(kept.size(), std::size_t(count));
      for (const Vector2d& p : kept) {
        const Points& all = before.empty() ? data : before;
        EXPECT_TRUE(
            std::any_of(all.begin(), all.end(), [&](const Vector2d& q) { return (p - q).norm() < 1e-9; }));
      }
      before = kept;
    }
  }
}

TEST(BiarcFit, VeryManyPointsGiveTheArcsOfFewer) {
  // The noise is fixed; ten times the points tell the same curve.
  const auto data = [](int count) {
    Points points;
    for (int i = 0; i < count; ++i) {
      const double t = double(i) / (count - 1);
      points.push_back({1000 * t, 100 * std::sin(6 * t) + 0.01 * std::sin(1e4 * t)});
    }
    return points;
  };
  for (const BiarcDistance distance : {BiarcDistance::rms, BiarcDistance::mean, BiarcDistance::max}) {
    SCOPED_TRACE(int(distance));
    BiarcOptions options;
    options.points = 6;
    options.distance = distance;
    const BiarcResult few = fitBiarcs(data(3000), options).value();
    const BiarcResult many = fitBiarcs(data(30000), options).value();
    EXPECT_NEAR(many.objective, few.objective, 0.1 * few.objective);
  }
  BiarcOptions options;
  options.tolerance = 0.5;
  const BiarcResult few = fitBiarcs(data(3000), options).value();
  const BiarcResult many = fitBiarcs(data(30000), options).value();
  EXPECT_LE(many.measures.max, 0.5 * (1 + 1e-9));
  EXPECT_LE(many.curve.arcs.size(), few.curve.arcs.size() + 2);
}

TEST(BiarcFit, MorePointsThanDataMeetAllData) {
  for (const Points& data : {Points{{1, 0}, {0, 2}, {1, 4}, {2, 6}, {3, 5}, {4, 4}, {5.5, 3}}, lamp()})
    for (const bool closed : {false, true})
      for (const int count : {int(data.size()) + 1, 2 * int(data.size()) + 3, 501}) {
        BiarcOptions options;
        options.points = count;
        options.closed = closed;
        const Result<BiarcResult> fit = fitBiarcs(data, options);
        ASSERT_TRUE(fit) << fit.error().message;
        EXPECT_EQ(fit->curve.points.size(), std::size_t(count));
        EXPECT_LT(fit->measures.max, 1e-9) << count << closed;
      }
}

TEST(BiarcFit, EndsWhereTheDataEnd) {
  for (const bool keep : {false, true}) {
    BiarcOptions options;
    options.points = 4;
    options.keepEnds = keep;
    const Points data = lamp();
    const BiarcResult r = fitBiarcs(data, options).value();
    const double most = keep ? 1e-12 : r.measures.max + 1e-9;
    EXPECT_LT((r.curve.points.front() - data.front()).norm(), most);
    EXPECT_LT((r.curve.points.back() - data.back()).norm(), most);
    EXPECT_LT(r.measures.away, 0.7);
  }
}

TEST(BiarcFit, MovingTheJointsLowersCurvatureFurther) {
  BiarcOptions options = throughOneFourSeven();
  options.goal = BiarcGoal::curvature;
  const double fixed = fitBiarcs(kSeven, options)->objective;
  options.moveJoints = true;
  const BiarcResult r = fitBiarcs(kSeven, options).value();
  EXPECT_LT(r.objective, fixed);
  EXPECT_EQ(r.curve.points[1], Vector2d(2, 6));
}

TEST(BiarcFit, StopsOnRequest) {
  std::stop_source stop;
  stop.request_stop();
  BiarcOptions options;
  options.points = 4;
  RunContext context;
  context.stop = stop.get_token();
  const Result<BiarcResult> r = fitBiarcs(lamp(), options, context);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, ErrorCode::cancelled);
}

TEST(BiarcFit, RecoversTheArcsThatMadeTheData) {
  // Three biarcs of our own, sampled without error.
  const BiarcCurve truth =
      biarcCurve({{0, 0}, {40, 25}, {90, 20}, {120, -10}}, {1.1, 0.3, -0.6, -0.9}).value();
  Points data;
  for (const CircularArc& arc : truth.arcs)
    for (int i = 0; i < 12; ++i) data.push_back(arc.pointAt(arc.length * i / 12));
  data.push_back(truth.arcs.back().end());
  BiarcOptions options;
  options.points = 4;
  const BiarcResult r = fitBiarcs(data, options).value();
  EXPECT_LT(r.measures.max, 1e-4);
}

TEST(BiarcFit, AnswersStraightDataWithStraightPieces) {
  Points line;
  for (int i = 0; i <= 10; ++i) line.emplace_back(i, 2 * i);
  BiarcOptions options;
  options.points = 3;
  const BiarcResult r = fitBiarcs(line, options).value();
  EXPECT_LT(r.measures.max, 1e-12);
  EXPECT_LT(r.measures.turning, 1e-9);
  const BiarcResult two = fitBiarcs({{0, 0}, {3, 4}}, BiarcOptions{.points = 2}).value();
  EXPECT_NEAR(two.measures.length, 5, 1e-12);
}

TEST(BiarcFit, ClosesCurves) {
  Points circle;
  for (int i = 0; i < 30; ++i)
    circle.emplace_back(5 + 3 * std::cos(2 * kPi * i / 30), 3 * std::sin(2 * kPi * i / 30));
  for (const int count : {2, 3, 5}) {
    BiarcOptions options;
    options.closed = true;
    options.points = count;
    const BiarcResult r = fitBiarcs(circle, options).value();
    EXPECT_EQ(r.curve.arcs.size(), std::size_t(2 * count));
    EXPECT_LT(r.measures.max, 1e-6);
    EXPECT_NEAR(r.measures.length, 6 * kPi, 1e-5);
    expectSmooth(r.curve);
  }
}

TEST(BiarcFit, KeepsATolerance) {
  int before = 1000;
  for (const double tolerance : {0.01, 0.1, 1.0}) {
    BiarcOptions options;
    options.closed = true;
    options.tolerance = tolerance;
    const BiarcResult r = fitBiarcs(ellipse(200), options).value();
    EXPECT_EQ(r.status, BiarcStatus::converged);
    EXPECT_LE(r.measures.max, tolerance * (1 + 1e-9));
    EXPECT_LT(int(r.curve.arcs.size()), before);
    before = int(r.curve.arcs.size());
  }
  BiarcOptions tooFew;
  tooFew.points = 2;
  tooFew.tolerance = 0.01;
  const BiarcResult r = fitBiarcs(lamp(), tooFew).value();
  EXPECT_EQ(r.status, BiarcStatus::toleranceExceeded);
  EXPECT_FALSE(r.message.empty());
}

TEST(BiarcFit, RefusesBadInputWithASentence) {
  const auto message = [](const Points& data, const BiarcOptions& options) {
    const Result<BiarcResult> r = fitBiarcs(data, options);
    EXPECT_FALSE(r);
    return r ? std::string() : r.error().message;
  };
  BiarcOptions three;
  three.points = 3;
  EXPECT_NE(message({{0, 0}, {1, NAN}, {2, 0}}, three).find("data point 1"), std::string::npos);
  EXPECT_NE(message({{1, 1}, {1, 1}, {1, 1}}, three).find("different"), std::string::npos);
  EXPECT_NE(message({}, three).find("at least 2"), std::string::npos);
  BiarcOptions index = throughOneFourSeven();
  index.indices = {0, 9};
  EXPECT_NE(message(kSeven, index).find("index 9"), std::string::npos);
  index.indices = {0, 3, 3, 6};
  EXPECT_NE(message(kSeven, index).find("coincide"), std::string::npos);
  BiarcOptions tangents = throughOneFourSeven();
  tangents.tangents = std::vector<double>{0, 1};
  EXPECT_NE(message(kSeven, tangents).find("tangent"), std::string::npos);
  EXPECT_NE(message(kSeven, BiarcOptions{}).find("how many"), std::string::npos);
}

TEST(BiarcFit, SurvivesARepeatedPointAndAReversal) {
  BiarcOptions options;
  options.points = 3;
  EXPECT_TRUE(fitBiarcs({{0, 0}, {1, 0}, {1, 0}, {2, 1}, {2, 1}}, options));
  const BiarcResult back = fitBiarcs({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {2, 0}, {1, 0}}, options).value();
  EXPECT_TRUE(std::isfinite(back.measures.length));
  expectSmooth(back.curve);
}

}  // namespace bw
