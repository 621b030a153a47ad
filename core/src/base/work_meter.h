// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/work_meter.h"

namespace bw::detail {

/// Charges work to the meter of this thread, if there is one.
inline void chargeWork(std::int64_t units) { WorkMeter::charge(units); }

/// True once the meter of this thread is spent: a search ends with what it has.
inline bool workExhausted() { return WorkMeter::exhausted(); }

}  // namespace bw::detail
