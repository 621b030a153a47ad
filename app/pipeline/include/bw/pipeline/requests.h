// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bw/core/design/face_choice.h"
#include "bw/core/design/job.h"
#include "bw/core/files/shared_bytes.h"
#include "bw/core/sweep/section_request.h"
#include "bw/core/sweep/sweep.h"
#include "bw/geometry/cad_model.h"
#include "bw/geometry/sections.h"

namespace bw::pipeline {

/// Which robot programs, and for which cell.
struct ProgramRequest {
  std::vector<std::string> formats;  ///< "rapid", "csv", "json"; none: no programs
  std::string cell;                  ///< its word, or the path of its file
  bool operator==(const ProgramRequest&) const = default;
};

/// What a job asks of each stage: nothing else of it reaches them.
struct Requests {
  explicit Requests(const Job& job);

  ReadOptions read;
  FaceChoice face;
  geometry::SetupRequest setup;
  SectionRequest sections;
  FitRequest fit;
  CheckRequest check;
  MotionRequest motion;
  ProgramRequest programs;
};

/// A file at some moment, as far as that tells whether it was written since.
struct FileStamp {
  std::filesystem::path path;
  std::uintmax_t size = 0;
  std::int64_t changed = 0;  ///< time of change, in the ticks of the system; 0 where it is not there
  bool operator==(const FileStamp&) const = default;

  static FileStamp of(const std::filesystem::path& file);
};

/// What is read: bytes that a design holds, or else a file.
struct SourceRequest {
  FileStamp file;  ///< only its path where there are bytes, which names them
  SharedBytes bytes;
  ReadOptions options;
  bool operator==(const SourceRequest&) const = default;
};

/// Planes through a target that lies in its block.
struct PlanesRequest {
  geometry::Setup setup;
  SectionRequest sections;
  bool operator==(const PlanesRequest&) const = default;
};

/// A row of blades in a block.
struct RowRequest {
  geometry::Setup setup;
  FitRequest fit;
  bool operator==(const RowRequest&) const = default;
};

/// Checks and timing of a row.
struct ResultRequest {
  CheckRequest check;
  MotionRequest motion;
  bool operator==(const ResultRequest&) const = default;
};

/// A cell for programs.
struct CellRequest {
  ProgramRequest programs;
  FileStamp file;  ///< of the cell, where it is a file
  bool operator==(const CellRequest&) const = default;
};

/// Of a stage that hangs on its inputs alone.
struct NoRequest {
  bool operator==(const NoRequest&) const = default;
};

}  // namespace bw::pipeline
