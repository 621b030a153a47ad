// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "isolated.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

namespace bw::geometry {
namespace {

TEST(Isolated, ReturnsAllBytesOfItsWork) {
  std::string big(5000000, '\0');
  for (std::size_t i = 0; i < big.size(); ++i) big[i] = char(i * 7 % 251);
  const auto bytes = runIsolated({}, [&] { return big; });
  ASSERT_TRUE(bytes);
  EXPECT_EQ(*bytes, big);
  const auto nothing = runIsolated({}, [] { return std::string(); });
  ASSERT_TRUE(nothing);
  EXPECT_TRUE(nothing->empty());
}

TEST(Isolated, CrashEndsTheWorkAloneAndIsAnError) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE}) {
    const auto bytes = runIsolated({}, [signal] {
      ::raise(signal);
      return std::string("never");
    });
    ASSERT_FALSE(bytes);
    EXPECT_EQ(bytes.error().code, ErrorCode::cannotRead);
  }
}

TEST(Isolated, StopEndsEndlessWork) {
  std::stop_source source;
  RunContext context;
  context.stop = source.get_token();
  std::jthread stopper([&] { source.request_stop(); });
  const auto bytes = runIsolated(context, []() -> std::string {
    for (;;) ::pause();
  });
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, ErrorCode::cancelled);
}

TEST(Isolated, InterruptOfTheWorkIsAStop) {
  const auto bytes = runIsolated({}, [] {
    ::raise(SIGINT);
    return std::string("never");
  });
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, ErrorCode::cancelled);
}

TEST(MemoryFile, IsReadThroughItsPath) {
  const MemoryFile file(std::string("a\0b", 3));
  ASSERT_TRUE(file.good());
  std::ostringstream read;
  read << std::ifstream(file.path(), std::ios::binary).rdbuf();
  EXPECT_EQ(read.str(), std::string("a\0b", 3));
}

TEST(Texts, TakeBackWhatWasAppendedAndNoMore) {
  std::string bytes;
  appendText(bytes, "one");
  appendText(bytes, "");
  std::string_view rest = bytes;
  std::string text;
  EXPECT_TRUE(takeText(rest, text));
  EXPECT_EQ(text, "one");
  EXPECT_TRUE(takeText(rest, text));
  EXPECT_EQ(text, "");
  EXPECT_FALSE(takeText(rest, text));
  rest = std::string_view(bytes).substr(0, 9);
  EXPECT_FALSE(takeText(rest, text));
}

}  // namespace
}  // namespace bw::geometry
