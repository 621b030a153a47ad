// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A design over the range of one of its variables: a table, and a small picture of each.

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "bw/core/design/variables.h"
#include "bw/core/files/file_set.h"
#include "bw/core/text/number_text.h"
#include "bw/core/text/printable.h"
#include "bw/core/text/typed_number.h"
#include "bw/pipeline/scene_content.h"
#include "bw/pipeline/vary.h"
#include "sets.h"
#include "verbs.h"

namespace bw::cli {

namespace fs = std::filesystem;

namespace {

constexpr int kLeast = pipeline::VaryRange::kLeast, kMost = pipeline::VaryRange::kMost;  // values
constexpr int kPictureWidth = 480, kPictureHeight = 320;                                 // pixels

struct VaryOptions {
  std::string file, out, over;
  int count = 7;
  std::vector<std::string> sets;
  bool noPictures = false;
};

/// A variable and the range in which it is varied.
struct Range {
  std::string name;
  double from = 0, to = 0;
};

Result<Range> rangeOf(const Design& design, const std::string& text) {
  const auto wrong = [&](const std::string& why) {
    return fail(ErrorCode::badInput, "--over " + text + ": " + why, "over");
  };
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const auto variable = std::ranges::find(design.variables, name, &Variable::name);
  if (variable == design.variables.end()) {
    std::string names;
    for (const Variable& each : design.variables) names += (names.empty() ? "" : ", ") + each.name;
    return wrong("the design has no variable \"" + name + "\"; " +
                 (names.empty() ? "it has none" : "it has " + names));
  }
  Range range{name, variable->min, variable->max};
  if (equals == std::string::npos) return range;
  const std::string values = text.substr(equals + 1);
  const std::size_t colon = values.find(':');
  if (colon == std::string::npos) return wrong("a range is FROM:TO, such as 10:40");
  const Result<double> from = readTypedNumber(values.substr(0, colon), {variable->unit});
  const Result<double> to = readTypedNumber(values.substr(colon + 1), {variable->unit});
  if (!from) return wrong(from.error().message);
  if (!to) return wrong(to.error().message);
  range.from = *from;
  range.to = *to;
  for (const double value : {range.from, range.to})
    if (!(value >= variable->min && value <= variable->max))
      return wrong(shortText(value, 6) + " is not between " + shortText(variable->min, 6) + " and " +
                   shortText(variable->max, 6) + ", as the design says of it");
  if (range.from == range.to) return wrong("both ends are the same; use blade design --set for one value");
  return range;
}

Result<std::string> pictureOf(const pipeline::Evaluation& e) {
  scene::Scene scene;
  scene.setContent(pipeline::sceneContent(e));
  scene::Style style;
  style[scene::Kind::cut].map = "deviation";
  style.tolerance = e.design.process.tolerance;
  scene.setStyle(style);
  scene.setCamera(
      scene.fitFrom(scene::directionOf(scene::View::iso), false, {kPictureWidth, kPictureHeight}));
  const Result<scene::Picture> picture = scene.render(kPictureWidth, kPictureHeight);
  return picture ? scene::pngBytes(*picture) : Result<std::string>(tl::unexpected<Error>(picture.error()));
}

/// The pictures that an earlier run left in a folder.
std::vector<fs::path> picturesIn(const fs::path& folder) {
  std::vector<fs::path> pictures;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool numbered = name.size() >= 11 && name.starts_with("vary-") && name.ends_with(".png") &&
                          name.find_first_not_of("0123456789", 5) == name.size() - 4;
    if (numbered && entry.is_regular_file(error)) pictures.push_back(entry.path());
  }
  return pictures;
}

int runVary(const Session& session, const VaryOptions& options) {
  Result<Design> design = session.openDesign(options.file);
  if (design) design = withSets(*design, options.sets);
  if (!design) return session.complain(design.error());
  const Result<Range> range = rangeOf(*design, options.over);
  if (!range) return session.complain(range.error());
  if (options.count < kLeast || options.count > kMost)
    return session.complain({ErrorCode::badInput,
                             "--count must be between " + std::to_string(kLeast) + " and " +
                                 std::to_string(kMost) + ", not " + std::to_string(options.count),
                             "count", double(options.count), double(kMost)});
  if (const Result<void> ok = session.mayWriteInto(options.out); !ok) return session.complain(ok.error());
  for (const std::string& set : options.sets)
    if (set.substr(0, set.find('=')) == range->name)
      return session.complain({ErrorCode::badInput,
                               "--set gives " + range->name + ", which --over varies; keep one of them",
                               "set"});
  FileSet files;
  const std::string head = pipeline::varyHead(range->name);
  std::string table = head + "\n";
  const RunContext context = session.context();
  bool allGood = true;
  int number = 0;
  const Result<void> varied = pipeline::vary(
      *design, {range->name, range->from, range->to, options.count}, context,
      [&](const pipeline::Variation& variation, const pipeline::Evaluation* evaluation) -> Result<void> {
        const std::string line = pipeline::varyLine(variation);
        table += line + "\n";
        allGood = allGood && variation.good;
        session.endProgress();
        if (number == 0) std::cerr << range->name << ": " << head.substr(head.find(',') + 1) << "\n";
        std::cerr << range->name << " = " << shortText(variation.value, 6) << ": "
                  << line.substr(line.find(',') + 1) << "\n";
        ++number;
        if (options.noPictures || !evaluation) return {};
        const Result<std::string> png = pictureOf(*evaluation);
        if (!png) return tl::unexpected<Error>(png.error());
        std::ostringstream name;
        name << "vary-" << (number < 10 ? "0" : "") << number << ".png";
        files.add(name.str(), *png);
        return {};
      });
  if (!varied) return session.complain(varied.error());
  files.add("vary.csv", table);
  std::vector<fs::path> earlier = picturesIn(options.out);
  std::erase_if(earlier, [&](const fs::path& file) {
    return std::ranges::find(files.paths(), file.filename()) != files.paths().end();
  });
  const Interrupt::Commit commit;
  if (const Result<void> ok = files.commit(options.out, context); !ok) return session.complain(ok.error());
  std::error_code ignored;
  for (const fs::path& file : earlier)
    if (fs::remove(file, ignored)) std::cerr << "removed " << printable(file.string()) << "\n";
  std::cerr << "wrote " << files.paths().size() << (files.paths().size() == 1 ? " file" : " files") << " to "
            << printable(options.out) << "\n";
  return allGood ? kDone : kLimitExceeded;
}

}  // namespace

void addVaryVerb(CLI::App& app, const Session& session, Work& work) {
  CLI::App* verb =
      app.add_subcommand("vary", "A design over the range of a variable: a table and small pictures");
  const auto options = std::make_shared<VaryOptions>();
  verb->add_option("DESIGN", options->file, "A .bladewright file")->required();
  verb->add_option("--over", options->over, "The variable, and from where to where; else its whole range")
      ->type_name("NAME[=FROM:TO]")
      ->required();
  verb->add_option("--count", options->count, "How many values, both ends among them (7)")->type_name("N");
  verb->add_option("--set", options->sets, "Give another variable a value; repeatable")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  verb->add_flag("--no-pictures", options->noPictures, "Only the table");
  verb->add_option("--out", options->out, "Folder for vary.csv and the pictures")
      ->type_name("DIR")
      ->required();
  verb->footer(
      "Example:\n  blade vary ripple.bladewright --over amplitude=10:30 --count 5 --out out/ripples");
  onChosen(*verb, session, work, options, runVary);
}

}  // namespace bw::cli
