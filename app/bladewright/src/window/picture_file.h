// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>

#include <filesystem>

#include "bw/core/base/result.h"

namespace bw::app {

/// Writes `image` as PNG, all or nothing. An error if it is null (`ErrorCode::noSolution`) or cannot be
/// written.
Result<void> writePng(const QImage& image, const std::filesystem::path& file);

}  // namespace bw::app
