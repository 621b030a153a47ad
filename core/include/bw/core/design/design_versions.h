// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "bw/core/base/result.h"
#include "bw/core/design/design.h"

namespace bw {

// The named versions of a design. They are no part of what is computed: a design with them has the results of
// the same design without.

/// The version of that name. Errors (`badInput`): there is none, with the nearest name or those that there
/// are.
Result<NamedVersion> versionOf(const Design& design, std::string_view name);

/// The design without its versions and marks: what a version holds, and what is handed out with results.
Design withoutVersions(Design design);

/// The design with its present state as a version, the last one. Errors (`badInput`): a name that is empty,
/// taken or no UTF-8; as many versions as there may be.
Result<Design> withVersion(const Design& design, const std::string& name);

/// The design as it was in that version, with the versions and the marks of now. Errors: those of
/// `versionOf`.
Result<Design> atVersion(const Design& design, std::string_view name);

/// The design without that version. Errors: those of `versionOf`.
Result<Design> withoutVersion(const Design& design, std::string_view name);

/// The design with another name for a version, in its place. Errors: those of `versionOf` and of
/// `withVersion`.
Result<Design> withVersionRenamed(const Design& design, std::string_view name, const std::string& next);

/// Does something to the design and to what each of its versions holds.
void changeStates(Design& design, const std::function<void(Design&)>& change);

}  // namespace bw
