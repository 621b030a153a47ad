// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A window that is edited without a pause and ended at random moments: killed, it loses at most the edits of
// the last seconds; asked to end, nothing. This program starts itself as that window.
#include <gtest/gtest.h>

#include <signal.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QProcess>
#include <QTemporaryDir>
#include <QTimer>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <random>
#include <vector>

#include "bw/model/document.h"
#include "bw/model/recovery.h"
#include "patience.h"
#include "window/desktop.h"
#include "window/main_window.h"

namespace bw::app {
namespace {

namespace fs = std::filesystem;

constexpr int kRounds = 3;
constexpr unsigned kSeed = 20261122;
constexpr double kPromise = 5;              // s of edits that may be lost
constexpr double kLongest = 9;              // s until a kill
constexpr double kFirst = 1, kStep = 1e-3;  // mm: the tolerance counts the edits

int rounds() {
  const char* text = std::getenv("BW_HOSTILE");
  return kRounds * std::max(1, text ? std::atoi(text) : 1);
}

int editOf(const Design& design) { return int(std::lround((design.process.tolerance - kFirst) / kStep)); }

/// One window in a process of its own, and when it made which edit.
class EditedWindow {
 public:
  explicit EditedWindow(const fs::path& folder) {
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("BW_HOSTILE_WINDOW", QString::fromStdString(folder.string()));
    process_.setProcessEnvironment(environment);
    process_.start(QCoreApplication::applicationFilePath(), QStringList());
    EXPECT_TRUE(process_.waitForStarted(kPatience));
    EXPECT_TRUE(readUntil([this] { return !edits_.empty(); }));
    clock_.start();
  }
  ~EditedWindow() {
    if (process_.state() != QProcess::NotRunning) {
      process_.kill();
      process_.waitForFinished(kPatience);
    }
  }

  void editFor(double seconds) {
    readUntil([&] { return double(clock_.elapsed()) > 1e3 * seconds; });
  }

  /// Sends `signal` and waits for the end; the exit status, −1 if it died of the signal.
  int end(int signal) {
    ended_ = double(clock_.elapsed()) * 1e-3;
    ::kill(pid_t(process_.processId()), signal);
    EXPECT_TRUE(process_.waitForFinished(kPatience));
    take();
    return process_.exitStatus() == QProcess::NormalExit ? process_.exitCode() : -1;
  }

  /// The last edit that was told `seconds` before the end; 0 if none.
  int lastEdit(double seconds) const {
    int last = 0;
    for (const auto& [time, number] : edits_)
      if (time < ended_ - seconds) last = number;
    return last;
  }
  int lastEdit() const { return edits_.empty() ? 0 : edits_.back().second; }

 private:
  void take() {
    while (process_.canReadLine())
      if (const int number = process_.readLine().trimmed().toInt(); number > 0)
        edits_.emplace_back(clock_.isValid() ? double(clock_.elapsed()) * 1e-3 : 0.0, number);
  }
  bool readUntil(const std::function<bool()>& done) {
    QElapsedTimer patience;
    patience.start();
    while (!done()) {
      if (patience.elapsed() > kPatience || process_.state() == QProcess::NotRunning) return false;
      process_.waitForReadyRead(10);
      take();
    }
    return true;
  }

  QProcess process_;
  QElapsedTimer clock_;
  double ended_ = 0;
  std::vector<std::pair<double, int>> edits_;
};

/// What the copy in `folder` holds once nobody owns it.
int recovered(const fs::path& folder) {
  const std::vector<model::RecoveryCopy> copies = model::listRecovery(folder);
  if (copies.empty()) return 0;
  EXPECT_EQ(copies.size(), 1u);
  model::Document document(folder);
  const Result<void> read = document.recover(copies.front().copy);
  EXPECT_TRUE(read) << read.error().message;
  const int edit = read ? editOf(*document.design()) : 0;
  document.discardCopy();
  return edit;
}

TEST(WindowKills, LoseAtMostTheLastSeconds) {
  std::mt19937 random(kSeed);
  double worst = 0;
  for (int round = 0; round < rounds(); ++round) {
    SCOPED_TRACE(round);
    QTemporaryDir folder;
    const fs::path recovery = folder.path().toStdString();
    EditedWindow window(recovery);
    window.editFor(kLongest * double(random()) / double(std::mt19937::max()));
    EXPECT_EQ(window.end(SIGKILL), -1);
    const int kept = recovered(recovery);
    EXPECT_GE(kept, window.lastEdit(kPromise));
    double lost = kPromise;
    while (lost > 0 && kept >= window.lastEdit(lost)) lost -= 0.1;
    worst = std::max(worst, lost);
    EXPECT_TRUE(model::listRecovery(recovery).empty());
  }
  std::cout << "hostile window kills: " << rounds() << " kills at random moments, at most " << worst
            << " s of edits lost, every copy readable\n";
}

TEST(WindowKills, LoseNothingWhereTheProgramIsAskedToEnd) {
  for (const int signal : {SIGTERM, SIGHUP, SIGINT}) {
    SCOPED_TRACE(signal);
    QTemporaryDir folder;
    const fs::path recovery = folder.path().toStdString();
    EditedWindow window(recovery);
    window.editFor(0.2);
    EXPECT_EQ(window.end(signal), 130);
    EXPECT_EQ(recovered(recovery), window.lastEdit());
  }
}

/// The window that the tests start: an edit at every turn of the event loop, each told on standard output.
int beEdited(const fs::path& recovery) {
  model::Settings settings;
  settings.forgetAll();
  Theme theme;
  MainWindow window(settings, theme, recovery);
  window.questions().showFolder = [](const QString&) {};
  const EndOfSession ending(window);
  window.show();
  if (!window.openExample("saddle")) return 1;
  QTimer edits;
  int number = 0;
  QObject::connect(&edits, &QTimer::timeout, [&] {
    ++number;
    window.bench().editDesign(
        "Change tolerance", [&](Design& design) { design.process.tolerance = kFirst + kStep * number; }, 1);
    std::printf("%d\n", number);
    std::fflush(stdout);
  });
  edits.start(5);
  return QApplication::exec();
}

}  // namespace
}  // namespace bw::app

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  QSurfaceFormat::setDefaultFormat(bw::view::SceneView::surfaceFormat());
  QApplication application(argc, argv);
  QApplication::setApplicationVersion(BW_VERSION);
  if (const char* folder = std::getenv("BW_HOSTILE_WINDOW")) return bw::app::beEdited(folder);
  return RUN_ALL_TESTS();
}
