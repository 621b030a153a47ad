// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "bw/core/design/design.h"

namespace bw {

// The curves across the travel that tell a designed surface: its sections, its key blades, or its rows of
// poles. Marks call one by the id of its source and its place among them, counted from 1: "surface/2". They
// stand among the marks of sources (`PartIds::sources`), and in files in a list of their own, "curves".

/// How many there are; none for a formula.
int curveCount(const DesignedSurface& surface);

/// What marks call the curve at a place, counted from 0, of the source of that id.
std::string curveId(const std::string& source, int curve);

struct CurveOfSource {
  std::string source;  ///< id of a designed surface
  int curve = 0;       ///< counted from 0
};
/// What it is, by its place, counted from 0: "row 3", "section 2", "key blade 4".
std::string curveWord(const DesignedSurface& surface, int curve);

/// What messages call it: "section 2", or, where it was given a name, "ridge (section 2)".
std::string curveTitle(const Source& source, int curve);

/// Why a curve cannot have a name, with what to do; empty where it can.
std::string whyNoCurveName(const std::string& name);

/// The curve that marks call so; nothing if the design has none.
std::optional<CurveOfSource> curveOf(const Design& design, const std::string& id);

/// Whether two curves are the same and lie at the same place of the design.
bool isSameCurve(const DesignedSurface& a, int curveOfA, const DesignedSurface& b, int curveOfB);

/// Marks of a design when it becomes another: where a surface gets more curves or fewer, or other ones in
/// their place, the marks of curves that stay go with them, and those of others are gone. Marks of all else,
/// and of the curves of surfaces that are no longer there, stay as they are.
PartMarks followed(const PartMarks& marks, const Design& before, const Design& after);

/// The same of the names that curves were given, where `after` has those of `before`: they go with the curves
/// that stay, and those of others are gone.
void followNames(const Design& before, Design& after);

}  // namespace bw
