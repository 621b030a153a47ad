// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

namespace bw {

/// How long tests wait for what must come, ms: a bound against hanging, not a timing. A machine may be slow,
/// and busy with other tests besides.
inline constexpr int kPatience = 300000;

}  // namespace bw
