// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "cad_format.h"
#include "cad_reader.h"

namespace bw::geometry {

namespace {

constexpr std::size_t kMostBytes = std::size_t(1) << 30;
constexpr std::size_t kLeastBytes = std::size_t(16) << 20;  // a small file may be as large as this inside
constexpr std::size_t kMostRatio = 200;  // CAD texts shrink to a fifth, at most to a hundredth
constexpr std::size_t kChunk = std::size_t(1) << 20;
constexpr int kGzipWindow = 15 + 16;  // of zlib: a gzip head and the largest window
constexpr int kRawWindow = -15;       // no head at all

constexpr std::string_view kGzip = "\x1f\x8b";
constexpr std::string_view kZip = "PK\x03\x04";
constexpr std::string_view kZipEntry = "PK\x01\x02";
constexpr std::string_view kZipEnd = "PK\x05\x06";

/// An inflating stream, ended with its scope.
struct Inflater {
  z_stream stream = {};
  bool good;
  explicit Inflater(int window) : good(inflateInit2(&stream, window) == Z_OK) {}
  ~Inflater() {
    if (good) inflateEnd(&stream);
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

Result<std::string> inflated(std::string_view bytes, int window, const std::string& name) {
  const std::size_t limit = std::min(kMostBytes, std::max(kLeastBytes, kMostRatio * bytes.size()));
  Inflater inflater(window);
  if (!inflater.good) return unreadable(name, "the memory does not suffice to unpack it");
  z_stream& stream = inflater.stream;
  std::string text, chunk(kChunk, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // zlib does not write to it
  std::size_t left = bytes.size();
  int state = Z_OK;
  while (state == Z_OK) {
    if (stream.avail_in == 0) {
      stream.avail_in = uInt(std::min<std::size_t>(left, std::numeric_limits<uInt>::max()));
      left -= stream.avail_in;
    }
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = uInt(chunk.size());
    state = inflate(&stream, Z_NO_FLUSH);
    text.append(chunk.data(), chunk.size() - stream.avail_out);
    if (text.size() > limit) {
      return fail(ErrorCode::cannotRead,
                  "cannot read " + name + ": it holds more than " + std::to_string(limit >> 20) +
                      " MB, which is too much for a packed CAD file; unpack it and open what it holds",
                  name, double(text.size()), double(limit));
    }
    // A file of several packed pieces holds their texts one after the other.
    const std::string_view rest = bytes.substr(bytes.size() - left - stream.avail_in);
    if (state == Z_STREAM_END && window == kGzipWindow && rest.substr(0, kGzip.size()) == kGzip)
      state = inflateReset(&stream);
  }
  if (state == Z_BUF_ERROR) return unreadable(name, "the packed file is cut short; copy or export it again");
  if (state != Z_STREAM_END) return unreadable(name, "the packed file is damaged; copy or export it again");
  return text;
}

/// A little-endian number of a zip file; 0 beyond its end.
std::uint32_t number(std::string_view bytes, std::size_t at, int size) {
  std::uint32_t value = 0;
  for (int i = size - 1; i >= 0; --i)
    value = value << 8 | (at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0u);
  return value;
}

struct ZipEntry {
  std::string name;
  unsigned flags = 0, method = 0;
  std::size_t crc = 0, packed = 0, head = 0;
};

/// What the archiver of macOS keeps beside a file bears its name too.
bool isBeside(const std::string& name) {
  return name.rfind("__MACOSX/", 0) == 0 || name.substr(name.rfind('/') + 1).rfind("._", 0) == 0;
}

/// The CAD files that the table of a zip archive lists; none if the table is missing.
std::vector<ZipEntry> cadEntries(std::string_view bytes) {
  std::vector<ZipEntry> entries;
  const std::size_t end = bytes.rfind(kZipEnd);
  if (end == std::string_view::npos) return entries;
  std::size_t at = number(bytes, end + 16, 4);
  while (at + 46 <= end && bytes.compare(at, kZipEntry.size(), kZipEntry) == 0) {
    const std::size_t nameSize = number(bytes, at + 28, 2);
    const ZipEntry entry = {std::string(bytes.substr(at + 46, nameSize)),
                            number(bytes, at + 8, 2),
                            number(bytes, at + 10, 2),
                            number(bytes, at + 16, 4),
                            number(bytes, at + 20, 4),
                            number(bytes, at + 42, 4)};
    if (formatOfSuffix(entry.name) != CadFormat::unknown && !isBeside(entry.name)) entries.push_back(entry);
    at += 46 + nameSize + number(bytes, at + 30, 2) + number(bytes, at + 32, 2);
  }
  return entries;
}

Result<std::string> unzipped(std::string_view bytes, const std::string& name) {
  const std::vector<ZipEntry> entries = cadEntries(bytes);
  if (bytes.rfind(kZipEnd) == std::string_view::npos)
    return unreadable(name, "the packed file is cut short; copy or export it again");
  if (entries.empty()) return unreadable(name, "the archive holds no STEP, IGES or BREP file");
  if (entries.size() > 1) {
    return unreadable(name, "the archive holds " + std::to_string(entries.size()) +
                                " CAD files; unpack it and open one of them");
  }
  const ZipEntry& entry = entries.front();
  const std::size_t data =
      entry.head + 30 + number(bytes, entry.head + 26, 2) + number(bytes, entry.head + 28, 2);
  if (entry.head >= bytes.size() || data > bytes.size() || entry.packed > bytes.size() - data)
    return unreadable(name, "the packed file is damaged; copy or export it again");
  if ((entry.flags & 1) != 0 || (entry.method != 0 && entry.method != 8)) {
    return unreadable(name,
                      "what it holds is encrypted or packed in a way that is not known; unpack it and "
                      "open what it holds");
  }
  const std::string_view packed = bytes.substr(data, entry.packed);
  Result<std::string> text =
      entry.method == 0 ? Result<std::string>(std::string(packed)) : inflated(packed, kRawWindow, name);
  if (text && ::crc32_z(0, reinterpret_cast<const Bytef*>(text->data()), text->size()) != entry.crc)
    return unreadable(name, "the packed file is damaged; copy or export it again");
  return text;
}

}  // namespace

bool isCompressed(std::string_view bytes) {
  return bytes.substr(0, kGzip.size()) == kGzip || bytes.substr(0, kZip.size()) == kZip;
}

Result<std::string> decompressed(std::string_view bytes, const std::string& name) {
  return bytes.substr(0, kGzip.size()) == kGzip ? inflated(bytes, kGzipWindow, name) : unzipped(bytes, name);
}

}  // namespace bw::geometry
