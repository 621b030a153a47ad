// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "bw/core/design/face_choice.h"
#include "bw/core/text/json_reader.h"

namespace bw {

/// Coordinates of designs are at most this large, mm: ten kilometres.
inline constexpr double kFarthest = 1e7;

/// Reads the keys "face" and "near".
void readFaceChoice(ObjectReader& reader, FaceChoice& face);

/// Writes both keys.
void writeFaceChoice(const FaceChoice& face, nlohmann::json& object);

}  // namespace bw
