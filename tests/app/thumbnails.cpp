// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
// Draws the pictures of the start page: thumbnails FOLDER writes <example>.png and <example>-dark.png. Run by
// hand when an example or the look of the scene changes; the pictures are kept in resources/icons/examples.
#include <cstdio>
#include <filesystem>

#include "bw/core/files/file_set.h"
#include "bw/geometry/export.h"
#include "bw/pipeline/example_design.h"
#include "bw/pipeline/pipeline.h"
#include "bw/pipeline/scene_content.h"

namespace {

constexpr int kWidth = 416, kHeight = 264;

int fail(const bw::Error& error) {
  std::fprintf(stderr, "thumbnails: %s\n", error.message.c_str());
  return 1;
}

/// The isometric view of the work, but the ramps stand with their hollow side away from it, and of the wavy
/// wall all is seen, which its block is a small part of.
bw::scene::Camera cameraFor(const std::string& example, const bw::scene::Scene& scene) {
  const bw::scene::PictureSize size{kWidth, kHeight};
  bw::scene::Camera camera = scene.fitCamera(bw::scene::View::iso, size);
  if (example == "wavy-wall") return scene.fitCamera(camera, size);
  if (example.rfind("ramp", 0) != 0) return camera;
  camera.position =
      camera.focus + (camera.position - camera.focus).norm() * Eigen::Vector3d(-1, -1, 0.9).normalized();
  return scene.fitCamera(camera, size);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: thumbnails FOLDER\n");
    return 2;
  }
  std::vector<bw::geometry::Example> examples = bw::geometry::exampleList();
  for (const bw::geometry::Example& example : bw::pipeline::designedExamples()) examples.push_back(example);
  for (const bw::geometry::Example& example : examples) {
    const bw::Result<bw::Design> design = bw::pipeline::exampleDesign(example.name);
    if (!design) return fail(design.error());
    const bw::pipeline::Outcome outcome = bw::pipeline::evaluate(*design, nullptr, {});
    if (outcome.error) return fail(*outcome.error);
    bw::scene::Content content = bw::pipeline::sceneContent(outcome.evaluation);
    const double middle = 0.55 * double(content.first<bw::scene::Stations>()->lines.size() - 1);
    for (bool dark : {false, true}) {
      bw::scene::Scene scene;
      bw::scene::Style style;
      style.dark = dark;
      style.legend = false;
      style.showGrid = false;
      style[bw::scene::Kind::station].visible = false;
      style[bw::scene::Kind::target].visible = example.name == "wavy-wall";  // its block lies within it
      style.playhead = middle;
      style.pixelRatio = 2;
      scene.setContent(content);
      scene.setStyle(style);
      scene.setCamera(cameraFor(example.name, scene));
      const bw::Result<bw::scene::Picture> picture = scene.render(kWidth, kHeight);
      if (!picture) return fail(picture.error());
      const bw::Result<std::string> png = bw::scene::pngBytes(*picture);
      if (!png) return fail(png.error());
      const std::filesystem::path file =
          std::filesystem::path(argv[1]) / (example.name + (dark ? "-dark.png" : ".png"));
      if (const bw::Result<void> written = bw::writeFile(file, *png); !written) return fail(written.error());
    }
  }
  return 0;
}
