// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QCoreApplication>
#include <QStringList>

namespace bw::app {

// Words of choices for a cut, in the order of their values.

inline QString cutWord(const char* word) { return QCoreApplication::translate("CutWords", word); }

/// `BlockFace`
inline QStringList faceWords() {
  return {cutWord("Top"),   cutWord("Bottom"), cutWord("Left"),
          cutWord("Right"), cutWord("Front"),  cutWord("Back")};
}
/// `CutPose::quarters`
inline QStringList turnWords() { return {cutWord("0°"), cutWord("90°"), cutWord("180°"), cutWord("270°")}; }
/// `KeptSide`
inline QStringList keptWords() {
  return {cutWord("Below"), cutWord("Above"),    cutWord("Left"),
          cutWord("Right"), cutWord("In front"), cutWord("Behind")};
}

}  // namespace bw::app
