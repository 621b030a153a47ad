// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bw/core/base/result.h"
#include "bw/core/elastica/elastica.h"

namespace bw::cases {

/// An elastica object as the command line writes it: the regular form, and the thesis's control parameters or
/// null.
nlohmann::ordered_json elasticaToJson(const Elastica& elastica);
/// Reads either form; keys of the regular form win where both are there.
Result<Elastica> elasticaFromJson(const nlohmann::json& object, const std::string& path);

}  // namespace bw::cases
