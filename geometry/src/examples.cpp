// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/blade/blade.h"
#include "bw/core/files/file_set.h"
#include "bw/core/text/number_text.h"
#include "bw/geometry/export.h"

namespace bw::geometry {

const std::vector<Example>& exampleList() {
  static const std::vector<Example> list = {
      {"panel-600x670", "Test panel 600 × 670 mm",
       "x = 600 u, y = 670 v, a = 2π (x − 300)/1000, b = 2π (y − 335)/640, "
       "z = 100 + 46 sin b + 12 sin 2b + 22 cos(0.4 b) (cos a + 0.06 cos 3a) + 22 sin a sin b; mm. "
       "Gaussian curvature of both signs; sections across y have at most two inflections."},
      {"graph", "Graph of a function",
       "p ∈ [−π/2, π/2], q ∈ [−0.75, 0.75]: x = 200 (p + π/2), y = 600 (q + 0.75), z = 45 cos⁴(2 (π/2 − q)) "
       "sin p exp(−0.1 p²); mm. "
       "The exponent 4 is read as that of the cosine, which then vanishes at q = ±π/4, just outside the "
       "domain."},
      {"saddle", "Saddle",
       "x ∈ [−300, 300], y ∈ [−400, 400], z = x²/1600 − y²/1200; mm. A hyperbolic paraboloid, exact."},
      {"sphere-cap", "Cap of a sphere",
       "x, y ∈ [−300, 300], z = √(900² − x² − y²) − √(900² − 2·300²); mm. A sphere of radius 900 over a "
       "square, exact."},
      {"torus-patch", "Patch of a torus",
       "x ∈ [−300, 300], y ∈ [700, 1300], z = √(450² − (√(x² + y²) − 1000)²); mm. A torus of radii 1000 and "
       "450 over a square, "
       "exact: Gaussian curvature is negative on the near half and positive on the far half."},
      {"wavy-wall", "Wavy wall 4200 × 2400 mm",
       "x = 4200 u, y = 2400 v, f = 2π y/1200 + 0.9 sin(2π x/4200), "
       "z = (110 + 50 cos(2π x/2800)) sin f + 60 cos(π x/4200); mm. Valleys and ridges wander along x."},
      {"ramp-corner-hollow", "Corner of a skater ramp, negative curvature",
       "x = r(v) X(u), y = 1400 v, z = 854.10 Z(u), (X, Z) the Bézier cubic (0,0) (0.5523,0) (1,0.4477) "
       "(1,1), "
       "r(v) = 855.11 + 146.27 (2v − 1)²; mm, exact. Profiles are 1342.6 mm long in the middle and 1459.8 "
       "mm at the ends."},
      {"ramp-corner-domed", "Corner of a skater ramp, positive curvature",
       "x = r(v) X(u), y = 1400 v, z = 854.10 Z(u), (X, Z) the Bézier cubic (0,0) (0.5523,0) (1,0.4477) "
       "(1,1), "
       "r(v) = 1001.38 − 146.27 (2v − 1)²; mm, exact. Profiles are 1459.8 mm long in the middle and 1342.6 "
       "mm at the ends."},
  };
  return list;
}

Result<std::string> exampleStep(const std::string& name) {
  std::vector<std::string> names;
  std::string all;
  for (const Example& example : exampleList()) {
    if (example.name == name) {
      const Result<std::filesystem::path> folder = resourceFolder();
      if (!folder) return tl::unexpected(folder.error());
      return readFile(*folder / "examples" / (name + ".step"));
    }
    all += (names.empty() ? "" : ", ") + example.name;
    names.push_back(example.name);
  }
  const std::string near = nearestWord(name, names.data(), int(names.size()));
  return fail(
      ErrorCode::badInput,
      "there is no example \"" + name + "\"" +
          (near.empty() ? "; the examples are " : "; did you mean \"" + near + "\"? The examples are ") + all,
      "example");
}

}  // namespace bw::geometry
