// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/replacement.h"

#include <gtest/gtest.h>

#include "bw/core/file_set.h"
#include "file_folder.h"

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
