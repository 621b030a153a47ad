// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <streambuf>
#include <string>
#include <string_view>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"

namespace bw::geometry {

/// How much the work of an isolated process may take, so that a damaged file ends in an error.
struct WorkLimits {
  int cpuSeconds = 600;
  std::size_t memory = std::size_t(4) << 30;  ///< bytes beyond what the program has when it forks
};

/// Runs `work` in a process forked for it and returns the bytes that it made, so that a library which crashes
/// on a damaged file, or works on it without end, takes only that process with it. A stop of the context ends
/// the process within 0.05 s. `work` sees a copy of everything there is, but only its own thread: it must not
/// wait for another one; what it throws counts as a crash. Errors: `cancelled`; `cannotRead` if the process
/// broke down, exceeded its time, or could not be made.
Result<std::string> runIsolated(const RunContext& context, const std::function<std::string()>& work,
                                const WorkLimits& limits = {});

/// Bytes as a file without a name on disk, for libraries that read only paths. Gone with its last user.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  /// True if all bytes are there.
  bool good() const { return good_; }
  /// A path that this process and its children can open.
  std::string path() const;

 private:
  int file_ = -1;
  bool good_ = false;
};

/// Texts to one and back, each with its length before it.
void appendText(std::string& bytes, std::string_view text);
/// False if `bytes` ends too early. Takes what it read off the front of `bytes`.
bool takeText(std::string_view& bytes, std::string& text);

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

}  // namespace bw::geometry
