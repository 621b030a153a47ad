// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "bw/model/document.h"

namespace bw::model {

/// The design before the last step of the history that changed more of it than its versions; null where there
/// is none.
std::shared_ptr<const Design> designBefore(Document& document);

}  // namespace bw::model
