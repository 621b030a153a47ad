// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <stop_token>
#include <string>

#include "bw/pipeline/requests.h"

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
  using States = std::map<std::filesystem::path, pipeline::FileStamp>;
  States now() const;

  States states_;
};

}  // namespace bw::cli
