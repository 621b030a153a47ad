// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace bw::app {

class HandSlider;

/// `grab` is called when a hand takes hold of `slider`, and returns what puts back that which stood then. Esc
/// calls that while the slider is held: the hand then holds it no longer, whatever its button does.
void putBackByEscape(HandSlider& slider, std::function<std::function<void()>()> grab);

}  // namespace bw::app
