// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/files/shared_bytes.h"

#include <functional>
#include <utility>

namespace bw {

SharedBytes::SharedBytes(std::string bytes) {
  if (bytes.empty()) return;
  hash_ = std::hash<std::string>{}(bytes);
  shared_ = std::make_shared<const std::string>(std::move(bytes));
}

const std::string& SharedBytes::str() const {
  static const std::string none;
  return shared_ ? *shared_ : none;
}

bool SharedBytes::operator==(const SharedBytes& other) const {
  return shared_ == other.shared_ || (hash_ == other.hash_ && str() == other.str());
}

}  // namespace bw
