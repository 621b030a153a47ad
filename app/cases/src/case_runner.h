// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bw/cases/cases.h"
#include "bw/core/curve/planar_curve.h"
#include "bw/core/elastica/elastica.h"
#include "bw/core/text/json_reader.h"

/// Points as [x, y], and null for a number that is not there.
template <>
struct nlohmann::adl_serializer<Eigen::Vector2d> {
  template <class Json>
  static void to_json(Json& json, const Eigen::Vector2d& p) {
    json = {p.x(), p.y()};
  }
};
template <class T>
struct nlohmann::adl_serializer<std::optional<T>> {
  template <class Json>
  static void to_json(Json& json, const std::optional<T>& value) {
    json = value ? Json(*value) : Json(nullptr);
  }
};

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
/// The same from a member that must be there.
void readPoint(ObjectReader& reader, const std::string& key, Eigen::Vector2d& out);

/// {"type": "bezier" | "bspline" | "points", …} to a curve.
Result<PlanarCurve> curveFromJson(const nlohmann::json& object, const std::string& path);

/// An elastica object as the command line writes it: the regular form, and the thesis's control parameters or
/// null.
nlohmann::ordered_json elasticaToJson(const Elastica& elastica);
/// Reads either form; keys of the regular form win where both are there.
Result<Elastica> elasticaFromJson(const nlohmann::json& object, const std::string& path);

/// {"error": {...}} of a case.
nlohmann::ordered_json errorToJson(const Error& error);

/// The text of a result, or of many.
std::string dumped(const nlohmann::ordered_json& answer, bool many);

/// The spline of least bending energy near a curve: reads the rest of a case and answers it
/// (docs/command-line.md, `relax`).
Result<nlohmann::ordered_json> answerRelaxation(ObjectReader& reader, bool& limited);

/// Points as text, two numbers a line as `fitCaseFromCsv` takes them.
Result<std::vector<Eigen::Vector2d>> pointsFromCsv(std::string_view text);

}  // namespace bw::cases
