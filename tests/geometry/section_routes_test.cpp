// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The two routes of sections, traced and by OpenCASCADE's intersection, on the examples and on files that
// nobody here made.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "shapes.h"

namespace bw::geometry::test {
namespace {

constexpr double kSame = 0.01;  // mm, as promised

double apart(const PlanarCurve& a, const PlanarCurve& b) {
  double worst = 0;
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (const Eigen::Vector2d& p : from->sample(101))
      worst = std::max(worst, (to->value(to->nearestParameter(p)) - p).norm());
  return worst;
}

/// What a row finds, in words that do not hang on digits.
std::vector<std::string> kinds(const Findings& findings) {
  std::vector<std::string> result;
  for (const Finding& f : findings)
    result.push_back(std::to_string(f.cause.index()) + " at " + std::to_string(f.where.stations->first) +
                     " to " + std::to_string(f.where.stations->last));
  return result;
}

/// Expects the same stations, findings and curves; returns the number of sections.
std::size_t compare(const Target& target, CutSettings settings, const std::string& name) {
  Findings traced, kernel;
  const auto setup = resolveSetup(target, settings, traced);
  if (!setup) return 0;
  traced.clear();
  settings.route = SectionRoute::traced;
  const auto a = cutSections(target, *setup, settings, {}, traced);
  settings.route = SectionRoute::kernel;
  const auto b = cutSections(target, *setup, settings, {}, kernel);
  EXPECT_EQ(kinds(traced), kinds(kernel)) << name;
  EXPECT_EQ(a.has_value(), b.has_value()) << name;
  if (!a || !b) return 0;
  EXPECT_EQ(a->size(), b->size()) << name;
  if (a->size() != b->size()) return 0;
  std::size_t followed = 0;
  for (std::size_t i = 0; i < a->size(); ++i) {
    EXPECT_EQ((*a)[i].index, (*b)[i].index) << name;
    EXPECT_EQ((*a)[i].chosen, (*b)[i].chosen) << name;
    EXPECT_EQ((*a)[i].branches.size(), (*b)[i].branches.size()) << name;
    if ((*a)[i].chosen < 0 || (*b)[i].chosen < 0) continue;
    ++followed;
    EXPECT_LT(apart((*a)[i].curve(), (*b)[i].curve()), kSame) << name << " station " << i;
  }
  return followed;
}

class ForeignRoutes : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(BW_FOREIGN_DATA)) GTEST_SKIP() << "occt-misc is not installed";
  }
  static CadModel model(const std::string& name) {
    auto result = CadModel::read(std::string(BW_FOREIGN_DATA) + "/" + name);
    EXPECT_TRUE(result) << result.error().message;
    return std::move(*result);
  }
  /// Each face by itself but for `but`; returns the number of sections of all.
  static std::size_t everyFace(const std::string& name, int stations, const std::set<int>& but = {}) {
    const CadModel m = model(name);
    std::size_t sections = 0;
    CutSettings settings;
    settings.stations = stations;
    for (const FaceInfo& info : m.info().faceList)
      if (but.contains(info.index))
        continue;
      else if (const auto target = Target::make(m, {FaceChoice::Kind::indices, {info.index}}))
        sections += compare(*target, settings, name + " face " + std::to_string(info.index));
    return sections;
  }
};

TEST(SectionRoutes, AgreeOnTheExamples) {
  for (const Example& example : exampleList()) {
    CutSettings settings;
    settings.stations = 9;
    EXPECT_EQ(compare(exampleTarget(example.name), settings, example.name), 9u);
    settings.direction = Eigen::Vector3d(0.8, 0.6, 0);
    EXPECT_GE(compare(exampleTarget(example.name), settings, example.name + " askew"), 7u);
  }
}

TEST(SectionRoutes, KernelConfirmsTheExamples) {
  for (const Example& example : exampleList()) {
    const Target target = exampleTarget(example.name);
    CutSettings settings;
    settings.stations = 20;
    Cut cut = cutOf(target, settings);
    const std::size_t before = cut.findings.size();
    const auto anew = confirmSections(target, cut.setup, settings, {}, cut.findings);
    ASSERT_TRUE(anew) << anew.error().message;
    EXPECT_FALSE(anew->has_value()) << example.name;
    EXPECT_EQ(cut.findings.size(), before) << example.name;
  }
}

TEST_F(ForeignRoutes, AgreeOnTheShell) {
  EXPECT_GT(everyFace("occ/shell1.brep", 5), 400u);
  const auto whole = Target::make(model("occ/shell1.brep"), {FaceChoice::Kind::all, {}});
  ASSERT_TRUE(whole);
  CutSettings settings;
  settings.stations = 7;
  EXPECT_EQ(compare(*whole, settings, "shell1"), 7u);
}

TEST_F(ForeignRoutes, AgreeOnTheHammer) { EXPECT_GT(everyFace("iges/hammer.iges", 5), 150u); }
TEST_F(ForeignRoutes, AgreeOnTheLinkRods) { EXPECT_GT(everyFace("step/linkrods.step", 5), 80u); }
TEST_F(ForeignRoutes, AgreeOnTheScrew) { EXPECT_GT(everyFace("step/screw.step", 5), 15u); }
// Of the thread of the bottle, faces 1 and 3, the tracer loses a turn.
TEST_F(ForeignRoutes, AgreeOnTheBottle) { EXPECT_GT(everyFace("occ/bottle.brep", 5, {1, 3}), 100u); }

TEST_F(ForeignRoutes, KernelTakesOverWhereTracingLosesACurve) {
  const auto thread = Target::make(model("occ/bottle.brep"), {FaceChoice::Kind::indices, {1}});
  ASSERT_TRUE(thread);
  CutSettings settings;
  settings.block = BlockPlacement{{0, -8, 51.5}, {9, 16, 2}, {0, 0, 0}};
  settings.direction = Eigen::Vector3d::UnitY();
  settings.stations = 5;
  Cut cut = cutOf(*thread, settings);
  const auto anew = confirmSections(*thread, cut.setup, settings, {}, cut.findings);
  ASSERT_TRUE(anew) << anew.error().message;
  ASSERT_TRUE(anew->has_value());
  const auto followed =
      std::ranges::count_if(**anew, [](const Section& section) { return section.chosen >= 0; });
  EXPECT_LT(followed, std::ssize(cut.sections));
  const auto differs = std::ranges::find_if(
      cut.findings, [](const Finding& f) { return std::holds_alternative<SectionDiffers>(f.cause); });
  ASSERT_NE(differs, cut.findings.end());
  const auto& cause = std::get<SectionDiffers>(differs->cause);
  EXPECT_TRUE(cause.taken);
  EXPECT_GT(cause.kernel, cause.traced);
  EXPECT_EQ(differs->severity, Severity::warning);
  EXPECT_TRUE(std::ranges::any_of(
      cut.findings, [](const Finding& f) { return std::holds_alternative<SectionBranches>(f.cause); }));
  // By the kernel alone it is the same row.
  settings.route = SectionRoute::kernel;
  EXPECT_EQ(std::ssize(cutOf(*thread, settings).sections), followed);
}

TEST_F(ForeignRoutes, SmallDifferencesOfLongSectionsAreTold) {
  // Ten metres of terrain: of a few places a section none shows that the routes lie up to 0.2 mm apart.
  const auto terrain = Target::make(model("occ/terrain.brep"), {FaceChoice::Kind::all, {}});
  ASSERT_TRUE(terrain);
  CutSettings settings;
  settings.direction = Eigen::Vector3d::UnitY();
  settings.stations = 10;
  Cut cut = cutOf(*terrain, settings);
  const auto anew = confirmSections(*terrain, cut.setup, settings, {}, cut.findings);
  ASSERT_TRUE(anew) << anew.error().message;
  settings.route = SectionRoute::kernel;
  const Cut kernel = cutOf(*terrain, settings);
  double worst = 0;
  for (std::size_t i = 0; i < cut.sections.size(); ++i)
    worst = std::max(worst, apart(cut.sections[i].curve(), kernel.sections[i].curve()));
  const bool told = std::ranges::any_of(
      cut.findings, [](const Finding& f) { return std::holds_alternative<SectionDiffers>(f.cause); });
  EXPECT_EQ(told, worst > kSame) << worst;
}

TEST_F(ForeignRoutes, AgreeOnPlaneFaces) {
  EXPECT_GT(everyFace("occ/face.brep", 9), 0u);
  EXPECT_GT(everyFace("occ/face2.brep", 9), 0u);
}

TEST_F(ForeignRoutes, AgreeOnTheTerrain) {
  const auto target = Target::make(model("occ/terrain.brep"), {FaceChoice::Kind::indices, {0}});
  ASSERT_TRUE(target);
  CutSettings settings;
  settings.stations = 3;
  settings.block = BlockPlacement{{84500, 84000, 10000}, {1200, 800, 500}, {0, 0, 0}};
  EXPECT_EQ(compare(*target, settings, "terrain"), 3u);
}

}  // namespace
}  // namespace bw::geometry::test
