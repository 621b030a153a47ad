// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/cases.h"

#include <chrono>
#include <cmath>

#include "bw/core/elastica.h"
#include "bw/core/elastica_fit.h"
#include "bw/core/number_text.h"
#include "elastica_json.h"
#include "json_reader.h"

namespace bw {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr double kHuge = 1e15;
constexpr std::size_t kMaxPoints = 1000000;

tl::unexpected<Error> passOn(const Error& error) { return tl::unexpected<Error>(error); }

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
  if (!reader.has("type"))
    reader.complain("type", path + " needs the key type: \"bezier\", \"bspline\" or \"points\"");
  const json *poles = nullptr, *points = nullptr, *knots = nullptr, *weights = nullptr;
  int degree = 3;
  if (type == 0) poles = reader.member("poles");
  if (type == 1) {
    poles = reader.member("poles");
    knots = reader.member("knots");
    weights = reader.member("weights");
    reader.integer("degree", degree, 1, 25);
    if (!reader.has("degree")) reader.complain("degree", path + " needs the key degree");
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

Result<ordered_json> elasticaCase(const json& object, bool&) {
  ObjectReader reader(object, "case");
  const json* shape = reader.member("elastica");
  const json* at = reader.member("at");
  if (!shape) reader.complain("elastica", "the case needs the key elastica");
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  const Result<Elastica> elastica = elasticaFromJson(*shape, "elastica");
  if (!elastica) return passOn(elastica.error());
  std::vector<double> arcs;
  if (at) {
    Result<std::vector<double>> read = readNumbers(at, "at");
    if (!read) return passOn(read.error());
    arcs = std::move(*read);
  }
  const auto start = std::chrono::steady_clock::now();
  std::vector<Elastica::State> states(arcs.size());
  elastica->at(arcs, states);
  const double energy = elastica->energy();
  const std::vector<double> inflections = elastica->inflections();
  const double largest = elastica->maxCurvature();
  const bool crosses = elastica->selfIntersects();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ordered_json result;
  result["elastica"] = elasticaToJson(*elastica);
  ordered_json points = ordered_json::array(), angles = ordered_json::array(),
               curvatures = ordered_json::array();
  for (const Elastica::State& state : states) {
    points.push_back({state.point.x(), state.point.y()});
    angles.push_back(state.angle);
    curvatures.push_back(state.curvature);
  }
  result["points"] = points;
  result["angles"] = angles;
  result["curvatures"] = curvatures;
  result["energy"] = energy;
  result["inflections"] = inflections;
  result["max_curvature"] = largest;
  result["self_intersects"] = crosses;
  result["seconds"] = seconds;
  return result;
}

Result<FitOptions> optionsFromJson(ObjectReader& reader) {
  FitOptions options;
  if (const json* length = reader.member("length")) {
    if (length->is_number()) {
      options.length = FitOptions::Length::given;
      reader.number("length", options.givenLength, 1e-12, kHuge);
    } else {
      int word = 0;
      reader.word("length", {"free", "exact"}, word);
      options.length = word == 1 ? FitOptions::Length::exact : FitOptions::Length::free;
    }
  }
  reader.boolean("endpoints", options.endpoints);
  reader.boolean("tangents", options.tangents);
  const auto optional = [&](const std::string& key, std::optional<double>& out, double min) {
    const json* value = reader.member(key);
    if (!value || value->is_null()) return;
    double x = 0;
    reader.number(key, x, min, kHuge);
    out = x;
  };
  optional("max_curvature", options.maxCurvature, 0);
  optional("max_periods", options.maxPeriods, 1e-6);
  int norm = 0, guess = 0;
  reader.word("norm", {"L2", "H1"}, norm);
  reader.word("guess", {"length", "count"}, guess);
  options.norm = FitOptions::Norm(norm);
  options.guess = FitOptions::Guess(guess);
  if (const json* initial = reader.member("initial"); initial && !initial->is_null()) {
    const Result<Elastica> shape = elasticaFromJson(*initial, "initial");
    if (!shape) return passOn(shape.error());
    options.initial = *shape;
  }
  return options;
}

Result<ordered_json> fitCase(const json& object, bool& limited) {
  ObjectReader reader(object, "case");
  const json* shape = reader.member("curve");
  if (!shape) reader.complain("curve", "the case needs the key curve");
  const Result<FitOptions> options = optionsFromJson(reader);
  if (!options) return passOn(options.error());
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  const Result<PlanarCurve> curve = curveFromJson(*shape, "curve");
  if (!curve) return passOn(curve.error());
  const Result<FitResult> fit = fitElastica(*curve, *options);
  if (!fit) return passOn(fit.error());
  if (fit->status == FitStatus::infeasible)
    return fail(ErrorCode::noSolution,
                fit->message.empty() ? "no elastica meets all the constraints" : fit->message, "constraints");
  limited = fit->status == FitStatus::iterationLimit;
  ordered_json result;
  result["elastica"] = elasticaToJson(fit->elastica);
  result["initial_elastica"] = elasticaToJson(fit->initial);
  result["R1"] = fit->R1;
  result["R2"] = fit->R2;
  result["R3"] = fit->R3;
  result["R3_star"] = fit->R3star;
  result["R4_initial"] = fit->R4initial;
  result["R4"] = fit->R4;
  result["hausdorff"] = fit->hausdorff;
  result["gradient_norm"] = fit->gradientNorm;
  result["iterations"] = fit->iterations;
  result["status"] = fitStatusName(fit->status);
  result["message"] = fit->message;
  result["seconds"] = fit->seconds;
  return result;
}

using CaseFunction = Result<ordered_json> (*)(const json&, bool&);

Result<CaseAnswer> runCases(std::string_view text, const RunContext& context, CaseFunction run) {
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
    Result<ordered_json> result = run(many ? (*input)["cases"][k] : *input, limit);
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

}  // namespace

Result<CaseAnswer> elasticaCases(std::string_view text, const RunContext& context) {
  return runCases(text, context, elasticaCase);
}

Result<CaseAnswer> fitCases(std::string_view text, const RunContext& context) {
  return runCases(text, context, fitCase);
}

Result<PlanarCurve> parseCurveJson(std::string_view text) {
  const Result<json> object = parseJsonText(text, "the curve");
  if (!object) return passOn(object.error());
  return curveFromJson(*object, "curve");
}

namespace {

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

}  // namespace

Result<PlanarCurve> parseCurveCsv(std::string_view text) {
  Result<std::vector<Eigen::Vector2d>> points = pointsFromCsv(text);
  if (!points) return passOn(points.error());
  return PlanarCurve::points(std::move(*points));
}

Result<std::string> fitCaseFromCsv(std::string_view text) {
  const Result<std::vector<Eigen::Vector2d>> points = pointsFromCsv(text);
  if (!points) return passOn(points.error());
  json list = json::array();
  for (const Eigen::Vector2d& p : *points) list.push_back({p.x(), p.y()});
  return json{{"curve", {{"type", "points"}, {"points", list}}}}.dump();
}

}  // namespace bw
