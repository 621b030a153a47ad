// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "section_ends.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace bw::geometry {

namespace {

constexpr double kSteep = 2;             // mm outward a mm of travel
constexpr double kLeastStep = 1;         // mm
constexpr std::size_t kEndStations = 3;  // stations that tell how a border goes on

/// The steps of one side of a row.
class Steps {
 public:
  explicit Steps(const std::vector<RowEnd>& ends) : ends_(ends) {
    for (const RowEnd& end : ends) reach_.push_back(end.out);
  }

  std::vector<double> fill() {
    if (ends_.size() < 3) return reach_;
    std::size_t at = 0;
    if (const std::optional<std::size_t> first = nextStep(0); first && step(*first) > 0) {
      at = rimFrom(lastRise(*first), true);
      goOn(at, false);
    }
    while (const std::optional<std::size_t> down = nextStep(at)) {
      if (step(*down) > 0) {  // of a stair, whose rim was found
        at = *down + 1;
        continue;
      }
      const std::optional<std::size_t> rim = rimAfter(*down);
      const std::size_t near = rimFrom(*down, false);
      if (!rim) {
        goOn(near, true);
        break;
      }
      at = rimFrom(*rim, true);
      for (std::size_t k = near + 1; k < at; ++k) {
        const RowEnd &a = ends_[near], &b = ends_[at];
        reach(k, std::lerp(a.out, b.out, (ends_[k].travel - a.travel) / (b.travel - a.travel)));
      }
    }
    return reach_;
  }

 private:
  void reach(std::size_t k, double out) { reach_[k] = std::max(reach_[k], out); }

  /// 1 where the border steps outward from station k to the next, −1 inward, else 0.
  int step(std::size_t k) const {
    const double by = ends_[k + 1].out - ends_[k].out;
    if (std::abs(by) <= std::max(kLeastStep, kSteep * (ends_[k + 1].travel - ends_[k].travel))) return 0;
    return by > 0 ? 1 : -1;
  }
  std::optional<std::size_t> nextStep(std::size_t from) const {
    for (std::size_t k = from; k + 1 < ends_.size(); ++k)
      if (step(k) != 0) return k;
    return {};
  }
  /// The station after the last of the steps outward before one inward.
  std::size_t lastRise(std::size_t from) const {
    std::size_t last = from + 1;
    for (std::size_t k = from; k + 1 < ends_.size() && step(k) >= 0; ++k)
      if (step(k) > 0) last = k + 1;
    return last;
  }
  /// The far rim of a notch: the first station after steps outward that reaches as far as the near one, or
  /// that of them which reaches farthest.
  std::optional<std::size_t> rimAfter(std::size_t down) const {
    std::optional<std::size_t> best;
    for (std::size_t k = down + 1; k + 1 < ends_.size(); ++k) {
      if (step(k) <= 0 || (k + 2 < ends_.size() && step(k + 1) > 0)) continue;
      if (!best || ends_[k + 1].out > ends_[*best].out) best = k + 1;
      if (ends_[*best].out >= ends_[down].out) break;
    }
    return best;
  }
  /// Where a border comes out of a step its rim lies between two stations: the one that reaches farther.
  std::size_t rimFrom(std::size_t k, bool onward) const {
    if (onward ? k + 1 == ends_.size() : k == 0) return k;
    const std::size_t next = onward ? k + 1 : k - 1;
    return ends_[next].out > ends_[k].out ? next : k;
  }
  /// The border beside station k goes on to the end of the row: `onward` to the last one.
  void goOn(std::size_t k, bool onward) {
    std::size_t beside = k;
    for (std::size_t n = 0; n < kEndStations; ++n) {
      if (onward ? beside == 0 || step(beside - 1) != 0 : beside + 1 == ends_.size() || step(beside) != 0)
        break;
      onward ? --beside : ++beside;
    }
    const double slope =
        beside == k ? 0 : (ends_[beside].out - ends_[k].out) / (ends_[beside].travel - ends_[k].travel);
    for (std::size_t i = onward ? k + 1 : 0; i < (onward ? ends_.size() : k); ++i)
      reach(i, ends_[k].out + slope * (ends_[i].travel - ends_[k].travel));
  }

  const std::vector<RowEnd>& ends_;
  std::vector<double> reach_;
};

}  // namespace

std::vector<double> withoutSteps(const std::vector<RowEnd>& ends) { return Steps(ends).fill(); }

}  // namespace bw::geometry
