// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Standard_Failure.hxx>
#include <gp_Dir.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include <exception>
#include <new>
#include <string>

#include "bw/core/base/result.h"

namespace bw::geometry {

inline gp_Pnt toPoint(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }
inline Eigen::Vector3d toEigen(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }
inline Eigen::Vector3d toEigen(const gp_Pnt& p) { return toEigen(p.XYZ()); }
inline Eigen::Vector3d toEigen(const gp_Vec& p) { return toEigen(p.XYZ()); }

/// Stops OCCT from printing to the standard streams of the program.
void silenceOcct();

/// The text of an OCCT exception for an error message.
std::string failureText(const Standard_Failure& failure);

/// Calls `body`, which returns a Result, and turns any exception into an error that begins with `what`.
template <class Body>
auto guarded(ErrorCode code, const std::string& what, Body&& body) -> decltype(body()) {
  try {
    return body();
  } catch (const Standard_Failure& failure) {
    return fail(code, what + ": " + failureText(failure));
  } catch (const std::bad_alloc&) {
    return fail(code, what + ": the memory does not suffice");
  } catch (const std::exception& e) {
    return fail(code, what + ": " + e.what());
  }
}

}  // namespace bw::geometry
