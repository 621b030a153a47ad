// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/design_versions.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "bw/core/text/number_text.h"
#include "bw/core/text/printable.h"
#include "design/design_keys.h"

namespace bw {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

/// What the embedded file of the design itself, and that of a version, is called by versions that share it.
constexpr const char* kOfDesign = "design";
std::string ofVersion(std::size_t index) { return "versions[" + std::to_string(index) + "]"; }

bool isBlank(const std::string& name) { return name.find_first_not_of(" \t\r\n") == std::string::npos; }

auto placeOf(const Design& design, std::string_view name) {
  return std::ranges::find(design.versions, name, &NamedVersion::name);
}

/// Why a version cannot be called so; nothing if it can.
Result<void> mayBeCalled(const Design& design, const std::string& name) {
  if (isBlank(name))
    return fail(ErrorCode::badInput, "the name of the version is empty; give it one", "name");
  if (!isUtf8(name))
    return fail(ErrorCode::badInput, "the name of the version is no UTF-8 text; give it another", "name");
  if (placeOf(design, name) != design.versions.end())
    return fail(ErrorCode::badInput,
                "the design has a version \"" + name + "\" already; choose another name, or remove that one",
                name);
  return {};
}

}  // namespace

Result<NamedVersion> versionOf(const Design& design, std::string_view name) {
  if (const auto found = placeOf(design, name); found != design.versions.end()) return *found;
  const std::string asked = "\"" + std::string(name) + "\"";
  if (design.versions.empty())
    return fail(ErrorCode::badInput, "the design has no versions, so there is none of the name " + asked,
                std::string(name));
  std::vector<std::string> names;
  std::string all;
  for (const NamedVersion& version : design.versions) {
    all += (names.empty() ? "\"" : ", \"") + version.name + "\"";
    names.push_back(version.name);
  }
  const std::string nearest = nearestWord(std::string(name), names.data(), int(names.size()));
  return fail(ErrorCode::badInput,
              "the design has no version " + asked +
                  (nearest.empty() ? "; it has " + all : "; did you mean \"" + nearest + "\"?"),
              std::string(name));
}

Design withoutVersions(Design design) {
  design.versions.clear();
  design.marks = {};
  return design;
}

Result<Design> withVersion(const Design& design, const std::string& name) {
  if (Result<void> ok = mayBeCalled(design, name); !ok) return tl::unexpected<Error>(ok.error());
  if (design.versions.size() >= std::size_t(Design::kMostVersions))
    return fail(ErrorCode::badInput,
                "the design has " + std::to_string(design.versions.size()) +
                    " versions, as many as there may be; remove one",
                name, double(design.versions.size()), double(Design::kMostVersions));
  Design named = design;
  named.versions.push_back({name, std::make_shared<const Design>(withoutVersions(design))});
  return named;
}

Result<Design> atVersion(const Design& design, std::string_view name) {
  const Result<NamedVersion> version = versionOf(design, name);
  if (!version) return tl::unexpected<Error>(version.error());
  Design taken = *version->design;
  taken.versions = design.versions;
  taken.marks = design.marks;
  return taken;
}

Result<Design> withoutVersion(const Design& design, std::string_view name) {
  if (const Result<NamedVersion> version = versionOf(design, name); !version)
    return tl::unexpected<Error>(version.error());
  Design less = design;
  less.versions.erase(less.versions.begin() + (placeOf(design, name) - design.versions.begin()));
  return less;
}

Result<Design> withVersionRenamed(const Design& design, std::string_view name, const std::string& next) {
  if (const Result<NamedVersion> version = versionOf(design, name); !version)
    return tl::unexpected<Error>(version.error());
  if (name == next) return design;
  if (Result<void> ok = mayBeCalled(design, next); !ok) return tl::unexpected<Error>(ok.error());
  Design renamed = design;
  renamed.versions[std::size_t(placeOf(design, name) - design.versions.begin())].name = next;
  return renamed;
}

void changeStates(Design& design, const std::function<void(Design&)>& change) {
  for (NamedVersion& version : design.versions) {
    auto state = std::make_shared<Design>(*version.design);
    change(*state);
    version.design = std::move(state);
  }
  change(design);
}

void detail::readVersions(ObjectReader& reader, Design& design) {
  const json* value = reader.member("versions");
  if (!value) return;
  const std::string path = reader.path() + ".versions";
  if (!value->is_array() || value->size() > std::size_t(Design::kMostVersions))
    return reader.complain(
        "versions",
        path + " must be a list of at most " + std::to_string(Design::kMostVersions) + " entries" +
            (value->is_array() ? ", not of " + std::to_string(value->size()) : std::string()),
        value->is_array() ? std::optional(double(value->size())) : std::nullopt,
        double(Design::kMostVersions));
  EmbeddedFiles files;
  if (!design.source().bytes.empty()) files.emplace(kOfDesign, design.source().bytes);
  std::set<std::string> names;
  for (std::size_t i = 0; i < value->size(); ++i) {
    const std::string entry = path + "[" + std::to_string(i) + "]";
    ObjectReader inner((*value)[i], entry);
    NamedVersion version;
    inner.need("name", entry + " needs the key name: what the version is called");
    inner.text("name", version.name);
    if (isBlank(version.name)) inner.complain("name", entry + ".name is empty; give the version a name");
    if (!names.insert(version.name).second)
      inner.complain(
          "name", entry + ".name is \"" + version.name + "\", as that of another version; give each its own");
    inner.need("design", entry + " needs the key design: the design as it was");
    Design state;
    if (const json* object = inner.member("design"))
      inner.take(designFrom(*object, entry + ".design", files), state);
    if (!reader.adopt(inner.finish())) return;
    if (!state.source().bytes.empty()) files.emplace(ofVersion(i), state.source().bytes);
    version.design = std::make_shared<const Design>(std::move(state));
    design.versions.push_back(std::move(version));
  }
}

ordered_json detail::versionsJson(const Design& design) {
  ordered_json versions = ordered_json::array();
  std::vector<std::pair<std::string, SharedBytes>> files;
  if (!design.source().bytes.empty()) files.emplace_back(kOfDesign, design.source().bytes);
  for (const NamedVersion& version : design.versions) {
    Design state = withoutVersions(*version.design);
    const SharedBytes bytes = state.source().bytes;
    const auto known = std::ranges::find(files, bytes, &std::pair<std::string, SharedBytes>::second);
    const bool shared = !bytes.empty() && known != files.end();
    if (shared) {
      state.source().bytes.clear();
      state.source().saved.reset();
    } else if (!bytes.empty()) {
      files.emplace_back(ofVersion(versions.size()), bytes);
    }
    ordered_json written = designJson(state);
    if (shared) written["sources"][0]["base64_as"] = known->first;
    ordered_json entry;
    entry["name"] = version.name;
    entry["design"] = std::move(written);
    versions.push_back(std::move(entry));
  }
  return versions;
}

}  // namespace bw
