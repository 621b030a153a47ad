// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// The sample data of Debian's occt-misc in the window: files that nobody here made.
#include <algorithm>

#include "window_fixture.h"

namespace bw::app {
namespace {

class ForeignFilesInTheWindow : public WindowTest {
 protected:
  void SetUp() override {
    if (!fs::exists(BW_FOREIGN_DATA)) GTEST_SKIP() << "occt-misc is not installed";
    WindowTest::SetUp();
  }

  void dropFile(const std::string& name) {
    QMimeData mime;
    mime.setUrls({QUrl::fromLocalFile(QString::fromStdString(std::string(BW_FOREIGN_DATA) + "/" + name))});
    QDragEnterEvent enter(QPoint(300, 300), Qt::CopyAction, &mime, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window(), &enter);
    QDropEvent event(QPointF(300, 300), Qt::CopyAction, &mime, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window(), &event);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !bench().document().empty(); }, kPatience));
    ASSERT_TRUE(settle()) << name << " takes too long";
  }

  /// A result stands, or a message says in words why none does; nothing between.
  void expectResultOrReason(const std::string& name) {
    const bool result = bench().current() && bench().sweep();
    if (!result) {
      ASSERT_TRUE(bench().runner().error()) << name << ": no result and no reason";
      const std::string& message = bench().runner().error()->message;
      EXPECT_GT(message.size(), 20u) << name;
      EXPECT_GT(window().messageList().count(), 0) << name;
      EXPECT_TRUE(window().banner().isVisible()) << name << ": " << message;
      EXPECT_FALSE(window().commands()["file.export"]->isEnabled()) << name;
    }
    RecordProperty(name, result ? "result" : bench().runner().error()->message);
  }
};

TEST_F(ForeignFilesInTheWindow, OpenOrTellWhyNot) {
  for (const char* name :
       {"occ/terrain.brep", "occ/shell1.brep", "occ/asahi.brep", "iges/hammer.iges", "step/linkrods.step"}) {
    SCOPED_TRACE(name);
    ASSERT_NO_FATAL_FAILURE(dropFile(name));
    expectResultOrReason(name);
    picture("foreign-" + fs::path(name).stem().string());
    window().commands()["file.close"]->trigger();
    ASSERT_TRUE(window().onStartPage());
  }
}

TEST_F(ForeignFilesInTheWindow, SaysThatAFileHasNoFaces) {
  ASSERT_NO_FATAL_FAILURE(dropFile("occ/asahi.brep"));
  ASSERT_TRUE(bench().runner().error());
  EXPECT_NE(bench().runner().error()->message.find("no face"), std::string::npos)
      << bench().runner().error()->message;
}

TEST_F(ForeignFilesInTheWindow, CutsABlockOutOfALargeTerrain) {
  ASSERT_NO_FATAL_FAILURE(dropFile("occ/terrain.brep"));
  ASSERT_TRUE(bench().runner().evaluation());
  const auto& target = bench().runner().evaluation()->cut().target.value;
  ASSERT_TRUE(target);
  const Bounds bounds = target->bounds();
  const Eigen::Vector3d size(1200, 800, 500),
      middle = target->sampler()->closest(0.5 * (bounds.min + bounds.max), nullptr)->point;
  bench().editDesign("Place block", [&](Design& design) {
    design.block().placement = BlockPlacement{middle - 0.5 * size, size, Eigen::Vector3d::Zero()};
    design.blade.length = 1800;
    design.cut().sections.stations = 24;
  });
  ASSERT_TRUE(settle());
  expectResultOrReason("terrain in a block");
  EXPECT_TRUE(bench().sweep()) << bench().runner().error().value_or(Error{}).message;
  picture("foreign-terrain-block");
  // The first result leads to its block, which fills a good part of the picture.
  const view::SceneView& view = window().sceneView();
  QRectF seen;
  ASSERT_TRUE(view.content().first<Box>());
  for (const Eigen::Vector3d& corner : view.content().first<Box>()->corners())
    seen |= QRectF(view.toWidget(corner), QSizeF(1, 1));
  EXPECT_TRUE(QRectF(view.rect()).contains(seen));
  EXPECT_GT(std::max(seen.width() / view.width(), seen.height() / view.height()), 0.4);
}

}  // namespace
}  // namespace bw::app
