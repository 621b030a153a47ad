// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/example_design.h"

#include <algorithm>
#include <iterator>

#include "bw/core/blade/blade.h"
#include "bw/core/text/number_text.h"
#include "bw/geometry/export.h"

namespace bw::pipeline {

namespace {

/// What an example needs besides the defaults.
struct Setting {
  const char* name;
  const char* blade;   ///< preset
  double bladeLength;  ///< mm
};

/// The ramps' profiles are up to 1460 mm long; the other examples are 600 mm wide. On the panel a round blade
/// of 720 mm would leave its plane, and a flat one of 800 mm snaps through in its own weight; on the torus a
/// round one of any length leaves its plane. On the graph one of 800 mm sags by more than the tolerance.
constexpr Setting kSettings[] = {
    {"panel-600x670", "steel-tube-3-2.5", 710},
    {"graph", "steel-tube-3-2.5", 745},
    {"torus-patch", "nicr-flat-5x1", 820},
    {"wavy-wall", "steel-tube-3-2.5", 900},
    {"ramp-corner-hollow", "steel-tube-3-2.5", 1700},
    {"ramp-corner-domed", "steel-tube-3-2.5", 1700},
};

/// A crest of the wall that runs along the travel: 600 mm wide, 900 mm long.
BlockPlacement blockInWall() { return {{1800, 600, -200}, {600, 900, 400}, Eigen::Vector3d::Zero()}; }

const geometry::Example* find(const std::vector<geometry::Example>& list, const std::string& name) {
  const auto found = std::ranges::find(list, name, &geometry::Example::name);
  return found == list.end() ? nullptr : &*found;
}

Result<void> known(const std::string& name) {
  if (find(designedExamples(), name) || find(geometry::exampleList(), name)) return {};
  std::vector<std::string> names;
  std::string all;
  for (const auto* list : {&designedExamples(), &geometry::exampleList()})
    for (const geometry::Example& example : *list) {
      all += (names.empty() ? "" : ", ") + example.name;
      names.push_back(example.name);
    }
  const std::string nearest = nearestWord(name, names.data(), int(names.size()));
  return fail(ErrorCode::badInput,
              "there is no example \"" + name + "\"" +
                  (nearest.empty() ? "; the examples are "
                                   : "; did you mean \"" + nearest + "\"? The examples are ") +
                  all,
              "example");
}

}  // namespace

const std::vector<geometry::Example>& designedExamples() {
  static const std::vector<geometry::Example> list = {
      {kSingleBlock, "Single block, poles 4 × 6",
       "A tensor-product spline over a block of 600 × 800 × 500 mm, four poles across and six along the "
       "travel."},
      {kBlockWall, "Wall of three blocks",
       "A loft through three cubic splines over three blocks of 600 × 800 × 500 mm side by side, one cubic a "
       "block across."},
      {"ripple-along", "Ripple along the travel",
       "z = height − rise ((x − 300)/300)² + amplitude sin(2π waves y/800) (1 − 0.3 ((x − 300)/300)²); mm. "
       "Variables: "
       "amplitude, waves, rise, height."},
      {"ripple-across", "Ripple across the travel",
       "z = height + rise sin(π y/800) + amplitude cos(2π (x − 300)/600) (1 − fade y/800); mm. The blade "
       "bends "
       "into one wave, which fades along the travel. Variables: amplitude, rise, fade, height."},
      {"ruled-between-curves", "Ruled between two curves",
       "A loft through two curves, an arc and one that leans: straight lines along the travel join them. "
       "Variables: rise, bow, lean, fall, height."},
      {"twist", "Twist",
       "A loft through three arcs that lean one way, not at all, and the other. Variables: lean, rise, "
       "height."},
      {"bump", "Bump", "Poles 4 × 6 over a block, the four in the middle raised. Variables: bump, height."},
      {"key-blade-fan", "Key-blade fan",
       "Four key blades across the travel that lean one way and then the other and arch ever less; every "
       "blade between them is an elastica. Variables: arch, lean, height."},
      {"turning-blades", "Turning blades",
       "Five key blades, two of whose planes are turned: as the blade travels it turns to the one side and "
       "to the other about upright lines. Variables: arch, lean, turn, height."},
      {"two-crossing-cuts", "Two crossing cuts and their crease",
       "east: z = base + slope x + bow sin(π x/600) + ripple sin(2π y/600); north: z = base + slope y + bow "
       "sin(π y/600) + ripple cos(2π x/600); mm. The block is turned by a quarter between the cuts; the part "
       "below both has a crease where they meet. Variables: base, slope, bow, ripple."},
      {"three-block-wall", "Three-block wall",
       "A loft through cubic splines whose knots lie on the boundaries of three blocks side by side: one "
       "cubic a block, with one tangent and one curvature where they meet. Variables: width, wave, sweep, "
       "height."},
  };
  return list;
}

Result<std::string> exampleSurface(const std::string& name) {
  if (Result<void> ok = known(name); !ok) return tl::unexpected<Error>(ok.error());
  if (!find(designedExamples(), name)) return geometry::exampleStep(name);
  const Result<Design> design = exampleDesign(name);
  if (!design) return tl::unexpected<Error>(design.error());
  std::vector<SplineSurface> splines;
  for (const Source& source : design->sources) {
    Result<SplineSurface> spline = splineOf(*source.surface);
    if (!spline) return tl::unexpected<Error>(spline.error());
    splines.push_back(std::move(*spline));
  }
  if (splines.size() == 1) return geometry::stepText(splines.front(), name);
  std::vector<geometry::NamedSurface> surfaces;
  for (std::size_t i = 0; i < splines.size(); ++i) surfaces.push_back({design->sources[i].id, &splines[i]});
  return geometry::stepText(surfaces, name);
}

Result<Design> exampleDesign(const std::string& name) {
  if (Result<void> ok = known(name); !ok) return tl::unexpected<Error>(ok.error());
  if (find(designedExamples(), name)) {
    const Result<std::filesystem::path> folder = resourceFolder();
    if (!folder) return tl::unexpected<Error>(folder.error());
    return loadDesign(*folder / "examples" / (name + ".bladewright"));
  }
  Design design;
  Result<std::string> step = geometry::exampleStep(name);
  if (!step) return tl::unexpected<Error>(step.error());
  design.source().bytes = std::move(*step);
  design.source().path = name + ".step";
  design.name = find(geometry::exampleList(), name)->title;
  const Setting* setting = std::ranges::find_if(kSettings, [&](const Setting& s) { return name == s.name; });
  const bool found = setting != std::end(kSettings);
  Result<Blade> blade = bladePreset(found ? setting->blade : design.blade.name);
  if (!blade) return tl::unexpected<Error>(blade.error());
  design.blade = *blade;
  if (found) design.blade.length = setting->bladeLength;
  if (name == "wavy-wall") {
    design.block().placement = blockInWall();
    design.cut().direction = Eigen::Vector3d::UnitY();
  }
  // The blade goes along its x: the block stands turned between the robots.
  if (name == "torus-patch") design.output.cell = "irb1600-pair-turned";
  if (name == "ramp-corner-hollow") design.output.cell = "irb1600-pair-wide";
  // One end of its blade is a metre above the other: such robots reach both only if the block is laid flat.
  if (name == "ramp-corner-domed") design.output.programs = {"csv", "json"};
  return design;
}

}  // namespace bw::pipeline
