// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "case_runner.h"

#include <cmath>
#include <exception>
#include <optional>

#include "bw/core/base/fault_barrier.h"
#include "bw/core/base/work_meter.h"
#include "bw/core/text/number_text.h"

namespace bw::cases {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr std::size_t kMaxPoints = 1000000;

std::optional<double> finiteNumber(const json& value) {
  const double x = value.is_number() ? value.get<double>() : std::nan("");
  return std::isfinite(x) ? std::optional(x) : std::nullopt;
}

std::optional<Eigen::Vector2d> finitePoint(const json& value) {
  if (!value.is_array() || value.size() != 2) return std::nullopt;
  const std::optional<double> x = finiteNumber(value[0]), y = finiteNumber(value[1]);
  return x && y ? std::optional(Eigen::Vector2d(*x, *y)) : std::nullopt;
}

/// Every entry by `read`; `entries` and `entry` are what messages call them.
template <class T>
Result<std::vector<T>> readList(const json* value, const std::string& path,
                                std::optional<T> (*read)(const json&), const std::string& list,
                                const std::string& entries, const std::string& entry) {
  if (!value || !value->is_array())
    return fail(ErrorCode::badInput, path + " must be a list of " + list, path);
  if (value->size() > kMaxPoints)
    return fail(
        ErrorCode::badInput,
        path + " has " + std::to_string(value->size()) + " " + entries + "; at most a million are read", path,
        double(value->size()), double(kMaxPoints));
  std::vector<T> result;
  result.reserve(value->size());
  for (const json& item : *value) {
    const std::optional<T> taken = read(item);
    const std::string where = taken ? "" : path + "[" + std::to_string(result.size()) + "]";
    if (!taken) return fail(ErrorCode::badInput, where + " must be " + entry, where);
    result.push_back(*taken);
  }
  return result;
}

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

/// Runs one case so that it can harm no other: its work is bounded, a fault of our own and numbers that are
/// not finite become its error. Where the work ended a search, the result says so in its `status` and
/// `message` and counts as limited, and an error's message says so.
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

}  // namespace

Result<std::vector<double>> readNumbers(const json* value, const std::string& path) {
  return readList(value, path, finiteNumber, "numbers", "entries", "a finite number");
}

Result<std::vector<Eigen::Vector2d>> readPoints(const json* value, const std::string& path) {
  return readList(value, path, finitePoint, "points [x, y]", "points",
                  "a point [x, y] of two finite numbers");
}

Result<Eigen::Vector2d> readPoint(const json* value, const std::string& path) {
  const std::optional<Eigen::Vector2d> p = value ? finitePoint(*value) : std::nullopt;
  if (!p) return fail(ErrorCode::badInput, path + " must be a point [x, y] of two finite numbers", path);
  return *p;
}

void readPoint(ObjectReader& reader, const std::string& key, Eigen::Vector2d& out) {
  const json* value = reader.member(key);
  if (const std::optional<Eigen::Vector2d> p = value ? finitePoint(*value) : std::nullopt)
    out = *p;
  else
    reader.complain(key, reader.path() + "." + key + " must be two finite numbers [x, y]");
}

Result<PlanarCurve> curveFromJson(const json& object, const std::string& path) {
  ObjectReader reader(object, path);
  int type = -1;
  reader.word("type", {"bezier", "bspline", "points"}, type);
  reader.need("type", path + " needs the key type: \"bezier\", \"bspline\" or \"points\"");
  const char* key = type == 2 ? "points" : "poles";
  const json *list = reader.member(key), *knotList = nullptr, *weightList = nullptr;
  int degree = 3;
  if (type == 1) {
    knotList = reader.member("knots");
    weightList = reader.given("weights");
    reader.integer("degree", degree, 1, 25);
    reader.need("degree", path + " needs the key degree");
  }
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  std::vector<Eigen::Vector2d> points;
  std::vector<double> knots, weights;
  reader.take(readPoints(list, path + "." + key), points);
  if (type == 1) reader.take(readNumbers(knotList, path + ".knots"), knots);
  if (weightList) reader.take(readNumbers(weightList, path + ".weights"), weights);
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  if (type == 0) return PlanarCurve::bezier(std::move(points));
  if (type == 2) return PlanarCurve::points(std::move(points));
  return PlanarCurve::bspline(degree, std::move(knots), std::move(points), std::move(weights));
}

Result<std::vector<Eigen::Vector2d>> pointsFromCsv(std::string_view text) {
  std::vector<Eigen::Vector2d> points;
  int line = 0;
  bool sawLine = false;
  while (!text.empty()) {
    ++line;
    const std::size_t end = text.find('\n');
    std::string_view row = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    row = row.substr(0, row.find('#'));
    std::vector<std::string_view> words;
    constexpr std::string_view kBreaks = ",; \t\r";
    for (std::size_t at = row.find_first_not_of(kBreaks); at != std::string_view::npos;) {
      const std::size_t stop = row.find_first_of(kBreaks, at);
      words.push_back(row.substr(at, stop - at));
      at = row.find_first_not_of(kBreaks, stop);
    }
    if (words.empty()) continue;
    const std::optional<double> x = parseNumber(words[0]);
    const std::optional<double> y = parseNumber(words.size() > 1 ? words[1] : std::string_view());
    if (!sawLine && !x && !y) {
      sawLine = true;  // the header
      continue;
    }
    sawLine = true;
    if (!x || !y || words.size() != 2)
      return fail(ErrorCode::badInput, "line " + std::to_string(line) + " must hold two numbers, x and y",
                  "line " + std::to_string(line), double(line));
    points.emplace_back(*x, *y);
  }
  return points;
}

ordered_json errorToJson(const Error& error) {
  return {{"error",
           {{"code", errorCodeName(error.code)},
            {"message", error.message},
            {"where", error.where},
            {"value", error.value},
            {"limit", error.limit}}}};
}

std::string dumped(const ordered_json& answer, bool many) {
  return answer.dump(many ? -1 : 2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Result<CaseAnswer> runCases(std::string_view text, const RunContext& context, const CaseFunction& run,
                            std::int64_t work) {
  const Result<json> input = parseJsonText(text, "the input");
  if (!input) return passOn(input.error());
  const bool many = input->is_object() && input->contains("cases");
  if (many && (!(*input)["cases"].is_array() || input->size() != 1))
    return fail(ErrorCode::badInput,
                "\"cases\" must be a list of cases, and no other key may stand beside it", "cases");
  if (!many && !input->is_object())
    return fail(ErrorCode::badInput, "the input must be a JSON object: one case or {\"cases\": [...]}",
                "input");
  const int count = many ? int((*input)["cases"].size()) : 1;
  std::vector<ordered_json> results(static_cast<std::size_t>(count));
  std::vector<std::optional<Error>> errors(static_cast<std::size_t>(count));
  std::vector<char> limited(static_cast<std::size_t>(count), 0);
  const auto body = [&](int i) {
    const std::size_t k = std::size_t(i);
    bool limit = false;
    Result<ordered_json> result = runGuarded(run, many ? (*input)["cases"][k] : *input, limit, work);
    limited[k] = limit;
    if (result) {
      results[k] = std::move(*result);
    } else {
      errors[k] = result.error();
      results[k] = errorToJson(result.error());
    }
  };
  if (Result<void> ok = parallelFor(context, count, body); !ok) return passOn(ok.error());
  CaseAnswer answer;
  for (std::size_t k = 0; k < results.size(); ++k) {
    answer.limited = answer.limited || limited[k];
    if (!errors[k]) continue;
    ++answer.failed;
    if (!answer.first) answer.first = errors[k];
  }
  answer.json = dumped(many ? ordered_json{{"results", results}} : results[0], many);
  return answer;
}

}  // namespace bw::cases
