// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bw/core/base/finding.h"

namespace bw::words {

/// Who reads: what can be done is told in the words of the command line or of the window.
enum class Reader { commandLine, window };

/// The stable word of a finding's kind, for scripts: "deviation", "section-short", …; of a program's check
/// the rule, "rapid-rule-13".
std::string kindWord(const Finding& finding);

/// The block and the cut of a place, as they stand before a sentence: "block-2, north". Empty where neither
/// is named.
std::string partName(const Place& place);

/// Where it is: "station 8", "end of the cut", a file. Empty where it has no place.
std::string placeText(const Finding& finding);

/// What is wrong, where, by how much, and what to do: one sentence that begins in lower case, without its
/// full stop. Blocks and stations are named in it, other places are not.
std::string sentence(const Finding& finding, Reader reader);

/// The same as it stands in a list of its own: with its place, and with a capital.
std::string listed(const Finding& finding, Reader reader);

/// What doing a remedy is called, for a button: "Use a blade of 812 mm". Empty for what only a person can do.
std::string action(const Remedy& remedy);

/// The sentences of all errors but those about programs.
std::vector<std::string> errorsOf(const Findings& findings, Reader reader);

}  // namespace bw::words
