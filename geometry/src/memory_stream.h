// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <streambuf>
#include <string>
#include <string_view>

namespace bw::geometry {

/// A stream buffer that reads bytes which are somewhere else, without a copy.
class BytesBuffer : public std::streambuf {
 public:
  explicit BytesBuffer(std::string_view bytes) {
    char* begin = const_cast<char*>(bytes.data());  // a get area is not written to
    setg(begin, begin, begin + bytes.size());
  }

 protected:
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
    const off_type base = from == std::ios_base::beg   ? 0
                          : from == std::ios_base::cur ? gptr() - eback()
                                                       : egptr() - eback();
    if (base + offset < 0 || base + offset > egptr() - eback()) return pos_type(off_type(-1));
    setg(eback(), eback() + base + offset, egptr());
    return pos_type(base + offset);
  }
  pos_type seekpos(pos_type at, std::ios_base::openmode which) override {
    return seekoff(off_type(at), std::ios_base::beg, which);
  }
};

/// A stream buffer that appends to a string. Tells its place, counted from where it began, but moves nowhere.
class AppendBuffer : public std::streambuf {
 public:
  explicit AppendBuffer(std::string& bytes) : bytes_(bytes), start_(bytes.size()) {}

 protected:
  int_type overflow(int_type c) override {
    if (c != traits_type::eof()) bytes_ += char(c);
    return c;
  }
  std::streamsize xsputn(const char* data, std::streamsize n) override {
    bytes_.append(data, std::size_t(n));
    return n;
  }
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
    const bool here = offset == 0 && from == std::ios_base::cur;
    return here ? pos_type(off_type(bytes_.size() - start_)) : pos_type(off_type(-1));
  }

 private:
  std::string& bytes_;
  std::size_t start_;
};

}  // namespace bw::geometry
