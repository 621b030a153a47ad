// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <QKeyEvent>
#include <QMouseEvent>
#include <QObject>

#include "bw/view/scene_view.h"
#include "window/handle_field.h"
#include "window/handle_numbers.h"
#include "window/surface_handles.h"
#include "workbench/workbench.h"

namespace bw::app {

/// The keyboard at the handle that was chosen last. The arrow keys move what is chosen by whole mm, or from
/// line to line of a grid, with Shift in steps of 10 of these, with Ctrl or Alt by tenths, and Esc takes that
/// back; a number that is typed, or Enter, opens a small field beside the handle, which takes its numbers,
/// and expressions. Both stop where the surface can no longer be cut, but for expressions, which are meant.
class HandleKeys : public QObject {
  Q_OBJECT

 public:
  HandleKeys(Workbench& bench, view::SceneView* view, SurfaceHandles& handles);

  /// Opens the field; what a key typed goes into it.
  void openField(const QKeyEvent* typed = nullptr);
  const QFrame& field() const { return *field_; }

 signals:
  /// A handle was clicked with the right button, and is chosen.
  void menuRequested(const QPoint& place);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  bool press(const QKeyEvent& key);
  void rightButton(const QMouseEvent& event);
  void nudge(HandleNumber number, double steps, const QKeyEvent& key);
  /// Moves to a number that was typed into a field.
  void take(HandleNumber number, double to, const NumberField& field);
  /// The handle whose numbers are told; −1: none.
  int handle() const;

  Workbench& bench_;
  view::SceneView* view_;
  SurfaceHandles& handles_;
  HandleField* field_;
  bool typed_ = false;  ///< the last move was of a number typed
  QPointF pressed_;     ///< where the right button went down
};

}  // namespace bw::app
