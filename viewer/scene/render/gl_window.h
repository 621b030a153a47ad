// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkSmartPointer.h>

namespace bw::scene {

/// Samples a pixel of a finished picture; drivers that offer fewer give what they have.
inline constexpr int kSamples = 8;

/// Where a scene is drawn: a VTK window over a GL context that someone holds.
class RenderTarget {
 public:
  virtual ~RenderTarget() = default;
  virtual vtkGenericOpenGLRenderWindow* window() const = 0;
  virtual bool makeCurrent() = 0;
  virtual void doneCurrent() = 0;
};

/// Finds a function of GL by its name in a context; `context` is whatever the caller wants back.
using GlFunction = void (*)();
using GlLoader = GlFunction (*)(void* context, const char* name);

/// A VTK window over a GL context (3.2 core or later) that is not its own. It answers WindowIsCurrentEvent
/// and WindowMakeCurrentEvent through its observers. VTK from 9.4 on finds GL through `loader`, earlier ones
/// by themselves; `context` must live as long as the window.
vtkSmartPointer<vtkGenericOpenGLRenderWindow> makeGlWindow(GlLoader loader, void* context);

}  // namespace bw::scene
