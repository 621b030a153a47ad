// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/pipeline/pipeline.h"

namespace bw::pipeline {

/// The stage that reads the first source of a design, beside its evaluation: whoever evaluates the design
/// with it as what was before does not read the file once more, unless it has changed since.
Result<Stage<SourceRequest, CadSource>> readFirstSource(const Design& design, const RunContext& context);

}  // namespace bw::pipeline
