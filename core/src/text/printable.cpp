// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/text/printable.h"

#include <boost/locale/utf.hpp>
#include <cstdint>

namespace bw {

namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  ///< 0: the byte begins no character
};

/// The UTF-8 character at the front of `text`: the shortest form only, no surrogates.
Character firstCharacter(std::string_view text) {
  namespace utf = boost::locale::utf;
  const char* end = text.data();
  const utf::code_point code = utf::utf_traits<char>::decode(end, text.data() + text.size());
  if (code == utf::illegal || code == utf::incomplete) return {};
  return {code, std::size_t(end - text.data())};
}

/// Characters that act instead of being seen.
bool acts(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) ||  // control characters
         code == 0x061c || code == 0x200e || code == 0x200f || (code >= 0x202a && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069) ||                // direction of writing
         code == 0x2028 || code == 0x2029 || code == 0xfeff;  // line separators, byte order mark
}

void appendHex(std::string& out, char mark, std::uint32_t value, int digits) {
  out += '\\';
  out += mark;
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) out += "0123456789abcdef"[value >> shift & 15];
}

}  // namespace

bool isUtf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t bytes = firstCharacter(text).bytes;
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return true;
}

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const Character c = firstCharacter(text);
    const std::size_t bytes = c.bytes ? c.bytes : 1;
    if (c.bytes == 0)
      appendHex(out, 'x', static_cast<unsigned char>(text[0]), 2);
    else if (c.code == '\n')
      out += "\\n";
    else if (c.code == '\t')
      out += "\\t";
    else if (c.code == '\r')
      out += "\\r";
    else if (acts(c.code) && c.code < 0x80)
      appendHex(out, 'x', c.code, 2);
    else if (acts(c.code))
      appendHex(out, 'u', c.code, 4);
    else
      out.append(text.substr(0, bytes));
    text.remove_prefix(bytes);
  }
  return out;
}

std::string whyNoFileName(const std::string& name) {
  constexpr std::size_t kLongest = 60;  // bytes
  if (name.find_first_not_of(" \t") == std::string::npos) return "a name must not be empty";
  if (name.size() > kLongest) return "a name has " + std::to_string(kLongest) + " characters at most";
  if (name.front() == ' ' || name.back() == ' ') return "a name has no blank at its ends";
  if (name.find_first_of("/\\:*?\"<>|") != std::string::npos || name.front() == '.' ||
      printable(name) != name)
    return "a name has none of / \\ : * ? \" < > |, and no point at its beginning: files are named after it";
  return {};
}

}  // namespace bw
