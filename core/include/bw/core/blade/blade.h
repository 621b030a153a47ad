// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bw/core/base/result.h"

namespace bw {

/// The tool: a thin heated blade or rod held at both ends.
struct Blade {
  enum class Section { flat, tube, rod };
  static constexpr double kLongest = 20000;  ///< mm: no job or design takes a longer blade
  std::string name = "steel-tube-3-2.5";     ///< preset word, or "custom"
  std::string title = {};                    ///< for people
  Section section = Section::tube;
  double length = 800;  ///< free length between the two TCP origins, mm
  bool autoLength =
      false;             ///< the length is left open: what serves a row best (`bladeLengths`) takes its place
  double width = 0;      ///< flat: along the cutting direction, mm
  double thickness = 0;  ///< flat: in the bending plane, mm
  double outerDiameter = 3;         ///< tube and rod, mm
  double innerDiameter = 2.5;       ///< tube, mm
  double youngModulus = 200000;     ///< at the working temperature, N/mm²
  double yieldStress = 500;         ///< at the working temperature, N/mm²
  double temperature = 350;         ///< °C at the cut
  double thermalExpansion = 13e-6;  ///< mean linear expansion from 20 °C to the working temperature, 1/K
  double safety = 1.2;              ///< yield stress is divided by this
  double density = 7850;            ///< kg/m³
  /// Where numbers of a preset come from, by their key; "nominal" begins one that nobody measured. A number
  /// that is given otherwise has none.
  std::map<std::string, std::string> sources = {};

  /// Distance of the outermost fibre from the neutral axis in the bending plane, mm.
  double fibreDistance() const;
  /// Second moment of area about the bending axis, mm⁴.
  double secondMoment() const;
  /// Of the section, mm².
  double area() const;
  /// Weight of a length, N/mm.
  double weight() const { return 9.80665e-9 * density * area(); }
  /// Flexural rigidity E I, N·mm².
  double flexuralRigidity() const { return youngModulus * secondMoment(); }
  /// The smallest radius (of the neutral axis) that stays elastic: E c · safety / yield, mm.
  double minRadius() const;
  double maxCurvature() const { return 1.0 / minRadius(); }
  /// Bending stress at a curvature (1/mm), N/mm².
  double stress(double curvature) const { return youngModulus * fibreDistance() * std::abs(curvature); }

  bool operator==(const Blade&) const = default;
};

/// The presets in the resource folder, in the order of their file names. Fails if the folder cannot be read.
Result<std::vector<Blade>> bladePresets();
/// One preset by its word; an unknown word is an error that names the nearest one.
Result<Blade> bladePreset(const std::string& name);

/// The folder with blades/, cells/, examples/, …: the environment variable BLADEWRIGHT_RESOURCES, else
/// ../share/bladewright as seen from the folder of the program (in a build tree a link to the sources).
Result<std::filesystem::path> resourceFolder();

}  // namespace bw
