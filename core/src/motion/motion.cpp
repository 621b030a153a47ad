// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/motion/motion.h"

#include <algorithm>

namespace bw {

double Motion::cuttingTime() const {
  const auto atStation = [](const MotionInstant& instant) { return instant.station >= 0; };
  const auto first = std::ranges::find_if(instants, atStation);
  if (first == instants.end()) return duration();
  auto last = instants.end() - 1;
  while (!atStation(*last)) --last;
  const auto from = first == instants.begin() ? first : first - 1,
             to = last + 1 == instants.end() ? last : last + 1;
  return to->time - from->time;
}

}  // namespace bw
