// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/base/finding.h"
#include "controls/theme.h"

namespace bw::app {

/// The colour and icon of a severity.
inline QColor severityColour(Severity severity, const Colours& colours) {
  return severity == Severity::error     ? colours.error
         : severity == Severity::warning ? colours.warning
                                         : colours.selection;
}
inline QString severityIcon(Severity severity) {
  return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "info";
}

}  // namespace bw::app
