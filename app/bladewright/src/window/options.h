// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QSize>
#include <QString>
#include <QStringList>

#include <optional>

namespace bw::app {

/// The command line of the window.
struct Options {
  QString file;        ///< to open at the start; may be empty
  QString example;     ///< name of an example to open at the start, instead of a file; may be empty
  QString screenshot;  ///< PNG of the window once the result stands, then quit
  QSize size;          ///< of the window, if given
  bool quitAfterFirstPicture = false;
  int timeChanges = 0;  ///< how many changes of the station count to time, then quit
  bool help = false, version = false;
};

/// Reads the arguments (without the program's name); a wrong one is described in `problem`.
std::optional<Options> parseOptions(const QStringList& arguments, QString* problem);

/// The text of --help.
QString helpText();

}  // namespace bw::app
