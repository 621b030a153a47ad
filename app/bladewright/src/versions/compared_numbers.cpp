// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "versions/compared_numbers.h"

#include <QCoreApplication>

#include <algorithm>
#include <limits>
#include <optional>

#include "bw/core/text/number_text.h"
#include "bw/pipeline/overall.h"
#include "controls/numbers.h"

namespace bw::app {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("bw::app::ComparedNumbers", text); }

/// m³ of the blocks; empty while one of them is not known.
std::optional<double> foamOf(const pipeline::Evaluation& evaluation) {
  double volume = 0;
  for (const pipeline::BlockEvaluation& block : evaluation.blocks) {
    if (!block.cuts.front().setup) return std::nullopt;
    volume += block.cuts.front().block().size.prod();
  }
  return volume * 1e-9;
}

}  // namespace

std::vector<ComparedNumber> comparedNumbers(const pipeline::Evaluation* evaluation) {
  std::vector<ComparedNumber> numbers = {
      {tr("Deviation"), tr("The largest, of the cut surface from the target"), {}, false},
      {tr("Covered"), tr("Part of the surface in the blocks that has cut surface over it"), {}, false},
      {tr("Margin"), tr("The smallest stability margin of a station"), {}, false},
      {tr("Radius"), tr("The smallest, over the whole blade at all stations"), {}, false},
      {tr("Time"), tr("Of all cuts, in minutes and seconds, leads included"), {}, false},
      {tr("Foam"), tr("Of all blocks"), {}, false}};
  if (!evaluation) return numbers;
  if (const std::optional<double> foam = foamOf(*evaluation))
    numbers[5].text = QString::fromStdString(shortText(*foam, 3)) + " m³";
  if (!evaluation->complete()) return numbers;
  const pipeline::Overall all = pipeline::overallOf(*evaluation);
  double margin = std::numeric_limits<double>::infinity();  // of a pulled blade it is above 1
  SweepLimits broken;
  for (const pipeline::BlockEvaluation& block : evaluation->blocks)
    for (const pipeline::CutEvaluation& cut : block.cuts) {
      const pipeline::CutResult result = *cut.result();
      for (const StationCheck& station : result.check.stations)
        margin = std::min(margin, station.stabilityMargin);
      const SweepLimits own = brokenLimits(result, evaluation->design);
      broken.deviation = broken.deviation || own.deviation || own.between;
      broken.coverage = broken.coverage || own.coverage;
      broken.radius = broken.radius || own.radius;
    }
  numbers[0].text = lengthText(std::max(all.summary.deviationMax, all.betweenMax.value_or(0)));
  numbers[0].broken = broken.deviation;
  numbers[1].text = percentText(all.covered);
  numbers[1].broken = broken.coverage;
  numbers[2].text = QString::fromStdString(fixedText(margin, 2));
  numbers[2].broken = margin < evaluation->design.process.margin;
  numbers[3].text = radiusText(all.summary.minRadius);
  numbers[3].broken = broken.radius;
  numbers[4].text = timeText(all.cuttingTime);
  return numbers;
}

}  // namespace bw::app
