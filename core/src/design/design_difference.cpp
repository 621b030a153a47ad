// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/design_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "bw/core/blade/blade_numbers.h"
#include "bw/core/design/design_versions.h"
#include "bw/core/design/process_numbers.h"
#include "bw/core/text/number_text.h"
#include "design/design_keys.h"

namespace bw {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMostListed = 4;  ///< differences within a list that are told one by one

/// A difference, and how many numbers it stands for.
struct Found {
  DesignDifference told;
  std::size_t numbers = 1;
  std::optional<double> most;  ///< by which one of them differs; empty where it is no number
};

/// How a number is shown.
struct Unit {
  std::string text;
  double scale = 1;
};

/// The name by which an entry of a list is known.
std::string nameOf(const ordered_json& entry) {
  if (!entry.is_object()) return {};
  for (const char* key : {"id", "name"})
    if (const auto found = entry.find(key); found != entry.end() && found->is_string())
      return found->get<std::string>();
  return {};
}

bool allNamed(const ordered_json& list) {
  return std::ranges::all_of(list, [](const ordered_json& entry) { return !nameOf(entry).empty(); });
}

/// A key in words: "turn_deg" is "turn".
std::string wordOf(std::string key) {
  for (const char* unit : {"_deg", "_mm"})
    if (key.ends_with(unit)) key.resize(key.size() - std::string(unit).size());
  std::ranges::replace(key, '_', ' ');
  return key;
}

/// Of the number at a place of the document, or of those of the list there.
Unit unitOf(std::string pointer) {
  while (!pointer.empty() && pointer.find_last_not_of("0123456789") != pointer.size() - 1)
    pointer.resize(pointer.find_last_of('/') == std::string::npos ? 0 : pointer.find_last_of('/'));
  if (pointer.ends_with("_deg")) return {" °"};
  if (pointer.ends_with("_mm")) return {" mm"};
  const std::size_t last = pointer.find_last_of('/');
  const std::string key = last == std::string::npos ? pointer : pointer.substr(last + 1);
  static constexpr auto kLengths = std::to_array<std::string_view>(
      {"origin", "size", "height", "moved", "poles", "x", "y", "bezier", "spline", "ducks", "middle",
       "offset", "blade_length", "spacing", "end_heights"});
  const bool ofGrid =
      pointer.find("/sizes/") != std::string::npos || pointer.find("/gaps/") != std::string::npos;
  return ofGrid || std::ranges::find(kLengths, key) != kLengths.end() ? Unit{" mm"} : Unit{};
}

template <class Number>
Unit unitOf(const Number& number) {
  return {*number.unit ? " " + std::string(number.unit) : std::string(), number.scale};
}

/// A value in words. With `digits` 0 a number is told to its last one.
std::string textOf(const ordered_json& value, const Unit& unit, int digits) {
  if (value.is_number()) {
    const double x = value.get<double>() * unit.scale;
    return (digits > 0 ? shortText(x, digits) : roundTripText(x)) + unit.text;
  }
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_null()) return "none";
  constexpr std::size_t kLongest = 40;
  std::string text = value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  if (text.size() > kLongest)
    text = std::to_string(value.size()) + (value.size() == 1 ? " entry" : " entries");
  return text;
}

/// Compares the documents of two designs.
class Comparison {
 public:
  void compare(const ordered_json& before, const ordered_json& after) { keys(before, after, {}, {}); }
  std::vector<DesignDifference> take() {
    std::vector<DesignDifference> told;
    told.reserve(found_.size());
    for (Found& found : found_) told.push_back(std::move(found.told));
    return told;
  }

 private:
  void add(const std::string& pointer, const std::string& what, std::string before, std::string after,
           std::optional<double> most = {}) {
    found_.push_back({{pointer, what, std::move(before), std::move(after)}, 1, most});
  }

  void value(const ordered_json& before, const ordered_json& after, const std::string& pointer,
             const std::string& what, const Unit& unit) {
    if (before == after) return;
    if (before.is_object() && after.is_object()) return keys(before, after, pointer, what);
    if (before.is_array() && after.is_array()) return list(before, after, pointer, what);
    constexpr int kDigits = 6;
    std::string old = textOf(before, unit, kDigits), now = textOf(after, unit, kDigits);
    if (old == now) {
      old = textOf(before, unit, 0);
      now = textOf(after, unit, 0);
    }
    std::optional<double> most;
    if (before.is_number() && after.is_number())
      most = std::abs(after.get<double>() - before.get<double>()) * unit.scale;
    add(pointer, what, std::move(old), std::move(now), most);
  }

  void keys(const ordered_json& before, const ordered_json& after, const std::string& pointer,
            const std::string& what) {
    // What is of another kind has other numbers altogether.
    const auto kindOf = [](const ordered_json& object) -> std::string {
      const auto type = object.find("type");
      return type != object.end() && type->is_string() ? kindText(type->get<std::string>()) : std::string();
    };
    if (const std::string old = kindOf(before), now = kindOf(after);
        !old.empty() && !now.empty() && old != now)
      return add(pointer + "/type", what, old, now);
    const auto each = [&](const std::string& key, const ordered_json* old, const ordered_json* now) {
      const std::string place = pointer + "/" + key;
      const auto [words, unit] = named(pointer, key, what, now ? *now : *old);
      if (old && now) return value(*old, *now, place, words, unit);
      constexpr int kDigits = 6;
      add(place, words, old ? textOf(*old, unit, kDigits) : std::string(),
          now ? textOf(*now, unit, kDigits) : std::string());
    };
    for (const auto& [key, now] : after.items()) {
      const auto old = before.find(key);
      each(key, old == before.end() ? nullptr : &*old, &now);
    }
    for (const auto& [key, old] : before.items())
      if (!after.contains(key)) each(key, &old, nullptr);
  }

  void list(const ordered_json& before, const ordered_json& after, const std::string& pointer,
            const std::string& what) {
    if (allNamed(before) && allNamed(after)) return parts(before, after, pointer);
    if (before.size() != after.size()) {
      add(pointer, what, textOf(before, {}, 1), textOf(after, {}, 1));
      return;
    }
    const std::size_t first = found_.size();
    static constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
    const bool isVector =
        after.size() == 3 && std::ranges::all_of(after, [](const ordered_json& x) { return x.is_number(); });
    for (std::size_t i = 0; i < after.size(); ++i) {
      const std::string entry = isVector ? std::string(" ") + kAxes[i] : " " + std::to_string(i + 1);
      value(before[i], after[i], pointer + "/" + std::to_string(i), what + entry, unitOf(pointer));
    }
    gather(first, pointer, what);
  }

  /// Makes one difference of many.
  void gather(std::size_t first, const std::string& pointer, const std::string& what) {
    if (found_.size() - first <= kMostListed) return;
    std::size_t numbers = 0;
    double most = 0;
    for (std::size_t i = first; i < found_.size(); ++i) {
      numbers += found_[i].numbers;
      most = std::max(most, found_[i].most.value_or(0));
    }
    found_.resize(first);
    add(pointer, what, "",
        std::to_string(numbers) + " values differ, by at most " + shortText(most) + unitOf(pointer).text);
    found_.back().told.many = true;
    found_.back().numbers = numbers;
    found_.back().most = most;
  }

  /// Entries that have names: blocks, cuts, surfaces, variables.
  void parts(const ordered_json& before, const ordered_json& after, const std::string& pointer) {
    const std::string kind = pointer == "/cuts"        ? "Cut "
                             : pointer == "/stock"     ? "Block "
                             : pointer == "/sources"   ? "Surface "
                             : pointer == "/variables" ? "Variable "
                                                       : "Entry ";
    std::map<std::string, const ordered_json*> old;
    for (const ordered_json& entry : before) old.emplace(nameOf(entry), &entry);
    std::set<std::string> kept;
    for (std::size_t i = 0; i < after.size(); ++i) {
      const std::string place = pointer + "/" + std::to_string(i);
      const std::string name = kind + nameOf(after[i]);
      kept.insert(nameOf(after[i]));
      const auto then = old.find(nameOf(after[i]));
      if (then == old.end())
        add(place, name, "", "there");
      else if (pointer == "/variables")
        variable(*then->second, after[i], place, name);
      else
        keys(*then->second, after[i], place, name);
    }
    for (std::size_t i = 0; i < before.size(); ++i)
      if (!kept.contains(nameOf(before[i])))
        add(pointer + "/" + std::to_string(i), kind + nameOf(before[i]), "there", "");
  }

  void variable(const ordered_json& before, const ordered_json& after, const std::string& pointer,
                const std::string& what) {
    const std::string unit = after.value("unit", std::string());
    for (const auto& [key, now] : after.items()) {
      const auto old = before.find(key);
      const std::string words = key == "value" ? what : what + ": " + wordOf(key);
      const Unit shown = {unit.empty() || key == "unit" ? std::string() : " " + unit};
      if (old != before.end())
        value(*old, now, pointer + "/" + key, words, shown);
      else
        add(pointer + "/" + key, words, "", textOf(now, shown, 6));
    }
    for (const auto& [key, old] : before.items())
      if (!after.contains(key)) add(pointer + "/" + key, what + ": " + wordOf(key), textOf(old, {}, 6), "");
  }

  /// What a key of an object is called, and the unit of its number.
  static std::pair<std::string, Unit> named(const std::string& object, const std::string& key,
                                            const std::string& what, const ordered_json& value) {
    for (const ProcessNumber& number : processNumbers())
      if (key == number.key &&
          object == "/process" + (number.object ? "/" + std::string(number.object) : std::string()))
        return {number.title, unitOf(number)};
    if (object == "/blade")
      for (const BladeNumber& number : bladeNumbers())
        if (key == number.key) return {std::string("Blade: ") + lowered(number.title), unitOf(number)};
    if (object.empty()) {
      if (key == "name") return {"Name of the design", {}};
      return {capital(wordOf(key)), {}};
    }
    if (key == "surface") return {what, {}};  // of a source, which is called so
    const bool deeper = what.find(": ") != std::string::npos;
    return {what + (deeper ? ", " : ": ") + wordOf(key),
            value.is_number() ? unitOf(object + "/" + key) : Unit{}};
  }

  /// What a surface or a family of planes is of.
  static std::string kindText(const std::string& type) {
    static const std::map<std::string, std::string> kTexts = {
        {"blades", "key blades"}, {"sections", "section curves"}, {"poles", "grid of poles"}};
    const auto found = kTexts.find(type);
    return found != kTexts.end() ? found->second : wordOf(type);
  }
  static std::string lowered(std::string text) {
    if (text.size() > 1 && text[1] >= 'a' && text[1] <= 'z') text[0] = char(text[0] | 0x20);
    return text;
  }
  static std::string capital(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = char(text[0] & ~0x20);
    return text;
  }

  std::vector<Found> found_;
};

/// The documents are compared without what is no setting, and without the bytes of files.
ordered_json documentOf(const Design& design) {
  Design bare = withoutVersions(design);
  for (Source& source : bare.sources) {
    source.bytes.clear();
    source.saved.reset();
    source.drawing.reset();
  }
  return detail::designJson(bare);
}

std::string sizeText(const SharedBytes& bytes) {
  return bytes.empty() ? "" : shortText(double(bytes.size()) / 1024, 4) + " KB";
}

}  // namespace

std::string sentenceOf(const DesignDifference& difference) {
  if (difference.many) return difference.what + ": " + difference.after;
  const auto shown = [](const std::string& value) { return value.empty() ? "not there" : value; };
  return difference.what + ": " + shown(difference.before) + " → " + shown(difference.after);
}

std::vector<DesignDifference> differences(const Design& before, const Design& after) {
  Comparison comparison;
  comparison.compare(documentOf(before), documentOf(after));
  std::vector<DesignDifference> told = comparison.take();
  for (std::size_t i = 0; i < after.sources.size(); ++i) {
    const Source& now = after.sources[i];
    const Source* then = before.find(now.id);
    if (!then || then->bytes == now.bytes) continue;
    DesignDifference file = {"/sources/" + std::to_string(i) + "/base64",
                             "Surface " + now.id + ": embedded CAD file", sizeText(then->bytes),
                             sizeText(now.bytes)};
    if (file.before == file.after) file.after = "another file of " + file.after;
    told.push_back(std::move(file));
  }
  return told;
}

}  // namespace bw
