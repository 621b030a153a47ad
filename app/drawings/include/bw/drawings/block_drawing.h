// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Drawings of foam blocks for the workshop: what a block is, what is left of it, and how it lies for each
// cut.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/parts/crease.h"
#include "bw/core/parts/cut_pose.h"
#include "bw/core/surface/mesh.h"

namespace bw::drawings {

/// One cut of a block, as the workshop makes it. Points are in the file's frame, mm.
struct DrawnCut {
  std::string id;
  CutPose pose;                                          ///< how the block lies for it
  std::string lies;                                      ///< the same in words; empty where as it is placed
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< of travel, unit
  std::string turns = {};                                ///< by how much planes turn; empty if parallel
  Polyline blade = {};                                   ///< at the first station, from the left grip on
  std::vector<Polyline> across = {};                     ///< blades at some stations, where they cut
  double bladeLength = 0;                                ///< mm
  std::size_t stations = 0;
  double cuttingTime = 0;                        ///< s, with the leads, without entry and exit
  double runTime = 0;                            ///< s, with these
  std::string keeps = {};                        ///< "below": foam that stays, seen from the surface
  std::string folder = {};                       ///< of its program; empty where there is none
  std::optional<double> removed = std::nullopt;  ///< mm³; empty where it is not known
};

/// What is left of a block.
struct DrawnPart {
  const TriangleMesh* mesh = nullptr;  ///< its faces, in the file's frame
  double blockVolume = 0, volume = 0;  ///< mm³, before and after the cuts
  int pieces = 1;
};

/// One block, with its cuts in the order in which they are made.
struct DrawnBlock {
  std::string id;
  Box placed;                                    ///< the block before it is turned for any cut
  std::optional<DrawnPart> part = std::nullopt;  ///< empty where it could not be made, and
  std::string whyNoPart = {};                    ///< a clause that tells why
  std::string whyNoCut = {};                     ///< a sentence: why it must not be cut so; empty if it may
  std::vector<Polyline> creases = {};            ///< the edges that cuts leave
  std::vector<DrawnCut> cuts = {};
};

/// The blocks of a design.
struct DrawnDesign {
  std::string name;
  std::string run;  ///< the name of the run that the drawings are of
  std::vector<DrawnBlock> blocks;
};

/// The drawings as PDF, A4 landscape: of each block one page with views in first-angle projection, dimensions
/// and the first cuts, and as many more as its further cuts need. One that must not be cut so is marked on
/// each page, with the reason. Texts beyond the letters of western Europe
/// (code page 1252) are written with question marks, long ones have an ellipsis in their middle. The file
/// carries no date, so that equal input gives equal bytes, for any number of threads. Some 0.05 s a block.
/// Errors: no block, one without size or without cuts, or numbers that are not finite (`badInput`);
/// `cancelled`; `internal` if libharu fails.
[[nodiscard]] Result<std::string> drawingsPdf(const DrawnDesign& design, const RunContext& context = {});

/// How many cuts the first page of a block holds, and each further one.
inline constexpr int kCutsOnFirstPage = 4, kCutsOnFurtherPage = 8;

}  // namespace bw::drawings
