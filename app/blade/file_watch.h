// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

namespace bw::cli {

/// Files, each as it was when it was added. What is read afterwards of one that changes meanwhile counts as
/// changed: a file is added before it is read.
class FileWatch {
 public:
  void add(const std::filesystem::path& file);
  /// Waits until a file is another, there or gone, and all have stayed as they are for a moment, since what
  /// writes them may take some time. False once a stop was requested.
  bool awaitChange(const std::stop_token& stop) const;
  /// "a.bladewright and b.step".
  std::string names() const;

 private:
  /// Time of the last change and size; empty where there is none.
  using State = std::optional<std::pair<std::filesystem::file_time_type, std::uintmax_t>>;
  using States = std::map<std::filesystem::path, State>;
  static State stateOf(const std::filesystem::path& file);
  States now() const;

  States states_;
};

}  // namespace bw::cli
