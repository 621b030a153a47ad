// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace bw {

/// How serious a finding is. An `error` means that the surface cannot be cut as designed.
enum class Severity { info, warning, error };

/// "info", "warning" or "error".
const char* severityName(Severity severity);

/// "station 8" for the index 7: texts for people count from 1, as the window does; indices in data count from
/// 0.
std::string stationName(int index);

/// The place of a finding: everything that the window needs to select and frame it.
struct Place {
  std::string text = {};  ///< in words, for instance "station 12"
  std::optional<int> strip = std::nullopt;
  std::optional<int> station = std::nullopt;
  std::optional<Eigen::Vector3d> point = std::nullopt;  ///< in the file's frame, mm
};

/// One finding of a check. `kind` is a stable word for scripts ("deviation", "curvature", "clearance", …);
/// `message` says what is wrong, where, by how much, and what to do.
struct Issue {
  Severity severity = Severity::info;
  std::string kind;
  std::string message;
  Place where = {};
};

using Issues = std::vector<Issue>;

/// True if any of `issues` is an error.
bool hasErrors(const Issues& issues);

/// True if any of `issues` says that a limit is exceeded: an error of any kind, or a warning about a limit
/// that the job or the blade states, of kind "deviation" (tolerance), "clearance" or "stability" (the blade
/// would not keep its shape). Warnings by rules of thumb ("angle", "speed", "inflections", …) do not count,
/// nor does "out-of-plane", which hangs on how the grips hold the blade.
bool exceedsLimit(const Issues& issues);

}  // namespace bw
