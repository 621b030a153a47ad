// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bw/cases/cases.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/text/json_reader.h"

namespace bw::cases {

/// An error's value to return from a function of any result.
inline tl::unexpected<Error> passOn(const Error& error) { return tl::unexpected<Error>(error); }

/// One case to its result. Sets the flag if a result is there but a stated bound or tolerance is not met.
using CaseFunction =
    std::function<Result<nlohmann::ordered_json>(const nlohmann::json& object, bool& limited)>;

/// The work that one case may cost, in units of `WorkMeter`: one to two seconds.
inline constexpr std::int64_t kCaseWork = 12'000'000;

/// Runs one case, or all of {"cases": […]} in parallel, each to a fixed slot and with its own share of
/// `work`.
Result<CaseAnswer> runCases(std::string_view text, const RunContext& context, const CaseFunction& run,
                            std::int64_t work = kCaseWork);

/// A list of finite numbers; `path` names it in errors. At most a million.
Result<std::vector<double>> readNumbers(const nlohmann::json* value, const std::string& path);

/// A list of finite points [x, y]. At most a million.
Result<std::vector<Eigen::Vector2d>> readPoints(const nlohmann::json* value, const std::string& path);

/// One finite point [x, y].
Result<Eigen::Vector2d> readPoint(const nlohmann::json* value, const std::string& path);

/// {"type": "bezier" | "bspline" | "points", …} to a curve.
Result<PlanarCurve> curveFromJson(const nlohmann::json& object, const std::string& path);

/// A list of points as [[x, y], …].
nlohmann::ordered_json pointsToJson(const std::vector<Eigen::Vector2d>& points);

/// Points as text, two numbers a line as `fitCaseFromCsv` takes them.
Result<std::vector<Eigen::Vector2d>> pointsFromCsv(std::string_view text);

}  // namespace bw::cases
