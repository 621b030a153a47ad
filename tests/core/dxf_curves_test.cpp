// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Curves of DXF drawings, as several programs write them, and drawings that are damaged or hold something
// else.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <sstream>

#include "bw/core/base/units.h"
#include "bw/core/dxf/dxf_curves.h"

namespace bw::test {
namespace {

/// "0 LINE 8 walls 10 0": codes and values, a line each.
std::string groups(const std::string& words) {
  std::istringstream stream(words);
  std::string text, word;
  while (stream >> word) text += word + "\n";
  return text;
}

std::string drawing(const std::string& entities, const std::string& header = "9 $INSUNITS 70 4") {
  return groups("0 SECTION 2 HEADER " + header + " 0 ENDSEC 0 SECTION 2 ENTITIES " + entities +
                " 0 ENDSEC 0 EOF");
}

DxfCurves read(const std::string& text) {
  auto read = readDxf(text, "a.dxf");
  EXPECT_TRUE(read) << (read ? "" : read.error().message);
  return read ? *read : DxfCurves{};
}

void expectError(const std::string& text, ErrorCode code, const std::string& part) {
  const auto result = readDxf(text, "a.dxf");
  ASSERT_FALSE(result.has_value()) << "expected: " << part;
  EXPECT_EQ(result.error().code, code);
  EXPECT_NE(result.error().message.find(part), std::string::npos)
      << result.error().message << "\nin place of: " << part;
}

Eigen::Vector3d firstOf(const SpaceCurve& curve) { return curve.value(curve.start()); }
Eigen::Vector3d lastOf(const SpaceCurve& curve) { return curve.value(curve.end()); }

TEST(DxfCurves, LinesArcsPolylinesAndSplinesInTheOrderOfTheFile) {
  const DxfCurves all = read(drawing(
      "0 LINE 8 walls 10 1 20 2 30 3 11 4 21 5 31 6 "
      "0 ARC 8 walls 10 100 20 50 30 7 40 10 50 350 51 90 "
      "0 LWPOLYLINE 8 roof 90 3 70 0 38 5 10 0 20 0 10 10 20 0 10 10 20 10 "
      "0 POLYLINE 8 roof 66 1 70 8 10 0 20 0 30 0 0 VERTEX 8 roof 70 32 10 1 20 2 30 3 0 VERTEX 8 roof 70 32 "
      "10 4 "
      "20 5 30 9 0 SEQEND 8 roof "
      "0 SPLINE 8 roof 70 8 71 3 72 8 73 4 74 0 40 0 40 0 40 0 40 0 40 1 40 1 40 1 40 1 10 0 20 0 30 0 10 1 "
      "20 0 30 "
      "1 10 2 20 0 30 1 10 3 20 0 30 0 "
      "0 ELLIPSE 8 roof 10 0 20 0 30 0 11 20 21 0 31 0 210 0 220 0 230 1 40 0.5 41 0 42 1.5707963267948966"));
  EXPECT_EQ(all.unit, "mm");
  ASSERT_EQ(all.curves.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(all.curves[i].number, int(i) + 1);
  EXPECT_EQ(all.curves[0].name, "walls");
  EXPECT_EQ(all.curves[2].name, "roof");
  EXPECT_EQ(firstOf(all.curves[0]), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(lastOf(all.curves[0]), Eigen::Vector3d(4, 5, 6));
  const double ten = 10 * kDegree;
  EXPECT_LT(
      (firstOf(all.curves[1]) - Eigen::Vector3d(100 + 10 * std::cos(ten), 50 - 10 * std::sin(ten), 7)).norm(),
      1e-9);
  EXPECT_LT((lastOf(all.curves[1]) - Eigen::Vector3d(100, 60, 7)).norm(), 1e-9);
  EXPECT_EQ(all.curves[2].poles[2], Eigen::Vector3d(10, 10, 5));
  EXPECT_EQ(lastOf(all.curves[3]), Eigen::Vector3d(4, 5, 9));
  EXPECT_LT((all.curves[4].value(0.5) - Eigen::Vector3d(1.5, 0, 0.75)).norm(), 1e-12);
  EXPECT_LT((lastOf(all.curves[5]) - Eigen::Vector3d(0, 10, 0)).norm(), 1e-12);
  EXPECT_TRUE(all.leftOut.empty());
}

TEST(DxfCurves, BulgesAreArcsBetweenTheirVertices) {
  // A half circle to the left of the way (bulge -1), a line, a quarter to the right.
  const DxfCurves all = read(drawing(
      "0 LWPOLYLINE 8 0 90 4 70 0 10 0 20 0 42 -1 10 20 20 0 10 40 20 0 42 0.41421356237309503 10 50 20 10"));
  ASSERT_EQ(all.curves.size(), 1u);
  const SpaceCurve& curve = all.curves[0];
  EXPECT_EQ(firstOf(curve), Eigen::Vector3d(0, 0, 0));
  EXPECT_LT((lastOf(curve) - Eigen::Vector3d(50, 10, 0)).norm(), 1e-12);
  double highest = 0;
  for (const Eigen::Vector3d& p : curve.samples(1000)) {
    highest = std::max(highest, p.y());
    if (p.x() < 20 - 1e-9) {
      EXPECT_NEAR((p - Eigen::Vector3d(10, 0, 0)).norm(), 10, 1e-9);
    } else if (p.x() <= 40) {
      EXPECT_NEAR(p.y(), 0, 1e-9);
    } else {
      EXPECT_NEAR((p - Eigen::Vector3d(40, 10, 0)).norm(), 10, 1e-9);
    }
  }
  EXPECT_NEAR(highest, 10, 0.1) << "clockwise from left to right is above";
}

TEST(DxfCurves, ArcsAndPolylinesLieInThePlaneOfTheirExtrusion) {
  // Extrusion -y: x of the plane is the world's x, y of it its z.
  const DxfCurves all =
      read(drawing("0 LWPOLYLINE 8 0 90 2 70 0 38 -800 10 1 20 2 10 3 20 4 210 0 220 -1 230 0 "
                   "0 ARC 8 0 10 5 20 6 30 -100 40 1 50 0 51 90 210 0 220 -1 230 0 "
                   "0 POLYLINE 8 0 66 1 70 0 10 0 20 0 30 -7 210 0 220 -1 230 0 0 VERTEX 8 0 10 1 20 1 30 -7 "
                   "0 VERTEX 8 0 10 2 "
                   "20 9 30 -7 0 SEQEND "
                   "0 ARC 8 0 10 5 20 6 30 1 40 1 50 0 51 90 210 0 220 0 230 -1"));
  ASSERT_EQ(all.curves.size(), 4u);
  EXPECT_LT((firstOf(all.curves[0]) - Eigen::Vector3d(1, 800, 2)).norm(), 1e-12);
  EXPECT_LT((lastOf(all.curves[0]) - Eigen::Vector3d(3, 800, 4)).norm(), 1e-12);
  EXPECT_LT((firstOf(all.curves[1]) - Eigen::Vector3d(6, 100, 6)).norm(), 1e-12);
  EXPECT_LT((lastOf(all.curves[1]) - Eigen::Vector3d(5, 100, 7)).norm(), 1e-12);
  EXPECT_LT((lastOf(all.curves[2]) - Eigen::Vector3d(2, 7, 9)).norm(), 1e-12);
  EXPECT_LT((firstOf(all.curves[3]) - Eigen::Vector3d(-6, 6, -1)).norm(), 1e-12)
      << "mirrored: x runs the other way";
}

namespace {

/// A drawing with blocks, cm.
std::string withBlocks(const std::string& blocks, const std::string& entities) {
  return groups("0 SECTION 2 HEADER 9 $INSUNITS 70 5 0 ENDSEC 0 SECTION 2 BLOCKS " + blocks +
                " 0 ENDSEC 0 SECTION 2 ENTITIES " + entities + " 0 ENDSEC 0 EOF");
}

const std::string kProfile =
    "0 BLOCK 8 0 2 Profile 70 0 10 1 20 2 30 0 0 LINE 8 0 10 1 20 2 30 0 11 4 21 2 31 1 "
    "0 ARC 8 ridge 10 4 20 2 30 1 40 2 50 0 51 90 0 TEXT 8 0 1 title 0 ENDBLK ";

double distance(const Eigen::Vector3d& p, double x, double y, double z) {
  return (p - Eigen::Vector3d(x, y, z)).norm();
}

}  // namespace

TEST(DxfCurves, BlocksArePutWhereTheyAreInserted) {
  // Stretched by 2 along x and turned by 90°; its base comes to (10, 20, 30). Names are the same in capitals.
  const DxfCurves all =
      read(withBlocks(kProfile, "0 INSERT 8 roof 2 PROFILE 10 10 20 20 30 30 41 2 42 1 43 3 50 90"));
  ASSERT_EQ(all.curves.size(), 2u);
  EXPECT_EQ(all.leftOut, (std::vector<std::string>{"1 × TEXT"}));
  EXPECT_EQ(all.curves[0].name, "roof") << "what lies on the layer 0 of a block has that of the insertion";
  EXPECT_EQ(all.curves[1].name, "ridge");
  EXPECT_EQ(all.curves[1].number, 2);
  EXPECT_LT(distance(firstOf(all.curves[0]), 100, 200, 300), 1e-9);
  EXPECT_LT(distance(lastOf(all.curves[0]), 100, 260, 330), 1e-9);
  // The arc is one of an ellipse, exactly: about (100, 260, 330), 40 along y and 20 along -x.
  for (const Eigen::Vector3d& p : all.curves[1].samples(50)) {
    EXPECT_NEAR(std::hypot((p.x() - 100) / 20, (p.y() - 260) / 40), 1, 1e-12);
    EXPECT_NEAR(p.z(), 330, 1e-9);
    EXPECT_LE(p.x(), 100 + 1e-9);
  }
  EXPECT_LT(distance(firstOf(all.curves[1]), 100, 300, 330), 1e-9);
  EXPECT_LT(distance(lastOf(all.curves[1]), 80, 260, 330), 1e-9);
}

TEST(DxfCurves, BlocksInRowsAndColumnsMirroredAndInThePlaneOfTheirExtrusion) {
  const std::string line = "0 BLOCK 2 b 10 0 20 0 0 LINE 8 0 10 0 20 0 11 1 21 0 0 ENDBLK ";
  // Two columns 5 apart, three rows 7 apart, along axes that are turned by 90°; distances are not stretched.
  const DxfCurves all =
      read(withBlocks(line, "0 INSERT 8 0 2 b 10 0 20 0 41 2 42 2 50 90 70 2 71 3 44 5 45 7"));
  ASSERT_EQ(all.curves.size(), 6u);
  EXPECT_LT(distance(lastOf(all.curves[0]), 0, 20, 0), 1e-9);
  EXPECT_LT(distance(firstOf(all.curves[1]), 0, 50, 0), 1e-9);
  EXPECT_LT(distance(firstOf(all.curves[2]), -70, 0, 0), 1e-9);
  EXPECT_LT(distance(lastOf(all.curves[5]), -140, 70, 0), 1e-9);
  // Extrusion -y: x of the plane is the world's x, y of it its z, and 30 runs against the world's y.
  const DxfCurves upright =
      read(withBlocks(line, "0 INSERT 8 0 2 b 10 3 20 4 30 -8 41 -1 50 90 210 0 220 -1 230 0"));
  ASSERT_EQ(upright.curves.size(), 1u);
  EXPECT_LT(distance(firstOf(upright.curves[0]), 30, 80, 40), 1e-9);
  EXPECT_LT(distance(lastOf(upright.curves[0]), 30, 80, 30), 1e-9);
}

TEST(DxfCurves, BlocksWithinBlocksAreTheSameAsExploded) {
  // An arm of two blocks, inserted with attributes; and the same, moved by hand.
  const DxfCurves all = read(withBlocks(
      kProfile +
          "0 BLOCK 2 pair 10 0 20 0 0 INSERT 8 0 2 profile 10 0 20 0 0 INSERT 8 other 2 profile 10 100 20 "
          "0 41 -1 0 POLYLINE 8 0 66 1 70 8 0 VERTEX 10 0 20 0 30 0 0 VERTEX 10 9 20 0 30 0 0 SEQEND 0 "
          "ENDBLK",
      "0 INSERT 8 roof 2 pair 66 1 10 0 20 50 50 180 0 ATTRIB 8 0 1 x 0 SEQEND 8 0 0 LINE 8 0 10 0 20 0 11 1 "
      "21 1"));
  ASSERT_EQ(all.curves.size(), 6u);
  const char* layers[] = {"roof", "ridge", "other", "ridge", "roof", "0"};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(all.curves[i].name, layers[i]) << i;
    EXPECT_EQ(all.curves[i].number, int(i) + 1);
  }
  EXPECT_LT(distance(lastOf(all.curves[0]), -30, 500, 10), 1e-9);
  EXPECT_LT(distance(lastOf(all.curves[2]), -1000 + 30, 500, 10), 1e-9);
  EXPECT_LT(distance(lastOf(all.curves[3]), -1000 + 30, 480, 10), 1e-9) << "the arc is mirrored";
  EXPECT_LT(distance(lastOf(all.curves[4]), -90, 500, 0), 1e-9);
  EXPECT_LT(distance(lastOf(all.curves[5]), 10, 10, 0), 1e-9);
}

TEST(DxfCurves, BlocksThatCannotBeInsertedAreToldWithTheirLine) {
  const auto refuse = [](const std::string& blocks, const std::string& entities, ErrorCode code,
                         const std::string& part) { expectError(withBlocks(blocks, entities), code, part); };
  refuse("0 BLOCK 2 a 0 INSERT 8 0 2 b 0 ENDBLK 0 BLOCK 2 b 0 INSERT 8 0 2 a 0 ENDBLK", "0 INSERT 8 0 2 a",
         ErrorCode::badInput, "more than 32 deep in others, or in itself");
  refuse(kProfile, "0 INSERT 8 0 2 profil", ErrorCode::badInput,
         "the block \"profil\", which the file does not hold");
  refuse(kProfile, "0 INSERT 8 0 2 profile 41 0", ErrorCode::cannotRead, "with a scale of nothing");
  refuse("0 BLOCK 2 a 0 POLYLINE 8 0 70 8 0 ENDBLK", "0 INSERT 8 0 2 a", ErrorCode::cannotRead,
         "ends within a polyline");
  refuse("0 BLOCK 2 a 0 CIRCLE 8 0 10 0 20 0 40 1 0 ENDBLK", "0 INSERT 8 0 2 a", ErrorCode::badInput,
         "is closed");
  refuse("0 BLOCK 2 a 0 LINE 8 0 11 1 0 ENDBLK", "0 INSERT 8 0 2 a 70 1000000000 71 1000000000",
         ErrorCode::badInput, "more than 10000 curves");
  refuse("0 BLOCK 2 a 0 ENDBLK", "0 INSERT 8 0 2 a 70 1000000000 71 1000000000", ErrorCode::badInput,
         "export what is needed of it alone");
  // Blocks of nothing, as often as they like.
  std::string blocks = "0 BLOCK 2 b0 0 TEXT 8 0 0 ENDBLK ";
  for (int i = 1; i < 20; ++i)
    blocks += "0 BLOCK 2 b" + std::to_string(i) + " 0 INSERT 8 0 2 b" + std::to_string(i - 1) +
              " 70 1000 71 1000 0 ENDBLK ";
  refuse(blocks, "0 INSERT 8 0 2 b19", ErrorCode::badInput, "export what is needed of it alone");
}

TEST(DxfCurves, UnitsOfTheDrawingAndAsAskedFor) {
  const std::string line = "0 LINE 8 0 10 0 20 0 30 0 11 2 21 0 31 0";
  for (const auto& [code, name, mm] : {std::tuple("0", "mm (assumed)", 1.0),
                                       {"1", "inch", 25.4},
                                       {"2", "foot", 304.8},
                                       {"4", "mm", 1.0},
                                       {"5", "cm", 10.0},
                                       {"6", "m", 1000.0}}) {
    const DxfCurves all = read(drawing(line, std::string("9 $ACADVER 1 AC1027 9 $INSUNITS 70 ") + code));
    EXPECT_EQ(all.unit, name);
    EXPECT_NEAR(lastOf(all.curves[0]).x(), 2 * mm, 1e-12);
  }
  EXPECT_EQ(read(drawing(line, "")).unit, "mm (assumed)");
  EXPECT_NEAR(lastOf(readDxf(drawing(line, "9 $INSUNITS 70 1"), "a.dxf", 10.0).value().curves[0]).x(), 20,
              1e-12);
  expectError(drawing(line, "9 $INSUNITS 70 18"), ErrorCode::badInput, "the unit 18 of DXF");
  EXPECT_TRUE(readDxf(drawing(line, "9 $INSUNITS 70 18"), "a.dxf", 1.0));
}

TEST(DxfCurves, WindowsLinesCommentsTablesBlocksAndLayoutsArePassedOver) {
  std::string text = groups(
      "999 made-by-hand 0 SECTION 2 TABLES 0 TABLE 2 LAYER 0 LAYER 2 walls 70 0 62 7 0 ENDTAB 0 ENDSEC "
      "0 SECTION 2 BLOCKS 0 BLOCK 2 door 0 LINE 8 0 10 0 20 0 11 9 21 9 0 ENDBLK 0 ENDSEC "
      "0 SECTION 2 ENTITIES 999 a-comment 0 LINE 8 0 10 0 20 0 11 9 21 9 0 TEXT 8 0 1 title 0 POINT 8 0 10 1 "
      "20 1 0 "
      "TEXT 1 more 0 LINE 67 1 8 0 10 0 20 0 11 1 21 1 0 ENDSEC 0 EOF");
  std::string windows;
  for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
  for (const std::string& one : {text, windows, "\xef\xbb\xbf" + text}) {
    EXPECT_TRUE(isDxf(one));
    const DxfCurves all = read(one);
    EXPECT_EQ(all.curves.size(), 1u);
    EXPECT_EQ(all.leftOut, (std::vector<std::string>{"1 × POINT", "2 × TEXT", "1 × entity of a layout"}));
  }
}

TEST(DxfCurves, WhatCannotBeASectionIsRefusedWithWords) {
  expectError("ISO-10303-21;", ErrorCode::cannotRead, "is no DXF file");
  expectError("", ErrorCode::cannotRead, "is no DXF file");
  expectError(drawing("0 CIRCLE 8 holes 10 0 20 0 40 5"), ErrorCode::badInput,
              "curve 1, a circle on the layer holes (line 16), is closed");
  expectError(drawing("0 ARC 8 0 10 0 20 0 40 5 50 0 51 360"), ErrorCode::badInput, "an arc of a whole turn");
  expectError(drawing("0 ELLIPSE 8 0 10 0 20 0 30 0 11 5 21 0 31 0 40 0.5 41 0 42 6.283185307179586"),
              ErrorCode::badInput, "a whole ellipse");
  expectError(drawing("0 LWPOLYLINE 8 0 90 3 70 1 10 0 20 0 10 1 20 0 10 1 20 1"), ErrorCode::badInput,
              "a polyline on the layer 0");
  expectError(drawing("0 INSERT 8 0 2 door 10 0 20 0"), ErrorCode::badInput,
              "line 16 inserts the block \"door\", which the file does not hold; explode it");
  expectError(drawing("0 TEXT 8 0 1 title"), ErrorCode::badInput, "it holds no curves, only 1 × TEXT");
  expectError(drawing(""), ErrorCode::badInput, "it holds no curves; export the section curves");
}

namespace {

using Points = std::vector<Eigen::Vector3d>;

std::string fitSpline(const Points& points, const std::string& more = "", int flags = 8) {
  std::ostringstream text;
  text.precision(17);
  text << "0 SPLINE 8 roof 70 " << flags << " 71 3 72 0 73 0 74 " << points.size() << " 44 0 " << more << " ";
  for (const Eigen::Vector3d& p : points) text << "11 " << p.x() << " 21 " << p.y() << " 31 " << p.z() << " ";
  return text.str();
}

/// The second route: the second derivatives at the points from all conditions at once, and the cubics that
/// they make. Ends are free of curvature but for tangents that are given.
class CubicByMoments {
 public:
  CubicByMoments(Points points, std::optional<Eigen::Vector3d> start, std::optional<Eigen::Vector3d> end,
                 bool around)
      : q_(std::move(points)) {
    const Eigen::Index n = Eigen::Index(q_.size()) - 1;
    for (Eigen::Index i = 0; i < n; ++i) h_.push_back((q_[i + 1] - q_[i]).norm());
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + 1, n + 1), b = Eigen::MatrixXd::Zero(n + 1, 3);
    const auto slope = [&](Eigen::Index i) -> Eigen::Vector3d { return (q_[i + 1] - q_[i]) / h_[i]; };
    for (Eigen::Index i = 1; i < n; ++i) {
      a(i, i - 1) = h_[i - 1];
      a(i, i) = 2 * (h_[i - 1] + h_[i]);
      a(i, i + 1) = h_[i];
      b.row(i) = 6 * (slope(i) - slope(i - 1));
    }
    a(0, 0) = a(n, n) = 1;
    if (around) {
      a(0, n) = -1;
      a.row(n).setZero();
      a(n, 0) = 2 * h_[0];
      a(n, 1) = h_[0];
      a(n, n - 1) = h_[n - 1];
      a(n, n) = 2 * h_[n - 1];
      b.row(n) = 6 * (slope(0) - slope(n - 1));
    }
    if (start) {
      a(0, 0) = 2 * h_[0];
      a(0, 1) = h_[0];
      b.row(0) = 6 * (slope(0) - *start);
    }
    if (end) {
      a(n, n - 1) = h_[n - 1];
      a(n, n) = 2 * h_[n - 1];
      b.row(n) = 6 * (*end - slope(n - 1));
    }
    moments_ = a.fullPivLu().solve(b);
  }
  Eigen::Vector3d value(double t) const {
    std::size_t i = 0;
    while (i + 1 < h_.size() && t > h_[i]) t -= h_[i++];
    const double h = h_[i], u = h - t;
    const Eigen::Vector3d from = moments_.row(Eigen::Index(i)), to = moments_.row(Eigen::Index(i) + 1);
    return (from * u * u * u + to * t * t * t) / (6 * h) + (q_[i] / h - from * h / 6) * u +
           (q_[i + 1] / h - to * h / 6) * t;
  }

 private:
  Points q_;
  std::vector<double> h_;
  Eigen::MatrixXd moments_;
};

}  // namespace

TEST(DxfCurves, FitPointsAreTheCubicOfContinuousCurvatureOverTheirChords) {
  const Points points = {{0, 0, 100}, {40, 0, 180}, {300, 0, 90}, {310, 0, 95}, {600, 0, 200}};
  const std::string start = "12 0 22 0 32 2 ", end = "13 -3 23 0 33 4 ";
  const Eigen::Vector3d up(0, 0, 1), back(-0.6, 0, 0.8);
  using Tangent = std::optional<Eigen::Vector3d>;
  for (const auto& [more, from, to] : {std::tuple<std::string, Tangent, Tangent>("", {}, {}),
                                       {start, up, {}},
                                       {end, {}, back},
                                       {start + end, up, back},
                                       {"12 0 22 0 32 0 ", {}, {}}}) {
    SCOPED_TRACE(more);
    const DxfCurves all = read(drawing(fitSpline(points, more)));
    ASSERT_EQ(all.curves.size(), 1u);
    const SpaceCurve& curve = all.curves[0];
    EXPECT_EQ(curve.degree, 3);
    EXPECT_EQ(curve.poles.size(), points.size() + 2) << "as CAD programs tell it by control points";
    EXPECT_EQ(curve.name, "roof");
    const CubicByMoments second(points, from, to, false);
    double length = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0) length += (points[i] - points[i - 1]).norm();
      EXPECT_LT((curve.value(length) - points[i]).norm(), 1e-9) << i;
    }
    EXPECT_NEAR(curve.end(), length, 1e-12);
    for (int i = 0; i <= 1000; ++i)
      ASSERT_LT((curve.value(length * i / 1000) - second.value(length * i / 1000)).norm(), 1e-8) << i;
  }
  // In the unit of the drawing, and where a block puts them.
  const DxfCurves cm = read(withBlocks("0 BLOCK 2 b 10 0 20 0 " + fitSpline(points) + " 0 ENDBLK ",
                                       "0 INSERT 8 0 2 b 10 0 20 30 30 0"));
  ASSERT_EQ(cm.curves.size(), 1u);
  const CubicByMoments second(points, {}, {}, false);
  EXPECT_LT((cm.curves[0].value(200) - (10 * second.value(200) + Eigen::Vector3d(0, 300, 0))).norm(), 1e-8);
}

TEST(DxfCurves, FitPointsThatCloseGoOnOverTheSeam) {
  const Points points = {{0, 0, 0}, {100, 20, 0}, {120, 150, 10}, {-30, 90, 0}};
  Points around = points;
  around.push_back(points.front());
  for (const Points& told : {points, around}) {
    const DxfCurves all = read(drawing(fitSpline(told, "", 11)));
    ASSERT_EQ(all.curves.size(), 1u);
    const CubicByMoments second(around, {}, {}, true);
    for (int i = 0; i <= 500; ++i) {
      const double t = all.curves[0].end() * i / 500;
      ASSERT_LT((all.curves[0].value(t) - second.value(t)).norm(), 1e-9) << i;
    }
  }
  // With a tangent at the seam it is that of both ends.
  const DxfCurves bound = read(drawing(fitSpline(points, "12 1 22 0 32 0", 11)));
  const CubicByMoments second(around, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitX(), false);
  EXPECT_LT((bound.curves[0].value(400) - second.value(400)).norm(), 1e-9);
}

TEST(DxfCurves, FitPointsTurnedAndScaledGiveTheSameCurveTurnedAndScaled) {
  const Points points = {{0, 0, 0}, {40, 7, 80}, {300, -20, 90}, {600, 3, 100}};
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  Points moved, backwards(points.rbegin(), points.rend());
  for (const Eigen::Vector3d& p : points) moved.push_back(3 * turn * p + Eigen::Vector3d(5, 6, 7));
  const SpaceCurve a = read(drawing(fitSpline(points))).curves.at(0);
  const SpaceCurve b = read(drawing(fitSpline(moved))).curves.at(0);
  const SpaceCurve c = read(drawing(fitSpline(backwards))).curves.at(0);
  for (int i = 0; i <= 100; ++i) {
    const double t = a.end() * i / 100;
    EXPECT_LT((b.value(3 * t) - (3 * turn * a.value(t) + Eigen::Vector3d(5, 6, 7))).norm(), 1e-9);
    EXPECT_LT((c.value(a.end() - t) - a.value(t)).norm(), 1e-9);
  }
}

namespace {

/// What is told by words as `groups`, as a binary file whose codes have so many bytes.
std::string binary(const std::string& words, int codeBytes) {
  std::string bytes("AutoCAD Binary DXF\r\n\x1a\0", 22);
  const auto put = [&bytes](std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes += char(value >> 8 * i & 0xff);
  };
  std::istringstream stream(words);
  int code = 0;
  std::string value;
  while (stream >> code >> value) {
    if (codeBytes == 1 && code > 254) put(0xff, 1);
    put(std::uint64_t(code), codeBytes == 1 && code <= 254 ? 1 : 2);
    const auto in = [code](int from, int to) { return code >= from && code <= to; };
    if (in(10, 59) || in(110, 149) || in(210, 239) || in(460, 469) || in(1010, 1059))
      put(std::bit_cast<std::uint64_t>(std::stod(value)), 8);
    else if (in(60, 79) || in(170, 179) || in(270, 289) || in(370, 389) || in(1060, 1070))
      put(std::uint64_t(std::stoi(value)), 2);
    else if (in(90, 99) || in(420, 429) || in(440, 459) || code == 1071)
      put(std::uint64_t(std::stoi(value)), 4);
    else if (in(160, 169))
      put(std::uint64_t(std::stoll(value)), 8);
    else if (in(290, 299))
      put(std::uint64_t(std::stoi(value)), 1);
    else if (in(310, 319) || code == 1004)
      put(value.size(), 1), bytes += value;
    else
      bytes += value + std::string(1, '\0');
  }
  return bytes;
}

const std::string kMixed =
    "999 a-comment 0 SECTION 2 HEADER 9 $ACADVER 1 AC1015 9 $INSUNITS 70 5 0 ENDSEC "
    "0 SECTION 2 BLOCKS 0 BLOCK 8 0 2 b 70 0 10 1 20 2 30 0 0 LINE 8 0 10 1 20 2 30 0 11 4 21 2 31 1 0 "
    "ENDBLK "
    "0 ENDSEC 0 SECTION 2 ENTITIES "
    "0 LINE 5 2F 8 walls 62 -7 370 25 420 65280 290 1 160 123456789012 310 abc 1071 -5 1004 xyz 1070 -3 "
    "1000 word 1040 0.25 48 1.5 10 1 20 2 30 3 11 4 21 5 31 6 "
    "0 ARC 8 walls 10 100 20 50 30 7 40 10 50 350 51 90 210 0 220 0 230 -1 "
    "0 LWPOLYLINE 8 roof 90 3 70 0 38 5 10 0 20 0 42 -0.5 10 10 20 0 10 10 20 10 "
    "0 SPLINE 8 roof 70 8 71 3 74 3 11 0 21 0 31 0 11 5 21 0 31 4 11 9 21 0 31 0 "
    "0 INSERT 8 roof 2 B 10 10 20 20 30 30 50 90 0 TEXT 8 0 1 title 0 ENDSEC 0 EOF ";

}  // namespace

TEST(DxfCurves, WhatMakesNoSectionIsToldBesideTheOthersWithItsNumberAndLayer) {
  const DxfCurves all = read(drawing(
      "0 LINE 8 walls 10 0 20 0 11 9 21 9 0 CIRCLE 8 holes 10 0 20 0 40 5 0 LINE 8 roof 10 0 20 0 11 5 21 0 "
      "0 SPLINE 8 bad 71 3 40 0 40 1 10 0 20 0 30 0 0 LINE 8 roof 10 0 20 0 11 7 21 0"));
  ASSERT_EQ(all.curves.size(), 3u);
  EXPECT_EQ(all.curves[1].number, 3);
  EXPECT_EQ(all.curves[2].number, 5);
  ASSERT_EQ(all.unusable.size(), 2u);
  EXPECT_EQ(all.unusable[0].number, 2);
  EXPECT_EQ(all.unusable[0].name, "holes");
  EXPECT_NE(all.unusable[0].why.message.find("curve 2, a circle on the layer holes"), std::string::npos);
  EXPECT_EQ(all.unusable[1].number, 4);
  EXPECT_NE(all.unusable[1].why.message.find("of degree 3 it takes 4"), std::string::npos);
}

TEST(DxfCurves, AWishToStopEndsTheReading) {
  std::stop_source stop;
  RunContext context;
  context.stop = stop.get_token();
  double share = -1;
  context.progress = [&](double fraction, std::string_view) {
    EXPECT_GE(fraction, share);
    EXPECT_LE(fraction, 1);
    share = fraction;
    if (fraction > 0.4) stop.request_stop();
  };
  std::string points;
  for (int i = 0; i < 30'000; ++i) points += "0 POINT 8 x ";
  for (const std::string& bytes : {drawing(points), binary("0 SECTION 2 ENTITIES " + points + "0 EOF ", 2)}) {
    share = -1;
    stop = std::stop_source();
    context.stop = stop.get_token();
    const auto result = readDxf(bytes, "a.dxf", std::nullopt, context);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::cancelled);
    EXPECT_LT(share, 0.9);
  }
}

TEST(DxfCurves, FewOrRepeatedOrWrongFitPoints) {
  const SpaceCurve line = read(drawing(fitSpline({{0, 0, 0}, {600, 0, 30}}))).curves.at(0);
  EXPECT_LT((line.value(line.end() / 4) - Eigen::Vector3d(150, 0, 7.5)).norm(), 1e-9);
  const Points points = {{0, 0, 0}, {40, 0, 80}, {300, 0, 90}};
  Points repeated = {points[0], points[0], points[1], points[2], points[2]};
  EXPECT_EQ(read(drawing(fitSpline(repeated))).curves.at(0).poles,
            read(drawing(fitSpline(points))).curves.at(0).poles);
  expectError(drawing(fitSpline({{1, 2, 3}})), ErrorCode::badInput,
              "curve 1, a spline on the layer roof (line 16), is told by fewer than two different points");
  expectError(drawing(fitSpline({points[0], points[0]})), ErrorCode::badInput, "fewer than two different");
  expectError(drawing(fitSpline({points[0], points[1]}, "", 9)), ErrorCode::badInput,
              "a closed spline on the layer roof (line 16), is told by fewer than three different points");
  expectError(drawing("0 SPLINE 8 0 70 8 71 3 72 0 73 0 74 4 11 0 21 0 31 0"), ErrorCode::cannotRead,
              "tells of 4 fit points and has 1");
  expectError(drawing("0 SPLINE 8 0 70 8 74 1 21 0"), ErrorCode::cannotRead,
              "tells of a fit point before the first one");
  expectError(drawing("0 SPLINE 8 0 70 8 74 2 11 0 21 0 11 nan 21 0"), ErrorCode::cannotRead,
              "where a finite number stands");
  expectError(drawing(fitSpline({{0, 0, 0}, {1e300, 0, 0}})), ErrorCode::badInput, "beyond a million metres");
  // Points that almost repeat give no wild curve.
  const SpaceCurve near =
      read(drawing(fitSpline({{0, 0, 0}, {300, 0, 50}, {300, 0, 50 + 1e-9}, {600, 0, 0}}))).curves.at(0);
  for (const Eigen::Vector3d& p : near.samples(200)) EXPECT_LT(p.norm(), 1000);
}

TEST(DxfCurves, BinaryFilesHoldTheSameAsTexts) {
  const DxfCurves text = read(groups(kMixed));
  ASSERT_EQ(text.curves.size(), 5u);
  for (const int codeBytes : {1, 2}) {
    SCOPED_TRACE(codeBytes);
    const std::string bytes = binary(kMixed, codeBytes);
    EXPECT_TRUE(isDxf(bytes));
    const DxfCurves all = read(bytes);
    EXPECT_EQ(all.unit, "cm");
    EXPECT_EQ(all.leftOut, text.leftOut);
    ASSERT_EQ(all.curves.size(), text.curves.size());
    for (std::size_t i = 0; i < all.curves.size(); ++i) {
      EXPECT_EQ(all.curves[i].name, text.curves[i].name);
      EXPECT_EQ(all.curves[i].number, text.curves[i].number);
      EXPECT_EQ(all.curves[i].poles, text.curves[i].poles);
      EXPECT_EQ(all.curves[i].weights, text.curves[i].weights);
      EXPECT_EQ(all.curves[i].knots, text.curves[i].knots);
    }
  }
  // Without the comment before it.
  const std::string plain = kMixed.substr(kMixed.find("0 SECTION"));
  for (const int codeBytes : {1, 2}) EXPECT_EQ(read(binary(plain, codeBytes)).curves.size(), 5u);
}

TEST(DxfCurves, DamagedBinaryFilesAreToldWithTheirByte) {
  for (const int codeBytes : {1, 2}) {
    const std::string whole = binary(kMixed, codeBytes);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const auto result = readDxf(std::string_view(whole).substr(0, size), "a.dxf");
      ASSERT_FALSE(result) << size;
      EXPECT_EQ(result.error().code, ErrorCode::cannotRead) << size;
    }
    const std::string line = "0 SECTION 2 ENTITIES 0 LINE 8 0 10 0 20 0 11 ", rest = " 21 9 0 ENDSEC 0 EOF ";
    expectError(binary(line + "nan" + rest, codeBytes), ErrorCode::cannotRead,
                "has a number that is not finite; the file is damaged");
    expectError(binary(line + "inf" + rest, codeBytes), ErrorCode::cannotRead, "byte ");
    expectError(binary(line + "1e300" + rest, codeBytes), ErrorCode::badInput, "beyond a million metres");
    expectError(binary("0 SECTION 2 ENTITIES 80 x 0 EOF ", codeBytes), ErrorCode::cannotRead,
                "has 80 where the code of a group stands, and DXF has no such code");
    expectError(binary("0 SECTION 2 ENTITIES 0 CIRCLE 8 0 40 1 0 EOF ", codeBytes), ErrorCode::badInput,
                codeBytes == 1 ? "(byte 42)" : "(byte 44)");
  }
  expectError(std::string("AutoCAD Binary DXF\n\x1a\0", 21), ErrorCode::cannotRead, "a transfer as text");
}

TEST(DxfCurves, SlipsInABinaryFileNeverBreakTheReader) {
  std::mt19937 random(5);
  for (int round = 0; round < 6000; ++round) {
    std::string bytes = binary(kMixed, 1 + round % 2);
    for (int slip = 0; slip < 3; ++slip) {
      const std::size_t at = 22 + random() % (bytes.size() - 22);
      switch (random() % 3) {
        case 0:
          bytes[at] = char(random() % 256);
          break;
        case 1:
          bytes.erase(at, random() % 9);
          break;
        default:
          bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 40));
      }
    }
    const auto result = readDxf(bytes, "a.dxf");
    if (!result) {
      EXPECT_FALSE(result.error().message.empty());
      continue;
    }
    for (const SpaceCurve& curve : result->curves) {
      EXPECT_TRUE(checkSpaceCurve(curve));
      EXPECT_TRUE(curve.value(0.5 * (curve.start() + curve.end())).allFinite());
    }
  }
}

TEST(DxfCurves, DamagedFilesAreToldWithTheirLine) {
  const std::string whole = drawing("0 LINE 8 0 10 0 20 0 11 9 21 9");
  for (std::size_t size = 0; size < whole.size() - 4; ++size)
    EXPECT_FALSE(readDxf(whole.substr(0, size), "a.dxf")) << size;
  expectError(whole.substr(0, whole.size() / 2 * 2 - 20), ErrorCode::cannotRead, "is cut short");
  expectError(drawing("0 LINE 8 0 10 nan 20 0 11 9 21 9"), ErrorCode::cannotRead,
              "has \"nan\" where a finite number");
  expectError(drawing("0 LINE 8 0 10 1e999 20 0 11 9 21 9"), ErrorCode::cannotRead, "where a finite number");
  expectError(drawing("0 LINE 8 0 x 1 20 0"), ErrorCode::cannotRead, "has \"x\" where the code of a group");
  expectError(drawing("0 POLYLINE 8 0 66 1 70 8 0 VERTEX 10 0 20 0 30 0"), ErrorCode::cannotRead,
              "ends the file within a polyline");
  expectError(drawing("0 SPLINE 8 0 71 3 40 0 40 1 10 0 20 0 30 0"), ErrorCode::badInput,
              "of degree 3 it takes 4");
  expectError(drawing("0 SPLINE 8 0 71 1000000000 40 0 40 1 10 0 20 0 30 0"), ErrorCode::badInput,
              "has the degree");
  expectError(drawing("0 SPLINE 8 0 71 1 40 0 40 0 40 1 40 1 41 1 41 -1 10 0 20 0 30 0 10 1 20 0 30 0"),
              ErrorCode::badInput, "a weight of -1");
  expectError(drawing("0 SPLINE 8 0 71 1 20 1"), ErrorCode::cannotRead, "before the first one");
  expectError(drawing("0 LINE 8 0 10 1e300 20 0 11 9 21 9"), ErrorCode::badInput, "beyond a million metres");
  expectError(drawing("0 ARC 8 0 10 0 20 0 40 1 50 0 51 90 210 0 220 0 230 0"), ErrorCode::cannotRead,
              "is no direction");
  std::string many;
  for (std::size_t i = 0; i <= DxfCurves::kMost; ++i) many += "0 LINE 8 0 10 0 20 0 11 9 21 9 ";
  expectError(drawing(many), ErrorCode::badInput, "more than 10000 curves");
  std::string long_ = "0 LWPOLYLINE 8 0 70 0 ";
  for (int i = 0; i < 100'001; ++i) long_ += "10 " + std::to_string(i) + " 20 0 ";
  expectError(drawing(long_), ErrorCode::badInput, "has 100001 points");
}

TEST(DxfCurves, SlipsInAFileNeverBreakTheReader) {
  const std::string whole = drawing(
      "0 ARC 8 0 10 5 20 6 30 1 40 1 50 0 51 90 0 LWPOLYLINE 8 0 90 3 70 0 10 0 20 0 42 0.5 10 20 20 0 10 40 "
      "20 7 "
      "0 SPLINE 8 0 70 8 71 1 72 4 73 2 40 0 40 0 40 1 40 1 10 0 20 0 30 0 10 3 20 0 30 0 "
      "0 POLYLINE 8 0 66 1 70 8 0 VERTEX 10 0 20 0 30 0 0 VERTEX 10 9 20 0 30 0 0 SEQEND");
  const std::string blocks = withBlocks(
      kProfile + "0 BLOCK 2 pair 10 0 20 0 0 INSERT 8 0 2 profile 10 5 20 5 41 2 50 30 0 ENDBLK",
      "0 INSERT 8 roof 2 pair 10 10 20 50 70 3 71 2 44 100 45 90 0 INSERT 8 0 2 profile 10 1 20 2");
  std::mt19937 random(3);
  for (int round = 0; round < 6000; ++round) {
    std::string text = round % 2 ? blocks : whole;
    for (int slip = 0; slip < 3; ++slip) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[at] = "0123456789.-e\nxA"[random() % 16];
          break;
        case 1:
          text.erase(at, random() % 9);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), random() % 40));
      }
    }
    const auto result = readDxf(text, "a.dxf");
    if (!result) {
      EXPECT_FALSE(result.error().message.empty());
      continue;
    }
    for (const SpaceCurve& curve : result->curves) {
      EXPECT_TRUE(checkSpaceCurve(curve));
      EXPECT_TRUE(curve.value(0.5 * (curve.start() + curve.end())).allFinite());
    }
  }
}

}  // namespace
}  // namespace bw::test
