// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <functional>
#include <future>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "bw/core/design/design.h"
#include "bw/core/design/program_formats.h"
#include "bw/core/files/temporary_name.h"
#include "bw/core/text/number_text.h"
#include "bw/core/text/printable.h"
#include "bw/pipeline/run_identity.h"
#include "bw/pipeline/scene_content.h"
#include "bw/pipeline/simulate.h"
#include "bw/robotio/dialects.h"
#include "verbs.h"

namespace bw::cli {

namespace {

struct ExportOptions {
  std::string path, cell, out;
  std::vector<std::string> formats = {"rapid"};
  bool despiteErrors = false;
};

int runExport(const Session& session, const ExportOptions& options) {
  Result<Design> design = session.designOf(options.path);
  if (!design) return session.complain(design.error());
  if (const Result<void> ok = session.mayWriteInto(options.out); !ok) return session.complain(ok.error());
  // What is exported is what the findings are about.
  if (!options.cell.empty()) design->output.cell = options.cell;
  design->output.programs = options.formats;
  pipeline::Policy policy;
  policy.contents = pipeline::Policy::Contents::programs;
  policy.despiteErrors = options.despiteErrors;
  policy.programFolder = "strip-0";
  policy.lengths = pipeline::foundLengths(options.path);
  const pipeline::Product product = pipeline::produce(*design, options.out, policy, session.context());
  session.tell(product.findings());
  if (product.error) return session.complain(*product.error);
  if (!product.files.paths().empty())
    if (Result<void> ok = session.writeFiles(product.files, options.out, {}, product.seen); !ok)
      return session.complain(ok.error());
  return product.status();
}

/// True if a folder holds what robots run at any depth at which programs lie, or cannot be read as far as
/// that.
bool holdsPrograms(const std::filesystem::path& folder) {
  constexpr int kProgramsDepth = 4;  // results/programs/column-1/strip-0/T_ROB1/file
  std::error_code error;
  for (std::filesystem::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    const robotio::Dialect* dialect = robotio::dialectOfFile(it->path().string());
    if (dialect && dialect->check) return true;
    if (it.depth() >= kProgramsDepth) it.disable_recursion_pending();
  }
  return bool(error);
}

/// The folders of strips below the programs of results: one, or some in the folder of each block.
std::vector<std::filesystem::path> stripsBelow(const std::filesystem::path& programs) {
  std::vector<std::filesystem::path> strips;
  std::error_code error;
  for (std::filesystem::recursive_directory_iterator it(programs, error), end; !error && it != end;
       it.increment(error)) {
    if (!it->is_directory(error)) continue;
    const std::string name = it->path().filename().string();
    if (name.starts_with("strip-") && name.find_first_not_of("0123456789", 6) == std::string::npos) {
      strips.push_back(it->path());
      it.disable_recursion_pending();
    }
    if (it.depth() >= 1 || isTemporaryName(name)) it.disable_recursion_pending();
  }
  std::ranges::sort(strips);
  return strips;
}

/// The design of the results that a path lies in, if it lies in any.
std::string designAbout(const std::filesystem::path& path) {
  constexpr int kHighest = 5;  // results/programs/column-1/strip-0/T_ROB1/file
  std::error_code error;
  std::filesystem::path at = std::filesystem::absolute(path, error).lexically_normal();
  if (!at.has_filename()) at = at.parent_path();
  for (int level = 0; level <= kHighest && !at.empty(); ++level, at = at.parent_path())
    if (std::filesystem::exists(at / "design.bladewright", error)) return at.string();
  return {};
}

/// True if a report says that a program or a motion is not as it was written.
bool isChanged(const Findings& findings) {
  return std::ranges::any_of(findings, [](const Finding& finding) {
    const auto* mismatch = std::get_if<RunMismatch>(&finding.cause);
    return mismatch && robotio::dialectOfFile(mismatch->file) &&
           (mismatch->what == RunMismatch::What::changedModule ||
            mismatch->what == RunMismatch::What::otherFile);
  });
}

/// What breaks the rules of a program; of a motion that no robot runs, whether it can be read.
Findings rulesOf(const robotio::Program& program) {
  const robotio::Dialect* dialect =
      program.size() == 1 ? robotio::dialectOfFile(program.front().path) : nullptr;
  if (!dialect || dialect->check) return robotio::checkProgram(program);
  const Result<Motion> motion = dialect->read(program);
  if (motion) return {};
  return {{Severity::error, ProgramBreach{"motion", program.front().path, motion.error().message}, {}, {}}};
}

/// What comes of a program that is not as its design had it written: it is run with the blade, and held
/// against what was planned.
Findings ranAgainst(const Session& session, const robotio::Program& program, const std::string& about) {
  Findings findings;
  const auto tell = [&](Severity severity, std::string clause) {
    const std::string place = "the program";
    if (clause.starts_with(place + ": ")) clause.erase(0, place.size() + 2);
    findings.push_back({severity, ProgramBreach{"program-run", place, std::move(clause)}, {}, {}});
  };
  const auto unknown = [&](const Error& error) {
    tell(Severity::error,
         "it is not as it was written, and cannot be held against its design: " + error.message);
    return findings;
  };
  const Result<Design> design = session.designOf(about);
  if (!design) return unknown(design.error());
  std::error_code error;
  const pipeline::CutLengths lengths =
      std::filesystem::is_directory(about, error) ? pipeline::lengthsMadeWith(about) : pipeline::CutLengths();
  const Result<pipeline::ProgramRun> run =
      pipeline::runProgram(program, &*design, session.context(), lengths);
  session.endProgress();
  if (!run) return unknown(run.error());
  // Rules that it breaks are told beside this.
  for (std::size_t i = run->broken; i < run->exceeded.size(); ++i) tell(Severity::error, run->exceeded[i]);
  for (const std::string& clause : run->warnings) tell(Severity::warning, clause);
  return findings;
}

/// What is found about one folder or file.
Result<Findings> findingsOf(const Session& session, const std::filesystem::path& path) {
  Findings findings = pipeline::compareWithReport(path);
  const bool changed = isChanged(findings);
  const std::string about = changed ? designAbout(path) : std::string();
  std::error_code error;
  const bool isResult = pipeline::isResultFolder(path);
  constexpr std::size_t kShown = 5;
  const std::vector<std::string> errors =
      isResult ? pipeline::errorsOfReport(path) : std::vector<std::string>();
  const auto tell = [&](std::string text) {
    findings.push_back(
        {Severity::error, ProgramBreach{"design-errors", "report.json", std::move(text)}, {}, {}});
  };
  for (std::size_t i = 0; i < std::min(kShown, errors.size()); ++i)
    tell("the design has an error: " + errors[i]);
  if (errors.size() > kShown)
    tell("the design has " + std::to_string(errors.size() - kShown) + " more errors");
  if (isResult && !holdsPrograms(path)) return findings;  // the design has none
  const std::filesystem::path programs = path / "programs";
  std::vector<std::filesystem::path> places = stripsBelow(isResult ? programs : path);
  // Those of one strip are named from the folder that was given.
  if (places.size() < 2)
    places = {isResult && std::filesystem::is_directory(programs, error) ? programs : path};
  for (const std::filesystem::path& place : places) {
    if (places.size() > 1 && !holdsPrograms(place)) continue;
    const Result<robotio::Program> program = robotio::loadProgram(place);
    if (!program) return tl::unexpected<Error>(program.error());
    Findings broken = rulesOf(*program);
    if (!about.empty())
      for (Finding& finding : ranAgainst(session, *program, about)) broken.push_back(std::move(finding));
    if (places.size() > 1)
      for (Finding& finding : broken) finding.where.block = place.lexically_relative(path).string();
    findings.insert(findings.end(), broken.begin(), broken.end());
  }
  return findings;
}

int runCheck(const Session& session, const std::vector<std::string>& paths) {
  int status = kDone;
  for (const std::string& path : paths) {
    const Result<Findings> findings = findingsOf(session, path);
    if (!findings) return session.complain(findings.error());
    for (const Finding& finding : *findings)
      std::cout << printable(path + ": " + severityName(finding.severity) + ": " + words::placeText(finding) +
                             ": " + words::sentence(finding, words::Reader::commandLine) + " [" +
                             words::kindWord(finding) + "]")
                << "\n";
    if (hasErrors(*findings)) status = kLimitExceeded;
    if (findings->empty()) std::cout << printable(path) << ": no findings\n";
  }
  return status;
}

struct SimulateOptions {
  std::string path, design, out;
};

int runSimulate(const Session& session, const SimulateOptions& options) {
  std::error_code error;
  // What draws the pictures gets ready meanwhile, unless all is to be done on one thread.
  std::future<scene::Scene> ready;
  if (!options.out.empty() && session.threads != 1 && std::filesystem::exists(options.path, error))
    ready = std::async(std::launch::async, pipeline::readyScene);
  const std::string about = options.design.empty() ? designAbout(options.path) : options.design;
  std::optional<Design> design;
  if (!about.empty()) {
    Result<Design> opened = session.designOf(about);
    if (!opened) return session.complain(opened.error());
    design = std::move(*opened);
  }
  const std::filesystem::path path = options.path, programs = path / "programs";
  if (const auto strips = stripsBelow(std::filesystem::is_directory(programs, error) ? programs : path);
      strips.size() > 1)
    return session.complain({ErrorCode::badInput,
                             options.path + " holds the programs of " + std::to_string(strips.size()) +
                                 " strips; give the folder of one, such as " + strips.front().string(),
                             options.path});
  Result<robotio::Program> program =
      robotio::loadProgram(std::filesystem::is_directory(programs, error) ? programs : path);
  // Results of a design with errors hold no program that robots run, but its motion.
  if (const auto motion = programs / "strip-0" / "motion.json";
      !program && std::filesystem::exists(motion, error))
    program = robotio::loadProgram(motion);
  if (!program) return session.complain(program.error());
  const pipeline::CutLengths lengths =
      std::filesystem::is_directory(about, error) ? pipeline::lengthsMadeWith(about) : pipeline::CutLengths();
  if (!options.out.empty())
    if (const Result<void> ok = session.mayWriteInto(options.out); !ok) return session.complain(ok.error());
  // What is seen of the run is told while the rest is sought.
  std::string cut;
  Result<std::vector<pipeline::ReportPicture>> pictures;
  const auto tellSeen = [&](const pipeline::ProgramRun& seen) {
    std::future<std::string> text =
        std::async(session.threads == 1 ? std::launch::deferred : std::launch::async,
                   [&seen] { return pipeline::cutText(seen); });
    pictures =
        pipeline::simulationPictures(seen, session.context(), ready.valid() ? ready.get() : scene::Scene());
    cut = text.get();
  };
  const Result<pipeline::ProgramRun> run = pipeline::runProgram(
      *program, design ? &*design : nullptr, session.context(), lengths,
      options.out.empty() ? std::function<void(const pipeline::ProgramRun&)>() : tellSeen);
  if (!run) return session.complain(run.error());
  if (!options.out.empty()) {
    if (session.stop.stop_requested()) return session.complain(stoppedError().value());
    FileSet files;
    files.add("simulation.json", pipeline::simulationText(*run));
    files.add("cut.obj", std::move(cut));
    if (!pictures) {
      // What the program does is known all the same.
      session.endProgress();
      std::cerr << "warning: no pictures are written: " << printable(pictures.error().message) << "\n";
    } else {
      for (const pipeline::ReportPicture& picture : *pictures) files.add(picture.name + ".png", picture.png);
    }
    if (Result<void> ok = session.writeFiles(files, options.out); !ok) return session.complain(ok.error());
  } else {
    std::cout << pipeline::simulationText(*run);
  }
  session.tell({});
  const Simulation& simulation = run->simulation;
  for (const std::string& clause : run->exceeded) std::cerr << "error: " << printable(clause) << "\n";
  for (const std::string& clause : run->warnings) std::cerr << "warning: " << printable(clause) << "\n";
  if (!design)
    std::cerr << "info: no design was given; the blade is run without weight, against no surface\n";
  std::cerr << run->motion.instants.size() << " targets in " << fixedText(run->motion.duration(), 0) << " s";
  if (simulation.halt) std::cerr << ", run up to " << shortText(simulation.halt->time, 4) << " s";
  if (run->surface && run->surface->covered > 0)
    std::cerr << (run->around > 0 ? "; but for the ways around the cut and the heat, the program"
                                  : "; the program")
              << (run->alone ? "" : " of " + printable(run->block + ", " + run->cut)) << " cuts within "
              << shortText(run->surface->toDesignMax) << " mm of the surface shown, within "
              << shortText(run->surface->toTargetMax) << " mm of the target";
  if (!simulation.blades.empty())
    std::cerr << "; least stability margin " << shortText(simulation.marginMin, 2);
  if (const BarrierLook* least = leastBarrier(run->barriers))
    std::cerr << "; least energy barrier " << shortText(*least->barrier, 2) << " N mm, at "
              << shortText(least->time, 4) << " s";
  if (simulation.minRadius > 0) std::cerr << "; smallest radius " << shortText(simulation.minRadius) << " mm";
  if (simulation.speeds)
    std::cerr << "; fastest point " << shortText(simulation.speeds->max) << " mm/s, at "
              << shortText(simulation.speeds->maxAt.time, 4) << " s";
  if (run->surface && run->surface->speeds)
    std::cerr << "; slowest that cuts " << shortText(run->surface->speeds->min) << " mm/s, at "
              << shortText(run->surface->speeds->minAt.time, 4) << " s";
  std::cerr << "\n";
  return run->exceeded.empty() ? kDone : kLimitExceeded;
}

}  // namespace

void addDespiteErrors(CLI::App& verb, bool& despiteErrors) {
  verb.add_flag("--despite-errors", despiteErrors,
                "Write the robot programs of a design with errors too, marked as not safe to run");
}

void addProgramVerbs(CLI::App& app, const Session& session, Work& work) {
  {
    CLI::App* verb =
        app.add_subcommand("export", "Robot programs of a result or a design, after their check");
    const auto options = std::make_shared<ExportOptions>();
    verb->add_option("PATH", options->path, "Folder of results, or a .bladewright file")->required();
    verb->add_option("--format", options->formats, programFormatWords(", ") + " (several with commas)")
        ->delimiter(',')
        ->type_name("LIST");
    verb->add_option("--cell", options->cell, "Robot cell: a word or a JSON file; default: the design's")
        ->type_name("CELL");
    verb->add_option("--out", options->out, "Folder for the programs")->type_name("DIR")->required();
    addDespiteErrors(*verb, options->despiteErrors);
    verb->footer(
        "Example:\n  blade export out/panel --format rapid,csv --cell irb1600-pair --out out/programs");
    onChosen(*verb, session, work, options, runExport);
  }
  {
    CLI::App* verb = app.add_subcommand(
        "simulate", "Read a program back and run it with the blade and its weight: what it really cuts");
    const auto options = std::make_shared<SimulateOptions>();
    verb->add_option("PROGRAM", options->path,
                     "Folder of results or of a program, or a motion: a file named motion.csv or motion.json")
        ->required();
    verb->add_option(
            "--design", options->design,
            "Design or folder of results to compare with; default: that of the results PROGRAM lies in")
        ->type_name("PATH");
    verb->add_option("--out", options->out,
                     "Folder for simulation.json, cut.obj and pictures of what is cut; without it the first "
                     "goes to standard output")
        ->type_name("DIR");
    verb->footer("Example:\n  blade simulate out/panel --out out/simulation");
    onChosen(*verb, session, work, options, runSimulate);
  }
  {
    CLI::App* verb = app.add_subcommand("check",
                                        "Apply the rules for robot programs to results, a program folder or "
                                        "a file; whether all is of one run");
    const auto paths = std::make_shared<std::vector<std::string>>();
    verb->add_option("PROGRAM", *paths,
                     "Folders of results, folders with T_ROB1/, T_ROB2/, …, or single module files")
        ->required();
    verb->footer("Example:\n  blade check out/panel");
    onChosen(*verb, session, work, paths, runCheck);
  }
}

}  // namespace bw::cli
