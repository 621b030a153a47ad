// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>

#include <vector>

#include "window/main_window.h"

namespace bw::app {

/// Changes the number of stations again and again and takes the time until each new picture stands: what a
/// user waits for, measured in the window itself.
class ChangeTimer : public QObject {
  Q_OBJECT

 public:
  ChangeTimer(MainWindow& window, int changes, QObject* parent = nullptr);
  /// Begins; the present result must stand.
  void start();
  /// Seconds of each change in order; fewer than asked for if a change had no result.
  const std::vector<double>& seconds() const { return seconds_; }

 signals:
  void finished();

 private:
  void change();

  MainWindow& window_;
  int changes_, stations_ = 0;
  std::vector<double> seconds_;
};

/// One line of text: smallest, median and largest of `seconds`.
QString summaryOf(std::vector<double> seconds);

}  // namespace bw::app
