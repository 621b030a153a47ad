// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/kerf_table.h"

#include <algorithm>
#include <cmath>

namespace bw {

double kerfAt(const KerfTable& table, double speed) {
  if (table.empty()) return 0;
  const auto after = std::ranges::upper_bound(table, speed, {}, &KerfAt::speed);
  if (after == table.begin()) return table.front().width;
  if (after == table.end()) return table.back().width;
  const KerfAt &a = *std::prev(after), &b = *after;
  return std::lerp(a.width, b.width, (speed - a.speed) / (b.speed - a.speed));
}

double widestKerf(const KerfTable& table) {
  double widest = 0;
  for (const KerfAt& entry : table) widest = std::max(widest, entry.width);
  return widest;
}

}  // namespace bw
