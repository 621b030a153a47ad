// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "block_layout.h"
#include "bw/core/base/units.h"
#include "bw/core/files/fingerprint.h"
#include "bw/pipeline/produce.h"
#include "make_files.h"

namespace bw::pipeline {

using nlohmann::ordered_json;

namespace {

/// No "-0" in a report.
double plain(double x) { return x == 0 ? 0.0 : x; }

ordered_json vec(const Eigen::Vector3d& v) { return {plain(v.x()), plain(v.y()), plain(v.z())}; }

/// How uneven the speeds of a blade are, and what was found to help.
ordered_json speedJson(const UnevenSpeed& cause) {
  ordered_json item = {{"speed_ratio", cause.ratio}};
  if (!cause.tried) return item;
  item["split"] = nullptr;
  item["planes"] = nullptr;
  if (!cause.parts.empty()) {
    ordered_json parts = ordered_json::array();
    for (const UnevenSpeed::Part& part : cause.parts)
      parts.push_back({{"from_mm", part.from}, {"to_mm", part.to}, {"speed_ratio", part.ratio}});
    item["split"] = {{"along", std::string(1, "xyz"[cause.edge])}, {"parts", parts}};
  }
  if (cause.planes)
    item["planes"] = {{"family", cause.planes->turning ? "turning" : "parallel"},
                      {"direction", vec(cause.planes->direction)},
                      {"speed_ratio", cause.planes->ratio}};
  return item;
}

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

ordered_json stationJson(const StationView& station) {
  const BladePose& s = station.pose;
  const FitResult& fit = station.fit.fit;
  const StationCheck& check = station.check;
  ordered_json object;
  object["index"] = s.index;
  object["travel"] = plain(s.travel);
  object["frame"] = {{"origin", vec(s.frame.origin)},
                     {"x", vec(s.frame.x)},
                     {"y", vec(s.frame.y)},
                     {"normal", vec(s.frame.normal)}};
  object["target_length"] = station.fit.target.length();
  object["elastica"] = elasticaJson(s.cut);
  object["fit_status"] = fitStatusName(fit.status);
  object["R4"] = fit.R4;
  object["hausdorff_mm"] = fit.hausdorff;
  object["blade"] = {{"left", {{"point", vec(s.leftPoint())}, {"tangent", vec(s.leftTangent())}}},
                     {"right", {{"point", vec(s.rightPoint())}, {"tangent", vec(s.rightTangent())}}},
                     {"parameter", {-s.before / s.cut.length(), 1 + s.after() / s.cut.length()}}};
  object["max_curvature"] = s.maxCurvature();
  object["min_radius_mm"] = s.minRadius() > 0 ? ordered_json(s.minRadius()) : ordered_json(nullptr);
  object["inflections"] = bladeInflections(s.cut);
  object["stable"] = check.stable;
  object["stability_margin"] = check.stabilityMargin;
  object["out_of_plane_margin"] = check.outOfPlaneMargin;
  object["moved_by_weight_mm"] = s.heavy ? ordered_json(check.movedByWeight) : ordered_json(nullptr);
  object["bent_sideways_mm"] =
      s.heavy && std::isfinite(check.sideways) ? ordered_json(check.sideways) : ordered_json(nullptr);
  object["snaps_at"] = station.fit.snapsAt ? ordered_json(*station.fit.snapsAt) : ordered_json(nullptr);
  const std::optional<double> ratio = station.certainty.energyRatio();
  object["certainty"] =
      station.rest == Rest::unknown ? ordered_json(nullptr) : ordered_json(restName(station.rest));
  object["energy_ratio"] = ratio ? ordered_json(*ratio) : ordered_json(nullptr);
  const std::optional<double>& barrier = station.certainty.barrier;
  object["barrier_Nmm"] = barrier ? ordered_json(*barrier) : ordered_json(nullptr);
  object["angle_mean_deg"] = toDegrees(check.angleMean);
  object["angle_max_deg"] = toDegrees(check.angleMax);
  object["speed_ratio"] = check.speedRatio;
  object["clearance_mm"] = check.clearance;
  object["above_bottom_mm"] = check.aboveBottom;
  object["grip_error_mm"] =
      std::isfinite(check.movedByGrip) ? ordered_json(check.movedByGrip) : ordered_json(nullptr);
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
  object["unrested"] = trial.unrested;
  if (!known) object["failure"] = trial.failure;
  return object;
}

/// How many stations were asked for; where that was left to the tolerance how many were found, and how well
/// they tell what lies between them.
ordered_json stationsJson(const SectionRequest& asked, const CutEvaluation& cut) {
  ordered_json object;
  object["asked"] = "auto";
  if (asked.spacing)
    object["asked"] = {{"spacing", *asked.spacing}};
  else if (asked.stations)
    object["asked"] = *asked.stations;
  if (!asked.byTolerance() || !cut.count.value) return object;
  // Cuts that go on from block to block have as many.
  object["found"] = cut.sections.request.sections.stations.value_or(cut.count.value->stations);
  const std::optional<double>& between = cut.count.value->between;
  object["between_mm"] = between ? ordered_json(*between) : ordered_json(nullptr);
  return object;
}

ordered_json blockJson(const Box& block) {
  return {{"origin", vec(block.frame.origin)},
          {"size", vec(block.size)},
          {"x", vec(block.frame.x)},
          {"y", vec(block.frame.y)},
          {"z", vec(block.frame.normal)}};
}

/// How the block lies for a cut, and what stays of it.
ordered_json lyingJson(const Cut& cut) {
  return {{"face_up", kBlockFaces[std::size_t(cut.pose.up)]},
          {"turn_deg", 90 * cut.pose.quarters},
          {"keep", kKeptSides[std::size_t(cut.keep)]},
          {"offset_mm", cut.offset}};
}

/// The curves of a crease, each with its points and how far these are off; null where that is not known.
ordered_json creaseCurvesJson(const Crease& crease) {
  ordered_json list = ordered_json::array();
  for (std::size_t c = 0; c < crease.curves.size(); ++c) {
    ordered_json points = ordered_json::array(), off = ordered_json::array();
    for (const Eigen::Vector3d& p : crease.curves[c]) points.push_back(vec(p));
    for (const std::optional<double>& value : crease.off[c])
      off.push_back(value ? ordered_json(*value) : ordered_json());
    list.push_back({{"points", points}, {"off_mm", off}});
  }
  return list;
}

ordered_json creasesJson(const BlockEvaluation& block) {
  ordered_json list = ordered_json::array();
  for (const Crease& crease : block.together.value->creases)
    list.push_back({{"cuts", {block.cuts[crease.first].id, block.cuts[crease.second].id}},
                    {"length_mm", crease.length},
                    {"off_max_mm", crease.offMax},
                    {"off_mean_mm", crease.offMean},
                    {"not_designed_mm", crease.alone},
                    {"not_cut_mm", crease.lacking},
                    {"curves", creaseCurvesJson(crease)}});
  return list;
}

/// What is left of a block; null where it could not be made a solid.
ordered_json partJson(const BlockEvaluation& block) {
  const std::optional<geometry::Part>& solid = block.part.value->solid;
  if (!solid) return nullptr;
  ordered_json removed = ordered_json::array();
  for (std::size_t i = 0; i < block.cuts.size(); ++i)
    removed.push_back({{"cut", block.cuts[i].id},
                       {"removed_mm3", solid->steps()[i].removed},
                       {"thickest_mm", solid->steps()[i].thickest}});
  return {{"block_mm3", solid->blockVolume()},
          {"left_mm3", solid->volume()},
          {"pieces", solid->pieces()},
          {"cuts", removed}};
}

ordered_json jointsJson(const Evaluation& e) {
  ordered_json list = ordered_json::array();
  const std::vector<BlockRow> rows = rowsOf(e);
  for (const Joint& joint : e.joints.value->joints)
    list.push_back({{"blocks", {rows[joint.first].block, rows[joint.second].block}},
                    {"cuts", {rows[joint.first].cut, rows[joint.second].cut}},
                    {"gap_max_mm", joint.gapMax},
                    {"gap_mean_mm", joint.gapMean},
                    {"gap_at_stations_max_mm", joint.gapAtStations},
                    {"angle_max_deg", toDegrees(joint.kinkMax)},
                    {"angle_at_stations_max_deg", toDegrees(joint.kinkAtStations)},
                    {"places", joint.places},
                    {"open", joint.open}});
  return list;
}

ordered_json summaryJson(const Evaluation& e) {
  const Overall all = overallOf(e);
  const SweepSummary& s = all.summary;
  // Where no blade runs to the end of a program, nothing is known of what that cuts.
  const auto ofPrograms = [](const std::optional<double>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
  };
  // A blade that is straight everywhere has no radius.
  const ordered_json radius = s.minRadius > 0 ? ordered_json(s.minRadius) : ordered_json(nullptr);
  ordered_json summary = {{"R4_max", s.R4Max},
                          {"R4_mean", s.R4Mean},
                          {"hausdorff_max_mm", s.hausdorffMax},
                          {"hausdorff_mean_mm", s.hausdorffMean},
                          {"deviation_max_mm", s.deviationMax},
                          {"deviation_mean_mm", s.deviationMean},
                          {"deviation_rms_mm", s.deviationRms},
                          {"within_tolerance_percent", 100 * s.withinTolerance},
                          {"program_deviation_max_mm", ofPrograms(all.programMax)},
                          {"program_deviation_mean_mm", ofPrograms(all.programMean)},
                          {"program_from_shown_max_mm", ofPrograms(all.fromShown)},
                          {"covered_percent", 100 * all.covered},
                          {"uncovered_max_mm", all.uncovered},
                          {"outside_percent", 100 * all.outside},
                          {"angle_max_deg", toDegrees(s.angleMax)},
                          {"angle_mean_deg", toDegrees(s.angleMean)},
                          {"angle_station_mean_max_deg", toDegrees(s.angleStationMeanMax)},
                          {"speed_ratio_min", s.speedRatioMin},
                          {"min_radius_mm", radius},
                          {"cutting_time_s", all.cuttingTime},
                          {"run_time_s", all.runTime}};
  if (e.joints.value && !e.joints.value->joints.empty()) {
    summary["joint_gap_max_mm"] = e.joints.value->gapMax();
    summary["joint_angle_max_deg"] = toDegrees(e.joints.value->kinkMax());
  }
  return summary;
}

}  // namespace

std::string reportJson(const Evaluation& e, const std::string& run, const FileSet& files,
                       words::Reader reader) {
  ordered_json report;
  const Design& design = e.design;
  const CutEvaluation& cut = e.cut();
  report["bladewright_report"] = 1;
  report["run"] = run;
  if (cut.target.value) {
    const Bounds b = cut.target.value->bounds();
    const std::vector<int>& faces = cut.target.value->faces();
    const auto& surface = design.source().surface;
    report["target"] = {{"file", design.source().path.generic_string()},
                        {"surface", surface ? ordered_json(shapeText(*surface)) : ordered_json(nullptr)},
                        {"face", faces.size() == 1 ? ordered_json(faces[0]) : ordered_json(faces)},
                        {"bounds_mm", {vec(b.min), vec(b.max)}},
                        {"area_mm2", cut.target.value->area()}};
  }
  report["variables"] = ordered_json::object();
  for (const Variable& variable : design.variables) report["variables"][variable.name] = variable.value;
  report["blade"] = {{"name", design.blade.name},
                     {"title", design.blade.title},
                     {"length", design.blade.length},
                     {"length_auto", design.blade.autoLength},
                     {"min_radius_mm", design.blade.minRadius()},
                     {"flexural_rigidity_Nmm2", design.blade.flexuralRigidity()},
                     {"weight_N_per_mm", design.blade.weight()}};
  if (cut.lengths.value) {
    ordered_json bands = ordered_json::array();
    for (const BladeLengths::Band& band : cut.lengths.value->bands())
      bands.push_back({{"from", band.from}, {"to", band.to}, {"certainty", restName(band.rest)}});
    const std::optional<double>& best = cut.lengths.value->best;
    report["blade"]["lengths"] = {{"best", best ? ordered_json(*best) : ordered_json(nullptr)},
                                  {"best_computed", cut.lengths.value->designed},
                                  {"stations_tried", cut.lengths.value->stations},
                                  {"serving", bands}};
  }
  if (cut.margins.value) {
    ordered_json trials = ordered_json::array();
    for (const RowTrial& trial : cut.margins.value->trials)
      trials.push_back({{"asked", trial.asked},
                        {"margin", trial.margin},
                        {"deviation_mm", trial.deviation < Blade::kLongest ? ordered_json(trial.deviation)
                                                                           : ordered_json(nullptr)},
                        {"certainty", restName(trial.rest)}});
    const std::optional<double>& best = cut.margins.value->best;
    report["blade"]["margins"] = {{"best", best ? ordered_json(*best) : ordered_json(nullptr)},
                                  {"trials", trials}};
  }
  if (cut.clearances.value && !cut.clearances.value->trials.empty()) {
    const std::optional<RowTrial>& best = cut.clearances.value->best;
    report["blade"]["clearances"] = {{"best", best ? ordered_json(best->clearance) : ordered_json(nullptr)},
                                     {"length", best ? ordered_json(best->length) : ordered_json(nullptr)},
                                     {"least", *cut.clearances.value->least()}};
  }
  ordered_json method;
  method["planes"] = cut.setup && cut.setup->planes.turns() ? "turning" : "parallel";
  if (cut.setup) {
    const PlaneFamily& planes = cut.setup->planes;
    method["direction"] = vec(planes.direction());
    if (planes.turns()) {
      const PlanesTurned turned = PlanesTurned::of(planes);
      method["planes_turned_deg"] = {
          {"first", turned.first}, {"last", turned.last}, {"least", turned.least}, {"most", turned.most}};
    }
  }
  method["stations"] = stationsJson(design.cut().sections, cut);
  method["fit"] = {{"length", design.process.fitLength == FitOptions::Length::exact ? "exact" : "free"},
                   {"endpoints", design.process.fitEndpoints},
                   {"tangents", design.process.fitTangents},
                   {"max_periods", design.process.maxPeriods},
                   {"extend", kExtensions[std::size_t(design.process.extend)]}};
  method["lead_mm"] = design.process.lead;
  method["tolerance_mm"] = design.process.tolerance;
  method["cutting_speed_mm_s"] = design.process.cuttingSpeed;
  method["clearance_mm"] = design.process.clearance;
  method["floor_mm"] = design.process.floor;
  method["margin"] = design.process.margin;
  method["kerf_mm"] = design.process.kerf;
  if (!design.process.kerfTable.empty()) {
    method["kerf_mm"] = ordered_json::array();
    for (const KerfAt& entry : design.process.kerfTable)
      method["kerf_mm"].push_back(ordered_json::array({entry.speed, entry.width}));
  }
  method["motion_tolerance_mm"] = design.process.motionTolerance;
  method["grip_error_mm"] = design.process.gripError;
  method["grip_angle_error_deg"] = design.process.gripAngle;
  method["weight"] = design.process.weight;
  const std::optional<Eigen::Vector3d>& up = design.process.up;
  method["up"] = up ? ordered_json(vec(up->normalized())) : ordered_json(kUpOfBlock);
  if (e.blocks.size() > 1)
    method["join"] = {{"type", kJoins[std::size_t(design.process.join)]},
                      {"gap_mm", design.process.jointGap},
                      {"kink_deg", design.process.jointKink}};
  method["cell"] = design.output.cell;
  report["method"] = method;
  if (cut.setup && e.blocks.size() == 1) report["block"] = blockJson(placedBlock(design, cut));
  if (cut.directions.value) {
    const DirectionSearch& search = *cut.directions.value;
    report["directions"] = ordered_json::array();
    for (std::size_t i = 0; i < search.trials.size(); ++i)
      report["directions"].push_back(trialJson(search.trials[i], i == search.chosen));
  }
  report["seconds"] = {{"read", e.seconds.read},         {"direction", e.seconds.direction},
                       {"sections", e.seconds.sections}, {"fit", e.seconds.fit},
                       {"extend", e.seconds.extend},     {"check", e.seconds.check},
                       {"write", e.seconds.write},       {"total", e.seconds.total}};
  report["strips"] = ordered_json::array();
  report["blocks"] = ordered_json::array();
  for (const BlockEvaluation& block : e.blocks) {
    ordered_json cuts = ordered_json::array();
    for (const CutEvaluation& each : block.cuts) {
      ordered_json strips = ordered_json::array();
      if (const std::optional<CutResult> result = each.result()) {
        ordered_json stations = ordered_json::array();
        for (std::size_t i = 0; i < result->size(); ++i) stations.push_back(stationJson(result->station(i)));
        strips.push_back(report["strips"].size());
        ordered_json strip = {{"index", report["strips"].size()}, {"block", block.id}, {"cut", each.id}};
        const bool ownLength = bool(std::ranges::find(design.cuts, each.id, &Cut::id)->length);
        if (e.blocks.size() > 1 || block.cuts.size() > 1 || ownLength) {
          strip["blade_length"] = result->sweep.request.blade.length;
          const BladeLengths* sought = each.lengths.value.get();
          if (sought && sought->best) strip["best_length"] = *sought->best;
        }
        strip["stations"] = stations;
        report["strips"].push_back(strip);
      }
      ordered_json entry = {{"id", each.id}, {"strips", strips}};
      entry.update(lyingJson(*std::ranges::find(design.cuts, each.id, &Cut::id)));
      cuts.push_back(entry);
    }
    ordered_json entry = {{"id", block.id}};
    if (e.blocks.size() > 1 && block.cuts.front().setup)
      entry.update(blockJson(placedBlock(design, block.cuts.front())));
    entry["cuts"] = cuts;
    if (block.together.value) entry["creases"] = creasesJson(block);
    if (block.part.value) entry["part"] = partJson(block);
    report["blocks"].push_back(entry);
  }
  if (e.joints.value) report["joints"] = jointsJson(e);
  if (e.complete()) report["summary"] = summaryJson(e);
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
    if (!finding.where.block.empty()) item["block"] = finding.where.block;
    if (!finding.where.cut.empty()) item["cut"] = finding.where.cut;
    if (finding.where.stations) item["station"] = finding.where.stations->worst;
    if (finding.where.point) item["point"] = vec(*finding.where.point);
    if (const auto* uneven = std::get_if<UnevenSpeed>(&finding.cause)) item.update(speedJson(*uneven));
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
