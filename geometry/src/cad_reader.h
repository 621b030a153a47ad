// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <TopoDS_Shape.hxx>

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/geometry/cad_model.h"

namespace bw::geometry {

/// The kinds of CAD files that are read.
enum class CadFormat { step, iges, brep, unknown };

/// The kind that the content is of; unknown if none.
CadFormat formatOfContent(std::string_view bytes);
/// The kind that a file's suffix promises; unknown if none.
CadFormat formatOfSuffix(const std::string& name);
/// "STEP", "IGES", "BREP"; "CAD" for unknown.
const char* formatName(CadFormat format);

/// Why OCCT must not be given this text: cut short, tables that claim more than there is, entities of one
/// number. OCCT reads on over such faults and may crash or never return. Empty if nothing is found.
std::string faultOf(std::string_view bytes, CadFormat format);

/// Without the UTF-8 byte order mark that some programs put first.
std::string_view withoutMark(std::string_view text);
std::string lowerCase(std::string_view text);
std::string_view trimmedLeft(std::string_view text);
/// Without the blanks and zero bytes at its end.
std::string_view trimmedRight(std::string_view text);

/// "mm", "cm", "m", "inch", … for a unit as a file calls it; "mm (assumed)" for none.
std::string unitName(std::string text);

/// mm in a unit of `unitName`; 0 for one that is not known.
double unitLength(const std::string& name);

/// Which entities of a STEP text refer to which, as written, whatever becomes of them in a reader.
class StepReferences {
 public:
  explicit StepReferences(std::string_view text);

  /// Numbers of the entities that refer to `entity`.
  std::vector<int> usersOf(int entity) const;

 private:
  std::vector<std::pair<int, int>> uses_;  // the one referred to and the one that refers, sorted
};

/// A shape as it came from a file, in mm, repaired.
struct ReadShape {
  TopoDS_Shape shape;
  std::string format;
  std::string unit;
  std::vector<std::string> healing;
  std::vector<std::string> leftOut;  ///< what could not be used
  std::vector<TopoDS_Shape> faces;   ///< in the order of the file
  std::vector<std::string> names;    ///< of the faces; empty where a face has none
  /// What was made of curves that have a name.
  std::vector<std::pair<TopoDS_Shape, std::string>> namedCurves = {};
};

/// The faces of a shape, each once, in the order in which they are met.
std::vector<TopoDS_Shape> facesOf(const TopoDS_Shape& shape);

/// The error that a file cannot be read, and why.
tl::unexpected<Error> unreadable(const std::string& name, const std::string& reason);

/// Reads a CAD file from its bytes. `name` serves the messages and the choice between formats that look
/// alike. A crash of the library, endless work or want of memory is the file's fault: `cannotRead`.
Result<ReadShape> readShape(const std::string& bytes, const std::string& name, const ReadOptions& options,
                            const RunContext& context);

/// What `work` makes of a CAD text and its format, in a process of its own whose time and memory are bounded
/// by the size of the text. `bytes` may be packed. Errors (`cannotRead`, with `name`): what is no CAD file,
/// or a damaged one; `cancelled`.
Result<std::string> readApart(
    const std::string& bytes, const std::string& name, const RunContext& context,
    const std::function<std::string(std::string_view text, CadFormat format)>& work);

/// The shape of a CAD text as OCCT reads it, in mm, with nothing healed. For the process that readers have of
/// their own.
Result<ReadShape> readRaw(std::string_view text, const std::string& name, CadFormat format);

/// How much larger a shape is whose numbers are taken in a unit in place of the one that it states. Error
/// `badInput`: that is not known.
Result<double> scaleTo(LengthUnit unit, const std::string& stated, const std::string& name);

/// Reads STEP with OCCT, in mm, with the names of its faces. What cannot be used is left out and told in
/// `leftOut`. Runs in the process that readers have of their own.
Result<ReadShape> readStep(std::string_view text, const std::string& name);

/// Repairs faults of a shape and sews faces whose open edges meet within `sewing` mm. Tells what was done,
/// the widest gap that was closed and the narrowest that stays open in `read.healing`; `read.faces` follow.
void heal(ReadShape& read, double sewing);

/// True for bytes of a gzip or zip file, as `.stpz` files are.
bool isCompressed(std::string_view bytes);

/// The text in a gzip file, or in the one CAD file of a zip archive. Errors (`cannotRead`, with `name`): cut
/// short, damaged, several or no CAD files, or more than 1 GiB or 200 times its own size, which no text is.
Result<std::string> decompressed(std::string_view bytes, const std::string& name);

}  // namespace bw::geometry
