// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "measure/blade_measuring.h"

#include <QCoreApplication>
#include <QRegularExpression>

namespace bw::app {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("bw::app::MeasurePage", text); }

BladeMeasurement heldAs(const MeasurementRow& row, bool hinged) {
  BladeMeasurement held{row.distance, row.height, {}};
  if (!hinged) held.angle = row.angle;
  return held;
}

/// The message of the core, which counts from 0 and leaves out rows without a height, in the numbers of the
/// page.
QString forPeople(const Error& error, const std::vector<std::size_t>& rows) {
  QString text = QString::fromStdString(error.message);
  static const QRegularExpression kPlace("measurements\\[(\\d+)\\]");
  const QRegularExpressionMatch match = kPlace.match(text);
  if (match.hasMatch()) {
    const auto index = match.captured(1).toULong();
    if (index < rows.size()) text.replace(kPlace, tr("measurement %1").arg(rows[index] + 1));
  }
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text.endsWith('.') ? text : text + '.';
}

}  // namespace

MeasurementOutcome evaluateSheet(const MeasurementSheet& sheet, const Blade& blade) {
  MeasurementOutcome outcome;
  std::vector<CalibrationMeasurement> measurements;
  std::vector<std::size_t> rowOf;
  for (std::size_t i = 0; i < sheet.rows.size(); ++i) {
    const MeasurementRow& row = sheet.rows[i];
    RowOutcome& out = outcome.rows.emplace_back();
    const BladeMeasurement held = heldAs(row, sheet.hinged);
    const double stretch = thermalStretch(blade, row.temperature);
    if (Result<BladeHeight> expected = bladeHeight(blade.length * stretch, held))
      out.expected = std::move(*expected);
    if (!(row.height > 0)) continue;
    if (Result<BladeLength> measured = bladeLength(held)) {
      out.lengthAtCut = measured->length / stretch;
      out.measured = std::move(*measured);
    }
    rowOf.push_back(i);
    measurements.push_back(
        {held, row.temperature, sheet.heightError, sheet.hinged ? 0 : sheet.angleError, sheet.distanceError});
  }
  outcome.measured = int(measurements.size());
  if (measurements.empty()) return outcome;
  CalibrationOptions options;
  options.heightOffset = sheet.heightOffset;
  options.angleOffset = sheet.angleOffset && !sheet.hinged;
  Result<CalibrationResult> length = calibrateBlade(measurements, blade, options);
  if (!length) {
    outcome.problem = forPeople(length.error(), rowOf);
    return outcome;
  }
  for (std::size_t k = 0; k < rowOf.size(); ++k) outcome.rows[rowOf[k]].residual = length->items[k].residual;
  outcome.length = std::move(*length);
  return outcome;
}

QString caseText(BladeLengthCase letter) {
  switch (letter) {
    case BladeLengthCase::free:
      return tr("hinged: straight at both ends");
    case BladeLengthCase::A:
      return tr("A: bends back before the grips");
    case BladeLengthCase::B:
      return tr("B: bends one way, tightest in the middle");
    case BladeLengthCase::C:
      return tr("C: bends one way, nearly as a circle");
    case BladeLengthCase::D:
      return tr("D: taut, flattest in the middle");
  }
  return {};
}

}  // namespace bw::app
