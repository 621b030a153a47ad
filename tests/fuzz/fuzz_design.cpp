// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A design that can be read can be written and read again, with its embedded bytes.

#include <cstddef>
#include <cstdint>

#include "bw/core/design/design.h"
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
  return 0;
}
