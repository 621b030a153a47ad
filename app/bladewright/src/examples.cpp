// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "examples.h"

#include <algorithm>

#include "bw/core/blade.h"
#include "bw/core/file_set.h"
#include "bw/geometry/export.h"

namespace bw::app {

namespace {

/// What an example needs besides the defaults.
struct Setting {
  const char* name;
  double bladeLength;  // mm
  int stations;
};

constexpr Setting kSettings[] = {
    {"panel-600x670", 900, 60},      {"graph", 900, 60},
    {"saddle", 900, 60},             {"sphere-cap", 900, 60},
    {"torus-patch", 900, 60},        {"wavy-wall", 3000, 120},
    {"ramp-corner-hollow", 2600, 60}, {"ramp-corner-domed", 2600, 60},
};

}  // namespace

Result<Design> exampleDesign(const std::string& name) {
  Design design;
  Result<std::string> step;
  if (const Result<std::filesystem::path> folder = resourceFolder())
    step = readFile(*folder / "examples" / (name + ".step"));
  if (!step) step = geometry::exampleStep(name);
  if (!step) return tl::unexpected<Error>(step.error());
  design.source.bytes = std::move(*step);
  design.source.path = name + ".step";
  for (const geometry::Example& example : geometry::exampleList())
    if (example.name == name) design.name = example.title;
  Result<Blade> blade = bladePreset(design.job.blade.name);
  if (!blade) return tl::unexpected<Error>(blade.error());
  design.job.blade = *blade;
  for (const Setting& setting : kSettings)
    if (name == setting.name) {
      design.job.blade.length = setting.bladeLength;
      design.job.stations = setting.stations;
    }
  return design;
}

}  // namespace bw::app
