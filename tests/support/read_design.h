// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "bw/core/design/design.h"

namespace bw::test {

/// The design of a file's text, which must be one.
inline Design designOf(const std::string& text) {
  Result<Design> design = parseDesign(text);
  EXPECT_TRUE(design) << design.error().message;
  return design.value_or(Design{});
}

/// Why an object is no design's; "accepted" where it is one.
inline std::string errorOf(const nlohmann::json& object) {
  const Result<Design> design = parseDesign(object.dump());
  return design ? "accepted" : design.error().message;
}

}  // namespace bw::test
