// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What the workshop gets of a design: its drawings and its cut list.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "../drawings/pdf_text.h"
#include "bw/core/files/fingerprint.h"
#include "bw/pipeline/example_design.h"
#include "bw/pipeline/produce.h"

namespace bw::pipeline {
namespace {

using drawings::pagesOf;
using drawings::textOf;

Design example(const std::string& name, int stations) {
  Design design = exampleDesign(name).value();
  design.output.programs = {"csv"};
  for (Cut& cut : design.cuts) cut.sections.stations = stations;
  return design;
}

Product made(const Design& design, int threads = 0) {
  RunContext context;
  context.threads = threads;
  Product product = produce(design, "nothing-is-written-there", {}, context);
  EXPECT_FALSE(product.error) << product.error->message;
  return product;
}

std::string file(const Product& product, const std::string& name) {
  const auto& paths = product.files.paths();
  const auto at = std::ranges::find(paths, std::filesystem::path(name));
  return at == paths.end() ? std::string() : product.files.bytes()[std::size_t(at - paths.begin())];
}

/// The cells of a table without quotes, by line.
std::vector<std::vector<std::string>> table(const std::string& csv) {
  std::vector<std::vector<std::string>> lines;
  std::istringstream in(csv);
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string>& cells = lines.emplace_back(1);
    for (const char c : line)
      if (c == ',')
        cells.emplace_back();
      else
        cells.back() += c;
  }
  return lines;
}

double number(const std::string& cell) { return std::strtod(cell.c_str(), nullptr); }

TEST(Workshop, GetsADrawingOfABlockWithItsCutsInOrder) {
  const Product product = made(example("two-crossing-cuts", 9));
  const std::string pdf = file(product, "drawings.pdf");
  const auto pages = pagesOf(pdf);
  ASSERT_EQ(pages.size(), 1u);
  const std::string text = textOf(pages[0]);
  const nlohmann::json report = nlohmann::json::parse(file(product, "report.json"));
  for (const std::string& part :
       {std::string("Two crossing cuts"), std::string("600 \xd7 600 \xd7 500 mm"),
        std::string("Cut 1 of 2: north"), std::string("Cut 2 of 2: east"),
        std::string("then turned by 90 degrees"), std::string("Blade 800 mm, 9 stations"),
        std::string("programs/strip-0"), std::string("programs/strip-1"),
        "run " + report["run"].get<std::string>(), std::string("front, right, bottom")})
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  EXPECT_LT(pdf.size(), 300'000u);
  EXPECT_EQ(report["fingerprints"]["drawings.pdf"], fingerprintText(fingerprintOf(pdf)));
  EXPECT_EQ(report["fingerprints"]["cut-list.csv"],
            fingerprintText(fingerprintOf(file(product, "cut-list.csv"))));
}

TEST(Workshop, GetsTheSameForAnyNumberOfThreads) {
  const Design design = example("two-crossing-cuts", 6);
  const Product one = made(design, 1), again = made(design, 1), two = made(design, 2);
  for (const char* name : {"drawings.pdf", "cut-list.csv"}) {
    EXPECT_FALSE(file(one, name).empty()) << name;
    EXPECT_EQ(file(one, name), file(again, name)) << name;
    EXPECT_EQ(file(one, name), file(two, name)) << name;
  }
}

TEST(Workshop, CutListAddsUpToTheReport) {
  const Product product = made(example("three-block-wall", 9));
  EXPECT_EQ(pagesOf(file(product, "drawings.pdf")).size(), 3u);
  const auto lines = table(file(product, "cut-list.csv"));
  const nlohmann::json report = nlohmann::json::parse(file(product, "report.json"));
  ASSERT_EQ(lines.size(), 5u) << "a head, three blocks, all";
  const auto column = [&](const std::string& name) {
    return std::size_t(std::ranges::find(lines[0], name) - lines[0].begin());
  };
  double block = 0, left = 0, waste = 0, time = 0, run = 0, order = 0;
  for (std::size_t i = 1; i <= 3; ++i) {
    const std::vector<std::string>& cells = lines[i];
    ASSERT_EQ(cells.size(), lines[0].size());
    const nlohmann::json& part = report["blocks"][i - 1]["part"];
    EXPECT_EQ(cells[0], report["blocks"][i - 1]["id"]);
    EXPECT_NEAR(number(cells[column("block_l")]), part["block_mm3"].get<double>() * 1e-6, 5.1e-4);
    EXPECT_NEAR(number(cells[column("left_l")]), part["left_mm3"].get<double>() * 1e-6, 5.1e-4);
    double removed = 0;
    for (const nlohmann::json& cut : part["cuts"]) removed += cut["removed_mm3"].get<double>() * 1e-6;
    EXPECT_NEAR(number(cells[column("waste_l")]), removed, 1e-3);
    EXPECT_NEAR(number(cells[column("waste_percent")]),
                100 * number(cells[column("waste_l")]) / number(cells[column("block_l")]), 0.01);
    block += number(cells[column("block_l")]);
    left += number(cells[column("left_l")]);
    waste += number(cells[column("waste_l")]);
    time += number(cells[column("cutting_time_s")]);
    run += number(cells[column("run_time_s")]);
    EXPECT_GT(number(cells[column("run_time_s")]), number(cells[column("cutting_time_s")]) + 0.5)
        << "these blades are led into the foam and out of it";
    order += number(cells[column("to_order")]);
  }
  const std::vector<std::string>& total = lines[4];
  EXPECT_EQ(total[0], "total");
  EXPECT_EQ(number(total[column("cuts")]), 3);
  EXPECT_NEAR(number(total[column("block_l")]), block, 2e-3);
  EXPECT_NEAR(number(total[column("left_l")]), left, 2e-3);
  EXPECT_NEAR(number(total[column("waste_l")]), waste, 2e-3);
  EXPECT_NEAR(block, left + waste, 2e-3);
  EXPECT_NEAR(number(total[column("cutting_time_s")]), time, 0.2);
  EXPECT_NEAR(number(total[column("cutting_time_s")]), report["summary"]["cutting_time_s"].get<double>(),
              0.06);
  EXPECT_NEAR(number(total[column("run_time_s")]), run, 0.2);
  EXPECT_NEAR(number(total[column("run_time_s")]), report["summary"]["run_time_s"].get<double>(), 0.06);
  EXPECT_EQ(number(total[column("to_order")]), 3);
  EXPECT_EQ(order, 3) << "of each size the blocks of it";
}

TEST(Workshop, DrawsWhatIsKnownOfABlockWhosePartIsNot) {
  Product product = made(example("two-crossing-cuts", 6));
  BlockEvaluation& block = product.evaluation.blocks.front();
  block.part.value = std::make_shared<const BlockPart>();
  block.part.findings = {{Severity::warning, PartUnknown{"the surface of east ends inside of it"}, {}, {}}};
  const Product again = produce(product.evaluation, "nothing-is-written-there", {}, {});
  ASSERT_FALSE(again.error) << again.error->message;
  const auto pages = pagesOf(file(again, "drawings.pdf"));
  ASSERT_EQ(pages.size(), 1u);
  const std::string text = textOf(pages[0]);
  EXPECT_NE(text.find("could not be worked out: the surface of east ends inside of it"), std::string::npos);
  EXPECT_NE(text.find("600 \xd7 600 \xd7 500 mm"), std::string::npos);
  const auto lines = table(file(again, "cut-list.csv"));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[1][8], "180.000");
  for (const std::size_t unknown : {9u, 10u, 11u}) {
    EXPECT_EQ(lines[1][unknown], "");
    EXPECT_EQ(lines[2][unknown], "");
  }
}

TEST(Workshop, NamesOfAnyLettersAreNoFault) {
  Design design = example("two-crossing-cuts", 6);
  design.name = "Dach f\u00fcr \u03a3\u03c4\u03ad\u03b3\u03b7 " + std::string(300, 'W');
  design.block().id = "=Bl\u00f6cke, \"\u03b1\"";
  for (Cut& cut : design.cuts) cut.block = design.block().id;
  const Product product = made(design);
  const std::string text = textOf(pagesOf(file(product, "drawings.pdf")).at(0));
  EXPECT_NE(text.find("Dach f\xfcr ????? WWW"), std::string::npos) << text;
  EXPECT_NE(text.find("Label: =Bl\xf6"), std::string::npos) << text;
  EXPECT_NE(file(product, "cut-list.csv").find("\n\"=Bl\u00f6cke, \"\"\u03b1\"\"\",600.00,"),
            std::string::npos);
}

TEST(Workshop, GetsTheKindsOfFilesAndTheBlocksThatAreWanted) {
  const Product all = made(example("three-block-wall", 9));
  const auto written = [&all](const Wanted& wanted) {
    Policy policy;
    policy.wanted = wanted;
    Product product = produce(all.evaluation, "nothing-is-written-there", policy, {});
    EXPECT_FALSE(product.error) << product.error->message;
    // The report lists what there is, and names the same run.
    const nlohmann::json report = nlohmann::json::parse(file(product, "report.json"));
    EXPECT_EQ(report["run"], nlohmann::json::parse(file(all, "report.json"))["run"]);
    EXPECT_EQ(report["files"].size(), product.files.paths().size());
    return product;
  };
  for (std::size_t kind = 0; kind < kFileKinds; ++kind) {
    Wanted wanted;
    wanted.kinds[kind] = false;
    const std::size_t fewer = all.files.paths().size() - written(wanted).files.paths().size();
    const std::size_t files[kFileKinds] = {3, 2, 0, 1, 2, 1, 2, 2};  // pages are the window's
    EXPECT_EQ(fewer, files[kind]) << kFileKindInfos[kind].word;
  }
  const Product two = written({.blocks = {"column-1", "column-3"}});
  EXPECT_TRUE(file(two, "programs/column-2/strip-1/motion.csv").empty());
  EXPECT_EQ(file(two, "programs/column-3/strip-2/motion.csv"),
            file(all, "programs/column-3/strip-2/motion.csv"));
  EXPECT_EQ(file(two, "surface.step").size(), file(all, "surface.step").size()) << "that of all of them";
  EXPECT_EQ(pagesOf(file(two, "drawings.pdf")).size(), 2u);
  const auto lines = table(file(two, "cut-list.csv"));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[2][0], "column-3");
  const auto order = std::size_t(std::ranges::find(lines[0], "to_order") - lines[0].begin());
  EXPECT_EQ(number(lines[1][order]), 2) << "as many are ordered";
  EXPECT_EQ(number(lines[3][order]), 2);
}

/// The polylines of a DXF by their layers: pairs of lines, a code and its value.
std::map<std::string, std::vector<std::vector<Eigen::Vector3d>>> polylinesOf(const std::string& dxf) {
  std::map<std::string, std::vector<std::vector<Eigen::Vector3d>>> layers;
  std::istringstream in(dxf);
  std::string code, value, entity, layer;
  while (std::getline(in, code) && std::getline(in, value)) {
    const int number = std::stoi(code);
    if (number == 0) entity = value;
    if (number == 8) {
      layer = value;
      if (entity == "POLYLINE") layers[layer].emplace_back();
      if (entity == "VERTEX") layers[layer].back().emplace_back();
    }
    if (entity == "VERTEX" && (number == 10 || number == 20 || number == 30))
      layers[layer].back().back()(number / 10 - 1) = std::stod(value);
  }
  EXPECT_EQ(value, "EOF");
  return layers;
}

/// The texts of a DXF, by their layers.
std::map<std::string, std::vector<std::string>> textsOf(const std::string& dxf) {
  std::map<std::string, std::vector<std::string>> layers;
  std::istringstream in(dxf);
  std::string code, value, entity, layer;
  while (std::getline(in, code) && std::getline(in, value)) {
    const int number = std::stoi(code);
    if (number == 0) entity = value;
    if (number == 8) layer = value;
    if (entity == "TEXT" && number == 1) layers[layer].push_back(value);
  }
  return layers;
}

TEST(Workshop, CurvesHaveTheirNamesInDxfAndStep) {
  Design design = example("three-block-wall", 9);
  for (Cut& cut : design.cuts)
    if (cut.id == "cut-column-2") cut.id = "übergang";
  for (Cut& cut : design.cuts)
    if (cut.id == "cut-column-3") cut.id = "%%u^M\\U+0041 \U0001D11E 5%";
  design.grid.reset();
  const Product product = made(design);
  const std::string dxf = file(product, "curves.dxf"), step = file(product, "curves.step");
  const auto texts = textsOf(dxf);
  EXPECT_EQ(texts.at("seam-names"),
            (std::vector<std::string>{"cut-column-1 | \\U+00FCbergang",
                                      "\\U+00FCbergang | \\U+0025%u\\U+005EM\\U+005CU+0041 "
                                      "(U+1D11E) 5%"}))
      << "no underlines, no control characters, no letters by what looks like their number";
  EXPECT_EQ(texts.at("outline-names").size(), 8u);
  EXPECT_EQ(texts.at("outline-names").front(), "cut-column-1 start");
  EXPECT_EQ(dxf.find("\u00fc"), std::string::npos) << "ASCII alone";
  // A product each, and an assembly of each kind.
  for (const char* name : {"'curves'", "'seam'", "'outline'", "'seam cut-column-1 | \\X2\\00FC\\X0\\bergang'",
                           "'outline cut-column-1 start'"})
    EXPECT_NE(step.find(std::string("=PRODUCT(") + name), std::string::npos) << name;
}

TEST(Workshop, NamesOfCurvesAreEachAnotherWhateverTheIds) {
  Design design = example("three-block-wall", 9);
  const std::string lengthy(300, 'x');
  const std::map<std::string, std::string> ids = {{"cut-column-1", lengthy + "1" + lengthy},
                                                  {"cut-column-2", lengthy + "2" + lengthy},
                                                  {"cut-column-3", "a\tb"}};
  for (Cut& cut : design.cuts) cut.id = ids.at(cut.id);
  design.grid.reset();
  const Product product = made(design);
  const auto texts = textsOf(file(product, "curves.dxf"));
  for (const auto& [layer, names] : texts) {
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size()) << layer;
    for (const std::string& name : names) EXPECT_LE(name.size(), 255u) << name;
  }
  const std::vector<std::string>& seams = texts.at("seam-names");
  ASSERT_EQ(seams.size(), 2u);
  EXPECT_EQ(seams.front(), std::string(126, 'x') + "..." + std::string(126, 'x'));
  EXPECT_TRUE(seams.back().ends_with("xxx | a\\U+005Ctb")) << seams.back();
  const std::vector<std::string>& outlines = texts.at("outline-names");
  EXPECT_TRUE(outlines.front().ends_with("xxx start")) << outlines.front();
  EXPECT_EQ(
      std::ranges::count_if(outlines, [](const std::string& name) { return name.ends_with("start (2)"); }),
      1);
}

TEST(Workshop, GetsTheCurvesOfAWallAndOfCrossingCuts) {
  const auto wall = polylinesOf(file(made(example("three-block-wall", 9)), "curves.dxf"));
  ASSERT_EQ(wall.at("seam").size(), 2u);
  EXPECT_EQ(wall.at("outline").size(), 8u);
  EXPECT_EQ(wall.count("crease"), 0u);
  for (std::size_t k = 0; k < 2; ++k) {
    const std::vector<Eigen::Vector3d>& seam = wall.at("seam")[k];
    for (const Eigen::Vector3d& p : seam) EXPECT_NEAR(p.x(), 600.0 * double(k + 1), 0.05);
    EXPECT_NEAR(std::abs(seam.back().y() - seam.front().y()), 800, 1);
    // The wall at its first boundary: 310 at both ends, 310 in the middle by its formula.
    if (k == 0) {
      EXPECT_NEAR(seam.front().z(), 310, 0.5);
    }
  }
  const Product crossing = made(example("two-crossing-cuts", 9));
  const auto corner = polylinesOf(file(crossing, "curves.dxf"));
  EXPECT_EQ(corner.at("outline").size(), 8u);
  ASSERT_GE(corner.at("crease").size(), 1u);
  for (const Eigen::Vector3d& p : corner.at("crease")[0]) {
    EXPECT_GT(p.z(), 0);
    EXPECT_LT(p.z(), 500);
  }
  // As STEP they are as many, or more where a curve has corners.
  const std::string step = file(crossing, "curves.step");
  std::size_t splines = 0;
  for (std::size_t at = step.find("=B_SPLINE_CURVE_WITH_KNOTS("); at != std::string::npos;
       at = step.find("=B_SPLINE_CURVE_WITH_KNOTS(", at + 1))
    ++splines;
  EXPECT_GE(splines, 8 + corner.at("crease").size());
  EXPECT_NE(step.find("'outline east start'"), std::string::npos);
}

TEST(Workshop, GetsNothingWhereNoPartIsSought) {
  const Product product = made(example("saddle", 9));
  EXPECT_TRUE(file(product, "drawings.pdf").empty());
  EXPECT_TRUE(file(product, "cut-list.csv").empty());
}

}  // namespace
}  // namespace bw::pipeline
