// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "bw/core/base/units.h"
#include "bw/core/design/design.h"
#include "bw/core/design/design_versions.h"
#include "bw/core/sweep/maps.h"
#include "bw/core/text/number_text.h"
#include "bw/core/text/printable.h"
#include "bw/geometry/export.h"
#include "bw/pipeline/drawn_design.h"
#include "bw/pipeline/example_design.h"
#include "bw/pipeline/overall.h"
#include "bw/pipeline/run_identity.h"
#include "bw/pipeline/scene_content.h"
#include "file_watch.h"
#include "sets.h"
#include "verbs.h"

namespace bw::cli {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

/// What `render --field` takes: the maps, and none of them.
std::vector<std::string> fieldNames() {
  std::vector<std::string> names;
  for (const MapInfo& map : cutMaps()) names.push_back(map.name);
  names.push_back("none");
  return names;
}

/// The same in words, with `last` before the last.
std::string fieldWords(const std::string& last) {
  const std::vector<std::string> names = fieldNames();
  std::string words = names.front();
  for (std::size_t i = 1; i < names.size(); ++i) words += (i + 1 == names.size() ? last : ", ") + names[i];
  return words;
}

/// True if a file's name says that it holds something else than one of `suffixes`. A name without a suffix
/// says nothing, and a device or pipe takes what it gets.
bool saysOtherwise(const fs::path& file, std::initializer_list<std::string_view> suffixes) {
  std::error_code error;
  const std::string suffix = lowerSuffix(file);
  return !suffix.empty() && !(fs::exists(file, error) && !fs::is_regular_file(file, error)) &&
         std::find(suffixes.begin(), suffixes.end(), suffix) == suffixes.end();
}

/// A blade that bends this little is straight, mm.
std::string radiusText(double radius) {
  constexpr double kStraight = 1e7;
  return radius > 0 && radius < kStraight ? shortText(radius) + " mm" : "none, the blade is straight";
}

void tellSummary(const pipeline::Evaluation& e) {
  const pipeline::Overall all = pipeline::overallOf(e);
  const SweepSummary& s = all.summary;
  const std::string uncut =
      e.uncut.empty() ? "" : " and " + std::to_string(e.uncut.size()) + " that cannot be cut";
  std::cerr << (e.blocks.size() > 1 || !uncut.empty() ? counted(e.blocks.size(), "block") + uncut + ", " : "")
            << all.stations << " stations; deviation max " << shortText(s.deviationMax)
            << " mm (between stations " << (all.programMax ? shortText(*all.programMax) + " mm" : "not known")
            << "), mean " << shortText(s.deviationMean) << " mm, " << shareText(s.withinTolerance)
            << (all.programMax > e.design.process.tolerance
                    ? " of the surface shown within tolerance (the blade between its stations is not), "
                    : " within tolerance, ")
            << shareText(all.covered) << " of the surface " << (all.outside > 0 ? "in the block " : "")
            << "covered (farthest beyond the cut " << shortText(all.uncovered) << " mm"
            << (all.outside > 0 ? "; " + shortText(100 * all.outside, 3) + " % of it lies outside" : "")
            << ")"
            << (all.lost > 0
                    ? ", did the blade keep its shape, which it does not at " + counted(all.lost, "station")
                    : "")
            << "; ";
  if (all.fromShown)
    std::cerr << (e.blocks.size() > 1 || e.blocks.front().cuts.size() > 1 ? "the programs cut within "
                                                                          : "the program cuts within ")
              << shortText(*all.fromShown) << " mm of this surface; ";
  else
    std::cerr << "how near to this surface the program cuts is not known; ";
  if (e.joints.value && !e.joints.value->joints.empty())
    std::cerr << "joints: gap max " << shortText(e.joints.value->gapMax()) << " mm, kink max "
              << fixedText(toDegrees(e.joints.value->kinkMax()), 2) << "°; ";
  std::cerr << "angle max " << fixedText(toDegrees(s.angleMax), 1) << "°; smallest radius "
            << radiusText(s.minRadius) << "; cutting time " << fixedText(all.cuttingTime, 0) << " s ("
            << fixedText(all.runTime, 0) << " s with entry and exit); computed in "
            << fixedText(e.seconds.total, 2) << " s\n";
}

/// Of the verbs that write results.
struct ResultOptions {
  std::string file, job, out;
  bool despiteErrors = false;
  std::string version;            ///< of the design
  std::vector<std::string> sets;  ///< name=value
  bool watch = false, handover = false;
};

/// Writes the results of a design. Those of `before`, if it is not null, are used again as far as they hold;
/// it becomes this one.
int writeResults(const Session& session, const Design& design, const ResultOptions& options, int threads = 0,
                 pipeline::Evaluation* before = nullptr) {
  if (const Result<void> ok = session.mayWriteInto(options.out); !ok) return session.complain(ok.error());
  RunContext context = session.context();
  if (context.threads == 0) context.threads = threads;
  pipeline::Policy policy{.despiteErrors = options.despiteErrors};
  if (options.handover)
    policy = pipeline::withHandover(
        std::move(policy),
        [context](const pipeline::Evaluation& e) { return pipeline::reportPictures(e, context); }, context);
  pipeline::Product product = pipeline::produce(design, options.out, policy, context, before);
  session.tell(product.findings());
  if (product.error) return session.complain(*product.error);
  const fs::path source = design.source().bytes.empty() ? design.source().path : fs::path();
  if (Result<void> ok = session.writeFiles(product.files, options.out, source, product.seen); !ok)
    return session.complain(ok.error());
  tellSummary(product.evaluation);
  const int status = product.status();
  if (before) *before = std::move(product.evaluation);
  return status;
}

int runRationalize(const Session& session, const ResultOptions& options) {
  const Result<std::string> text =
      options.job.empty() ? Result<std::string>("{}") : session.readInput(options.job);
  if (!text) return session.complain(text.error());
  int threads = 0;
  Result<Design> design = parseJob(*text, &threads);
  if (!design) return session.complain(design.error());
  design->name = fs::path(options.file).stem().string();
  design->source().path = options.file;
  return writeResults(session, *design, options, threads);
}

/// What the design of a file loses where the one beside its results takes its place, in words; empty for
/// nothing.
std::string lostBeside(const Design& design, const ResultOptions& options) {
  const std::string lost = pipeline::lostInResults(design);
  if (lost.empty() && (!options.sets.empty() || !options.version.empty()))
    return "would be replaced by the design that it is changed to here";
  return lost;
}

/// The design whose results are asked for. Errors besides: its file would be replaced by the one beside the
/// results, which is not the same.
Result<Design> askedFor(const Session& session, const ResultOptions& options) {
  Result<Design> design = session.openDesign(options.file);
  if (!design) return design;
  if (pipeline::sameFile(fs::path(options.out) / kDesignFile, options.file))
    if (const std::string lost = lostBeside(*design, options); !lost.empty())
      return fail(ErrorCode::badInput, options.file + " " + lost + "; give --out another folder", "out");
  if (!options.version.empty()) design = atVersion(*design, options.version);
  if (!design) return design;
  Result<pipeline::FollowedDesign> followed = pipeline::followDrawing(*design, session.context());
  if (!followed) return tl::unexpected<Error>(followed.error());
  session.endProgress();
  if (!followed->told.empty())
    std::cerr << severityName(followed->severity) << ": " << printable(followed->told) << "\n";
  return withSets(followed->design, options.sets);
}

/// Writes the results, and again whenever the design, or a CAD file or drawing that it links, was saved,
/// until it is stopped. What cannot be read or made is told, and the next change is waited for.
int watchDesign(const Session& session, const ResultOptions& options) {
  if (pipeline::sameFile(fs::path(options.out) / kDesignFile, options.file))
    return session.complain({ErrorCode::badInput,
                             options.file + " is written anew with the results, which would never end; give "
                                            "--out another folder",
                             "out"});
  pipeline::Evaluation before;
  while (!session.stop.stop_requested()) {
    FileWatch watch;
    watch.add(options.file);
    // Before they are read.
    Result<Design> linking = loadDesign(options.file);
    if (linking && !options.version.empty()) linking = atVersion(*linking, options.version);
    if (linking)
      for (const Source& source : linking->sources) {
        if (source.bytes.empty() && !source.path.empty()) watch.add(source.path);
        if (source.drawing) watch.add(source.drawing->path);
      }
    const Result<Design> design = askedFor(session, options);
    if (design) {
      writeResults(session, *design, options, 0, &before);
    } else {
      session.complain(design.error());
    }
    if (session.stop.stop_requested()) break;
    std::cerr << "watching " << printable(watch.names()) << "; Ctrl-C ends it\n";
    if (watch.awaitChange(session.stop)) std::cerr << "\nchanged; once more\n";
  }
  return kInterrupted;
}

int runDesign(const Session& session, const ResultOptions& options) {
  if (options.watch) return watchDesign(session, options);
  const Result<Design> design = askedFor(session, options);
  return design ? writeResults(session, *design, options) : session.complain(design.error());
}

struct RenderOptions {
  std::string path, out, field = "deviation", view = "iso", size = "1600x1000";
  bool dark = false, isolines = false;
};

int runRender(const Session& session, const RenderOptions& options) {
  const std::optional<scene::View> view = scene::viewFromName(options.view);
  if (!view)
    return session.complain({ErrorCode::badInput,
                             "there is no view \"" + options.view +
                                 "\"; the views are iso, top, bottom, front, back, left, right",
                             "view"});
  int width = 0, height = 0;
  char rest = 0;
  if (std::sscanf(options.size.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 64 ||
      height < 64 || width > 8192 || height > 8192)
    return session.complain(
        {ErrorCode::badInput,
         "--size must be WIDTHxHEIGHT with 64 to 8192 pixels each, not \"" + options.size + "\"", "size"});
  const std::vector<std::string> fields = fieldNames();
  std::string field = options.field;
  if (std::find(fields.begin(), fields.end(), field) == fields.end()) {
    const std::string nearest = nearestWord(field, fields.data(), int(fields.size()));
    return session.complain({ErrorCode::badInput,
                             "there is no field \"" + field + "\"" +
                                 (nearest.empty() ? "; the fields are " + fieldWords(" and ")
                                                  : "; did you mean \"" + nearest + "\"?"),
                             "field"});
  }
  if (saysOtherwise(options.out, {".png"}))
    return session.complain({ErrorCode::badInput,
                             "pictures are PNG; give --out a name that ends in .png, not " + options.out,
                             "out"});
  const Result<Design> design = session.designOf(options.path);
  if (!design) return session.complain(design.error());
  const pipeline::Policy policy{.contents = pipeline::Policy::Contents::evaluation,
                                .lengths = pipeline::foundLengths(options.path)};
  pipeline::Product product = pipeline::produce(*design, {}, policy, session.context());
  session.tell(product.evaluation.sourceFindings);
  if (product.error) return session.complain(*product.error);
  if (const Result<void> ok = pipeline::addParts(product.evaluation, session.context()); !ok)
    return session.complain(ok.error());
  if (const MapInfo* map = cutMap(field); map && !map->ofCut && !pipeline::hasCreases(product.evaluation))
    return session.complain(
        {ErrorCode::badInput,
         "there is no crease to be coloured: no two cuts of a block meet; take another field", "field"});
  scene::Scene scene;
  scene.setContent(pipeline::sceneContent(product.evaluation));
  scene::Style style;
  style[scene::Kind::cut].map = field;
  style.dark = options.dark;
  style.isolines = options.isolines;
  style.tolerance = design->process.tolerance;
  style.marker = pipeline::uncoveredMark(product.evaluation);
  style.playhead = 0.5 * double(product.evaluation.cut().sweep.value->poses.size() - 1);
  scene.setStyle(style);
  scene.setCamera(scene.fitFrom(scene::directionOf(*view), *view != scene::View::iso, {width, height}));
  const Result<scene::Picture> picture = scene.render(width, height);
  if (!picture) return session.complain(picture.error());
  const Result<std::string> png = scene::pngBytes(*picture);
  if (!png) return session.complain(png.error());
  session.endProgress();
  const Result<void> ok = session.writeOutput(options.out, *png);
  return ok ? int(kDone) : session.complain(ok.error());
}

struct ExampleOptions {
  std::string name, out = "-";
};

int runExample(const Session& session, const ExampleOptions& options) {
  const auto& [name, out] = options;
  if (name.empty()) {
    for (const auto* list : {&geometry::exampleList(), &pipeline::designedExamples()})
      for (const geometry::Example& example : *list)
        std::cout << example.name << "\n  " << example.title << "\n  " << example.formula << "\n";
    return kDone;
  }
  if (saysOtherwise(out, {kDesignSuffix, ".step", ".stp"}))
    return session.complain(
        {ErrorCode::badInput,
         "examples are written as STEP or as designs; give --out a name that ends in .step, .stp "
         "or .bladewright, not " +
             out,
         "out"});
  Result<std::string> bytes;
  if (lowerSuffix(out) == kDesignSuffix) {
    const Result<Design> design = pipeline::exampleDesign(name);
    if (!design) return session.complain(design.error());
    bytes = designToJson(*design);
  } else {
    bytes = pipeline::exampleSurface(name);
    if (!bytes) return session.complain(bytes.error());
  }
  const Result<void> ok = session.writeOutput(out, *bytes);
  return ok ? int(kDone) : session.complain(ok.error());
}

/// `handover` tells what holds where neither is given.
void addHandover(CLI::App& verb, bool& handover) {
  const std::string usual = handover ? "; written unless --no-handover is given" : "";
  verb.add_flag(
      "--handover,!--no-handover", handover,
      "What is understood without this program: report.html, report.pdf, pictures, IGES, STL" + usual);
}

}  // namespace

void addSurfaceVerbs(CLI::App& app, const Session& session, Work& work) {
  {
    CLI::App* verb =
        app.add_subcommand("rationalize", "From a CAD surface to a blade sweep, its report and its programs");
    const auto options = std::make_shared<ResultOptions>();
    verb->add_option("FILE", options->file, "STEP, IGES or BREP file")->required();
    verb->add_option("--job", options->job, "Job file (JSON); every key is optional, - for standard input")
        ->type_name("JOB.json");
    verb->add_option("--out", options->out, "Folder for the results")->type_name("DIR")->required();
    addHandover(*verb, options->handover);
    addDespiteErrors(*verb, options->despiteErrors);
    verb->footer("Example:\n  blade rationalize panel.step --job job.json --out out/panel");
    onChosen(*verb, session, work, options, runRationalize);
  }
  {
    CLI::App* verb = app.add_subcommand("design", "Evaluate a saved design and write its results");
    const auto options = std::make_shared<ResultOptions>();
    verb->add_option("DESIGN", options->file, "A .bladewright file")->required();
    verb->add_option("--out", options->out, "Folder for the results")->type_name("DIR")->required();
    verb->add_option("--version", options->version,
                     "A named version of the design in place of its present state")
        ->type_name("NAME");
    verb->add_option("--set", options->sets, "Give a variable of the design another value; repeatable")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    options->handover = true;
    addHandover(*verb, options->handover);
    verb->add_flag(
        "--watch", options->watch,
        "Write the results again whenever the design, or a CAD file or drawing that it links, is saved");
    addDespiteErrors(*verb, options->despiteErrors);
    verb->footer(
        "Example:\n  blade design panel.bladewright --out out/panel\n"
        "  blade design panel.bladewright --out out/panel --watch\n"
        "  blade design ripple.bladewright --out out/ripple --set amplitude=25 --set waves=1.5");
    onChosen(*verb, session, work, options, runDesign);
  }
  {
    CLI::App* verb = app.add_subcommand("render", "A picture of a result or a design, without a display");
    const auto options = std::make_shared<RenderOptions>();
    verb->add_option("PATH", options->path, "Folder of results, or a .bladewright file")->required();
    verb->add_option("--field", options->field, fieldWords(" or "))->type_name("NAME");
    verb->add_option("--view", options->view, "iso, top, bottom, front, back, left or right")
        ->type_name("NAME");
    verb->add_option("--size", options->size, "Size in pixels")->type_name("WxH");
    verb->add_flag("--dark", options->dark, "Dark theme");
    verb->add_flag("--isolines", options->isolines, "Lines at the legend's ticks");
    verb->add_option("--out", options->out, "PNG file")->type_name("PNG")->required();
    verb->footer(
        "Example:\n  blade render out/panel --field deviation --view iso --size 1600x1000 --out panel.png");
    onChosen(*verb, session, work, options, runRender);
  }
  {
    CLI::App* verb =
        app.add_subcommand("example", "Write an example surface as STEP or as a design, or list them");
    const auto options = std::make_shared<ExampleOptions>();
    verb->add_option("NAME", options->name, "Name of the example; without it they are listed");
    verb->add_option(
            "--out", options->out,
            "STEP file, - for standard output; a name that ends in .bladewright gives a design with a "
            "blade and a block that suit the example")
        ->type_name("FILE");
    verb->footer(
        "Example:\n  blade example panel-600x670 --out panel.step\n"
        "  blade example wavy-wall --out wall.bladewright\n"
        "  blade example ripple-along --out ripple.bladewright");
    onChosen(*verb, session, work, options, runExample);
  }
}

}  // namespace bw::cli
