// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Whatever a DXF file holds, its curves are finite and make a loft, or one sentence says why not.

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "bw/core/dxf/dxf_curves.h"
#include "bw/core/shape/drawn_sections.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const bw::Result<bw::DxfCurves> read = bw::readDxf(text, "a.dxf");
  if (!read) {
    FUZZ_REQUIRE(!read.error().message.empty());
    return 0;
  }
  FUZZ_REQUIRE(bw::isDxf(text) && !read->curves.empty() && !read->unit.empty());
  for (const bw::SpaceCurve& curve : read->curves) {
    FUZZ_REQUIRE(bw::checkSpaceCurve(curve));
    for (const Eigen::Vector3d& point : curve.samples(50)) FUZZ_REQUIRE(point.allFinite());
  }
  bw::RunContext alone;
  alone.threads = 1;
  bw::DrawnOptions few;
  few.points = 4;
  const bw::Result<bw::DrawnSections> drawn = bw::sectionsThrough(read->curves, few, alone);
  if (!drawn) {
    FUZZ_REQUIRE(!drawn.error().message.empty());
    return 0;
  }
  FUZZ_REQUIRE(std::isfinite(drawn->deviation) && drawn->longest > 0);
  FUZZ_REQUIRE(bw::splineOf(drawn->surface));
  return 0;
}
