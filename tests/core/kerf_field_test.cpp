// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A kerf that is told over speed: its table as text and in files, and its width by place.
#include "bw/core/sweep/kerf_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analytic_surfaces.h"
#include "bw/core/design/design.h"
#include "bw/core/shape/moved_sections.h"
#include "bw/core/sweep/kerf_text.h"
#include "bw/core/sweep/sweep_check.h"
#include "plane_sections.h"

namespace bw {
namespace {

using Eigen::Vector3d;

const KerfTable kTable = {{5, 4.2}, {20, 2.7}};

std::string refusalOf(const char* text) {
  const Result<KerfTable> table = readTypedKerf(text);
  return table ? "taken: " + typedKerf(*table) : table.error().message;
}

TEST(KerfTable, GoesEvenlyBetweenItsEntriesAndStaysBeyondThem) {
  EXPECT_EQ(kerfAt(kTable, 1), 4.2);
  EXPECT_EQ(kerfAt(kTable, 5), 4.2);
  EXPECT_NEAR(kerfAt(kTable, 10), 3.7, 1e-12);
  EXPECT_EQ(kerfAt(kTable, 20), 2.7);
  EXPECT_EQ(kerfAt(kTable, 200), 2.7);
  EXPECT_EQ(widestKerf(kTable), 4.2);
  EXPECT_EQ(kerfAt({}, 5), 0);
}

TEST(KerfTable, IsReadAsPeopleTypeIt) {
  for (const char* text :
       {"5: 4.2, 20: 2.7", "5:4.2;20:2.7", "5: 4,2; 20: 2,7", "5: 4,2, 20: 2,7",
        " 5 mm/s : 4.2 mm ,  20 mm/s : 0.27 cm ", "5:4.2,20:2.7", "0.3 m/min: 4.2, 20: 2.7"}) {
    const Result<KerfTable> table = readTypedKerf(text);
    ASSERT_TRUE(table) << text << ": " << table.error().message;
    EXPECT_EQ(*table, kTable) << text;
  }
  EXPECT_EQ(*readTypedKerf(typedKerf(kTable)), kTable);
  EXPECT_TRUE(readTypedKerf("  ")->empty());
  EXPECT_NE(refusalOf("5: 4,2,20: 2,7").find("semicolon"), std::string::npos) << refusalOf("5: 4,2,20: 2,7");
  EXPECT_NE(refusalOf("4.2").find("colon"), std::string::npos);
  EXPECT_NE(refusalOf("5: 4.2").find("2 entries or more, not 1"), std::string::npos) << refusalOf("5: 4.2");
  EXPECT_NE(refusalOf("20: 2.7, 5: 4.2").find("entry 2 has a speed of 5"), std::string::npos);
  EXPECT_NE(refusalOf("0: 2.7, 5: 4.2").find("entry 1 has a speed of 0"), std::string::npos);
  EXPECT_NE(refusalOf("5: 70, 20: 2.7").find("entry 1 has a width of 70"), std::string::npos);
  EXPECT_NE(refusalOf("5: 4.2, x: 2.7").find("the speed of entry 2"), std::string::npos);
  EXPECT_NE(refusalOf("5: 4.2, 20: 2 kg").find("the width of entry 2"), std::string::npos);
}

TEST(KerfTable, TakesExpressionsForItsNumbers) {
  const auto value = [](const std::string& text) -> Result<double> {
    const NamedNumber numbers[] = {{"width", 420}, {"slow", 5}};
    return evaluateExpression(text, numbers);
  };
  for (const char* text : {"=slow: =width/100; 20: 2.7", "=slow:=max(width; 1)/100, 20: 2.7",
                           "= slow : = max(width, 1)/100 , 20: 2.7"}) {
    const Result<ToldKerf> told = readTypedKerf(text, value);
    ASSERT_TRUE(told) << text << ": " << told.error().message;
    EXPECT_EQ(told->table, kTable) << text;
    ASSERT_EQ(told->expressions.size(), 2u) << text;
    EXPECT_EQ(told->expressions.at("/0/0").text, "slow");
    EXPECT_EQ(told->expressions.at("/0/1").value, 4.2);
    const Result<ToldKerf> again = readTypedKerf(typedKerf(told->table, told->expressions), value);
    ASSERT_TRUE(again) << typedKerf(told->table, told->expressions);
    EXPECT_EQ(again->expressions, told->expressions);
    EXPECT_EQ(again->table, told->table);
  }
  EXPECT_EQ(typedKerf(kTable, {{"/1/1", {"width/100 - 1.5", 2.7}}}), "5: 4.2; 20: =width/100 - 1.5");
  const auto refused = [&](const char* text) {
    const Result<ToldKerf> told = readTypedKerf(text, value);
    return told ? std::string("taken") : told.error().message;
  };
  EXPECT_NE(refused("5: =widht, 20: 2.7").find("the width of entry 1, after its =, character 1"),
            std::string::npos)
      << refused("5: =widht, 20: 2.7");
  EXPECT_NE(refused("5: =width, 20: 2.7").find("entry 1 has a width of 420"), std::string::npos);
  EXPECT_FALSE(readTypedKerf("5: =1+1, 20: 2.7")) << "where there are no variables there are no expressions";
}

TEST(KerfTable, StandsInJobsAndDesignsInPlaceOfTheWidth) {
  const Result<Design> job = parseJob(R"({"kerf": [[5, 4.2], [20, 2.7]]})");
  ASSERT_TRUE(job) << job.error().message;
  EXPECT_EQ(job->process.kerfTable, kTable);
  EXPECT_EQ(job->process.kerf, 0);
  const Result<Design> again = parseDesign(designToJson(*job));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*again, *job);
  EXPECT_EQ(designToJson(*again), designToJson(*job));
  const Result<Design> width = parseJob(R"({"kerf": 2.5})");
  ASSERT_TRUE(width);
  EXPECT_TRUE(width->process.kerfTable.empty());
  EXPECT_EQ(width->process.kerf, 2.5);
  EXPECT_EQ(parseDesign(designToJson(*width))->process, width->process);
}

TEST(KerfTable, TakesExpressionsAsTheWidthDoes) {
  const char* text =
      R"({"bladewright_design": 2, "variables": [{"name": "melt", "value": 2.7, "min": 0, "max": 5}],
    "process": {"kerf": [[5, "=melt + 1.5"], ["=melt / 0.135", "=melt"]]}})";
  const Result<Design> design = parseDesign(text);
  ASSERT_TRUE(design) << design.error().message;
  ASSERT_EQ(design->process.kerfTable.size(), 2u);
  EXPECT_NEAR(design->process.kerfTable[0].width, 4.2, 1e-12);
  EXPECT_NEAR(design->process.kerfTable[1].speed, 20, 1e-12);
  const std::string written = designToJson(*design);
  EXPECT_NE(written.find("\"=melt + 1.5\""), std::string::npos) << written;
  EXPECT_EQ(*parseDesign(written), *design);
  const Result<Design> width = parseDesign(
      R"({"bladewright_design": 2, "variables": [{"name": "melt", "value": 2, "min": 0, "max": 5}], "process": {"kerf": "=melt / 2"}})");
  ASSERT_TRUE(width);
  EXPECT_EQ(width->process.kerf, 1);
  EXPECT_NE(designToJson(*width).find("\"=melt / 2\""), std::string::npos);
}

TEST(KerfTable, OfAFileIsRefusedByEntryNumberAndRemedy) {
  const auto refusal = [](const char* kerf) {
    const Result<Design> job = parseJob(std::string(R"({"kerf": )") + kerf + "}");
    return job ? std::string("taken") : job.error().message;
  };
  const std::pair<const char*, const char*> cases[] = {
      {"[]", "2 to 100 pairs"},
      {"[[5, 4]]", "not of 1"},
      {"[5, 4]", "kerf[0] must be a pair"},
      {"[[5, 4], [20]]", "kerf[1] must be a pair"},
      {"[[5, 4], [20, 2, 1]]", "kerf[1] must be a pair"},
      {"[[5, 4], [5, 2]]", "entry 2 has a speed of 5 mm/s, which is not above the one before it (5)"},
      {"[[20, 4], [5, 2]]", "from the slowest to the fastest"},
      {"[[0, 4], [5, 2]]", "entry 1 has a speed of 0"},
      {"[[-1, 4], [5, 2]]", "kerf[0][0] is -1 but must lie between 0 and 10000"},
      {"[[1, 4], [5, 51]]", "kerf[1][1] is 51 but must lie between 0 and 50"},
      {"[[1, 4], [5, -1]]", "kerf[1][1] is -1"},
      {"[[1, 4], [5, \"wide\"]]", "kerf[1][1] must be a number"},
      {"{\"5\": 4}", "kerf must be a number"},
  };
  for (const auto& [kerf, told] : cases)
    EXPECT_NE(refusal(kerf).find(told), std::string::npos) << kerf << ": " << refusal(kerf);
  std::string many = "[";
  for (int i = 1; i <= 101; ++i) many += (i > 1 ? ", [" : "[") + std::to_string(i) + ", 3]";
  EXPECT_NE(refusal((many + "]").c_str()).find("not of 101"), std::string::npos);
}

/// Planes across y, whose levels are y.
const PlaneFamily kAlongY{Frame{{0, 0, 0}, -Vector3d::UnitX(), Vector3d::UnitZ(), Vector3d::UnitY()}};

/// A row of straight blades from (0, y, 0), turning about that end as they travel along y, at levels 0, 10 ….
std::vector<KerfField::Row> fan() {
  std::vector<KerfField::Row> rows;
  for (int i = 0; i < 5; ++i) {
    KerfField::Row& row = rows.emplace_back();
    row.level = 10 * i;
    const double angle = 0.05 * i;
    const Vector3d along(std::cos(angle), 0, std::sin(angle));
    for (int k = 0; k <= 20; ++k) {
      row.places.push_back(10 * k * along + row.level * Vector3d::UnitY());
      row.tangents.push_back(along);
      row.speeds.push_back(5 + k + i);
    }
  }
  return rows;
}

TEST(KerfField, TellsTheSpeedOfThePointThatPassesThere) {
  const KerfField field(kTable, kAlongY, fan());
  for (const KerfField::Row& row : field.rows())
    for (std::size_t k = 0; k < row.places.size(); ++k) {
      EXPECT_NEAR(field.speed(row.places[k]), row.speeds[k], 1e-9);
      const Vector3d across = row.tangents[k].cross(Vector3d::UnitY());
      EXPECT_NEAR(field.speed(row.places[k] + 3 * across), row.speeds[k], 1e-9)
          << "across the blade, the same";
    }
  EXPECT_NEAR(field.speed({35, 0, 0}), 8.5, 1e-12) << "between two places";
  EXPECT_NEAR(field.speed(0.5 * (field.rows()[1].places[7] + field.rows()[2].places[7])), 5 + 7 + 1.5, 0.01);
  EXPECT_NEAR(field.speed({-20, 0, 3}), 5, 1e-12) << "beyond the ends as at them";
  EXPECT_NEAR(field.speed({500, 0, 0}), 25, 1e-12);
  EXPECT_NEAR(field.speed({50, -30, 0}), 10, 1e-12) << "before the first row as on it";
  EXPECT_EQ(field.width({35, 0, 0}), kerfAt(kTable, 8.5));
  EXPECT_NEAR(field.farthestFrom([&](const Vector3d& p) { return field.width(p); }), 0, 1e-12);
  EXPECT_NEAR(field.farthestFrom([](const Vector3d&) { return 2.7; }), 1.5, 1e-12);
}

TEST(KerfField, GoesContinuouslyBesideABentBlade) {
  KerfField::Row row;
  for (int k = 0; k <= 40; ++k) {
    const double angle = 0.05 * k;
    row.places.emplace_back(100 * std::sin(angle), 0, 100 * std::cos(angle));
    row.tangents.emplace_back(std::cos(angle), 0, -std::sin(angle));
    row.speeds.push_back(5 + 0.3 * k);
  }
  const KerfField field({{5, 5}, {17, 2}}, kAlongY, {row});
  for (const double radius : {94.0, 100.0, 106.0}) {
    double before = 0;
    for (int i = 0; i <= 4000; ++i) {
      const double angle = 0.0005 * i;
      const double speed = field.speed({radius * std::sin(angle), 2, radius * std::cos(angle)});
      EXPECT_NEAR(speed, 5 + 6 * angle, 0.002);
      if (i > 0) {
        ASSERT_NEAR(speed, before, 0.0032) << radius << ' ' << angle;
      }
      before = speed;
    }
  }
}

TEST(KerfField, OfOneWidthIsThatWidth) {
  const KerfField field({{5, 3}, {20, 3}}, kAlongY, fan());
  SurfaceGrid swept;
  swept.rows = 5;
  swept.columns = 21;
  for (const KerfField::Row& row : field.rows())
    swept.points.insert(swept.points.end(), row.places.begin(), row.places.end());
  const Kerf kerf{3, {}, 0, -Vector3d::UnitZ()};
  EXPECT_EQ(standingBeside(swept, kerf, field).points, standingBeside(swept, kerf).points);
  const auto shared = std::make_shared<const KerfField>(field);
  const auto one = movedBy(std::make_unique<test::SphereSampler>(900), -1.5),
             other = movedBy(std::make_unique<test::SphereSampler>(900), shared, kerf, 1);
  for (const Vector3d& p : swept.points) {
    const Vector3d place = 901 * (p + Vector3d(0, 0, 900)).normalized();
    EXPECT_EQ(one->offset(place, *one->closest(place, nullptr)),
              other->offset(place, *other->closest(place, nullptr)));
  }
}

TEST(KerfField, SectionsOfTheMiddleKeepTheWidthOfEachPlace) {
  const double radius = 900;
  const std::vector<Section> cap = test::sectionsOf(5, 100, [=](int i) {
    return test::graphCurve(
        300, [=](double x) { return std::sqrt(radius * radius - std::pow(100 * i, 2) - x * x); }, 481);
  });
  KerfField::Row row;
  for (int k = 0; k <= 60; ++k) {
    const double x = -300 + 10 * k, z = std::sqrt(radius * radius - x * x);
    row.places.emplace_back(x, 0, z);
    row.tangents.emplace_back(z / radius, 0, -x / radius);
    row.speeds.push_back(5 + 0.25 * k);
  }
  const auto field = std::make_shared<const KerfField>(kTable, kAlongY, std::vector{row});
  Kerf kerf;
  kerf.table = kTable;
  for (const double side : {1.0, -1.0}) {
    Findings unsaid;
    const auto sampler = movedBy(std::make_unique<test::SphereSampler>(radius), field, kerf, side);
    const Result<std::vector<Section>> middle = sectionsOn(cap, *sampler, 2.1, {}, unsaid);
    ASSERT_TRUE(middle) << middle.error().message;
    double narrowest = 1e9, widest = 0;
    for (const Section& section : *middle)
      for (const Eigen::Vector2d& p : section.curve().sample(301)) {
        const Vector3d place = section.frame.toWorld(p);
        const double off = -side * (place.norm() - radius);
        EXPECT_NEAR(off, 0.5 * field->width(place), 2e-3) << "the table has corners, the spline has none";
        narrowest = std::min(narrowest, off);
        widest = std::max(widest, off);
      }
    EXPECT_NEAR(narrowest, 1.35, 0.01);
    EXPECT_NEAR(widest, 2.1, 0.01);
  }
}

}  // namespace
}  // namespace bw
