// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "bw/core/design/program_formats.h"
#include "bw/pipeline/run_identity.h"
#include "bw/robotio/dialects.h"
#include "bw/robotio/motion/program_plan.h"
#include "make_files.h"

namespace bw::pipeline {

Result<FileSet> programFiles(Evaluation& e, const Cell& cell, const std::string& name, const Policy& policy) {
  Findings& findings = e.programs;
  findings.clear();
  const Motion& motion = *e.cut().motion.value;
  robotio::ProgramNotes notes{name, words::errorsOf(e.findings(), policy.reader), {}, runId(e, &cell)};
  for (const Finding& finding : robotio::checkPlacement(motion, cell))
    notes.warnings.push_back(words::sentence(finding, policy.reader));
  FileSet files;
  const std::vector<std::string>& formats = e.design.output.programs;
  for (auto format = formats.begin(); format != formats.end(); ++format) {
    if (std::find(formats.begin(), format, *format) != format) continue;  // asked for twice
    const robotio::Dialect* dialect = robotio::dialect(*format);
    if (!dialect) {
      const std::string nearest = nearestProgramFormat(*format);
      return fail(ErrorCode::badInput,
                  "there is no program format \"" + *format + "\"" +
                      (nearest.empty() ? "; the formats are " + programFormatWords()
                                       : "; did you mean \"" + nearest + "\"?"),
                  "format");
    }
    if (dialect->check && !notes.errors.empty()) {
      findings.push_back({policy.despiteErrors ? Severity::warning : Severity::error,
                          ProgramDespiteErrors{int(notes.errors.size()), policy.despiteErrors},
                          {},
                          {}});
      if (!policy.despiteErrors) continue;
    }
    Result<robotio::Program> program = dialect->write(motion, cell, notes, &findings);
    if (!program) return tl::unexpected<Error>(program.error());
    for (robotio::ProgramFile& file : *program) files.add(file.path, std::move(file.bytes));
  }
  return files;
}

}  // namespace bw::pipeline
