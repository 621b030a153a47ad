// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "controls/severity.h"

namespace bw::app {

QColor severityColour(Severity severity, const Colours& colours) {
  return severity == Severity::error     ? colours.error
         : severity == Severity::warning ? colours.warning
                                         : colours.selection;
}

QString severityIcon(Severity severity) {
  return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "info";
}

}  // namespace bw::app
