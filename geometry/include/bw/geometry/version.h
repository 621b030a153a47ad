// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace bw::geometry {

/// "OpenCASCADE 7.6.3" and a line feed.
std::string libraryVersions();

}  // namespace bw::geometry
