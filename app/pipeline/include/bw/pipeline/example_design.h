// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/design/design.h"
#include "bw/geometry/export.h"

namespace bw::pipeline {

/// The name of the example that a new single block begins as.
inline constexpr const char* kSingleBlock = "single-block";
/// That of a new wall of several blocks.
inline constexpr const char* kBlockWall = "block-wall";

/// The examples that are designed rather than read: a name, a title, and how their surface is told, as
/// `geometry::exampleList` has them. Their designs are resources/examples/<name>.bladewright.
const std::vector<geometry::Example>& designedExamples();

/// A design that cuts the example of that name: of `designedExamples`, or one around a surface of
/// `geometry::exampleList`, with the geometry embedded, a blade that can follow it, and a block where a part
/// of it is cut. An unknown name is an error that names the nearest.
Result<Design> exampleDesign(const std::string& name);

/// The surface of the example of that name as STEP text, mm. Errors as `exampleDesign`.
Result<std::string> exampleSurface(const std::string& name);

}  // namespace bw::pipeline
