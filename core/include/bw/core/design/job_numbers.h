// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "bw/core/base/number_setting.h"
#include "bw/core/design/job.h"

namespace bw {

/// Where a number of a job stands: in the window under Setup, Process or Process ▸ Fit and lead.
enum class JobPart { setup, process, details };

struct JobNumber : NumberSetting<Job> {
  JobPart part = JobPart::process;
  bool ofFit = false;  ///< in files in the object "fit"
};
std::span<const JobNumber> jobNumbers();

}  // namespace bw
