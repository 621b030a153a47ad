// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Qt>

#include "bw/view/scene_view.h"

namespace bw::view {

enum class Drag { none, orbit, pan, zoom };

/// What dragging with that button and those keys does.
Drag dragFor(Navigation navigation, Qt::MouseButton button, Qt::KeyboardModifiers keys);

}  // namespace bw::view
