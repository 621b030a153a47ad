// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "controls/numbers.h"

#include <algorithm>
#include <cmath>

#include "bw/core/number_text.h"
#include "bw/core/units.h"

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
  return mm > kStraight || !std::isfinite(mm) ? QStringLiteral("straight") : shortNumber(mm, 3) + " mm";
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

QString percentText(double fraction) {
  const double percent = 100 * fraction;
  const double shown = percent < 100 ? std::min(percent, 99.9) : percent;
  return QString::fromStdString(fixedText(shown, percent < 100 ? 1 : 0)) + QStringLiteral(" %");
}

QString pointText(const Eigen::Vector3d& p) {
  const auto text = [](double v) { return QString::fromStdString(fixedText(v, 1)); };
  return QStringLiteral("%1, %2, %3").arg(text(p.x()), text(p.y()), text(p.z()));
}

QString sizeText(const Eigen::Vector3d& size) {
  return QStringLiteral("%1 × %2 × %3 mm")
      .arg(shortNumber(size.x(), 4), shortNumber(size.y(), 4), shortNumber(size.z(), 4));
}

std::vector<StationNumbers> stationNumbers(const pipeline::SweepResult& result) {
  const auto& stations = result.sweep.stations;
  const SweepAnalysis& analysis = result.analysis;
  const Field* deviation = analysis.cut.field("deviation");
  const Field* speed = analysis.cut.field("speed");
  std::vector<StationNumbers> numbers(stations.size());
  for (std::size_t i = 0; i < stations.size(); ++i) {
    StationNumbers& n = numbers[i];
    n.maxCurvature = stations[i].blade.maxCurvature();
    n.stress = result.sweep.blade.stress(n.maxCurvature);
    if (i >= analysis.stationRow.size()) continue;
    const std::size_t columns = std::size_t(analysis.cut.columns);
    const std::size_t first = std::size_t(analysis.stationRow[i]) * columns;
    if (deviation && first + columns <= deviation->values.size())
      for (std::size_t k = 0; k < columns; ++k)
        n.deviation = std::max(n.deviation, std::abs(deviation->values[first + k]));
    if (speed && first + columns <= speed->values.size()) {
      const auto [low, high] = std::minmax_element(speed->values.begin() + std::ptrdiff_t(first),
                                                   speed->values.begin() + std::ptrdiff_t(first + columns));
      n.speedMin = *low;
      n.speedMax = *high;
    }
  }
  return numbers;
}

}  // namespace bw::app
