// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/text/base64.h"

#include <algorithm>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/binary_from_base64.hpp>
#include <boost/archive/iterators/transform_width.hpp>

namespace bw {

using boost::archive::iterators::base64_from_binary;
using boost::archive::iterators::binary_from_base64;
using boost::archive::iterators::transform_width;

std::string toBase64(const std::string& bytes) {
  using Digits = base64_from_binary<transform_width<std::string::const_iterator, 6, 8>>;
  std::string text(Digits(bytes.begin()), Digits(bytes.end()));
  return text.append((3 - bytes.size() % 3) % 3, '=');
}

std::optional<std::string> fromBase64(std::string text) {
  using Bytes = transform_width<binary_from_base64<std::string::const_iterator>, 8, 6>;
  const std::size_t digits = text.find_last_not_of('=') + 1, padding = text.size() - digits;
  if (text.size() % 4 != 0 || padding > 2 || text.find('=') < digits) return std::nullopt;
  std::fill(text.end() - std::ptrdiff_t(padding), text.end(), 'A');
  try {
    std::string bytes(Bytes(text.cbegin()), Bytes(text.cend()));
    bytes.resize(bytes.size() - padding);
    return bytes;
  } catch (const boost::archive::iterators::dataflow_exception&) {
    return std::nullopt;
  }
}

}  // namespace bw
