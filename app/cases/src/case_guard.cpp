// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "case_guard.h"

#include <cmath>
#include <exception>
#include <optional>

#include "bw/core/base/fault_barrier.h"
#include "bw/core/base/work_meter.h"

namespace bw::cases {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr const char* kBest =
    "The search was stopped at the work limit of a case; this is the best until then.";
constexpr const char* kNothing = "The search was stopped at the work limit of a case.";

/// The path of the first number that is not finite.
std::optional<std::string> notFinite(const ordered_json& value, const std::string& path) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) return path;
  if (value.is_object()) {
    for (const auto& [key, member] : value.items())
      if (auto found = notFinite(member, path.empty() ? key : path + "." + key)) return found;
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (value[i].is_number_integer()) continue;
      if (value[i].is_number_float() && std::isfinite(value[i].get<double>())) continue;
      if (auto found = notFinite(value[i], path + "[" + std::to_string(i) + "]")) return found;
    }
  }
  return std::nullopt;
}

void tellStopped(ordered_json& result) {
  if (result.contains("status")) result["status"] = "work-limit";
  std::string message = kBest;
  if (const auto before = result.find("message"); before != result.end() && before->is_string())
    if (const std::string text = before->get<std::string>(); !text.empty()) message += " " + text;
  result["message"] = message;
}

}  // namespace

Result<ordered_json> runGuarded(const CaseFunction& run, const json& object, bool& limited,
                                std::int64_t work) {
  const FaultBarrier barrier;
  const WorkMeter meter(work);
  try {
    Result<ordered_json> result = run(object, limited);
    if (!result) {
      if (std::string& text = result.error().message;
          meter.stopped() && result.error().code == ErrorCode::noSolution)
        text += (text.ends_with('.') ? " " : ". ") + std::string(kNothing);
      return result;
    }
    if (const std::optional<std::string> where = notFinite(*result, ""))
      return fail(
          ErrorCode::noSolution,
          "the result's " + *where +
              " is beyond the numbers of the computer: the numbers of the case are too large, too small "
              "or too far apart; scale them, or look for a slip in one of them",
          *where);
    if (meter.stopped()) {
      tellStopped(*result);
      limited = true;
    }
    return result;
  } catch (const std::exception& e) {
    return fail(ErrorCode::internal,
                std::string("this case met a fault of Bladewright's own: ") + e.what() +
                    "; please report it with the case",
                "case");
  }
}

}  // namespace bw::cases
