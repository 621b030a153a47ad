// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "bw/core/number_text.h"
#include "bw/pipeline/pipeline.h"
#include "bw/pipeline/run_identity.h"
#include "bw/robotio/program.h"

namespace bw::pipeline {

namespace {

std::vector<std::string> errorsOf(const Evaluation& e) {
  std::vector<std::string> errors;
  for (const Issue& issue : e.issues())
    if (issue.severity == Severity::error && issue.kind != kProgramIssue) errors.push_back(issue.message);
  return errors;
}

std::string countText(const std::vector<std::string>& errors) {
  return errors.size() == 1 ? "an error" : std::to_string(errors.size()) + " errors";
}

Issue refusal(const std::vector<std::string>& errors, const ProgramPolicy& policy) {
  return {Severity::error,
          kProgramIssue,
          "no RAPID program is written, because the design has " + countText(errors) +
              (errors.size() == 1 ? "; mend it" : "; mend them") + policy.remedy,
          {}};
}

Issue marking(const std::vector<std::string>& errors) {
  return {Severity::warning,
          kProgramIssue,
          "the RAPID program is written although the design has " + countText(errors) +
              "; its modules are marked as not safe to run",
          {}};
}

}  // namespace

Result<FileSet> programFiles(const Evaluation& e, const Cell& cell, const std::vector<std::string>& formats,
                             const std::string& name, const ProgramPolicy& policy, Issues& findings) {
  static const std::vector<std::string> kFormats = {"rapid", "csv", "json"};
  if (!e.sweep.value)
    return fail(ErrorCode::badInput, "there is no result to write; mend what the messages say first",
                "results");
  const Motion& motion = e.sweep.value->motion;
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
      options.errors = errorsOf(e);
      options.run = runId(e, &cell);
      if (!options.errors.empty()) {
        findings.push_back(policy.despiteErrors ? marking(options.errors) : refusal(options.errors, policy));
        if (!policy.despiteErrors) continue;
      }
      program = robotio::writeRapid(motion, cell, options, &findings);
    } else if (format == "csv") {
      program = robotio::writeCsv(motion);
    } else if (format == "json") {
      program = robotio::writeJson(motion, cell);
    } else {
      const std::string nearest = nearestWord(format, kFormats.data(), int(kFormats.size()));
      return fail(ErrorCode::badInput,
                  "there is no program format \"" + format + "\"" +
                      (nearest.empty() ? "; the formats are rapid, csv and json"
                                       : "; did you mean \"" + nearest + "\"?"),
                  "format");
    }
    if (!program) return tl::unexpected<Error>(program.error());
    for (robotio::ProgramFile& file : *program) files.add(file.path, std::move(file.bytes));
  }
  return files;
}

}  // namespace bw::pipeline
