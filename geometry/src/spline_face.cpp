// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "spline_face.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <cmath>
#include <string>

#include "occt.h"
#include "step_text.h"

namespace bw::geometry {

namespace {

constexpr double kTolerance = 1e-6;  ///< mm, of the face's border on its surface

Result<void> checkKnots(const char* which, int degree, const std::vector<double>& knots, int poles) {
  const std::string where = std::string("knots") + which;
  if (degree < 1 || poles < degree + 1 || int(knots.size()) != poles + degree + 1) {
    return fail(ErrorCode::badInput,
                std::string("the surface cannot be made: in ") + which + " it has degree " +
                    std::to_string(degree) + ", " + std::to_string(poles) + " poles and " +
                    std::to_string(knots.size()) +
                    " knots; there must be more poles than the degree, and poles + degree + 1 knots",
                where, double(knots.size()), double(poles + degree + 1));
  }
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i]) || (i > 0 && knots[i] < knots[i - 1])) {
      return fail(ErrorCode::badInput,
                  std::string("the surface cannot be made: knot ") + std::to_string(i) + " in " + which +
                      " is not a number in ascending order",
                  where, knots[i]);
    }
  }
  const bool clamped = knots[degree] == knots.front() && knots[poles] == knots.back();
  if (!clamped || !(knots.back() > knots.front())) {
    return fail(ErrorCode::badInput,
                std::string("the surface cannot be made: its knots in ") + which +
                    " are not clamped at both ends, or span nothing",
                where);
  }
  return {};
}

}  // namespace

Result<void> checkSplineSurface(const SplineSurface& surface) {
  if (auto ok = checkKnots("u", surface.degreeU, surface.knotsU, surface.polesU); !ok) return ok;
  if (auto ok = checkKnots("v", surface.degreeV, surface.knotsV, surface.polesV); !ok) return ok;
  const int nu = surface.polesU, nv = surface.polesV;
  if (surface.poles.size() != std::size_t(nu) * nv) {
    return fail(ErrorCode::badInput,
                "the surface cannot be made: it has " + std::to_string(surface.poles.size()) +
                    " poles instead of " + std::to_string(nu) + " × " + std::to_string(nv),
                "poles", double(surface.poles.size()), double(nu) * nv);
  }
  for (std::size_t i = 0; i < surface.poles.size(); ++i) {
    if (!surface.poles[i].allFinite()) {
      return fail(ErrorCode::badInput,
                  "the surface cannot be made: its pole " + std::to_string(i) + " is not finite", "poles");
    }
  }
  return {};
}

TopoDS_Face faceOf(const SplineSurface& surface) {
  TColgp_Array2OfPnt poles(1, surface.polesU, 1, surface.polesV);
  for (int j = 0; j < surface.polesV; ++j)
    for (int i = 0; i < surface.polesU; ++i)
      poles(i + 1, j + 1) = toPoint(surface.poles[std::size_t(j) * surface.polesU + i]);
  std::vector<double> u, v;
  std::vector<int> countsU, countsV;
  packKnots(surface.knotsU, u, countsU);
  packKnots(surface.knotsV, v, countsV);
  const int nu = int(u.size()), nv = int(v.size());
  const Handle(Geom_BSplineSurface) spline =
      new Geom_BSplineSurface(poles, TColStd_Array1OfReal(u[0], 1, nu), TColStd_Array1OfReal(v[0], 1, nv),
                              TColStd_Array1OfInteger(countsU[0], 1, nu),
                              TColStd_Array1OfInteger(countsV[0], 1, nv), surface.degreeU, surface.degreeV);
  return BRepBuilderAPI_MakeFace(spline, kTolerance).Face();
}

}  // namespace bw::geometry
