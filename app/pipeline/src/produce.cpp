// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/produce.h"

#include <algorithm>

#include "bw/core/design/program_formats.h"
#include "bw/core/files/file_set.h"
#include "bw/core/files/fingerprint.h"
#include "bw/pipeline/run_identity.h"
#include "bw/robotio/dialects.h"
#include "bw/robotio/motion/program_plan.h"
#include "make_files.h"

namespace bw::pipeline {

namespace {

namespace fs = std::filesystem;

/// A source up to this size is embedded there; a larger one is linked.
constexpr std::uintmax_t kEmbedLimit = 8u << 20;

using Contents = Policy::Contents;

Result<FileSet> filesOf(Evaluation& evaluation, const Policy& policy, const RunContext& context) {
  if (policy.contents == Contents::evaluation) return FileSet{};
  if (evaluation.blocks.size() != 1 || evaluation.blocks.front().cuts.size() != 1)
    return fail(ErrorCode::badInput, "files are written of designs with one block and one cut", "results");
  if (!evaluation.result())
    return fail(ErrorCode::badInput, "there is no result to write; mend what the messages say first",
                "results");
  if (policy.contents == Contents::results) return resultFiles(evaluation, context, policy);
  const Result<Cell> cell = loadCell(evaluation.design.output.cell);
  if (!cell) return tl::unexpected<Error>(cell.error());
  Result<FileSet> programs = programFiles(evaluation, *cell, policy.programName, policy);
  if (!programs) return programs;
  FileSet files;
  files.append(std::move(*programs), policy.programFolder);
  return files;
}

/// Has OpenCASCADE confirm the sections of an evaluation that was looked at, and makes anew what hangs on
/// those that it takes over. A source that is another by now is left to `storedDesign`, which says so.
void confirm(Product& product, const RunContext& context) {
  Evaluation& standing = product.evaluation;
  if (!standing.result() || standing.cut().confirmed.value) return;
  Outcome outcome = evaluate(standing.design, &standing, context, Purpose::files);
  if (outcome.evaluation.source.value != standing.source.value) return;
  product.error = outcome.error;
  if (product.error) return;
  standing.blocks = std::move(outcome.evaluation.blocks);
  standing.cell = std::move(outcome.evaluation.cell);
}

void makeFiles(Product& product, const Policy& policy, const RunContext& context) {
  Result<FileSet> files = filesOf(product.evaluation, policy, context);
  if (files)
    product.files = std::move(*files);
  else
    product.error = files.error();
}

}  // namespace

int Product::status() const {
  if (error) return statusOf(error->code);
  return exceedsLimit(findings()) ? kLimitExceeded : kDone;
}

Findings Product::takenOver() const {
  Findings taken = findings();
  std::erase_if(taken, [](const Finding& finding) {
    const auto* differs = std::get_if<SectionDiffers>(&finding.cause);
    return !differs || !differs->taken;
  });
  return taken;
}

Product produce(const Design& design, const std::filesystem::path& folder, const Policy& policy,
                const RunContext& context) {
  Product product;
  if (policy.contents != Contents::evaluation) {
    product.seen = folderState(folder);
    if (!design.output.programs.empty())
      if (const Result<Cell> cell = loadCell(design.output.cell); !cell) {
        product.error = cell.error();
        return product;
      }
  }
  const Purpose purpose = policy.contents == Contents::evaluation ? Purpose::live : Purpose::files;
  Outcome outcome = evaluate(design, nullptr, context, purpose, policy.length);
  product.evaluation = std::move(outcome.evaluation);
  product.error = outcome.error;
  if (!product.error) makeFiles(product, policy, context);
  return product;
}

Product produce(Evaluation evaluation, const std::filesystem::path& folder, const Policy& policy,
                const RunContext& context) {
  Product product;
  product.seen = folderState(folder);
  product.evaluation = std::move(evaluation);
  confirm(product, context);
  if (!product.error) makeFiles(product, policy, context);
  return product;
}

Result<Design> storedDesign(const Evaluation& evaluation) {
  Design result = evaluation.design;
  if (result.source().surface) return result;
  const Fingerprint& read = evaluation.source.value->content;
  const auto changed = [&] {
    return fail(ErrorCode::cannotRead,
                result.source().path.string() +
                    " was changed after the results were computed from it; compute them again",
                result.source().path.string());
  };
  std::error_code error;
  if (result.source().bytes.empty() && fs::file_size(result.source().path, error) <= kEmbedLimit && !error) {
    Result<std::string> bytes = readFile(result.source().path);
    if (!bytes) return tl::unexpected<Error>(bytes.error());
    if (fingerprintOf(*bytes) != read) return changed();
    result.source().bytes = std::move(*bytes);
    result.source().path = result.source().path.filename();
  } else if (result.source().bytes.empty()) {
    const Result<Fingerprint> now = fingerprintOfFile(result.source().path);
    if (!now) return tl::unexpected<Error>(now.error());
    if (*now != read) return changed();
    result.source().path = fs::absolute(result.source().path, error);
    result.source().saved = read;
  }
  return result;
}

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
