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

int runExport(const Session& session, const std::string& path, const std::vector<std::string>& formats,
              const std::string& cellName, const std::string& out) {
  const Result<Design> design = designOf(path);
  if (!design) return session.complain(design.error());
  const Result<Cell> cell = loadCell(cellName.empty() ? design->job.cell : cellName);
  if (!cell) return session.complain(cell.error());
  const pipeline::Outcome outcome = pipeline::evaluate(*design, nullptr, session.context());
  if (outcome.error) return session.complain(*outcome.error);
  const Motion& motion = outcome.evaluation.sweep.value->motion;
  Issues findings = robotio::checkPlacement(motion, *cell);
  Result<FileSet> files = pipeline::programFiles(motion, *cell, formats, "Blade", findings);
  session.tell(findings);
  if (!files) return session.complain(files.error());
  FileSet all;
  all.append(std::move(*files), "strip-0");
  if (Result<void> ok = session.writeFiles(all, out); !ok) return session.complain(ok.error());
  return kDone;
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

void addProgramVerbs(CLI::App& app, const Session& session, Work& work) {
  {
    CLI::App* verb =
        app.add_subcommand("export", "Robot programs of a result or a design, after their check");
    const auto path = std::make_shared<std::string>();
    const auto formats = std::make_shared<std::vector<std::string>>(std::vector<std::string>{"rapid"});
    const auto cell = std::make_shared<std::string>();
    const auto out = std::make_shared<std::string>();
    verb->add_option("PATH", *path, "Folder of results, or a .bladewright file")->required();
    verb->add_option("--format", *formats, "rapid, csv, json (several with commas)")
        ->delimiter(',')
        ->type_name("LIST");
    verb->add_option("--cell", *cell, "Robot cell: a word or a JSON file; default: the design's")
        ->type_name("CELL");
    verb->add_option("--out", *out, "Folder for the programs")->type_name("DIR")->required();
    verb->footer(
        "Example:\n  blade export out/panel --format rapid,csv --cell irb1600-pair --out out/programs");
    verb->callback([&session, &work, path, formats, cell, out] {
      work = [&session, path, formats, cell, out] {
        return runExport(session, *path, *formats, *cell, *out);
      };
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
