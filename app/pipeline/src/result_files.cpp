// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "bw/core/base/units.h"
#include "bw/core/sweep/maps.h"
#include "bw/core/sweep/station_times.h"
#include "bw/core/text/number_text.h"
#include "bw/geometry/export.h"
#include "bw/pipeline/run_identity.h"
#include "curves.h"
#include "make_files.h"
#include "workshop.h"

namespace bw::pipeline {

namespace {

constexpr int kSweepPoints = 101;  ///< points a station in sweep.json

/// Appends numbers to a text without a temporary string each.
class Lines {
 public:
  explicit Lines(std::size_t reserve) { text_.reserve(reserve); }
  Lines& text(std::string_view t) {
    text_ += t;
    return *this;
  }
  Lines& integer(long long value) {
    std::array<char, 24> buffer;
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    text_.append(buffer.data(), error == std::errc{} ? end : buffer.data());
    return *this;
  }
  Lines& fixed(double value, int decimals) {
    text_ += fixedText(value, decimals);
    return *this;
  }
  Lines& vector(const Eigen::Vector3d& v, int decimals, char separator) {
    fixed(v.x(), decimals).text_ += separator;
    fixed(v.y(), decimals).text_ += separator;
    return fixed(v.z(), decimals);
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace

std::string objText(const std::vector<NamedGrid>& grids) {
  std::size_t count = 0;
  for (const NamedGrid& grid : grids) count += grid.grid->points.size();
  Lines lines(count * 110);
  lines.text("# Cut surface of the blade, mm, in the frame of the CAD file\n");
  long long before = 1;
  for (const NamedGrid& grid : grids) {
    const TriangleMesh mesh = grid.grid->triangles();
    lines.text("o ").text(grid.name).text("\n");
    for (const Eigen::Vector3d& p : mesh.points) lines.text("v ").vector(p, 6, ' ').text("\n");
    for (const auto& t : mesh.triangles)
      lines.text("f ")
          .integer(t[0] + before)
          .text(" ")
          .integer(t[1] + before)
          .text(" ")
          .integer(t[2] + before)
          .text("\n");
    before += (long long)(mesh.points.size());
  }
  return lines.take();
}

namespace {

/// The number of a strip in front of a row, where there are several.
void beginRow(Lines& lines, const std::vector<Strip>& strips, const Strip& strip) {
  if (strips.size() > 1) lines.integer(strip.index).text(",");
}

void stationRows(Lines& lines, const std::vector<Strip>& strips, const Strip& strip) {
  const CutResult result = *strip.cut->result();
  for (std::size_t i = 0; i < result.size(); ++i) {
    beginRow(lines, strips, strip);
    const StationView station = result.station(i);
    const BladePose& s = station.pose;
    const StationFit& found = station.fit;
    const StationCheck& check = station.check;
    const double radius = s.minRadius();
    lines.integer(s.index).text(",").fixed(s.travel, 4).text(",").fixed(found.target.length(), 4);
    lines.text(",").fixed(s.cut.length(), 4);
    lines.text(",").fixed(found.fit.R4, 9).text(",").fixed(found.fit.hausdorff, 6);
    lines.text(",").vector(s.leftPoint(), 4, ',').text(",").vector(s.leftTangent(), 8, ',');
    lines.text(",").vector(s.rightPoint(), 4, ',').text(",").vector(s.rightTangent(), 8, ',');
    lines.text(",").text(radius > 0 ? fixedText(radius, 3) : "");
    lines.text(",").integer(bladeInflections(s.cut));
    lines.text(check.stable ? ",yes," : ",no,").fixed(toDegrees(check.angleMean), 4);
    lines.text(",").fixed(toDegrees(check.angleMax), 4).text(",").fixed(check.speedRatio, 6);
    lines.text(",").fixed(check.clearance, 3).text(",").fixed(check.stabilityMargin, 6);
    lines.text(",").text(s.heavy ? fixedText(check.movedByWeight, 4) : "");
    lines.text(",").fixed(check.aboveBottom, 3).text("\n");
  }
}

std::string stationsCsv(const std::vector<Strip>& strips) {
  std::size_t count = 0;
  for (const Strip& strip : strips) count += strip.cut->sweep.value->poses.size();
  Lines lines(count * 400 + 600);
  if (strips.size() > 1) lines.text("strip,");
  lines.text(
      "station,travel_mm,target_length_mm,elastica_length_mm,R4,hausdorff_mm,"
      "left_x_mm,left_y_mm,left_z_mm,left_tx,left_ty,left_tz,right_x_mm,right_y_mm,right_z_mm,right_tx,right_"
      "ty,right_tz,"
      "min_radius_mm,inflections,stable,angle_mean_deg,angle_max_deg,speed_ratio,clearance_mm,"
      "stability_margin,moved_by_weight_mm,above_bottom_mm\n");
  for (const Strip& strip : strips) stationRows(lines, strips, strip);
  return lines.take();
}

const char* unitSuffix(const std::string& unit) {
  if (unit == "°") return "_deg";
  if (unit == "mm/s") return "_mm_s";
  if (unit == "N/mm²") return "_N_mm2";
  return "_mm";
}

std::string deviationCsv(const std::vector<Strip>& strips) {
  std::size_t count = 0;
  for (const Strip& strip : strips) count += strip.cut->analysis.value->cut.points.size();
  Lines lines(count * 80);
  for (const Strip& strip : strips) {
    const CutResult result = *strip.cut->result();
    SurfaceGrid cut = result.analysis.cut;
    cut.fields.push_back(certaintyField(result.rest, result.analysis.stationRow, cut));
    if (strip.index == 0) {
      if (strips.size() > 1) lines.text("strip,");
      lines.text("row,column,x_mm,y_mm,z_mm");
      for (const Field& field : cut.fields) {
        lines.text(",").text(field.name);
        if (!field.unit.empty()) lines.text(unitSuffix(field.unit));
      }
      lines.text("\n");
    }
    std::size_t k = 0;
    for (int r = 0; r < cut.rows; ++r)
      for (int c = 0; c < cut.columns; ++c, ++k) {
        beginRow(lines, strips, strip);
        lines.integer(r).text(",").integer(c).text(",").vector(cut.points[k], 4, ',');
        for (const Field& field : cut.fields) {
          lines.text(",");
          if (const char* word = mapWord(field.name, field.values[k]))
            lines.text(word);
          else if (std::isfinite(field.values[k]))
            lines.fixed(field.values[k], 5);
        }
        lines.text("\n");
      }
  }
  return lines.take();
}

std::string sweepJson(const std::vector<Strip>& strips, const std::string& run) {
  using nlohmann::ordered_json;
  const auto vec = [](const Eigen::Vector3d& v) {
    return ordered_json{v.x() + 0.0, v.y() + 0.0, v.z() + 0.0};
  };
  const auto tellPlanes = [&vec](ordered_json& told, const PlaneFamily& planes) {
    told["direction"] = vec(planes.direction());
    if (!planes.turns()) return;
    const PlanesTurned turned = PlanesTurned::of(planes);
    told["planes_turned_deg"] = {
        {"first", turned.first}, {"last", turned.last}, {"least", turned.least}, {"most", turned.most}};
  };
  ordered_json object;
  object["bladewright_sweep"] = 1;
  object["run"] = run;
  object["unit"] = "mm";
  object["points_per_station"] = kSweepPoints;
  object["blade_length"] = strips.front().cut->sweep.value->request.blade.length;
  tellPlanes(object, strips.front().cut->sweep.value->planes);
  object["strips"] = ordered_json::array();
  for (const Strip& strip : strips) {
    const CutResult result = *strip.cut->result();
    ordered_json stations = ordered_json::array();
    const std::vector<double> times = stationTimes(result.motion, result.sweep.poses);
    for (std::size_t i = 0; i < result.size(); ++i) {
      const BladePose& s = result.sweep.poses[i];
      ordered_json points = ordered_json::array();
      for (const Eigen::Vector3d& p : s.cutPoints(kSweepPoints)) points.push_back(vec(p));
      stations.push_back({{"index", s.index},
                          {"time", times.empty() ? ordered_json(nullptr) : ordered_json(times[i])},
                          {"points", points},
                          {"left", {{"point", vec(s.leftPoint())}, {"tangent", vec(s.leftTangent())}}},
                          {"right", {{"point", vec(s.rightPoint())}, {"tangent", vec(s.rightTangent())}}}});
    }
    ordered_json part = {{"index", strip.index}, {"block", strip.block->id}, {"cut", strip.cut->id}};
    if (strips.size() > 1) {
      part["blade_length"] = result.sweep.request.blade.length;
      tellPlanes(part, result.sweep.planes);
    }
    part["stations"] = stations;
    object["strips"].push_back(part);
  }
  return object.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

/// All cut surfaces as one part.
Result<std::string> stepOf(const std::vector<Strip>& strips) {
  std::vector<geometry::NamedSurface> surfaces;
  for (const Strip& strip : strips)
    surfaces.push_back(
        {strips.size() > 1 ? strip.cut->id : "cut surface", &strip.cut->analysis.value->surface});
  return geometry::stepText(surfaces, "cut surface");
}

/// The blocks before they are cut, each as it lies before it is turned for any cut.
Result<std::string> blocksOf(const Evaluation& e, const Wanted& wanted, const RunContext& context) {
  std::vector<std::pair<std::string, geometry::Part>> blocks;
  for (const BlockEvaluation& block : e.blocks) {
    if (!wanted.hasBlock(block.id)) continue;
    Result<geometry::Part> whole = geometry::Part::make(block.part.request.placed, {}, context);
    if (!whole) return tl::unexpected<Error>(whole.error());
    blocks.emplace_back(block.id, std::move(*whole));
  }
  std::vector<geometry::NamedPart> named;
  for (const auto& [id, block] : blocks) named.push_back({id, &block});
  return named.empty() ? Result<std::string>("") : geometry::partsStepText(named, "blocks");
}

/// The parts that are left, where they are known; empty where none is.
Result<std::string> partsOf(const Evaluation& e, const Wanted& wanted) {
  std::vector<geometry::NamedPart> parts;
  for (const BlockEvaluation& block : e.blocks)
    if (wanted.hasBlock(block.id) && block.part.value && block.part.value->solid &&
        block.part.value->solid->pieces() > 0)
      parts.push_back({block.id, &*block.part.value->solid});
  return parts.empty() ? Result<std::string>("") : geometry::partsStepText(parts, "parts");
}

std::string meshOf(const std::vector<Strip>& strips) {
  std::vector<NamedGrid> grids;
  for (const Strip& strip : strips)
    grids.push_back({strips.size() > 1 ? "strip-" + std::to_string(strip.index) : "cut_surface",
                     &strip.cut->analysis.value->cut});
  return objText(grids);
}

}  // namespace

Result<FileSet> resultFiles(Evaluation& e, const RunContext& context, const Policy& policy) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const std::vector<Strip> strips = stripsOf(e);
  FileSet programs;
  std::string run;
  if (e.design.output.programs.empty()) run = runId(e, nullptr);
  if (!e.design.output.programs.empty()) {
    Result<Cell> cell = loadCell(e.design.output.cell);
    if (!cell) return tl::unexpected<Error>(cell.error());
    run = runId(e, &*cell);
    if (policy.wanted.has(FileKind::programs)) {
      Result<FileSet> written = programFiles(e, *cell, "Blade", policy, "programs/strip-0");
      if (!written) return tl::unexpected<Error>(written.error());
      programs = std::move(*written);
    }
  }
  // The texts are independent of each other and take most of the time of a small job.
  std::array<std::string, 10> texts;
  std::optional<Error> stepError, partsError, blocksError, drawingsError, curvesError;
  const Wanted& wanted = policy.wanted;
  const bool workshop = partsSought(e) && wanted.has(FileKind::workshop);
  const auto body = [&](int i) {
    switch (i) {
      case 0: {
        if (!wanted.has(FileKind::surface)) break;
        Result<std::string> step = stepOf(strips);
        if (step)
          texts[0] = std::move(*step);
        else
          stepError = step.error();
        break;
      }
      case 1:
        if (wanted.has(FileKind::meshes)) texts[1] = meshOf(strips);
        break;
      case 2:
        if (wanted.has(FileKind::tables)) texts[2] = deviationCsv(strips);
        break;
      case 3:
        if (wanted.has(FileKind::tables)) texts[3] = stationsCsv(strips);
        break;
      case 4: {
        if (!wanted.has(FileKind::parts)) break;
        Result<std::string> parts = partsOf(e, wanted);
        if (parts)
          texts[5] = std::move(*parts);
        else
          partsError = parts.error();
        if (!partsSought(e)) break;
        Result<std::string> blocks = blocksOf(e, wanted, context);
        if (blocks)
          texts[9] = std::move(*blocks);
        else
          blocksError = blocks.error();
        break;
      }
      case 6: {
        if (!wanted.has(FileKind::curves)) break;
        const std::vector<CurveLayer> layers = curvesOf(e);
        std::vector<geometry::NamedCurve> all;
        for (const CurveLayer& layer : layers)
          for (const geometry::NamedCurve& curve : layer.curves)
            all.push_back({layer.name + " " + curve.name, curve.points, layer.name});
        Result<std::string> step = geometry::curvesStepText(all, "curves");
        if (step)
          texts[7] = std::move(*step);
        else
          curvesError = step.error();
        texts[8] = dxfText(layers);
        break;
      }
      case 5:
        if (workshop) {
          Result<std::string> drawings = drawingsOf(e, run, programs.paths(), wanted, context);
          if (drawings)
            texts[6] = std::move(*drawings);
          else
            drawingsError = drawings.error();
        }
        break;
      default:
        texts[4] = sweepJson(strips, run);
        break;
    }
  };
  if (Result<void> ok = parallelFor(context, 8, body); !ok) return tl::unexpected<Error>(ok.error());
  if (stepError) return tl::unexpected<Error>(*stepError);
  if (partsError) return tl::unexpected<Error>(*partsError);
  if (blocksError) return tl::unexpected<Error>(*blocksError);
  if (drawingsError) return tl::unexpected<Error>(*drawingsError);
  if (curvesError) return tl::unexpected<Error>(*curvesError);
  FileSet files;
  files.add("sweep.json", std::move(texts[4]));
  if (wanted.has(FileKind::surface)) files.add("surface.step", std::move(texts[0]));
  if (!texts[5].empty()) files.add("parts.step", std::move(texts[5]));
  if (!texts[9].empty()) files.add("blocks.step", std::move(texts[9]));
  if (workshop) {
    files.add("drawings.pdf", std::move(texts[6]));
    files.add("cut-list.csv", cutListCsv(e, wanted));
  }
  if (wanted.has(FileKind::meshes)) files.add("mesh.obj", std::move(texts[1]));
  if (wanted.has(FileKind::curves)) {
    files.add("curves.step", std::move(texts[7]));
    files.add("curves.dxf", std::move(texts[8]));
  }
  if (wanted.has(FileKind::tables)) {
    files.add("stations.csv", std::move(texts[3]));
    files.add("deviation.csv", std::move(texts[2]));
  }
  files.append(std::move(programs), {});
  const Result<Design> stored = storedDesign(e);
  if (!stored) return tl::unexpected<Error>(stored.error());
  files.add(kDesignFile, designToJson(*stored));
  if (policy.more) {
    Result<FileSet> further = policy.more(e, files.paths());
    if (!further) return tl::unexpected<Error>(further.error());
    files.append(std::move(*further), {});
  }
  e.seconds.write = std::chrono::duration<double>(Clock::now() - start).count();
  e.seconds.total += e.seconds.write;
  files.add("report.json", reportJson(e, run, files, policy.reader));
  return files;
}

}  // namespace bw::pipeline
