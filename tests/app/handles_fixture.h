// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include "window_fixture.h"

namespace bw::app {

/// A window on a designed example whose handles stand where they are seen.
class HandlesTest : public WindowTest {
 protected:
  void open(const QString& name) {
    ASSERT_TRUE(window().openExample(name));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(bench().current()) << bench().runner().error().value_or(Error{}).message;
    ASSERT_TRUE(QTest::qWaitFor([&] { return view().resting(); }, kPatience));
  }
  /// Turns the camera to the front, and waits until it stands: a handle that is pressed before lies
  /// elsewhere.
  bool lookFromFront() {
    window().commands()["view.front"]->trigger();
    return QTest::qWaitFor(
        [&] {
          const scene::Camera camera = view().camera();
          return view().resting() && std::abs((camera.focus - camera.position).normalized().y()) > 0.999;
        },
        kPatience);
  }
  view::SceneView& view() { return window().sceneView(); }
  const scene::Handles& handles() { return view().sceneStyle().handles; }
  QPoint at(int handle) { return view().toWidget(handles().points[std::size_t(handle)]).toPoint(); }
};

}  // namespace bw::app
