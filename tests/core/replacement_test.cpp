// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/files/replacement.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

#include "bw/core/files/file_set.h"
#include "file_folder.h"

namespace {

bool foldersFail = false;

}  // namespace

/// The system's, or a disk that fails when the names of a folder are to be written.
extern "C" int fsync(int fd) {
  struct stat status {};
  if (foldersFail && ::fstat(fd, &status) == 0 && S_ISDIR(status.st_mode)) {
    errno = EIO;
    return -1;
  }
  return int(::syscall(SYS_fsync, fd));
}

namespace bw {

namespace fs = std::filesystem;

namespace {

std::string textOf(const fs::path& file) {
  const Result<std::string> text = readFile(file);
  return text ? *text : "(none)";
}

/// Two folders and two files of one run.
void prepare(Replacement& replacement, const fs::path& folder, const std::string& text) {
  for (const char* name : {"left", "right"}) {
    const Result<fs::path> fresh = replacement.folder(folder / name);
    ASSERT_TRUE(fresh) << fresh.error().message;
    ASSERT_TRUE(replacement.fill(*fresh / "program", text, folder / name / "program"));
  }
  ASSERT_TRUE(replacement.file(folder / "sweep", text));
  ASSERT_TRUE(replacement.file(folder / "report", text));
}

void expectAll(const fs::path& folder, const std::string& text) {
  for (const char* name : {"left/program", "right/program", "sweep", "report"})
    EXPECT_EQ(textOf(folder / name), text) << name;
}

}  // namespace

TEST(Replacement, PutsFoldersAndFilesInPlaceTogether) {
  for (const bool exchange : {true, false}) {
    const Folder folder;
    for (const char* text : {"first", "second"}) {
      Replacement replacement({}, exchange);
      prepare(replacement, folder.path(), text);
      const Result<void> ok = replacement.commit();
      ASSERT_TRUE(ok) << ok.error().message;
      expectAll(folder.path(), text);
      EXPECT_EQ(replacement.formerFolders().size(), text == std::string("first") ? 0u : 2u);
      for (const auto& [former, live] : replacement.formerFolders()) {
        EXPECT_EQ(textOf(former / "program"), "first");
        fs::remove_all(former);
      }
      EXPECT_EQ(folder.count(), 4u) << (exchange ? "with" : "without") << " exchange";
    }
  }
}

TEST(Replacement, LeavesEverythingAsItWasWhereOneStepFails) {
  for (const bool exchange : {true, false}) {
    const Folder folder;
    {
      Replacement replacement;
      prepare(replacement, folder.path(), "first");
      ASSERT_TRUE(replacement.commit());
    }
    {
      Replacement replacement({}, exchange);
      prepare(replacement, folder.path(), "second");
      ASSERT_TRUE(replacement.file(folder.path() / "last", "second"));
      // In the last moment somebody makes a folder of that name.
      ASSERT_TRUE(writeFile(folder.path() / "last/theirs", "theirs"));
      EXPECT_FALSE(replacement.commit());
    }
    expectAll(folder.path(), "first");
    EXPECT_EQ(textOf(folder.path() / "last/theirs"), "theirs");
    EXPECT_EQ(folder.count(), 5u);
  }
}

TEST(Replacement, LeavesEverythingAsItWasWhereTheDiskFailsLast) {
  for (const bool exchange : {true, false}) {
    const Folder folder;
    for (const char* text : {"first", "second"}) {
      Replacement replacement({}, exchange);
      for (const char* name : {"sweep", "report"})
        ASSERT_TRUE(replacement.file(folder.path() / name, text, true));
      foldersFail = text == std::string("second");
      EXPECT_NE(bool(replacement.commit()), foldersFail);
      foldersFail = false;
    }
    for (const char* name : {"sweep", "report"}) EXPECT_EQ(textOf(folder.path() / name), "first");
    EXPECT_EQ(folder.count(), 2u);
  }
  const Folder folder;
  ASSERT_TRUE(writeFile(folder.path() / "design", "first"));
  foldersFail = true;
  EXPECT_FALSE(writeFile(folder.path() / "design", "second"));
  EXPECT_FALSE(writeFile(folder.path() / "other", "second"));
  foldersFail = false;
  EXPECT_EQ(textOf(folder.path() / "design"), "first");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(Replacement, RemovesNoFileThatItDidNotMake) {
  const Folder folder;
  ASSERT_TRUE(writeFile(folder.path() / "theirs", "theirs"));
  Replacement replacement;
  const Result<void> ok = replacement.fill(folder.path() / "theirs", "ours", "theirs");
  ASSERT_FALSE(ok);
  EXPECT_EQ(ok.error().code, ErrorCode::cannotWrite);
  EXPECT_EQ(textOf(folder.path() / "theirs"), "theirs");
}

TEST(Replacement, ThatIsNotCommittedLeavesNothing) {
  const Folder folder;
  {
    Replacement replacement;
    prepare(replacement, folder.path() / "new/deep", "first");
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Replacement, RemovesWhatGoesAway) {
  const Folder folder;
  ASSERT_TRUE(writeFile(folder.path() / "old", "old"));
  Replacement replacement;
  replacement.removal(folder.path() / "old");
  ASSERT_TRUE(replacement.file(folder.path() / "new", "new", true));
  ASSERT_TRUE(replacement.commit());
  EXPECT_EQ(folder.count(), 1u);
  EXPECT_EQ(textOf(folder.path() / "new"), "new");
}

}  // namespace bw
