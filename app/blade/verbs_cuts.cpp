// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The cuts of a design as one table.

#include <iostream>

#include "bw/core/design/cut_table.h"
#include "verbs.h"

namespace bw::cli {

namespace {

struct CutsOptions {
  std::string file, table, out = "-", format = "csv";
};

int runCuts(const Session& session, const CutsOptions& options) {
  const Result<Design> design = session.openDesign(options.file);
  if (!design) return session.complain(design.error());
  const auto finish = [&session](const Result<void>& ok) {
    return ok ? int(kDone) : session.complain(ok.error());
  };
  if (options.table.empty()) {
    if (options.out.ends_with(kDesignSuffix))
      return session.complain(
          {ErrorCode::badInput,
           options.out + " would be a design, but no table was given to put into it; give --table, or --out "
                         "a name for the table",
           "out"});
    const bool json = options.format == "json";
    return finish(session.writeOutput(options.out, json ? cutTableJson(*design) : cutTableCsv(*design)));
  }
  if (!options.out.ends_with(kDesignSuffix))
    return session.complain({ErrorCode::badInput,
                             "with --table a design is written; give --out a name that ends in .bladewright",
                             "out"});
  const Result<std::string> text = session.readInput(options.table);
  if (!text) return session.complain(text.error());
  Result<Design> made = withCutTable(*design, *text);
  if (!made) {
    Error error = made.error();
    error.message = options.table + ": " + error.message;
    return session.complain(error);
  }
  return finish(session.writeDesign(std::move(*made), options.out));
}

}  // namespace

void addCutsVerb(CLI::App& app, const Session& session, Work& work) {
  CLI::App* verb =
      app.add_subcommand("cuts", "The cuts of a design as a table, or a design with those of one");
  const auto options = std::make_shared<CutsOptions>();
  verb->add_option("DESIGN", options->file, "A .bladewright file")->required();
  verb->add_option("--table", options->table,
                   "Table (CSV or JSON) of the cuts that the design is to have, - for standard input")
      ->type_name("TABLE");
  verb->add_option("--format", options->format, "Of the table that is written")
      ->check(CLI::IsMember({"csv", "json"}))
      ->type_name("csv|json");
  verb->add_option("--out", options->out,
                   "File for the table, - for standard output; with --table, the design that is written")
      ->type_name("FILE");
  verb->footer(
      "Example:\n  blade cuts block.bladewright --out cuts.csv\n"
      "  blade cuts block.bladewright --table cuts.csv --out changed.bladewright");
  onChosen(*verb, session, work, options, runCuts);
}

}  // namespace bw::cli
