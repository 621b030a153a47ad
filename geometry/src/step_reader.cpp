// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "cad_reader.h"

#include <Interface_Static.hxx>
#include <STEPControl_Reader.hxx>
#include <StepData_StepModel.hxx>
#include <StepGeom_Curve.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepShape_ClosedShell.hxx>
#include <StepShape_ConnectedFaceSet.hxx>
#include <StepShape_Face.hxx>
#include <StepShape_ManifoldSolidBrep.hxx>
#include <StepShape_OpenShell.hxx>
#include <StepShape_OrientedFace.hxx>
#include <StepShape_Shell.hxx>
#include <StepShape_ShellBasedSurfaceModel.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

#include <algorithm>
#include <istream>
#include <map>
#include <set>

#include "isolated.h"
#include "step_salvage.h"

namespace bw::geometry {

namespace {

std::string nameOf(const Handle(StepRepr_RepresentationItem) & item) {
  if (item.IsNull() || item->Name().IsNull()) return {};
  std::string name = item->Name()->ToCString();
  name.erase(0, std::min(name.find_first_not_of(' '), name.size()));
  name.erase(name.find_last_not_of(' ') + 1);
  return name == "NONE" ? std::string() : name;  // what some programs write for no name
}

/// Names of faces: their own, else that of the shell, solid or surface model that they belong to.
class FaceNames {
 public:
  explicit FaceNames(const Handle(Interface_InterfaceModel) & model) {
    for (int i = 1; i <= model->NbEntities(); ++i) {
      const Handle(Standard_Transient)& entity = model->Value(i);
      if (const auto shell = Handle(StepShape_ConnectedFaceSet)::DownCast(entity); !shell.IsNull()) {
        give(shell, nameOf(shell));
      } else if (const auto solid = Handle(StepShape_ManifoldSolidBrep)::DownCast(entity); !solid.IsNull()) {
        give(solid->Outer(), nameOf(solid));
      } else if (const auto sheet = Handle(StepShape_ShellBasedSurfaceModel)::DownCast(entity);
                 !sheet.IsNull() && !sheet->SbsmBoundary().IsNull()) {
        for (int k = 1; k <= sheet->NbSbsmBoundary(); ++k)
          give(Handle(StepShape_ConnectedFaceSet)::DownCast(sheet->SbsmBoundaryValue(k).Value()),
               nameOf(sheet));
      }
    }
  }

  std::string of(const Handle(StepShape_Face) & face) const {
    if (const std::string own = nameOf(face); !own.empty()) return own;
    const auto it = inherited_.find(face.get());
    return it == inherited_.end() ? std::string() : it->second;
  }

 private:
  void give(const Handle(StepShape_ConnectedFaceSet) & shell, const std::string& name) {
    if (name.empty() || shell.IsNull() || shell->CfsFaces().IsNull()) return;
    for (int i = 1; i <= shell->NbCfsFaces(); ++i) inherited_.emplace(shell->CfsFacesValue(i).get(), name);
  }

  std::map<const StepShape_Face*, std::string> inherited_;
};

/// Finds the faces that the translator made of each entity and gives them their names. Tells in words which
/// it did not make; empty if it made all.
std::string matchFaces(const STEPControl_Reader& reader, ReadShape& result) {
  const Handle(StepData_StepModel) model = Handle(StepData_StepModel)::DownCast(reader.WS()->Model());
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  const FaceNames names(model);
  std::map<const TopoDS_TShape*, std::string> byShape;
  std::set<int> missing;
  int faces = 0;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(StepShape_Face) face = Handle(StepShape_Face)::DownCast(model->Value(i));
    if (face.IsNull() || !Handle(StepShape_OrientedFace)::DownCast(face).IsNull()) continue;
    ++faces;
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, face);
    if (shape.IsNull()) {
      missing.insert(model->IdentLabel(face));
    } else if (const std::string name = names.of(face); !name.empty()) {
      byShape.emplace(shape.TShape().get(), name);
    }
  }
  result.faces = facesOf(result.shape);
  result.names.clear();
  for (const TopoDS_Shape& face : result.faces) {
    const auto it = byShape.find(face.TShape().get());
    result.names.push_back(it == byShape.end() ? std::string() : it->second);
  }
  if (missing.empty()) return {};
  return std::to_string(missing.size()) + " of " + std::to_string(faces) +
         (missing.size() == 1 ? " faces is" : " faces are") + " left out (" + entityList(missing) + ")";
}

/// What the translator made of curves, with the names of these.
std::vector<std::pair<TopoDS_Shape, std::string>> namedCurves(const STEPControl_Reader& reader) {
  std::vector<std::pair<TopoDS_Shape, std::string>> named;
  const Handle(StepData_StepModel) model = Handle(StepData_StepModel)::DownCast(reader.WS()->Model());
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(StepGeom_Curve) curve = Handle(StepGeom_Curve)::DownCast(model->Value(i));
    const std::string name = nameOf(curve);
    if (name.empty()) continue;
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, curve);
    if (!shape.IsNull()) named.emplace_back(shape, name);
  }
  return named;
}

}  // namespace

Result<ReadShape> readStep(std::string_view text, const std::string& name) {
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  STEPControl_Reader reader;
  BytesBuffer buffer(text);
  std::istream stream(&buffer);
  if (reader.ReadStream(name.c_str(), stream) != IFSelect_RetDone) {
    return unreadable(name, "it is not valid STEP; export it again from the CAD program");
  }
  ReadShape result;
  const Salvage salvaged = salvage(Handle(StepData_StepModel)::DownCast(reader.WS()->Model()), text);
  if (!salvaged.fault.empty()) return unreadable(name, salvaged.fault);
  result.healing = salvaged.mended;
  result.format = "STEP";
  TColStd_SequenceOfAsciiString lengths, angles, solidAngles;
  reader.FileUnits(lengths, angles, solidAngles);
  result.unit = lengths.IsEmpty() ? "mm (assumed)" : unitName(lengths.First().ToCString());
  std::string lost;
  if (reader.TransferRoots() > 0) {
    result.shape = reader.OneShape();
    if (!result.shape.IsNull()) lost = matchFaces(reader, result);
    if (result.faces.empty()) result.namedCurves = namedCurves(reader);
  }
  if (!salvaged.damage.empty() || !lost.empty()) {
    const std::string all = "no face is left out for that";
    result.leftOut.push_back(salvaged.damage.empty() ? lost
                                                     : salvaged.damage + "; " + (lost.empty() ? all : lost));
  }
  if (!salvaged.unitDamage.empty()) {
    result.leftOut.push_back(salvaged.unitDamage + "; lengths are read in " + result.unit +
                             ": check the size, and state the unit if it is wrong");
  }
  return result;
}

}  // namespace bw::geometry
