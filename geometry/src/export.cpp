// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/geometry/export.h"

#include <BSplCLib.hxx>
#include <BSplSLib.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TCollection_HAsciiString.hxx>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "bw/core/blade/blade.h"
#include "bw/core/files/file_set.h"
#include "bw/core/text/number_text.h"
#include "occt.h"
#include "spline_face.h"
#include "step_text.h"

namespace bw::geometry {

namespace {

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

/// The surface as a shell of one face.
int shellOf(StepText& text, const SplineSurface& surface, const std::string& name) {
  const int nu = surface.polesU, nv = surface.polesV;
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
  return text.shell(id, {{s, true}, {e, true}, {n, false}, {w, false}}, name);
}

}  // namespace

Result<std::string> stepText(const SplineSurface& surface, const std::string& name) {
  const NamedSurface one{name, &surface};
  return stepText(std::span(&one, 1), name);
}

Result<std::string> stepText(std::span<const NamedSurface> surfaces, const std::string& name) {
  StepText text;
  std::vector<std::string> names;
  for (const NamedSurface& one : surfaces) names.push_back(one.name);
  names = stepNames(names);
  std::vector<int> shells;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const SplineSurface& surface = *surfaces[i].surface;
    if (auto ok = checkSplineSurface(surface); !ok) return tl::unexpected(ok.error());
    shells.push_back(shellOf(text, surface, names[i]));
  }
  return text.file(shells, name);
}

namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kSamePlace = 1e-6;  // mm
constexpr double kCorner = 0.94;     // cosine of the turn

/// The curve without points that stand where the one before does, parted at its corners.
std::vector<Points> smoothPieces(const Points& points) {
  Points apart;
  for (const Eigen::Vector3d& p : points)
    if (apart.empty() || (p - apart.back()).norm() > kSamePlace) apart.push_back(p);
  std::vector<Points> pieces;
  if (apart.size() < 2) return pieces;
  pieces.push_back({apart.front()});
  for (std::size_t i = 1; i < apart.size(); ++i) {
    pieces.back().push_back(apart[i]);
    if (i + 1 == apart.size()) break;
    const Eigen::Vector3d before = (apart[i] - apart[i - 1]).normalized(),
                          after = (apart[i + 1] - apart[i]).normalized();
    if (before.dot(after) < kCorner) pieces.push_back({apart[i]});
  }
  return pieces;
}

/// The spline through points at their chord lengths.
Result<int> splineThrough(StepText& text, const Points& points, const std::string& name) {
  const int count = int(points.size()), degree = std::min(3, count - 1);
  std::vector<double> at = {0};
  for (std::size_t i = 1; i < points.size(); ++i)
    at.push_back(at.back() + (points[i] - points[i - 1]).norm());
  const std::vector<double> knots = interpolationKnots(at, degree);
  TColgp_Array1OfPnt poles(1, count);
  for (int i = 0; i < count; ++i) poles(i + 1) = toPoint(points[std::size_t(i)]);
  TColStd_Array1OfInteger contact(1, count);
  contact.Init(0);
  int pivot = 0;
  BSplCLib::Interpolate(degree, arrayOf(knots), arrayOf(at), contact, poles, pivot);
  if (pivot != 0)
    return fail(ErrorCode::noSolution, "no curve could be laid through the points of " + name, "curves");
  Points own;
  for (int i = 0; i < count; ++i) own.push_back(toEigen(poles(i + 1)));
  return text.splineCurve(degree, knots, own, name);
}

}  // namespace

Result<std::string> curvesStepText(std::span<const NamedCurve> curves, const std::string& name) {
  return guarded(ErrorCode::noSolution, "the curves could not be written", [&]() -> Result<std::string> {
    StepText text;
    std::vector<std::string> names;
    for (const NamedCurve& curve : curves) names.push_back(curve.name);
    names = stepNames(names);
    std::vector<StepText::Wire> wires;
    for (std::size_t i = 0; i < curves.size(); ++i) {
      StepText::Wire wire{names[i], curves[i].layer, {}};
      for (const Points& piece : smoothPieces(curves[i].points)) {
        const Result<int> id = splineThrough(text, piece, names[i]);
        if (!id) return tl::unexpected<Error>(id.error());
        wire.curves.push_back(*id);
      }
      if (!wire.curves.empty()) wires.push_back(std::move(wire));
    }
    return text.curveFile(wires, name);
  });
}

namespace {

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
        IGESControl_Controller::Init();
        IGESControl_Writer writer("MM", 0);  // 0: trimmed surfaces, which every modeller reads
        if (!writer.AddShape(faceOf(surface)))
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
