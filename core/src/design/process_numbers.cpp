// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/process_numbers.h"

#include <array>

namespace bw {

namespace {

constexpr std::array<ProcessNumber, 5> kNumbers = {{
    {{&Process::tolerance, "tolerance", "Tolerance", "mm", 1e-4, 1000, 1e-3, 3, 0.1,
      "Largest deviation of the cut surface that is accepted", "Change tolerance"},
     ProcessPart::setup},
    {{&Process::clearance, "clearance", "Clearance", "mm", 0, 10000, 0, 1, 5,
      "Between a grip of the blade and the block", "Change clearance"},
     ProcessPart::setup},
    {{&Process::cuttingSpeed, "cutting_speed", "Cutting speed", "mm/s", 0.01, 1000, 0.01, 2, 1,
      "Of the fastest point of the blade", "Change cutting speed"},
     ProcessPart::process},
    {{&Process::maxPeriods, "max_periods", "Most waves", "", 0.05, 10, 0.1, 2, 0.1,
      "Periods of the elastica that the blade may span; more than one is hard to hold", "Change most waves"},
     ProcessPart::details,
     true},
    {{&Process::lead, "lead", "Lead", "mm", 0, 10000, 0, 2, 5, "Straight travel before and after the block",
      "Change lead"},
     ProcessPart::details},
}};

}  // namespace

std::span<const ProcessNumber> processNumbers() { return kNumbers; }

}  // namespace bw
