// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/files/file_set.h"
#include "bw/core/files/fingerprint.h"
#include "bw/pipeline/produce.h"

namespace bw::pipeline {

namespace fs = std::filesystem;

namespace {

/// A source up to this size is embedded there; a larger one is linked.
constexpr std::uintmax_t kEmbedLimit = 8u << 20;

}  // namespace

Result<Design> storedDesign(const Evaluation& evaluation) {
  Design result = evaluation.design;
  const Fingerprint& read = evaluation.source.value->content;
  const auto changed = [&] {
    return fail(ErrorCode::cannotRead,
                result.source().path.string() +
                    " was changed after the results were computed from it; compute them again",
                result.source().path.string());
  };
  std::error_code error;
  if (result.source().bytes.empty() && fs::file_size(result.source().path, error) <= kEmbedLimit && !error) {
    Result<std::string> bytes = readFile(result.source().path);
    if (!bytes) return tl::unexpected<Error>(bytes.error());
    if (fingerprintOf(*bytes) != read) return changed();
    result.source().bytes = std::move(*bytes);
    result.source().path = result.source().path.filename();
  } else if (result.source().bytes.empty()) {
    const Result<Fingerprint> now = fingerprintOfFile(result.source().path);
    if (!now) return tl::unexpected<Error>(now.error());
    if (*now != read) return changed();
    result.source().path = fs::absolute(result.source().path, error);
    result.source().saved = read;
  }
  return result;
}

}  // namespace bw::pipeline
