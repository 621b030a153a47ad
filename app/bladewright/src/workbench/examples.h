// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "bw/core/base/result.h"
#include "bw/core/design/design.h"

namespace bw::app {

/// A design that cuts the example surface of that name: the geometry embedded, a blade long enough, the block
/// around it. Reads resources/examples/<name>.step if it is there, else makes the surface.
Result<Design> exampleDesign(const std::string& name);

}  // namespace bw::app
