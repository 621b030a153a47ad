// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The sample data of Debian's occt-misc: files that nobody here made.

#include <algorithm>
#include <filesystem>

#include "bw/core/files/file_set.h"
#include "shapes.h"

namespace bw::geometry::test {
namespace {

class ForeignFiles : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(BW_FOREIGN_DATA)) GTEST_SKIP() << "occt-misc is not installed";
  }
  static Result<CadModel> read(const std::string& name) {
    return CadModel::read(std::string(BW_FOREIGN_DATA) + "/" + name);
  }
  static CadModel model(const std::string& name) {
    auto result = read(name);
    EXPECT_TRUE(result) << result.error().message;
    return std::move(*result);
  }
  static Target face(const std::string& name, int index) {
    auto target = Target::make(model(name), {FaceChoice::Kind::indices, {index}});
    EXPECT_TRUE(target) << target.error().message;
    return std::move(*target);
  }
  static double deviation(const Target& target, const std::vector<Section>& sections) {
    const auto sampler = target.sampler();
    double worst = 0;
    for (const Section& s : sections) {
      if (s.chosen < 0) continue;
      for (const Eigen::Vector2d& q : s.curve().sample(101)) {
        const Eigen::Vector3d p = s.frame.toWorld(q);
        worst = std::max(worst, std::abs(sampler->offset(p, *sampler->closest(p, nullptr))));
      }
    }
    return worst;
  }
  /// Every face gives sections, or says why not; those it gives lie on it, or on the surface continued across
  /// its holes.
  static void everyFace(const std::string& name, int stations, int least) {
    const CadModel m = model(name);
    int good = 0;
    for (const FaceInfo& info : m.info().faceList) {
      const auto target = Target::make(m, {FaceChoice::Kind::indices, {info.index}});
      if (!target) {
        EXPECT_FALSE(target.error().message.empty());
        continue;
      }
      CutSettings settings;
      settings.stations = stations;
      Findings findings;
      const auto setup = resolveSetup(*target, settings, findings);
      ASSERT_TRUE(setup) << name << " face " << info.index << ": " << setup.error().message;
      const auto sections = cutSections(*target, *setup, settings, {}, findings);
      if (!sections) {
        EXPECT_FALSE(sections.error().message.empty());
        continue;
      }
      // The borders of a large model meet only within its own tolerance (the hammer is 39 m long and sewn
      // within 0.01 mm).
      const double size = (m.info().bounds.max - m.info().bounds.min).norm();
      EXPECT_LT(deviation(*target, *sections), std::max(2e-3, 1e-6 * size)) << name << " face " << info.index;
      ++good;
    }
    EXPECT_GE(good, least) << name;
  }
};

TEST_F(ForeignFiles, AreReadWithTheirCounts) {
  struct Known {
    const char* name;
    const char* format;
    int solids, faces;
  };
  for (const Known& k : {Known{"occ/terrain.brep", "BREP", 0, 1}, Known{"occ/shell1.brep", "BREP", 0, 99},
                         Known{"iges/hammer.iges", "IGES", 0, 45}, Known{"step/linkrods.step", "STEP", 1, 37},
                         Known{"step/screw.step", "STEP", 1, 10}, Known{"occ/bottle.brep", "BREP", 1, 71}}) {
    const CadModel m = model(k.name);
    EXPECT_EQ(m.info().format, k.format) << k.name;
    EXPECT_EQ(m.info().solids, k.solids) << k.name;
    EXPECT_EQ(m.info().faces, k.faces) << k.name;
    EXPECT_EQ(m.info().faceList.size(), std::size_t(k.faces)) << k.name;
    for (const FaceInfo& f : m.info().faceList) {
      EXPECT_TRUE(f.bounds.valid()) << k.name;
      EXPECT_GT(f.area, 0) << k.name;
    }
  }
}

TEST_F(ForeignFiles, UnitsAreTold) {
  EXPECT_EQ(model("occ/terrain.brep").info().unit, "mm (assumed)");
  EXPECT_EQ(model("step/linkrods.step").info().unit, "mm");
  EXPECT_EQ(model("iges/hammer.iges").info().unit, "mm");
}

TEST_F(ForeignFiles, LooseFacesAreSewnAndThatIsReported) {
  const auto healing = model("iges/hammer.iges").info().healing;
  ASSERT_FALSE(healing.empty());
  EXPECT_NE(healing.front().find("45 separate faces were sewn"), std::string::npos);
}

TEST_F(ForeignFiles, AsahiHasNoFacesAndSaysSo) {
  expectError(read("occ/asahi.brep"), ErrorCode::badInput, "holds no faces, only 2828 edges");
}

TEST_F(ForeignFiles, TruncatedOnesAreRefused) {
  for (const char* name : {"occ/terrain.brep", "occ/shell1.brep", "iges/hammer.iges", "step/linkrods.step"}) {
    const std::string bytes = readFile(std::string(BW_FOREIGN_DATA) + "/" + name).value();
    for (const double part : {0.1, 0.35, 0.62, 0.9, 0.995}) {
      const auto cut = CadModel::readBytes(bytes.substr(0, std::size_t(part * double(bytes.size()))), name);
      ASSERT_FALSE(cut) << name << " " << part;
      EXPECT_EQ(cut.error().code, ErrorCode::cannotRead) << cut.error().message;
    }
  }
}

TEST_F(ForeignFiles, TerrainThroughABlockPlacedInIt) {
  const Target target = face("occ/terrain.brep", 0);
  CutSettings settings;
  settings.block = BlockPlacement{{84500, 84000, 10000}, {1200, 800, 500}, {0, 0, 0}};
  const Cut cut = cutOf(target, settings);
  EXPECT_NEAR((cut.setup.planes.direction() - Eigen::Vector3d::UnitX()).norm(), 0, 1e-12);
  ASSERT_EQ(cut.sections.size(), 60u);
  // It goes on past the block: the row ends in its faces.
  EXPECT_NEAR(cut.sections.front().travel, 0, 1e-6);
  EXPECT_NEAR(cut.sections.back().travel, 1200, 1e-6);
  EXPECT_LT(deviation(target, cut.sections), 1e-3);
  for (const Section& s : cut.sections) {
    for (const double t : {s.curve().start(), s.curve().end()}) {
      const Eigen::Vector3d p = cut.setup.block.frame.toLocal(s.frame.toWorld(s.curve().value(t)));
      EXPECT_NEAR(std::min({p.y(), 800 - p.y(), p.z(), 500 - p.z()}), 0, 1e-4);
    }
  }
}

TEST_F(ForeignFiles, ShellIsCutAcrossAllItsFaces) {
  const auto target = Target::make(model("occ/shell1.brep"), {FaceChoice::Kind::all, {}});
  ASSERT_TRUE(target);
  CutSettings settings;
  settings.stations = 20;
  const Cut cut = cutOf(*target, settings);
  EXPECT_EQ(cut.sections.size(), 20u);
  EXPECT_LT(deviation(*target, cut.sections), 1e-3);
}

TEST_F(ForeignFiles, FacesOfTheShellAreCutOneByOne) { everyFace("occ/shell1.brep", 8, 90); }
TEST_F(ForeignFiles, FacesOfTheHammerAreCutOneByOne) { everyFace("iges/hammer.iges", 8, 38); }
TEST_F(ForeignFiles, FacesOfTheLinkRodsAreCutOneByOne) { everyFace("step/linkrods.step", 8, 20); }
TEST_F(ForeignFiles, FacesOfTheScrewAreCutOneByOne) { everyFace("step/screw.step", 8, 4); }

TEST_F(ForeignFiles, MeshesShowEveryFace) {
  for (const char* name : {"occ/shell1.brep", "iges/hammer.iges", "step/linkrods.step", "occ/terrain.brep"}) {
    const auto target = Target::make(model(name), {FaceChoice::Kind::all, {}});
    ASSERT_TRUE(target);
    const auto mesh = target->mesh();
    ASSERT_TRUE(mesh) << mesh.error().message;
    double area = 0;
    for (const auto& t : mesh->triangles) {
      area += 0.5 *
              (mesh->points[t[1]] - mesh->points[t[0]]).cross(mesh->points[t[2]] - mesh->points[t[0]]).norm();
    }
    EXPECT_NEAR(area, target->area(), 0.01 * target->area()) << name;
  }
}

}  // namespace
}  // namespace bw::geometry::test
