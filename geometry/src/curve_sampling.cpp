// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "curve_sampling.h"

#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_Line.hxx>
#include <Geom_TrimmedCurve.hxx>

namespace bw::geometry {

bool isLine(Handle(Geom2d_Curve) curve) {
  while (const auto trimmed = Handle(Geom2d_TrimmedCurve)::DownCast(curve)) curve = trimmed->BasisCurve();
  return curve->IsKind(STANDARD_TYPE(Geom2d_Line));
}

bool isLine(Handle(Geom_Curve) curve) {
  while (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve)) curve = trimmed->BasisCurve();
  return curve->IsKind(STANDARD_TYPE(Geom_Line));
}

}  // namespace bw::geometry
