// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/geometry/export.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BSplSLib.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS_Face.hxx>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <string>

#include "bw/core/text/number_text.h"
#include "occt.h"
#include "step_text.h"

namespace bw::geometry {

namespace {

/// Clamped knots for interpolation at `t`: the parameters themselves without the second and the last but one
/// (not-a-knot) for a cubic, averages for lower degrees.
std::vector<double> interpolationKnots(const std::vector<double>& t, int degree) {
  std::vector<double> knots(std::size_t(degree + 1), t.front());
  for (auto at = t.begin() + 1; at + degree < t.end(); ++at)
    knots.push_back(degree == 3 ? at[1] : std::accumulate(at, at + degree, 0.0) / degree);
  knots.insert(knots.end(), std::size_t(degree + 1), t.back());
  return knots;
}

TColStd_Array1OfReal arrayOf(const std::vector<double>& values) {
  return {values.front(), 1, int(values.size())};
}

}  // namespace

Result<SplineSurface> loft(const SurfaceGrid& grid, const std::vector<double>& rowParameters) {
  if (grid.rows < 2 || grid.columns < 2 || int(rowParameters.size()) != grid.rows ||
      grid.points.size() != std::size_t(grid.rows) * grid.columns)
    return fail(ErrorCode::badInput, "a skin needs at least two stations with at least two points each",
                "skin", double(grid.rows), 2.0);
  for (int r = 1; r < grid.rows; ++r)
    if (!(rowParameters[std::size_t(r)] > rowParameters[std::size_t(r - 1)]))
      return fail(ErrorCode::badInput,
                  "stations " + std::to_string(r) + " and " + std::to_string(r + 1) +
                      " coincide, so no surface can be laid through them; use fewer stations",
                  stationName(r));
  SplineSurface surface;
  surface.polesU = grid.columns;
  surface.polesV = grid.rows;
  surface.degreeU = std::min(3, grid.columns - 1);
  surface.degreeV = std::min(3, grid.rows - 1);
  std::vector<double> u(std::size_t(grid.columns));
  for (int c = 0; c < grid.columns; ++c) u[std::size_t(c)] = double(c) / (grid.columns - 1);
  surface.knotsU = interpolationKnots(u, surface.degreeU);
  surface.knotsV = interpolationKnots(rowParameters, surface.degreeV);
  return guarded(
      ErrorCode::noSolution, "the skin through the stations could not be computed",
      [&]() -> Result<SplineSurface> {
        TColgp_Array2OfPnt points(1, grid.columns, 1, grid.rows);
        for (int r = 0; r < grid.rows; ++r)
          for (int c = 0; c < grid.columns; ++c) points(c + 1, r + 1) = toPoint(grid.at(r, c));
        int pivot = 0;
        BSplSLib::Interpolate(surface.degreeU, surface.degreeV, arrayOf(surface.knotsU),
                              arrayOf(surface.knotsV), arrayOf(u), arrayOf(rowParameters), points, pivot);
        if (pivot != 0)
          return fail(ErrorCode::noSolution, "the skin through the stations could not be computed", "skin");
        surface.poles.reserve(grid.points.size());
        for (int r = 0; r < grid.rows; ++r)
          for (int c = 0; c < grid.columns; ++c) surface.poles.push_back(toEigen(points(c + 1, r + 1)));
        return std::move(surface);
      });
}

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

/// Whether a file can hold the surface: counts that fit together, knots in order and clamped, finite poles.
/// The error says what does not fit.
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

}  // namespace

Result<std::string> stepText(const SplineSurface& surface, const std::string& name) {
  if (auto ok = checkSplineSurface(surface); !ok) return tl::unexpected(ok.error());
  const int nu = surface.polesU, nv = surface.polesV;
  StepText text;
  const int id = text.splineSurface(surface);
  const int last = nu * nv - 1;
  const int v00 = text.vertex(surface.poles[0]), v10 = text.vertex(surface.poles[nu - 1]);
  const int v11 = text.vertex(surface.poles[last]), v01 = text.vertex(surface.poles[last - nu + 1]);
  const auto alongU = [&](int first, int from, int to) {
    const auto pole = surface.poles.begin() + first;
    return text.edge(from, to, text.splineCurve(surface.degreeU, surface.knotsU, {pole, pole + nu}));
  };
  const auto alongV = [&](int first, int from, int to) {
    std::vector<Eigen::Vector3d> poles;
    for (int k = first; k <= last; k += nu) poles.push_back(surface.poles[k]);
    return text.edge(from, to, text.splineCurve(surface.degreeV, surface.knotsV, poles));
  };
  const int s = alongU(0, v00, v10), e = alongV(nu - 1, v10, v11);
  const int n = alongU(last - nu + 1, v01, v11), w = alongV(0, v00, v01);
  return text.file(id, {{s, true}, {e, true}, {n, false}, {w, false}}, name);
}

namespace {

constexpr double kTolerance = 1e-6;               ///< mm, of the face's border on its surface
constexpr const char* kDate = "20000101.000000";  ///< the same bytes on every day

Handle(TCollection_HAsciiString) ascii(const std::string& text) {
  std::string plain;
  for (const char c : text) plain += c >= ' ' && c < 0x7f ? c : '_';
  return new TCollection_HAsciiString(plain.c_str());
}

}  // namespace

Result<std::string> igesText(const SplineSurface& surface, const std::string& name) {
  if (Result<void> ok = checkSplineSurface(surface); !ok) return tl::unexpected<Error>(ok.error());
  silenceOcct();
  return guarded(
      ErrorCode::internal, "the surface could not be written as IGES", [&]() -> Result<std::string> {
        TColgp_Array2OfPnt poles(1, surface.polesU, 1, surface.polesV);
        for (int j = 0; j < surface.polesV; ++j)
          for (int i = 0; i < surface.polesU; ++i)
            poles(i + 1, j + 1) = toPoint(surface.poles[std::size_t(j) * surface.polesU + i]);
        std::vector<double> u, v;
        std::vector<int> countsU, countsV;
        packKnots(surface.knotsU, u, countsU);
        packKnots(surface.knotsV, v, countsV);
        const int nu = int(u.size()), nv = int(v.size());
        const Handle(Geom_BSplineSurface) spline = new Geom_BSplineSurface(
            poles, TColStd_Array1OfReal(u[0], 1, nu), TColStd_Array1OfReal(v[0], 1, nv),
            TColStd_Array1OfInteger(countsU[0], 1, nu), TColStd_Array1OfInteger(countsV[0], 1, nv),
            surface.degreeU, surface.degreeV);
        IGESControl_Controller::Init();
        IGESControl_Writer writer("MM", 0);  // 0: trimmed surfaces, which every modeller reads
        if (!writer.AddShape(BRepBuilderAPI_MakeFace(spline, kTolerance).Face()))
          return fail(ErrorCode::internal, "the surface could not be turned into IGES", "iges");
        writer.ComputeModel();
        const Handle(IGESData_IGESModel) model = writer.Model();
        IGESData_GlobalSection section = model->GlobalSection();
        for (const auto set : {&IGESData_GlobalSection::SetSendName, &IGESData_GlobalSection::SetFileName,
                               &IGESData_GlobalSection::SetReceiveName})
          (section.*set)(ascii(name));
        section.SetSystemId(ascii("Bladewright"));
        section.SetAuthorName(ascii("Bladewright"));
        section.SetCompanyName(ascii(""));
        section.SetDate(ascii(kDate));
        section.SetLastChangeDate(ascii(kDate));
        model->SetGlobalSection(section);
        std::ostringstream text;
        text.imbue(std::locale::classic());
        if (!writer.Write(text))
          return fail(ErrorCode::internal, "the surface could not be written as IGES", "iges");
        return text.str();
      });
}

}  // namespace bw::geometry
