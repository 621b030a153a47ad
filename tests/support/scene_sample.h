// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>

#include <cmath>

#include "bw/core/base/units.h"
#include "bw/scene/scene.h"

namespace bw::test {

/// How fine a sample scene is, and how far its cut surface misses its target.
struct SceneSample {
  int stations = 30;
  int rowsBetween = 3;  ///< rows of the cut surface from a station to the next, less one
  int columns = 80;
  double error = 4;  ///< mm, largest deviation
};

/// Height (mm) of the wavy sample panel, 600 mm along x (the blade) and 670 mm along y (the cutting
/// direction).
inline double panelHeight(double x, double y) {
  return 120 + 45 * std::sin(x * 0.0105 + 0.4) * std::cos(y * 0.0061) + 22 * std::cos(x * 0.004 - y * 0.0078);
}

/// Signed miss (mm) of the sample's cut surface at a place of the panel.
inline double panelMiss(double x, double y, double error) {
  return error * std::sin(x / 600 * 6.0) * std::sin(y / 670 * 5.0 + 0.3);
}

/// A panel, its target 30 mm wider all around, stations, blades that run on straight beyond the foam, and the
/// block.
inline scene::Content sampleContent(const SceneSample& sample = {}) {
  constexpr double kWidth = 600, kDepth = 670;
  TriangleMesh target;
  const int nx = 90, ny = 100;
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      const double x = -30 + (kWidth + 60) * i / nx, y = -30 + (kDepth + 60) * j / ny, h = 1e-3;
      const double dx = (panelHeight(x + h, y) - panelHeight(x - h, y)) / (2 * h),
                   dy = (panelHeight(x, y + h) - panelHeight(x, y - h)) / (2 * h);
      target.points.emplace_back(x, y, panelHeight(x, y));
      target.normals.push_back(Eigen::Vector3d(-dx, -dy, 1).normalized());
      if (i < nx && j < ny) {
        const int a = j * (nx + 1) + i, b = a + 1, c = b + nx + 1, d = c - 1;
        target.triangles.push_back({a, b, c});
        target.triangles.push_back({a, c, d});
      }
    }
  }
  const auto cutPoint = [&](double x, double y) {
    return Eigen::Vector3d(x, y, panelHeight(x, y) + panelMiss(x, y, sample.error));
  };
  scene::CutSurface surface;
  SurfaceGrid& cut = surface.grid;
  cut.rows = (sample.stations - 1) * (sample.rowsBetween + 1) + 1;
  cut.columns = sample.columns;
  cut.fields = {{"deviation", "Deviation", "mm", {}},       {"angle", "Cutting angle", "\u00b0", {}},
                {"speed", "Blade speed", "mm/s", {}},       {"relative_speed", "Relative speed", "", {}},
                {"curvature", "Curvature / limit", "", {}}, {"stress", "Bending stress", "N/mm²", {}},
                {"certainty", "Certainty", "", {}}};
  surface.limits = {{"curvature", 1.0}, {"stress", 417.0}};
  for (int r = 0; r < cut.rows; ++r) {
    for (int c = 0; c < cut.columns; ++c) {
      const double x = kWidth * c / (cut.columns - 1), y = kDepth * r / (cut.rows - 1);
      cut.points.push_back(cutPoint(x, y));
      cut.fields[0].values.push_back(panelMiss(x, y, sample.error));
      cut.fields[1].values.push_back(4 + 24 * std::abs(std::sin(x * 0.006 + y * 0.005)));
      cut.fields[2].values.push_back(2.6 - 1.9 * std::pow(std::sin(x / kWidth * kPi), 2) *
                                               std::pow(std::cos(y / kDepth * kPi), 2));
      cut.fields[3].values.push_back(cut.fields[2].values.back() / 2.6);
      cut.fields[4].values.push_back(0.15 + 0.65 * std::pow(std::sin(x * 0.0105 + 0.4), 2) *
                                                (0.4 + 0.6 * y / kDepth));
      cut.fields[5].values.push_back(417 * cut.fields[4].values.back());
      cut.fields[6].values.push_back(y > 0.9 * kDepth ? 0 : y > 0.5 * kDepth ? 2 : 3);  // lost, held, certain
    }
  }
  scene::Stations stations;
  scene::Blades blades;
  for (int s = 0; s < sample.stations; ++s) {
    const double y = kDepth * s / (sample.stations - 1);
    std::vector<Eigen::Vector3d> station, blade;
    for (int c = 0; c < sample.columns; ++c)
      station.push_back(cutPoint(kWidth * c / (sample.columns - 1), y));
    const Eigen::Vector3d left = (station[0] - station[1]).normalized(),
                          right = (station.back() - station[station.size() - 2]).normalized();
    for (int k = 12; k > 0; --k) blade.push_back(station.front() + 15.0 * k * left);
    blade.insert(blade.end(), station.begin(), station.end());
    for (int k = 1; k <= 12; ++k) blade.push_back(station.back() + 15.0 * k * right);
    stations.lines.push_back(station);
    blades.lines.push_back(blade);
  }
  Box block;
  block.frame.origin = {-10, -10, 0};
  block.size = {620, 690, 220};
  constexpr scene::ItemId kBlock{0}, kRow{0, 0, 0};
  return {{{{}, target}, {kRow, surface}, {kRow, stations}, {kRow, blades}, {kBlock, block}}};
}

}  // namespace bw::test
