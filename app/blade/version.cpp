// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/base/version.h"
#include "bw/geometry/version.h"
#include "bw/scene/version.h"
#include "verbs.h"

namespace bw::cli {

std::string versionText() {
  return "blade " BW_VERSION " (Bladewright)\n" + libraryVersions() + geometry::libraryVersions() +
         scene::libraryVersions();
}

}  // namespace bw::cli
