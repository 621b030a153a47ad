// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <string>

#include "bw/core/surface/spline_surface.h"
#include "bw/geometry/cad_model.h"
#include "bw/geometry/export.h"
#include "bw/geometry/sections.h"

namespace bw::geometry::test {

/// A bi-cubic spline through a grid of points of `f` over [0, 1]², as STEP.
inline std::string stepOf(const std::function<Eigen::Vector3d(double, double)>& f, int rows = 25,
                          int columns = 25) {
  SurfaceGrid grid;
  grid.rows = rows;
  grid.columns = columns;
  std::vector<double> v;
  for (int r = 0; r < rows; ++r) {
    v.push_back(double(r) / (rows - 1));
    for (int c = 0; c < columns; ++c) grid.points.push_back(f(double(c) / (columns - 1), v.back()));
  }
  const auto surface = loft(grid, v);
  EXPECT_TRUE(surface) << surface.error().message;
  return stepText(*surface, "test").value();
}

inline CadModel modelOf(const std::string& step) {
  auto model = CadModel::readBytes(step, "test.step");
  EXPECT_TRUE(model) << model.error().message;
  return std::move(*model);
}

inline Target targetOf(const std::string& step, const FaceChoice& choice = {}) {
  auto target = Target::make(modelOf(step), choice);
  EXPECT_TRUE(target) << target.error().message;
  return std::move(*target);
}

inline Target exampleTarget(const std::string& name) { return targetOf(exampleStep(name).value()); }

/// What a test asks of the sections of a target.
struct CutSettings {
  std::optional<BlockPlacement> block;
  std::optional<Eigen::Vector3d> direction;
  int stations = 60;
  std::optional<double> spacing;
  SectionRoute route = SectionRoute::automatic;

  operator SetupRequest() const { return {block, direction}; }            // NOLINT
  operator SectionRequest() const { return {stations, spacing, route}; }  // NOLINT
};

/// Sections of a target; fails the test on an error.
struct Cut {
  Setup setup;
  std::vector<Section> sections;
  Findings findings;
};

inline Cut cutOf(const Target& target, const CutSettings& settings, int threads = 0) {
  Cut cut;
  auto setup = resolveSetup(target, settings, cut.findings);
  EXPECT_TRUE(setup) << setup.error().message;
  cut.setup = *setup;
  RunContext context;
  context.threads = threads;
  auto sections = cutSections(target, cut.setup, settings, context, cut.findings);
  EXPECT_TRUE(sections) << sections.error().message;
  if (sections)
    std::ranges::copy_if(*sections, std::back_inserter(cut.sections),
                         [](const Section& s) { return s.chosen >= 0; });
  return cut;
}

/// Checks what is true of every error: it has the code, names what it must, and reads as one sentence.
template <class T>
void expectError(const Result<T>& result, ErrorCode code, const std::string& part) {
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, code) << result.error().message;
  EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message;
  EXPECT_EQ(result.error().message.find('\n'), std::string::npos) << result.error().message;
}

}  // namespace bw::geometry::test
