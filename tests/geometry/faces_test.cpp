// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Units, seams, names, groups: how the faces of a file are taken and chosen.

#include <cmath>
#include <numbers>

#include "step_parts.h"

namespace bw::geometry::test {
namespace {

CadModel read(const std::string& step, const ReadOptions& options) {
  auto model = CadModel::readBytes(step, "test.step", {}, options);
  EXPECT_TRUE(model) << model.error().message;
  return std::move(*model);
}

bool tells(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

std::vector<int> chosen(const CadModel& model, const FaceChoice& choice) {
  const auto faces = model.choose(choice);
  EXPECT_TRUE(faces) << faces.error().message;
  return faces ? *faces : std::vector<int>();
}

TEST(Unit, NumbersOfTheFileAreTakenInTheUnitAskedFor) {
  const std::string step = exampleStep("saddle").value();  // 600 wide, states mm
  const std::string metres = replaced(step, "SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT($,.METRE.)");
  for (const auto& [unit, width] : {std::pair(LengthUnit::mm, 600.0),
                                    {LengthUnit::cm, 6000.0},
                                    {LengthUnit::m, 600e3},
                                    {LengthUnit::inch, 15240.0}}) {
    for (const std::string& file : {step, metres}) {
      const CadModel model = read(file, {unit});
      EXPECT_NEAR(model.info().bounds.size().x(), width, 1e-9 * width);
      EXPECT_EQ(model.info().readAs, lengthUnitName(unit));
      EXPECT_NEAR(model.info().faceList[0].area,
                  modelOf(step).info().faceList[0].area * std::pow(width / 600, 2), 1e-6 * width * width);
    }
  }
  EXPECT_EQ(read(metres, {LengthUnit::mm}).info().unit, "m");
  EXPECT_EQ(modelOf(metres).info().readAs, "m");
}

TEST(Unit, NamesAndOrderOfFacesSurviveIt) {
  const CadModel model = read(threeFaces(), {LengthUnit::inch});
  ASSERT_EQ(model.info().faces, 3);
  EXPECT_EQ(model.info().faceList[0].name, "hill");
  EXPECT_EQ(model.info().faceList[2].name, "tile");
  EXPECT_EQ(model.info().faceList[2].type, "plane");
}

/// Two bent sheets beside one another with a gap between them, the right one 300 mm wide.
std::string twoSheets(double gap, double step = 0) {
  const auto sheet = [&](double from, double width, double lift) {
    return [=](double u, double v) {
      const double x = from + width * u;
      return Eigen::Vector3d(x, 400 * v, lift + 50 * std::sin(x / 200));
    };
  };
  return mergedStep({patch("left", sheet(0, 500, 0)), patch("right", sheet(500 + gap, 300, step))});
}

TEST(Sewing, ClosesGapsWithinItsToleranceAndNamesTheWidest) {
  const CadModel model = read(twoSheets(0.06), {{}, 0.1});
  EXPECT_EQ(model.info().edges, 7);
  EXPECT_TRUE(tells(model.info().healing, "2 separate faces were sewn together")) << model.info().healing[0];
  EXPECT_TRUE(tells(model.info().healing, "widest gap was 0.06")) << model.info().healing[0];
  EXPECT_EQ(model.info().faceList[0].name, "left");
  EXPECT_EQ(model.info().faceList[1].name, "right");
  EXPECT_EQ(model.info().groups.size(), 1u);
}

TEST(Sewing, OfZeroJoinsNothing) {
  const auto half = [](double from) {
    return patch("", [from](double u, double v) { return Eigen::Vector3d(from + 100 * u, 80 * v, 0); });
  };
  const std::string step = mergedStep({half(0), half(100)});
  EXPECT_TRUE(read(step, {{}, 0}).info().healing.empty());
  EXPECT_FALSE(read(step, {{}, 0.1}).info().healing.empty());
}

TEST(Sewing, LeavesWiderGapsOpenAndNamesThem) {
  const CadModel model = read(twoSheets(0.4), {{}, 0.1});
  EXPECT_EQ(model.info().edges, 8);
  ASSERT_EQ(model.info().healing.size(), 1u);
  EXPECT_TRUE(tells(model.info().healing, "a gap of 0.408 mm between faces 0 and 1 stays open"))
      << model.info().healing[0];
  EXPECT_EQ(read(twoSheets(0.4), {{}, 0.5}).info().edges, 7);
  EXPECT_EQ(read(twoSheets(0.06), {{}, 0}).info().edges, 8);
}

TEST(Sewing, TakesNoNarrowFaceForAGap) {
  const auto strip = [](double from, double to) {
    return patch("", [=](double u, double v) { return Eigen::Vector3d(from + (to - from) * u, 400 * v, 0); });
  };
  // Each a face beside the next one, without a gap; the narrow ones end in edges of half a mm and less.
  const CadModel model = read(mergedStep({strip(0, 300), strip(300, 300.5), strip(300.5, 600)}), {{}, 0.1});
  for (const std::string& line : model.info().healing)
    EXPECT_EQ(line.find("stays open"), std::string::npos) << line;
  const CadModel outer = read(mergedStep({strip(0, 300), strip(300, 300.4)}), {{}, 0.1});
  for (const std::string& line : outer.info().healing)
    EXPECT_EQ(line.find("stays open"), std::string::npos) << line;
}

TEST(Sewing, NamesNoGapWiderThanTenMillimetres) {
  const CadModel near = read(twoSheets(9), {{}, 2});
  ASSERT_FALSE(near.info().healing.empty());
  EXPECT_TRUE(tells(near.info().healing, "a gap of 9.18 mm between faces 0 and 1 stays open"))
      << near.info().healing[0];
  EXPECT_TRUE(read(twoSheets(11), {{}, 2}).info().healing.empty());
}

TEST(Names, AreThoseOfStepAndOfTheShellWhereAFaceHasNone) {
  std::string step = threeFaces();
  EXPECT_EQ(modelOf(step).info().faceList[1].name, "gutter");
  step = replaced(step, "ADVANCED_FACE('hill'", "ADVANCED_FACE(''");
  step = replaced(step, "OPEN_SHELL('hill'", "OPEN_SHELL('the \\X2\\00C6\\X0\\sc''hill'");
  EXPECT_EQ(modelOf(step).info().faceList[0].name, "the Æsc'hill");
}

TEST(Choice, FacesAreChosenByName) {
  const CadModel model = modelOf(threeFaces());
  EXPECT_EQ(chosen(model, {.kind = FaceChoice::Kind::named, .names = {"gutter"}}), (std::vector<int>{1}));
  EXPECT_EQ(chosen(model, {.kind = FaceChoice::Kind::named, .names = {"tile", "hill"}}),
            (std::vector<int>{2, 0}));
  const auto wrong = model.choose({.kind = FaceChoice::Kind::named, .names = {"guter"}});
  expectError(wrong, ErrorCode::badInput, "\"hill\", \"gutter\", \"tile\"");
  EXPECT_NE(wrong.error().message.find("did you mean \"gutter\"?"), std::string::npos);
  expectError(model.choose({.kind = FaceChoice::Kind::named, .names = {"larges"}}), ErrorCode::badInput,
              "did you mean \"largest\"?");
}

TEST(Choice, SliversOfANameAreLeftOutAndTold) {
  const auto strip = [](double from, double width) {
    return patch("side", [=](double u, double v) { return Eigen::Vector3d(from + width * u, 80 * v, 0); });
  };
  const CadModel model = modelOf(mergedStep({strip(0, 100), strip(200, 0.004)}));
  FaceChoice choice{FaceChoice::Kind::named};
  choice.names = {"side", "side"};
  Findings findings;
  const auto target = Target::make(model, choice, &findings);
  ASSERT_TRUE(target) << target.error().message;
  EXPECT_EQ(target->faces().size(), 1u) << "and each once";
  ASSERT_FALSE(findings.empty());
  const auto* left = std::get_if<FacesLeftOut>(&findings.back().cause);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->count, 1);
  EXPECT_EQ(left->width, 0.01);
  const CadModel sliver = modelOf(mergedStep({strip(0, 0.004)}));
  expectError(Target::make(sliver, choice), ErrorCode::badInput, "face 0 of test.step is only");
}

TEST(Choice, NearestIsTheFaceNearestToThePointNotToItsBox) {
  const CadModel model = modelOf(threeFaces());
  const auto near = [&](const Eigen::Vector3d& p) {
    return chosen(model, {.kind = FaceChoice::Kind::nearest, .point = p});
  };
  EXPECT_EQ(near({200, 150, 100}), (std::vector<int>{0}));
  EXPECT_EQ(near({600, 150, -150}), (std::vector<int>{1}));
  EXPECT_EQ(near({450, 400, -490}), (std::vector<int>{2}));
  EXPECT_EQ(near({1e6, 1e6, -500}), (std::vector<int>{2}));
  Findings findings;
  ASSERT_TRUE(model.choose({.kind = FaceChoice::Kind::nearest, .point = {450, 400, -490}}, &findings));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].severity, Severity::info);
  const auto* nearest = std::get_if<NearestFace>(&findings[0].cause);
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->face.index, 2);
  EXPECT_EQ(nearest->face.name, "tile");
  EXPECT_NEAR(nearest->distance, 10, 1e-6);
}

TEST(Choice, LargestPrefersWhatIsBentAndSaysWhatItTook) {
  Findings findings;
  const CadModel model = modelOf(threeFaces());
  const auto faces = model.choose({}, &findings);
  ASSERT_TRUE(faces);
  EXPECT_EQ(*faces, (std::vector<int>{0}));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].severity, Severity::warning) << "there are others, and no solid";
  const auto* largest = std::get_if<LargestFace>(&findings[0].cause);
  ASSERT_TRUE(largest && largest->larger);
  EXPECT_EQ(largest->face.name, "hill");
  EXPECT_EQ(largest->faces, 3);
  EXPECT_EQ(largest->larger->index, 2);
  EXPECT_EQ(largest->larger->type, "plane");
  EXPECT_NEAR(largest->left, model.info().faceList[1].area + model.info().faceList[2].area, 1e-6);
  // Where there are planes alone, the largest is one; a file of one face says nothing.
  findings.clear();
  const auto planes =
      modelOf(mergedStep({planeFace("a", 100, 100, 0), planeFace("b", 300, 100, 50)})).choose({}, &findings);
  EXPECT_EQ(planes.value(), (std::vector<int>{1}));
  EXPECT_EQ(findings.size(), 1u);
  findings.clear();
  ASSERT_TRUE(modelOf(planeFace("a", 100, 100, 0)).choose({}, &findings));
  EXPECT_TRUE(findings.empty());
}

/// A slab: its top in two faces that join smoothly, its underside, and two ends.
std::string slab() {
  const auto top = [](double x, double y) { return Eigen::Vector3d(x, y, 100 + 30 * std::sin(x / 150)); };
  return mergedStep(
      {patch("top", [&](double u, double v) { return top(500 * u, 500 * v); }),
       patch("top", [&](double u, double v) { return top(500 + 300 * u, 500 * v); }),
       patch("under", [](double u, double v) { return Eigen::Vector3d(800 * u, 500 - 500 * v, 0); }),
       patch("end", [&](double u, double v) { return Eigen::Vector3d(0, 500 - 500 * u, v * top(0, 0).z()); }),
       patch("end", [&](double u, double v) { return Eigen::Vector3d(800, 500 * u, v * top(800, 0).z()); })});
}

TEST(Groups, AreFacesThatJoinSmoothly) {
  const CadModel model = read(slab(), {{}, 0.01});
  const auto& groups = model.info().groups;
  ASSERT_EQ(groups.size(), 4u);
  EXPECT_EQ(groups[0].faces, (std::vector<int>{0, 1}));
  EXPECT_GT(groups[0].area, groups[1].area);
  EXPECT_EQ(groups[1].faces, (std::vector<int>{2}));
  EXPECT_EQ(model.info().faceList[1].group, 0);
  EXPECT_EQ(chosen(model, {.kind = FaceChoice::Kind::group, .group = 0}), (std::vector<int>{0, 1}));
  expectError(model.choose({.kind = FaceChoice::Kind::group, .group = 4}), ErrorCode::badInput,
              "4 groups, 0 to 3");
}

TEST(Info, TellsHowAFaceIsBentAndHowTightly) {
  const CadInfo info = modelOf(threeFaces()).infoInFull().value();
  EXPECT_EQ(info.faceList[0].curved, "doubly");
  EXPECT_EQ(info.faceList[1].curved, "singly");
  EXPECT_NEAR(info.faceList[1].minRadius, 200, 3);
  EXPECT_EQ(info.faceList[2].curved, "flat");
  EXPECT_EQ(info.faceList[2].minRadius, 0);
  // A sheet that rises by less than the tolerance over its length is flat, one by more is not.
  const auto arched = [](double rise) {
    return modelOf(
               patch("", [=](double u,
                             double v) { return Eigen::Vector3d(300 * u, 400 * v, 4 * rise * u * (1 - u)); }))
        .infoInFull()
        .value()
        .faceList[0]
        .curved;
  };
  EXPECT_EQ(arched(0.5 * kCurvedTolerance * 9 / 25), "flat");
  EXPECT_EQ(arched(2 * kCurvedTolerance), "singly");
}

TEST(Info, SectionsAreThoseOfTheMainDirections) {
  const CadInfo info = modelOf(exampleStep("sphere-cap").value()).infoInFull().value();
  const auto& sections = info.faceList[0].sections;
  ASSERT_EQ(sections.size(), 2u);
  EXPECT_NEAR(std::abs(sections[0].direction.dot(sections[1].direction)), 0, 1e-12);
  // Arcs over a chord of 600: of radius 900 through the middle, of the smallest radius along the borders.
  const double border = std::sqrt(900.0 * 900 - 300 * 300);
  for (const FaceSections& s : sections) {
    EXPECT_NEAR(s.shortest, 2 * 900 * std::asin(300.0 / 900), 0.05);
    EXPECT_NEAR(s.longest, 2 * border * std::asin(300.0 / border), 0.05);
    EXPECT_NEAR(s.minRadius, border, 2);
  }
}

}  // namespace
}  // namespace bw::geometry::test
