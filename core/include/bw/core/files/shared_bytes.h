// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace bw {

/// The bytes of a file, immutable: copies share them, and their hash is made once, when they come in. Safe to
/// share between threads.
class SharedBytes {
 public:
  SharedBytes() = default;
  SharedBytes(std::string bytes);                                    // NOLINT: a string is what it is
  SharedBytes(const char* text) : SharedBytes(std::string(text)) {}  // NOLINT

  bool empty() const { return !shared_; }
  std::size_t size() const { return str().size(); }
  const std::string& str() const;
  operator const std::string&() const { return str(); }  // NOLINT
  void clear() { *this = SharedBytes(); }

  /// O(1) between copies and where hashes differ.
  bool operator==(const SharedBytes& other) const;

 private:
  std::shared_ptr<const std::string> shared_;  ///< null if there are none
  std::size_t hash_ = 0;
};

}  // namespace bw
