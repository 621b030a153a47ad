// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "bw/core/design/program_formats.h"
#include "bw/pipeline/run_identity.h"
#include "bw/robotio/program.h"
#include "make_files.h"

namespace bw::pipeline {

Result<FileSet> programFiles(Evaluation& e, const Cell& cell, const std::string& name, const Policy& policy) {
  const std::vector<std::string>& formats = e.design.output.programs;
  Findings& findings = e.programs;
  findings.clear();
  const Motion& motion = *e.cut().motion.value;
  FileSet files;
  for (std::size_t i = 0; i < formats.size(); ++i) {
    const std::string& format = formats[i];
    if (std::find(formats.begin(), formats.begin() + std::ptrdiff_t(i), format) !=
        formats.begin() + std::ptrdiff_t(i))
      continue;  // asked for twice
    Result<robotio::Program> program;
    if (format == "rapid") {
      robotio::RapidOptions options;
      options.programName = name;
      options.errors = words::errorsOf(e.findings(), policy.reader);
      for (const Finding& finding : robotio::checkPlacement(motion, cell))
        options.warnings.push_back(words::sentence(finding, policy.reader));
      options.run = runId(e, &cell);
      if (!options.errors.empty()) {
        findings.push_back({policy.despiteErrors ? Severity::warning : Severity::error,
                            ProgramDespiteErrors{int(options.errors.size()), policy.despiteErrors},
                            {},
                            {}});
        if (!policy.despiteErrors) continue;
      }
      program = robotio::writeRapid(motion, cell, options, &findings);
    } else if (format == "csv") {
      program = robotio::writeCsv(motion);
    } else if (format == "json") {
      program = robotio::writeJson(motion, cell);
    } else {
      const std::string nearest = nearestProgramFormat(format);
      return fail(ErrorCode::badInput,
                  "there is no program format \"" + format + "\"" +
                      (nearest.empty() ? "; the formats are " + programFormatWords()
                                       : "; did you mean \"" + nearest + "\"?"),
                  "format");
    }
    if (!program) return tl::unexpected<Error>(program.error());
    for (robotio::ProgramFile& file : *program) files.add(file.path, std::move(file.bytes));
  }
  return files;
}

}  // namespace bw::pipeline
