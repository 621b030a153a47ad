// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Packed CAD files: gzip and zip, as .stpz files are.

#include <zlib.h>

#include <cstdint>

#include "shapes.h"

namespace bw::geometry::test {
namespace {

/// A deflated text, with a gzip head (window 31) or none (window −15).
std::string deflated(const std::string& text, int window) {
  z_stream stream = {};
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, window, 9, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, uLong(text.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = uInt(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = uInt(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

std::string gzip(const std::string& text) { return deflated(text, 15 + 16); }

std::string little(std::uint32_t value, int size) {
  std::string bytes;
  for (int i = 0; i < size; ++i, value >>= 8) bytes += char(value & 255u);
  return bytes;
}

struct Entry {
  std::string name, text;
  bool stored = false;
  unsigned flags = 0;
};

std::string zip(const std::vector<Entry>& entries) {
  std::string bytes, table;
  for (const Entry& entry : entries) {
    const std::string data = entry.stored ? entry.text : deflated(entry.text, -15);
    const auto crc =
        std::uint32_t(::crc32(0, reinterpret_cast<const Bytef*>(entry.text.data()), uInt(entry.text.size())));
    const std::string facts = little(20, 2) + little(entry.flags, 2) + little(entry.stored ? 0 : 8, 2) +
                              little(0, 4) + little(crc, 4) + little(std::uint32_t(data.size()), 4) +
                              little(std::uint32_t(entry.text.size()), 4) +
                              little(std::uint32_t(entry.name.size()), 2) + little(0, 2);
    table += "PK\x01\x02" + little(20, 2) + facts + little(0, 10) + little(std::uint32_t(bytes.size()), 4) +
             entry.name;
    bytes += "PK\x03\x04" + facts + entry.name + data;
  }
  const std::string count = little(std::uint32_t(entries.size()), 2);
  return bytes + table + "PK\x05\x06" + little(0, 4) + count + count +
         little(std::uint32_t(table.size()), 4) + little(std::uint32_t(bytes.size()), 4) + little(0, 2);
}

TEST(Packed, GzipAndZipAreReadLikeWhatTheyHold) {
  const std::string step = exampleStep("saddle").value();
  const Bounds bounds = modelOf(step).info().bounds;
  for (const std::string& bytes :
       {gzip(step), gzip(step.substr(0, 900)) + gzip(step.substr(900)), gzip("\xef\xbb\xbf" + step),
        zip({{"saddle.stp", step}}), zip({{"saddle.STEP", step, true}}),
        zip({{"read me.txt", "hello"}, {"parts/saddle.step", step}}),
        zip({{"saddle.step", step}, {"__MACOSX/._saddle.step", "resources"}, {"._saddle.step", "more"}})}) {
    const auto model = CadModel::readBytes(bytes, "saddle.stpz");
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_EQ(model->info().format, "STEP");
    EXPECT_EQ(model->info().bounds.min, bounds.min);
  }
}

TEST(Packed, FileThatSwellsBeyondAllBoundsIsRefused) {
  // 100 MB of nothing shrink to 0.1 MB.
  const std::string bomb = gzip(std::string(100u << 20, ' '));
  ASSERT_LT(bomb.size(), 200000u);
  expectError(CadModel::readBytes(bomb, "bomb.stpz"), ErrorCode::cannotRead, "more than");
  expectError(CadModel::readBytes(zip({{"a.stp", std::string(100u << 20, ' ')}}), "bomb.stpz"),
              ErrorCode::cannotRead, "more than");
  // What is packed twice is not unpacked twice.
  expectError(CadModel::readBytes(gzip(gzip(exampleStep("saddle").value())), "twice.stpz"),
              ErrorCode::cannotRead, "twice.stpz");
}

TEST(Packed, DamageAndWhatIsNotThereAreToldWithTheFilesName) {
  const std::string step = exampleStep("saddle").value();
  for (const std::string& whole : {gzip(step), zip({{"a.stp", step}})}) {
    for (std::size_t length = 4; length < whole.size(); length += 61)
      expectError(CadModel::readBytes(whole.substr(0, length), "cut.stpz"), ErrorCode::cannotRead,
                  "cut.stpz");
    for (std::size_t at = 2; at < whole.size(); at += 37) {
      std::string damaged = whole;
      damaged[at] = char(damaged[at] ^ 0x55);
      const auto model = CadModel::readBytes(damaged, "damaged.stpz");
      if (!model) {
        EXPECT_EQ(model.error().code, ErrorCode::cannotRead) << model.error().message;
      }
    }
  }
  std::string stored = zip({{"a.stp", step, true}});
  const std::size_t coordinate = stored.find("CARTESIAN_POINT('',(") + 20;
  stored[coordinate] = stored[coordinate] == '1' ? '2' : '1';
  expectError(CadModel::readBytes(stored, "bit.stpz"), ErrorCode::cannotRead, "damaged");
  expectError(CadModel::readBytes(zip({{"a.txt", step}}), "none.stpz"), ErrorCode::cannotRead,
              "holds no STEP");
  expectError(CadModel::readBytes(zip({{"a.stp", step}, {"b.stp", step}}), "two.stpz"), ErrorCode::cannotRead,
              "2 CAD files");
  expectError(CadModel::readBytes(zip({{"a.stp", step, false, 1}}), "secret.stpz"), ErrorCode::cannotRead,
              "encrypted");
}

}  // namespace
}  // namespace bw::geometry::test
