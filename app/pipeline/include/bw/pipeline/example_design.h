// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "bw/core/base/result.h"
#include "bw/core/design/design.h"

namespace bw::pipeline {

/// A design that cuts the example surface of that name (`geometry::exampleList`): the geometry embedded, a
/// blade that is long enough, and for the wall, which no single blade can cut, a block placed in it. Reads
/// resources/examples/<name>.step if it is there, else makes the surface. An unknown name is an error that
/// names the nearest one.
Result<Design> exampleDesign(const std::string& name);

}  // namespace bw::pipeline
