// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <variant>

#include "bw/core/design/variables.h"
#include "bw/pipeline/example_design.h"

namespace bw::test {

/// A surface that swings along the travel, the more the farther right: there the blade goes up and down more
/// than three times as fast as at its left end. Without programs.
inline Design swinging() {
  Design design = pipeline::exampleDesign("ripple-along").value();
  design.variables.clear();
  design.bindings.clear();
  std::get<FormulaSurface>(design.source().surface->shape).formula =
      "250 + 130*(x/600)*sin(2*pi*y/200) + 5*(1 - ((x-300)/300)^2)";
  design.process.weight = false;
  design.process.jointGap = 0.5;  // mm: of the parts that it is cut in, with stations as far apart
  design.cut().sections.stations = 49;
  design.output.programs.clear();
  return resolved(design).value();
}

}  // namespace bw::test
