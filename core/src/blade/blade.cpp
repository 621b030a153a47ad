// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/blade/blade.h"
#include "bw/core/blade/blade_numbers.h"
#include "bw/core/blade/cutting_limits.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bw/core/base/units.h"
#include "bw/core/blade/blade_json.h"
#include "bw/core/files/file_set.h"
#include "bw/core/text/number_text.h"

namespace bw {

namespace fs = std::filesystem;
using nlohmann::json;

double Blade::fibreDistance() const {
  return section == Section::flat ? 0.5 * thickness : 0.5 * outerDiameter;
}

double Blade::secondMoment() const {
  const auto disc = [](double d) { return kPi * d * d * d * d / 64.0; };
  switch (section) {
    case Section::flat:
      return width * thickness * thickness * thickness / 12.0;
    case Section::tube:
      return disc(outerDiameter) - disc(innerDiameter);
    case Section::rod:
      return disc(outerDiameter);
  }
  return 0;
}

double Blade::area() const {
  const double inner = section == Section::tube ? innerDiameter : 0;
  return section == Section::flat ? width * thickness
                                  : kPi / 4 * (outerDiameter * outerDiameter - inner * inner);
}

double cuttingAngleLimit(const Blade& blade) {
  // A flat blade cuts only along its edge; a round one melts whichever way it goes, but drags.
  return (blade.section == Blade::Section::flat ? 45 : 60) * kDegree;
}

double Blade::minRadius() const { return youngModulus * fibreDistance() * safety / yieldStress; }

namespace {

constexpr const char* kAuto = "auto";  // length

constexpr std::array<BladeNumber, 11> kBlade = {{
    {{&Blade::length, "length", "Blade length", "mm", 10, Blade::kLongest, 10, 2, 10,
      "Free length between the two grips", "Change blade length"}},
    {{&Blade::outerDiameter, "outer_diameter", "Outer diameter", "mm", 0, 100, 0.05, 3, 0.1, "",
      "Change diameter"},
     false},
    {{&Blade::innerDiameter, "inner_diameter", "Inner diameter", "mm", 0, 100, 0, 3, 0.1, "",
      "Change diameter"},
     false,
     true,
     false},
    {{&Blade::width, "width", "Width", "mm", 0, 200, 0.05, 3, 0.5, "Along the cutting direction",
      "Change blade width"},
     true,
     false,
     false},
    {{&Blade::thickness, "thickness", "Thickness", "mm", 0, 50, 0.01, 3, 0.1, "In the plane of bending",
      "Change blade thickness"},
     true,
     false,
     false},
    {{&Blade::youngModulus, "young_modulus", "Young's modulus", "N/mm²", 1, 2e6, 1, 1, 1000,
      "At the working temperature", "Change Young's modulus"}},
    {{&Blade::yieldStress, "yield_stress", "Yield stress", "N/mm²", 1e-2, 1e5, 1e-2, 2, 10,
      "At the working temperature", "Change yield stress"}},
    {{&Blade::safety, "safety", "Safety factor", "", 1, 10, 1, 3, 0.1, "The yield stress is divided by this",
      "Change safety factor"}},
    {{&Blade::density, "density", "Density", "kg/m³", 1, 30000, 1, 0, 50,
      "With the section it makes the blade's own weight", "Change density"}},
    {{&Blade::temperature, "temperature", "Temperature", "°C", -50, 1500, -50, 1, 10,
      "Of the blade at the cut", "Change temperature"}},
    {{&Blade::thermalExpansion, "thermal_expansion", "Expansion", "·10⁻⁶/K", 0, 1e-3, 0, 3, 0.5,
      "Mean thermal expansion from 20 °C to the working temperature", "Change thermal expansion", 1e6}},
}};

/// Reads a blade object strictly over the values of `blade`.
Result<Blade> bladeFromJson(const json& object, const std::string& path, Blade blade,
                            ExpressionScope* scope = nullptr) {
  ObjectReader reader(object, path, scope);
  reader.text("name", blade.name);
  reader.text("title", blade.title);
  int section = int(blade.section);
  reader.word("section", {"flat", "tube", "rod"}, section);
  blade.section = Blade::Section(section);
  for (const BladeNumber& number : bladeNumbers()) {
    if (object.contains(number.key)) blade.sources.erase(number.key);
    if (number.member == &Blade::length && object.contains(number.key)) {
      blade.autoLength = *reader.member(number.key) == kAuto;
      if (blade.autoLength) continue;
    }
    reader.number(number.key, blade.*number.member, number.min, number.max);
  }
  if (const json* sources = reader.member("sources"); sources && sources->is_object()) {
    for (const auto& [key, text] : sources->items())
      if (text.is_string())
        blade.sources[key] = text.get<std::string>();
      else
        reader.complain("sources", path + ".sources." + key + " must be a text");
  } else if (sources) {
    reader.complain("sources", path + ".sources must be an object of texts");
  }
  if (blade.section == Blade::Section::flat && !(blade.width > 0 && blade.thickness > 0))
    reader.complain("width", path + " is a flat blade and needs width and thickness greater than 0 mm");
  if (blade.section != Blade::Section::flat && !(blade.outerDiameter > 0))
    reader.complain("outer_diameter", path + " is round and needs outer_diameter greater than 0 mm");
  if (blade.section == Blade::Section::tube && !(blade.innerDiameter < blade.outerDiameter))
    reader.complain("inner_diameter", path + ".inner_diameter must be smaller than outer_diameter",
                    blade.innerDiameter, blade.outerDiameter);
  if (Result<void> ok = reader.finish(); !ok) return tl::unexpected<Error>(ok.error());
  return blade;
}

}  // namespace

std::span<const BladeNumber> bladeNumbers() { return kBlade; }

json bladeToJson(const Blade& blade) {
  static const char* const kSections[] = {"flat", "tube", "rod"};
  json object = {{"name", blade.name}, {"title", blade.title}, {"section", kSections[int(blade.section)]}};
  for (const BladeNumber& number : bladeNumbers())
    if (number.appliesTo(blade.section)) object[number.key] = blade.*number.member;
  if (blade.autoLength) object["length"] = kAuto;
  if (!blade.sources.empty()) object["sources"] = blade.sources;
  return object;
}

void readBlade(ObjectReader& reader, Blade& blade) {
  const json* value = reader.member("blade");
  if (!value) return;
  const auto take = [&](const std::string& name) {
    Result<Blade> preset = bladePreset(name);
    if (preset)
      blade = std::move(*preset);
    else
      reader.complain("blade", preset.error().message);
    return preset.has_value();
  };
  if (value->is_string()) {
    take(value->get<std::string>());
    return;
  }
  if (!value->is_object()) {
    reader.complain("blade", reader.path() + ".blade must be the word of a preset or an object");
    return;
  }
  json own = *value;
  if (own.contains("preset")) {
    if (!own["preset"].is_string() || !take(own["preset"].get<std::string>())) {
      reader.complain("blade", reader.path() + ".blade.preset must be the word of a preset");
      return;
    }
    own.erase("preset");
  } else if (!own.contains("name")) {
    blade.name = "custom";
    blade.title = "Own blade";
  } else if (own["name"].is_string()) {
    // Numbers that an earlier version did not write are those of the preset.
    if (Result<Blade> preset = bladePreset(own["name"].get<std::string>())) blade = std::move(*preset);
  }
  Result<Blade> read = bladeFromJson(own, reader.path() + ".blade", blade, reader.scope());
  if (read)
    blade = std::move(*read);
  else
    reader.complain("blade", read.error().message, read.error().value, read.error().limit);
}

Result<fs::path> resourceFolder() {
  std::error_code error;
  if (const char* chosen = std::getenv("BLADEWRIGHT_RESOURCES"); chosen && *chosen) {
    if (fs::is_directory(chosen, error)) return fs::path(chosen);
    return fail(
        ErrorCode::cannotRead,
        std::string("BLADEWRIGHT_RESOURCES names ") + chosen + ", which is not a folder; correct or unset it",
        chosen);
  }
  std::array<char, 4096> buffer;
  const ssize_t n = ::readlink("/proc/self/exe", buffer.data(), buffer.size());
  if (n > 0) {
    const fs::path installed =
        fs::path(std::string(buffer.data(), std::size_t(n))).parent_path().parent_path() / "share" /
        "bladewright";
    if (fs::is_directory(installed, error)) return installed;
  }
  return fail(
      ErrorCode::cannotRead,
      "the resource folder share/bladewright was not found beside the folder of the program; install the "
      "program whole, or set BLADEWRIGHT_RESOURCES to its resources");
}

Result<std::vector<Blade>> bladePresets() {
  const Result<fs::path> root = resourceFolder();
  if (!root) return tl::unexpected<Error>(root.error());
  const fs::path folder = *root / "blades";
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (error || files.empty())
    return fail(ErrorCode::cannotRead, "no blade presets in " + folder.string() + "; reinstall the resources",
                folder.string());
  std::sort(files.begin(), files.end());
  std::vector<Blade> blades;
  for (const fs::path& file : files) {
    const Result<std::string> bytes = readFile(file, 1 << 20);
    if (!bytes) return tl::unexpected<Error>(bytes.error());
    const Result<json> object = parseJsonText(*bytes, file.filename().string());
    if (!object) return tl::unexpected<Error>(object.error());
    Blade blank;
    blank.name = file.stem().string();
    Result<Blade> blade = bladeFromJson(*object, file.filename().string(), blank);
    if (!blade) return tl::unexpected<Error>(blade.error());
    blades.push_back(std::move(*blade));
  }
  return blades;
}

Result<Blade> bladePreset(const std::string& name) {
  const Result<std::vector<Blade>> presets = bladePresets();
  if (!presets) return tl::unexpected<Error>(presets.error());
  std::vector<std::string> names;
  for (const Blade& blade : *presets) {
    if (blade.name == name) return blade;
    names.push_back(blade.name);
  }
  std::string message = "there is no blade preset \"" + name + "\"";
  const std::string nearest = nearestWord(name, names.data(), int(names.size()));
  if (!nearest.empty()) {
    message += "; did you mean \"" + nearest + "\"?";
  } else {
    message += "; the presets are";
    for (std::size_t i = 0; i < names.size(); ++i) message += (i ? ", " : " ") + names[i];
  }
  return fail(ErrorCode::badInput, message, "blade");
}

}  // namespace bw
