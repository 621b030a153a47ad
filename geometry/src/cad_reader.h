// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <TopoDS_Shape.hxx>

#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/geometry/cad_model.h"

namespace bw::geometry {

/// A shape as it came from a file, in mm, repaired.
struct ReadShape {
  TopoDS_Shape shape;
  std::string format;
  std::string unit;
  std::vector<std::string> healing;
  std::vector<std::string> leftOut;  ///< what could not be used
  std::vector<TopoDS_Shape> faces;   ///< in the order of the file
  std::vector<std::string> names;    ///< of the faces; empty where a face has none
};

/// The faces of a shape, each once, in the order in which they are met.
std::vector<TopoDS_Shape> facesOf(const TopoDS_Shape& shape);

/// The error that a file cannot be read, and why.
tl::unexpected<Error> unreadable(const std::string& name, const std::string& reason);

/// Reads a CAD file from its bytes. `name` serves the messages and the choice between formats that look
/// alike. A crash of the library, endless work or want of memory is the file's fault: `cannotRead`.
Result<ReadShape> readShape(const std::string& bytes, const std::string& name, const ReadOptions& options,
                            const RunContext& context);

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
