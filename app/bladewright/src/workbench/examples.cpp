// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "workbench/examples.h"

#include "bw/pipeline/example_design.h"

namespace bw::app {

Result<Design> exampleDesign(const std::string& name) { return pipeline::exampleDesign(name); }

}  // namespace bw::app
