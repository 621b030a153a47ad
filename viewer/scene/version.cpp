// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/scene/version.h"

#include <vtkVersion.h>

namespace bw::scene {

std::string libraryVersions() { return std::string("VTK ") + vtkVersion::GetVTKVersion() + "\n"; }

}  // namespace bw::scene
