// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What stands over the scene or steps in for it: the cube, faces to choose, the place of a finding.
#include "scene/camera/picking.h"
#include "scene_fixture.h"

namespace bw::scene {
namespace {

TEST_F(SceneTest, CubeTellsItsFaces) {
  const auto at = [&](double x, double y) { return scene.cubeDirection(x, y, kWidth, kHeight); };
  for (const View view : {View::top, View::front, View::left, View::right, View::back, View::bottom}) {
    draw(Style{}, "cube", view);
    const PixelRect cube = *scene.overlay().marker;
    EXPECT_EQ(at(cube.x + cube.width / 2, cube.y + cube.height / 2), directionOf(view));
    EXPECT_FALSE(at(kWidth / 2, kHeight / 2));
  }
  draw(Style{}, "cube", View::iso);
  const PixelRect cube = *scene.overlay().marker;
  const double x = cube.x + cube.width / 2, y = cube.y + cube.height / 2;
  EXPECT_EQ(at(x, y), Eigen::Vector3d(1, -1, 1));
  EXPECT_EQ(at(x, y - 22), directionOf(View::top));
  EXPECT_EQ(at(x - 19, y + 11), directionOf(View::front));
  EXPECT_EQ(at(x + 19, y + 11), directionOf(View::right));
}

TEST_F(SceneTest, SmallPicturesKeepTheirSurfaceBesideTheLegend) {
  for (const PictureSize size : {PictureSize{300, 240}, {400, 300}, {640, 440}, {1600, 900}}) {
    for (const View view : {View::iso, View::top}) {
      // The first picture of a scene, too, which nothing was drawn before.
      Scene fresh;
      fresh.setContent(test::sampleContent());
      fresh.setStyle(mapped("deviation"));
      fresh.setCamera(fresh.fitFrom(directionOf(view), view != View::iso, size));
      ASSERT_TRUE(fresh.render(size.width, size.height));
      const Camera eye = fresh.camera();
      const Projection seen(eye.position, eye.focus, eye.up, eye.viewAngle, eye.parallel, eye.parallelScale,
                            size.width, size.height);
      for (const auto& point : fresh.content().first<CutSurface>()->grid.points) {
        const Eigen::Vector3d pixel = seen.toPixel(point);
        ASSERT_GT(pixel.x(), 0) << size.width;
        ASSERT_LT(pixel.x(), fresh.overlay().legend->x) << size.width;
        ASSERT_GT(pixel.y(), 0) << size.width;
        ASSERT_LT(pixel.y(), size.height) << size.width;
      }
    }
  }
}

TEST_F(SceneTest, CubeOffersTwentySixViews) {
  std::set<std::array<int, 3>> met;
  for (const View view :
       {View::iso, View::top, View::front, View::left, View::right, View::back, View::bottom}) {
    for (const double turn : {0.0, 0.4, 1.9, 3.5, 5.0}) {
      scene.setCamera(orbit(scene.fitCamera(view, {kWidth, kHeight}), {0, 0, 0}, turn, 0));
      shot("cube-views");
      const PixelRect cube = *scene.overlay().marker;
      for (double y = cube.y; y < cube.y + cube.height; y += 2)
        for (double x = cube.x; x < cube.x + cube.width; x += 2)
          if (const auto d = scene.cubeDirection(x, y, kWidth, kHeight))
            met.insert({int((*d)[0]), int((*d)[1]), int((*d)[2])});
    }
  }
  EXPECT_EQ(met.size(), 26u);
  EXPECT_FALSE(met.contains({0, 0, 0}));
  // Each of them gives a level camera that looks from there.
  for (const auto& [x, y, z] : met) {
    const Eigen::Vector3d back = Eigen::Vector3d(x, y, z).normalized();
    const Camera camera = scene.fitFrom(back, true, {900, 600});
    EXPECT_TRUE(camera.parallel);
    EXPECT_LT(((camera.position - camera.focus).normalized() - back).norm(), 1e-9);
    EXPECT_NEAR(camera.up.dot(back), 0, 1e-9);
    if (x != 0 || y != 0) {
      EXPECT_GT(camera.up.z(), 0);
    }
  }
}

/// A row of square plates, 100 mm wide, the last of which stands upright.
std::shared_ptr<const FaceMesh> plates(int count) {
  auto faces = std::make_shared<FaceMesh>();
  for (int k = 0; k < count; ++k) {
    const int base = int(faces->mesh.points.size());
    for (const auto& [u, v] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)})
      faces->mesh.points.emplace_back(110.0 * k + 100 * u, k + 1 == count ? 0 : 100.0 * v,
                                      k + 1 == count ? 100.0 * v : 0);
    faces->mesh.triangles.push_back({base, base + 1, base + 2});
    faces->mesh.triangles.push_back({base, base + 2, base + 3});
    faces->faces.insert(faces->faces.end(), {k, k});
  }
  return faces;
}

TEST_F(SceneTest, ChoosingShowsTheFacesPaleTheChosenOnesSolidAndTheHoveredOneLit) {
  Content content = test::sampleContent();
  content.add({}, Faces{plates(4)});
  scene.setContent(content);
  Style style = mapped("deviation");
  style.showGrid = false;
  style.chooseFaces = true;
  style.chosenFaces = {1};
  style.hoveredFace = 2;
  const Picture picture = draw(style, "choose-faces", View::iso);
  EXPECT_FALSE(scene.overlay().legend) << "the result steps aside";
  std::array<std::vector<Color>, 4> seen;
  everywhere(picture, [&](const Pick& pick, const Color& c, int, int) {
    if (pick.kind != Pick::Kind::face) {
      EXPECT_EQ(pick.kind, Pick::Kind::none);
      return;
    }
    ASSERT_GE(pick.face, 0);
    ASSERT_LT(pick.face, 4);
    EXPECT_GE(pick.point.x(), 110 * pick.face - 0.1);
    EXPECT_LE(pick.point.x(), 110 * pick.face + 100.1);
    seen[std::size_t(pick.face)].push_back(c);
  });
  for (const auto& colors : seen) ASSERT_GT(colors.size(), 20u);
  const auto mean = [](const std::vector<Color>& colors) -> Eigen::Vector3d {
    double r = 0, g = 0, b = 0;
    for (const Color& c : colors) r += c.r, g += c.g, b += c.b;
    return Eigen::Vector3d(r, g, b) / double(colors.size());
  };
  const Eigen::Vector3d pale = mean(seen[0]), chosen = mean(seen[1]), lit = mean(seen[2]);
  EXPECT_GT(pale.minCoeff(), 170);
  EXPECT_GT(chosen.z() - chosen.x(), pale.z() - pale.x() + 30) << "solid and blue";
  EXPECT_GT(lit.x() - lit.z(), 20) << "lit up warm";
  // Out of choosing they are a faint surrounding that no pick finds.
  style.chooseFaces = false;
  const Picture around = draw(style, "faces-around", View::iso);
  everywhere(around,
             [&](const Pick& pick, const Color&, int, int) { EXPECT_NE(pick.kind, Pick::Kind::face); });
  style[Kind::face].visible = false;
  EXPECT_NE(draw(style, "faces-hidden", View::iso).rgb, around.rgb);
}

TEST_F(SceneTest, ChoosingEndsAsItBeganWhateverContentCame) {
  Content content = test::sampleContent();
  content.add({}, Faces{plates(4)});
  const Style style = mapped("deviation");
  scene.setContent(content);
  draw(style, "chosen-before");  // the fit keeps clear of the legend of a picture of that width
  const Picture before = draw(style, "chosen-before");
  Style choosing = style;
  choosing.chooseFaces = true;
  scene.setStyle(choosing);
  scene.setContent(content);
  EXPECT_TRUE(scene.bounds().size().x() < 440);
  const Picture after = draw(style, "chosen-after");
  EXPECT_EQ(before.rgb, after.rgb);
  // Without faces there is nothing to choose: the result stays.
  content.remove(Kind::face);
  scene.setContent(content);
  draw(choosing, "no-faces");
  EXPECT_TRUE(scene.overlay().legend);
  auto broken = std::make_shared<FaceMesh>(*plates(3));
  broken->mesh.triangles[2] = {0, 1, 4000};
  content.add({}, Faces{broken});
  scene.setContent(content);
  draw(choosing, "broken-faces");
  EXPECT_TRUE(scene.overlay().legend);
}

TEST_F(SceneTest, FindingHasItsRingAtThePointAndItsWordsBesideIt) {
  for (const auto& [width, height, ratio, dark] :
       {std::tuple(1000, 640, 1.0, false), std::tuple(520, 360, 1.0, true),
        std::tuple(1600, 1000, 2.0, true)}) {
    Style style = mapped("deviation");
    style.pixelRatio = ratio;
    style.dark = dark;
    style.marker = Marker{scene.content().first<Stations>()->lines[12][40],
                          "Station 13: the cut surface lies 3.94 mm above the target, 2 mm is the tolerance; "
                          "more stations or a longer blade bring it nearer",
                          Severity::error};
    const Picture picture =
        draw(style, ("marker-" + std::to_string(width)).c_str(), View::iso, width, height);
    const Overlay& overlay = scene.overlay();
    ASSERT_TRUE(overlay.place && overlay.label) << width;
    const double x = overlay.place->x + 0.5 * overlay.place->width,
                 y = overlay.place->y + 0.5 * overlay.place->height;
    const Pick pick = scene.pick(x, y, width, height);
    EXPECT_LT((pick.point - style.marker->point).norm(), 6);
    const Color ring = at(picture, int(x + 7.5 * ratio), int(y));
    EXPECT_GT(ring.r, ring.b + 60);
    // The words are whole, inside the picture, and clear of legend and cube.
    const PixelRect& card = *overlay.label;
    EXPECT_GE(card.x, 0);
    EXPECT_GE(card.y, 0);
    EXPECT_LE(card.x + card.width, width);
    EXPECT_LE(card.y + card.height, height);
    std::string words;
    for (const Overlay::Text& text : overlay.texts)
      if (card.contains(text.box.x, text.box.y)) words += (words.empty() ? "" : " ") + text.text;
    EXPECT_EQ(words, style.marker->text);
    if (width >= 1000 && overlay.legend) {
      EXPECT_FALSE(overlay.legend->contains(card.x + card.width, card.y));
    }
  }
  Style style = mapped("deviation");
  style.marker = Marker{Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()), "nowhere", {}};
  draw(style, "marker-nowhere");
  EXPECT_FALSE(scene.overlay().place);
  style.marker = Marker{{1e6, 0, 0}, "far away", {}};
  draw(style, "marker-outside");
  EXPECT_FALSE(scene.overlay().place);
}

}  // namespace
}  // namespace bw::scene
