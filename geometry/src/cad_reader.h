// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <TopoDS_Shape.hxx>

#include <string>
#include <vector>

#include "bw/core/result.h"
#include "bw/core/run_context.h"

namespace bw::geometry {

/// A shape as it came from a file, in mm, repaired.
struct ReadShape {
  TopoDS_Shape shape;
  std::string format;
  std::string unit;
  std::vector<std::string> healing;
};

/// Reads a CAD file from its bytes. `name` serves the messages and the choice between formats that look
/// alike.
Result<ReadShape> readShape(const std::string& bytes, const std::string& name, const RunContext& context);

}  // namespace bw::geometry
