// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Qt>

#include <cmath>

namespace bw::app {

/// What a hand counts by when it moves something: as it is, coarsely with Shift, finely with Ctrl or Alt, the
/// same with the mouse as with the arrow keys.
struct HandSteps {
  double fine = 0.1, plain = 1, coarse = 10;
};

/// How a hand moves something while it holds these keys.
struct HandPace {
  double step = 1;   ///< of the number that is moved
  double share = 1;  ///< of the way of the hand that it goes
};

inline HandPace handPace(Qt::KeyboardModifiers keys, const HandSteps& steps = {}) {
  constexpr double kFineShare = 0.1;
  if (keys & (Qt::ControlModifier | Qt::AltModifier)) return {steps.fine, kFineShare};
  return {keys & Qt::ShiftModifier ? steps.coarse : steps.plain, 1};
}

/// The round number so many steps on from a number, which may lie between two.
inline double nextRound(double number, double step, double steps) {
  constexpr double kNear = 1e-6;
  const double places = number / step;
  return (steps > 0 ? std::floor(places + kNear) + steps : std::ceil(places - kNear) + steps) * step;
}

}  // namespace bw::app
