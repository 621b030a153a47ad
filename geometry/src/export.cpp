// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/geometry/export.h"

#include "spline_check.h"
#include "step_text.h"

namespace bw::geometry {

Result<std::string> stepText(const SplineSurface& surface, const std::string& name) {
  if (auto ok = checkSplineSurface(surface); !ok) return tl::unexpected(ok.error());
  const int nu = surface.polesU, nv = surface.polesV;
  const auto pole = [&](int i, int j) -> const Eigen::Vector3d& {
    return surface.poles[std::size_t(j) * nu + i];
  };
  StepText text;
  const int id = text.splineSurface(surface);
  const int v00 = text.vertex(pole(0, 0)), v10 = text.vertex(pole(nu - 1, 0));
  const int v11 = text.vertex(pole(nu - 1, nv - 1)), v01 = text.vertex(pole(0, nv - 1));
  std::vector<Eigen::Vector3d> south, north, west, east;
  for (int i = 0; i < nu; ++i) {
    south.push_back(pole(i, 0));
    north.push_back(pole(i, nv - 1));
  }
  for (int j = 0; j < nv; ++j) {
    west.push_back(pole(0, j));
    east.push_back(pole(nu - 1, j));
  }
  const int s = text.edge(v00, v10, text.splineCurve(surface.degreeU, surface.knotsU, south));
  const int e = text.edge(v10, v11, text.splineCurve(surface.degreeV, surface.knotsV, east));
  const int n = text.edge(v01, v11, text.splineCurve(surface.degreeU, surface.knotsU, north));
  const int w = text.edge(v00, v01, text.splineCurve(surface.degreeV, surface.knotsV, west));
  return text.file(id, {{s, true}, {e, true}, {n, false}, {w, false}}, name);
}

}  // namespace bw::geometry
