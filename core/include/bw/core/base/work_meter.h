// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace bw {

/// Bounds the work of one job by counting it, not by a clock, so that what is reached does not depend on the
/// machine. While a meter lives, the numeric code that runs on its thread charges to it what it does
/// (`chargeWork`), and every search asks (`workExhausted`) before it goes on: once the limit is spent it ends
/// like at its limit of iterations, with the best so far. Without a meter nothing is bounded. Meters of one
/// thread nest: the innermost counts, and passes what it counted on when it ends.
class WorkMeter {
 public:
  /// `limit` in units of about a tenth of a microsecond on a core of 2020.
  explicit WorkMeter(std::int64_t limit) : limit_(limit), outer_(current_) { current_ = this; }
  ~WorkMeter() {
    current_ = outer_;
    if (outer_ == nullptr) return;
    outer_->spent_ += spent_;
    outer_->stopped_ = outer_->stopped_ || stopped_;
  }
  /// A meter with a share of what the one around it has left: what a search may cost so that there is work
  /// left to use what it found. Without one around it, without bounds.
  static WorkMeter share(double part) {
    if (current_ == nullptr) return WorkMeter(std::numeric_limits<std::int64_t>::max());
    const std::int64_t left = std::max<std::int64_t>(0, current_->limit_ - current_->spent_);
    return WorkMeter(static_cast<std::int64_t>(part * static_cast<double>(left)));
  }
  WorkMeter(const WorkMeter&) = delete;
  WorkMeter& operator=(const WorkMeter&) = delete;

  /// True once a search on this thread was told to end.
  bool stopped() const { return stopped_; }

  static void charge(std::int64_t units) {
    if (current_ != nullptr) current_->spent_ += units;
  }
  static bool exhausted() {
    if (current_ == nullptr || current_->spent_ < current_->limit_) return false;
    current_->stopped_ = true;
    return true;
  }

 private:
  static inline constinit thread_local WorkMeter* current_ = nullptr;

  std::int64_t limit_;
  std::int64_t spent_ = 0;
  bool stopped_ = false;
  WorkMeter* outer_;
};

}  // namespace bw
