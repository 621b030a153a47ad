// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/curve/space_curve.h"
#include "bw/core/design/read_options.h"

namespace bw::geometry {

/// The curves of a CAD file that bound no face, in mm.
struct CadCurves {
  static constexpr int kMost = 10'000;  ///< curves that are read

  std::string format;                ///< "STEP", "IGES", "BREP"
  std::string unit;                  ///< of the file; "mm (assumed)" where it has none
  std::vector<SpaceCurve> curves;    ///< in the order of the file; an edge each
  int faces = 0;                     ///< that the file has besides
  std::vector<std::string> leftOut;  ///< what could not be used, in words
};

/// Reads them from the bytes of a STEP, IGES or BREP file, packed or not, each as the B-spline that it is;
/// `options.unit` as for faces. `name` serves messages and the suffix. In a process of its own
/// (docs/architecture.md). Errors: those of `CadModel::readBytes` for what cannot be read; `badInput` for a
/// file without such curves, with what it has, or with more than kMost; `cancelled`.
Result<CadCurves> readCurves(const std::string& bytes, const std::string& name,
                             const RunContext& context = {}, const ReadOptions& options = {});

/// True for the text of a STEP or IGES file that names no entity of which a face is made, and some of which a
/// curve is. For files that are not packed.
bool namesNoFaces(std::string_view bytes);

}  // namespace bw::geometry
