// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace bw {

/// Versions of the libraries that core uses, one "name version" a line.
std::string libraryVersions();

}  // namespace bw
