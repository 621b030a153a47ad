// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace bw {

/// `text` as one line that a terminal, a log or a label shows as it is: control characters, the marks that
/// turn the direction of writing, the separators of lines and bytes that are no UTF-8 become escapes ("\n",
/// "\x1b", "\u202e"). Names of files, keys and entities come from outside; none of them moves a cursor,
/// hides a word or feigns a second message. All else stays, byte for byte. O(n).
std::string printable(std::string_view text);

/// Why files cannot be called after a name: it is blank, has more than 60 bytes, begins with a point, has
/// blanks at its ends, or signs that file names do without. Empty if they can.
std::string whyNoFileName(const std::string& name);

/// True for well-formed UTF-8: no overlong forms, no surrogates.
bool isUtf8(std::string_view text);

}  // namespace bw
