// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/file_set.h"
#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

namespace fs = std::filesystem;

namespace {

/// A source up to this size is embedded there; a larger one is linked.
constexpr std::uintmax_t kEmbedLimit = 8u << 20;

}  // namespace

Result<Design> storedDesign(const Design& design) {
  Design result = design;
  std::error_code error;
  if (result.source.bytes.empty() && fs::file_size(result.source.path, error) <= kEmbedLimit && !error) {
    Result<std::string> bytes = readFile(result.source.path);
    if (!bytes) return tl::unexpected<Error>(bytes.error());
    result.source.bytes = std::move(*bytes);
    result.source.path = result.source.path.filename();
  } else if (result.source.bytes.empty()) {
    result.source.path = fs::absolute(result.source.path, error);
    noteSource(result);
  }
  return result;
}

}  // namespace bw::pipeline
