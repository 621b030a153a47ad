// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Curves of DXF drawings.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/curve/space_curve.h"

namespace bw {

/// A curve of a drawing of which no section can be made.
struct UnusableCurve {
  int number = 1;    ///< its place among all curves of the file, from 1
  std::string name;  ///< its layer
  Error why;
};

struct DxfCurves {
  static constexpr std::size_t kMost = 10'000;           ///< curves that are read
  static constexpr std::size_t kMostPoints = 2'000'000;  ///< of all of them

  std::string unit;                     ///< that the drawing states; "mm (assumed)" where it has none
  std::vector<SpaceCurve> curves;       ///< in the order of the file, mm; the name of each is its layer
  std::vector<UnusableCurve> unusable;  ///< closed ones, and such as make no curve
  std::vector<std::string> leftOut;     ///< what else it holds, in words
};

/// True for a DXF file, a text or a binary one.
bool isDxf(std::string_view bytes);

/// Reads the curves of the model space of a DXF file, a text or a binary one (of any release): lines, arcs,
/// parts of ellipses, polylines with their bulges, splines (those told by fit points alone as the cubic with
/// continuous curvature through them, docs/mathematics.md, Fit points), each in the plane that its extrusion
/// tells, and those of blocks wherever they are inserted. `unit`: mm that a unit of the drawing is taken for,
/// whatever it states. `name` serves messages. What of it is closed, or makes no curve, is told with its
/// number and layer, so that the others can be chosen. Errors: `cannotRead` for what is damaged or cut short,
/// with the line, or the byte; `badInput` for a unit that is not known, blocks that are not in the file or
/// come to too much, more than kMost curves or kMostPoints points, and where no curve can be used, each with
/// what to do; `cancelled`. O(n) in time, and in what blocks come to; what it keeps are points and blocks.
Result<DxfCurves> readDxf(std::string_view bytes, const std::string& name,
                          std::optional<double> unit = std::nullopt, const RunContext& context = {});

}  // namespace bw
