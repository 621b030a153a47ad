// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

#include <vector>

#include "bw/pipeline/pipeline.h"

namespace bw::app {

/// A number of a result, as text, to be set beside that of another; empty where it is not known.
struct ComparedNumber {
  QString name, tip, text;
  bool broken = false;  ///< beyond its limit
};

/// What results are compared by, always the same numbers: largest deviation, surface covered, smallest margin
/// and radius, cutting time, foam. Of a result that did not come so far, or of none, those that are known.
std::vector<ComparedNumber> comparedNumbers(const pipeline::Evaluation* evaluation);

}  // namespace bw::app
