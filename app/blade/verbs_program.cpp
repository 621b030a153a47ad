// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <iostream>
#include <memory>

#include "bw/core/cell.h"
#include "bw/core/design.h"
#include "bw/pipeline/pipeline.h"
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
    if (Result<void> ok = session.writeFiles(all, options.out); !ok) return session.complain(ok.error());
  }
  return resultStatus(outcome.evaluation);
}

int runCheck(const Session& session, const std::vector<std::string>& paths) {
  int status = kDone;
  for (const std::string& path : paths) {
    const Result<robotio::Program> program = robotio::loadProgram(path);
    if (!program) return session.complain(program.error());
    const Issues issues = robotio::checkRapid(*program);
    for (const Issue& issue : issues)
      std::cout << path << ": " << severityName(issue.severity) << ": " << issue.where.text << ": "
                << issue.message << " [" << issue.kind << "]\n";
    if (hasErrors(issues)) status = kLimitExceeded;
    if (issues.empty()) std::cout << path << ": no findings\n";
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
    CLI::App* verb =
        app.add_subcommand("check", "Apply the rules for robot programs to a program folder or file");
    const auto paths = std::make_shared<std::vector<std::string>>();
    verb->add_option("PROGRAM", *paths, "Folders with T_ROB1/, T_ROB2/, …, or single module files")
        ->required();
    verb->footer("Example:\n  blade check out/panel/programs/strip-0");
    verb->callback(
        [&session, &work, paths] { work = [&session, paths] { return runCheck(session, *paths); }; });
  }
}

}  // namespace bw::cli
