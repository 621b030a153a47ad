// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/design/variables.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bw/core/design/design.h"
#include "bw/core/design/design_versions.h"
#include "bw/core/text/number_text.h"
#include "design/design_keys.h"

namespace bw {

namespace {

/// Whether nothing in that part of the design is told by an expression.
bool plain(const Design& design, const std::string& part) {
  const auto first = design.bindings.lower_bound(part);
  return first == design.bindings.end() || !first->first.starts_with(part);
}

/// Takes parts over as they were, which a way through text would round.
template <class Part>
void keepPlain(std::vector<Part>& read, const std::vector<Part>& before, const Design& design,
               const char* list) {
  for (std::size_t i = 0; i < read.size() && i < before.size(); ++i)
    if (plain(design, list + std::to_string(i) + "/")) read[i] = before[i];
}

}  // namespace

bool isVariableName(std::string_view name) { return isExpressionName(name) && name != "x" && name != "y"; }

Result<Design> resolved(const Design& design) {
  // What is designed is told by numbers that must fit each other: as it will be read, or not at all.
  const bool designed =
      std::ranges::any_of(design.sources, [](const Source& source) { return source.surface.has_value(); });
  if (design.bindings.empty() && !designed) return design;
  Design bare = withoutVersions(design);
  for (Source& source : bare.sources) source.bytes = {};
  Result<Design> read = detail::designFrom(detail::designJson(bare));
  if (!read) return read;
  read->name = design.name;
  for (std::size_t i = 0; i < read->sources.size() && i < design.sources.size(); ++i)
    if (!design.sources[i].surface) read->sources[i] = design.sources[i];
  if (!read->grid) {
    keepPlain(read->stock, design.stock, design, "/stock/");
    keepPlain(read->cuts, design.cuts, design, "/cuts/");
    read->grid = design.grid;
  } else if (plain(design, "/grid/")) {
    read->grid = design.grid;
    read->stock = design.stock;
    if (plain(design, "/cuts/")) read->cuts = design.cuts;
  }
  if (plain(design, "/blade/")) read->blade = design.blade;
  if (plain(design, "/process/")) read->process = design.process;
  read->output = design.output;
  read->versions = design.versions;
  read->marks = design.marks;
  return read;
}

namespace {

Result<void> set(Design& design, const std::string& name, double value) {
  const auto found = std::ranges::find(design.variables, name, &Variable::name);
  if (found == design.variables.end()) {
    std::vector<std::string> names;
    std::string all;
    for (const Variable& variable : design.variables) {
      all += (names.empty() ? "" : ", ") + variable.name;
      names.push_back(variable.name);
    }
    if (names.empty())
      return fail(ErrorCode::badInput, "the design has no variables, so there is no \"" + name + "\" to set",
                  name);
    const std::string nearest = nearestWord(name, names.data(), int(names.size()));
    return fail(ErrorCode::badInput,
                "the design has no variable \"" + name + "\"" +
                    (nearest.empty() ? "; it has " + all : "; did you mean \"" + nearest + "\"?"),
                name);
  }
  if (!(value >= found->min && value <= found->max)) {
    const std::string unit = found->unit.empty() ? "" : " " + found->unit;
    return fail(ErrorCode::badInput,
                name + " is " + shortText(value, 6) + unit + " but must lie between " +
                    shortText(found->min, 6) + " and " + shortText(found->max, 6) + unit,
                name, value, value < found->min ? found->min : found->max);
  }
  found->value = value;
  return {};
}

}  // namespace

Result<Design> withVariables(const Design& design, const std::vector<NamedNumber>& values) {
  Design changed = design;
  for (const NamedNumber& number : values)
    if (Result<void> ok = set(changed, number.name, number.value); !ok)
      return tl::unexpected<Error>(ok.error());
  return resolved(changed);
}

}  // namespace bw
