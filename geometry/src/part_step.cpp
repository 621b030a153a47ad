// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <APIHeaderSection_MakeHeader.hxx>
#include <STEPControl_Writer.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <StepShape_ManifoldSolidBrep.hxx>
#include <TCollection_HAsciiString.hxx>

#include <locale>
#include <sstream>
#include <string>
#include <vector>

#include "occt.h"
#include "part_impl.h"
#include "step_text.h"

namespace bw::geometry {

namespace {

Handle(TCollection_HAsciiString) ascii(const std::string& text) {
  return new TCollection_HAsciiString(text.c_str());
}

/// Marks stand in the place of names until the text is there: OCCT's writer knows no letters beyond ASCII.
std::string markOf(std::size_t i) { return "bladewright:" + std::to_string(i) + ":"; }

/// Gives the products and solids that the model has from entity `first` on a mark in the place of a name.
void nameEntities(const Handle(StepData_StepModel) & model, int first, const std::string& mark) {
  for (int i = first; i <= model->NbEntities(); ++i) {
    const Handle(Standard_Transient) entity = model->Value(i);
    if (const auto product = Handle(StepBasic_Product)::DownCast(entity); !product.IsNull()) {
      product->SetId(ascii(mark));
      product->SetName(ascii(mark));
    } else if (const auto solid = Handle(StepShape_ManifoldSolidBrep)::DownCast(entity); !solid.IsNull()) {
      solid->SetName(ascii(mark));
    }
  }
}

void setHeader(const Handle(StepData_StepModel) & model, const std::string& mark) {
  APIHeaderSection_MakeHeader header(model);
  header.SetName(ascii(mark));
  header.SetTimeStamp(ascii(""));
  header.SetAuthorValue(1, ascii(""));
  header.SetOrganizationValue(1, ascii(""));
  header.SetPreprocessorVersion(ascii("Bladewright"));
  header.SetOriginatingSystem(ascii("Bladewright"));
  header.SetAuthorisation(ascii(""));
  header.SetDescriptionValue(1, ascii(""));
}

/// The text with `'mark'` replaced by the name, quoted as STEP wants it.
std::string withNames(const std::string& text, const std::vector<std::string>& names) {
  const std::string head = "'bladewright:";
  std::string result;
  std::size_t from = 0;
  for (std::size_t at = text.find(head); at != std::string::npos; at = text.find(head, from)) {
    result.append(text, from, at - from);
    result += stepString(names[std::stoul(text.substr(at + head.size()))]);
    from = text.find('\'', at + 1) + 1;
  }
  return result.append(text, from);
}

}  // namespace

Result<std::string> partsStepText(std::span<const NamedPart> parts, const std::string& name) {
  if (parts.empty())
    return fail(ErrorCode::badInput, "there is no part to be written as STEP; name at least one", "parts");
  for (const NamedPart& part : parts)
    if (part.part->pieces() == 0)
      return fail(ErrorCode::badInput,
                  "nothing is left of \"" + part.name +
                      "\" after its cuts, so it cannot be written as STEP; leave it out, or turn a cut round",
                  part.name);
  silenceOcct();
  return guarded(ErrorCode::internal, "the parts could not be written as STEP", [&]() -> Result<std::string> {
    STEPControl_Writer writer;
    std::vector<std::string> own;
    for (const NamedPart& part : parts) own.push_back(part.name);
    own = stepNames(own);
    std::vector<std::string> names = {name};  // of the file, and of each part
    names.insert(names.end(), own.begin(), own.end());
    Handle(StepData_StepModel) model = writer.Model(Standard_True);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const NamedPart& part = parts[i];
      const int first = model->NbEntities() + 1;
      if (writer.Transfer(compoundOf(part.part->impl().solids), STEPControl_ManifoldSolidBrep) !=
          IFSelect_RetDone)
        return fail(ErrorCode::internal, "\"" + part.name + "\" could not be turned into STEP", part.name);
      model = writer.Model();
      nameEntities(model, first, markOf(i + 1));
    }
    setHeader(model, markOf(0));
    StepData_StepWriter lines(model);
    lines.SendModel(Handle(StepData_Protocol)::DownCast(model->Protocol()));
    std::ostringstream text;
    text.imbue(std::locale::classic());
    if (!lines.Print(text)) return fail(ErrorCode::internal, "the parts could not be written as STEP", name);
    return withNames(text.str(), names);
  });
}

}  // namespace bw::geometry
