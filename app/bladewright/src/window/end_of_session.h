// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QSocketNotifier>

#include <memory>

#include "window/main_window.h"

namespace bw::app {

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
