// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QOpenGLWidget>

#include "scene/render/gl_window.h"

namespace bw::view {

/// Lets VTK draw in the frame buffer of a QOpenGLWidget. Make it while the widget's context is current.
class WidgetTarget : public scene::RenderTarget {
 public:
  explicit WidgetTarget(QOpenGLWidget* widget);
  ~WidgetTarget() override;
  vtkGenericOpenGLRenderWindow* window() const override { return window_; }
  bool makeCurrent() override;
  void doneCurrent() override;

 private:
  bool isCurrent() const;

  QOpenGLWidget* widget_;
  QOpenGLContext* context_;
  vtkSmartPointer<vtkGenericOpenGLRenderWindow> window_;
};

}  // namespace bw::view
