// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

namespace bw {

/// A number of a design, whose default is that of its member: the readers and writers of files and the window
/// take its words and limits from here, so that a new one is a row and a member.
template <class Owner>
struct NumberSetting {
  double Owner::*member;
  const char* key;    ///< in files
  const char* title;  ///< in the window
  const char* unit;   ///< shown, as of the value times `scale`
  double min, max;    ///< that a file may state
  double typedMin;    ///< that may be typed; ≥ min
  int decimals;       ///< shown at least, unless zeros
  double step;        ///< of the arrow keys
  const char* help;
  const char* change;  ///< of a step of undo
  double scale = 1;    ///< shown per stored
};

}  // namespace bw
