// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QSocketNotifier>
#include <QString>

#include <memory>

#include "window/main_window.h"

namespace bw::app {

/// From now on a fatal error of Qt, such as a display that is not there, ends the program with one sentence
/// and `pipeline::kNoDisplay` instead of an abort. Call it before the application is made.
void explainFatalErrors();

/// Why the 3D view cannot be drawn on this display, in words with a remedy; empty if it can. Needs the
/// application.
QString openGlProblem();

/// Shows `problem` on standard error, and in a box if `box` and there is a screen for it.
void tellOpenGlProblem(const QString& problem, bool box);

/// Keeps unsaved work when the program is ended from outside: SIGTERM, SIGHUP (the terminal or the
/// connection is gone) and SIGINT copy the design and end the program with the status of an interrupted one;
/// a desktop session that ends has it copied before it asks the windows to close. One for the program.
class EndOfSession : public QObject {
  Q_OBJECT

 public:
  explicit EndOfSession(MainWindow& window);
  /// Gives the signals their usual meaning again.
  ~EndOfSession() override;

 private:
  void end();

  MainWindow& window_;
  std::unique_ptr<QSocketNotifier> notifier_;
  bool ended_ = false;
};

}  // namespace bw::app
