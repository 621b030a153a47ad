// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>

#include <filesystem>
#include <string>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"

namespace bw {

/// "cannot write PATH: why", with what helps.
tl::unexpected<Error> cannotWrite(const std::filesystem::path& path, int error);

/// Makes a file that is not there yet, writes it and waits until it is on the disk; on failure it is removed
/// again. `shown` is the name for messages.
Result<void> writeSynced(const std::filesystem::path& path, const std::string& bytes,
                         const std::filesystem::path& shown, const RunContext& context);
/// Writes into a device or pipe.
Result<void> writeInto(const std::filesystem::path& path, const std::string& bytes);

/// Waits until the names in a folder are on the disk. Where a folder cannot be opened or synced there is
/// nothing to wait for.
Result<void> syncFolder(const std::filesystem::path& folder);
/// That of a folder and all folders below; links are not followed.
Result<void> syncTree(const std::filesystem::path& folder);

}  // namespace bw
