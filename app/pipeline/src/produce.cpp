// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/produce.h"

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/design/design_versions.h"
#include "bw/core/design/program_formats.h"
#include "bw/core/files/file_set.h"
#include "bw/core/files/fingerprint.h"
#include "bw/core/text/number_text.h"
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
  if (!evaluation.complete())
    return fail(ErrorCode::badInput, "there is no result to write; mend what the messages say first",
                "results");
  if (policy.contents == Contents::results) return resultFiles(evaluation, context, policy);
  const Result<Cell> cell = loadCell(evaluation.design.output.cell);
  if (!cell) return tl::unexpected<Error>(cell.error());
  return programFiles(evaluation, *cell, policy.programName, policy, policy.programFolder);
}

/// Has OpenCASCADE confirm the sections of an evaluation that was looked at, and makes anew what hangs on
/// those that it takes over. A source that is another by now is left to `storedDesign`, which says so.
void confirm(Product& product, const RunContext& context) {
  Evaluation& standing = product.evaluation;
  if (!standing.complete() || standing.cut().confirmed.value) return;
  Outcome outcome = evaluate(standing.design, &standing, context, Purpose::files);
  if (outcome.evaluation.source.value != standing.source.value) return;
  product.error = outcome.error;
  if (product.error) return;
  standing.blocks = std::move(outcome.evaluation.blocks);
  standing.missed = std::move(outcome.evaluation.missed);
  standing.uncut = std::move(outcome.evaluation.uncut);
  standing.uncutArea = outcome.evaluation.uncutArea;
  standing.outside = std::move(outcome.evaluation.outside);
  standing.outsideShare = outcome.evaluation.outsideShare;
  standing.joints = std::move(outcome.evaluation.joints);
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
                const RunContext& context, const Evaluation* previous) {
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
  Outcome outcome = evaluate(design, previous, context, purpose, policy.lengths);
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

std::string lostInResults(const Design& design) {
  if (!design.versions.empty())
    return "has named versions, which would be lost: results hold a design without";
  if (design.source().drawing)
    return "links a drawing, which would be lost: results hold the surface drawn there";
  if (design.marks != PartMarks())
    return "hides or locks parts, which would be lost: results hold a design without such marks";
  return {};
}

Result<Design> storedDesign(const Evaluation& evaluation) {
  Design result = withoutVersions(evaluation.design);
  result.source().drawing.reset();  // what was cut is the surface that it holds
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

namespace {

/// The findings of one block, and those that concern all.
Findings findingsFor(const BlockEvaluation& block, Findings all) {
  std::erase_if(all, [&](const Finding& finding) {
    return !finding.where.block.empty() && finding.where.block != block.id;
  });
  return all;
}

/// The programs of one strip; `findings` gets what is to be told of them.
Result<FileSet> programsOf(const Evaluation& e, const Strip& strip, const Cell& cell,
                           robotio::ProgramNotes notes, const Policy& policy, Findings& findings) {
  const Motion& motion = *strip.cut->motion.value;
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

std::string lowered(std::string name) {
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return name;
}

/// A block's id as the name of a folder.
std::string folderName(const std::string& id) {
  std::string name;
  for (const char c : id) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || (c == '.' && !name.empty());
    name += plain ? c : '_';
  }
  constexpr std::size_t kLongest = 60;
  name.resize(std::min(kLongest, name.size()));
  // Folders go to machines that know no point at an end, and have names of their own.
  if (name.ends_with('.')) name.back() = '_';
  const std::string low = lowered(name);
  for (const char* device : {"con", "prn", "aux", "nul"})
    if (low == device) name += '_';
  if (low.size() == 4 && (low.starts_with("com") || low.starts_with("lpt")) && low[3] > '0' && low[3] <= '9')
    name += '_';
  return name;
}

}  // namespace

std::vector<Strip> stripsOf(const Evaluation& e) {
  std::vector<Strip> strips;
  for (const BlockEvaluation& block : e.blocks)
    for (const CutEvaluation& cut : block.cuts)
      if (cut.result()) strips.push_back({int(strips.size()), &block, &cut});
  return strips;
}

std::filesystem::path stripFolder(const Evaluation& e, const Strip& strip) {
  const std::string own = "strip-" + std::to_string(strip.index);
  if (e.blocks.size() < 2) return own;
  std::string name = folderName(strip.block->id);
  const auto same = std::ranges::count_if(
      e.blocks, [&](const BlockEvaluation& block) { return lowered(folderName(block.id)) == lowered(name); });
  if (same > 1) name += "-" + std::to_string(strip.block - e.blocks.data() + 1);
  return fs::path(name) / own;
}

std::string stripTitle(const Evaluation& e, const Strip& strip) {
  const bool blocks = e.blocks.size() > 1, cuts = strip.block->cuts.size() > 1;
  if (!blocks && !cuts) return {};
  return (blocks ? strip.block->id + (cuts ? ", " + strip.cut->id : "") : strip.cut->id) + ": ";
}

std::string lyingText(const Cut& cut) {
  if (cut.pose.asPlaced()) return {};
  std::string text = "its " + std::string(kBlockFaces[std::size_t(cut.pose.up)]) + " face up";
  if (cut.pose.quarters != 0)
    text += ", then turned by " + std::to_string(90 * cut.pose.quarters) +
            " degrees counter-clockwise seen from above";
  return text;
}

PlanesTurned PlanesTurned::of(const PlaneFamily& planes) {
  constexpr int kLooks = 400;
  const auto at = [&planes](int k) {
    const double degrees = toDegrees(planes.angle(std::lerp(planes.entry, planes.exit, double(k) / kLooks)));
    return std::round(degrees * 1e6) / 1e6 + 0.0;  // no noise, and no −0
  };
  PlanesTurned turned{at(0), at(kLooks), at(0), at(0)};
  for (int k = 1; k <= kLooks; ++k) {
    turned.least = std::min(turned.least, at(k));
    turned.most = std::max(turned.most, at(k));
  }
  return turned;
}

std::string turningText(const PlaneFamily& planes, const Box& block) {
  if (!planes.turns()) return {};
  // Where the block lies on another face for the cut, the lines about which they turn lie, too.
  const bool upright = planes.frame.y.dot(block.frame.normal) > 0.5;
  const auto by = [](double degrees) {
    const std::string size = fixedText(std::abs(degrees), 1);
    return size + (size == "0.0" ? "" : degrees > 0 ? " counter-clockwise" : " clockwise");
  };
  const PlanesTurned turned = PlanesTurned::of(planes);
  std::string text = "by " + by(turned.first) + " at first, " + by(turned.last) + " at last";
  if (turned.least < std::min(turned.first, turned.last) || turned.most > std::max(turned.first, turned.last))
    text += ", between " + by(turned.least) + " and " + by(turned.most);
  return text + (upright ? " (degrees, seen from above)" : " (degrees, about a line that lies level)");
}

namespace {

const char* besideTheCut(KeptSide side) {
  switch (side) {
    case KeptSide::below:
      return "below the cut";
    case KeptSide::above:
      return "above the cut";
    case KeptSide::left:
      return "to the left of the cut";
    case KeptSide::right:
      return "to the right of the cut";
    case KeptSide::front:
      return "in front of the cut";
    case KeptSide::back:
      break;
  }
  return "behind the cut";
}

/// What is to be done with the block before the program of a strip runs.
std::vector<std::string> stepsBefore(const Evaluation& e, const Strip& strip) {
  std::vector<std::string> steps;
  const std::vector<CutEvaluation>& cuts = strip.block->cuts;
  const auto place = strip.cut - cuts.data();
  if (cuts.size() > 1)
    steps.push_back(
        "this is cut " + std::to_string(place + 1) + " of " + std::to_string(cuts.size()) + " of " +
        strip.block->id +
        (place > 0 ? "; make " + cuts[std::size_t(place - 1)].id + " before it, and take away what is cut off"
                   : std::string()));
  const auto poseOf = [&e](const CutEvaluation& cut) -> const CutPose& {
    return std::ranges::find(e.design.cuts, cut.id, &Cut::id)->pose;
  };
  // Also where it comes back to how it was placed.
  if (std::ranges::any_of(cuts, [&](const CutEvaluation& cut) { return !poseOf(cut).asPlaced(); })) {
    const std::string lies = lyingText(*std::ranges::find(e.design.cuts, strip.cut->id, &Cut::id));
    steps.push_back("lay the block with " + (lies.empty() ? "its top face up, not turned" : lies) +
                    "; the work object is at its corner that then lies lowest, at the left and in front");
  }
  const KeptSide kept = std::ranges::find(e.design.cuts, strip.cut->id, &Cut::id)->keep;
  steps.push_back(std::string("see that what stays is the foam ") + besideTheCut(kept) +
                  ", as the block then lies");
  return steps;
}

}  // namespace

Result<FileSet> programFiles(Evaluation& e, const Cell& cell, const std::string& name, const Policy& policy,
                             const fs::path& ofOne) {
  e.programs.clear();
  const std::vector<Strip> strips = stripsOf(e);
  const Findings found = e.findings();
  const std::string run = runId(e, &cell);
  FileSet files;
  Findings all;
  for (const Strip& strip : strips) {
    if (!policy.wanted.hasBlock(strip.block->id)) continue;
    Findings findings;
    const robotio::ProgramNotes notes{name,
                                      words::errorsOf(findingsFor(*strip.block, found), policy.reader),
                                      {},
                                      stepsBefore(e, strip),
                                      run};
    Result<FileSet> own = programsOf(e, strip, cell, notes, policy, findings);
    if (!own) return own;
    if (e.blocks.size() > 1)
      for (Finding& finding : findings) finding.where.block = strip.block->id;
    if (strip.block->cuts.size() > 1)
      for (Finding& finding : findings) finding.where.cut = strip.cut->id;
    all.insert(all.end(), findings.begin(), findings.end());
    // The folder of the only strip ends in its name, where it has one.
    const fs::path base = ofOne.filename().string().starts_with("strip-") ? ofOne.parent_path() : ofOne;
    files.append(std::move(*own), strips.size() == 1 ? ofOne : base / stripFolder(e, strip));
  }
  e.programs = std::move(all);
  return files;
}

}  // namespace bw::pipeline
