// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "cad_reader.h"

#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepLib.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <BinTools.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Check.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <ShapeFix_Shape.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <XSControl_WorkSession.hxx>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string_view>

#include "bw/core/number_text.h"
#include "cad_format.h"
#include "isolated.h"
#include "occt.h"

namespace bw::geometry {

namespace {

namespace fs = std::filesystem;

constexpr double kSewTolerance = 0.01;  // mm; gaps between faces of one surface as CAD programs leave them
constexpr int kCheckLimit =
    2000;  // faces up to which a file is checked for faults: the check costs about 1 ms a face

tl::unexpected<Error> unreadable(const std::string& name, const std::string& reason) {
  return fail(ErrorCode::cannotRead, "cannot read " + name + ": " + reason, name);
}

std::string unitName(std::string text) {
  text = lowerCase(text);
  if (text.find("millimet") != std::string::npos || text == "mm") return "mm";
  if (text.find("centimet") != std::string::npos || text == "cm") return "cm";
  if (text.find("kilomet") != std::string::npos || text == "km") return "km";
  if (text.find("micromet") != std::string::npos || text == "um") return "um";
  if (text == "metre" || text == "meter" || text == "m") return "m";
  if (text.find("inch") != std::string::npos || text == "in") return "inch";
  if (text.find("foot") != std::string::npos || text.find("feet") != std::string::npos || text == "ft")
    return "foot";
  if (text.find("mil") == 0) return "mil";
  if (text.find("mi") == 0) return "mile";
  return text.empty() ? "mm (assumed)" : text;
}

Result<ReadShape> readStep(const std::string& bytes, const std::string& name) {
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  STEPControl_Reader reader;
  std::istringstream stream(bytes);
  if (reader.ReadStream(name.c_str(), stream) != IFSelect_RetDone) {
    return unreadable(name, "it is not valid STEP; export it again from the CAD program");
  }
  // OCCT's translators follow references without looking whether they lead anywhere, so damaged entities must
  // be found first.
  const Handle(Interface_InterfaceModel) model = reader.WS()->Model();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const std::string type = model->Value(i)->DynamicType()->Name();
    if (type.rfind("StepGeom_", 0) != 0 && type.rfind("StepShape_", 0) != 0) continue;
    const Handle(Interface_Check) check = model->Check(i, Standard_True);
    if (check.IsNull() || !check->HasFailed()) continue;
    return unreadable(name, "its entity " + std::string(model->StringLabel(model->Value(i))->ToCString()) +
                                " is damaged (" + check->CFail(1) + "); copy or export it again");
  }
  ReadShape result;
  result.format = "STEP";
  TColStd_SequenceOfAsciiString lengths, angles, solidAngles;
  reader.FileUnits(lengths, angles, solidAngles);
  result.unit = lengths.IsEmpty() ? "mm (assumed)" : unitName(lengths.First().ToCString());
  if (reader.TransferRoots() > 0) result.shape = reader.OneShape();
  return result;
}

Result<ReadShape> readIges(const std::string& bytes, const std::string& name) {
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  const MemoryFile file(bytes);
  if (!file.good()) return unreadable(name, "the memory does not suffice for a copy of it");
  IGESControl_Reader reader;
  reader.SetReadVisible(false);
  if (reader.ReadFile(file.path().c_str()) != IFSelect_RetDone) {
    return unreadable(name, "it is not valid IGES; export it again from the CAD program, best as STEP");
  }
  ReadShape result;
  result.format = "IGES";
  const Handle(IGESData_IGESModel) model = reader.IGESModel();
  result.unit = "mm (assumed)";
  if (!model.IsNull() && !model->GlobalSection().UnitName().IsNull()) {
    result.unit = unitName(model->GlobalSection().UnitName()->ToCString());
  }
  if (reader.TransferRoots() > 0) result.shape = reader.OneShape();
  return result;
}

Result<ReadShape> readBrep(const std::string& bytes) {
  ReadShape result;
  result.format = "BREP";
  result.unit = "mm (assumed)";
  std::istringstream stream(bytes);
  BRep_Builder builder;
  BRepTools::Read(result.shape, stream, builder);
  return result;
}

int countOf(const TopoDS_Shape& shape, TopAbs_ShapeEnum type) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, type, map);
  return map.Extent();
}

/// True if no two faces share an edge.
bool loose(const TopoDS_Shape& shape) {
  TopTools_IndexedDataMapOfShapeListOfShape faces;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) {
    const TopTools_ListOfShape& list = faces(i);
    for (const TopoDS_Shape& face : list) {
      if (!face.IsSame(list.First())) return false;
    }
  }
  return true;
}

void heal(ReadShape& read) {
  const int faces = countOf(read.shape, TopAbs_FACE);
  if (faces <= kCheckLimit && !BRepCheck_Analyzer(read.shape).IsValid()) {
    ShapeFix_Shape fixer(read.shape);
    if (fixer.Perform()) {
      read.shape = fixer.Shape();
      read.healing.push_back(BRepCheck_Analyzer(read.shape).IsValid()
                                 ? "faces or edges with faults were repaired"
                                 : "faces or edges with faults were repaired in part; some faults remain");
    } else {
      read.healing.push_back("some faces or edges have faults that could not be repaired");
    }
  }
  if (faces > 1 && loose(read.shape)) {
    BRepBuilderAPI_Sewing sewing(kSewTolerance);
    sewing.Add(read.shape);
    sewing.Perform();
    const TopoDS_Shape sewn = sewing.SewedShape();
    if (!sewn.IsNull() && countOf(sewn, TopAbs_FACE) == faces && !loose(sewn)) {
      read.shape = sewn;
      read.healing.push_back(std::to_string(faces) +
                             " separate faces were sewn together where their edges meet within " +
                             shortText(kSewTolerance) + " mm");
    }
  }
  BRepLib::BuildCurves3d(read.shape);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(read.shape, TopAbs_EDGE, edges);
  int bare = 0;
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    double first = 0, last = 0;
    if (!BRep_Tool::Degenerated(edge) && BRep_Tool::Curve(edge, first, last).IsNull()) ++bare;
  }
  if (bare > 0)
    read.healing.push_back(std::to_string(bare) + " edges have no curve in space and are passed over");
}

/// Fills the static tables of OCCT's translators before the first process is forked that needs them.
void prepareTranslators() {
  static const bool ready = [] {
    STEPControl_Controller::Init();
    IGESControl_Controller::Init();
    return true;
  }();
  static_cast<void>(ready);
}

Result<ReadShape> readAndHeal(const std::string& bytes, const std::string& name, CadFormat format) {
  auto read = guarded(ErrorCode::cannotRead, "cannot read " + name, [&]() -> Result<ReadShape> {
    auto raw = format == CadFormat::step   ? readStep(bytes, name)
               : format == CadFormat::iges ? readIges(bytes, name)
                                           : readBrep(bytes);
    if (!raw) return raw;
    if (raw->shape.IsNull() || countOf(raw->shape, TopAbs_FACE) == 0) {
      std::string what = "it holds no faces";
      if (!raw->shape.IsNull() && countOf(raw->shape, TopAbs_EDGE) > 0) {
        what += ", only " + std::to_string(countOf(raw->shape, TopAbs_EDGE)) + " edges";
      }
      return fail(ErrorCode::badInput,
                  name + " cannot be used: " + what + "; export a surface or a solid, not curves or a mesh",
                  name, 0, 1);
    }
    heal(*raw);
    return raw;
  });
  if (!read) read.error().where = name;
  return read;
}

/// A result as bytes: an error's code and texts, or the shape and what is known of it.
std::string packed(const Result<ReadShape>& read) {
  std::string bytes;
  if (!read) {
    const Error& error = read.error();
    appendText(bytes, std::to_string(int(error.code)));
    appendText(bytes, error.message);
    return bytes;
  }
  appendText(bytes, "");
  appendText(bytes, read->format);
  appendText(bytes, read->unit);
  appendText(bytes, std::to_string(read->healing.size()));
  for (const std::string& line : read->healing) appendText(bytes, line);
  std::ostringstream shape;
  BinTools::Write(read->shape, shape);
  appendText(bytes, shape.str());
  return bytes;
}

Result<ReadShape> unpacked(std::string_view bytes, const std::string& name) {
  const auto broken = [&] {
    return unreadable(name, "what was read of it is incomplete; the memory may not suffice");
  };
  std::string code, text, count;
  if (!takeText(bytes, code)) return broken();
  if (!code.empty()) {
    if (!takeText(bytes, text)) return broken();
    return fail(ErrorCode(std::stoi(code)), text, name);
  }
  ReadShape read;
  if (!takeText(bytes, read.format) || !takeText(bytes, read.unit) || !takeText(bytes, count))
    return broken();
  read.healing.resize(std::stoul(count));
  for (std::string& line : read.healing) {
    if (!takeText(bytes, line)) return broken();
  }
  if (!takeText(bytes, text)) return broken();
  return guarded(ErrorCode::cannotRead, "cannot read " + name, [&]() -> Result<ReadShape> {
    std::istringstream shape(text);
    BinTools::Read(read.shape, shape);
    if (read.shape.IsNull()) return broken();
    return std::move(read);
  });
}

}  // namespace

Result<ReadShape> readShape(const std::string& bytes, const std::string& name, const RunContext& context) {
  silenceOcct();
  if (trimmedRight(bytes).empty()) {
    return unreadable(name, "the file is empty; export it again from the CAD program");
  }
  const CadFormat content = formatOfContent(bytes), suffix = formatOfSuffix(name);
  if (content == CadFormat::unknown) {
    if (bytes.find("\"bladewright_design\"") != std::string::npos) {
      return unreadable(name,
                        "it is a design, whose surface and settings are in it; open it as one, with blade "
                        "design or in the window");
    }
    if (suffix == CadFormat::unknown) {
      return unreadable(name,
                        "it is neither STEP, IGES nor BREP; export the surface as STEP from the CAD program");
    }
    return unreadable(name,
                      std::string("its content is not ") + formatName(suffix) +
                          "; the file is damaged or of another kind: export it again from the CAD program");
  }
  if (const std::string fault = faultOf(bytes, content); !fault.empty()) return unreadable(name, fault);
  if (context.stopped()) return stoppedError();
  prepareTranslators();
  const auto bytesBack = runIsolated(context, [&] { return packed(readAndHeal(bytes, name, content)); });
  if (!bytesBack) {
    if (bytesBack.error().code != ErrorCode::cannotRead) return tl::unexpected(bytesBack.error());
    return unreadable(name, bytesBack.error().message);
  }
  return unpacked(*bytesBack, name);
}

}  // namespace bw::geometry
