// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The named versions of a design: told, added, taken and removed.

#include <iostream>
#include <nlohmann/json.hpp>

#include "bw/core/design/design_difference.h"
#include "bw/core/design/design_versions.h"
#include "bw/core/text/printable.h"
#include "verbs.h"

namespace bw::cli {

using nlohmann::ordered_json;

namespace {

struct VersionsOptions {
  std::string file, name, take, drop, out, format = "text";
};

/// The versions, each with its differences: then, and now.
std::string versionsText(const Design& design, const std::string& file) {
  std::string text = printable(file) + ": " + counted(design.versions.size(), "version") + "\n";
  for (const NamedVersion& version : design.versions) {
    const std::vector<DesignDifference> all = differences(*version.design, design);
    text += printable(version.name) + ": " +
            (all.empty() ? std::string("as the present state")
                         : counted(all.size(), "difference") + " to the present state") +
            "\n";
    for (const DesignDifference& d : all)
      text += "  " + printable(sentenceOf(d)) + "  (" + printable(d.pointer) + ")\n";
  }
  return text;
}

std::string versionsJson(const Design& design) {
  ordered_json list = ordered_json::array();
  for (const NamedVersion& version : design.versions) {
    ordered_json told = ordered_json::array();
    for (const DesignDifference& d : differences(*version.design, design))
      told.push_back({{"pointer", d.pointer}, {"what", d.what}, {"then", d.before}, {"now", d.after}});
    list.push_back({{"name", version.name}, {"differences", told}});
  }
  return ordered_json{{"versions", list}}.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

int runVersions(const Session& session, const VersionsOptions& options) {
  const auto finish = [&session](const Result<void>& ok) {
    return ok ? int(kDone) : session.complain(ok.error());
  };
  const int asked = int(!options.name.empty()) + int(!options.take.empty()) + int(!options.drop.empty());
  if (asked > 1)
    return session.complain(
        {ErrorCode::badInput, "--name, --take and --drop are three things to do; give one of them", "usage"});
  if (!options.out.empty() && asked == 0)
    return session.complain(
        {ErrorCode::badInput,
         "versions are listed on standard output; --out goes with --name, --take or --drop", "out"});
  if (!options.take.empty() && options.out.empty())
    return session.complain({ErrorCode::badInput,
                             "--take writes another design; give --out a name that ends in .bladewright",
                             "out"});
  if (!options.out.empty())
    if (Result<void> ok = session.mayWriteDesign(options.out); !ok) return session.complain(ok.error());
  const Result<Design> design = session.openDesign(options.file);
  if (!design) return session.complain(design.error());
  if (asked == 0) {
    std::cout << (options.format == "json" ? versionsJson(*design) : versionsText(*design, options.file));
    return kDone;
  }
  Result<Design> made = !options.name.empty()   ? withVersion(*design, options.name)
                        : !options.take.empty() ? atVersion(*design, options.take)
                                                : withoutVersion(*design, options.drop);
  if (!made) return session.complain(made.error());
  return finish(session.writeDesign(std::move(*made), options.out.empty() ? options.file : options.out));
}

}  // namespace

void addVersionsVerb(CLI::App& app, const Session& session, Work& work) {
  CLI::App* verb = app.add_subcommand(
      "versions", "The named versions of a design: what differs, and to name, take or remove one");
  const auto options = std::make_shared<VersionsOptions>();
  verb->add_option("DESIGN", options->file, "A .bladewright file")->required();
  verb->add_option("--name", options->name, "Add the present state as a version of that name")
      ->type_name("NAME");
  verb->add_option("--take", options->take, "Write the design as it was in that version")->type_name("NAME");
  verb->add_option("--drop", options->drop, "Remove that version")->type_name("NAME");
  verb->add_option("--out", options->out,
                   "The design that is written; without it --name and --drop write DESIGN itself")
      ->type_name("DESIGN");
  verb->add_option("--format", options->format, "Of the list")
      ->check(CLI::IsMember({"text", "json"}))
      ->type_name("text|json");
  verb->footer(
      "Example:\n  blade versions panel.bladewright\n"
      "  blade versions panel.bladewright --name \"as ordered\"\n"
      "  blade versions panel.bladewright --take \"as ordered\" --out ordered.bladewright");
  onChosen(*verb, session, work, options, runVersions);
}

}  // namespace bw::cli
