// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "isolated.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iostream>
#include <new>
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

TEST(Isolated, WhatTheWorkThrowsIsACrash) {
  const auto bytes = runIsolated({}, []() -> std::string { throw std::bad_alloc(); });
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, ErrorCode::cannotRead);
}

TEST(Isolated, CrashIsToldWhereNobodyWaitsForChildren) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  const auto bytes = runIsolated({}, [] {
    ::raise(SIGSEGV);
    return std::string("never");
  });
  const auto whole = runIsolated({}, [] { return std::string("done"); });
  std::signal(SIGCHLD, before);
  EXPECT_FALSE(bytes);
  EXPECT_EQ(whole.value(), "done");
}

TEST(Isolated, WhatTheWorkPrintsStaysOutOfTheProgramsStreams) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const auto bytes = runIsolated({}, [] {
    std::cout << "Not a TShape table" << std::endl;
    std::cerr << "no such thing" << std::endl;
    return std::string("done");
  });
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(bytes.value(), "done");
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

TEST(Isolated, WorkWithoutEndIsAnErrorOfTheFile) {
  WorkLimits limits;
  limits.cpuSeconds = 1;
  const auto bytes = runIsolated(
      {},
      []() -> std::string {
        volatile bool end = false;
        while (!end) {
        }
        return "never";
      },
      limits);
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, ErrorCode::cannotRead);
  EXPECT_NE(bytes.error().message.find("within 1 s of computing"), std::string::npos)
      << bytes.error().message;
}

TEST(Isolated, WorkGetsNoMoreMemoryThanItsLimit) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer ends a program that gets no memory";
#endif
  WorkLimits limits;
  limits.memory = std::size_t(64) << 20;
  const auto bytes = runIsolated(
      {},
      [] {
        std::string taken;
        try {
          for (std::size_t size = 1 << 20; size < std::size_t(1) << 30; size *= 2) taken.assign(size, 1);
        } catch (const std::bad_alloc&) {
          return std::string("refused");
        }
        return std::string("had all");
      },
      limits);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(*bytes, "refused");
}

TEST(Isolated, InterruptOfTheWorkIsAStop) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const auto bytes = runIsolated({}, [signal] {
      ::raise(signal);
      return std::string("never");
    });
    ASSERT_FALSE(bytes);
    EXPECT_EQ(bytes.error().code, ErrorCode::cancelled);
  }
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
