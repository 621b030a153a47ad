// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/files/folder_lock.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "bw/core/files/file_set.h"
#include "bw/core/files/temporary_name.h"
#include "file_folder.h"

namespace bw {

TEST(FolderLock, TellsTheSecondWriterWhoTheFirstIs) {
  const Folder folder;
  const Result<FolderLock> first = FolderLock::take(folder.path());
  ASSERT_TRUE(first) << first.error().message;
  const Result<FolderLock> second = FolderLock::take(folder.path());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::cannotWrite);
  for (const std::string& text : {"process " + std::to_string(::getpid()), "on " + hostName(),
                                  std::string("since 20"), std::string("choose another folder")})
    EXPECT_NE(second.error().message.find(text), std::string::npos) << second.error().message;
}

TEST(FolderLock, IsFreeAgainAndLeavesNothing) {
  const Folder folder;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(FolderLock::take(folder.path()));
  EXPECT_EQ(folder.count(), 0u);
}

TEST(FolderLock, OfADeadWriterIsTakenOver) {
  const Folder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    const Result<FolderLock> lock = FolderLock::take(folder.path());
    ::kill(::getpid(), SIGKILL);
  }
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(folder.count(), 1u) << "what the dead one left";
  EXPECT_TRUE(FolderLock::take(folder.path()));
  EXPECT_EQ(folder.count(), 0u);
}

TEST(FolderLock, OfADeadWriterWhoWasAnotherUserIsTakenOver) {
  const Folder folder;
  const std::filesystem::path file = folder.path() / FolderLock::kFile;
  ASSERT_TRUE(writeFile(file, "process 1"));
  ASSERT_EQ(::chmod(folder.path().c_str(), 0777), 0);
  ASSERT_EQ(::chmod(file.c_str(), 0444), 0);
  // To the superuser every file can be written.
  const uid_t self = ::geteuid();
  if (self == 0) {
    ASSERT_EQ(::seteuid(65534), 0);
  }
  {
    const Result<FolderLock> lock = FolderLock::take(folder.path());
    EXPECT_TRUE(lock) << lock.error().message;
    const Result<FolderLock> second = FolderLock::take(folder.path());
    EXPECT_FALSE(second);
    EXPECT_NE(second.error().message.find("process " + std::to_string(::getpid())), std::string::npos);
  }
  EXPECT_EQ(::seteuid(self), 0);
  EXPECT_EQ(folder.count(), 0u);
}

TEST(FolderLock, NamesTheFolderItCannotBeTakenFor) {
  const Result<FolderLock> lock = FolderLock::take("/proc/self");
  ASSERT_FALSE(lock);
  EXPECT_NE(lock.error().message.find("/proc/self"), std::string::npos);
}

TEST(TemporaryName, OfADeadWriterIsClearedAwayAndOfALivingOneIsNot) {
  const Folder folder;
  const std::filesystem::path mine = temporaryName(folder.path() / "a.txt");
  std::string dead = mine.string();
  const std::string own = std::to_string(::getpid());
  dead.replace(dead.rfind("-" + own + "-") + 1, own.size(), std::to_string(deadProcess()));
  // The dead one's last: writing another would clear it away.
  for (const std::filesystem::path& file :
       {mine, folder.path() / "b.part-1", folder.path() / "c.txt", std::filesystem::path(dead)})
    ASSERT_TRUE(writeFile(file, "bytes"));
  EXPECT_EQ(leftByDeadWriters(folder.path()), std::vector<std::filesystem::path>{dead});
  EXPECT_EQ(placeOfTemporary(dead), folder.path() / "a.txt");
  ASSERT_TRUE(writeFile(folder.path() / "d.txt", "bytes"));
  EXPECT_FALSE(std::filesystem::exists(dead));
  EXPECT_EQ(folder.count(), 4u);
  EXPECT_TRUE(isTemporaryName(mine.filename().string()));
  for (const char* name : {"b.part-1", ".part-1-0123456789ab-0", "a.part-x-0123456789ab-0",
                           "a.part-1-0123456789ag-0", "a.part-1-0123456789ab-", "part", ""})
    EXPECT_FALSE(isTemporaryName(name)) << name;
}

TEST(TemporaryName, IsOneWhereNothingIs) {
  const Folder folder;
  ASSERT_TRUE(writeFile(folder.path() / "b.txt", "bytes"));
  const std::string first = temporaryName(folder.path() / "a.txt").string();
  const std::size_t number = first.rfind('-') + 1;
  // As after the start of a container in which a process of the same number was killed.
  const std::string next = first.substr(0, number) + std::to_string(std::stoi(first.substr(number)) + 1);
  std::filesystem::copy_file(folder.path() / "b.txt", next);
  const std::string other = temporaryName(folder.path() / "a.txt").string();
  EXPECT_NE(other, next);
  EXPECT_FALSE(std::filesystem::exists(other));
}

TEST(TemporaryName, OfAnotherMachineIsClearedAwayAfterADay) {
  const Folder folder;
  const std::filesystem::path file = folder.path() / "a.txt.part-1-000000000000-0";
  ASSERT_TRUE(writeFile(file, "bytes"));
  EXPECT_TRUE(leftByDeadWriters(folder.path()).empty());
  std::filesystem::last_write_time(file,
                                   std::filesystem::file_time_type::clock::now() - std::chrono::hours(25));
  EXPECT_EQ(leftByDeadWriters(folder.path()).size(), 1u);
}

}  // namespace bw
