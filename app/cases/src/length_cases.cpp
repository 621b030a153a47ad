// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <chrono>

#include "bw/core/blade/blade_json.h"
#include "bw/core/calibration/blade_length.h"
#include "case_runner.h"

namespace bw::cases {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr double kHuge = 1e12;

void readMeasurement(ObjectReader& reader, BladeMeasurement& m) {
  for (const char* key : {"distance", "height"})
    reader.need(key, reader.path() + " needs the key " + key + ", in mm");
  reader.number("distance", m.distance, 1e-9, kHuge);
  reader.number("height", m.height, 0, kHuge);
  reader.need("angle", reader.path() + " needs the key angle, in rad, or null for ends that turn freely");
  reader.number("angle", m.angle, 0, 3.1);
}

ordered_json bladeToResult(const BladeLength& blade) {
  ordered_json result;
  result["length"] = blade.length;
  result["slack"] = blade.slack;
  result["k"] = blade.k;
  result["case"] = bladeLengthCaseName(blade.letter);
  result["angle"] = blade.angle;
  result["elastica"] = elasticaToJson(blade.elastica);
  result["stable"] = blade.stable;
  result["sensitivity"] = {
      {"height", blade.byHeight}, {"angle", blade.byAngle}, {"distance", blade.byDistance}};
  return result;
}

ordered_json estimateToJson(const Estimate& estimate) {
  return {
      {"value", estimate.value}, {"error", estimate.error}, {"low", estimate.low}, {"high", estimate.high}};
}

Result<ordered_json> singleCase(const json& object) {
  ObjectReader reader(object, "case");
  BladeMeasurement measurement;
  readMeasurement(reader, measurement);
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  const auto start = std::chrono::steady_clock::now();
  const Result<BladeLength> blade = bladeLength(measurement);
  if (!blade) return passOn(blade.error());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ordered_json result = bladeToResult(*blade);
  result["seconds"] = seconds;
  return result;
}

Result<CalibrationMeasurement> measurementFromJson(const json& object, const std::string& path) {
  ObjectReader reader(object, path);
  CalibrationMeasurement m;
  readMeasurement(reader, m.held);
  reader.number("temperature", m.temperature, -50, 1500);
  reader.number("height_error", m.heightError, 0, kHuge);
  reader.number("angle_error", m.angleError, 0, 10);
  reader.number("distance_error", m.distanceError, 0, kHuge);
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  return m;
}

Result<ordered_json> calibrationCase(const json& object) {
  ObjectReader reader(object, "case");
  const json* list = reader.member("measurements");
  Blade blade;
  if (Result<Blade> preset = bladePreset(blade.name)) blade = std::move(*preset);
  readBlade(reader, blade);
  if (blade.autoLength) reader.complain("blade", "case.blade.length must be a number here, not \"auto\"");
  CalibrationOptions options;
  reader.number("confidence", options.confidence, 1e-6, 1 - 1e-9);
  reader.boolean("height_offset", options.heightOffset);
  reader.boolean("angle_offset", options.angleOffset);
  reader.number("reference_temperature", options.referenceTemperature, -50, 1500);
  if (!list->is_array()) reader.complain("measurements", "case.measurements must be a list of measurements");
  if (Result<void> ok = reader.finish(); !ok) return passOn(ok.error());
  std::vector<CalibrationMeasurement> measurements;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Result<CalibrationMeasurement> m =
        measurementFromJson((*list)[i], "measurements[" + std::to_string(i) + "]");
    if (!m) return passOn(m.error());
    measurements.push_back(*m);
  }
  const auto start = std::chrono::steady_clock::now();
  const Result<CalibrationResult> calibrated = calibrateBlade(measurements, blade, options);
  if (!calibrated) return passOn(calibrated.error());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ordered_json result;
  result["length"] = calibrated->length.value;
  result["interval"] = estimateToJson(calibrated->length);
  result["confidence"] = options.confidence;
  result["temperature"] = blade.temperature;
  result["reference_temperature"] = options.referenceTemperature;
  result["reference_length"] = estimateToJson(calibrated->reference);
  if (calibrated->heightOffset) result["height_offset"] = estimateToJson(*calibrated->heightOffset);
  if (calibrated->angleOffset) result["angle_offset"] = estimateToJson(*calibrated->angleOffset);
  result["sigma"] = calibrated->sigma;
  result["degrees_of_freedom"] = calibrated->degreesOfFreedom;
  result["plausibility"] = calibrated->plausibility;
  result["measurements"] = ordered_json::array();
  for (const CalibrationResult::Item& item : calibrated->items) {
    ordered_json entry = bladeToResult(item.blade);
    entry["residual"] = item.residual;
    entry["weighted_residual"] = item.weightedResidual;
    entry["single_length"] = item.singleLength;
    result["measurements"].push_back(std::move(entry));
  }
  result["iterations"] = calibrated->iterations;
  result["seconds"] = seconds;
  return result;
}

Result<ordered_json> lengthCase(const json& object, bool&) {
  if (object.is_object() && object.contains("measurements")) return calibrationCase(object);
  return singleCase(object);
}

}  // namespace

Result<CaseAnswer> lengthCases(std::string_view text, const RunContext& context) {
  return runCases(text, context, lengthCase);
}

}  // namespace bw::cases
