// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Two moulds for each panel of a design.

#include <filesystem>
#include <iostream>

#include "bw/core/text/typed_number.h"
#include "bw/pipeline/moulds.h"
#include "verbs.h"

namespace bw::cli {

namespace fs = std::filesystem;

namespace {

struct MouldsOptions {
  std::string file, out;
  std::string thickness;  ///< as it was typed
};

int runMoulds(const Session& session, const MouldsOptions& options) {
  const Result<Design> opened = session.openDesign(options.file);
  if (!opened) return session.complain(opened.error());
  if (Result<void> ok = session.mayWriteDesign(options.out); !ok) return session.complain(ok.error());
  const Result<double> thickness = readTypedNumber(options.thickness, {"mm"});
  if (!thickness)
    return session.complain({ErrorCode::badInput, "--thickness: " + thickness.error().message, "thickness"});
  const pipeline::Outcome outcome = pipeline::evaluate(*opened, nullptr, session.context());
  if (outcome.error) return session.complain(*outcome.error);
  Result<Design> design = pipeline::withUpperMoulds(outcome.evaluation, *thickness);
  if (!design) return session.complain(design.error());
  session.endProgress();
  std::cerr << counted(design->stock.size() - opened->stock.size(), "upper mould") << " for "
            << counted(opened->stock.size(), "block") << "\n";
  if (const int lost = pipeline::gridExpressions(*opened); lost > 0)
    std::cerr << "warning: the blocks lie in no grid any more: " << counted(std::size_t(lost), "number")
              << " of it that expressions told " << (lost == 1 ? "stands" : "stand")
              << " as computed; make the moulds anew when a variable changes\n";
  const Result<void> ok = session.writeDesign(std::move(*design), options.out);
  return ok ? int(kDone) : session.complain(ok.error());
}

}  // namespace

void addMouldsVerb(CLI::App& app, const Session& session, Work& work) {
  CLI::App* verb = app.add_subcommand(
      "moulds", "A design with a second block for each of its blocks: two moulds for a panel between them");
  const auto options = std::make_shared<MouldsOptions>();
  verb->add_option("DESIGN", options->file, "A .bladewright file")->required();
  verb->add_option("--thickness", options->thickness,
                   "Of the panel, mm or with a unit (3cm); its middle is the surface")
      ->type_name("LENGTH")
      ->required();
  verb->add_option("--out", options->out, "The design that is written")->type_name("DESIGN")->required();
  verb->footer("Example:\n  blade moulds bump.bladewright --thickness 30 --out bump-moulds.bladewright");
  onChosen(*verb, session, work, options, runMoulds);
}

}  // namespace bw::cli
