// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/produce.h"

#include "make_files.h"

namespace bw::pipeline {

namespace {

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
  Outcome outcome = evaluate(design, nullptr, context, purpose);
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

}  // namespace bw::pipeline
