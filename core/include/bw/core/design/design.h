// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "bw/core/base/result.h"
#include "bw/core/design/job.h"
#include "bw/core/files/fingerprint.h"
#include "bw/core/files/shared_bytes.h"

namespace bw {

/// Where the target of a design comes from.
struct Source {
  std::filesystem::path path;  ///< of the CAD file; relative to the design file when stored
  SharedBytes bytes;           ///< the file itself if it is embedded, else empty
  /// What the linked file was when the design was last saved; nothing if never, or if it is embedded.
  std::optional<Fingerprint> saved = std::nullopt;
  bool operator==(const Source&) const = default;
};

/// A design: an immutable value that holds everything a result is made from. What the desktop program edits
/// and saves.
struct Design {
  std::string name = "Untitled";
  Source source;
  Job job;

  static constexpr int kVersion = 1;
};

/// Reads a .bladewright file's text. A newer version, unknown keys and wrong types are errors that name them.
Result<Design> parseDesign(std::string_view json);
/// The text of a .bladewright file (JSON, versioned; embedded geometry as base64).
std::string designToJson(const Design& design);

/// Fills `source.saved` from the linked file as it is now; leaves it empty for an embedded source, and as it
/// was where the file cannot be read.
void noteSource(Design& design);

/// Reads and writes the file itself; a linked source is resolved against the file's folder. Writing is
/// atomic.
Result<Design> loadDesign(const std::filesystem::path& file);
Result<void> saveDesign(const Design& design, const std::filesystem::path& file);

}  // namespace bw
