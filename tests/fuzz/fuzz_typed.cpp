// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Whatever is typed into a field is a number within its limits or one sentence; lists and formulas likewise.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "bw/core/text/expression.h"
#include "bw/core/text/number_text.h"
#include "bw/core/text/typed_number.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bw::NumberDemand kDemands[] = {{"mm", 10, 20000},      {"\u00b0", -360, 360},
                                              {"mm/s", 0.01, 1000},   {"N/mm\u00b2", 1, 2e6},
                                              {"\u00b0C", -50, 1500}, {"\u00b710\u207b\u2076/K", 0, 1000},
                                              {"", 2, 5000, true}};
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const bw::NumberDemand& demand : kDemands) {
    const bw::Result<double> value = bw::readTypedNumber(text, demand);
    if (!value) {
      FUZZ_REQUIRE(!value.error().message.empty());
      continue;
    }
    FUZZ_REQUIRE(*value >= demand.min && *value <= demand.max);
    FUZZ_REQUIRE(!demand.whole || *value == std::round(*value));
    // What the field would show means the same again.
    const bw::Result<double> again = bw::readTypedNumber(bw::roundTripText(*value), demand);
    FUZZ_REQUIRE(again && *again == *value);
  }
  const bw::Result<std::vector<int>> list = bw::readNumberList(text, 1000, "face");
  if (list)
    FUZZ_REQUIRE(bw::readNumberList(bw::numberListText(*list), 1000, "face").value() == *list);
  else
    FUZZ_REQUIRE(!list.error().message.empty());
  const std::array<bw::NamedNumber, 2> numbers = {{{"x", 2}, {"width", 600}}};
  const bw::Result<double> value = bw::evaluateExpression(text, numbers);
  FUZZ_REQUIRE(value ? std::isfinite(*value) : !value.error().message.empty());
  return 0;
}
