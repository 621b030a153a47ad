// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include <QApplication>
#include <QSurfaceFormat>
#include <QTimer>

#include <unistd.h>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "bw/core/text/printable.h"
#include "bw/pipeline/exit_status.h"
#include "bw/view/scene_view.h"
#include "window/desktop.h"
#include "window/main_window.h"
#include "window/options.h"
#include "workbench/handover.h"

namespace {

using namespace bw::pipeline;  // the exit statuses

/// Seconds since the operating system started this process; negative if it does not tell.
double secondsSinceProcessStart() {
  std::ifstream file("/proc/self/stat");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  const std::size_t name = text.rfind(')');
  if (name == std::string::npos) return -1;
  std::istringstream rest(text.substr(name + 1));
  std::string word;
  // The start time is field 22; field 3 follows the name.
  for (int field = 3; field <= 22; ++field) rest >> word;
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec) - std::stod(word) / double(sysconf(_SC_CLK_TCK));
}

/// Changes the number of stations again and again and takes the time until each new picture stands: what a
/// user waits for, measured in the window itself.
class ChangeTimer : public QObject {
 public:
  ChangeTimer(bw::app::MainWindow& window, int changes) : window_(window), changes_(changes) {}

  /// Begins; the present result must stand. `finished` is called once.
  void start(const std::function<void()>& finished) {
    finished_ = finished;
    const auto result = window_.bench().sweep();
    stations_ = window_.bench().cut().sections.stations.value_or(result ? int(result->size()) : 0);
    // Queued: the next change begins with an idle window, as one by hand does.
    connect(
        &window_, &bw::app::MainWindow::pictureStands, this,
        [this] {
          seconds_.push_back(window_.pictureDelay());
          change();
        },
        Qt::QueuedConnection);
    connect(
        &window_.bench().runner(), &bw::model::EvaluationRunner::finished, this,
        [this] {
          if (!window_.bench().current()) finished_();
        },
        Qt::QueuedConnection);
    change();
  }

  /// Whether each change had a result.
  bool complete() const { return int(seconds_.size()) == changes_; }

  /// One line of text: smallest, median and largest of the seconds.
  QString summary() const {
    if (seconds_.empty()) return QStringLiteral("no change had a result");
    std::vector<double> seconds = seconds_;
    std::sort(seconds.begin(), seconds.end());
    return QStringLiteral("%1 changes: %2 s at best, %3 s in the middle, %4 s at worst")
        .arg(seconds.size())
        .arg(seconds.front(), 0, 'f', 3)
        .arg(seconds[seconds.size() / 2], 0, 'f', 3)
        .arg(seconds.back(), 0, 'f', 3);
  }

 private:
  void change() {
    if (complete()) return finished_();
    // Each number is another one, so that no earlier result can be used again.
    const int next = stations_ + 1 + int(seconds_.size());
    window_.bench().editCut(tr("Change stations"), [next](bw::Cut& cut) { cut.sections.stations = next; });
  }

  bw::app::MainWindow& window_;
  std::function<void()> finished_;
  int changes_, stations_ = 0;
  std::vector<double> seconds_;
};

}  // namespace

int main(int argc, char** argv) {
  // A file that outgrows a limit is a failed write with a message, not a death by signal.
  std::signal(SIGXFSZ, SIG_IGN);
  QStringList arguments;
  for (int i = 1; i < argc; ++i) arguments << QString::fromLocal8Bit(argv[i]);
  QString problem;
  const std::optional<bw::app::Options> options = bw::app::parseOptions(arguments, &problem);
  if (!options) {
    std::fprintf(stderr, "bladewright: %s\n", qPrintable(problem));
    return kBadInput;
  }
  if (options->help) {
    std::fputs(qPrintable(bw::app::helpText()), stdout);
    return 0;
  }
  if (options->version) {
    std::puts("bladewright " BW_VERSION);
    return 0;
  }

  bw::app::explainFatalErrors();
  QSurfaceFormat::setDefaultFormat(bw::view::SceneView::surfaceFormat());
  QApplication application(argc, argv);
  QApplication::setApplicationName("bladewright");
  QApplication::setDesktopFileName("bladewright");  // whose icon a Wayland desktop shows
  QApplication::setApplicationDisplayName("Bladewright");
  QApplication::setApplicationVersion(BW_VERSION);

  const bool oneShot =
      !options->screenshot.isEmpty() || options->quitAfterFirstPicture || options->timeChanges > 0;
  if (const QString lack = bw::app::openGlProblem(); !lack.isEmpty()) {
    bw::app::tellOpenGlProblem(lack, !oneShot);
    return kNoDisplay;
  }
  bw::model::Settings settings;
  bw::app::Theme theme;
  theme.apply(settings.theme());
  // A run for a picture or a timing leaves nothing behind and recovers nothing.
  if (oneShot) settings.forgetAll();
  bw::app::MainWindow window(settings, theme,
                             oneShot ? std::filesystem::path() : bw::model::Settings::recoveryFolder());
  const bw::app::EndOfSession ending(window);
  if (options->size.isValid()) window.resize(options->size);

  int status = 0;
  // Of a run for a picture: nobody may be there to read the notice.
  const auto complain = [&](const bw::Error& error) {
    std::fprintf(stderr, "bladewright: %s\n", bw::printable(error.message).c_str());
    status = statusOf(error.code);
  };
  ChangeTimer changes(window, options->timeChanges);
  const auto quit = [&] {
    if (!options->screenshot.isEmpty()) {
      // What moved is drawn smoothly once it rests.
      while (!window.onStartPage() && !window.sceneView().resting())
        QApplication::processEvents(QEventLoop::WaitForMoreEvents);
      const bw::Result<void> written =
          bw::app::writePng(window.grab().toImage(), options->screenshot.toStdString());
      if (!written) complain(written.error());
    }
    QApplication::exit(status);
  };
  const auto tellChanges = [&] {
    std::printf("%s\n", qPrintable(changes.summary()));
    if (!changes.complete()) status = kNoSolution;
    quit();
  };
  const auto finish = [&] {
    if (options->quitAfterFirstPicture)
      std::printf("first picture after %.2f s\n", secondsSinceProcessStart());
    if (options->timeChanges > 0 && window.bench().current())
      changes.start(tellChanges);
    else
      quit();
  };
  window.show();
  bw::Result<void> opened;
  if (!options->file.isEmpty())
    opened = window.openFile(options->file);
  else if (!options->example.isEmpty())
    opened = window.openExample(options->example);
  if (!oneShot) window.recover();
  if (oneShot) {
    if (!opened) complain(opened.error());
    const auto await = [&] {
      if (window.onStartPage()) {
        QTimer::singleShot(0, &window, finish);
        return;
      }
      // The result's picture, or the notice that tells why there is none.
      QObject::connect(&window, &bw::app::MainWindow::pictureStands, &window, finish,
                       static_cast<Qt::ConnectionType>(Qt::QueuedConnection | Qt::SingleShotConnection));
      QObject::connect(&window.bench().runner(), &bw::model::EvaluationRunner::finished, &window, [&] {
        if (window.bench().current()) return;
        if (const std::optional<bw::Error>& error = window.bench().runner().error()) complain(*error);
        QTimer::singleShot(0, &window, finish);
      });
    };
    if (window.bench().reading())
      QObject::connect(
          &window.bench(), &bw::app::Workbench::readingEnded, &window,
          [&, await] {
            if (const std::optional<bw::Error>& error = window.bench().readingError()) complain(*error);
            await();
          },
          Qt::SingleShotConnection);
    else
      await();
  }
  return QApplication::exec();
}
