// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bw/core/blade.h"
#include "bw/core/elastica_fit.h"
#include "bw/core/frame.h"
#include "bw/core/result.h"

namespace bw {

/// A unit that the numbers of a CAD file can be taken in.
enum class LengthUnit { mm, cm, m, inch };
inline constexpr std::array<LengthUnit, 4> kLengthUnits = {LengthUnit::mm, LengthUnit::cm, LengthUnit::m,
                                                           LengthUnit::inch};
/// "mm", "cm", "m", "in".
const char* lengthUnitName(LengthUnit unit);
/// Its length in mm.
double millimetres(LengthUnit unit);

/// Which faces of the file are the target.
struct FaceChoice {
  enum class Kind {
    largest,  ///< the largest that is bent in earnest: planes, cylinders and cones only where nothing else is
    all,
    indices,
    named,   ///< every face of these names
    group,   ///< faces that join smoothly, one side of a solid
    nearest  ///< to a point
  };
  Kind kind = Kind::largest;
  std::vector<int> indices = {};                    ///< for Kind::indices
  std::vector<std::string> names = {};              ///< for Kind::named
  int group = 0;                                    ///< for Kind::group: 0 is the one of largest area
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< for Kind::nearest: in the file's frame, mm
  bool operator==(const FaceChoice&) const = default;
};

/// A block as written in a job: corner, size, rotation. Angles in rad (job key in degrees).
struct BlockPlacement {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d size = Eigen::Vector3d::Constant(500);
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  bool operator==(const BlockPlacement&) const = default;
  Box box() const;
};

/// Everything that a rationalisation is asked to do: the JOB.json of the command line and the settings of a
/// design.
struct Job {
  std::optional<LengthUnit> unit;  ///< the numbers of the file are taken in it; empty = as the file states
  std::optional<double> sewing;    ///< mm within which edges of faces are joined; empty = by the tolerance
  FaceChoice face;
  std::optional<BlockPlacement> block;  ///< empty = "auto": around the face
  std::optional<Eigen::Vector3d>
      direction;                  ///< cutting direction in the file's frame, not zero; empty = "auto"
  int stations = 60;              ///< used unless `spacing` is set; ≥ 2, at most kMaxStations
  std::optional<double> spacing;  ///< mm between stations
  double lead = 20;               ///< mm of straight travel before and after the block
  Blade blade;
  FitOptions::Length fitLength = FitOptions::Length::free;
  bool fitEndpoints = false;
  bool fitTangents = false;
  double maxPeriods = 1;
  double tolerance = 2.0;      ///< mm, deviation of the cut surface
  double cuttingSpeed = 20.0;  ///< mm/s of the fastest point
  double clearance = 50.0;     ///< mm between a grip and the block
  std::vector<std::string> programs = {"rapid", "csv", "json"};
  std::string cell = "irb1600-pair";
  int threads = 0;

  /// mm: `sewing`, or else a tenth of the tolerance, at most kMostSewing.
  double sewingTolerance() const;

  static constexpr double kMostSewing = 0.1;  ///< mm, unless the job says more
  static constexpr int kMaxStations = 20000;
};

/// Reads JOB.json. Unknown keys, wrong types and values out of range are errors that name the key, the value
/// and the remedy (the nearest known key is suggested). Every key is optional.
Result<Job> parseJob(std::string_view json);

/// The job as JSON text that `parseJob` reads back to an equal job; every key written.
std::string jobToJson(const Job& job);

}  // namespace bw
