// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <memory>

#include "verbs.h"

namespace bw::cli {

namespace {

struct Options {
  std::string in = "-", out = "-";
};

using Cases = Result<cases::CaseAnswer> (*)(std::string_view, const RunContext&);

int answer(const Session& session, const Options& options, Cases cases, bool points) {
  Result<std::string> text = session.readInput(options.in);
  if (!text) return session.complain(text.error());
  if (points && isPointTable(options.in)) {
    text = cases::fitCaseFromCsv(*text);
    if (!text) return session.complain(text.error());
  }
  return tellAnswer(session, options.out, cases(*text, session.context()));
}

void addVerb(CLI::App& app, const Session& session, Work& work, const char* name, const char* text,
             const char* example, Cases cases, bool points) {
  CLI::App* verb = app.add_subcommand(name, text);
  const auto options = std::make_shared<Options>();
  verb->add_option("--in", options->in, "Input file, - for standard input")->type_name("FILE");
  verb->add_option("--out", options->out, "Output file, - for standard output")->type_name("FILE");
  verb->footer(std::string("Example:\n  ") + example);
  onChosen(*verb, session, work, options,
           [cases, points](const Session& s, const Options& o) { return answer(s, o, cases, points); });
}

}  // namespace

int tellAnswer(const Session& session, const std::string& out, const Result<cases::CaseAnswer>& answer) {
  if (!answer) return session.complain(answer.error());
  session.endProgress();
  if (Result<void> ok = session.writeOutput(out, answer->json); !ok) return session.complain(ok.error());
  if (answer->first) return session.complain(*answer->first);
  return answer->limited ? kLimitExceeded : kDone;
}

bool isPointTable(const std::string& file) {
  const std::string suffix = lowerSuffix(file);
  return suffix == ".csv" || suffix == ".dat";
}

void addNumericVerbs(CLI::App& app, const Session& session, Work& work) {
  addVerb(app, session, work, "elastica",
          "Evaluate elastica: points, angles, curvatures, energy, inflections",
          "echo '{\"elastica\": {\"start\": [0,0], \"start_angle\": 0.5, \"start_curvature\": -0.002,\n"
          "    \"force\": [0,0], \"length\": 800}, \"at\": [0, 400, 800]}' | blade elastica",
          cases::elasticaCases, false);
  addVerb(app, session, work, "fit", "Fit an elastica to a plane curve (JSON cases, or points as .csv/.dat)",
          "echo '{\"curve\": {\"type\": \"bezier\", \"poles\": [[0,0],[200,150],[400,150],[600,0]]}}' | "
          "blade fit",
          cases::fitCases, true);
  addVerb(
      app, session, work, "piecewise", "Approximate a plane curve by several elastica that meet smoothly",
      "echo '{\"curve\": {\"type\": \"bezier\", \"poles\": [[0,0],[150,260],[300,-310],[450,270],[600,0]]},\n"
      "    \"pieces\": 3, \"splits\": \"optimised\"}' | blade piecewise",
      cases::piecewiseCases, false);
  addBiarcVerb(app, session, work);
  addVerb(app, session, work, "spline",
          "A spline through points: a chain of elastica (as through ducks), of cubic Béziers, or cubic",
          "echo '{\"points\": [[0,0],[100,40],[220,30],[300,-20]], \"start_angle\": 0.6}' | blade spline",
          cases::splineCases, false);
  addVerb(app, session, work, "discrete",
          "A discrete elastica: the polyline of least bending between clamped ends",
          "echo '{\"start\": [0,0], \"end\": [600,0], \"start_angle\": 0.6, \"end_angle\": -0.4, \"length\": "
          "700,\n"
          "    \"segments\": 200}' | blade discrete",
          cases::discreteCases, false);
  addVerb(app, session, work, "relax",
          "The spline of least bending energy within a tolerance of a plane curve",
          "echo '{\"curve\": {\"type\": \"bezier\", \"poles\": [[0,0],[200,150],[400,150],[600,0]]}, "
          "\"tolerance\": 5}' | "
          "blade relax",
          cases::relaxCases, false);
  addVerb(app, session, work, "length", "The length of a blade from how it sags between its ends",
          "echo '{\"distance\": 600, \"height\": 120, \"angle\": 0.6}' | blade length", cases::lengthCases,
          false);
  addVerb(app, session, work, "bvp",
          "The shapes of a blade between two grips: points, length and tangent angles given (null: hinged)",
          "echo '{\"start\": [0,0], \"end\": [760,0], \"start_angle\": 0.4, \"end_angle\": -0.3,\n"
          "    \"length\": 800, \"all\": true}' | blade bvp",
          cases::bvpCases, false);
}

}  // namespace bw::cli
