// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <nlohmann/json.hpp>

#include "bw/core/base/units.h"
#include "bw/core/files/fingerprint.h"
#include "bw/pipeline/produce.h"

namespace bw::pipeline {

using nlohmann::ordered_json;

namespace {

/// No "-0" in a report.
double plain(double x) { return x == 0 ? 0.0 : x; }

ordered_json vec(const Eigen::Vector3d& v) { return {plain(v.x()), plain(v.y()), plain(v.z())}; }

ordered_json quaternion(const Eigen::Quaterniond& q) {
  return {plain(q.w()), plain(q.x()), plain(q.y()), plain(q.z())};
}

ordered_json elasticaJson(const Elastica& e) {
  ordered_json object;
  object["start"] = {plain(e.start().x()), plain(e.start().y())};
  object["start_angle"] = plain(e.startAngle());
  object["start_curvature"] = plain(e.startCurvature());
  object["force"] = {plain(e.force().x()), plain(e.force().y())};
  object["length"] = e.length();
  if (const std::optional<ControlParameters> p = e.controlParameters())
    object["control_parameters"] = {{"k", p->k},     {"s0", p->s0}, {"l", p->l}, {"S", p->S},
                                    {"phi", p->phi}, {"x", p->x},   {"y", p->y}};
  else
    object["control_parameters"] = nullptr;
  return object;
}

ordered_json stationJson(const Station& s) {
  ordered_json object;
  object["index"] = s.index;
  object["travel"] = plain(s.travel);
  object["frame"] = {{"origin", vec(s.frame.origin)},
                     {"x", vec(s.frame.x)},
                     {"y", vec(s.frame.y)},
                     {"normal", vec(s.frame.normal)}};
  object["target_length"] = s.targetLength;
  object["elastica"] = elasticaJson(s.fit.elastica);
  object["fit_status"] = fitStatusName(s.fit.status);
  object["R4"] = s.fit.R4;
  object["hausdorff_mm"] = s.fit.hausdorff;
  object["blade"] = {{"left", {{"point", vec(s.leftPoint())}, {"tangent", vec(s.leftTangent())}}},
                     {"right", {{"point", vec(s.rightPoint())}, {"tangent", vec(s.rightTangent())}}},
                     {"parameter", {-s.extension, 1 + s.extension}}};
  const double curvature = s.blade.maxCurvature();
  object["max_curvature"] = curvature;
  object["min_radius_mm"] = curvature > 0 ? ordered_json(1 / curvature) : ordered_json(nullptr);
  object["inflections"] = bladeInflections(s.fit.elastica);
  object["stable"] = s.stable;
  object["stability_margin"] = s.stabilityMargin;
  object["out_of_plane_margin"] = s.outOfPlaneMargin;
  object["angle_mean_deg"] = toDegrees(s.angleMean);
  object["angle_max_deg"] = toDegrees(s.angleMax);
  object["speed_ratio"] = s.speedRatio;
  object["clearance_mm"] = s.clearance;
  return object;
}

ordered_json trialJson(const DirectionTrial& trial, bool chosen) {
  ordered_json object = {{"name", trial.name},
                         {"direction", vec(trial.direction)},
                         {"chosen", chosen},
                         {"stations", trial.stations},
                         {"unusable", trial.unusable}};
  const bool known = trial.failure.empty();
  object["deviation_max_mm"] = known ? ordered_json(trial.deviationMax) : ordered_json(nullptr);
  object["angle_max_deg"] = known ? ordered_json(toDegrees(trial.angleMax)) : ordered_json(nullptr);
  if (!known) object["failure"] = trial.failure;
  return object;
}

}  // namespace

std::string reportJson(const Evaluation& e, const std::string& run, const FileSet& files,
                       words::Reader reader) {
  ordered_json report;
  const Job& job = e.design.job;
  report["bladewright_report"] = 1;
  report["run"] = run;
  if (e.target.value) {
    const Bounds b = e.target.value->bounds();
    const std::vector<int>& faces = e.target.value->faces();
    report["target"] = {{"file", e.design.source.path.generic_string()},
                        {"face", faces.size() == 1 ? ordered_json(faces[0]) : ordered_json(faces)},
                        {"bounds_mm", {vec(b.min), vec(b.max)}},
                        {"area_mm2", e.target.value->area()}};
  }
  report["blade"] = {{"name", job.blade.name},
                     {"title", job.blade.title},
                     {"length", job.blade.length},
                     {"min_radius_mm", job.blade.minRadius()},
                     {"flexural_rigidity_Nmm2", job.blade.flexuralRigidity()}};
  ordered_json method;
  method["planes"] = "parallel";
  if (e.setup) method["direction"] = vec(e.setup->direction);
  method["fit"] = {{"length", job.fitLength == FitOptions::Length::exact ? "exact" : "free"},
                   {"endpoints", job.fitEndpoints},
                   {"tangents", job.fitTangents},
                   {"max_periods", job.maxPeriods}};
  method["lead_mm"] = job.lead;
  method["tolerance_mm"] = job.tolerance;
  method["cutting_speed_mm_s"] = job.cuttingSpeed;
  method["clearance_mm"] = job.clearance;
  method["cell"] = job.cell;
  report["method"] = method;
  if (e.setup) {
    const Box& block = e.setup->block;
    report["block"] = {{"origin", vec(block.frame.origin)},
                       {"size", vec(block.size)},
                       {"x", vec(block.frame.x)},
                       {"y", vec(block.frame.y)},
                       {"z", vec(block.frame.normal)}};
  }
  if (e.directions.value) {
    const DirectionSearch& search = *e.directions.value;
    report["directions"] = ordered_json::array();
    for (std::size_t i = 0; i < search.trials.size(); ++i)
      report["directions"].push_back(trialJson(search.trials[i], i == search.chosen));
  }
  report["seconds"] = {{"read", e.seconds.read},         {"direction", e.seconds.direction},
                       {"sections", e.seconds.sections}, {"fit", e.seconds.fit},
                       {"extend", e.seconds.extend},     {"check", e.seconds.check},
                       {"write", e.seconds.write},       {"total", e.seconds.total}};
  report["strips"] = ordered_json::array();
  if (e.sweep.value) {
    ordered_json stations = ordered_json::array();
    for (const Station& station : e.sweep.value->sweep.stations) stations.push_back(stationJson(station));
    report["strips"].push_back({{"index", 0}, {"stations", stations}});
    const SweepSummary& s = e.sweep.value->analysis.summary;
    // A blade that is straight everywhere has no radius.
    const ordered_json radius = s.minRadius > 0 ? ordered_json(s.minRadius) : ordered_json(nullptr);
    report["summary"] = {{"R4_max", s.R4Max},
                         {"R4_mean", s.R4Mean},
                         {"hausdorff_max_mm", s.hausdorffMax},
                         {"hausdorff_mean_mm", s.hausdorffMean},
                         {"deviation_max_mm", s.deviationMax},
                         {"deviation_mean_mm", s.deviationMean},
                         {"deviation_rms_mm", s.deviationRms},
                         {"within_tolerance_percent", 100 * s.withinTolerance},
                         {"angle_max_deg", toDegrees(s.angleMax)},
                         {"angle_mean_deg", toDegrees(s.angleMean)},
                         {"angle_station_mean_max_deg", toDegrees(s.angleStationMeanMax)},
                         {"speed_ratio_min", s.speedRatioMin},
                         {"joint_gap_max_mm", 0.0},
                         {"joint_angle_max_deg", 0.0},
                         {"min_radius_mm", radius},
                         {"cutting_time_s", s.cuttingTime}};
  }
  if (e.cell.value) {
    report["robots"] = ordered_json::array();
    for (const CellTask& task : e.cell.value->tasks)
      report["robots"].push_back(
          {{"task", task.name}, {"tcp", {vec(task.tool.position), quaternion(task.tool.rotation)}}});
  }
  report["issues"] = ordered_json::array();
  for (const Finding& finding : e.findings()) {
    ordered_json item = {{"severity", severityName(finding.severity)},
                         {"kind", words::kindWord(finding)},
                         {"message", words::sentence(finding, reader)},
                         {"where", words::placeText(finding)}};
    if (finding.where.stations) item["station"] = finding.where.stations->worst;
    if (finding.where.point) item["point"] = vec(*finding.where.point);
    report["issues"].push_back(item);
  }
  report["files"] = ordered_json::array({"report.json"});
  report["fingerprints"] = ordered_json::object();
  for (std::size_t i = 0; i < files.paths().size(); ++i) {
    const std::string name = files.paths()[i].generic_string();
    report["files"].push_back(name);
    report["fingerprints"][name] = fingerprintText(fingerprintOf(files.bytes()[i]));
  }
  return report.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace bw::pipeline
