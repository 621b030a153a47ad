// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

namespace bw {

/// Who finds the curves in which a plane cuts the target: the own tracer, which keeps up with dragging;
/// OpenCASCADE's intersection, the kernel; or the tracer, which the kernel confirms before results are
/// written.
enum class SectionRoute { automatic, kernel, traced };
/// Their words in a job, by value.
inline constexpr std::array<const char*, 3> kSectionRoutes = {"auto", "kernel", "traced"};

/// How many planes cut the target, and by which route.
struct SectionRequest {
  std::optional<int> stations = {};    ///< 2 to kMost, used unless `spacing` is set; empty: by the tolerance
  std::optional<double> spacing = {};  ///< mm between stations, above 0
  SectionRoute route = SectionRoute::automatic;

  static constexpr int kMost = 20000;
  /// True if the number of stations is to follow from the tolerance.
  bool byTolerance() const { return !stations && !spacing; }
  bool operator==(const SectionRequest&) const = default;
};

}  // namespace bw
