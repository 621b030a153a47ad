// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/design.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "bw/core/blade/blade_json.h"
#include "bw/core/blade/blade_numbers.h"
#include "bw/core/design/design_versions.h"
#include "bw/core/design/process_numbers.h"
#include "bw/core/design/program_formats.h"
#include "bw/core/files/file_set.h"
#include "bw/core/text/base64.h"
#include "bw/core/text/number_text.h"
#include "design/design_keys.h"
#include "design/grid_cuts.h"

namespace bw {

namespace {

constexpr std::array<ProcessNumber, 13> kNumbers = {{
    {{&Process::tolerance, "tolerance", "Tolerance", "mm", 1e-4, 1000, 1e-3, 3, 0.1,
      "Largest deviation of the cut surface that is accepted", "Change tolerance"},
     ProcessPart::setup},
    {{&Process::clearance, "clearance", "Clearance", "mm", 0, 10000, 0, 1, 5,
      "Between a grip of the blade and the block", "Change clearance"},
     ProcessPart::setup},
    {{&Process::floor, "floor", "Floor", "mm", 0, 10000, 0, 1, 5,
      "Between the whole blade and the face that its block lies on, where the block is given",
      "Change floor"},
     ProcessPart::setup},
    {{&Process::cuttingSpeed, "cutting_speed", "Cutting speed", "mm/s", 0.01, 1000, 0.01, 2, 1,
      "Of the fastest point of the blade", "Change cutting speed"},
     ProcessPart::process},
    {{&Process::kerf, "kerf", "Kerf", "mm", 0, 50, 0, 2, 0.1,
      "Width of foam that the blade melts away: its middle keeps half of it off the surface", "Change kerf"},
     ProcessPart::process},
    {{&Process::maxPeriods, "max_periods", "Most waves", "", 0.05, 10, 0.1, 2, 0.1,
      "Periods of the elastica that the blade may span; more than one is hard to hold", "Change most waves"},
     ProcessPart::details,
     "fit"},
    {{&Process::margin, "margin", "Stability margin", "", 0, 1, 0, 2, 0.05,
      "How firmly blades rest at least: 1 for a straight one, 0 where it is about to snap",
      "Change stability margin"},
     ProcessPart::details},
    {{&Process::motionTolerance, "motion_tolerance", "Motion tolerance", "mm", 1e-3, 100, 1e-2, 3, 0.05,
      "Between the blade as the robots move it and the surface shown; targets are added until it holds",
      "Change motion tolerance"},
     ProcessPart::details},
    {{&Process::lead, "lead", "Lead", "mm", 0, 10000, 0, 2, 5, "Straight travel before and after the block",
      "Change lead"},
     ProcessPart::details},
    {{&Process::gripError, "grip_error", "Grip error", "mm", 0, 100, 0, 2, 0.1,
      "How far a grip may be off: the map of grip errors shows what that does to the cut",
      "Change grip error"},
     ProcessPart::details},
    {{&Process::gripAngle, "grip_angle_error", "Grip turn", "°", 0, 10, 0, 2, 0.1,
      "How far a grip may be turned besides", "Change grip turn"},
     ProcessPart::details},
    {{&Process::jointGap, "gap_mm", "Joint gap", "mm", 0, 100, 0, 2, 0.05,
      "Between the surfaces of neighbouring blocks at their boundary; told where it is more",
      "Change joint gap"},
     ProcessPart::details,
     "join"},
    {{&Process::jointKink, "kink_deg", "Joint kink", "°", 0, 90, 0, 2, 0.1,
      "Between these surfaces there; told where it is more", "Change joint kink"},
     ProcessPart::details,
     "join"},
}};

}  // namespace

std::span<const ProcessNumber> processNumbers() { return kNumbers; }

namespace {

constexpr std::array<ProgramFormat, 3> kFormats = {
    {{"rapid", "ABB RAPID", "MultiMove program for two robots"},
     {"csv", "CSV", "One row an instant: position and rotation of both blade ends"},
     {"json", "JSON", "The same with full precision, for scripts"}}};

}  // namespace

std::span<const ProgramFormat> programFormats() { return kFormats; }

const ProgramFormat* programFormat(std::string_view word) {
  const auto found = std::ranges::find_if(kFormats, [&](const ProgramFormat& f) { return word == f.word; });
  return found == kFormats.end() ? nullptr : &*found;
}

std::string programFormatWords(const char* last) {
  std::string words = kFormats.front().word;
  for (std::size_t i = 1; i < kFormats.size(); ++i)
    words += (i + 1 == kFormats.size() ? last : ", ") + std::string(kFormats[i].word);
  return words;
}

std::string nearestProgramFormat(const std::string& word) {
  std::vector<std::string> words;
  for (const ProgramFormat& format : kFormats) words.push_back(format.word);
  return nearestWord(word, words.data(), int(words.size()));
}

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// The key "base64_as" of a version: an embedded file that stands in the document already.
void readSharedFile(ObjectReader& reader, const detail::EmbeddedFiles& files, SharedBytes& bytes) {
  std::string word;
  reader.text("base64_as", word);
  if (!reader.has("base64_as")) return;
  if (reader.has("base64"))
    return reader.complain("base64_as",
                           reader.path() + " has its file twice, by base64 and by base64_as; keep one");
  if (const auto found = files.find(word); found != files.end()) {
    bytes = found->second;
    return;
  }
  std::string all;
  for (const auto& [name, file] : files) all += (all.empty() ? "\"" : ", \"") + name + "\"";
  reader.complain("base64_as", reader.path() + ".base64_as names \"" + word + "\", " +
                                   (all.empty() ? "but no CAD file is embedded before it"
                                                : "but before it there is " + all));
}

/// The file of a source, and what it was. In a version it may be one of `files`.
void readFileKeys(ObjectReader& reader, Source& source, const detail::EmbeddedFiles* files) {
  std::string path, base64, fingerprint;
  reader.text("path", path);
  reader.text("base64", base64);
  reader.text("fingerprint", fingerprint);
  source.path = path;
  if (files) readSharedFile(reader, *files, source.bytes);
  const bool isShared = !source.bytes.empty();
  if (std::optional<std::string> bytes = fromBase64(std::move(base64)); bytes && !isShared)
    source.bytes = std::move(*bytes);
  else if (!bytes)
    reader.complain("base64", reader.path() + ".base64 is damaged; embed the CAD file again");
  source.saved = fingerprintFrom(fingerprint);
  if (!source.saved && !fingerprint.empty())
    reader.complain("fingerprint",
                    reader.path() + ".fingerprint is damaged; remove it or save the design again");
}

/// The settings of a design with one cut, in one object. Designs that were written before have `threads`.
Result<Design> jobFromJson(const json& object, const std::string& path, int& threads) {
  Design design;
  ObjectReader reader(object, path);
  detail::readSourceKeys(reader, design.source());
  detail::readPlacement(reader, design.block());
  detail::readCutKeys(reader, design.cut());
  if (Result<void> ok = detail::readBladeKeys(reader, object, design.blade); !ok)
    return tl::unexpected<Error>(ok.error());
  detail::readProcessKeys(reader, design.process);
  detail::readOutputKeys(reader, design.output);
  reader.integer("threads", threads, 0, 1024);
  if (Result<void> ok = reader.finish(); !ok) return tl::unexpected<Error>(ok.error());
  return design;
}

/// A member that is an object, by its reader.
template <class Read>
void readPart(ObjectReader& reader, const char* key, const Read& read) {
  const json* value = reader.member(key);
  if (!value) return;
  ObjectReader inner(*value, reader.path() + "." + key, reader.scope());
  read(inner);
  reader.adopt(inner.finish());
}

/// A member that is a list of objects. Entries without an id have the first part's, numbered on.
template <class Part, class Read>
void readList(ObjectReader& reader, const char* key, const char* what, std::size_t most,
              std::vector<Part>& list, const Read& read) {
  const json* value = reader.member(key);
  if (!value) return;
  const std::string path = reader.path() + "." + key;
  if (!value->is_array() || value->empty() || value->size() > most)
    return reader.complain(
        key,
        path + " must be a list of 1 to " + std::to_string(most) + " entries" +
            (value->is_array() ? ", not of " + std::to_string(value->size()) : std::string()),
        value->is_array() ? std::optional(double(value->size())) : std::nullopt, double(most));
  std::set<std::string> ids;
  list.clear();
  for (std::size_t i = 0; i < value->size(); ++i) {
    const std::string entry = path + "[" + std::to_string(i) + "]";
    ObjectReader inner((*value)[i], entry, reader.scope());
    Part part;
    part.id = what + ("-" + std::to_string(i + 1));
    inner.text("id", part.id);
    read(inner, part);
    if (part.id.empty()) inner.complain("id", entry + ".id is empty; give it a name");
    if (!ids.insert(part.id).second)
      inner.complain("id", entry + ".id is \"" + part.id + "\", as that of another entry; give each its own");
    const bool good = reader.adopt(inner.finish());
    list.push_back(std::move(part));
    if (!good) return;
  }
}

/// A name that none of those parts has.
template <class Part>
void complainOf(ObjectReader& reader, const char* key, const std::string& id, const std::vector<Part>& parts,
                const char* what) {
  std::vector<std::string> ids;
  for (const Part& part : parts) ids.push_back(part.id);
  const std::string nearest = nearestWord(id, ids.data(), int(ids.size()));
  reader.complain(
      key, reader.path() + "." + key + " names \"" + id + "\", but the design has " +
               (ids.size() == 1 ? "\"" + ids.front() + "\"" : std::to_string(ids.size()) + " other " + what) +
               (nearest.empty() || ids.size() == 1 ? "" : "; did you mean \"" + nearest + "\"?"));
}

/// The key "source" of a cut: one of the sources, the first where it is left out.
void readSourceReference(ObjectReader& reader, const Design& design, std::string& id) {
  id = design.source().id;
  reader.text("source", id);
  if (!design.find(id)) complainOf(reader, "source", id, design.sources, "sources");
}

/// The key "block" of a cut: one of the blocks. Left out it is the only one, or under a grid each of them.
void readBlockReference(ObjectReader& reader, const Design& design, Cut& cut) {
  const bool given = reader.has("block");
  cut.block = design.grid || design.stock.size() > 1 ? std::string() : design.block().id;
  reader.text("block", cut.block);
  if (!given && design.grid) return;
  if (!given && cut.block.empty())
    return reader.complain("block", reader.path() + " needs the key block: the id of one of the " +
                                        std::to_string(design.stock.size()) + " blocks");
  if (std::ranges::find(design.stock, cut.block, &StockBlock::id) != design.stock.end()) return;
  complainOf(reader, "block", cut.block, design.stock, "blocks");
}

/// The blocks: those of a list, or those of a grid.
void readStock(ObjectReader& reader, Design& design) {
  detail::readGrid(reader, design.grid);
  if (!design.grid)
    return readList(reader, "stock", "block", std::size_t(Design::kMostBlocks), design.stock,
                    detail::readPlacement);
  if (reader.member("stock"))
    reader.complain("stock",
                    reader.path() + " tells its blocks twice, by grid and by stock; keep one of them");
  design.stock = stockOf(*design.grid);
}

void readCuts(ObjectReader& reader, Design& design) {
  std::vector<Cut> list = {{}};
  list.front().source = design.source().id;
  list.front().block = design.grid ? std::string() : design.block().id;
  readList(reader, "cuts", "cut", std::size_t(Design::kMostCuts), list, [&](ObjectReader& inner, Cut& cut) {
    readSourceReference(inner, design, cut.source);
    readBlockReference(inner, design, cut);
    detail::readCutKeys(inner, cut);
    detail::readBlockCutKeys(inner, cut);
  });
  if (!design.grid) {
    design.cuts = std::move(list);
    return;
  }
  const auto own =
      std::stable_partition(list.begin(), list.end(), [](const Cut& cut) { return cut.block.empty(); });
  const auto tooMany = [&](std::size_t count) {
    if (count > std::size_t(Design::kMostCuts))
      reader.complain("cuts",
                      reader.path() + ".cuts come to " + std::to_string(count) +
                          " in the blocks of the grid; there may be " + std::to_string(Design::kMostCuts),
                      double(count), double(Design::kMostCuts));
    return count > std::size_t(Design::kMostCuts);
  };
  if (tooMany(std::size_t(own - list.begin()) * design.stock.size())) return;
  // One id for cuts of two blocks, "cut-A-b" of cut in A-b and of cut-A in b, would lose one of them.
  std::map<std::string, std::string> blocks;
  for (auto cut = list.begin(); cut != own; ++cut)
    for (const StockBlock& block : design.stock)
      if (const auto [other, isNew] = blocks.try_emplace(cut->id + "-" + block.id, block.id); !isNew)
        return reader.complain("cuts", reader.path() + ".cuts make \"" + other->first +
                                           "\" of the blocks \"" + other->second + "\" and \"" + block.id +
                                           "\"; call a cut or a block otherwise");
  design.cuts = cutsOf(design.stock, {list.begin(), own}, {own, list.end()});
  (void)tooMany(design.cuts.size());
}

/// Version 1: one source, and a job.
Result<Design> earlierDesign(ObjectReader& reader, const detail::EmbeddedFiles* files) {
  Design design;
  if (const json* job = reader.member("job")) {
    int threads = 0;  // of the machine that it was saved on
    Result<Design> read = jobFromJson(*job, reader.path() + ".job", threads);
    if (!read) return read;
    design = std::move(*read);
  }
  readPart(reader, "source", [&](ObjectReader& inner) { readFileKeys(inner, design.source(), files); });
  return design;
}

Result<Design> presentDesign(ObjectReader& reader, const json& object, const detail::EmbeddedFiles* files) {
  Design design;
  detail::readVariables(reader, design.variables);
  for (const Variable& variable : design.variables)
    reader.scope()->numbers.push_back({variable.name, variable.value});
  readList(reader, "sources", "source", std::size_t(Design::kMostSources), design.sources,
           [files](ObjectReader& inner, Source& source) {
             detail::readSurface(inner, source.surface);
             if (source.surface)
               for (const char* key : {"path", "base64", "base64_as", "fingerprint", "unit", "sewing"})
                 if (inner.has(key))
                   inner.complain(key, inner.path() + " has a surface of its own and the key " + key +
                                           " of a CAD file; keep one of them");
             readFileKeys(inner, source, files);
             detail::readSourceKeys(inner, source);
             detail::readCurveNames(inner, source);
             detail::readDrawing(inner, source);
           });
  for (std::size_t i = 1; i < design.sources.size(); ++i)
    if (!design.sources[i].surface)
      reader.complain("sources",
                      reader.path() + ".sources[" + std::to_string(i) +
                          "] is a CAD file; only the first source may be one: put all faces into one "
                          "file, or describe the others as surfaces");
  readStock(reader, design);
  readCuts(reader, design);
  if (Result<void> ok = detail::readBladeKeys(reader, object, design.blade); !ok)
    return tl::unexpected<Error>(ok.error());
  readPart(reader, "process", [&](ObjectReader& inner) { detail::readProcessKeys(inner, design.process); });
  readPart(reader, "output", [&](ObjectReader& inner) { detail::readOutputKeys(inner, design.output); });
  return design;
}

}  // namespace

std::vector<StockBlock> stockOf(const BlockGrid& grid) {
  std::vector<StockBlock> stock;
  for (BlockGrid::Cell& cell : grid.cells()) stock.push_back({std::move(cell.id), cell.placement});
  return stock;
}

std::vector<Cut> cutsOf(const std::vector<StockBlock>& stock, const std::vector<Cut>& each,
                        const std::vector<Cut>& own) {
  std::vector<Cut> cuts;
  std::map<std::string, std::size_t> places;
  const auto add = [&](const Cut& cut) {
    const auto [place, isNew] = places.try_emplace(cut.id, cuts.size());
    if (isNew)
      cuts.push_back(cut);
    else
      cuts[place->second] = cut;
  };
  for (const StockBlock& block : stock)
    for (Cut cut : each) {
      cut.id += "-" + block.id;
      cut.block = block.id;
      add(cut);
    }
  for (const Cut& cut : own) add(cut);
  return cuts;
}

bool NamedVersion::operator==(const NamedVersion& other) const {
  return name == other.name &&
         (design == other.design || (design && other.design && *design == *other.design));
}

const Source* Design::find(const std::string& id) const {
  const auto found = std::ranges::find(sources, id, &Source::id);
  return found == sources.end() ? nullptr : &*found;
}

ReadOptions Design::readOptions(const Source& of) const {
  return {of.unit, of.sewing.value_or(std::min(process.tolerance / 10, ReadOptions::kMostSewing))};
}

Result<Design> parseJob(std::string_view text, int* threads) {
  const Result<json> object = parseJsonText(text, "job");
  if (!object) return tl::unexpected<Error>(object.error());
  int unused = 0;
  return jobFromJson(*object, "job", threads ? *threads : unused);
}

Result<Design> parseDesign(std::string_view text, int* version) {
  const Result<json> object = parseJsonText(text, "design");
  if (!object) {
    Error error = object.error();
    // Not where it is a design but for one number.
    if (error.where == "design")
      error.message += "; a design is what Bladewright saved, a CAD file is opened as a surface";
    return tl::unexpected<Error>(std::move(error));
  }
  return detail::designFrom(*object, version);
}

namespace {

/// The file of a grid tells cuts once that all blocks have: each gets their expressions.
void placeCutBindings(const json& object, Design& design) {
  if (!design.grid || !object.contains("cuts")) return;
  std::map<std::string, std::size_t> each, own;  // by the ids of the cuts that are made of them
  const json& list = object["cuts"];
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string id = list[i].value("id", "cut-" + std::to_string(i + 1));
    if (list[i].contains("block"))
      own[id] = i;
    else
      for (const StockBlock& block : design.stock) each.try_emplace(id + "-" + block.id, i);
  }
  design.bindings = detail::withCutBindings(
      design.bindings, design.cuts.size(), [&](std::size_t cut) -> std::optional<std::size_t> {
        const std::string& id = design.cuts[cut].id;
        if (const auto told = own.find(id); told != own.end()) return told->second;
        const auto told = each.find(id);
        return told == each.end() ? std::nullopt : std::optional(told->second);
      });
}

}  // namespace

namespace {

/// A design from its document, which messages call `path`; with `files` what a version holds.
Result<Design> readDesign(const json& object, const std::string& path, const detail::EmbeddedFiles* files,
                          int* version) {
  ExpressionScope scope;
  ObjectReader reader(object, path, &scope);
  int found = 0;
  if (Result<void> ok = reader.version("bladewright_design", found, Design::kVersion, 0); !ok)
    return tl::unexpected<Error>(ok.error());
  if (found == 0)
    reader.complain(
        "bladewright_design",
        (files ? path : std::string("this")) +
            " is not a Bladewright design: the key bladewright_design with the version is missing");
  Result<Design> design = found == 1 ? earlierDesign(reader, files) : presentDesign(reader, object, files);
  if (!design) return design;
  reader.text("name", design->name);
  if (!files) {
    detail::readVersions(reader, *design);
    detail::readMarks(reader, *design);
  } else {
    if (reader.has("versions"))
      reader.complain("versions",
                      path + " has versions of its own; those of a design hold none: move them up");
    for (const char* key : {"hidden", "locked"})
      if (reader.has(key))
        reader.complain(key, path + " has the key " + key +
                                 ", but what is hidden or locked is told of the present state alone; take "
                                 "it out");
  }
  if (Result<void> ok = reader.finish(); !ok) return tl::unexpected<Error>(ok.error());
  if (version) *version = found;
  // Those of a version count from its own document.
  std::string before = path.substr(std::min(path.find_first_of(".["), path.size()));
  std::erase(before, ']');
  std::ranges::replace_if(
      before, [](char c) { return c == '.' || c == '['; }, '/');
  for (auto& [pointer, bound] : scope.bound) {
    std::string place = pointer.substr(before.size());
    // Told as one object they are written by their own keys.
    if (place == "/process/grip_error/mm") place = "/process/grip_error";
    if (place == "/process/grip_error/deg") place = "/process/grip_angle_error";
    design->bindings.emplace(std::move(place), std::move(bound));
  }
  placeCutBindings(object, *design);
  return design;
}

}  // namespace

Result<Design> detail::designFrom(const json& object, int* version) {
  return readDesign(object, "design", nullptr, version);
}

Result<Design> detail::designFrom(const json& object, const std::string& path, const EmbeddedFiles& files) {
  return readDesign(object, path, &files, nullptr);
}

namespace {

/// Puts the expressions in the place of the numbers that they came to.
void writeBindings(const std::map<std::string, BoundNumber>& bindings, nlohmann::ordered_json& object) {
  constexpr double kSame = 1e-12;  // relative: angles are kept in rad
  for (const auto& [pointer, bound] : bindings) {
    if (!pointer.starts_with('/') || pointer.find('~') != std::string::npos) continue;
    const nlohmann::ordered_json::json_pointer place(pointer);
    if (!object.contains(place) || !object[place].is_number()) continue;
    const double now = object[place].get<double>();
    if (std::abs(now - bound.value) <= kSame * std::abs(bound.value)) object[place] = "=" + bound.text;
  }
}

/// No file has -0, which means nothing and reads as a slip.
void dropMinusZeros(nlohmann::ordered_json& value) {
  if (value.is_structured()) {
    for (nlohmann::ordered_json& entry : value) dropMinusZeros(entry);
  } else if (value.is_number_float() && value.get<double>() == 0) {
    value = 0.0;
  }
}

}  // namespace

std::string designToJson(const Design& design) {
  return detail::designJson(design).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
         "\n";
}

nlohmann::ordered_json detail::designJson(const Design& design) {
  nlohmann::ordered_json object;
  object["bladewright_design"] = Design::kVersion;
  object["name"] = design.name;
  if (!design.variables.empty()) object["variables"] = variablesJson(design.variables);
  json sources = json::array(), stock = json::array(), cuts = json::array();
  /// `isBound` of the writers of a part.
  const auto boundIn = [&design](const std::string& part) {
    return [&design, part](const std::string& place) -> const BoundNumber* {
      const auto first = design.bindings.lower_bound(part + place);
      const bool there = first != design.bindings.end() && first->first.starts_with(part + place);
      return there ? &first->second : nullptr;
    };
  };
  for (const Source& source : design.sources) {
    if (source.surface) {
      const std::string part = "/sources/" + std::to_string(sources.size()) + "/surface";
      json designed = {{"id", source.id}, {"surface", surfaceJson(*source.surface, boundIn(part))}};
      detail::writeCurveNames(source, designed);
      detail::writeDrawing(source, designed);
      sources.push_back(std::move(designed));
      continue;
    }
    json part = {{"id", source.id}, {"path", source.path.generic_string()}};
    if (!source.bytes.empty()) part["base64"] = toBase64(source.bytes);
    if (source.bytes.empty() && source.saved) part["fingerprint"] = fingerprintText(*source.saved);
    detail::writeSourceKeys(source, part);
    sources.push_back(std::move(part));
  }
  const std::optional<detail::CutsUnderGrid> underGrid = detail::cutsUnderGrid(design);
  for (const StockBlock& block : design.stock) {
    if (underGrid) break;
    json part = {{"id", block.id}};
    detail::writePlacement(block, part);
    stock.push_back(std::move(part));
  }
  for (const Cut& cut : underGrid ? underGrid->cuts : design.cuts) {
    const std::size_t told = underGrid ? underGrid->of[cuts.size()] : cuts.size();
    json part = {{"id", cut.id}, {"source", cut.source}};
    if (!cut.block.empty()) part["block"] = cut.block;
    detail::writeCutKeys(cut, part);
    detail::writeBlockCutKeys(cut, part, boundIn("/cuts/" + std::to_string(told)));
    cuts.push_back(std::move(part));
  }
  object["sources"] = sources;
  if (underGrid)
    object["grid"] = gridJson(*design.grid, boundIn({}));
  else
    object["stock"] = stock;
  object["cuts"] = cuts;
  object["blade"] = bladeToJson(design.blade);
  // Of another section than that of now, but told by an expression.
  for (const BladeNumber& number : bladeNumbers())
    if (!number.appliesTo(design.blade.section) &&
        design.bindings.contains(std::string("/blade/") + number.key))
      object["blade"][number.key] = design.blade.*number.member;
  json process;
  detail::writeProcessKeys(design.process, process);
  object["process"] = process;
  object["output"] = {{"programs", design.output.programs}, {"cell", design.output.cell}};
  writeBindings(underGrid ? detail::withCutBindings(design.bindings, underGrid->of.size(),
                                                    [&](std::size_t cut) { return underGrid->of[cut]; })
                          : design.bindings,
                object);
  writeMarks(design, object);
  dropMinusZeros(object);
  if (!design.versions.empty()) object["versions"] = versionsJson(design);
  return object;
}

void noteSources(Design& design) {
  for (Source& source : design.sources)
    if (source.surface || !source.bytes.empty())
      source.saved.reset();
    else if (const Result<Fingerprint> now = fingerprintOfFile(source.path))
      source.saved = *now;
}

Result<Design> loadDesign(const fs::path& file, int* version) {
  const Result<std::string> text = readFile(file, kLargestText);
  if (!text) return tl::unexpected<Error>(text.error());
  Result<Design> design = parseDesign(*text, version);
  if (!design) {
    Error error = design.error();
    error.message = file.filename().string() + ": " + error.message;
    return tl::unexpected<Error>(std::move(error));
  }
  changeStates(*design, [&file](Design& state) {
    for (Source& source : state.sources)
      if (source.bytes.empty() && !source.path.empty() && source.path.is_relative())
        source.path = (file.parent_path() / source.path).lexically_normal();
    for (Source& source : state.sources)
      if (source.drawing && source.drawing->path.is_relative())
        source.drawing->path = (file.parent_path() / source.drawing->path).lexically_normal();
  });
  return design;
}

namespace {

/// Where a linked file lies beside a design of that folder.
void relate(fs::path& path, const fs::path& folder) {
  if (!path.is_absolute()) return;
  const fs::path relative = path.lexically_relative(folder);
  if (!relative.empty()) path = relative;
}

}  // namespace

Result<void> saveDesign(const Design& design, const fs::path& file) {
  Design stored = design;
  std::size_t embedded = 0;
  for (const Source& source : design.sources) embedded += source.bytes.str().size();
  std::error_code error;
  const fs::path folder = fs::absolute(file, error).parent_path();
  changeStates(stored, [&folder](Design& state) {
    for (Source& source : state.sources) {
      if (source.bytes.empty()) relate(source.path, folder);
      if (source.drawing) relate(source.drawing->path, folder);
    }
  });
  const std::string text = designToJson(stored);
  if (text.size() > kLargestText)
    return fail(ErrorCode::cannotWrite,
                file.string() + " would have " + std::to_string(text.size() >> 20) +
                    " MB, but designs above " + std::to_string(kLargestText >> 20) +
                    " MB cannot be opened again; link the CAD file (" + std::to_string(embedded >> 20) +
                    " MB) instead of embedding it" +
                    (design.versions.empty()
                         ? ""
                         : ", or remove some of the " + std::to_string(design.versions.size()) + " versions"),
                file.string(), double(text.size()), double(kLargestText));
  return writeFile(file, text);
}

}  // namespace bw
