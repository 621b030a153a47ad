// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/sweep_check.h"
#include "finding_of.h"
#include "row_settings.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <optional>
#include <string>

#include "analytic_surfaces.h"
#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_stability.h"

namespace bw {

namespace {

constexpr double kRadius = 1500;
constexpr double kHalfWidth = 280;

std::vector<double> evenTravel(int n) {
  std::vector<double> travel;
  for (int i = 0; i < n; ++i) travel.push_back(-300.0 + 600.0 * i / (n - 1));
  return travel;
}

Box sphereBlock() {
  return Box{
      Frame{{-300, -320, 1200}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()},
      {600, 640, 350}};
}

Result<Sweep> sphereSweep(const test::RowSettings& settings, int stations, Findings& findings) {
  return buildSweep(test::sphereSections(kRadius, kHalfWidth, evenTravel(stations)), settings, sphereBlock(),
                    PlaneFamily::across(sphereBlock(), -Eigen::Vector3d::UnitY()), {}, findings);
}

}  // namespace

TEST(Sweep, BladeHasItsLengthAndLiesSymmetrically) {
  test::RowSettings settings;
  Findings findings;
  const Result<Sweep> sweep = sphereSweep(settings, 9, findings);
  ASSERT_TRUE(sweep) << sweep.error().message;
  for (std::size_t i = 0; i < sweep->poses.size(); ++i) {
    const BladePose& pose = sweep->poses[i];
    EXPECT_NEAR(pose.blade.length(), settings.blade.length, 1e-9);
    const double cut = pose.cut.length();
    EXPECT_NEAR(pose.before, 0.5 * (settings.blade.length - cut), 1e-9);
    // The fitted part lies in the middle of the blade.
    EXPECT_LT((pose.blade.point(0.5 * settings.blade.length) - pose.cut.point(0.5 * cut)).norm(), 1e-7);
    EXPECT_LT(sweep->fits[i].fit.R4, 1e-6);  // a circle is an elastica; what a row asks besides weighs little
  }
}

TEST(Sweep, ShortBladeIsAnErrorThatTellsTheLengthNeeded) {
  test::RowSettings settings;
  settings.blade.length = 500;
  Findings findings;
  const Result<Sweep> sweep = sphereSweep(settings, 5, findings);
  ASSERT_FALSE(sweep);
  EXPECT_EQ(sweep.error().code, ErrorCode::badInput);
  EXPECT_NE(sweep.error().message.find("shorter than the section"), std::string::npos);
  EXPECT_EQ(sweep.error().value, 500.0);
  EXPECT_GT(*sweep.error().limit, 560 + 2 * settings.clearance - 1);
}

TEST(SweepAnalysis, FindsTheSphereAgain) {
  test::RowSettings settings;
  Findings findings;
  Result<Sweep> sweep = sphereSweep(settings, 31, findings);
  ASSERT_TRUE(sweep);
  const test::SphereSampler sphere(kRadius);
  const Result<SweepAnalysis> analysis = test::analysisOf(*sweep, settings, sphere, {});
  ASSERT_TRUE(analysis) << analysis.error().message;
  // Between the stations the cubic skin differs from the sphere in the fourth order only.
  EXPECT_LT(analysis->summary.deviationMax, 1e-3);
  EXPECT_EQ(analysis->summary.withinTolerance, 1.0);
  // The smallest radius is that of the outermost circle.
  EXPECT_NEAR(analysis->summary.minRadius, std::sqrt(kRadius * kRadius - 300.0 * 300.0), 0.1);
  EXPECT_TRUE(analysis->findings.empty());
  // The middle station lies on a great circle: σ = E e / R everywhere.
  const Field& stress = *analysis->cut.field("stress");
  for (int c = 0; c <= 100; ++c)
    EXPECT_NEAR(stress.values[std::size_t(analysis->stationRow[15]) * 101 + std::size_t(c)],
                settings.blade.youngModulus * settings.blade.fibreDistance() / kRadius, 0.1);
}

TEST(SweepAnalysis, TellsWhereTheSkinLeavesTheBlade) {
  test::RowSettings settings;
  Findings findings;
  const Result<Sweep> sweep = sphereSweep(settings, 9, findings);
  ASSERT_TRUE(sweep);
  const Result<SweepCheck> check = checkSweep(*sweep, settings, {});
  ASSERT_TRUE(check);
  // A skin that is drawn off station 5.
  const Loft drawn = [](const SurfaceGrid& grid, const std::vector<double>& rowParameters) {
    SurfaceGrid moved = grid;
    for (int c = 0; c < grid.columns; ++c)
      moved.points[std::size_t(4 * grid.columns + c)] += Eigen::Vector3d(0, 0, 0.034);
    return test::interpolated(moved, rowParameters);
  };
  const Result<SweepAnalysis> analysis =
      analyzeSweep(*sweep, sweep->poses, *check, settings, test::SphereSampler(kRadius), drawn, {});
  ASSERT_TRUE(analysis) << analysis.error().message;
  const Finding* off = test::findingOf<SkinOff>(analysis->findings);
  ASSERT_TRUE(off);
  EXPECT_EQ(off->severity, Severity::warning);
  EXPECT_EQ(*off->where.stations, StationRange::of(4));
  EXPECT_NEAR(std::get<SkinOff>(off->cause).distance, 0.034, 1e-4);
  EXPECT_NEAR(analysis->summary.deviationMax, 0.034, 1e-3) << "what is written is what is measured";
}

TEST(SweepAnalysis, VelocityFollowsTheMaterialPoints) {
  // On the sphere the point at arc length σ from the middle is (ρ sin σ/ρ, y, ρ cos σ/ρ) with ρ² = R² − y².
  test::RowSettings settings;
  Findings findings;
  const auto worst = [&](int n) {
    Result<Sweep> sweep = sphereSweep(settings, n, findings);
    const Result<SweepAnalysis> analysis =
        test::analysisOf(*sweep, settings, test::SphereSampler(kRadius), {});
    double error = 0;
    const Field& angle = *analysis->cut.field("angle");
    for (std::size_t i = 0; i < sweep->poses.size(); ++i) {
      const double y = -sweep->poses[i].travel, rho = std::sqrt(kRadius * kRadius - y * y);
      const double slope = y / rho;  // dρ/dtravel
      const double length = sweep->poses[i].cut.length();
      for (int c = 0; c <= 100; c += 10) {
        const double sigma = (c / 100.0 - 0.5) * length, phi = sigma / rho,
                     dphi = -sigma * slope / (rho * rho);
        const Eigen::Vector2d v(slope * std::sin(phi) + rho * std::cos(phi) * dphi,
                                slope * std::cos(phi) - rho * std::sin(phi) * dphi);
        const double expected = toDegrees(std::atan(v.norm()));
        error = std::max(
            error,
            std::abs(angle.values[std::size_t(analysis->stationRow[i]) * 101 + std::size_t(c)] - expected));
      }
    }
    return error;
  };
  const double coarse = worst(16), fine = worst(31);
  EXPECT_LT(fine, 0.02);
  EXPECT_GT(coarse / fine, 3.0);  // second order, the ends included
}

TEST(SweepAnalysis, TellsTooMuchCurvatureAndTooLittleClearance) {
  test::RowSettings settings;
  settings.blade.yieldStress = 100;  // bends to 3600 mm only
  settings.blade.length = 620;
  Findings findings;
  Result<Sweep> sweep = sphereSweep(settings, 7, findings);
  ASSERT_TRUE(sweep);
  const Result<SweepAnalysis> analysis = test::analysisOf(*sweep, settings, test::SphereSampler(kRadius), {});
  ASSERT_TRUE(analysis);
  bool curvature = false, clearance = false;
  for (const Finding& finding : analysis->findings) {
    curvature =
        curvature || (finding.kind() == FindingKind::curvature && finding.severity == Severity::error);
    clearance = clearance || finding.kind() == FindingKind::clearance;
    EXPECT_TRUE(finding.where.stations);
  }
  EXPECT_TRUE(curvature);
  EXPECT_TRUE(clearance);
}

TEST(SweepAnalysis, IsTheSameForAnyNumberOfThreads) {
  test::RowSettings settings;
  Findings findings;
  std::vector<std::vector<double>> values;
  for (const int threads : {1, 2, 5}) {
    Result<Sweep> sweep = sphereSweep(settings, 12, findings);
    RunContext context;
    context.threads = threads;
    const Result<SweepAnalysis> analysis =
        test::analysisOf(*sweep, settings, test::SphereSampler(kRadius + 1), context);
    ASSERT_TRUE(analysis);
    values.push_back(analysis->cut.field("deviation")->values);
  }
  EXPECT_EQ(values[0], values[1]);
  EXPECT_EQ(values[0], values[2]);
}

TEST(SweepAnalysis, DeviationIsNegativeInside) {
  test::RowSettings settings;
  Findings findings;
  Result<Sweep> sweep = sphereSweep(settings, 12, findings);
  const Result<SweepAnalysis> analysis =
      test::analysisOf(*sweep, settings, test::SphereSampler(kRadius + 3), {});
  ASSERT_TRUE(analysis);
  for (const double d : analysis->cut.field("deviation")->values) EXPECT_NEAR(d, -3, 1e-2);
  EXPECT_EQ(analysis->findings.front().kind(), FindingKind::deviation);
}

namespace {

/// Straight sections across −Y at z = 0, 560 mm long, each moved by `shift`(travel) along x; the indices
/// count steps of `step` mm.
template <class Shift>
std::vector<Section> straightSections(const std::vector<double>& travel, double step, Shift shift) {
  std::vector<Section> sections;
  for (const double t : travel) {
    const Frame frame{
        {shift(t), -t, 0}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitY()};
    std::vector<Eigen::Vector2d> points;
    for (int k = 0; k <= 20; ++k) points.emplace_back(-kHalfWidth + 2 * kHalfWidth * k / 20, 0);
    sections.push_back(
        {int(std::lround((t - travel.front()) / step)), t, frame, {*PlanarCurve::points(points)}});
  }
  return sections;
}

/// Travel from `first` to `last` in steps of `step`, behind what is there.
void addTravel(std::vector<double>& travel, double first, double last, double step) {
  for (double t = first; t <= last + 1e-9; t += step) travel.push_back(t);
}

struct Analysed {
  Sweep sweep;
  SweepAnalysis analysis;
  template <class T>
  const T* cause() const {
    return test::causeOf<T>(analysis.findings);
  }
  template <class T>
  const Finding* finding() const {
    return test::findingOf<T>(analysis.findings);
  }
};

Analysed analysedOn(const std::vector<Section>& sections, const test::RowSettings& settings,
                    const SurfaceSampler& target) {
  Findings findings;
  Result<Sweep> sweep =
      buildSweep(sections, settings, sphereBlock(),
                 PlaneFamily::across(sphereBlock(), -Eigen::Vector3d::UnitY()), {}, findings);
  EXPECT_TRUE(sweep) << sweep.error().message;
  Result<SweepAnalysis> analysis = test::analysisOf(*sweep, settings, target, {});
  EXPECT_TRUE(analysis) << analysis.error().message;
  return {std::move(*sweep), std::move(*analysis)};
}

}  // namespace

TEST(SweepAnalysis, MeansAreOverTheAreaWhereverTheStationsLie) {
  // d = 0.02 t on a plane that leans back, and an angle of atan(t/q) where the stations move by t²/2q along
  // x: closed forms over [0, W], whether most of the stations lie at the start or not.
  constexpr double kWidth = 600, kSlope = 0.02, kQ = 600;
  test::RowSettings settings;
  settings.tolerance = 3.02;
  const test::PlaneSampler leaning({0, kSlope, std::sqrt(1 - kSlope * kSlope)});
  std::vector<double> travel;
  addTravel(travel, 0, 99, 1);
  addTravel(travel, 100, kWidth, 25);
  const Analysed straight =
      analysedOn(straightSections(travel, 1, [](double) { return 0.0; }), settings, leaning);
  const double largest = kSlope * kWidth;
  EXPECT_NEAR(straight.analysis.summary.deviationMax, largest, 1e-9);
  EXPECT_NEAR(straight.analysis.summary.deviationMean, largest / 2, 1e-9);
  EXPECT_NEAR(straight.analysis.summary.deviationRms, largest / std::sqrt(3), 1e-3);
  // Rows lie 2.5 mm apart there, and each stands for half of that on either side.
  EXPECT_NEAR(straight.analysis.summary.withinTolerance, settings.tolerance / largest, 1.25 / kWidth);
  EXPECT_NEAR(straight.analysis.summary.angleMean, 0, 1e-12);
  const Analysed sheared =
      analysedOn(straightSections(travel, 1, [](double t) { return t * t / (2 * kQ); }), settings, leaning);
  EXPECT_NEAR(sheared.analysis.summary.deviationMean, largest / 2, 1e-3);
  EXPECT_NEAR(sheared.analysis.summary.angleMean,
              std::atan(kWidth / kQ) - kQ / (2 * kWidth) * std::log1p(std::pow(kWidth / kQ, 2)), 1e-3);
}

TEST(SweepAnalysis, EvenStationsHaveEvenRows) {
  for (const auto& [stations, between] : {std::pair{2, 64}, {9, 30}, {60, 4}, {200, 2}}) {
    std::vector<double> travel;
    addTravel(travel, 0, 0.7 * (stations - 1), 0.7);
    const Analysed even = analysedOn(straightSections(travel, 0.7, [](double) { return 0.0; }),
                                     test::RowSettings{}, test::PlaneSampler(Eigen::Vector3d::UnitZ()));
    for (int i = 0; i < stations; ++i) EXPECT_EQ(even.analysis.stationRow[std::size_t(i)], i * between);
  }
}

TEST(SweepAnalysis, GapInsideTheRowIsAnError) {
  // Two halves of a plane, 200 mm apart: between them the surface continued is what is cut.
  constexpr double kGap = 100;
  std::vector<double> travel;
  addTravel(travel, -300, -kGap, 10);
  addTravel(travel, kGap, 300, 10);
  const test::RowSettings settings;
  const Analysed halves = analysedOn(straightSections(travel, 10, [](double) { return 0.0; }), settings,
                                     test::PlaneSampler(Eigen::Vector3d::UnitZ(), kGap));
  EXPECT_NEAR(halves.analysis.summary.deviationMax, 0, 1e-9);
  const Finding* gap = halves.finding<GapInRow>();
  ASSERT_TRUE(gap);
  EXPECT_EQ(gap->severity, Severity::error);
  EXPECT_EQ(gap->where.stations->first, 20);
  EXPECT_EQ(gap->where.stations->last, 40);
  EXPECT_EQ(gap->where.stations->worst, 20);
  EXPECT_NEAR(halves.cause<GapInRow>()->width, 200, 1e-9);
  EXPECT_LT(gap->where.point->norm(), 1e-9);
  EXPECT_FALSE(halves.finding<TooFar>());
  // Where the rows lead off the plane before it, more stations would not help: the deviation lies in the gap.
  std::vector<Section> rising = straightSections(travel, 10, [](double) { return 0.0; });
  for (Section& section : rising)
    section.frame.origin.z() = 0.15 * std::max(0.0, 110 - std::abs(section.travel));
  const Analysed off = analysedOn(rising, settings, test::PlaneSampler(Eigen::Vector3d::UnitZ(), kGap));
  const TooFar* far = off.cause<TooFar>();
  ASSERT_TRUE(far);
  EXPECT_EQ(far->source, TooFar::Source::gap);
  EXPECT_EQ(far->leftFirst, 21);
  EXPECT_EQ(far->leftLast, 39);
  EXPECT_TRUE(off.finding<TooFar>()->remedies.empty());
}

TEST(SweepAnalysis, StationsLeftOutAtTheEndsAreNoGap) {
  std::vector<double> travel;
  addTravel(travel, -100, 100, 10);
  std::vector<Section> sections = straightSections(travel, 10, [](double) { return 0.0; });
  for (Section& section : sections) section.index += 5;
  EXPECT_FALSE(analysedOn(sections, test::RowSettings{}, test::PlaneSampler(Eigen::Vector3d::UnitZ()))
                   .finding<GapInRow>());
}

TEST(SweepAnalysis, ManyGapsAreOneErrorAtTheWidest) {
  std::vector<double> travel;
  for (int i = 0; i < 40; ++i)
    if (i % 5 != 3 && i != 22 && i != 24) travel.push_back(10.0 * i);
  const Analysed gaps = analysedOn(straightSections(travel, 10, [](double) { return 0.0; }),
                                   test::RowSettings{}, test::PlaneSampler(Eigen::Vector3d::UnitZ()));
  EXPECT_EQ(std::ranges::count(gaps.analysis.findings, FindingKind::gap, &Finding::kind), 1);
  EXPECT_EQ(gaps.finding<GapInRow>()->where.stations->first, 21);
  EXPECT_EQ(gaps.finding<GapInRow>()->where.stations->last, 25);
  EXPECT_EQ(gaps.cause<GapInRow>()->otherPlaces, 7);
}

TEST(SweepAnalysis, TooFewStationsAskForMore) {
  // The stations are arcs of the sphere to rounding; what lies between so few of them is not.
  test::RowSettings settings;
  settings.tolerance = 0.1;
  const test::SphereSampler sphere(kRadius);
  const auto found = [&](int stations, const SurfaceSampler& target) {
    return analysedOn(test::sphereSections(kRadius, kHalfWidth, evenTravel(stations)), settings, target);
  };
  const Analysed few = found(2, sphere);
  ASSERT_TRUE(few.cause<TooFar>());
  EXPECT_EQ(few.cause<TooFar>()->source, TooFar::Source::between);
  EXPECT_NEAR(few.cause<TooFar>()->spacing, 600, 1e-9);
  // The advice is followed until it holds.
  int stations = 2;
  for (int round = 0; round < 8; ++round) {
    const Analysed now = found(stations, sphere);
    const Finding* finding = now.finding<TooFar>();
    if (!finding) break;
    const MoreStations* more = remedyOf<MoreStations>(finding->remedies);
    ASSERT_TRUE(more);
    EXPECT_EQ(more->count, 2 * stations - 1);
    stations = more->count;
  }
  EXPECT_FALSE(found(stations, sphere).finding<TooFar>()) << stations;
  EXPECT_FALSE(found(31, sphere).finding<TooFar>());
  // Where the stations themselves are off, more of them do not help.
  const Analysed off = found(31, test::SphereSampler(kRadius + 1));
  EXPECT_EQ(off.cause<TooFar>()->source, TooFar::Source::stations);
  const Remedies& remedies = off.finding<TooFar>()->remedies;
  EXPECT_TRUE(remedyOf<CutInParts>(remedies));
  EXPECT_FALSE(remedyOf<MoreStations>(remedies));
  ASSERT_TRUE(remedyOf<WiderTolerance>(remedies));
  settings.tolerance = remedyOf<WiderTolerance>(remedies)->tolerance;
  EXPECT_FALSE(found(31, test::SphereSampler(kRadius + 1)).finding<TooFar>()) << settings.tolerance;
}

TEST(SweepAnalysis, TellsTheBladeThatBringsItsGripsOutOfTheBlock) {
  // A short straight section at one edge of the block (x from -300 to 300): the far grip comes out by 50 mm
  // at x = 350, the near one at x = -350, and the blade lies lopsided.
  test::RowSettings settings;
  settings.blade.length = 300;
  const auto sections = [] {
    std::vector<Section> result = straightSections({0, 10, 20, 30}, 10, [](double) { return -250.0; });
    for (Section& section : result)
      section.curve() = *PlanarCurve::points({{-50, 1300}, {0, 1300}, {50, 1300}});
    return result;
  };
  const test::PlaneSampler plane(Eigen::Vector3d::UnitZ());
  const Analysed shortBlade = analysedOn(sections(), settings, plane);
  const Finding* grip = shortBlade.finding<GripTooNear>();
  ASSERT_TRUE(grip);
  EXPECT_EQ(grip->severity, Severity::error);
  ASSERT_TRUE(remedyOf<OtherLength>(grip->remedies));
  EXPECT_EQ(remedyOf<OtherLength>(grip->remedies)->length, 707);  // in steps of a hundredth
  settings.blade.length = 707;
  EXPECT_FALSE(analysedOn(sections(), settings, plane).finding<GripTooNear>());
}

TEST(SweepAnalysis, TellsWhereTheBladeComesNearToTheFaceThatTheBlockLiesOn) {
  test::RowSettings settings;
  Findings findings;
  Result<Sweep> sweep = sphereSweep(settings, 31, findings);
  ASSERT_TRUE(sweep);
  // Circles about the axis: the grips are lowest, and lowest of all at the ends of the row.
  constexpr double kSettled = 5e-3;  // mm: what a row asks besides weighs little
  const auto lowest = [&](const BladePose& pose) {
    const double radius = std::sqrt(kRadius * kRadius - pose.frame.origin.y() * pose.frame.origin.y());
    return radius * std::cos(0.5 * settings.blade.length / radius) - 1200;
  };
  CheckRequest request = settings;
  const Result<SweepCheck> unasked = checkSweep(*sweep, request, {});
  ASSERT_TRUE(unasked);
  for (std::size_t i = 0; i < sweep->poses.size(); ++i) {
    EXPECT_NEAR(unasked->stations[i].aboveBottom, lowest(sweep->poses[i]), kSettled) << i;
    EXPECT_FALSE(unasked->stations[i].nearBottom);
  }
  const test::SphereSampler sphere(kRadius);
  EXPECT_FALSE(test::findingOf<NearBottom>(test::analysisOf(*sweep, request, sphere)->findings));
  request.floor = lowest(sweep->poses[5]) + 0.01;
  const Findings near = test::analysisOf(*sweep, request, sphere)->findings;
  ASSERT_EQ(std::ranges::count(near, FindingKind::floor, &Finding::kind), 2);  // one at each end
  const Finding* first = test::findingOf<NearBottom>(near);
  EXPECT_EQ(first->severity, Severity::warning);
  EXPECT_EQ(first->where.stations->first, 0);
  EXPECT_EQ(first->where.stations->last, 5);
  EXPECT_EQ(first->where.stations->worst, 0);
  EXPECT_NEAR(std::get<NearBottom>(first->cause).height, lowest(sweep->poses[0]), kSettled);
  EXPECT_TRUE(exceedsLimit(near));

  // Upside down and tilted along the blade: the lowest place lies on the way, between any that are looked at.
  const double tilt = 0.1;
  const Eigen::Vector3d up(std::sin(tilt), 0, -std::cos(tilt)), along(std::cos(tilt), 0, std::sin(tilt));
  sweep->block.frame = Frame{1600 * -up, along, up.cross(along), up};
  const Result<SweepCheck> tilted = checkSweep(*sweep, request, {});
  ASSERT_TRUE(tilted);
  for (std::size_t i = 0; i < sweep->poses.size(); ++i) {
    const double y = sweep->poses[i].frame.origin.y();
    EXPECT_NEAR(tilted->stations[i].aboveBottom, 1600 - std::sqrt(kRadius * kRadius - y * y), kSettled) << i;
  }
}

TEST(SweepAnalysis, TellsNoLongerBladeWhereItCurlsBackIntoTheBlock) {
  // A circle of radius 100 inside the block: however long the blade, its grips stay on it.
  test::RowSettings settings;
  settings.blade.section = Blade::Section::rod;
  settings.blade.outerDiameter = 0.3;
  settings.blade.length = 300;
  std::vector<Section> sections = straightSections({0, 10, 20, 30, 40}, 10, [](double) { return 0.0; });
  for (Section& section : sections) section.curve() = test::arc({0, 1275}, 100, kPi / 2 + 0.8, kPi / 2 - 0.8);
  const Analysed circles = analysedOn(sections, settings, test::PlaneSampler(Eigen::Vector3d::UnitZ()));
  const Finding* grip = circles.finding<GripTooNear>();
  ASSERT_TRUE(grip);
  EXPECT_FALSE(circles.cause<GripTooNear>()->unheldLength);
  EXPECT_TRUE(remedyOf<OtherBlock>(grip->remedies));
  EXPECT_FALSE(remedyOf<OtherLength>(grip->remedies));
}

TEST(SweepAnalysis, BladeThatKeepsTheClearanceIsTrue) {
  // Along a sphere the grips go down as well as out: 2 × the missing clearance is not enough.
  test::RowSettings settings;
  settings.clearance = 500;
  const auto found = [&](double length) -> std::optional<Finding> {
    settings.blade.length = length;
    const Analysed row = analysedOn(test::sphereSections(kRadius, kHalfWidth, evenTravel(9)), settings,
                                    test::SphereSampler(kRadius));
    const Finding* finding = row.finding<GripTooNear>();
    return finding ? std::optional(*finding) : std::nullopt;
  };
  const std::optional<Finding> missed = found(800);
  ASSERT_TRUE(missed);
  EXPECT_EQ(missed->severity, Severity::error) << "no room for 500 mm at both sides of such sections";
  const OtherLength* longer = remedyOf<OtherLength>(missed->remedies);
  ASSERT_TRUE(longer);
  EXPECT_FALSE(found(longer->length)) << longer->length;
  const std::optional<Finding> shorter = found(0.98 * longer->length);
  ASSERT_TRUE(shorter) << longer->length;
  EXPECT_EQ(shorter->severity, Severity::warning) << "room, but not as it lies";
}

TEST(ExceedsLimit, CountsErrorsAndWarningsAboutStatedLimits) {
  EXPECT_FALSE(exceedsLimit({}));
  for (const Cause& cause : {Cause(TooFar{}), Cause(GripTooNear{}), Cause(WouldSnap{})}) {
    EXPECT_TRUE(exceedsLimit({{Severity::warning, cause}})) << cause.index();
    EXPECT_FALSE(exceedsLimit({{Severity::info, cause}})) << cause.index();
  }
  for (const Cause& cause : {Cause(SteepAngle{}), Cause(UnevenSpeed{}), Cause(ManyInflections{}),
                             Cause(UnsettledFit{}), Cause(SectionMissing{}), Cause(WrongSide{})}) {
    EXPECT_FALSE(exceedsLimit({{Severity::warning, cause}})) << cause.index();
    EXPECT_TRUE(exceedsLimit({{Severity::warning, SteepAngle{}}, {Severity::error, cause}})) << cause.index();
  }
}

TEST(BladeInflections, CountOnlyWhereTheBladeBends) {
  const Elastica sine = *Elastica::make({0, 0}, 0.1, 0, {1e-4, 0}, 800);
  ASSERT_EQ(sine.inflections().size(), 3u);
  EXPECT_EQ(bladeInflections(sine), int(sine.inflections().size()) - 1);
  // Almost straight: waves of 0.01 µm.
  const Elastica straight = *Elastica::make({0, 0}, 1e-7, 0, {1e-4, 0}, 800);
  EXPECT_FALSE(straight.inflections().empty());
  EXPECT_EQ(bladeInflections(straight), 0);
  EXPECT_EQ(bladeInflections(*Elastica::make({0, 0}, 0, 0, {0, 0}, 800)), 0);
  EXPECT_EQ(bladeInflections(*Elastica::make({0, 0}, 0, 1e-3, {0, 0}, 800)), 0);
}

TEST(SweepAnalysis, StopsOnRequest) {
  test::RowSettings settings;
  Findings findings;
  Result<Sweep> sweep = sphereSweep(settings, 12, findings);
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  const Result<SweepAnalysis> analysis =
      test::analysisOf(*sweep, settings, test::SphereSampler(kRadius), context);
  ASSERT_FALSE(analysis);
  EXPECT_EQ(analysis.error().code, ErrorCode::cancelled);
}

TEST(Motion, FastestPointMovesAtTheCuttingSpeed) {
  test::RowSettings settings;
  Findings findings;
  const Result<Sweep> sweep = sphereSweep(settings, 21, findings);
  ASSERT_TRUE(sweep);
  const Result<Motion> motion = buildMotion(*sweep, {}, sweep->poses, settings, findings);
  ASSERT_TRUE(motion) << motion.error().message;
  ASSERT_EQ(motion->instants.size(), 23u);
  EXPECT_NEAR(motion->instants[1].time, settings.lead / 20, 1e-12);
  for (std::size_t i = 1; i + 1 < sweep->poses.size(); ++i) {
    const BladePose &a = sweep->poses[i], &b = sweep->poses[i + 1];
    double farthest = 0;
    for (int k = 0; k <= 400; ++k) {
      const double s = settings.blade.length * k / 400;
      farthest =
          std::max(farthest, (b.frame.toWorld(b.blade.point(s)) - a.frame.toWorld(a.blade.point(s))).norm());
    }
    EXPECT_NEAR(farthest / (motion->instants[i + 2].time - motion->instants[i + 1].time), 20, 20 * 1e-4);
  }
}

TEST(Motion, EndsFollowTheTcpConvention) {
  test::RowSettings settings;
  Findings findings;
  const Result<Sweep> sweep = sphereSweep(settings, 9, findings);
  const Result<Motion> motion = buildMotion(*sweep, {}, sweep->poses, settings, findings);
  ASSERT_TRUE(motion);
  const Box block = sphereBlock();
  Eigen::Matrix3d R_WB;
  R_WB << block.frame.x, block.frame.y, block.frame.normal;
  for (std::size_t i = 1; i + 1 < motion->instants.size(); ++i) {
    const BladePose& station = sweep->poses[i - 1];
    const Pose &left = motion->instants[i].poses[0], &right = motion->instants[i].poses[1];
    const Eigen::Matrix3d l = R_WB * left.rotation.toRotationMatrix(),
                          r = R_WB * right.rotation.toRotationMatrix();
    EXPECT_LT((l.col(0) - station.leftTangent()).norm(), 1e-12);
    EXPECT_LT((r.col(0) + station.rightTangent()).norm(), 1e-12);
    EXPECT_LT((l.col(2) - sweep->planes.direction()).norm(), 1e-12);
    EXPECT_LT((r.col(2) - sweep->planes.direction()).norm(), 1e-12);
    EXPECT_LT((block.frame.toWorld(left.position.head<2>(), left.position.z()) - station.leftPoint()).norm(),
              kPlaceUnit)
        << "in numbers that programs state";
    EXPECT_NEAR(l.determinant(), 1, 1e-12);
    EXPECT_GE(left.rotation.dot(motion->instants[i - 1].poses[0].rotation), 0);
  }
  ASSERT_TRUE(motion->approach && motion->retreat);
  EXPECT_LT((R_WB * *motion->approach - sweep->planes.direction()).norm(), 1e-12) << "in the block frame";
  EXPECT_LT((R_WB * *motion->retreat - sweep->planes.direction()).norm(), 1e-12);
}

TEST(Motion, RefusesImpossibleSpeeds) {
  test::RowSettings settings;
  Findings findings;
  const Result<Sweep> sweep = sphereSweep(settings, 4, findings);
  for (const double speed : {0.0, -1.0, double(NAN), double(INFINITY)})
    EXPECT_FALSE(buildMotion(*sweep, {}, sweep->poses, {.cuttingSpeed = speed}, findings)) << speed;
}

namespace {

/// Three equal sections of height `profile`(x) over x = -half … half.
template <class Profile>
std::vector<Section> equalSections(Profile profile, double half = 300) {
  std::vector<Section> sections;
  for (int i = 0; i < 3; ++i) {
    std::vector<Eigen::Vector2d> points;
    for (int k = 0; k <= 120; ++k) {
      const double x = half * (k / 60.0 - 1);
      points.emplace_back(x, profile(x));
    }
    const double y = 20.0 * i;
    sections.push_back(
        {i,
         y,
         Frame{{0, y, 0}, -Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY()},
         {*PlanarCurve::points(points)}});
  }
  return sections;
}

/// Nearly lines that bend only towards their ends.
std::vector<Section> nearlyStraightSections(double sag) {
  return equalSections([sag](double x) { return sag * (1 - std::pow(x / 300, 8)); });
}

/// A bulge between two hollows.
std::vector<Section> bulgeSections() {
  return equalSections([](double x) { return 20 * std::cos(2 * kPi * x / 700); });
}

}  // namespace

TEST(Sweep, BladeHoldsAlsoBeyondTheSection) {
  // The profile 1 − u⁸ is flat in the middle and drops at its ends: in tension an elastica follows it
  // closely, and curls up beyond the ends.
  test::RowSettings settings;
  settings.tolerance = 2;
  Findings findings;
  const Result<Sweep> sweep =
      buildSweep(nearlyStraightSections(0.6), settings, sphereBlock(),
                 PlaneFamily::across(sphereBlock(), Eigen::Vector3d::UnitY()), {}, findings);
  ASSERT_TRUE(sweep) << sweep.error().message;
  const Result<FitResult> free = fitElastica(sweep->fits.front().target);
  ASSERT_TRUE(free);
  const double extra = 0.5 * (settings.blade.length - free->elastica.length());
  EXPECT_GT(free->elastica.segment(-extra, free->elastica.length() + extra)->maxCurvature(),
            settings.blade.maxCurvature())
      << "the best fit alone would curl up";
  for (std::size_t i = 0; i < sweep->poses.size(); ++i) {
    EXPECT_LE(sweep->poses[i].blade.maxCurvature(), settings.blade.maxCurvature() * (1 + 1e-9));
    EXPECT_GT(stabilityMargin(sweep->poses[i].blade), 0);
    EXPECT_LE(sweep->fits[i].fit.hausdorff, 2 * settings.tolerance);
    EXPECT_EQ(sweep->fits[i].fit.status, FitStatus::constraintsActive);
    EXPECT_TRUE(sweep->fits[i].heldBack);
  }
  const Result<SweepAnalysis> analysis = test::analysisOf(*sweep, settings, test::SphereSampler(kRadius), {});
  ASSERT_TRUE(analysis);
  EXPECT_TRUE(test::findingOf<HeldBackFit>(analysis->findings));
}

TEST(Sweep, BladeHoldsOnSectionsMuchShorterThanItself) {
  // A corner of the target: 20 mm of it between 1500 mm of blade.
  test::RowSettings settings;
  settings.blade.length = 1500;
  Findings findings;
  const auto corner =
      equalSections([](double x) { return 0.05 * std::sin(0.3 * x) + 0.1 * std::sin(0.1 * x); }, 10);
  const Result<Sweep> sweep =
      buildSweep(corner, settings, sphereBlock(),
                 PlaneFamily::across(sphereBlock(), Eigen::Vector3d::UnitY()), {}, findings);
  ASSERT_TRUE(sweep) << sweep.error().message;
  for (std::size_t i = 0; i < sweep->poses.size(); ++i) {
    EXPECT_LE(sweep->poses[i].blade.maxCurvature(), settings.blade.maxCurvature() * (1 + 1e-9));
    EXPECT_GT(stabilityMargin(sweep->poses[i].blade), 0);
    EXPECT_LE(sweep->fits[i].fit.hausdorff, settings.tolerance);
  }
}

TEST(Sweep, SectionsTooRoundForABladeAreCutByOneThatMayBendSo) {
  // The end of a rod: no blade bends so far. Straight or as an arc of its smallest radius, one lies as near.
  test::RowSettings settings;
  Findings findings;
  std::vector<Section> round;
  for (int i = 0; i < 8; ++i) {
    const double half = 1.9 - 0.02 * i * (7 - i);
    round.push_back(equalSections([](double x) { return std::sqrt(4 - x * x) + 0.1 * x; }, half).front());
    round.back().index = i;
  }
  const Result<Sweep> sweep =
      buildSweep(round, settings, sphereBlock(), PlaneFamily::across(sphereBlock(), Eigen::Vector3d::UnitY()),
                 {}, findings);
  ASSERT_TRUE(sweep) << sweep.error().message;
  EXPECT_TRUE(findings.empty());
  for (std::size_t i = 0; i < sweep->poses.size(); ++i) {
    EXPECT_LE(sweep->fits[i].fit.hausdorff, settings.tolerance);
    EXPECT_LE(sweep->poses[i].blade.maxCurvature(), settings.blade.maxCurvature());
  }
}

TEST(SweepAnalysis, TellsHowLongARoundBladeStaysInItsPlane) {
  // A bulge whose blade bends back towards its grips: the longer, the more it is pressed. The plane's normal
  // is the way out of it for a tube. A row would move its grips against that: it is that of the fits.
  test::RowSettings settings;
  const auto twist = [&](double length, Blade::Section section) -> std::optional<Finding> {
    settings.blade.length = length;
    settings.blade.section = section;
    settings.blade.width = 5;
    settings.blade.thickness = 1;
    const Result<Sweep> sweep = fitSweep(bulgeSections(), settings, sphereBlock(),
                                         PlaneFamily::across(sphereBlock(), Eigen::Vector3d::UnitY()), {});
    EXPECT_TRUE(sweep);
    const Result<SweepAnalysis> analysis =
        test::analysisOf(*sweep, settings, test::SphereSampler(kRadius), {});
    EXPECT_TRUE(analysis);
    const Finding* finding = test::findingOf<WouldTwist>(analysis->findings);
    return finding ? std::optional(*finding) : std::nullopt;
  };
  const std::optional<Finding> found = twist(800, Blade::Section::tube);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->severity, Severity::error);
  const OtherLength* shorter = remedyOf<OtherLength>(found->remedies);
  ASSERT_TRUE(shorter);
  EXPECT_LT(shorter->length, 800);
  EXPECT_FALSE(twist(shorter->length, Blade::Section::tube)) << shorter->length;
  EXPECT_TRUE(twist(shorter->length + 2, Blade::Section::tube)) << shorter->length;
  EXPECT_FALSE(twist(800, Blade::Section::flat));
}

TEST(SweepAnalysis, TellsWhereALongerBladeWouldNotHold) {
  // Continued to 300 mm beyond the block, a bulge becomes nearly two waves.
  test::RowSettings settings;
  settings.blade.length = 640;
  settings.clearance = 300;
  std::vector<Section> sections = bulgeSections();
  for (Section& section : sections) section.frame.origin.z() = 1375;
  const Analysed waves = analysedOn(sections, settings, test::SphereSampler(kRadius));
  const Finding* grip = waves.finding<GripTooNear>();
  ASSERT_TRUE(grip);
  EXPECT_TRUE(waves.cause<GripTooNear>()->unheldLength);
  ASSERT_TRUE(remedyOf<OtherBlock>(grip->remedies));
  EXPECT_EQ(remedyOf<OtherBlock>(grip->remedies)->how, OtherBlock::How::smaller);
}

TEST(SweepAnalysis, FitsThatDidNotComeToRestAreOneFindingAStretch) {
  test::RowSettings settings;
  Findings findings;
  Result<Sweep> sweep = sphereSweep(settings, 9, findings);
  ASSERT_TRUE(sweep);
  for (const int i : {2, 3, 4}) sweep->fits[std::size_t(i)].fit.status = FitStatus::iterationLimit;
  sweep->fits[3].fit.hausdorff = 0.25;
  sweep->fits[7].fit.status = FitStatus::infeasible;
  sweep->fits[7].fit.conflict = {"length"};
  const Result<SweepAnalysis> analysis = test::analysisOf(*sweep, settings, test::SphereSampler(kRadius), {});
  ASSERT_TRUE(analysis);
  const Finding* unmet = test::findingOf<UnmetConditions>(analysis->findings);
  ASSERT_TRUE(unmet);
  EXPECT_EQ(unmet->severity, Severity::error);
  EXPECT_EQ(*unmet->where.stations, StationRange::of(7));
  EXPECT_EQ(std::get<UnmetConditions>(unmet->cause).conditions, std::vector<std::string>{"length"});
  const Finding* unsettled = test::findingOf<UnsettledFit>(analysis->findings);
  ASSERT_TRUE(unsettled);
  EXPECT_EQ(unsettled->severity, Severity::warning);
  EXPECT_EQ(*unsettled->where.stations, (StationRange{2, 4, 3, 3}));
  EXPECT_EQ(std::get<UnsettledFit>(unsettled->cause).distance, 0.25);
}

TEST(SweepAnalysis, MarginsAreThoseOfTheBlade) {
  test::RowSettings settings;
  Findings findings;
  Result<Sweep> sweep = sphereSweep(settings, 5, findings);
  ASSERT_TRUE(sweep);
  const Result<SweepCheck> check = checkSweep(*sweep, settings, {});
  ASSERT_TRUE(check);
  for (std::size_t i = 0; i < sweep->poses.size(); ++i) {
    EXPECT_EQ(check->stations[i].stabilityMargin, stabilityMargin(sweep->poses[i].blade));
    EXPECT_EQ(check->stations[i].outOfPlaneMargin, outOfPlaneMargin(sweep->poses[i].blade))
        << "the preset is a tube";
    EXPECT_TRUE(check->stations[i].stable);
  }
}

}  // namespace bw
