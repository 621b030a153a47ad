// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "case_runner.h"

namespace bw::cases {

/// The spline of least bending energy near a curve: reads the rest of a case and answers it
/// (docs/command-line.md, `relax`).
Result<nlohmann::ordered_json> answerRelaxation(ObjectReader& reader, bool& limited);

}  // namespace bw::cases
