// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/handle_reach.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>

namespace bw::app {

WithinReach withinReach(const std::optional<pipeline::Reach>& reach, double by, double from, double step) {
  WithinReach may{by};
  if (!reach || reach->now != pipeline::Bar::none) return may;
  for (const pipeline::Reach::End& end : reach->ends) {
    const bool below = &end == &reach->ends[0];
    if (end.bar == pipeline::Bar::none || (below ? by >= end.free : by <= end.free)) continue;
    may.by = lastBefore(end.free, from, step);
    may.stoppedBy = end.bar;
  }
  return may;
}

double lastBefore(double end, double from, double step) {
  const double last = (from + end) / step;
  return end < 0 ? std::min(0.0, std::ceil(last) * step - from)
                 : std::max(0.0, std::floor(last) * step - from);
}

QString wordsOf(pipeline::Bar bar) {
  const auto words = [](const char* text) { return QCoreApplication::translate("HandleReach", text); };
  switch (bar) {
    case pipeline::Bar::noBlade:
      return words("no blade can be laid on it");
    case pipeline::Bar::outside:
      return words("some of the surface would leave the block");
    case pipeline::Bar::tooTight:
      return words("the blade would bend sharper than it may");
    case pipeline::Bar::crosses:
      return words("the blade would cross itself");
    case pipeline::Bar::lost:
      return words("nothing is known to keep the blade in its shape");
    case pipeline::Bar::tooFar:
      return words("the blade would leave the surface by more than the tolerance");
    case pipeline::Bar::low:
      return words("the blade would come too near to the face that the block lies on");
    case pipeline::Bar::none:
      break;
  }
  return {};
}

}  // namespace bw::app
