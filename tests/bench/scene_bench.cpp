// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Hovering over the faces of a file: finding the one under the mouse and lighting it up, without and with the
// picture.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "bw/scene/scene.h"
#include "scene_sample.h"

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
  scene.setCamera(scene.fitCamera(View::iso, double(kWidth) / kHeight));
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

}  // namespace
