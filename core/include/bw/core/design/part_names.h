// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What the parts of a design are called in another one.
#pragma once

#include <map>
#include <string>

#include "bw/core/design/design.h"

namespace bw {

/// The new names of parts by those that they had.
struct NewNames {
  std::map<std::string, std::string> blocks = {}, cuts = {}, sources = {};
};

/// Of lists as long as before each part that is called otherwise in the same place, by a name that no part
/// had, while none has its old one.
NewNames newNames(const Design& before, const Design& after);

/// The name that a part has now.
void followName(const std::map<std::string, std::string>& names, std::string& name);

/// A design with its parts called so, which name each other so too.
Design calledSo(Design design, const NewNames& names);

}  // namespace bw
