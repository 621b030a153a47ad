// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/end_of_session.h"

#include <fcntl.h>
#include <unistd.h>

#include <QApplication>
#include <QSessionManager>

#include <array>
#include <cerrno>
#include <csignal>

#include "bw/pipeline/exit_status.h"

namespace bw::app {

namespace {

constexpr std::array kEnding = {SIGTERM, SIGHUP, SIGINT};

// A handler knows no object: what it writes wakes the event loop.
int wakePipe[2] = {-1, -1};

void wake(int) {
  const int kept = errno;
  const char byte = 0;
  static_cast<void>(!::write(wakePipe[1], &byte, 1));
  errno = kept;
}

}  // namespace

EndOfSession::EndOfSession(MainWindow& window) : window_(window) {
  connect(
      qApp, &QGuiApplication::commitDataRequest, this, [this](QSessionManager&) { window_.keepWork(); },
      Qt::DirectConnection);
  if (::pipe2(wakePipe, O_CLOEXEC | O_NONBLOCK) != 0) return;
  notifier_ = std::make_unique<QSocketNotifier>(wakePipe[0], QSocketNotifier::Read);
  connect(notifier_.get(), &QSocketNotifier::activated, this, &EndOfSession::end);
  struct sigaction action {};
  action.sa_handler = wake;
  action.sa_flags = SA_RESTART;
  for (const int signal : kEnding) ::sigaction(signal, &action, nullptr);
}

EndOfSession::~EndOfSession() {
  if (!notifier_) return;
  if (ended_) window_.keepWork();  // what came in while the event loops ended
  for (const int signal : kEnding) std::signal(signal, SIG_DFL);
  for (int& end : wakePipe) ::close(end);
}

void EndOfSession::end() {
  ended_ = true;
  notifier_->setEnabled(false);
  window_.keepWork();
  // All event loops end, those of open dialogs too.
  QApplication::exit(pipeline::kInterrupted);
}

}  // namespace bw::app
