// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Cuts of a design told by key blades.

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "bw/core/base/units.h"
#include "bw/core/shape/surface_blades.h"
#include "bw/core/shape/turning_planes.h"
#include "bw/core/text/number_text.h"
#include "bw/pipeline/key_blades.h"
#include "verbs.h"

namespace bw::cli {

namespace fs = std::filesystem;

namespace {

struct KeysOptions {
  std::string file, out, cut;
  double tolerance = 0;  ///< mm; 0: a quarter of the design's
  bool adopt = false;
};

/// What became of planes that turned.
std::string planesText(const pipeline::CutKeyBlades& keys) {
  const std::string now = planesOf(keys.surface) ? "in planes that turn" : "in parallel planes";
  const double off = toDegrees(keys.turnedOff);
  if (off < 0.005) return "; " + now + " as those before";
  return "; " + now + ", up to " + shortText(off, 2) + "° off those before";
}

int runKeys(const Session& session, const KeysOptions& options) {
  const Result<Design> opened = session.openDesign(options.file);
  if (!opened) return session.complain(opened.error());
  if (Result<void> ok = session.mayWriteDesign(options.out); !ok) return session.complain(ok.error());
  if (!options.cut.empty() && std::ranges::find(opened->cuts, options.cut, &Cut::id) == opened->cuts.end())
    return session.complain(
        {ErrorCode::badInput, "there is no cut \"" + options.cut + "\" in the design", "cut"});
  const double tolerance =
      options.tolerance > 0 ? options.tolerance : kKeyBladeShare * opened->process.tolerance;
  pipeline::Outcome outcome = pipeline::evaluate(*opened, nullptr, session.context());
  if (session.stop.stop_requested()) return session.complain(stoppedError().value());
  bool any = false, within = true;
  Design design = *opened;
  for (const pipeline::BlockEvaluation& block : outcome.evaluation.blocks)
    for (const pipeline::CutEvaluation& cut : block.cuts) {
      if (!options.cut.empty() && cut.id != options.cut) continue;
      if (!(options.adopt ? bool(cut.sweep.value) : bool(cut.sections.value)) && outcome.error)
        return session.complain(*outcome.error);
      const Result<pipeline::CutKeyBlades> keys = pipeline::keyBladesOf(
          cut, options.adopt ? pipeline::Told::cut : pipeline::Told::target, tolerance, session.context());
      if (!keys) return session.complain(keys.error());
      outcome.evaluation.design = design;
      Result<Design> changed = pipeline::withSurface(outcome.evaluation, cut.id, keys->surface);
      if (!changed) return session.complain(changed.error());
      design = std::move(*changed);
      any = true;
      const bool near = keys->deviation <= tolerance;
      within = within && near;
      session.endProgress();
      std::cerr << cut.id << ": " << std::get<BladesSurface>(keys->surface.shape).blades.size()
                << " key blades for " << cut.sections.value->size()
                << (options.adopt ? " blades, within " : " sections, within ") << shortText(keys->deviation)
                << " mm (the farthest at y = " << shortText(keys->worst, 6) << ")";
      if (cut.setup && cut.setup->planes.turns()) std::cerr << planesText(*keys);
      if (!near)
        std::cerr << ", more than " << shortText(tolerance) << " mm, as near as the elastica fitted to each "
                  << (options.adopt ? "blade" : "section") << " comes";
      std::cerr << "\n";
    }
  if (!any)
    return session.complain({ErrorCode::badInput,
                             "the blade meets none of the cuts that are asked for; see blade design", "cut"});
  if (const Result<void> ok = session.writeDesign(std::move(design), options.out); !ok)
    return session.complain(ok.error());
  return within ? kDone : kLimitExceeded;
}

}  // namespace

void addKeysVerb(CLI::App& app, const Session& session, Work& work) {
  CLI::App* verb = app.add_subcommand(
      "keys",
      "A design with the surfaces of its cuts told by the fewest key blades, between which all is elastica");
  const auto options = std::make_shared<KeysOptions>();
  verb->add_option("DESIGN", options->file, "A .bladewright file")->required();
  verb->add_option("--cut", options->cut, "Only that cut; else all of them")->type_name("ID");
  verb->add_flag("--adopt", options->adopt,
                 "Of the surfaces that the blades cut, in place of those asked for");
  verb->add_option("--tolerance", options->tolerance,
                   "mm between the blades and the sections (a quarter of the design's tolerance)")
      ->check(CLI::Range(1e-3, 1e3))
      ->type_name("MM");
  verb->add_option("--out", options->out, "The design that is written")->type_name("DESIGN")->required();
  verb->footer("Example:\n  blade keys bump.bladewright --tolerance 0.5 --out bump-keys.bladewright");
  onChosen(*verb, session, work, options, runKeys);
}

}  // namespace bw::cli
