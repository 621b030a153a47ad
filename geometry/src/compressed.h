// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "bw/core/base/result.h"

namespace bw::geometry {

/// True for bytes of a gzip or zip file, as `.stpz` files are.
bool isCompressed(std::string_view bytes);

/// The text in a gzip file, or in the one CAD file of a zip archive. Errors (`cannotRead`, with `name`): cut
/// short, damaged, several or no CAD files, or more than 1 GiB or 200 times its own size, which no text is.
Result<std::string> decompressed(std::string_view bytes, const std::string& name);

}  // namespace bw::geometry
