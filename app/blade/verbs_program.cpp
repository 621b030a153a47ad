// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <iostream>
#include <memory>

#include "bw/core/cell.h"
#include "bw/core/design.h"
#include "bw/core/printable.h"
#include "bw/pipeline/pipeline.h"
#include "bw/pipeline/run_identity.h"
#include "bw/robotio/program.h"
#include "verbs.h"

namespace bw::cli {

namespace {

struct ExportOptions {
  std::string path, cell, out;
  std::vector<std::string> formats = {"rapid"};
};

int runExport(const Session& session, const ExportOptions& options, bool despiteErrors) {
  Result<Design> design = designOf(options.path);
  if (!design) return session.complain(design.error());
  // What is exported is what the findings are about.
  if (!options.cell.empty()) design->job.cell = options.cell;
  design->job.programs = options.formats;
  const Result<Cell> cell = loadCell(design->job.cell);
  if (!cell) return session.complain(cell.error());
  const pipeline::FolderState before = pipeline::folderState(options.out);
  const pipeline::Outcome outcome = pipeline::evaluate(*design, nullptr, session.context());
  session.tell(outcome.evaluation.issues());
  if (outcome.error) return session.complain(*outcome.error);
  Issues findings;
  Result<FileSet> files = pipeline::programFiles(outcome.evaluation, *cell, options.formats, "Blade",
                                                 programPolicy(despiteErrors), findings);
  session.tell(findings);
  if (!files) return session.complain(files.error());
  if (!files->paths().empty()) {
    FileSet all;
    all.append(std::move(*files), "strip-0");
    if (Result<void> ok = session.writeFiles(all, options.out, {}, before); !ok)
      return session.complain(ok.error());
  }
  return resultStatus(outcome.evaluation);
}

/// True if a folder holds modules, or lists of them, at any depth at which programs lie, or cannot be read as
/// far as that.
bool holdsRapid(const std::filesystem::path& folder) {
  std::error_code error;
  for (std::filesystem::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    const std::string suffix = lowerSuffix(it->path());
    if (suffix == ".mod" || suffix == ".modx" || suffix == ".pgf") return true;
    if (it.depth() >= 3) it.disable_recursion_pending();
  }
  return bool(error);
}

/// What is found about one folder or file.
Result<Issues> findingsOf(const std::filesystem::path& path) {
  Issues issues = pipeline::compareWithReport(path);
  std::error_code error;
  const bool isResult = pipeline::isResultFolder(path);
  if (isResult && !holdsRapid(path)) return issues;  // the design has none
  const std::filesystem::path programs = path / "programs";
  const Result<robotio::Program> program =
      robotio::loadProgram(isResult && std::filesystem::is_directory(programs, error) ? programs : path);
  if (!program) return tl::unexpected<Error>(program.error());
  const Issues broken = robotio::checkRapid(*program);
  issues.insert(issues.end(), broken.begin(), broken.end());
  return issues;
}

int runCheck(const Session& session, const std::vector<std::string>& paths) {
  int status = kDone;
  for (const std::string& path : paths) {
    const Result<Issues> issues = findingsOf(path);
    if (!issues) return session.complain(issues.error());
    for (const Issue& issue : *issues)
      std::cout << printable(path + ": " + severityName(issue.severity) + ": " + issue.where.text + ": " +
                             issue.message + " [" + issue.kind + "]")
                << "\n";
    if (hasErrors(*issues)) status = kLimitExceeded;
    if (issues->empty()) std::cout << printable(path) << ": no findings\n";
  }
  return status;
}

}  // namespace

std::shared_ptr<bool> addDespiteErrors(CLI::App& verb) {
  const auto despite = std::make_shared<bool>(false);
  verb.add_flag("--despite-errors", *despite,
                "Write the robot programs of a design with errors too, marked as not safe to run");
  return despite;
}

pipeline::ProgramPolicy programPolicy(bool despiteErrors) {
  return {despiteErrors, ", or have it written and marked as not safe to run with --despite-errors"};
}

void addProgramVerbs(CLI::App& app, const Session& session, Work& work) {
  {
    CLI::App* verb =
        app.add_subcommand("export", "Robot programs of a result or a design, after their check");
    const auto options = std::make_shared<ExportOptions>();
    verb->add_option("PATH", options->path, "Folder of results, or a .bladewright file")->required();
    verb->add_option("--format", options->formats, "rapid, csv, json (several with commas)")
        ->delimiter(',')
        ->type_name("LIST");
    verb->add_option("--cell", options->cell, "Robot cell: a word or a JSON file; default: the design's")
        ->type_name("CELL");
    verb->add_option("--out", options->out, "Folder for the programs")->type_name("DIR")->required();
    const std::shared_ptr<bool> despite = addDespiteErrors(*verb);
    verb->footer(
        "Example:\n  blade export out/panel --format rapid,csv --cell irb1600-pair --out out/programs");
    verb->callback([&session, &work, options, despite] {
      work = [&session, options, despite] { return runExport(session, *options, *despite); };
    });
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
    verb->callback(
        [&session, &work, paths] { work = [&session, paths] { return runCheck(session, *paths); }; });
  }
}

}  // namespace bw::cli
