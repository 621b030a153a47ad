// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A façade in one file: ten thousand faces that share their edges.

#include <sys/resource.h>

#include <array>
#include <cmath>

#include "step_parts.h"

namespace bw::geometry::test {
namespace {

constexpr double kPanel = 500;  // mm

double height(double x, double y) { return 4000 * std::sin(x / 20000) * std::cos(y / 15000); }

std::string number(int id) { return "#" + std::to_string(id); }

/// A shell of n × n bi-cubic faces over a wavy surface.
std::string facade(int n) {
  StepText step;
  const auto at = [](double i, double j) {
    return Eigen::Vector3d(kPanel * i, kPanel * j, height(kPanel * i, kPanel * j));
  };
  // Poles of a cubic through a row of four points, at even parameters.
  const auto poles = [](const std::array<Eigen::Vector3d, 4>& p) {
    return std::array<Eigen::Vector3d, 4>{p[0], (-5 * p[0] + 18 * p[1] - 9 * p[2] + 2 * p[3]) / 6,
                                          (2 * p[0] - 9 * p[1] + 18 * p[2] - 5 * p[3]) / 6, p[3]};
  };
  const std::vector<double> knots = {0, 0, 0, 0, 1, 1, 1, 1};
  std::vector<int> vertices, along, across;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) vertices.push_back(step.vertex(at(i, j)));
  }
  const auto vertex = [&](int i, int j) { return vertices[std::size_t(j) * (n + 1) + i]; };
  const auto curve = [&](int i, int j, int di, int dj) {
    std::array<Eigen::Vector3d, 4> p;
    for (int k = 0; k < 4; ++k) p[k] = at(i + di * k / 3.0, j + dj * k / 3.0);
    const auto q = poles(p);
    const int spline = step.splineCurve(3, knots, std::vector<Eigen::Vector3d>(q.begin(), q.end()));
    return step.edge(vertex(i, j), vertex(i + di, j + dj), spline);
  };
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i < n; ++i) along.push_back(curve(i, j, 1, 0));
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i <= n; ++i) across.push_back(curve(i, j, 0, 1));
  }
  std::string faces;
  std::string file;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      SplineSurface surface;
      surface.degreeU = surface.degreeV = 3;
      surface.polesU = surface.polesV = 4;
      surface.knotsU = surface.knotsV = knots;
      std::array<std::array<Eigen::Vector3d, 4>, 4> rows;  // by v, poles in u
      for (int b = 0; b < 4; ++b) {
        for (int a = 0; a < 4; ++a) rows[b][a] = at(i + a / 3.0, j + b / 3.0);
        rows[b] = poles(rows[b]);
      }
      surface.poles.resize(16);
      for (int a = 0; a < 4; ++a) {
        const auto column = poles({rows[0][a], rows[1][a], rows[2][a], rows[3][a]});
        for (int b = 0; b < 4; ++b) surface.poles[std::size_t(b) * 4 + a] = column[b];
      }
      const int spline = step.splineSurface(surface);
      const std::vector<StepText::Side> sides = {{along[std::size_t(j) * n + i], true},
                                                 {across[std::size_t(j) * (n + 1) + i + 1], true},
                                                 {along[std::size_t(j + 1) * n + i], false},
                                                 {across[std::size_t(j) * (n + 1) + i], false}};
      if (i == n - 1 && j == n - 1) {
        file = step.file({step.shell(spline, sides, "facade")}, "facade");
        continue;
      }
      std::string loop;
      for (const auto& side : sides)
        loop += (loop.empty() ? "" : ",") + number(step.add("ORIENTED_EDGE('',*,*," + number(side.edge) +
                                                            (side.forward ? ",.T.)" : ",.F.)")));
      const int bound =
          step.add("FACE_OUTER_BOUND(''," + number(step.add("EDGE_LOOP('',(" + loop + "))")) + ",.T.)");
      faces += number(step.add("ADVANCED_FACE('',(" + number(bound) + ")," + number(spline) + ",.T.)")) + ",";
    }
  }
  return replaced(file, "OPEN_SHELL('facade',(", "OPEN_SHELL('facade',(" + faces);
}

double peakMegabytes(int who) {
  rusage usage = {};
  ::getrusage(who, &usage);
  return double(usage.ru_maxrss) / 1024;
}

TEST(LargeFile, TenThousandFacesAreReadInLessThanOneAndAHalfGigabytes) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer needs memory of its own";
#endif
  const std::string step = facade(100);
  const auto model = CadModel::readBytes(step, "facade.step");
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->info().faces, 10000);
  EXPECT_EQ(model->info().edges, 2 * 100 * 101);
  EXPECT_EQ(model->info().groups.size(), 1u);
  EXPECT_EQ(model->info().faceList[0].name, "facade");
  // The program and the process that reads for it, each at its peak, though the peaks are not at one time.
  EXPECT_LT(peakMegabytes(RUSAGE_SELF) + peakMegabytes(RUSAGE_CHILDREN), 1500);
}

}  // namespace
}  // namespace bw::geometry::test
