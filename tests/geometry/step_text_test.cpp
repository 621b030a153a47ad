// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "bw/core/files/file_set.h"
#include "shapes.h"

namespace bw::geometry::test {
namespace {

SplineSurface wave() {
  SurfaceGrid grid;
  grid.rows = 7;
  grid.columns = 9;
  std::vector<double> v;
  for (int r = 0; r < grid.rows; ++r) {
    v.push_back(std::pow(r / 6.0, 1.3));
    for (int c = 0; c < grid.columns; ++c) {
      const double x = 80.0 * c + 0.1, y = 600 * v.back() - 1.0 / 3;
      grid.points.push_back({x, y, 1e-9 * c + 37 * std::sin(x / 140) * std::cos(y / 230) - 1234.5});
    }
  }
  return loft(grid, v).value();
}

TEST(StepText, ReadsBackAsTheSameSurface) {
  const SplineSurface surface = wave();
  const auto sampler = targetOf(stepText(surface, "wave").value()).sampler();
  double worst = 0;
  for (int i = 0; i <= 40; ++i) {
    for (int j = 0; j <= 40; ++j) {
      const auto foot = sampler->closest(surface.value(i / 40.0, j / 40.0), nullptr);
      ASSERT_TRUE(foot);
      worst = std::max(worst, foot->distance);
    }
  }
  EXPECT_LT(worst, 1e-6);
}

TEST(IgesText, ReadsBackAsTheSameSurfaceInMillimetres) {
  const SplineSurface surface = wave();
  const auto text = igesText(surface, "wave");
  ASSERT_TRUE(text) << text.error().message;
  const auto model = CadModel::readBytes(*text, "wave.iges");
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->info().format, "IGES");
  EXPECT_EQ(model->info().unit, "mm");
  EXPECT_EQ(model->info().faces, 1);
  const auto target = Target::make(*model, {});
  ASSERT_TRUE(target) << target.error().message;
  const auto sampler = target->sampler();
  double worst = 0;
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; j <= 40; ++j) {
      const auto foot = sampler->closest(surface.value(i / 40.0, j / 40.0), nullptr);
      ASSERT_TRUE(foot);
      worst = std::max(worst, foot->distance);
    }
  EXPECT_LT(worst, 1e-6);
}

TEST(IgesText, EqualInputGivesEqualBytesWithoutDateOrMachine) {
  const std::string a = igesText(wave(), "wave Ø").value();
  EXPECT_EQ(a, igesText(wave(), "wave Ø").value());
  EXPECT_NE(a.find("20000101.000000"), std::string::npos);
  char host[256] = {};
  ASSERT_EQ(::gethostname(host, sizeof(host) - 1), 0);
  if (std::string(host).size() > 3) {
    EXPECT_EQ(a.find(host), std::string::npos);
  }
  SplineSurface bad = wave();
  bad.poles[3].x() = std::numeric_limits<double>::quiet_NaN();
  expectError(igesText(bad, "bad"), ErrorCode::badInput, "pole 3");
}

TEST(StepText, EqualInputGivesEqualBytesAndNoDate) {
  const auto a = stepText(wave(), "wave"), b = stepText(wave(), "wave");
  ASSERT_TRUE(a && b);
  EXPECT_EQ(*a, *b);
  EXPECT_NE(a->find("FILE_NAME('wave','',"), std::string::npos);
  EXPECT_EQ(a->find('\r'), std::string::npos);
}

TEST(StepText, WritesNumbersTheWayTheStandardWants) {
  SplineSurface s;
  s.degreeU = s.degreeV = 1;
  s.knotsU = s.knotsV = {0, 0, 1, 1};
  s.polesU = s.polesV = 2;
  s.poles = {{0, -0.0, 1e-20}, {1e21, 0, 0}, {0, 12, 0.1}, {1e21, 12, -2.5e-7}};
  const std::string text = stepText(s, "numbers").value();
  EXPECT_NE(text.find("(0.,0.,1.E-20)"), std::string::npos);
  EXPECT_NE(text.find("(1.E+21,0.,0.)"), std::string::npos);
  EXPECT_NE(text.find("(0.,12.,0.1)"), std::string::npos);
  EXPECT_NE(text.find("(1.E+21,12.,-2.5E-07)"), std::string::npos);
}

TEST(StepText, NamesKeepQuotesAndForeignLetters) {
  const std::string text = stepText(wave(), "it's \\ Ærø 𝄞").value();
  EXPECT_NE(text.find("'it''s \\\\ \\X2\\00C6\\X0\\r\\X2\\00F8\\X0\\ \\X4\\0001D11E\\X0\\'"),
            std::string::npos);
  // Letters of both kinds beside each other.
  EXPECT_NE(stepText(wave(), "Æ𝄞𝄢øå")
                .value()
                .find("'\\X2\\00C6\\X0\\\\X4\\0001D11E0001D122\\X0\\\\X2\\00F800E5\\X0\\'"),
            std::string::npos);
  EXPECT_TRUE(CadModel::readBytes(text, "name.step"));
}

TEST(StepText, TellsFacesApartWhoseNamesComeOutTheSame) {
  const SplineSurface surface = wave();
  const NamedSurface surfaces[] = {{"a\tb", &surface}, {"a\nb", &surface}, {"a\\tb", &surface}};
  const std::string text = stepText(surfaces, "three").value();
  for (const char* name : {"'a\\\\tb'", "'a\\\\nb'", "'a\\\\tb (2)'"})
    EXPECT_NE(text.find(std::string("=ADVANCED_FACE(") + name), std::string::npos) << name;
}

TEST(StepText, RefusesWhatIsNoSurface) {
  SplineSurface s = wave();
  s.poles[3].y() = std::numeric_limits<double>::infinity();
  expectError(stepText(s, "bad"), ErrorCode::badInput, "pole 3");
  s = wave();
  s.poles.pop_back();
  expectError(stepText(s, "bad"), ErrorCode::badInput, "poles");
  s = wave();
  s.knotsU.pop_back();
  expectError(stepText(s, "bad"), ErrorCode::badInput, "knots");
  s = wave();
  std::swap(s.knotsV.front(), s.knotsV.back());
  expectError(stepText(s, "bad"), ErrorCode::badInput, "ascending");
  expectError(stepText(SplineSurface{}, "bad"), ErrorCode::badInput, "knots");
}

}  // namespace
}  // namespace bw::geometry::test
