// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/geometry/export.h"

#include <algorithm>
#include <cmath>

#include "bw/core/file_set.h"
#include "step_text.h"

namespace bw::geometry {

namespace {

Result<void> checkKnots(const char* which, int degree, const std::vector<double>& knots, int poles) {
  const std::string where = std::string("knots") + which;
  if (degree < 1 || poles < degree + 1 || int(knots.size()) != poles + degree + 1) {
    return fail(ErrorCode::badInput,
                std::string("the surface cannot be written: in ") + which + " it has degree " +
                    std::to_string(degree) + ", " + std::to_string(poles) + " poles and " +
                    std::to_string(knots.size()) +
                    " knots; there must be more poles than the degree, and poles + degree + 1 knots",
                where, double(knots.size()), double(poles + degree + 1));
  }
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i]) || (i > 0 && knots[i] < knots[i - 1])) {
      return fail(ErrorCode::badInput,
                  std::string("the surface cannot be written: knot ") + std::to_string(i) + " in " + which +
                      " is not a number in ascending order",
                  where, knots[i]);
    }
  }
  const bool clamped = knots[degree] == knots.front() && knots[poles] == knots.back();
  if (!clamped || !(knots.back() > knots.front())) {
    return fail(ErrorCode::badInput,
                std::string("the surface cannot be written: its knots in ") + which +
                    " are not clamped at both ends, or span nothing",
                where);
  }
  return {};
}

}  // namespace

Result<std::string> stepText(const SplineSurface& surface, const std::string& name) {
  if (auto ok = checkKnots("u", surface.degreeU, surface.knotsU, surface.polesU); !ok)
    return tl::unexpected(ok.error());
  if (auto ok = checkKnots("v", surface.degreeV, surface.knotsV, surface.polesV); !ok)
    return tl::unexpected(ok.error());
  const int nu = surface.polesU, nv = surface.polesV;
  if (surface.poles.size() != std::size_t(nu) * nv) {
    return fail(ErrorCode::badInput,
                "the surface cannot be written: it has " + std::to_string(surface.poles.size()) +
                    " poles instead of " + std::to_string(nu) + " × " + std::to_string(nv),
                "poles", double(surface.poles.size()), double(nu) * nv);
  }
  for (std::size_t i = 0; i < surface.poles.size(); ++i) {
    if (!surface.poles[i].allFinite()) {
      return fail(ErrorCode::badInput,
                  "the surface cannot be written: its pole " + std::to_string(i) + " is not finite", "poles");
    }
  }
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

Result<void> writeStep(const SplineSurface& surface, const std::string& name,
                       const std::filesystem::path& file) {
  auto text = stepText(surface, name);
  if (!text) return tl::unexpected(text.error());
  return writeFile(file, *text);
}

}  // namespace bw::geometry
