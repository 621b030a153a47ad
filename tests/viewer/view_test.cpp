// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <QApplication>
#include <QDir>
#include <QMainWindow>
#include <QMouseEvent>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include <cmath>

#include "bw/scene/navigation.h"
#include "bw/view/scene_view.h"
#include "patience.h"
#include "scene_sample.h"

namespace {

using bw::kPatience;
using bw::scene::Camera;
using bw::scene::Pick;
using bw::scene::Style;
using bw::scene::View;
using bw::view::Navigation;
using bw::view::SceneView;

/// A shown view of the sample panel with its first frame drawn.
class SceneViewTest : public testing::Test {
 protected:
  void SetUp() override {
    Style style;
    style[bw::scene::Kind::cut].map = "deviation";
    view.resize(900, 640);
    view.setStyle(style);
    view.setContent(bw::test::sampleContent());
    QSignalSpy first(&view, &SceneView::rendered);
    view.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&view, kPatience));
    ASSERT_TRUE(first.count() > 0 || first.wait(kPatience));
  }

  static void send(QWidget& widget, QEvent::Type type, const QPointF& at, Qt::MouseButton button,
                   Qt::MouseButtons held, Qt::KeyboardModifiers keys = {}) {
    QMouseEvent event(type, at, widget.mapToGlobal(at), button, held, keys);
    QApplication::sendEvent(&widget, &event);
  }

  void drag(const QPointF& from, const QPointF& to, Qt::MouseButton button, Qt::KeyboardModifiers keys = {}) {
    send(view, QEvent::MouseButtonPress, from, button, button, keys);
    constexpr int kSteps = 8;
    for (int i = 1; i <= kSteps; ++i) {
      send(view, QEvent::MouseMove, from + (to - from) * i / kSteps, Qt::NoButton, button, keys);
    }
    send(view, QEvent::MouseButtonRelease, to, button, Qt::NoButton, keys);
  }

  void wheel(const QPointF& at, int angle) {
    QWheelEvent event(at, view.mapToGlobal(at), QPoint(), QPoint(0, angle), Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&view, &event);
  }

  Eigen::Vector3d stationPoint(int station) const {
    const auto& line = view.content().first<bw::scene::Stations>()->lines[std::size_t(station)];
    return line[line.size() / 2];
  }

  static double distance(const QPointF& a, const QPointF& b) {
    return std::hypot(a.x() - b.x(), a.y() - b.y());
  }

  void save(const QImage& image, const char* name) {
    QDir().mkpath(BW_TEST_OUTPUT);
    image.save(QString(BW_TEST_OUTPUT) + "/" + name);
  }

  SceneView view;
};

TEST_F(SceneViewTest, ShowsTheMapItsLegendAndTheBackground) {
  const QImage image = view.grabFramebuffer();
  save(image, "view-first.png");
  ASSERT_EQ(image.size(), QSize(900, 640) * view.devicePixelRatioF());
  int red = 0, blue = 0;
  for (int y = 0; y < image.height(); y += 2) {
    for (int x = 0; x < int(view.legendRect().left()); x += 2) {
      const QColor c = image.pixelColor(x, y);
      red += c.red() > c.blue() + 80;
      blue += c.blue() > c.red() + 80;
      ASSERT_EQ(c.alpha(), 255);
    }
  }
  EXPECT_GT(red, 500);
  EXPECT_GT(blue, 500);
  EXPECT_TRUE(QRectF(view.rect()).contains(view.legendRect()));
  // The gradient runs from light above to grey below.
  EXPECT_GT(image.pixelColor(image.width() / 2, 1).lightness(),
            image.pixelColor(image.width() / 2, image.height() - 2).lightness() + 8);
}

TEST_F(SceneViewTest, FirstContentIsFittedBesideTheLegend) {
  for (const auto& station : view.content().first<bw::scene::Stations>()->lines) {
    for (const auto& p : station) {
      const QPointF place = view.toWidget(p);
      EXPECT_TRUE(QRectF(view.rect()).contains(place));
      EXPECT_LT(place.x(), view.legendRect().left());
    }
  }
}

TEST_F(SceneViewTest, ClickPicksTheStationUnderTheCursor) {
  QSignalSpy spy(&view, &SceneView::picked);
  for (const int station : {3, 12, 22}) {
    QTest::mouseClick(&view, Qt::LeftButton, {}, view.toWidget(stationPoint(station)).toPoint());
    ASSERT_EQ(spy.count(), 1);
    EXPECT_EQ(spy.takeFirst().at(0).value<Pick>().station.station, station);
  }
  QTest::mouseClick(&view, Qt::LeftButton, {}, QPoint(450, 4));
  ASSERT_EQ(spy.count(), 1);
  EXPECT_EQ(spy.takeFirst().at(0).value<Pick>().station.station, -1);
}

TEST_F(SceneViewTest, HoveringTellsTheValueOfTheMap) {
  Pick last;
  QObject::connect(&view, &SceneView::hovered, [&](const Pick& pick) { last = pick; });
  const auto& cut = view.content().first<bw::scene::CutSurface>()->grid;
  const std::size_t index = std::size_t(30) * std::size_t(cut.columns) + 20;
  send(view, QEvent::MouseMove, view.toWidget(cut.points[index]), Qt::NoButton, Qt::NoButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return last.value.has_value(); }, kPatience));
  EXPECT_NEAR(*last.value, cut.fields[0].values[index], 0.05);
  EXPECT_LT((last.point - cut.points[index]).norm(), 1.0);
}

TEST_F(SceneViewTest, WhatComesToLieUnderARestingCursorIsLitToo) {
  const QPointF at(300, 330);
  ASSERT_EQ(view.handleAt(at), -1);
  send(view, QEvent::MouseMove, at, Qt::NoButton, Qt::NoButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return view.resting(); }, kPatience));
  QSignalSpy lit(&view, &SceneView::handleHovered);
  Style style = view.sceneStyle();
  const auto [origin, direction] = view.rayAt(at);
  style.handles.points = {origin + 500 * direction};
  view.setStyle(style);
  ASSERT_TRUE(lit.count() > 0 || lit.wait(kPatience));
  EXPECT_EQ(lit.last().front().toInt(), 0);
  // And goes out where the picture moves away.
  style.handles.points = {view.rayAt(at + QPointF(80, 0)).first +
                          500 * view.rayAt(at + QPointF(80, 0)).second};
  view.setStyle(style);
  ASSERT_TRUE(lit.count() > 1 || lit.wait(kPatience));
  EXPECT_EQ(lit.last().front().toInt(), -1);
  // Nothing of it where the cursor is elsewhere.
  QEvent leave(QEvent::Leave);
  QApplication::sendEvent(&view, &leave);
  style.handles.points = {origin + 500 * direction};
  view.setStyle(style);
  ASSERT_TRUE(QTest::qWaitFor([&] { return view.resting(); }, kPatience));
  EXPECT_EQ(lit.count(), 2);
  // A view that comes to stand under the cursor sees it without a move.
  QEnterEvent enter(at, at, view.mapToGlobal(at));
  QApplication::sendEvent(&view, &enter);
  ASSERT_TRUE(lit.count() > 2 || lit.wait(kPatience));
  EXPECT_EQ(lit.last().front().toInt(), 0);
}

TEST_F(SceneViewTest, OrbitTurnsAboutThePointUnderTheCursorAndKeepsTheHorizon) {
  const Eigen::Vector3d pivot = stationPoint(15);
  const QPointF at = view.toWidget(pivot);
  const Camera before = view.camera();
  drag(at, at + QPointF(120, -30), Qt::RightButton);
  const Camera after = view.camera();
  EXPECT_GT((after.position - before.position).norm(), 100);
  // The cursor's point is hit within a pixel, and stays within one.
  EXPECT_LT(distance(view.toWidget(pivot), at), 1.5);
  EXPECT_NEAR((after.focus - after.position).cross(after.up).z(), 0, 1e-6);
  EXPECT_GT(after.up.z(), 0);
  EXPECT_NEAR((after.position - after.focus).norm(), (before.position - before.focus).norm(), 1e-6);
}

TEST_F(SceneViewTest, OrbitStopsStraightAbove) {
  drag({300, 200}, {300, 1200}, Qt::RightButton);
  const Camera camera = view.camera();
  EXPECT_NEAR((camera.position - camera.focus).normalized().z(), 1, 1e-9);
  EXPECT_NEAR(camera.up.z(), 0, 1e-9);
}

TEST_F(SceneViewTest, PanCarriesThePointUnderTheCursor) {
  const Eigen::Vector3d point = stationPoint(10);
  const QPointF from = view.toWidget(point);
  drag(from, from + QPointF(60, 40), Qt::RightButton, Qt::ShiftModifier);
  EXPECT_LT(distance(view.toWidget(point), from + QPointF(60, 40)), 1.0);
  const QPointF back = view.toWidget(point);
  drag(back, back - QPointF(25, 35), Qt::MiddleButton);
  EXPECT_LT(distance(view.toWidget(point), back - QPointF(25, 35)), 1.0);
}

TEST_F(SceneViewTest, WheelZoomsToTheCursor) {
  for (const bool parallel : {false, true}) {
    view.setParallel(parallel);
    const Eigen::Vector3d point = stationPoint(6), other = stationPoint(24);
    const QPointF at = view.toWidget(point);
    const double before = distance(at, view.toWidget(other));
    wheel(at, 240);
    EXPECT_LT(distance(view.toWidget(point), at), 1.0);
    EXPECT_GT(distance(at, view.toWidget(other)), 1.2 * before);
    wheel(at, -240);
    EXPECT_NEAR(distance(at, view.toWidget(other)), before, 1.0);
  }
}

TEST_F(SceneViewTest, PresetsMapTheButtons) {
  const auto moves = [&](Qt::MouseButton button, Qt::KeyboardModifiers keys) {
    view.setView(View::iso, false);
    const Camera before = view.camera();
    drag({350, 300}, {400, 320}, button, keys);
    const Camera after = view.camera();
    const bool turned =
        ((after.position - after.focus).normalized() - (before.position - before.focus).normalized()).norm() >
        1e-6;
    const bool scaled = std::abs(after.parallelScale - before.parallelScale) > 1e-6;
    const bool shifted = (after.position - before.position).norm() > 1e-6;
    return turned ? 'o' : scaled ? 'z' : shifted ? 'p' : '-';
  };
  const auto row = [&](Navigation navigation) {
    view.setNavigation(navigation);
    std::string result;
    for (const Qt::MouseButton button : {Qt::MiddleButton, Qt::RightButton}) {
      for (const Qt::KeyboardModifier key : {Qt::NoModifier, Qt::ShiftModifier, Qt::ControlModifier})
        result += moves(button, key);
    }
    return result;
  };
  EXPECT_EQ(row(Navigation::rhino), "pppopz");
  EXPECT_EQ(row(Navigation::blender), "opz---");
  EXPECT_EQ(row(Navigation::solidworks), "ozpppp");
}

TEST_F(SceneViewTest, StandardViewIsReachedInAnEasedMoveThatKeepsTheHorizon) {
  int moves = 0;
  double tilt = 0;
  QObject::connect(&view, &SceneView::cameraChanged, [&] {
    const Camera camera = view.camera();
    ++moves;
    tilt = std::max(tilt, std::abs((camera.focus - camera.position).normalized().cross(camera.up).z()));
  });
  view.setView(View::top, true);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return (view.camera().position - view.camera().focus).normalized().z() > 1 - 1e-12; },
      kPatience));
  EXPECT_GE(moves, 2);
  EXPECT_LT(tilt, 1e-9);
  EXPECT_NEAR(view.camera().up.y(), 1, 1e-9);
}

TEST_F(SceneViewTest, ClickOnTheCubeTakesThatView) {
  // In the oblique view the upper face of the cube lies above the middle of its square.
  QTest::mouseClick(&view, Qt::LeftButton, {}, QPoint(68, view.height() - 68 - 22));
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return (view.camera().position - view.camera().focus).normalized().z() > 1 - 1e-9; }, kPatience));
}

TEST_F(SceneViewTest, StandardViewsAreParallelAndADesignOpensInPerspective) {
  EXPECT_FALSE(view.parallel());
  for (const View standard :
       {View::iso, View::top, View::bottom, View::front, View::back, View::left, View::right}) {
    view.open();
    EXPECT_FALSE(view.parallel());
    view.setView(standard, false);
    EXPECT_TRUE(view.parallel());
    const Eigen::Vector3d back = (view.camera().position - view.camera().focus).normalized();
    EXPECT_LT((back - bw::scene::directionOf(standard)).norm(), 1e-9);
  }
  // On the way there nothing jumps: sizes at the focus change evenly.
  view.open();
  const auto size = [&] { return bw::scene::pixelSize(view.camera(), view.height()); };
  const double from = size();
  std::vector<double> sizes{from};
  QObject::connect(&view, &SceneView::cameraChanged, [&] { sizes.push_back(size()); });
  view.setView(View::top, true);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return (view.camera().position - view.camera().focus).normalized().z() > 1 - 1e-12; },
      kPatience));
  const double low = std::min(from, sizes.back()) * 0.99, high = std::max(from, sizes.back()) * 1.01;
  for (const double s : sizes) {
    EXPECT_GE(s, low);
    EXPECT_LE(s, high);
  }
}

TEST_F(SceneViewTest, ClickOnAnEdgeOfTheCubeLooksFromThere) {
  // In the oblique view the edge between top and front runs up to the left of the middle of its square.
  const QPoint edge(68 - 19, view.height() - 68 - 11);
  send(view, QEvent::MouseMove, edge, Qt::NoButton, Qt::NoButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return view.cursor().shape() == Qt::PointingHandCursor; }, kPatience));
  save(view.grabFramebuffer(), "view-cube-edge.png");
  QTest::mouseClick(&view, Qt::LeftButton, {}, edge);
  const Eigen::Vector3d wanted = Eigen::Vector3d(0, -1, 1).normalized();
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return ((view.camera().position - view.camera().focus).normalized() - wanted).norm() < 1e-9; },
      kPatience));
  EXPECT_TRUE(view.parallel());
}

/// The sample elsewhere, and of another size.
bw::scene::Content shifted(const Eigen::Vector3d& by, double scale) {
  bw::scene::Content content = bw::test::sampleContent();
  const auto move = [&](Eigen::Vector3d& p) { p = scale * p + by; };
  for (auto& p : content.first<bw::TriangleMesh>()->points) move(p);
  for (auto& p : content.first<bw::scene::CutSurface>()->grid.points) move(p);
  for (auto* lines :
       {&content.first<bw::scene::Stations>()->lines, &content.first<bw::scene::Blades>()->lines})
    for (auto& line : *lines)
      for (auto& p : line) move(p);
  move(content.first<bw::Box>()->frame.origin);
  content.first<bw::Box>()->size *= scale;
  return content;
}

TEST_F(SceneViewTest, RefitsWhatLeftThePictureAndLeavesAloneWhatDidNot) {
  const auto settle = [&] {
    Camera last = view.camera();
    return QTest::qWaitFor(
        [&] {
          const Camera now = view.camera();
          const bool still = (now.position - last.position).norm() < 1e-12;
          last = now;
          return still && view.resting();
        },
        kPatience);
  };
  const auto inSight = [&] {
    const auto& block = *view.content().first<bw::Box>();
    return QRectF(view.rect())
        .contains(view.toWidget(block.frame.toWorld(0.5 * block.size.head<2>(), 0.5 * block.size.z())));
  };
  const Camera before = view.camera();
  view.setContent(shifted({5, -3, 2}, 1));
  EXPECT_TRUE(settle());
  EXPECT_EQ(view.camera().position, before.position) << "a small change moves no camera";
  view.setContent(shifted({90000, 0, 500}, 1));
  EXPECT_TRUE(QTest::qWaitFor(inSight, kPatience)) << "another place";
  EXPECT_TRUE(settle());
  view.setContent(shifted({0, 0, 0}, 25.4));
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return inSight() && view.toWidget(view.content().first<bw::Box>()->frame.origin).x() > 0; },
      kPatience))
      << "another unit";
  EXPECT_TRUE(settle());
  // Who looks at a detail keeps it while the rest changes a little.
  bw::Bounds detail;
  detail.add(view.content().first<bw::scene::Stations>()->lines[8][40]);
  view.fitBounds(detail, false);
  const Camera close = view.camera();
  view.setContent(shifted({0, 0, 10}, 25.5));
  EXPECT_TRUE(settle());
  EXPECT_EQ(view.camera().position, close.position);
}

TEST_F(SceneViewTest, TheCameraStandsWhileAHandleIsHeld) {
  Style style = view.sceneStyle();
  style.handles.points = {stationPoint(8)};
  view.setStyle(style);
  const auto place = [&] { return view.toWidget(view.sceneStyle().handles.points.front()); };
  ASSERT_TRUE(QTest::qWaitFor([&] { return view.resting(); }, kPatience));
  // Pressed in the middle of a glide.
  int moves = 0;
  QObject::connect(&view, &SceneView::cameraChanged, [&] { ++moves; });
  view.setView(View::front, true);
  EXPECT_FALSE(view.resting()) << "the camera glides";
  ASSERT_TRUE(QTest::qWaitFor([&] { return moves > 1; }, kPatience));
  QPointF at = place();
  ASSERT_EQ(view.handleAt(at), 0);
  send(view, QEvent::MouseButtonPress, at, Qt::LeftButton, Qt::LeftButton);
  ASSERT_TRUE(view.holding());
  const Camera held = view.camera();
  QTest::qWait(600);
  EXPECT_EQ(view.camera().position, held.position) << "the glide ends where the handle was seized";
  // And what the pull brings out of the picture is not followed before it is let go of.
  view.setContent(shifted({90000, 0, 0}, 1));
  QTest::qWait(100);
  EXPECT_EQ(view.camera().position, held.position);
  send(view, QEvent::MouseButtonRelease, at, Qt::LeftButton, Qt::NoButton);
  EXPECT_FALSE(view.holding());
  EXPECT_TRUE(QTest::qWaitFor([&] { return view.resting() && view.camera().focus.x() > 80000; }, kPatience));
  // Nor is what is given up, which comes back to where it was.
  view.setContent(bw::test::sampleContent());
  ASSERT_TRUE(QTest::qWaitFor([&] { return view.resting() && view.camera().focus.x() < 10000; }, kPatience));
  at = place();
  ASSERT_EQ(view.handleAt(at), 0);
  send(view, QEvent::MouseButtonPress, at, Qt::LeftButton, Qt::LeftButton);
  const Camera again = view.camera();
  view.setContent(shifted({90000, 0, 0}, 1));
  view.letGo();
  view.setContent(bw::test::sampleContent());
  QTest::qWait(600);
  EXPECT_EQ(view.camera().position, again.position);
}

TEST_F(SceneViewTest, FacesAreClickedOnlyWhileTheyAreChosen) {
  bw::scene::Content content = bw::test::sampleContent();
  auto faces = std::make_shared<bw::FaceMesh>();
  faces->mesh = *content.first<bw::TriangleMesh>();
  for (const auto& triangle : faces->mesh.triangles) {
    const Eigen::Vector3d& p = faces->mesh.points[std::size_t(triangle[0])];
    faces->faces.push_back(int(std::clamp((p.x() + 30) / 66, 0.0, 9.0)) +
                           10 * int(std::clamp((p.y() + 30) / 36.5, 0.0, 19.0)));
  }
  content.add({}, bw::scene::Faces{faces});
  view.setContent(content);
  std::vector<std::pair<int, Qt::KeyboardModifiers>> clicked;
  QObject::connect(&view, &SceneView::faceClicked,
                   [&](int face, Qt::KeyboardModifiers keys) { clicked.emplace_back(face, keys); });
  QSignalSpy stations(&view, &SceneView::picked);
  const QPoint at = view.toWidget({300, 335, bw::test::panelHeight(300, 335)}).toPoint();
  QTest::mouseClick(&view, Qt::LeftButton, {}, at);
  EXPECT_TRUE(clicked.empty());
  EXPECT_EQ(stations.count(), 1);
  Style style = view.sceneStyle();
  style.chooseFaces = true;
  view.setStyle(style);
  QTest::mouseClick(&view, Qt::LeftButton, {}, at);
  QTest::mouseClick(&view, Qt::LeftButton, Qt::ControlModifier, at);
  EXPECT_EQ(stations.count(), 1);
  ASSERT_EQ(clicked.size(), 2u);
  EXPECT_NEAR(clicked[0].first % 10, 5, 1);
  EXPECT_EQ(clicked[1].second, Qt::ControlModifier);
  // Hovering lights up one face of two hundred.
  Pick last;
  QObject::connect(&view, &SceneView::hovered, [&](const Pick& pick) { last = pick; });
  send(view, QEvent::MouseMove, at, Qt::NoButton, Qt::NoButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return last.kind == Pick::Kind::face; }, kPatience));
  EXPECT_EQ(last.face, clicked[0].first);
}

TEST_F(SceneViewTest, DoubleClickOnTheLegendAsksForItsRange) {
  QSignalSpy spy(&view, &SceneView::legendActivated);
  QSignalSpy picks(&view, &SceneView::picked);
  const QPoint at = view.legendRect().center().toPoint();
  QTest::mouseDClick(&view, Qt::LeftButton, {}, at);
  EXPECT_EQ(spy.count(), 1);
  EXPECT_EQ(picks.count(), 0);
}

TEST_F(SceneViewTest, ParallelKeepsSizesAtTheFocus) {
  const Camera camera = view.camera();
  const Eigen::Vector3d side =
      camera.focus + 100 * (camera.focus - camera.position).cross(camera.up).normalized();
  const double before = distance(view.toWidget(camera.focus), view.toWidget(side));
  view.setParallel(true);
  EXPECT_TRUE(view.parallel());
  EXPECT_NEAR(distance(view.toWidget(camera.focus), view.toWidget(side)), before, 1e-6);
  view.setParallel(false);
  EXPECT_LT((view.camera().position - camera.position).norm(), 1e-6);
}

TEST_F(SceneViewTest, FitBoundsFramesASmallPlace) {
  bw::Bounds place;
  place.add(stationPoint(8));
  view.fitBounds(place, false);
  EXPECT_LT(distance(view.toWidget(stationPoint(8)), QPointF(view.rect().center())), 150);
  EXPECT_GT(distance(view.toWidget(stationPoint(8)), view.toWidget(stationPoint(10))), 60);
}

TEST_F(SceneViewTest, PictureHasAnySizeAndLeavesTheViewAsItWas) {
  const QImage before = view.grabFramebuffer();
  const QImage picture = view.picture(QSize(1500, 1000), 2);
  save(picture, "view-picture.png");
  ASSERT_EQ(picture.size(), QSize(1500, 1000));
  const QImage after = view.grabFramebuffer();
  ASSERT_EQ(after.size(), before.size());
  int different = 0;
  for (int y = 0; y < before.height(); y += 5) {
    for (int x = 0; x < before.width(); x += 5) different += before.pixel(x, y) != after.pixel(x, y);
  }
  EXPECT_EQ(different, 0);
}

TEST_F(SceneViewTest, StyleReachesTheNextFrame) {
  Style style = view.sceneStyle();
  style.dark = true;
  style.playhead = 10.5;
  view.setStyle(style);
  const QImage image = view.grabFramebuffer();
  save(image, "view-dark.png");
  EXPECT_LT(image.pixelColor(450, 2).lightness(), 60);
}

TEST_F(SceneViewTest, SurvivesAMoveToAnotherWindow) {
  QMainWindow window;
  window.resize(700, 500);
  window.setCentralWidget(&view);
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window, kPatience));
  const QImage image = view.grabFramebuffer();
  save(image, "view-moved.png");
  int colored = 0;
  for (int y = 0; y < image.height(); y += 4) {
    for (int x = 0; x < image.width(); x += 4)
      colored += std::abs(image.pixelColor(x, y).red() - image.pixelColor(x, y).blue()) > 80;
  }
  EXPECT_GT(colored, 200);
  window.takeCentralWidget();
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();
  QSurfaceFormat::setDefaultFormat(SceneView::surfaceFormat());
  QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
