// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace bw::scene {

/// "VTK 9.1.0" and a line feed.
std::string libraryVersions();

}  // namespace bw::scene
