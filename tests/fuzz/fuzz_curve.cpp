// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The readers of motions and of plane curves, CSV and JSON, all on the same bytes. What a writer makes of a
// motion that was read is read back to the same text.

#include <cstddef>
#include <cstdint>

#include "bw/robotio/text/program_text.h"
#include "case_runner.h"
#include "require.h"

namespace {

void checkMotion(const bw::Result<bw::Motion>& motion) {
  if (!motion) {
    FUZZ_REQUIRE(!motion.error().message.empty());
    return;
  }
  const auto csv = bw::robotio::writeCsv(*motion);
  FUZZ_REQUIRE(csv);
  const auto fromCsv = bw::robotio::readCsv(csv->front().bytes);
  FUZZ_REQUIRE(fromCsv);
  const auto json = bw::robotio::writeJson(*fromCsv, bw::Cell{});
  FUZZ_REQUIRE(json);
  const auto fromJson = bw::robotio::readJson(json->front().bytes);
  FUZZ_REQUIRE(fromJson);
  FUZZ_REQUIRE(bw::robotio::writeCsv(*fromJson)->front().bytes == csv->front().bytes);
}

template <typename Value>
void checkError(const bw::Result<Value>& result) {
  if (!result) FUZZ_REQUIRE(!result.error().message.empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  checkMotion(bw::robotio::readCsv(text));
  checkMotion(bw::robotio::readJson(text));
  const auto json = bw::parseJsonText(text, "the curve");
  checkError(json);
  if (json) checkError(bw::cases::curveFromJson(*json, "curve"));
  const auto points = bw::cases::pointsFromCsv(text);
  checkError(points);
  if (points) checkError(bw::PlanarCurve::points(*points));
  return 0;
}
