// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkSmartPointer.h>

#include <memory>

#include "bw/core/base/result.h"

namespace bw::scene {

/// Samples a pixel of a finished picture; drivers that offer fewer give what they have.
inline constexpr int kSamples = 8;

/// Finds a function of GL by its name in a context; `context` is whatever the caller wants back.
using GlFunction = void (*)();
using GlLoader = GlFunction (*)(void* context, const char* name);

/// Where a scene is drawn: a VTK window over a GL context (3.2 core or later) that someone holds.
class RenderTarget {
 public:
  virtual ~RenderTarget() = default;
  RenderTarget(const RenderTarget&) = delete;
  RenderTarget& operator=(const RenderTarget&) = delete;
  vtkGenericOpenGLRenderWindow* window() const { return window_; }
  virtual bool isCurrent() const = 0;
  virtual bool makeCurrent() = 0;
  virtual void doneCurrent() = 0;
  /// Samples a pixel that finished pictures get here: `kSamples`, or fewer where a picture got no more.
  int samples() const { return samples_; }
  /// Takes in what a picture just drawn with `samples()` got: to ask for more each time would cost new
  /// buffers each time.
  virtual void seeFinished();

 protected:
  /// VTK from 9.4 on finds GL through `loader`, earlier ones by themselves; `context` must live as long.
  RenderTarget(GlLoader loader, void* context);
  /// Gives up the window, while the context is still there: every destructor calls it.
  void release();

 private:
  vtkSmartPointer<vtkGenericOpenGLRenderWindow> window_;
  int samples_ = kSamples;
};

/// A window without a screen: a surfaceless EGL context of its own. Fails where the system offers none.
Result<std::unique_ptr<RenderTarget>> makeOffscreenTarget();

}  // namespace bw::scene
