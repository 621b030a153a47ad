// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/geometry/version.h"

#include <Standard_Version.hxx>

namespace bw::geometry {

std::string libraryVersions() { return "OpenCASCADE " OCC_VERSION_COMPLETE "\n"; }

}  // namespace bw::geometry
