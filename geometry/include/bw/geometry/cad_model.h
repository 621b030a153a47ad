// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bw/core/frame.h"
#include "bw/core/issue.h"
#include "bw/core/job.h"
#include "bw/core/mesh.h"
#include "bw/core/result.h"
#include "bw/core/run_context.h"
#include "bw/core/surface_sampler.h"

namespace bw::geometry {

/// What is known of one face of a CAD file.
struct FaceInfo {
  int index = 0;     ///< 0-based, in the order of the file: what a job's "face" means
  std::string type;  ///< "plane", "cylinder", "cone", "sphere", "torus", "bspline", "bezier", "revolution",
                     ///< "extrusion", "offset", "other"
  Bounds bounds;     ///< tight, mm
  double area = 0;   ///< mm²
  double curvatureMin = 0;  ///< smallest and largest principal curvature found by sampling, 1/mm, signed
  double curvatureMax = 0;
};

/// What a CAD file holds.
struct CadInfo {
  std::string format;  ///< "STEP", "IGES", "BREP"
  std::string unit;    ///< of the file: "mm", "m", "inch", …; "mm (assumed)" where the format has none
  int solids = 0, shells = 0, faces = 0, edges = 0;
  Bounds bounds;
  std::vector<FaceInfo> faceList;
  std::vector<std::string> healing;  ///< what was repaired when reading, in words; empty = nothing was needed
};

/// A CAD file in memory, in mm, healed and oriented. Immutable; cheap to copy. Safe for reading from one
/// thread at a time; samplers and sections made from it are independent.
class CadModel {
 public:
  /// Reads STEP, IGES or BREP (told from the content, then from the suffix). Errors: missing, empty,
  /// truncated or garbage file
  /// (`cannotRead`), a file without faces (`badInput`), each with what to do.
  static Result<CadModel> read(const std::filesystem::path& file, const RunContext& context = {});
  /// The same from bytes in memory (the source embedded in a design). `name` serves messages and the suffix.
  static Result<CadModel> readBytes(const std::string& bytes, const std::string& name,
                                    const RunContext& context = {});

  const CadInfo& info() const;
  /// Counts, types, areas and bounds are there at once; curvature ranges only after this (it samples every
  /// face).
  CadInfo infoWithCurvatures() const;

  /// Indices of the faces chosen; an index out of range, or a face thinner than the tolerance, is an error
  /// that tells the range.
  Result<std::vector<int>> choose(const FaceChoice& choice) const;

  /// Opaque handle for this module's own functions.
  struct Impl;
  const Impl& impl() const { return *impl_; }
  const std::shared_ptr<const Impl>& shared() const { return impl_; }

 private:
  explicit CadModel(std::shared_ptr<const Impl> impl);
  std::shared_ptr<const Impl> impl_;
};

/// The chosen faces as one target.
class Target {
 public:
  static Result<Target> make(const CadModel& model, const FaceChoice& choice);

  Bounds bounds() const;  ///< tight, file frame, mm
  double area() const;    ///< mm²
  const std::vector<int>& faces() const;

  /// Closest-point queries to the trimmed faces; one sampler a thread.
  std::unique_ptr<SurfaceSampler> sampler() const;
  /// Triangles within `deflection` mm (0 = 1/2000 of the size) for display.
  Result<TriangleMesh> mesh(double deflection = 0) const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  explicit Target(std::shared_ptr<const Impl> impl);
  std::shared_ptr<const Impl> impl_;
};

}  // namespace bw::geometry
