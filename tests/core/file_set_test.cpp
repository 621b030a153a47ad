// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/files/file_set.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "file_folder.h"

namespace bw {

namespace fs = std::filesystem;

TEST(FileSet, WritesAllFilesIntoNewFolders) {
  const Folder folder;
  FileSet set;
  set.add("a.txt", "one");
  set.add("deep/er/b.txt", std::string("two\0three", 9));
  ASSERT_TRUE(set.commit(folder.path() / "new"));
  EXPECT_EQ(*readFile(folder.path() / "new/a.txt"), "one");
  EXPECT_EQ(readFile(folder.path() / "new/deep/er/b.txt")->size(), 9u);
  EXPECT_EQ(folder.count(), 2u);
}

TEST(FileSet, LeavesNothingWhereOneFileCannotBeWritten) {
  const Folder folder;
  ASSERT_TRUE(writeFile(folder.path() / "plain", "a file where a folder is wanted"));
  FileSet set;
  set.add("good.txt", "good");
  set.add("sub/good.txt", "good");
  set.add("plain/bad.txt", "bad");
  const Result<void> result = set.commit(folder.path());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::cannotWrite);
  EXPECT_NE(result.error().message.find("plain"), std::string::npos);
  EXPECT_EQ(folder.count(), 1u);
  EXPECT_FALSE(fs::exists(folder.path() / "sub"));
}

TEST(FileSet, KeepsTheOldFilesWhereANewOneDoesNotFit) {
  const Folder folder;
  FileSet old, fresh;
  for (const char* name : {"a.txt", "b.txt", "sub/c.txt"}) old.add(name, "old");
  ASSERT_TRUE(old.commit(folder.path()));
  fresh.add("a.txt", "new");
  fresh.add("b.txt", "new");
  fresh.add("sub/c.txt", std::string(8192, 'x'));
  const FileSizeLimit limit(4096);
  const Result<void> result = fresh.commit(folder.path());
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("sub/c.txt: File too large; the file system or a limit"),
            std::string::npos)
      << result.error().message;
  for (const char* name : {"a.txt", "b.txt", "sub/c.txt"}) EXPECT_EQ(*readFile(folder.path() / name), "old");
  EXPECT_EQ(folder.count(), 3u);
}

TEST(FileSet, DevicesAreWrittenAndNotReplaced) {
  ASSERT_TRUE(writeFile("/dev/null", "bytes"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  if (fs::is_character_file("/dev/full")) {
    const Result<void> full = writeFile("/dev/full", "bytes");
    ASSERT_FALSE(full);
    EXPECT_NE(full.error().message.find("cannot write /dev/full: No space left"), std::string::npos);
    EXPECT_NE(full.error().message.find("free some space"), std::string::npos);
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
  }
}

TEST(FileSet, FollowsSymbolicLinks) {
  const Folder folder;
  ASSERT_TRUE(writeFile(folder.path() / "real/x.txt", "old"));
  fs::create_symlink("real/x.txt", folder.path() / "link.txt");
  ASSERT_TRUE(writeFile(folder.path() / "link.txt", "new"));
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link.txt"));
  EXPECT_EQ(*readFile(folder.path() / "real/x.txt"), "new");
}

TEST(FileSet, FollowsLinksToWhatIsNotThereYet) {
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "below");
  std::filesystem::create_symlink("below/second", folder.path() / "first");
  std::filesystem::create_symlink("real", folder.path() / "below/second");
  ASSERT_TRUE(writeFile(folder.path() / "first", "text"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "first"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "below/second"));
  EXPECT_EQ(readFile(folder.path() / "below/real").value_or("(none)"), "text");
}

TEST(FileSet, StopLeavesNothing) {
  const Folder folder;
  std::stop_source source;
  source.request_stop();
  FileSet set;
  set.add("sub/a.txt", "one");
  const Result<void> result = set.commit(folder.path(), RunContext{source.get_token()});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::cancelled);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(FileSet, MessagesNameTheFileItself) {
  const Result<void> result = writeFile("/proc/nowhere.txt", "bytes");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message.find(".part-"), std::string::npos) << result.error().message;
}

TEST(FileSet, KeepsTheOldFileUntilTheNewOneIsWhole) {
  const Folder folder;
  ASSERT_TRUE(writeFile(folder.path() / "x.txt", "old"));
  ASSERT_TRUE(writeFile(folder.path() / "x.txt", "new"));
  EXPECT_EQ(*readFile(folder.path() / "x.txt"), "new");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(ReadFile, NamesWhatIsMissing) {
  const Result<std::string> missing = readFile("/no/such/file.step");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::cannotRead);
  EXPECT_NE(missing.error().message.find("/no/such/file.step"), std::string::npos);
  EXPECT_FALSE(readFile("/"));
}

}  // namespace bw
