// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The window as a program that writes a picture and ends: what scripts rely on.
#include <gtest/gtest.h>

#include <QImage>
#include <QProcess>
#include <QProcessEnvironment>
#include <QStandardPaths>
#include <QTemporaryDir>

#include <filesystem>
#include <fstream>

namespace {

struct Finished {
  int status = -1;
  std::string err;
};

class Program : public ::testing::Test {
 protected:
  Finished run(const QStringList& arguments, const QProcessEnvironment& environment = here(),
               const QString& program = BW_WINDOW) {
    QProcess process;
    process.setProcessEnvironment(environment);
    process.start(program, arguments);
    EXPECT_TRUE(process.waitForFinished(60000)) << process.errorString().toStdString();
    if (process.state() != QProcess::NotRunning) process.kill();
    return {process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -1,
            process.readAllStandardError().toStdString()};
  }

  /// The environment of this test, with settings of its own.
  static QProcessEnvironment here() { return QProcessEnvironment::systemEnvironment(); }
  QProcessEnvironment apart() const {
    QProcessEnvironment environment = here();
    for (const char* name : {"HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME"})
      environment.insert(name, folder_.path());
    return environment;
  }

  QString path(const QString& name) const { return folder_.filePath(name); }

  QTemporaryDir folder_;
};

TEST_F(Program, TellsThatAFileIsMissing) {
  const Finished end = run({path("nofile.step"), "--screenshot", path("x.png")});
  EXPECT_EQ(end.status, 4);
  EXPECT_NE(end.err.find("bladewright: there is no file " + path("nofile.step").toStdString()),
            std::string::npos)
      << end.err;
}

TEST_F(Program, TellsThatADesignIsMissing) {
  const Finished end = run({path("nofile.bladewright"), "--screenshot", path("x.png")});
  EXPECT_EQ(end.status, 4);
  EXPECT_NE(end.err.find("nofile.bladewright"), std::string::npos) << end.err;
}

TEST_F(Program, TellsWhyAFileHasNoResult) {
  std::ofstream(path("garbage.step").toStdString()) << "ISO-10303-21; and then nothing";
  const Finished end = run({path("garbage.step"), "--screenshot", path("x.png")});
  EXPECT_NE(end.status, 0);
  EXPECT_NE(end.err.find("bladewright: "), std::string::npos) << end.err;
}

TEST_F(Program, TellsThatAFileHasNoFaces) {
  const std::string file = std::string(BW_FOREIGN_DATA) + "/occ/asahi.brep";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "occt-misc is not installed";
  const Finished end = run({QString::fromStdString(file), "--quit-after-first-picture"});
  EXPECT_NE(end.status, 0);
  EXPECT_NE(end.err.find("no face"), std::string::npos) << end.err;
}

TEST_F(Program, EndsWellWithThePictureOfAResult) {
  const Finished end = run({"--example", "saddle", "--screenshot", path("x.png"), "--size", "1280x800"});
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(QImage(path("x.png")).size(), QSize(1280, 800));
}

// No display, or none that can draw: words and a status, never an abort or an empty window.

TEST_F(Program, TellsThatThereIsNoDisplay) {
  QProcessEnvironment environment = apart();
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}) environment.remove(name);
  const Finished none = run({}, environment);
  EXPECT_EQ(none.status, 6) << none.err;
  EXPECT_NE(none.err.find("bladewright: no window can be opened: there is no display"), std::string::npos)
      << none.err;
  environment.insert("DISPLAY", ":4321");
  const Finished wrong = run({}, environment);
  EXPECT_EQ(wrong.status, 6) << wrong.err;
  EXPECT_NE(wrong.err.find("bladewright: no window can be opened"), std::string::npos) << wrong.err;
  environment.insert("QT_QPA_PLATFORM", "nonsense");
  EXPECT_EQ(run({}, environment).status, 6);
}

TEST_F(Program, TellsThatThereIsNoOpenGl) {
  QProcessEnvironment environment = apart();
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"}) environment.remove(name);
  environment.insert("QT_QPA_PLATFORM", "offscreen");
  const Finished offscreen = run({"--example", "saddle"}, environment);
  EXPECT_EQ(offscreen.status, 6) << offscreen.err;
  EXPECT_NE(offscreen.err.find("needs OpenGL"), std::string::npos) << offscreen.err;
  // The platform that draws nowhere, on a display: it has OpenGL, but not for widgets.
  environment = apart();
  environment.insert("QT_QPA_PLATFORM", "offscreen");
  const Finished nowhere = run({"--example", "saddle", "--screenshot", path("x.png")}, environment);
  EXPECT_EQ(nowhere.status, 6) << nowhere.err;
  EXPECT_NE(nowhere.err.find("needs OpenGL"), std::string::npos) << nowhere.err;
  // A driver that is not there, on the display of this test.
  environment = apart();
  environment.insert("LIBGL_DRIVERS_PATH", "/nonexistent");
  const Finished driver = run({"--example", "saddle", "--screenshot", path("x.png")}, environment);
  EXPECT_EQ(driver.status, 6) << driver.err;
  EXPECT_NE(driver.err.find("needs OpenGL 3.2"), std::string::npos) << driver.err;
}

TEST_F(Program, TellsThatTheDisplayHasNoOpenGl) {
  const QString server = QStandardPaths::findExecutable("Xvfb");
  if (server.isEmpty()) GTEST_SKIP() << "Xvfb is not installed";
  QProcess display;
  display.start(server,
                {"-displayfd", "1", "-screen", "0", "1280x800x24", "-extension", "GLX", "-nolisten", "tcp"});
  ASSERT_TRUE(display.waitForReadyRead(60000));
  QProcessEnvironment environment = apart();
  environment.insert("DISPLAY", ":" + QString::fromLatin1(display.readLine().trimmed()));
  // Without GLX, EGL serves; without both there are words.
  const Finished egl = run({"--example", "saddle", "--screenshot", path("egl.png")}, environment);
  EXPECT_EQ(egl.status, 0) << egl.err;
  environment.insert("QT_XCB_GL_INTEGRATION", "none");
  const Finished end = run({"--example", "saddle", "--screenshot", path("x.png")}, environment);
  EXPECT_EQ(end.status, 6) << end.err;
  EXPECT_NE(end.err.find("needs OpenGL"), std::string::npos) << end.err;
  display.terminate();
  display.waitForFinished(60000);
}

TEST_F(Program, SurvivesALimitOnTheSizeOfFiles) {
  const Finished end = run(
      {"-c", QString("ulimit -f 8; exec %1 --example saddle --screenshot %2").arg(BW_WINDOW, path("x.png"))},
      apart(), "/bin/bash");
  EXPECT_EQ(end.status, 4) << end.err;
  EXPECT_NE(end.err.find("no larger file"), std::string::npos) << end.err;
  EXPECT_FALSE(std::filesystem::exists(path("x.png").toStdString()));
}

}  // namespace
