// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What a DXF file is a list of: codes, each with its value.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bw/core/base/result.h"

namespace bw::dxf {

/// What a binary DXF file begins with.
inline constexpr std::string_view kBinaryMark("AutoCAD Binary DXF\r\n\x1a\0", 22);

/// A group: a code and its value. In a text they have a line each, in a binary file so many bytes as the code
/// tells.
struct Group {
  int code = 0;
  std::string_view value = {};                  ///< as text; empty for numbers of a binary file
  std::optional<double> number = std::nullopt;  ///< of a binary file
  std::size_t place = 0;                        ///< of the code: its line, or its byte, from 1
};

/// The text without blanks and ends of lines around it.
std::string_view trimmed(std::string_view text);

/// The groups of a file, one after the other, whether it is a text or binary. Both outlive it.
class Groups {
 public:
  Groups(std::string_view bytes, const std::string& name);

  /// The next one; comments are passed over. Errors, `cannotRead`: an end where none may be, a code that is
  /// no number, or that tells not what its value is.
  Result<Group> next();

  bool binary() const { return codeBytes_ > 0; }
  /// "line 12", or "byte 5310": for messages.
  std::string words(std::size_t place) const;
  /// The place of the value of a group, and of what tells the type of an entity.
  std::size_t placeOfValue(std::size_t place) const { return binary() ? place : place + 1; }
  tl::unexpected<Error> damaged(std::size_t place, const std::string& what) const;
  /// What was passed, of all.
  double share() const { return size_ > 0 ? 1 - double(rest_.size()) / double(size_) : 1; }

 private:
  Result<Group> nextOfText();
  Result<Group> nextOfBinary();
  std::string_view takeLine();
  tl::unexpected<Error> cutShort() const;

  std::string_view rest_;
  const std::string& name_;
  std::size_t size_ = 0;
  std::size_t line_ = 0;
  std::size_t codeBytes_ = 0;  // of a binary file: 1 before release 13, else 2
};

}  // namespace bw::dxf
