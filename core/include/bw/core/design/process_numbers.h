// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "bw/core/base/number_setting.h"
#include "bw/core/design/design.h"

namespace bw {

/// Where a number of the process stands: in the window under Setup, Process or Process ▸ Fit and lead.
enum class ProcessPart { setup, process, details };

/// A number of the process.
struct ProcessNumber : NumberSetting<Process> {
  ProcessPart part = ProcessPart::process;
  const char* object = nullptr;  ///< in files in the object of that key: "fit", "join"
};
std::span<const ProcessNumber> processNumbers();

}  // namespace bw
