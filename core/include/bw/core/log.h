// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace bw {

enum class LogLevel { debug, info, warning };

/// Where log lines go. A value handed down to whoever logs; there is no global logger. The default is silent.
class Logger {
 public:
  using Sink = std::function<void(LogLevel, std::string_view)>;
  Logger() = default;
  explicit Logger(Sink sink) : sink_(std::move(sink)) {}
  void operator()(LogLevel level, std::string_view text) const {
    if (sink_) sink_(level, text);
  }

 private:
  Sink sink_;
};

}  // namespace bw
