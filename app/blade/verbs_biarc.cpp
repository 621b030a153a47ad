// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "verbs.h"

namespace bw::cli {

namespace {

using nlohmann::json;

struct Options {
  std::string in = "-", out = "-", svg;
  int arcs = 0, kept = 0;
  double tolerance = 0;
  std::string select, distance;
  bool closed = false;
};

/// Where a case with its options stands: {"cases": [{"points": [[x, y], …]}]}, and a little more.
constexpr int kDeepest = 16;

/// The keys of the command line enter every case of the input and win over its own.
Result<std::string> withOptions(const std::string& text, const Options& options) {
  json keys = json::object();
  if (options.arcs > 0) keys["arcs"] = options.arcs;
  if (options.kept > 0) keys["points_kept"] = options.kept;
  if (options.tolerance > 0) keys["tolerance"] = options.tolerance;
  if (!options.select.empty()) keys["select"] = options.select;
  if (!options.distance.empty()) keys["distance"] = options.distance;
  if (options.closed) keys["closed"] = true;
  if (keys.empty()) return text;
  bool deep = false;
  const auto watch = [&deep](int depth, json::parse_event_t, json&) {
    deep = deep || depth > kDeepest;
    return !deep;
  };
  json input = json::parse(text, watch, false);
  if (deep || !input.is_object()) return text;  // the verb says what is wrong with it
  if (input.contains("cases") && input["cases"].is_array()) {
    for (json& object : input["cases"])
      if (object.is_object()) object.update(keys);
  } else {
    input.update(keys);
  }
  return input.dump();
}

/// One picture goes to the file of that name, several to NAME-0.svg, NAME-1.svg, …
Result<void> writePictures(const Session& session, const std::string& name,
                           const std::vector<std::string>& pictures) {
  const std::filesystem::path file = name;
  if (pictures.size() == 1)
    return pictures[0].empty() ? Result<void>() : session.writeOutput(name, pictures[0]);
  FileSet files;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    if (!pictures[i].empty())
      files.add(file.stem().string() + "-" + std::to_string(i) + file.extension().string(), pictures[i]);
  return session.writeFiles(files, file.has_parent_path() ? file.parent_path() : ".");
}

int biarcs(const Session& session, const Options& options) {
  Result<std::string> text = session.readInput(options.in);
  if (!text) return session.complain(text.error());
  if (isPointTable(options.in)) text = cases::biarcCaseFromCsv(*text);
  if (text) text = withOptions(*text, options);
  if (!text) return session.complain(text.error());
  std::vector<std::string> pictures;
  const Result<cases::CaseAnswer> result =
      cases::biarcCases(*text, session.context(), options.svg.empty() ? nullptr : &pictures);
  if (result && !options.svg.empty())
    if (Result<void> ok = writePictures(session, options.svg, pictures); !ok)
      return session.complain(ok.error());
  return tellAnswer(session, options.out, result);
}

}  // namespace

void addBiarcVerb(CLI::App& app, const Session& session, Work& work) {
  CLI::App* verb =
      app.add_subcommand("biarc", "Fit circular arcs to points (JSON cases, or points as .csv/.dat)");
  const auto options = std::make_shared<Options>();
  verb->add_option("--in", options->in, "Input file, - for standard input")->type_name("FILE");
  verb->add_option("--out", options->out, "Output file, - for standard output")->type_name("FILE");
  verb->add_option("--svg", options->svg, "Also draw data and arcs (several cases: FILE-0, FILE-1, …)")
      ->type_name("FILE");
  verb->add_option("--arcs", options->arcs, "Number of arcs, even")->check(CLI::Range(2, 1000000));
  verb->add_option("--points-kept", options->kept, "Number of points between the biarcs, ends included")
      ->check(CLI::Range(2, 1000000));
  verb->add_option("--tolerance", options->tolerance, "Largest distance in mm: the fewest arcs that keep it")
      ->check(CLI::PositiveNumber);
  verb->add_option("--select", options->select, "How the points are first chosen");
  verb->add_option("--distance", options->distance, "What is made small: mean, rms or max");
  verb->add_flag("--closed", options->closed, "The curve returns to its start");
  verb->footer(
      "Example:\n  echo '{\"points\": [[1,0],[0,2],[1,4],[2,6],[3,5],[4,4],[5.5,3]], \"points_kept\": "
      "[0,3,6]}' |\n    blade biarc --svg curve.svg");
  onChosen(*verb, session, work, options, biarcs);
}

}  // namespace bw::cli
