// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <future>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/pipeline/handover.h"
#include "bw/scene/scene.h"

namespace bw::pipeline {

/// Pictures of a report, each encoded while the next one is drawn, unless all is to be done on one thread.
/// Those of one direction show what they show at one place, so that they can be compared.
class PictureList {
 public:
  PictureList(scene::Scene& scene, const RunContext& context) : scene_(scene), context_(context) {}

  /// What the scene shows from there, all of it, as a picture named `name`. Errors: those of
  /// `scene::Scene::render`; `cancelled`.
  Result<void> add(scene::View view, bool parallel, const char* name, const char* title);
  /// All that were added, in their order. Errors: those of `scene::pngBytes`; `cancelled`.
  Result<std::vector<ReportPicture>> take();

 private:
  struct Drawn {
    const char* name;
    const char* title;
    std::future<Result<std::string>> png;
  };

  /// A direction, whether the picture is a parallel projection, and has a legend, which takes its room.
  using Sight = std::tuple<scene::View, bool, bool>;

  scene::Scene& scene_;
  const RunContext& context_;
  std::vector<Drawn> drawn_;
  std::map<Sight, scene::Camera> cameras_;
};

}  // namespace bw::pipeline
