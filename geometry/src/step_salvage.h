// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <StepData_StepModel.hxx>

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace bw::geometry {

/// What was made of the damaged entities of a STEP model.
struct Salvage {
  std::vector<std::string> mended;  ///< in words
  std::string damage;               ///< which entities are damaged and how; empty if none
  std::string unitDamage;           ///< the same of the units
  std::string fault;                ///< why nothing of the file can be used; empty if something can
};

/// "#3, #8 and 40 more" for numbers of entities.
std::string entityList(const std::set<int>& entities);

/// Makes a STEP model safe to translate: OCCT's translators follow references without looking whether they
/// lead anywhere. A shape without a name, where the standard asks for one, gets an empty one. Faces that need
/// a damaged entity are taken out of their shells, and so is what else of the shapes needs one. `text` is
/// that of the model.
Salvage salvage(const Handle(StepData_StepModel) & model, std::string_view text);

}  // namespace bw::geometry
