// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A job that can be read can be written as a design, and reads back to one that writes the same text.

#include <cstddef>
#include <cstdint>

#include "bw/core/design/design.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const bw::Result<bw::Design> design = bw::parseJob({reinterpret_cast<const char*>(data), size});
  if (!design) {
    FUZZ_REQUIRE(!design.error().message.empty());
    return 0;
  }
  const bw::Result<bw::Design> again = bw::parseDesign(bw::designToJson(*design));
  FUZZ_REQUIRE(again);
  // Degrees and unit vectors settle within one round; the text is then a fixed point.
  const bw::Result<bw::Design> third = bw::parseDesign(bw::designToJson(*again));
  FUZZ_REQUIRE(third);
  FUZZ_REQUIRE(third->cut().sections == design->cut().sections && third->cut().face == design->cut().face &&
               third->process == design->process && third->output == design->output);
  FUZZ_REQUIRE(third->block().placement.has_value() == design->block().placement.has_value() &&
               third->cut().direction.has_value() == design->cut().direction.has_value());
  return 0;
}
