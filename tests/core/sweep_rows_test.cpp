// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The rows of the sampled cut surface: how many are kept, and where the search for their feet starts.
#include <gtest/gtest.h>

#include <mutex>

#include "analytic_surfaces.h"
#include "finding_of.h"
#include "plane_sections.h"
#include "row_settings.h"

namespace bw {

namespace {

PlanarCurve level(double height) {
  return *PlanarCurve::points({{-200, height}, {0, height}, {200, height}});
}

SweepAnalysis analysed(const Sweep& sweep, const test::RowSettings& settings, const SurfaceSampler& target) {
  Result<SweepAnalysis> analysis = test::analysisOf(sweep, settings, target, {});
  EXPECT_TRUE(analysis) << analysis.error().message;
  return std::move(*analysis);
}

Sweep planeSweep(int stations, const test::RowSettings& settings, const std::function<double(int)>& height) {
  Findings findings;
  const Box block = test::blockUnder(200, stations, -50, 50);
  Result<Sweep> sweep =
      buildSweep(test::sectionsOf(stations, 1.0, [&](int i) { return level(height(i)); }), settings, block,
                 PlaneFamily::across(block, -Eigen::Vector3d::UnitY()), {}, findings);
  EXPECT_TRUE(sweep) << sweep.error().message;
  return std::move(*sweep);
}

/// Tells how far the starts of the search lie from the feet, in parameters (x, y) of the plane z = 0.
class SeedRecorder : public test::PlaneSampler {
 public:
  struct Record {
    std::mutex mutex;
    double farthest = 0, sum = 0;
    int seeded = 0, unseeded = 0;
  };
  explicit SeedRecorder(Record& record) : PlaneSampler(Eigen::Vector3d::UnitZ()), record_(record) {}
  Result<Foot> closest(const Eigen::Vector3d& p, const Foot* seed) override {
    const Foot foot{0, {p.x(), p.y()}, {p.x(), p.y(), 0}, Eigen::Vector3d::UnitZ(), std::abs(p.z()), false};
    const std::lock_guard lock(record_.mutex);
    if (seed) {
      const double miss = (seed->uv - foot.uv).norm();
      record_.farthest = std::max(record_.farthest, miss);
      record_.sum += miss;
      ++record_.seeded;
    } else {
      ++record_.unseeded;
    }
    return foot;
  }
  std::unique_ptr<SurfaceSampler> clone() const override { return std::make_unique<SeedRecorder>(record_); }

 private:
  Record& record_;
};

}  // namespace

TEST(CutSurface, SearchStartsWhereTheFootWillBe) {
  // Evenly spaced points have their feet on straight lines: after the first two of a row and of a column the
  // start is the foot itself. A neighbour's foot would be 0.25 mm off at least.
  test::RowSettings settings;
  Sweep sweep = planeSweep(60, settings, [](int) { return 1.0; });
  SeedRecorder::Record record;
  analysed(sweep, settings, SeedRecorder(record));
  EXPECT_EQ(record.unseeded, 16);   // one a part
  EXPECT_LT(record.farthest, 4.1);  // the second point of a part starts at the first
  EXPECT_LT(record.sum / record.seeded, 0.01);
}

TEST(CutSurface, ManyStationsKeepTheBudgetOfRows) {
  test::RowSettings settings;
  for (const int stations : {2, 120, 241, 242, 1000, 2000}) {
    Sweep sweep = planeSweep(stations, settings, [](int) { return 0.0; });
    const SweepAnalysis analysis = analysed(sweep, settings, test::PlaneSampler(Eigen::Vector3d::UnitZ()));
    EXPECT_LE(analysis.cut.rows, 481) << stations;
    EXPECT_GE(analysis.cut.rows, std::min(2 * stations - 1, 65)) << stations;
    EXPECT_EQ(analysis.cut.points.size(), std::size_t(analysis.cut.rows * analysis.cut.columns));
    for (const Field& field : analysis.cut.fields) EXPECT_EQ(field.values.size(), analysis.cut.points.size());
    ASSERT_EQ(analysis.stationRow.size(), std::size_t(stations));
    EXPECT_EQ(analysis.stationRow.front(), 0);
    EXPECT_EQ(analysis.stationRow.back(), analysis.cut.rows - 1);
    // The kept row nearest to a station lies beside it.
    const double apart = double(stations - 1) / (analysis.cut.rows - 1);
    for (std::size_t i = 0; i < analysis.stationRow.size(); ++i)
      EXPECT_NEAR(-analysis.cut.at(analysis.stationRow[i], 0).y(), double(i), apart + 1e-9);
  }
}

TEST(CutSurface, OneBadStationAmongManyIsFoundAndShown) {
  // Station 778 alone is 3 mm too high, and its blade gives way to its neighbours by some µm: thinned rows
  // must neither hide it from the numbers nor from the map.
  test::RowSettings settings;
  settings.tolerance = 0.5;
  constexpr int kBad = 777;
  Sweep sweep = planeSweep(1500, settings, [](int i) { return i == kBad ? 3.0 : 0.0; });
  const SweepAnalysis analysis = analysed(sweep, settings, test::PlaneSampler(Eigen::Vector3d::UnitZ()));
  EXPECT_NEAR(analysis.summary.deviationMax, 3, 0.01);
  EXPECT_NEAR(analysis.stationDeviation[kBad], 3, 0.01);
  EXPECT_NEAR(analysis.stationDeviation[kBad + 5], 0, 0.05);
  const std::vector<double>& deviation = analysis.cut.field("deviation")->values;
  EXPECT_NEAR(*std::ranges::max_element(deviation), 3, 0.01);
  EXPECT_LE(analysis.cut.rows, 481);
  const Finding* far = test::findingOf<TooFar>(analysis.findings);
  ASSERT_TRUE(far);
  EXPECT_EQ(far->where.stations->worst, kBad);
  // The area is that of all rows: the strips of about three stations of 1500 lie off.
  EXPECT_NEAR(1 - analysis.summary.withinTolerance, 3.0 / 1499, 2.0 / 1499);
}

}  // namespace bw
