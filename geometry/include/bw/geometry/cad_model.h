// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/base/units.h"
#include "bw/core/design/face_choice.h"
#include "bw/core/design/read_options.h"
#include "bw/core/surface/mesh.h"
#include "bw/core/surface/spline_surface.h"
#include "bw/core/surface/surface_sampler.h"

namespace bw::geometry {

/// Sections of a face across one of the main directions of its block.
struct FaceSections {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitY();  ///< unit; the blade would travel along it
  double shortest = 0, longest = 0;                      ///< lengths, mm
  double minRadius = 0;                                  ///< the tightest of all, mm; 0 = straight
};

/// The height in mm of an arc over a chord as long as the face up to which a curvature counts as none.
inline constexpr double kCurvedTolerance = 0.1;
/// The angle between the normals of two faces up to which they join smoothly, rad.
inline constexpr double kSmoothJoin = 5 * kDegree;

/// What is known of one face of a CAD file.
struct FaceInfo {
  int index = 0;     ///< 0-based, in the order of the file: what a job's "face" means
  std::string type;  ///< "plane", "cylinder", "cone", "sphere", "torus", "bspline", "bezier", "revolution",
                     ///< "extrusion", "offset", "other"
  Bounds bounds;     ///< tight, mm
  double area = 0;   ///< mm²
  std::string name;  ///< as STEP names it, or its shell or solid; may be empty, or that of several faces
  int group = -1;    ///< index in CadInfo::groups; −1 for a face that cannot be used
  // These only from `infoInFull`.
  double curvatureMin = 0;  ///< smallest and largest principal curvature found by sampling, 1/mm, signed
  double curvatureMax = 0;
  std::string curved;    ///< "flat", "singly" or "doubly", by kCurvedTolerance
  double minRadius = 0;  ///< of the largest principal curvature, mm: a blade that bends to it can follow the
                         ///< face in any direction; 0 = no curvature at all
  std::vector<FaceSections> sections;  ///< none where no open sections exist
};

/// Faces that join smoothly: what could be one side of a solid.
struct FaceGroup {
  int index = 0;           ///< 0 has the largest area
  std::vector<int> faces;  ///< ascending
  double area = 0;         ///< mm²
  Bounds bounds;           ///< mm
};

/// What a CAD file holds.
struct CadInfo {
  std::string format;  ///< "STEP", "IGES", "BREP", "designed"
  std::string unit;    ///< of the file: "mm", "m", "inch", …; "mm (assumed)" where the format has none
  std::string readAs;  ///< the unit that its numbers were taken in: `unit`, or that of the options
  double unitLength = 0, readAsLength = 0;  ///< of `unit` and `readAs`, mm; 0 where it is not known
  double sewing = 0;                        ///< mm, as asked for
  int solids = 0, shells = 0, faces = 0, edges = 0;
  Bounds bounds;
  std::vector<FaceInfo> faceList;
  std::vector<FaceGroup> groups;     ///< largest area first
  std::vector<std::string> healing;  ///< what was repaired when reading, in words; empty = nothing was needed
  std::vector<std::string> leftOut;  ///< what of the file could not be used, in words
};

/// A CAD file in memory, in mm, healed and oriented. Immutable; cheap to copy. Targets, samplers and sections
/// may be made from it on several threads at once; each sampler belongs to one thread.
class CadModel {
 public:
  /// Reads STEP, IGES or BREP (told from the content, then from the suffix). Errors: missing, empty,
  /// truncated or garbage file (`cannotRead`), a file without faces (`badInput`), each with what to do.
  static Result<CadModel> read(const std::filesystem::path& file, const RunContext& context = {},
                               const ReadOptions& options = {});
  /// The same from bytes in memory (the source embedded in a design). `name` serves messages and the suffix.
  static Result<CadModel> readBytes(const std::string& bytes, const std::string& name,
                                    const RunContext& context = {}, const ReadOptions& options = {});

  /// One face that was never in a file: the whole of a surface, under a name. Takes 0.3 ms for some poles.
  /// Errors: poles, knots and degrees that do not fit or are not finite (`badInput`).
  static Result<CadModel> of(const SplineSurface& surface, const std::string& name);

  const CadInfo& info() const;
  /// With curvatures and sections of each face too: a few ms a face. Error: `cancelled`.
  Result<CadInfo> infoInFull(const RunContext& context = {}) const;

  /// Indices of the faces chosen. `findings` is told where the choice was left to the program. Errors
  /// (`badInput`): an index, name or group that does not exist, each with those that do; a face thinner than
  /// 0.01 mm.
  Result<std::vector<int>> choose(const FaceChoice& choice, Findings* findings = nullptr) const;

  /// Opaque handle for this module's own functions.
  struct Impl;
  const Impl& impl() const { return *impl_; }
  const std::shared_ptr<const Impl>& shared() const { return impl_; }

 private:
  explicit CadModel(std::shared_ptr<const Impl> impl);
  std::shared_ptr<const Impl> impl_;
};

/// Triangles of all faces of a file that can be computed with, for choosing among them: coarser than those of
/// a target, within 1/1000 of the file's size. Errors: `cancelled`; `internal` if
/// OpenCASCADE fails.
Result<FaceMesh> faceMesh(const CadModel& model, const RunContext& context = {});

/// The chosen faces as one target.
class Target {
 public:
  /// Takes the faces that `choice` names; what it took, and what it left out as too thin, goes to `findings`.
  /// Error `badInput`: a number, name or group that does not exist, a point that is not finite, a chosen face
  /// too thin to be cut, or no other.
  static Result<Target> make(const CadModel& model, const FaceChoice& choice, Findings* findings = nullptr);

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
