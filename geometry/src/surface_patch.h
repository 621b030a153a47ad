// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Geom_Surface.hxx>

#include <string>
#include <vector>

#include "bw/core/surface/surface_jet.h"

namespace bw::geometry {

using Jet = SurfaceJet;

/// Evaluates the surface of a face. B-splines and Béziers up to degree 9 are evaluated from tables of their
/// own, because the live path asks for hundreds of thousands of points; other surfaces by OCCT. Calls with
/// one object from several threads are safe.
class SurfacePatch {
 public:
  explicit SurfacePatch(const Handle(Geom_Surface) & surface);

  Eigen::Vector3d value(double u, double v) const {
    Jet jet;
    evaluate(u, v, 0, jet);
    return jet.p;
  }
  /// Fills p, du, dv of the jet.
  void first(double u, double v, Jet& jet) const { evaluate(u, v, 1, jet); }
  /// Fills all derivatives; the normal is left to whoever knows the outer side.
  void second(double u, double v, Jet& jet) const { evaluate(u, v, 2, jet); }

  /// Without the rectangle that a file may have trimmed it to.
  const Handle(Geom_Surface) & surface() const { return surface_; }
  /// "plane", "cylinder", … as in FaceInfo.
  const std::string& type() const { return type_; }
  bool isSpline() const { return degreeU_ > 0; }
  /// Distinct knots in each direction (B-splines), else empty.
  const std::vector<double>& breaksU() const { return breaksU_; }
  const std::vector<double>& breaksV() const { return breaksV_; }
  /// Inner knots at which the surface is less than twice continuously differentiable.
  const std::vector<double>& creasesU() const { return creasesU_; }
  const std::vector<double>& creasesV() const { return creasesV_; }
  int degreeU() const { return degreeU_; }
  int degreeV() const { return degreeV_; }
  /// The period, or 0.
  double periodU() const { return periodU_; }
  double periodV() const { return periodV_; }

 private:
  /// Fills the derivatives up to `order` ≤ 2.
  void evaluate(double u, double v, int order, Jet& jet) const;

  std::string type_;
  Handle(Geom_Surface) surface_;
  double periodU_ = 0, periodV_ = 0;
  int degreeU_ = 0, degreeV_ = 0;
  int polesU_ = 0, polesV_ = 0;
  bool rational_ = false;
  std::vector<double> knotsU_, knotsV_;
  std::vector<double> tableU_, tableV_;  // basis polynomials, span by span
  std::vector<double> breaksU_, breaksV_, creasesU_, creasesV_;
  std::vector<Eigen::Vector4d> poles_;  // homogeneous, u slowest
};

}  // namespace bw::geometry
