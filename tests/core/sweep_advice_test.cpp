// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What the findings advise is followed, number by number: it must not be refused, and must mend what it was
// said of.
#include <gtest/gtest.h>

#include <cmath>

#include "analytic_surfaces.h"
#include "bw/core/base/units.h"
#include "finding_of.h"
#include "plane_sections.h"
#include "row_settings.h"

namespace bw {

namespace {

using test::findingOf;
using test::numberAfter;

struct Tried {
  Result<Sweep> sweep = fail(ErrorCode::internal, "not run");
  Findings findings;
};

/// Nine sections y = height(x), |x| ≤ half, 10 mm apart, and what is found of their sweep.
template <class Height>
Tried run(const test::RowSettings& settings, double half, Height height) {
  Tried result;
  const Box block = test::blockUnder(half, 80, -2 * half, 2 * half);
  result.sweep =
      buildSweep(test::sectionsOf(9, 10, [&](int) { return test::graphCurve(half, height); }), settings,
                 block, PlaneFamily::across(block, -Eigen::Vector3d::UnitY()), {}, result.findings);
  if (!result.sweep) return result;
  const Result<SweepAnalysis> analysis =
      test::analysisOf(*result.sweep, settings, test::GraphSampler<Height>(half, height), {});
  EXPECT_TRUE(analysis) << analysis.error().message;
  if (analysis)
    result.findings.insert(result.findings.end(), analysis->findings.begin(), analysis->findings.end());
  return result;
}

/// A sine of that amplitude over its whole length 2π · wave.
auto sine(double amplitude, double wave) {
  return [amplitude, wave](double x) { return amplitude * std::cos(x / wave); };
}

/// A blade that bends to `radius` mm, of the default steel.
Blade bladeOfRadius(double radius, double length) {
  Blade blade;
  blade.name = "custom";
  blade.section = Blade::Section::flat;
  blade.width = 5;
  blade.thickness = 1;
  blade.thickness *= radius / blade.minRadius();
  blade.length = length;
  return blade;
}

/// True if the finding about sections that are too tight is among them.
bool tooTight(const Findings& findings) { return findingOf<TooTight>(findings); }

}  // namespace

TEST(Advice, LengthForASectionThatIsLongerThanTheBladeIsEnough) {
  for (const double clearance : {0.0, 50.0, 400.0})
    for (const double half : {450.0, 1100.0}) {
      test::RowSettings settings;
      settings.clearance = clearance;
      settings.blade = bladeOfRadius(100, 300);
      const Tried refused = run(settings, half, sine(20, half / 3));
      ASSERT_FALSE(refused.sweep);
      const OtherLength* longer = remedyOf<OtherLength>(refused.sweep.error().remedies);
      ASSERT_TRUE(longer) << refused.sweep.error().message;
      settings.blade.length = longer->length;
      EXPECT_EQ(numberAfter(refused.sweep.error().message, "choose a blade of "), longer->length);
      EXPECT_EQ(*refused.sweep.error().limit, settings.blade.length);
      EXPECT_LE(settings.blade.length, Blade::kLongest);
      EXPECT_TRUE(run(settings, half, sine(20, half / 3)).sweep) << settings.blade.length;
    }
}

TEST(Advice, NoBladeIsAdvisedThatIsLongerThanAJobTakes) {
  test::RowSettings settings;
  settings.blade = bladeOfRadius(100, 800);
  const Tried refused = run(settings, 14'400, sine(500, 4000));
  ASSERT_FALSE(refused.sweep);
  const std::string& message = refused.sweep.error().message;
  EXPECT_EQ(message.find("choose a blade of"), std::string::npos) << message;
  EXPECT_NE(message.find("no blade may be longer than 20000 mm"), std::string::npos) << message;
  EXPECT_NE(message.find("smaller block"), std::string::npos) << message;
}

TEST(Advice, TooTightIsSaidWithPlaceRadiusLimitAndRemedy) {
  // Waves of 40 mm with radii down to 25 mm, for a blade that bends to 360 mm.
  test::RowSettings settings;
  settings.blade = bladeOfRadius(360, 800);
  const Tried tight = run(settings, 250, sine(40, 31.6));
  ASSERT_TRUE(tight.sweep) << tight.sweep.error().message;
  ASSERT_TRUE(tooTight(tight.findings));
  const Finding* finding = findingOf<TooTight>(tight.findings);
  EXPECT_TRUE(finding->where.stations);
  ASSERT_TRUE(finding->where.point);
  EXPECT_NEAR(finding->where.point->z(), sine(40, 31.6)(finding->where.point->x()), 1);
  const auto& cause = std::get<TooTight>(finding->cause);
  EXPECT_NEAR(cause.limit, 360, 1e-9);
  EXPECT_GT(cause.radius, 20);
  EXPECT_LT(cause.radius, 90);
  // What it says of the distance is true.
  EXPECT_GT(cause.distance, 10);
  const BendingBlade* blade = remedyOf<BendingBlade>(finding->remedies);
  ASSERT_TRUE(blade);
  EXPECT_EQ(blade->title, "Spring steel rod 1 mm");
  EXPECT_FALSE(blade->presetBends());
}

TEST(Advice, ABladeThatHardlyBendsAtAllIsTold) {
  test::RowSettings settings;
  settings.blade.section = Blade::Section::rod;
  settings.blade.outerDiameter = 30;
  settings.blade.yieldStress = 0.01;
  settings.blade.safety = 10;
  ASSERT_GT(settings.blade.minRadius(), 1e9);
  const Tried tight = run(settings, 250, sine(20, 80));
  ASSERT_TRUE(tight.sweep) << tight.sweep.error().message;
  EXPECT_TRUE(tooTight(tight.findings));
}

TEST(Advice, BladeThatBendsFarEnoughIsNotTooTightAnyMore) {
  for (const double wave : {31.6, 100.0}) {
    test::RowSettings settings;
    settings.blade = bladeOfRadius(360, 900);
    const Tried tight = run(settings, 250, sine(40, wave));
    const Finding* finding = findingOf<TooTight>(tight.findings);
    ASSERT_TRUE(finding) << wave;
    settings.blade = bladeOfRadius(remedyOf<BendingBlade>(finding->remedies)->radius, 900);
    const Tried eased = run(settings, 250, sine(40, wave));
    ASSERT_TRUE(eased.sweep) << eased.sweep.error().message;
    EXPECT_FALSE(tooTight(eased.findings)) << wave;
    // A little less far, and it is.
    settings.blade = bladeOfRadius(1.1 * settings.blade.minRadius(), 900);
    EXPECT_TRUE(tooTight(run(settings, 250, sine(40, wave)).findings)) << wave;
  }
}

TEST(Advice, LargerSurfaceIsNotTooTightAnyMore) {
  for (const double wave : {31.6, 80.0}) {
    test::RowSettings settings;
    settings.blade = bladeOfRadius(360, 900);
    const Tried tight = run(settings, 250, sine(40, wave));
    const Finding* finding = findingOf<TooTight>(tight.findings);
    ASSERT_TRUE(finding) << wave;
    const LargerSurface* surface = remedyOf<LargerSurface>(finding->remedies);
    ASSERT_TRUE(surface) << wave;
    const double scale = surface->scale;
    ASSERT_GT(scale, 1);
    if (surface->bladeLength) settings.blade.length = *surface->bladeLength;
    EXPECT_LE(settings.blade.length, Blade::kLongest);
    const Tried larger = run(settings, scale * 250, sine(scale * 40, scale * wave));
    ASSERT_TRUE(larger.sweep) << larger.sweep.error().message;
    EXPECT_FALSE(tooTight(larger.findings)) << scale;
  }
}

TEST(Advice, GentleSectionsAreNeverTooTight) {
  // Arcs at the limit of the blade, within it by 2 %, up to a third of a turn.
  test::RowSettings settings;
  settings.blade = bladeOfRadius(200, 900);
  const Box block = test::blockUnder(204, 80, 0, 204);
  for (const double turn : {0.2, 0.6, 1.0}) {
    Findings findings;
    const auto arc = [&](int) { return test::arc({0, 0}, 204, kPi / 2 + turn, kPi / 2 - turn); };
    Result<Sweep> sweep = buildSweep(test::sectionsOf(9, 10, arc), settings, block,
                                     PlaneFamily::across(block, -Eigen::Vector3d::UnitY()), {}, findings);
    ASSERT_TRUE(sweep);
    const Result<SweepAnalysis> analysis =
        test::analysisOf(*sweep, settings, test::PlaneSampler(Eigen::Vector3d::UnitZ()), {});
    ASSERT_TRUE(analysis);
    EXPECT_FALSE(tooTight(analysis->findings)) << turn;
  }
}

TEST(Advice, ShorterBladeHoldsItsShape) {
  // Blades that buckle, twist or overbend beyond a short section: the length that is told does, and is no
  // refusal.
  int followed = 0;
  for (const auto section : {Blade::Section::flat, Blade::Section::rod})
    for (const double amplitude : {6.0, 40.0})
      for (const double length : {900.0, 1800.0}) {
        test::RowSettings settings;
        settings.blade = bladeOfRadius(80, length);
        if (section == Blade::Section::rod) {
          settings.blade.section = section;
          settings.blade.outerDiameter = settings.blade.thickness;
        }
        const Tried before = run(settings, 150, sine(amplitude, 60));
        ASSERT_TRUE(before.sweep);
        for (const Finding& finding : before.findings) {
          const OtherLength* advised = remedyOf<OtherLength>(finding.remedies);
          if (!advised || finding.kind() == FindingKind::clearance) continue;
          ++followed;
          test::RowSettings shorter = settings;
          shorter.blade.length = advised->length;
          const Tried after = run(shorter, 150, sine(amplitude, 60));
          EXPECT_TRUE(after.sweep) << advised->length;
          EXPECT_FALSE(findingOf(after.findings, finding.kind())) << advised->length;
        }
      }
  EXPECT_GT(followed, 0);
}

}  // namespace bw
