// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QOpenGLContext>
#include <QOpenGLWidget>

#include "scene/render/gl_window.h"

namespace bw::view {

/// Lets VTK draw in the frame buffer of a QOpenGLWidget. Make it while the widget's context is current.
class WidgetTarget : public scene::RenderTarget {
 public:
  explicit WidgetTarget(QOpenGLWidget* widget)
      : RenderTarget(
            [](void* held, const char* name) -> scene::GlFunction {
              return static_cast<QOpenGLContext*>(held)->getProcAddress(name);
            },
            widget->context()),
        widget_(widget),
        context_(widget->context()) {
    window()->SetFrameBlitModeToBlitToCurrent();
  }
  ~WidgetTarget() override { release(); }

  bool isCurrent() const override { return context_ && QOpenGLContext::currentContext() == context_; }
  bool makeCurrent() override {
    // While the widget paints, its frame buffer is bound already and must stay so.
    if (!isCurrent()) widget_->makeCurrent();
    return isCurrent();
  }
  void doneCurrent() override { widget_->doneCurrent(); }

 private:
  QOpenGLWidget* widget_;
  QOpenGLContext* context_;
};

}  // namespace bw::view
