// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "widget_target.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>

#include <QOpenGLContext>

namespace bw::view {

WidgetTarget::WidgetTarget(QOpenGLWidget* widget)
    : widget_(widget),
      context_(widget->context()),
      window_(scene::makeGlWindow(
          [](void* held, const char* name) -> scene::GlFunction {
            return static_cast<QOpenGLContext*>(held)->getProcAddress(name);
          },
          widget->context())) {
  const auto answers = vtkSmartPointer<vtkCallbackCommand>::New();
  answers->SetClientData(this);
  answers->SetCallback([](vtkObject*, unsigned long event, void* client, void* data) {
    auto* self = static_cast<WidgetTarget*>(client);
    if (event == vtkCommand::WindowMakeCurrentEvent) self->makeCurrent();
    if (event == vtkCommand::WindowIsCurrentEvent) *static_cast<bool*>(data) = self->isCurrent();
  });
  window_->AddObserver(vtkCommand::WindowMakeCurrentEvent, answers);
  window_->AddObserver(vtkCommand::WindowIsCurrentEvent, answers);
  window_->SetFrameBlitModeToBlitToCurrent();
  window_->SetReadyForRendering(true);
}

WidgetTarget::~WidgetTarget() {
  if (makeCurrent()) window_->Finalize();
  window_->SetReadyForRendering(false);
}

bool WidgetTarget::isCurrent() const { return context_ && QOpenGLContext::currentContext() == context_; }

bool WidgetTarget::makeCurrent() {
  // While the widget paints, its frame buffer is bound already and must stay so.
  if (!isCurrent()) widget_->makeCurrent();
  return isCurrent();
}

void WidgetTarget::doneCurrent() { widget_->doneCurrent(); }

}  // namespace bw::view
