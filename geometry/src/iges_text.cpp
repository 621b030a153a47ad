// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <BRepBuilderAPI_MakeFace.hxx>
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
#include <sstream>

#include "bw/geometry/export.h"
#include "occt.h"
#include "spline_check.h"

namespace bw::geometry {

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
          for (int i = 0; i < surface.polesU; ++i) {
            const Eigen::Vector3d& p = surface.poles[std::size_t(j) * surface.polesU + i];
            poles(i + 1, j + 1) = gp_Pnt(p.x(), p.y(), p.z());
          }
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
