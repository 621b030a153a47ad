// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "bw/core/base/units.h"
#include "bw/core/design/design.h"
#include "bw/core/text/number_text.h"
#include "bw/geometry/cad_model.h"
#include "verbs.h"

namespace bw::cli {

using nlohmann::ordered_json;

namespace {

struct InfoOptions {
  std::string file, unit, out = "-";
  double sewing = ReadOptions::kMostSewing;
};

ordered_json vec(const Eigen::Vector3d& v) { return {v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}; }

ordered_json boundsJson(const Bounds& b) {
  return b.valid() ? ordered_json{{"min", vec(b.min)}, {"max", vec(b.max)}} : ordered_json(nullptr);
}

/// A radius in mm; null where there is no curvature.
ordered_json radiusJson(double radius) { return radius > 0 ? ordered_json(radius) : ordered_json(nullptr); }

ordered_json faceJson(const geometry::FaceInfo& face) {
  ordered_json object = {{"index", face.index},
                         {"type", face.type},
                         {"bounds_mm", boundsJson(face.bounds)},
                         {"size_mm", vec(face.bounds.size())},
                         {"area_mm2", face.area},
                         {"curvature_range", {face.curvatureMin, face.curvatureMax}},
                         {"name", face.name.empty() ? ordered_json(nullptr) : ordered_json(face.name)},
                         {"group", face.group < 0 ? ordered_json(nullptr) : ordered_json(face.group)},
                         {"curved", face.curved.empty() ? ordered_json(nullptr) : ordered_json(face.curved)},
                         {"min_radius_mm", radiusJson(face.minRadius)}};
  ordered_json sections = ordered_json::array();
  for (const geometry::FaceSections& s : face.sections)
    sections.push_back({{"direction", vec(s.direction)},
                        {"lengths_mm", {s.shortest, s.longest}},
                        {"min_radius_mm", radiusJson(s.minRadius)}});
  object["sections"] = sections;
  return object;
}

Result<ReadOptions> readOptions(const InfoOptions& options) {
  if (!std::isfinite(options.sewing))
    return fail(ErrorCode::badInput, "--sewing is no number of mm; give one from 0 to 100", "sewing");
  // The words and limits are those of a job.
  ordered_json job = {{"sewing", options.sewing}};
  if (!options.unit.empty()) job["unit"] = options.unit;
  const Result<Design> parsed = parseJob(job.dump());
  if (!parsed) return tl::unexpected<Error>(parsed.error());
  return parsed->readOptions(parsed->source());
}

int runInfo(const Session& session, const InfoOptions& options) {
  const Result<ReadOptions> how = readOptions(options);
  if (!how) return session.complain(how.error());
  const Result<geometry::CadModel> model = geometry::CadModel::read(options.file, session.context(), *how);
  if (!model) return session.complain(model.error());
  const Result<geometry::CadInfo> full = model->infoInFull(session.context());
  if (!full) return session.complain(full.error());
  const geometry::CadInfo& info = *full;
  ordered_json object = {{"file", options.file},
                         {"format", info.format},
                         {"unit", info.unit},
                         {"read_as", info.readAs},
                         {"solids", info.solids},
                         {"shells", info.shells},
                         {"faces", info.faces},
                         {"edges", info.edges},
                         {"bounds_mm", boundsJson(info.bounds)},
                         {"healing", info.healing},
                         {"left_out", info.leftOut},
                         {"sewing_mm", info.sewing},
                         {"curved_tolerance_mm", geometry::kCurvedTolerance},
                         {"smooth_join_deg", toDegrees(geometry::kSmoothJoin)}};
  ordered_json faces = ordered_json::array();
  for (const geometry::FaceInfo& face : info.faceList) faces.push_back(faceJson(face));
  object["face_list"] = faces;
  ordered_json groups = ordered_json::array();
  for (const geometry::FaceGroup& group : info.groups)
    groups.push_back({{"index", group.index},
                      {"faces", group.faces},
                      {"area_mm2", group.area},
                      {"bounds_mm", boundsJson(group.bounds)}});
  object["groups"] = groups;
  session.endProgress();
  const Result<void> ok = session.writeOutput(
      options.out, object.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n");
  return ok ? int(kDone) : session.complain(ok.error());
}

}  // namespace

void addInfoVerb(CLI::App& app, const Session& session, Work& work) {
  CLI::App* verb = app.add_subcommand(
      "info", "What a CAD file holds: unit, faces, sizes, curvature, sections, groups, healing");
  const auto options = std::make_shared<InfoOptions>();
  verb->add_option("FILE", options->file, "STEP, IGES or BREP file")->required();
  verb->add_option("--unit", options->unit, "Take the numbers of the file as mm, cm, m or in")
      ->type_name("UNIT");
  verb->add_option("--sewing", options->sewing, "Join open edges of faces within this many mm")
      ->type_name("MM");
  verb->add_option("--out", options->out, "Output file, - for standard output")->type_name("FILE");
  verb->footer("Example:\n  blade info panel.step");
  onChosen(*verb, session, work, options, runInfo);
}

}  // namespace bw::cli
