// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/biarc/biarc.h"

#include <algorithm>
#include <cmath>

#include "case_runner.h"

namespace bw::cases {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr double kHuge = 1e15;
constexpr int kMost = 1000000;
/// Chains of points are longer than anything that the other verbs take.
constexpr std::int64_t kWork = 5 * kCaseWork / 2;

/// Words in the order of the enumerations.
const std::vector<std::string> kSelections = {"auto", "spacing", "index", "coordinates", "curvature", "tube"};
const std::vector<std::string> kGoals = {"nothing", "distance", "curvature", "combined"};

void readIndices(ObjectReader& reader, const std::string& key, const json& list, BiarcOptions& options) {
  for (const json& entry : list) {
    if (!entry.is_number_integer() || std::abs(entry.get<double>()) > kMost) {
      reader.complain(key, key + " must be a list of whole numbers, counted from 0");
      return;
    }
    options.indices.push_back(entry.get<int>());
  }
  if (list.empty()) reader.complain(key, key + " must name at least two points");
}

void readVary(ObjectReader& reader, BiarcOptions& options) {
  const json* vary = reader.member("vary");
  if (!vary) return;
  options.movePoints = options.turnTangents = options.moveJoints = false;
  const char* text = "vary must be a list of \"points\", \"tangents\" and \"joints\"";
  if (!vary->is_array()) return reader.complain("vary", text);
  for (const json& word : *vary) {
    if (word == "points")
      options.movePoints = true;
    else if (word == "tangents")
      options.turnTangents = true;
    else if (word == "joints")
      options.moveJoints = true;
    else
      return reader.complain("vary", text);
  }
}

/// The keys that say which points are chosen, and how many.
void readChoice(ObjectReader& reader, BiarcOptions& options) {
  int select = 0, arcs = 0;
  const bool named = reader.has("select");
  reader.word("select", kSelections, select);
  options.select = BiarcSelect(select);
  reader.integer("arcs", arcs, 2, 2 * kMost);
  if (arcs % 2 != 0) reader.complain("arcs", "arcs must be even: each biarc has two", double(arcs));
  if (arcs > 0) options.points = options.closed ? arcs / 2 : arcs / 2 + 1;
  if (options.closed && arcs == 2) reader.complain("arcs", "a closed curve needs at least 4 arcs", 2, 4);
  const json* kept = reader.member("points_kept");
  const json* indices = reader.member("indices");
  if (kept && kept->is_array())
    readIndices(reader, "points_kept", *kept, options);
  else
    reader.integer("points_kept", options.points, 2, kMost);
  if (indices) {
    if (indices->is_array())
      readIndices(reader, "indices", *indices, options);
    else
      reader.complain("indices", "indices must be a list of whole numbers, counted from 0");
  }
  reader.number("tube", options.tube, 0, kHuge);
  const bool coordinates = reader.has("coordinates"), tube = reader.has("tube");
  const int ways = (!options.indices.empty() ? 1 : 0) + (coordinates ? 1 : 0) + (tube ? 1 : 0) +
                   (reader.has("points_kept") && kept && !kept->is_array() ? 1 : 0) + (arcs > 0 ? 1 : 0);
  if (ways > 1)
    reader.complain("case",
                    "give only one of arcs, points_kept, indices, coordinates and tube: each says how many "
                    "points the curve has");
  const auto needs = [&](bool given, BiarcSelect way, const char* key) {
    if (!given) return;
    if (named && options.select != way)
      reader.complain("select", std::string("select must be \"") + kSelections[std::size_t(way)] +
                                    "\" where " + key + " is given");
    options.select = way;
  };
  needs(!options.indices.empty(), BiarcSelect::index, "a list of indices");
  needs(coordinates, BiarcSelect::coordinates, "coordinates");
  needs(tube, BiarcSelect::tube, "tube");
  if (options.select == BiarcSelect::coordinates)
    reader.need("coordinates", "select \"coordinates\" needs the key coordinates: a list of points");
}

BiarcOptions optionsFromJson(ObjectReader& reader) {
  BiarcOptions options;
  reader.boolean("closed", options.closed);
  readChoice(reader, options);
  if (const json* list = reader.member("coordinates"))
    reader.take(readPoints(list, "coordinates"), options.coordinates);
  if (const json* list = reader.given("tangents"))
    reader.take(readNumbers(list, "tangents"), options.tangents);
  int distance = 1, curvature = 0, ends = 0;
  reader.word("distance", {"mean", "rms", "max"}, distance);
  reader.word("curvature", {"energy", "angle"}, curvature);
  reader.word("ends", {"free", "kept"}, ends);
  options.distance = BiarcDistance(distance);
  options.curvature = BiarcCurvature(curvature);
  options.keepEnds = ends == 1;
  reader.number("weight", options.weight, 0, 1);
  int goal = reader.has("weight") ? int(BiarcGoal::combined) : int(BiarcGoal::distance);
  reader.word("minimise", kGoals, goal);
  options.goal = BiarcGoal(goal);
  if (reader.has("weight") && options.goal != BiarcGoal::combined)
    reader.complain("weight", "weight serves minimise \"combined\" only");
  if (options.goal == BiarcGoal::combined)
    reader.need("weight", "minimise \"combined\" needs the key weight, from 0 (distance) to 1 (curvature)");
  if (options.goal == BiarcGoal::curvature) options.movePoints = false;
  readVary(reader, options);
  if (options.goal == BiarcGoal::curvature && options.movePoints)
    reader.complain(
        "vary", "points cannot vary while curvature alone is minimised: the curve would shrink to a line");
  reader.integer("max_iterations", options.maxIterations, 1, kMost);
  reader.integer("max_arcs", options.maxArcs, 2, 2 * kMost);
  reader.number("tolerance", options.tolerance, 1e-12, kHuge);
  if (!options.tolerance && options.points == 0 && options.indices.empty() &&
      options.select != BiarcSelect::coordinates && !reader.has("tube"))
    reader.complain(
        "case", "the case needs one of the keys arcs, points_kept, tolerance, indices, coordinates and tube");
  return options;
}

ordered_json arcToJson(const CircularArc& arc) {
  ordered_json object;
  object["start"] = arc.start;
  object["radius"] = arc.radius();
  object["angle"] = arc.turning;
  object["length"] = arc.length;
  object["start_angle"] = arc.startAngle;
  object["middle"] = arc.pointAt(arc.length / 2);
  object["end"] = arc.end();
  return object;
}

void addMeasures(ordered_json& object, const BiarcMeasures& m) {
  object["distance"] = {
      {"mean", m.mean}, {"rms", m.rms}, {"max", m.max}, {"farthest", m.farthest}, {"away", m.away}};
  object["curvature"] = {{"energy", m.energy}, {"angle", m.angle}, {"largest_jump", m.largestJump}};
  object["length"] = m.length;
  object["turning"] = m.turning;
}

Result<ordered_json> biarcCase(const json& object, bool& limited, const RunContext& context, bool picture) {
  ObjectReader reader(object, "case");
  const json* list = reader.member("points");
  reader.need("points", "the case needs the key points");
  bool svg = false;
  reader.boolean("svg", svg);
  const BiarcOptions options = optionsFromJson(reader);
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  const Result<std::vector<Eigen::Vector2d>> points = readPoints(list, "points");
  if (!points) return passOn(points.error());
  const Result<BiarcResult> fit = fitBiarcs(*points, options, context);
  if (!fit) return passOn(fit.error());
  limited = fit->status == BiarcStatus::toleranceExceeded || fit->status == BiarcStatus::iterationLimit;
  ordered_json result;
  result["arcs"] = ordered_json::array();
  for (const CircularArc& arc : fit->curve.arcs) result["arcs"].push_back(arcToJson(arc));
  result["closed"] = fit->curve.closed;
  result["points"] = fit->curve.points;
  result["tangents"] = fit->curve.tangents;
  result["shares"] = fit->curve.shares;
  addMeasures(result, fit->measures);
  ordered_json initial;
  addMeasures(initial, fit->initial);
  result["initial"] = std::move(initial);
  result["objective"] = fit->objective;
  result["iterations"] = fit->iterations;
  result["status"] = biarcStatusName(fit->status);
  result["message"] = fit->message;
  if (svg || picture) result["svg"] = biarcSvg(fit->curve, *points);
  result["seconds"] = fit->seconds;
  return result;
}

}  // namespace

Result<CaseAnswer> biarcCases(std::string_view text, const RunContext& context,
                              std::vector<std::string>* pictures) {
  RunContext one = context;
  one.progress = {};
  Result<CaseAnswer> answer = runCases(
      text, context,
      [&](const json& object, bool& limited) { return biarcCase(object, limited, one, pictures != nullptr); },
      kWork);
  if (!answer || !pictures) return answer;
  // The pictures leave the answer, unless the case itself asked for them.
  ordered_json output = ordered_json::parse(answer->json);
  const json input = json::parse(text);
  const bool many = output.contains("results");
  pictures->clear();
  for (std::size_t i = 0; i < (many ? output["results"].size() : 1); ++i) {
    ordered_json& result = many ? output["results"][i] : output;
    const json& object = many ? input["cases"][i] : input;
    pictures->push_back(result.contains("svg") ? result["svg"].get<std::string>() : "");
    if (result.contains("svg") && !object.value("svg", false)) result.erase("svg");
  }
  answer->json = dumped(output, many);
  return answer;
}

Result<std::string> biarcCaseFromCsv(std::string_view text) {
  const Result<std::vector<Eigen::Vector2d>> points = pointsFromCsv(text);
  if (!points) return passOn(points.error());
  return json{{"points", *points}}.dump();
}

}  // namespace bw::cases
