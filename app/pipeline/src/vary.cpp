// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/vary.h"

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/design/variables.h"
#include "bw/core/text/number_text.h"
#include "bw/words/findings.h"

namespace bw::pipeline {

namespace {

/// A field of a CSV file.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string all = "\"";
  for (const char c : text) all += c == '"' ? std::string("\"\"") : std::string(1, c);
  return all + "\"";
}

Variation variationOf(double value, const Outcome& outcome) {
  Variation variation{.value = value, .error = outcome.error};
  if (outcome.error) return variation;
  const Evaluation& e = outcome.evaluation;
  variation.all = overallOf(e);
  for (const BlockEvaluation& block : e.blocks)
    for (const CutEvaluation& cut : block.cuts)
      if (cut.rest.value)
        for (const Rest rest : cut.rest.value->stations) ++variation.rest[std::size_t(rest)];
  const Findings findings = e.findings();
  variation.good = !exceedsLimit(findings);
  for (const Finding& finding : findings) {
    if (finding.severity == Severity::info) continue;
    const std::string kind = words::kindWord(finding);
    if (variation.findings.find(kind) == std::string::npos)
      variation.findings += (variation.findings.empty() ? "" : " ") + kind;
  }
  return variation;
}

}  // namespace

Result<void> vary(const Design& design, const VaryRange& range, const RunContext& context,
                  const std::function<Result<void>(const Variation&, const Evaluation*)>& each) {
  if (std::ranges::find(design.variables, range.variable, &Variable::name) == design.variables.end())
    return fail(ErrorCode::badInput, "the design has no variable \"" + range.variable + "\"", "variable");
  if (range.count < VaryRange::kLeast || range.count > VaryRange::kMost)
    return fail(ErrorCode::badInput,
                std::to_string(range.count) + " values are asked for; there may be " +
                    std::to_string(VaryRange::kLeast) + " to " + std::to_string(VaryRange::kMost),
                "count", double(range.count), double(VaryRange::kMost));
  std::optional<Outcome> before;
  for (int i = 0; i < range.count; ++i) {
    const double value = std::lerp(range.from, range.to, double(i) / (range.count - 1));
    const Result<Design> varied = withVariables(design, {{range.variable, value}});
    Outcome outcome;
    if (varied)
      outcome = evaluate(*varied, before ? &before->evaluation : nullptr,
                         context.child(double(i) / range.count, double(i + 1) / range.count));
    else
      outcome.error = varied.error();
    if (context.stopped()) return stoppedError();
    if (Result<void> ok = each(variationOf(value, outcome), outcome.error ? nullptr : &outcome.evaluation);
        !ok)
      return ok;
    if (!outcome.error) before = std::move(outcome);
  }
  return {};
}

std::string varyHead(const std::string& variable) {
  return variable +
         ",status,deviation_max_mm,deviation_mean_mm,within_tolerance_percent,covered_percent,"
         "min_radius_mm,angle_max_deg,certain,held,lost,unknown,cutting_time_s,way_deviation_max_mm,findings";
}

std::string varyLine(const Variation& variation) {
  std::string line = fixedText(variation.value, 6);
  const auto add = [&line](const std::string& text) { line += "," + quoted(text); };
  constexpr int kNumbers = 12;
  if (variation.error) {
    add("failed");
    for (int i = 0; i < kNumbers; ++i) add("");
    add(variation.error->message);
    return line;
  }
  const SweepSummary& summary = variation.all.summary;
  add(variation.good ? "ok" : "exceeds");
  add(fixedText(summary.deviationMax, 4));
  add(fixedText(summary.deviationMean, 4));
  add(fixedText(100 * summary.withinTolerance, 2));
  add(fixedText(100 * variation.all.covered, 2));
  add(summary.minRadius > 0 ? fixedText(summary.minRadius, 1) : "");
  add(fixedText(toDegrees(summary.angleMax), 2));
  for (const Rest rest : {Rest::certain, Rest::held, Rest::lost, Rest::unknown})
    add(std::to_string(variation.rest[std::size_t(rest)]));
  add(fixedText(variation.all.cuttingTime, 1));
  add(variation.all.betweenMax ? fixedText(*variation.all.betweenMax, 4) : "");
  add(variation.findings);
  return line;
}

}  // namespace bw::pipeline
