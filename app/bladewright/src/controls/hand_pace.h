// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Qt>

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

}  // namespace bw::app
