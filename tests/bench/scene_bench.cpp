// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Hovering over the faces of a file: finding the one under the mouse and lighting it up, without and with the
// picture. And a wall of 3 × 5 blocks with a map that is turned, as the view draws it while it moves.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bw/scene/navigation.h"
#include "bw/scene/scene.h"
#include "wall_scene.h"

namespace {

using namespace bw;
using namespace bw::scene;

constexpr int kWidth = 1280, kHeight = 800;

/// The sample panel again and again, each a face of its own, on a square of them.
std::shared_ptr<const FaceMesh> manyFaces(int count) {
  const TriangleMesh panel = *test::sampleContent().first<TriangleMesh>();
  auto faces = std::make_shared<FaceMesh>();
  const int side = int(std::ceil(std::sqrt(double(count))));
  for (int k = 0; k < count; ++k) {
    const int base = int(faces->mesh.points.size());
    const Eigen::Vector3d by(700.0 * (k % side), 770.0 * (k / side), 0);
    // Every fourth point in both directions.
    constexpr int kRows = 26, kColumns = 23, kStride = 4, kAll = 91;
    for (int j = 0; j < kRows; ++j)
      for (int i = 0; i < kColumns; ++i)
        faces->mesh.points.push_back(
            by + panel.points[std::size_t(std::min(j * kStride, 100) * kAll + i * kStride)]);
    for (int j = 0; j + 1 < kRows; ++j) {
      for (int i = 0; i + 1 < kColumns; ++i) {
        const int a = base + j * kColumns + i;
        faces->mesh.triangles.push_back({a, a + 1, a + kColumns + 1});
        faces->mesh.triangles.push_back({a, a + kColumns + 1, a + kColumns});
        faces->faces.insert(faces->faces.end(), {k, k});
      }
    }
  }
  return faces;
}

Scene choosing(int count) {
  Scene scene;
  Content content = test::sampleContent();
  content.add({}, Faces{manyFaces(count)});
  scene.setContent(std::move(content));
  Style style;
  style.chooseFaces = true;
  style.chosenFaces = {0};
  scene.setStyle(style);
  scene.setCamera(scene.fitCamera(View::iso, {kWidth, kHeight}));
  scene.pick(0, 0, kWidth, kHeight);
  return scene;
}

/// The next place of a mouse that crosses the picture, and what lights up there.
void hover(Scene& scene, int step) {
  const int x = kWidth / 4 + (step * 37) % (kWidth / 2), y = kHeight / 4 + (step * 23) % (kHeight / 2);
  Style style = scene.style();
  style.hoveredFace = scene.pick(x, y, kWidth, kHeight).face;
  scene.setStyle(style);
}

void hoverFaces(benchmark::State& state) {
  Scene scene = choosing(int(state.range(0)));
  int step = 0;
  for (auto _ : state) hover(scene, ++step);
}
BENCHMARK(hoverFaces)->Arg(200)->Arg(2000)->Unit(benchmark::kMillisecond);

void hoverFacesWithPicture(benchmark::State& state) {
  Scene scene = choosing(int(state.range(0)));
  if (!scene.render(kWidth, kHeight)) return state.SkipWithError("no GL");
  int step = 0;
  for (auto _ : state) {
    hover(scene, ++step);
    benchmark::DoNotOptimize(scene.render(kWidth, kHeight));
  }
}
BENCHMARK(hoverFacesWithPicture)->Arg(200)->Unit(benchmark::kMillisecond);

/// The wall after a sketch (a row of 51 points a station), or as evaluated (257 rows of 101 points a block).
test::WallScene wallOf(bool evaluated) {
  test::WallScene wall;
  if (evaluated) wall.panel = {33, 7, 101, 0.5};
  return wall;
}

constexpr int kWallWidth = 1000, kWallHeight = 660;
constexpr double kTurn = 0.02;  // rad, from picture to picture

/// A scene of it with the map of deviation, drawn once as the view draws what moves.
bool show(Scene& scene, const test::WallScene& wall, bool isolines) {
  scene.setContent(test::wallContent(wall));
  Style style;
  style[Kind::cut].map = "deviation";
  style.isolines = isolines;
  scene.setStyle(style);
  scene.setCamera(scene.fitCamera(View::iso, {kWallWidth, kWallHeight}));
  if (!scene.render(kWallWidth, kWallHeight)) return false;
  scene.setDraft(true);
  return scene.render(kWallWidth, kWallHeight).has_value();
}

/// Budget: 15 pictures a second on software GL. Each is read back, too.
void orbitWall(benchmark::State& state) {
  Scene scene;
  if (!show(scene, wallOf(state.range(0) != 0), state.range(1) != 0)) return state.SkipWithError("no GL");
  for (auto _ : state) {
    scene.setCamera(orbit(scene.camera(), scene.camera().focus, kTurn, 0));
    benchmark::DoNotOptimize(scene.render(kWallWidth, kWallHeight));
  }
}
BENCHMARK(orbitWall)
    ->ArgNames({"evaluated", "isolines"})
    ->ArgsProduct({{0, 1}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// A sketch of it has so many blocks that are others; then the picture of it. `content_ms`: until it is
/// drawn.
void pictureOfWallSketch(benchmark::State& state) {
  Scene scene;
  const test::WallScene wall = wallOf(false);
  if (!show(scene, wall, false)) return state.SkipWithError("no GL");
  const int made = int(state.range(0));
  const bool whole = state.range(1) != 0;
  std::vector<Content> others;
  for (const double up : {0.0, 5.0}) {
    Content& content = others.emplace_back(whole ? test::wallContent(wall) : Content{});
    for (int block = 0; block < made; ++block)
      for (Item& item : test::wallPanel(wall, block % wall.columns, block / wall.columns, up).items) {
        const auto there = std::ranges::find_if(content.items, [&](const Item& other) {
          return other.kind() == item.kind() && other.id == item.id;
        });
        if (there != content.items.end())
          there->data = std::move(item.data);
        else
          content.items.push_back(std::move(item));
      }
  }
  std::size_t k = 0;
  double content = 0;
  for (auto _ : state) {
    k = 1 - k;
    const auto start = std::chrono::steady_clock::now();
    if (whole)
      scene.setContent(others[k]);
    else
      scene.replace(others[k]);
    content += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    benchmark::DoNotOptimize(scene.render(kWallWidth, kWallHeight));
  }
  state.counters["content_ms"] = 1e3 * content / double(state.iterations());
}
BENCHMARK(pictureOfWallSketch)
    ->ArgNames({"made", "whole"})
    ->Args({15, 1})
    ->Args({15, 0})
    ->Args({6, 0})
    ->Args({1, 0})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
