// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "sets.h"

#include <algorithm>

#include "bw/core/design/variables.h"
#include "bw/core/text/typed_number.h"

namespace bw::cli {

Result<Design> withSets(const Design& design, const std::vector<std::string>& sets) {
  std::vector<NamedNumber> values;
  for (const std::string& text : sets) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      return fail(ErrorCode::badInput, "--set takes NAME=VALUE, such as width=650, not \"" + text + "\"",
                  "set");
    const std::string name = text.substr(0, equals);
    if (std::ranges::find(values, name, &NamedNumber::name) != values.end())
      return fail(ErrorCode::badInput, "--set gives " + name + " twice; keep one of them", "set");
    const auto variable = std::ranges::find(design.variables, name, &Variable::name);
    double value = 0;
    if (variable != design.variables.end()) {
      const Result<double> typed = readTypedNumber(text.substr(equals + 1), {variable->unit});
      if (!typed) return fail(ErrorCode::badInput, "--set " + name + ": " + typed.error().message, "set");
      value = *typed;
    }
    values.push_back({name, value});
  }
  return values.empty() ? Result<Design>(design) : withVariables(design, values);
}

}  // namespace bw::cli
