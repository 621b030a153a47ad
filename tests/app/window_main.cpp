// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Runs the tests of the real window.
#include <gtest/gtest.h>

#include <QApplication>
#include <QSurfaceFormat>

#include "bw/view/scene_view.h"

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  QSurfaceFormat::setDefaultFormat(bw::view::SceneView::surfaceFormat());
  QApplication application(argc, argv);
  QApplication::setApplicationVersion(BW_VERSION);
  return RUN_ALL_TESTS();
}
