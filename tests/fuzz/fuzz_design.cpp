// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A design that can be read can be written and read again, with its embedded bytes, its variables, its
// versions and its surface.

#include <cstddef>
#include <cstdint>

#include "bw/core/design/design.h"
#include "bw/core/design/design_difference.h"
#include "bw/core/design/design_versions.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const bw::Result<bw::Design> design = bw::parseDesign({reinterpret_cast<const char*>(data), size});
  if (!design) {
    FUZZ_REQUIRE(!design.error().message.empty());
    return 0;
  }
  const bw::Result<bw::Design> again = bw::parseDesign(bw::designToJson(*design));
  FUZZ_REQUIRE(again);
  FUZZ_REQUIRE(again->source().bytes == design->source().bytes);
  FUZZ_REQUIRE(again->cut().sections == design->cut().sections);
  FUZZ_REQUIRE(again->variables == design->variables);
  FUZZ_REQUIRE(again->versions.size() == design->versions.size());
  for (std::size_t i = 0; i < design->versions.size(); ++i) {
    FUZZ_REQUIRE(again->versions[i].name == design->versions[i].name);
    FUZZ_REQUIRE(again->versions[i].design->source().bytes == design->versions[i].design->source().bytes);
    FUZZ_REQUIRE(bw::atVersion(*again, design->versions[i].name));
    (void)bw::differences(*design->versions[i].design, *design);
  }
  FUZZ_REQUIRE(again->source().surface.has_value() == design->source().surface.has_value());
  FUZZ_REQUIRE(bw::resolved(*design));
  // A surface, or one sentence. What a formula costs is bounded, but too much for a fuzzer.
  if (!design->source().surface ||
      std::holds_alternative<bw::FormulaSurface>(design->source().surface->shape))
    return 0;
  const bw::Result<bw::SplineSurface> spline = bw::splineOf(*design->source().surface);
  FUZZ_REQUIRE(spline || !spline.error().message.empty());
  if (spline)
    for (const Eigen::Vector3d& pole : spline->poles) FUZZ_REQUIRE(pole.allFinite());
  return 0;
}
