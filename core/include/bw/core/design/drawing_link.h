// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>

#include "bw/core/base/frame.h"
#include "bw/core/files/fingerprint.h"
#include "bw/core/shape/designed_surface.h"

namespace bw {

/// The CAD file whose curves a surface was made of, and what was made of it then: where the file changes it
/// is made anew, and what a hand has set since stays.
struct DrawingLink {
  std::filesystem::path path = {};                       ///< relative to the design file when stored
  std::optional<std::string> layer = std::nullopt;       ///< whose curves were taken; empty: all together
  Fingerprint read = {};                                 ///< what the file was
  Fingerprint surface = {};                              ///< `surfaceMark` of what was made
  std::optional<BlockPlacement> block = std::nullopt;    ///< around it
  Eigen::Vector3d direction = Eigen::Vector3d::UnitY();  ///< of travel, across the curves
  double length = 0;                                     ///< mm, of the blade
  bool operator==(const DrawingLink&) const = default;
};

/// Tells whether a surface is still one that was made, also after it was saved and read.
Fingerprint surfaceMark(const DesignedSurface& surface);

/// Whether the surface is as it was made of the drawing; no hand has changed it.
bool isAsDrawn(const DrawingLink& link, const DesignedSurface& surface);

}  // namespace bw
