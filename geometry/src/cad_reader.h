// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <TopoDS_Shape.hxx>

#include <string>
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

}  // namespace bw::geometry
