// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "cad_reader.h"

#include <BRepBuilderAPI_Transform.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <gp_Trsf.hxx>

#include <istream>
#include <sstream>
#include <string_view>

#include "bw/core/dxf/dxf_curves.h"
#include "bw/core/text/number_text.h"
#include "isolated.h"
#include "occt.h"

namespace bw::geometry {

namespace {

constexpr std::size_t kMemoryLeast = std::size_t(2) << 30;  // bytes that reading may take of any file
constexpr std::size_t kMemoryPerByte = 60;                  // and more for each byte of it
constexpr int kSecondsLeast = 20;                           // of computing, likewise
constexpr std::size_t kBytesPerSecond = 200000;

Result<ReadShape> readIges(std::string_view text, const std::string& name) {
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  const MemoryFile file(text);
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
  if (model.IsNull() || result.shape.IsNull()) return result;
  const Handle(Transfer_TransientProcess) process = reader.WS()->TransferReader()->TransientProcess();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(IGESData_IGESEntity) entity = model->Entity(i);
    if (entity.IsNull() || !entity->HasShortLabel()) continue;
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, entity);
    if (shape.IsNull() || shape.ShapeType() < TopAbs_WIRE) continue;
    const std::string_view label = trimmedLeft(trimmedRight(entity->ShortLabel()->ToCString()));
    if (!label.empty()) result.namedCurves.emplace_back(shape, label);
  }
  return result;
}

Result<ReadShape> readBrep(std::string_view text) {
  ReadShape result;
  result.format = "BREP";
  result.unit = "mm (assumed)";
  BytesBuffer buffer(text);
  std::istream stream(&buffer);
  BRep_Builder builder;
  BRepTools::Read(result.shape, stream, builder);
  return result;
}

int countOf(const TopoDS_Shape& shape, TopAbs_ShapeEnum type) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, type, map);
  return map.Extent();
}

/// Takes the numbers of the file as lengths in `unit`, whatever unit it states.
Result<void> readAs(ReadShape& read, LengthUnit unit, const std::string& name) {
  const Result<double> scale = scaleTo(unit, read.unit, name);
  if (!scale) return tl::unexpected(scale.error());
  if (*scale == 1) return {};
  gp_Trsf larger;
  larger.SetScaleFactor(*scale);
  BRepBuilderAPI_Transform transform(read.shape, larger, Standard_True);
  for (TopoDS_Shape& face : read.faces) face = transform.ModifiedShape(face);
  read.shape = transform.Shape();
  return {};
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

Result<ReadShape> readAndHeal(std::string_view text, const std::string& name, CadFormat format,
                              const ReadOptions& options) {
  auto read = guarded(ErrorCode::cannotRead, "cannot read " + name, [&]() -> Result<ReadShape> {
    auto raw = readRaw(text, name, format);
    if (!raw) return raw;
    if (raw->faces.empty()) raw->faces = facesOf(raw->shape);
    raw->names.resize(raw->faces.size());
    if (raw->faces.empty()) {
      if (!raw->leftOut.empty()) return unreadable(name, raw->leftOut.back());
      std::string what = "it holds no faces";
      if (!raw->shape.IsNull() && countOf(raw->shape, TopAbs_EDGE) > 0) {
        const int edges = countOf(raw->shape, TopAbs_EDGE);
        what += ", only " + std::to_string(edges) + (edges == 1 ? " edge" : " edges") +
                "; make a loft through its curves, or export a surface or a solid";
      } else {
        what += "; export a surface or a solid, not a mesh";
      }
      return fail(ErrorCode::badInput, name + " cannot be used: " + what, name, 0, 1);
    }
    if (options.unit) {
      if (auto ok = readAs(*raw, *options.unit, name); !ok) return tl::unexpected(ok.error());
    }
    heal(*raw, options.sewing);
    return raw;
  });
  if (!read) read.error().where = name;
  return read;
}

/// A result as bytes: an error's code and texts, or what is known of the shape and the shape itself.
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
  for (const auto* lines : {&read->healing, &read->leftOut}) {
    appendText(bytes, std::to_string(lines->size()));
    for (const std::string& line : *lines) appendText(bytes, line);
  }
  // Faces are told by their place among those that the shape is met in.
  TopTools_IndexedMapOfShape met;
  TopExp::MapShapes(read->shape, TopAbs_FACE, met);
  appendText(bytes, std::to_string(read->faces.size()));
  for (std::size_t i = 0; i < read->faces.size(); ++i) {
    appendText(bytes, std::to_string(met.FindIndex(read->faces[i])));
    appendText(bytes, read->names[i]);
  }
  std::ostringstream stream;
  BinTools::Write(read->shape, stream);
  bytes += std::move(stream).str();
  return bytes;
}

Result<ReadShape> unpackedShape(std::string_view bytes, const std::string& name) {
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
  if (!takeText(bytes, read.format) || !takeText(bytes, read.unit)) return broken();
  for (auto* lines : {&read.healing, &read.leftOut}) {
    if (!takeText(bytes, count)) return broken();
    lines->resize(std::stoul(count));
    for (std::string& line : *lines) {
      if (!takeText(bytes, line)) return broken();
    }
  }
  if (!takeText(bytes, count)) return broken();
  std::vector<int> places(std::stoul(count));
  read.names.resize(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!takeText(bytes, text) || !takeText(bytes, read.names[i])) return broken();
    places[i] = std::stoi(text);
  }
  return guarded(ErrorCode::cannotRead, "cannot read " + name, [&]() -> Result<ReadShape> {
    BytesBuffer buffer(bytes);
    std::istream stream(&buffer);
    BinTools::Read(read.shape, stream);
    const std::vector<TopoDS_Shape> met = facesOf(read.shape);
    for (const int place : places) {
      if (place < 1 || place > int(met.size())) return broken();
      read.faces.push_back(met[std::size_t(place) - 1]);
    }
    return std::move(read);
  });
}

/// What `work` makes of a CAD text that is not packed.
Result<std::string> readText(std::string_view text, const std::string& name, const RunContext& context,
                             const std::function<std::string(std::string_view, CadFormat)>& work) {
  text = withoutMark(text);
  if (trimmedRight(text).empty()) {
    return unreadable(name, "the file is empty; export it again from the CAD program");
  }
  const CadFormat content = formatOfContent(text), suffix = formatOfSuffix(name);
  if (content == CadFormat::unknown) {
    if (text.find("\"bladewright_design\"") != std::string::npos) {
      return unreadable(name, "it is a design, whose surface and settings are in it; open it as a design");
    }
    if (isDxf(text))
      return unreadable(name, "it is a DXF drawing, which has no faces; make a loft through its curves");
    if (suffix == CadFormat::unknown) {
      return unreadable(name,
                        "it is neither STEP, IGES nor BREP; export the surface as STEP from the CAD program");
    }
    return unreadable(name,
                      std::string("its content is not ") + formatName(suffix) +
                          "; the file is damaged or of another kind: export it again from the CAD program");
  }
  if (const std::string fault = faultOf(text, content); !fault.empty()) return unreadable(name, fault);
  if (context.stopped()) return stoppedError();
  prepareTranslators();
  WorkLimits limits;
  limits.memory = kMemoryLeast + kMemoryPerByte * text.size();
  limits.cpuSeconds = kSecondsLeast + int(text.size() / kBytesPerSecond);
  auto bytesBack = runIsolated(
      context, [&] { return work(text, content); }, limits);
  if (!bytesBack && bytesBack.error().code == ErrorCode::cannotRead)
    return unreadable(name, bytesBack.error().message);
  return bytesBack;
}

}  // namespace

std::vector<TopoDS_Shape> facesOf(const TopoDS_Shape& shape) {
  std::vector<TopoDS_Shape> faces;
  if (shape.IsNull()) return faces;
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, TopAbs_FACE, map);
  for (int i = 1; i <= map.Extent(); ++i) faces.push_back(map(i));
  return faces;
}

tl::unexpected<Error> unreadable(const std::string& name, const std::string& reason) {
  return fail(ErrorCode::cannotRead, "cannot read " + name + ": " + reason, name);
}

Result<ReadShape> readRaw(std::string_view text, const std::string& name, CadFormat format) {
  if (format == CadFormat::step) return readStep(text, name);
  return format == CadFormat::iges ? readIges(text, name) : readBrep(text);
}

Result<double> scaleTo(LengthUnit unit, const std::string& stated, const std::string& name) {
  const double length = unitLength(stated);
  if (length > 0) return millimetres(unit) / length;
  return fail(ErrorCode::badInput,
              name + " states its lengths in \"" + stated +
                  "\", which cannot be read as another unit; leave out \"unit\" to read it as stated",
              "unit");
}

Result<std::string> readApart(const std::string& bytes, const std::string& name, const RunContext& context,
                              const std::function<std::string(std::string_view, CadFormat)>& work) {
  silenceOcct();
  if (!isCompressed(bytes)) return readText(bytes, name, context, work);
  const auto text =
      guarded(ErrorCode::cannotRead, "cannot read " + name, [&] { return decompressed(bytes, name); });
  if (!text) return tl::unexpected(text.error());
  return readText(*text, name, context, work);
}

Result<ReadShape> readShape(const std::string& bytes, const std::string& name, const ReadOptions& options,
                            const RunContext& context) {
  const Result<std::string> back =
      readApart(bytes, name, context, [&](std::string_view text, CadFormat format) {
        return packed(readAndHeal(text, name, format, options));
      });
  if (!back) return tl::unexpected(back.error());
  return unpackedShape(*back, name);
}

}  // namespace bw::geometry
