// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/base/finding.h"

#include <algorithm>

namespace bw {

const char* severityName(Severity severity) {
  static const char* const kNames[] = {"info", "warning", "error"};
  return kNames[int(severity)];
}

FindingKind Finding::kind() const {
  return std::visit([](const auto& value) { return value.kind; }, cause);
}

bool hasErrors(const Findings& findings) {
  return std::ranges::any_of(findings, [](const Finding& f) { return f.severity == Severity::error; });
}

bool exceedsLimit(const Findings& findings) {
  return std::ranges::any_of(findings, [](const Finding& f) {
    if (f.severity != Severity::warning) return f.severity == Severity::error;
    const FindingKind kind = f.kind();
    return kind == FindingKind::deviation || kind == FindingKind::clearance || kind == FindingKind::floor ||
           kind == FindingKind::stability || kind == FindingKind::motion || kind == FindingKind::joint ||
           kind == FindingKind::crease;
  });
}

bool isSnapByGrip(const Finding& finding) {
  const auto* errors = std::get_if<GripErrors>(&finding.cause);
  const auto* held = std::get_if<HeldByLittle>(&finding.cause);
  return (errors && errors->snaps) || (held && held->barrier == 0);
}

}  // namespace bw
