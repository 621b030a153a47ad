// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "spline_check.h"

#include <cmath>
#include <string>

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

void packKnots(const std::vector<double>& flat, std::vector<double>& knots, std::vector<int>& counts) {
  for (const double k : flat) {
    if (!knots.empty() && knots.back() == k) {
      ++counts.back();
    } else {
      knots.push_back(k);
      counts.push_back(1);
    }
  }
}

Result<void> checkSplineSurface(const SplineSurface& surface) {
  if (auto ok = checkKnots("u", surface.degreeU, surface.knotsU, surface.polesU); !ok) return ok;
  if (auto ok = checkKnots("v", surface.degreeV, surface.knotsV, surface.polesV); !ok) return ok;
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
  return {};
}

}  // namespace bw::geometry
