// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A job that can be read can be written, and reads back to a job that writes the same text.

#include <cstddef>
#include <cstdint>

#include "bw/core/design/job.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const bw::Result<bw::Job> job = bw::parseJob({reinterpret_cast<const char*>(data), size});
  if (!job) {
    FUZZ_REQUIRE(!job.error().message.empty());
    return 0;
  }
  const std::string text = bw::jobToJson(*job);
  const bw::Result<bw::Job> again = bw::parseJob(text);
  FUZZ_REQUIRE(again);
  // Degrees and unit vectors settle within one round; the text is then a fixed point.
  const std::string settled = bw::jobToJson(*again);
  const bw::Result<bw::Job> third = bw::parseJob(settled);
  FUZZ_REQUIRE(third);
  FUZZ_REQUIRE(third->stations == job->stations && third->face == job->face &&
               third->programs == job->programs);
  FUZZ_REQUIRE(third->tolerance == job->tolerance && third->cell == job->cell && third->lead == job->lead);
  FUZZ_REQUIRE(third->block.has_value() == job->block.has_value() &&
               third->direction.has_value() == job->direction.has_value());
  return 0;
}
