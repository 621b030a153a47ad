// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/change_timer.h"

#include <algorithm>

namespace bw::app {

ChangeTimer::ChangeTimer(MainWindow& window, int changes, QObject* parent)
    : QObject(parent), window_(window), changes_(changes) {}

void ChangeTimer::start() {
  stations_ = window_.bench().cut().sections.stations;
  // Queued: the next change begins with an idle window, as one by hand does.
  connect(
      &window_, &MainWindow::pictureStands, this,
      [this] {
        seconds_.push_back(window_.pictureDelay());
        change();
      },
      Qt::QueuedConnection);
  connect(
      &window_.bench().runner(), &model::EvaluationRunner::finished, this,
      [this] {
        if (!window_.bench().current()) emit finished();
      },
      Qt::QueuedConnection);
  change();
}

void ChangeTimer::change() {
  if (int(seconds_.size()) == changes_) return emit finished();
  // Each number is another one, so that no earlier result can be used again.
  const int next = stations_ + 1 + int(seconds_.size());
  window_.bench().editCut(tr("Change stations"), [next](Cut& cut) { cut.sections.stations = next; });
}

QString summaryOf(std::vector<double> seconds) {
  if (seconds.empty()) return QStringLiteral("no change had a result");
  std::sort(seconds.begin(), seconds.end());
  return QStringLiteral("%1 changes: %2 s at best, %3 s in the middle, %4 s at worst")
      .arg(seconds.size())
      .arg(seconds.front(), 0, 'f', 3)
      .arg(seconds[seconds.size() / 2], 0, 'f', 3)
      .arg(seconds.back(), 0, 'f', 3);
}

}  // namespace bw::app
