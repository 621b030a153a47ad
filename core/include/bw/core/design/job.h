// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/blade/blade.h"
#include "bw/core/design/face_choice.h"
#include "bw/core/design/read_options.h"
#include "bw/core/fit/elastica_fit.h"
#include "bw/core/sweep/section_request.h"

namespace bw {

/// Everything that a rationalisation is asked to do: the JOB.json of the command line and the settings of a
/// design.
struct Job {
  std::optional<LengthUnit> unit;  ///< the numbers of the file are taken in it; empty = as the file states
  std::optional<double> sewing;    ///< mm within which edges of faces are joined; empty = by the tolerance
  FaceChoice face;
  std::optional<BlockPlacement> block;  ///< empty = "auto": around the face
  std::optional<Eigen::Vector3d>
      direction;                  ///< cutting direction in the file's frame, not zero; empty = "auto"
  int stations = 60;              ///< used unless `spacing` is set; ≥ 2, at most SectionRequest::kMost
  std::optional<double> spacing;  ///< mm between stations
  SectionRoute sections = SectionRoute::automatic;
  double lead = 20;  ///< mm of straight travel before and after the block
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

  /// mm: `sewing`, or else a tenth of the tolerance, at most ReadOptions::kMostSewing.
  double sewingTolerance() const;
  bool operator==(const Job&) const = default;
};

/// Reads JOB.json. Unknown keys, wrong types and values out of range are errors that name the key, the value
/// and the remedy (the nearest known key is suggested). Every key is optional. What a machine takes is no
/// part of a job: `threads` gets the number of worker threads that the text may ask for, 0 = all.
Result<Job> parseJob(std::string_view json, int* threads = nullptr);

/// The job as JSON text that `parseJob` reads back to an equal job; every key written.
std::string jobToJson(const Job& job);

}  // namespace bw
