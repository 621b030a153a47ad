// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A design from the curves of a CAD file.

#include <algorithm>
#include <iostream>
#include <iterator>

#include "bw/core/text/number_text.h"
#include "bw/core/text/printable.h"
#include "bw/pipeline/drawn_design.h"
#include "verbs.h"

namespace bw::cli {

namespace {

struct SectionsOptions {
  std::string file, out, kind = kSectionKinds[int(SectionCurve::Kind::spline)], unit, curves;
  std::vector<std::string> layers;
  double tolerance = DrawnOptions::kTolerance;  ///< mm
  int points = 0;
  bool link = false;
};

/// The place of a word among some; an error names the nearest.
Result<int> placeOf(const std::string& word, const std::vector<std::string>& words, const std::string& what) {
  const auto found = std::ranges::find(words, word);
  if (found != words.end()) return int(found - words.begin());
  const std::string nearest = nearestWord(word, words.data(), int(words.size()));
  std::string all;
  for (std::size_t i = 0; i < words.size(); ++i)
    all += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return fail(ErrorCode::badInput,
              "there is no " + what + " \"" + word + "\"; " +
                  (nearest.empty() ? "there are " + all : "did you mean \"" + nearest + "\"?"),
              what);
}

/// "; its layers are holes (1 curve) and roof (3 curves), of which --layer takes some"; empty for one.
std::string layersText(const std::vector<pipeline::DrawnLayer>& layers) {
  constexpr std::size_t kSome = 10;
  if (layers.size() < 2) return {};
  std::string text = "; its layers are ";
  for (std::size_t i = 0; i < std::min(layers.size(), kSome); ++i) {
    const bool last = i + 1 == layers.size();
    text += (i == 0 ? ""
             : last ? " and "
                    : ", ") +
            layers[i].name + " (" + std::to_string(layers[i].curves) +
            (layers[i].curves == 1 ? " curve)" : " curves)");
  }
  if (layers.size() > kSome) text += " and " + std::to_string(layers.size() - kSome) + " more";
  return text + ", of which --layer takes some";
}

/// A design follows its drawing as the window has it made, so that one is refused that was made otherwise.
Result<void> mayLink(const SectionsOptions& options) {
  const SectionsOptions usual;
  const char* other = options.file == "-"                    ? "standard input"
                      : !options.unit.empty()                ? "--unit"
                      : !options.curves.empty()              ? "--curves"
                      : options.layers.size() > 1            ? "several --layer"
                      : options.points != usual.points       ? "--points"
                      : options.kind != usual.kind           ? "--kind"
                      : options.tolerance != usual.tolerance ? "--tolerance"
                                                             : nullptr;
  if (!options.link || !other) return {};
  return fail(
      ErrorCode::badInput,
      std::string("a design that follows its file (--link) is made of all curves or of one layer, as ") +
          "the file states them; leave out " + other + ", or --link",
      "link");
}

int runSections(const Session& session, const SectionsOptions& options) {
  if (Result<void> ok = mayLink(options); !ok) return session.complain(ok.error());
  if (Result<void> ok = session.mayWriteDesign(options.out); !ok) return session.complain(ok.error());
  pipeline::DrawnRequest request;
  const Result<int> kind =
      placeOf(options.kind, {std::begin(kSectionKinds), std::end(kSectionKinds)}, "kind");
  if (!kind) return session.complain(kind.error());
  request.sections = {SectionCurve::Kind(*kind), options.tolerance, options.points};
  if (!options.unit.empty()) {
    std::vector<std::string> units;
    for (const LengthUnit unit : kLengthUnits) units.emplace_back(lengthUnitName(unit));
    const Result<int> unit = placeOf(options.unit, units, "unit");
    if (!unit) return session.complain(unit.error());
    request.unit = kLengthUnits[std::size_t(*unit)];
  }
  request.numbers = options.curves;
  request.names = options.layers;
  const Result<std::string> bytes = session.readInput(options.file);
  if (!bytes) return session.complain(bytes.error());
  const Result<pipeline::DrawnCurves> curves =
      pipeline::drawnCurves(*bytes, options.file, request.unit, session.context());
  if (!curves) return session.complain(curves.error());
  Result<pipeline::DrawnDesign> drawn =
      pipeline::designThrough(*curves, options.file, request, session.context());
  if (!drawn) {
    if (request.names.empty() && curves->format == "DXF" && drawn.error().code != ErrorCode::cancelled)
      drawn.error().message += layersText(pipeline::layersOf(*curves));
    return session.complain(drawn.error());
  }
  session.endProgress();
  for (const std::string& line : drawn->leftOut) std::cerr << "left out: " << printable(line) << "\n";
  if (request.unit ? lengthUnitName(*request.unit) != drawn->unit
                   : drawn->unit.find(' ') != std::string::npos)
    std::cerr << "lengths are taken in " << (request.unit ? lengthUnitName(*request.unit) : "mm")
              << (request.unit ? ", the file states " + printable(drawn->unit)
                               : std::string(", the file states no unit; --unit gives another"))
              << "\n";
  const double deviation = drawn->sections.deviation;
  if (options.link) {
    const std::optional<std::string> layer =
        options.layers.empty() ? std::nullopt : std::optional(options.layers.front());
    drawn->design.source().drawing = pipeline::linkTo(options.file, fingerprintOf(*bytes), layer, *drawn);
  }
  std::cerr << printable(pipeline::drawnText(*drawn, options.file)) << "\n";
  if (const Result<void> ok = session.writeDesign(std::move(drawn->design), options.out); !ok)
    return session.complain(ok.error());
  return deviation <= options.tolerance ? kDone : kLimitExceeded;
}

}  // namespace

void addSectionsVerb(CLI::App& app, const Session& session, Work& work) {
  CLI::App* verb = app.add_subcommand(
      "sections", "A design with a loft through the curves of a CAD file: STEP, IGES or DXF");
  const auto options = std::make_shared<SectionsOptions>();
  verb->add_option("FILE", options->file, "STEP, IGES, BREP or DXF file; - for standard input")->required();
  verb->add_option("--out", options->out, "The design that is written")->type_name("DESIGN")->required();
  verb->add_option("--points", options->points,
                   "Points of each section (as few as keep the tolerance); the status is 1 if they do not")
      ->check(CLI::Range(2, SectionCurve::kMost))
      ->type_name("N");
  verb->add_option("--tolerance", options->tolerance,
                   "mm between each curve and its section, and between ends that are joined (0.1)")
      ->check(CLI::Range(DrawnOptions::kLeast, DrawnOptions::kMost))
      ->type_name("MM");
  verb->add_option("--kind", options->kind, "How sections run: spline, bezier or ducks")->type_name("KIND");
  verb->add_option("--unit", options->unit, "Take the numbers of the file as mm, cm, m or in")
      ->type_name("UNIT");
  verb->add_option("--curves", options->curves, "Only these, by number: 1,3-5")->type_name("LIST");
  verb->add_option("--layer", options->layers, "Only curves of that layer or name; repeatable")
      ->type_name("NAME")
      ->allow_extra_args(false);
  verb->add_flag("--link", options->link,
                 "The design follows the file: blade design --watch and the window take over its changes");
  verb->footer(
      "Example:\n  blade sections profiles.dxf --layer profiles --out roof.bladewright\n"
      "  blade sections profiles.step --tolerance 0.05 --kind bezier --out roof.bladewright");
  onChosen(*verb, session, work, options, runSections);
}

}  // namespace bw::cli
