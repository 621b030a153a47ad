// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "controls/numbers.h"

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/blade/cutting_limits.h"
#include "bw/core/text/number_text.h"

namespace bw::app {

namespace {

constexpr double kStraight = 1e6;  // mm: beyond this radius a blade counts as straight

QString shortNumber(double value, int digits) { return QString::fromStdString(shortText(value, digits)); }

}  // namespace

QString lengthText(double mm) {
  const double size = std::abs(mm);
  const int decimals = size < 0.0995 ? 3 : size < 9.95 ? 2 : size < 999.5 ? 1 : 0;
  return QString::fromStdString(fixedText(mm, decimals)) + QStringLiteral(" mm");
}

QString radiusText(double mm) {
  return mm <= 0 || mm > kStraight || !std::isfinite(mm) ? QStringLiteral("straight")
                                                         : shortNumber(mm, 3) + " mm";
}

QString angleText(double rad) {
  return QString::fromStdString(fixedText(toDegrees(rad), 1)) + QStringLiteral("°");
}

QString speedText(double mmPerSecond) { return shortNumber(mmPerSecond, 3) + QStringLiteral(" mm/s"); }

QString timeText(double seconds) {
  const double tenths = std::round(seconds * 10) / 10;
  const int minutes = int(tenths / 60);
  return QStringLiteral("%1:%2").arg(minutes).arg(
      QString::fromStdString(fixedText(tenths - 60 * minutes, 1)).rightJustified(4, QLatin1Char('0')));
}

QString percentText(double fraction) { return QString::fromStdString(shareText(fraction)); }

QString pointText(const Eigen::Vector3d& p) {
  const auto text = [](double v) { return QString::fromStdString(fixedText(v, 1)); };
  return QStringLiteral("%1, %2, %3").arg(text(p.x()), text(p.y()), text(p.z()));
}

QString withinSentence(QString text) {
  if (!text.isEmpty()) text[0] = text[0].toLower();
  return text;
}

QString sizeText(const Eigen::Vector3d& size) {
  return QStringLiteral("%1 × %2 × %3 mm")
      .arg(shortNumber(size.x(), 4), shortNumber(size.y(), 4), shortNumber(size.z(), 4));
}

SweepLimits brokenLimits(const pipeline::CutResult& result, const Design& design) {
  const SweepSummary& summary = result.analysis.summary;
  SweepLimits broken;
  broken.deviation = summary.deviationMax > design.process.tolerance;
  broken.between = result.between.deviationMax > design.process.tolerance;
  broken.radius = summary.minRadius > 0 && summary.minRadius < design.blade.minRadius();
  broken.angle = summary.angleMax > cuttingAngleLimit(design.blade);
  broken.speed = summary.speedRatioMin < kSpeedRatioLimit;
  broken.coverage = !result.coverage.findings.empty();
  return broken;
}

SweepLimits brokenLimits(const pipeline::StationView& station, const Design& design) {
  return {false,
          station.pose.maxCurvature() > design.blade.maxCurvature(),
          station.check.angleMax > cuttingAngleLimit(design.blade),
          station.check.speedRatio < kSpeedRatioLimit,
          station.check.clearance < design.process.clearance,
          station.check.nearBottom,
          station.check.stabilityMargin < design.process.margin};
}

std::vector<StationNumbers> stationNumbers(const pipeline::CutResult& result) {
  std::vector<StationNumbers> numbers(result.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    StationNumbers& n = numbers[i];
    const pipeline::StationView station = result.station(i);
    n.maxCurvature = station.pose.maxCurvature();
    n.stress = result.sweep.request.blade.stress(n.maxCurvature);
    n.deviation = station.deviation;
    n.speedMin = station.check.speedMin;
    n.speedMax = station.check.speedMax;
  }
  return numbers;
}

std::vector<StationNumbers> stationNumbers(const pipeline::CutSketch& sketch) {
  std::vector<StationNumbers> numbers;
  for (std::size_t i = 0; i < sketch.sweep->poses.size(); ++i) {
    StationNumbers& n = numbers.emplace_back();
    n.maxCurvature = sketch.sweep->poses[i].maxCurvature();
    n.stress = sketch.sweep->request.blade.stress(n.maxCurvature);
    n.deviation = sketch.look->deviation[i];
    n.speedMin = sketch.look->speed[i][0];
    n.speedMax = sketch.look->speed[i][1];
  }
  return numbers;
}

}  // namespace bw::app
