// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/finding.h"
#include "controls/theme.h"

namespace bw::app {

/// The colour and icon of a severity.
QColor severityColour(Severity severity, const Colours& colours);
QString severityIcon(Severity severity);

}  // namespace bw::app
