// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Autosaved copies: when they are written, how a crash leaves them, who takes them away.
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "bw/core/files/file_set.h"
#include "bw/model/document.h"
#include "bw/model/recovery.h"
#include "patience.h"

namespace bw::model {
namespace {

namespace fs = std::filesystem;

class Recovery : public ::testing::Test {
 protected:
  static Design design(const std::string& name = "Panel") {
    Design design;
    design.name = name;
    design.source().path = "panel.step";
    design.source().bytes = "ISO-10303-21;";
    return design;
  }

  /// What a process leaves that makes `edits` changes, each copied, and is killed.
  void crash(const std::string& name, int stations, const fs::path& file = {}) {
    const pid_t child = ::fork();
    if (child == 0) {
      RecoveryFile copy(folder());
      Design changed = design(name);
      changed.cut().sections.stations = stations;
      QImage picture(48, 30, QImage::Format_RGB32);
      picture.fill(Qt::red);
      const bool written = copy.write(changed, {file, std::nullopt}, picture).has_value();
      ::kill(::getpid(), written ? SIGKILL : SIGTERM);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  }

  fs::path folder() const { return fs::path(folder_.path().toStdString()) / "recovery"; }
  fs::path path(const std::string& name) const { return fs::path(folder_.path().toStdString()) / name; }

  std::size_t filesLeft() const {
    std::error_code error;
    std::size_t count = 0;
    for (fs::directory_iterator it(folder(), error), end; !error && it != end; it.increment(error)) ++count;
    return count;
  }

  QTemporaryDir folder_;
};

TEST_F(Recovery, CopiesEditsThatNeverPause) {
  Document document(folder());
  document.start(design());
  int stations = 10;
  // An edit at every turn of the event loop: no pause ever comes.
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        document.editDesign("Change stations", 1,
                            [&](Design& design) { design.cut().sections.stations = ++stations; });
        return filesLeft() > 0;
      },
      kPatience))
      << "every edit started the clock again";
}

TEST_F(Recovery, ListsEveryCrashedDesignNewestFirst) {
  crash("first", 11, "/home/somebody/first.bladewright");
  crash("second", 12);
  crash("third", 13);
  // File times may be as coarse as the system's tick: put some seconds between them.
  const auto now = fs::file_time_type::clock::now();
  for (const RecoveryCopy& copy : listRecovery(folder()))
    fs::last_write_time(copy.copy, now - std::chrono::seconds(copy.name == "first"    ? 30
                                                              : copy.name == "second" ? 20
                                                                                      : 10));
  const std::vector<RecoveryCopy> copies = listRecovery(folder());
  ASSERT_EQ(copies.size(), 3u);
  EXPECT_EQ(copies[0].name, "third");
  EXPECT_EQ(copies[1].name, "second");
  EXPECT_EQ(copies[2].name, "first");
  EXPECT_EQ(copies[2].file, "/home/somebody/first.bladewright");
  EXPECT_TRUE(copies[0].file.empty());
  EXPECT_EQ(copies[0].size, fs::file_size(copies[0].copy));
  EXPECT_EQ(copies[0].picture.size(), QSize(48, 30));
  EXPECT_TRUE(copies[0].time.isValid());
  EXPECT_TRUE(copies[0].problem.isEmpty());
  EXPECT_EQ(listRecovery(folder()).size(), 3u) << "looking took them away";
}

TEST_F(Recovery, ListsNoCopyOfALivingWindow) {
  Document document(folder());
  document.start(design());
  document.editDesign("Change stations", -1, [](Design& design) { design.cut().sections.stations = 21; });
  document.autosaveNow(true);
  ASSERT_GT(filesLeft(), 0u);
  EXPECT_TRUE(listRecovery(folder()).empty());
}

TEST_F(Recovery, KeepsTheCopyUntilItsSuccessorStands) {
  crash("lost", 21);
  const std::vector<RecoveryCopy> copies = listRecovery(folder());
  ASSERT_EQ(copies.size(), 1u);
  {
    Document document(folder());
    ASSERT_TRUE(document.recover(copies[0].copy));
    EXPECT_TRUE(document.modified());
    EXPECT_EQ(document.design()->cut().sections.stations, 21);
    EXPECT_TRUE(listRecovery(folder()).empty()) << "two windows on one copy";
    EXPECT_FALSE(Document(folder()).recover(copies[0].copy));
    EXPECT_FALSE(discardRecovery(copies[0].copy));
  }  // this window ends without saving or discarding: as a crash does
  ASSERT_EQ(listRecovery(folder()).size(), 1u);
  {
    Document document(folder());
    ASSERT_TRUE(document.recover(copies[0].copy));
    EXPECT_FALSE(document.saveAs("/proc/no-place-here/a.bladewright"));
    EXPECT_TRUE(fs::exists(copies[0].copy)) << "a save that failed took the copy";
    ASSERT_TRUE(document.saveAs(path("a.bladewright")));
  }
  EXPECT_TRUE(listRecovery(folder()).empty());
  EXPECT_EQ(filesLeft(), 0u);
}

TEST_F(Recovery, GoesWhenThePersonDiscardsIt) {
  crash("unwanted", 21);
  const std::vector<RecoveryCopy> copies = listRecovery(folder());
  ASSERT_EQ(copies.size(), 1u);
  EXPECT_TRUE(discardRecovery(copies[0].copy));
  EXPECT_EQ(filesLeft(), 0u);
  Document document(folder());
  document.start(design());
  document.editDesign("Change stations", -1, [](Design& design) { design.cut().sections.stations = 21; });
  document.autosaveNow(true);
  document.discardCopy();
  EXPECT_EQ(filesLeft(), 0u);
}

TEST_F(Recovery, GoesWhenEverythingIsUndone) {
  Document document(folder());
  document.start(design());
  document.editDesign("Change stations", -1, [](Design& design) { design.cut().sections.stations = 21; });
  document.autosaveNow(true);
  ASSERT_GT(filesLeft(), 0u);
  document.undoStack().undo();
  document.autosaveNow(true);
  EXPECT_EQ(filesLeft(), 0u);
}

TEST_F(Recovery, KeepsAndNamesACopyThatCannotBeRead) {
  crash("damaged", 21);
  const fs::path copy = listRecovery(folder()).at(0).copy;
  fs::resize_file(copy, fs::file_size(copy) / 2);
  const std::vector<RecoveryCopy> copies = listRecovery(folder());
  ASSERT_EQ(copies.size(), 1u);
  EXPECT_FALSE(copies[0].problem.isEmpty());
  Document document(folder());
  const Result<void> recovered = document.recover(copy);
  ASSERT_FALSE(recovered);
  EXPECT_NE(recovered.error().message.find(copy.string()), std::string::npos) << recovered.error().message;
  EXPECT_TRUE(fs::exists(copy));
  EXPECT_TRUE(document.empty());
}

TEST_F(Recovery, ClearsWhatDeadOwnersLeftBeside) {
  fs::create_directories(folder());
  const fs::path base = folder() / "0b0b8f6c-5a6a-4a7e-9a51-2f3c1f0f6d11";
  // A lock that names this very process, as one with a number that was given out again would.
  ASSERT_TRUE(writeFile(base.string() + ".lock", std::to_string(::getpid()) + "\nmodel_tests\n"));
  ASSERT_TRUE(writeFile(base.string() + ".bladewright.part-1", "half"));
  ASSERT_TRUE(writeFile(base.string() + ".origin", ""));
  EXPECT_TRUE(listRecovery(folder()).empty());
  EXPECT_EQ(filesLeft(), 0u);
  // With a copy beside it such a lock does not hide the copy.
  ASSERT_TRUE(saveDesign(design("hidden"), base.string() + ".bladewright"));
  ASSERT_TRUE(writeFile(base.string() + ".lock", std::to_string(::getpid()) + "\nmodel_tests\n"));
  ASSERT_EQ(listRecovery(folder()).size(), 1u);
  EXPECT_EQ(filesLeft(), 1u);
}

TEST_F(Recovery, TellsOnceWhenTheCopyCannotBeWritten) {
  Document document("/proc/bladewright-has-no-place-here");
  QSignalSpy failed(&document, &Document::autosaveFailed);
  document.start(design());
  document.editDesign("Change stations", -1, [](Design& design) { design.cut().sections.stations = 21; });
  document.autosaveNow(true);
  ASSERT_TRUE(QTest::qWaitFor([&] { return failed.count() == 1; }, kPatience));
  document.autosaveNow(true);
  QCoreApplication::processEvents();
  EXPECT_EQ(failed.count(), 1);
}

TEST_F(Recovery, KnowsThatAnotherWroteTheFile) {
  const fs::path file = path("a.bladewright");
  Document document(folder());
  document.start(design());
  ASSERT_TRUE(document.saveAs(file));
  EXPECT_FALSE(document.changedOnDisk());
  fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::hours(1));
  EXPECT_FALSE(document.changedOnDisk()) << "the same content under another time";
  Document other({});
  ASSERT_TRUE(other.open(file));
  other.editDesign("Change stations", -1, [](Design& design) { design.cut().sections.stations = 33; });
  ASSERT_TRUE(other.saveAs(file));
  EXPECT_FALSE(other.changedOnDisk());
  EXPECT_TRUE(document.changedOnDisk());
  // A copy remembers what the file was, too.
  document.editDesign("Change stations", -1, [](Design& design) { design.cut().sections.stations = 44; });
  document.autosaveNow(true);
  fs::create_directories(folder() / "after");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder()))
    if (entry.is_regular_file() && entry.path().extension() != ".lock")
      fs::copy_file(entry.path(), folder() / "after" / entry.path().filename());
  Document later({});
  ASSERT_TRUE(later.recover(listRecovery(folder() / "after").at(0).copy));
  EXPECT_EQ(later.file(), file);
  EXPECT_TRUE(later.changedOnDisk());
  fs::remove(file);
  EXPECT_FALSE(document.changedOnDisk());
}

TEST_F(Recovery, ListsCopiesWhoseLocksCannotBeMade) {
  crash("read-only", 21);
  const fs::path copy = listRecovery(folder()).at(0).copy;
  // As on a file system without the right to write.
  fs::create_directory(fs::path(copy).replace_extension(".lock"));
  const std::vector<RecoveryCopy> copies = listRecovery(folder());
  ASSERT_EQ(copies.size(), 1u);
  Document document(folder());
  EXPECT_TRUE(document.recover(copies[0].copy));
}

TEST_F(Recovery, SavesWhichSourceTheResultsWereMadeFrom) {
  const fs::path source = path("panel.step");
  ASSERT_TRUE(writeFile(source, "ISO-10303-21; read"));
  Design linked = design();
  linked.source().path = source;
  linked.source().bytes.clear();
  Document document({});
  document.start(linked);
  document.noteRead(source, fingerprintOf("ISO-10303-21; read"));
  ASSERT_TRUE(writeFile(source, "ISO-10303-21; changed since"));
  ASSERT_TRUE(document.saveAs(path("a.bladewright")));
  EXPECT_EQ(document.design()->source().saved, fingerprintOf("ISO-10303-21; read"));
}

TEST_F(Recovery, RemembersWhatTheLinkedSourceWasWhenItSaves) {
  const fs::path source = path("panel.step"), file = path("a.bladewright");
  ASSERT_TRUE(writeFile(source, "ISO-10303-21; one"));
  Design linked = design();
  linked.source().path = source;
  linked.source().bytes.clear();
  Document document({});
  document.start(linked);
  document.editDesign("Change stations", -1, [](Design& design) { design.cut().sections.stations = 17; });
  ASSERT_TRUE(document.saveAs(file));
  EXPECT_EQ(document.design()->source().saved, fingerprintOf("ISO-10303-21; one"));
  document.undoStack().undo();
  EXPECT_EQ(document.design()->source().saved, fingerprintOf("ISO-10303-21; one")) << "a step back forgot it";
  ASSERT_TRUE(writeFile(source, "ISO-10303-21; two"));
  Document other({});
  ASSERT_TRUE(other.open(file));
  EXPECT_EQ(other.design()->source().saved, fingerprintOf("ISO-10303-21; one"));
  ASSERT_TRUE(other.saveAs(file));
  EXPECT_EQ(other.design()->source().saved, fingerprintOf("ISO-10303-21; two"));
}

}  // namespace
}  // namespace bw::model
