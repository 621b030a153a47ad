// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

namespace bw::app {

/// From now on a fatal error of Qt, such as a display that is not there, ends the program with one sentence
/// and `pipeline::kNoDisplay` instead of an abort. Call it before the application is made.
void explainFatalErrors();

/// Why the 3D view cannot be drawn on this display, in words with a remedy; empty if it can. Needs the
/// application.
QString openGlProblem();

/// Shows `problem` on standard error, and in a box if `box` and there is a screen for it.
void tellOpenGlProblem(const QString& problem, bool box);

}  // namespace bw::app
