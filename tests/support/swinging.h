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
  std::get<FormulaSurface>(design.source().surface->shape).formula = "250 + 130*(x/600)*sin(2*pi*y/200)";
  design.process.weight = false;
  design.cut().sections.stations = 49;
  design.output.programs.clear();
  return resolved(design).value();
}

}  // namespace bw::test
