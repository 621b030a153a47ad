// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/desktop.h"

#include <fcntl.h>
#include <unistd.h>

#include <QApplication>
#include <QGuiApplication>
#include <QMessageBox>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLWidget>
#include <QSessionManager>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "bw/core/text/printable.h"
#include "bw/pipeline/exit_status.h"
#include "bw/view/scene_view.h"

namespace bw::app {

namespace {

QtMessageHandler plainHandler = nullptr;
bool widgetsRefused = false;  ///< Qt said that it draws no OpenGL into widgets on this platform

/// Why there is no window, and what to do.
std::string displayProblem() {
  const char* display = std::getenv("DISPLAY");
  const char* wayland = std::getenv("WAYLAND_DISPLAY");
  if ((!display || !*display) && (!wayland || !*wayland))
    return "there is no display (DISPLAY and WAYLAND_DISPLAY are not set); start it in a desktop session, or "
           "under xvfb-run";
  std::string names;
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"})
    if (const char* value = std::getenv(name))
      names += (names.empty() ? "" : ", ") + std::string(name) + "=" + value;
  return "the display cannot be reached (" + printable(names) + "); correct that";
}

void handle(QtMsgType type, const QMessageLogContext& context, const QString& text) {
  if (text.startsWith("QOpenGLWidget is not supported")) widgetsRefused = true;
  if (type != QtFatalMsg) return plainHandler(type, context, text);
  const bool display = text.contains("platform plugin");
  const std::string words = display ? "no window can be opened: " + displayProblem() +
                                          ". The program blade works without a display."
                                    : "Qt ended the program: " + printable(text.toStdString());
  std::fprintf(stderr, "bladewright: %s\n", words.c_str());
  std::fflush(nullptr);
  std::_Exit(display ? pipeline::kNoDisplay : pipeline::kInternal);
}

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

void explainFatalErrors() { plainHandler = qInstallMessageHandler(handle); }

QString openGlProblem() {
  const QString remedy = QObject::tr(
      " Install or update the graphics driver (for instance libgl1-mesa-dri), or work with the command line "
      "program blade.");
  QOpenGLContext context;
  context.setFormat(view::SceneView::surfaceFormat());
  if (!context.create())
    return QObject::tr("The 3D view needs OpenGL 3.2; this display offers none.") + remedy;
  QOffscreenSurface surface;
  surface.setFormat(context.format());
  surface.create();
  if (!context.makeCurrent(&surface))
    return QObject::tr("The 3D view needs OpenGL 3.2; this display refuses to draw with it.") + remedy;
  // Some platforms have OpenGL, but none for widgets.
  { const QOpenGLWidget probe; }
  if (widgetsRefused)
    return QObject::tr("The 3D view needs OpenGL in its window; the platform %1 offers none.")
               .arg(QGuiApplication::platformName()) +
           remedy;
  const auto [major, minor] = context.format().version();
  const bool embedded = context.isOpenGLES();
  context.doneCurrent();
  if (embedded || major < 3 || (major == 3 && minor < 2))
    return QObject::tr("The 3D view needs OpenGL 3.2; this display offers %1%2.%3.")
               .arg(embedded ? QStringLiteral("OpenGL ES ") : QString())
               .arg(major)
               .arg(minor) +
           remedy;
  return {};
}

void tellOpenGlProblem(const QString& problem, bool box) {
  std::fprintf(stderr, "bladewright: %s\n", qPrintable(problem));
  const QString platform = QGuiApplication::platformName();
  if (box && platform != "offscreen" && platform != "minimal")
    QMessageBox::critical(nullptr, QObject::tr("Bladewright cannot draw"), problem);
}

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
