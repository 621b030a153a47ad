// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/job_numbers.h"

#include <array>

namespace bw {

namespace {

constexpr std::array<JobNumber, 5> kJob = {{
    {{&Job::tolerance, "tolerance", "Tolerance", "mm", 1e-4, 1000, 1e-3, 3, 0.1,
      "Largest deviation of the cut surface that is accepted", "Change tolerance"},
     JobPart::setup},
    {{&Job::clearance, "clearance", "Clearance", "mm", 0, 10000, 0, 1, 5,
      "Between a grip of the blade and the block", "Change clearance"},
     JobPart::setup},
    {{&Job::cuttingSpeed, "cutting_speed", "Cutting speed", "mm/s", 0.01, 1000, 0.01, 2, 1,
      "Of the fastest point of the blade", "Change cutting speed"},
     JobPart::process},
    {{&Job::maxPeriods, "max_periods", "Most waves", "", 0.05, 10, 0.1, 2, 0.1,
      "Periods of the elastica that the blade may span; more than one is hard to hold", "Change most waves"},
     JobPart::details,
     true},
    {{&Job::lead, "lead", "Lead", "mm", 0, 10000, 0, 2, 5, "Straight travel before and after the block",
      "Change lead"},
     JobPart::details},
}};

}  // namespace

std::span<const JobNumber> jobNumbers() { return kJob; }

}  // namespace bw
