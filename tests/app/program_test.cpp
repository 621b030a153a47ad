// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The window as a program that writes a picture and ends: what scripts rely on.
#include <gtest/gtest.h>

#include <QImage>
#include <QProcess>
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
  Finished run(const QStringList& arguments) {
    QProcess process;
    process.start(BW_WINDOW, arguments);
    EXPECT_TRUE(process.waitForFinished(60000)) << process.errorString().toStdString();
    if (process.state() != QProcess::NotRunning) process.kill();
    return {process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -1,
            process.readAllStandardError().toStdString()};
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

}  // namespace
