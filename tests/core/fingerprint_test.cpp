// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/files/fingerprint.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>

#include "bw/core/design/design.h"
#include "bw/core/files/file_set.h"

namespace bw {
namespace {

namespace fs = std::filesystem;

TEST(Fingerprint, IsTheChecksumOfTheCatalogue) {
  // The check value of CRC-64/XZ in the catalogue of parametrised CRC algorithms.
  EXPECT_EQ(fingerprintOf("123456789"), (Fingerprint{9, 0x995dc9bbdf1939faULL}));
  EXPECT_EQ(fingerprintText(fingerprintOf("123456789")), "9-995dc9bbdf1939fa");
}

TEST(Fingerprint, OfAFileIsThatOfItsBytes) {
  const fs::path folder = fs::path(::testing::TempDir()) / ("fingerprint-" + std::to_string(::getpid()));
  const fs::path file = folder / "bytes";
  std::string bytes(200000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = char(i * i >> 3);
  ASSERT_TRUE(writeFile(file, bytes));
  EXPECT_EQ(fingerprintOfFile(file), fingerprintOf(bytes));
  ASSERT_TRUE(writeFile(file, ""));
  EXPECT_EQ(fingerprintOfFile(file), fingerprintOf(""));
  EXPECT_FALSE(fingerprintOfFile(folder / "missing"));
  EXPECT_FALSE(fingerprintOfFile(folder)) << "a folder";
  fs::remove_all(folder);
}

TEST(Fingerprint, IsReadBackFromItsText) {
  for (const Fingerprint& f : {Fingerprint{}, Fingerprint{81233, 1}, Fingerprint{1ULL << 40, ~0ULL}})
    EXPECT_EQ(fingerprintFrom(fingerprintText(f)), f);
  for (const char* text :
       {"", "-", "9", "9-", "9-995dc9bbdf1939f", "9-995dc9bbdf1939fag", "x-995dc9bbdf1939fa",
        "-9-995dc9bbdf1939fa", "9-995dc9bbdf1939fa ", "99999999999999999999-995dc9bbdf1939fa"})
    EXPECT_FALSE(fingerprintFrom(text)) << text;
}

TEST(Design, RemembersWhatItsLinkedSourceWas) {
  Design design;
  design.source().path = "/x/panel.step";
  design.source().saved = fingerprintOf("one");
  const Result<Design> read = parseDesign(designToJson(design));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->source(), design.source());
  design.source().bytes = "two";
  EXPECT_EQ(designToJson(design).find("fingerprint"), std::string::npos)
      << "an embedded source cannot change";
  const Result<Design> damaged =
      parseDesign(R"({"bladewright_design": 1, "source": {"path": "a.step", "fingerprint": "12"}})");
  ASSERT_FALSE(damaged);
  EXPECT_NE(damaged.error().message.find("fingerprint"), std::string::npos) << damaged.error().message;
}

}  // namespace
}  // namespace bw
