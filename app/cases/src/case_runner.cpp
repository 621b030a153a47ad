// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "case_runner.h"

#include <cmath>
#include <optional>

#include "case_guard.h"
#include "elastica_json.h"

namespace bw::cases {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr std::size_t kMaxPoints = 1000000;

}  // namespace

Result<std::vector<double>> readNumbers(const json* value, const std::string& path) {
  if (!value || !value->is_array())
    return fail(ErrorCode::badInput, path + " must be a list of numbers", path);
  if (value->size() > kMaxPoints)
    return fail(ErrorCode::badInput,
                path + " has " + std::to_string(value->size()) + " entries; at most a million are read", path,
                double(value->size()), double(kMaxPoints));
  std::vector<double> result;
  result.reserve(value->size());
  for (std::size_t i = 0; i < value->size(); ++i) {
    const json& entry = (*value)[i];
    const double x = entry.is_number() ? entry.get<double>() : std::nan("");
    if (!std::isfinite(x))
      return fail(ErrorCode::badInput, path + "[" + std::to_string(i) + "] must be a finite number",
                  path + "[" + std::to_string(i) + "]");
    result.push_back(x);
  }
  return result;
}

Result<std::vector<Eigen::Vector2d>> readPoints(const json* value, const std::string& path) {
  if (!value || !value->is_array())
    return fail(ErrorCode::badInput, path + " must be a list of points [x, y]", path);
  if (value->size() > kMaxPoints)
    return fail(ErrorCode::badInput,
                path + " has " + std::to_string(value->size()) + " points; at most a million are read", path,
                double(value->size()), double(kMaxPoints));
  std::vector<Eigen::Vector2d> result;
  result.reserve(value->size());
  for (std::size_t i = 0; i < value->size(); ++i) {
    const json& entry = (*value)[i];
    const bool good = entry.is_array() && entry.size() == 2 && entry[0].is_number() && entry[1].is_number();
    const Eigen::Vector2d p =
        good ? Eigen::Vector2d(entry[0].get<double>(), entry[1].get<double>()) : Eigen::Vector2d(NAN, NAN);
    if (!p.allFinite())
      return fail(ErrorCode::badInput,
                  path + "[" + std::to_string(i) + "] must be a point [x, y] of two finite numbers",
                  path + "[" + std::to_string(i) + "]");
    result.push_back(p);
  }
  return result;
}

Result<PlanarCurve> curveFromJson(const json& object, const std::string& path) {
  ObjectReader reader(object, path);
  int type = -1;
  reader.word("type", {"bezier", "bspline", "points"}, type);
  reader.need("type", path + " needs the key type: \"bezier\", \"bspline\" or \"points\"");
  const json *poles = nullptr, *points = nullptr, *knots = nullptr, *weights = nullptr;
  int degree = 3;
  if (type == 0) poles = reader.member("poles");
  if (type == 1) {
    poles = reader.member("poles");
    knots = reader.member("knots");
    weights = reader.member("weights");
    reader.integer("degree", degree, 1, 25);
    reader.need("degree", path + " needs the key degree");
  }
  if (type == 2) points = reader.member("points");
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  if (type == 2) {
    Result<std::vector<Eigen::Vector2d>> list = readPoints(points, path + ".points");
    return list ? PlanarCurve::points(std::move(*list)) : Result<PlanarCurve>(passOn(list.error()));
  }
  Result<std::vector<Eigen::Vector2d>> list = readPoints(poles, path + ".poles");
  if (!list) return passOn(list.error());
  if (type == 0) return PlanarCurve::bezier(std::move(*list));
  Result<std::vector<double>> knotList = readNumbers(knots, path + ".knots");
  if (!knotList) return passOn(knotList.error());
  std::vector<double> weightList;
  if (weights && !weights->is_null()) {
    Result<std::vector<double>> read = readNumbers(weights, path + ".weights");
    if (!read) return passOn(read.error());
    weightList = std::move(*read);
  }
  return PlanarCurve::bspline(degree, std::move(*knotList), std::move(*list), std::move(weightList));
}

Result<Eigen::Vector2d> readPoint(const json* value, const std::string& path) {
  const bool good =
      value && value->is_array() && value->size() == 2 && (*value)[0].is_number() && (*value)[1].is_number();
  const Eigen::Vector2d p = good ? Eigen::Vector2d((*value)[0].get<double>(), (*value)[1].get<double>())
                                 : Eigen::Vector2d(NAN, NAN);
  if (!p.allFinite())
    return fail(ErrorCode::badInput, path + " must be a point [x, y] of two finite numbers", path);
  return p;
}

ordered_json pointsToJson(const std::vector<Eigen::Vector2d>& points) {
  ordered_json list = ordered_json::array();
  for (const Eigen::Vector2d& p : points) list.push_back({p.x(), p.y()});
  return list;
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
  ordered_json output = many ? ordered_json{{"results", results}} : results[0];
  answer.json = output.dump(many ? -1 : 2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
  return answer;
}

}  // namespace bw::cases
