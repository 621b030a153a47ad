// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "bw/core/base/result.h"
#include "scene/render/gl_window.h"

namespace bw::scene {

/// A window without a screen: a surfaceless EGL context of its own. Fails where the system offers none.
Result<std::unique_ptr<RenderTarget>> makeOffscreenTarget();

}  // namespace bw::scene
