// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "bw/core/base/finding.h"

namespace bw::test {

/// The first finding of that kind, or null.
inline const Finding* findingOf(const Findings& findings, FindingKind kind) {
  const auto found = std::ranges::find(findings, kind, &Finding::kind);
  return found == findings.end() ? nullptr : &*found;
}

/// The first finding of that cause, or null.
template <class T>
const Finding* findingOf(const Findings& findings) {
  const auto found = std::ranges::find_if(
      findings, [](const Finding& finding) { return std::holds_alternative<T>(finding.cause); });
  return found == findings.end() ? nullptr : &*found;
}

/// The values of that cause, or null.
template <class T>
const T* causeOf(const Findings& findings) {
  const Finding* finding = findingOf<T>(findings);
  return finding ? &std::get<T>(finding->cause) : nullptr;
}

}  // namespace bw::test
