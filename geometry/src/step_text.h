// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "bw/core/surface/spline_surface.h"

namespace bw::geometry {

/// Writes faces and curves as ISO 10303-21 text of AP214, in mm. Own writer: OCCT's puts a date in the header
/// and numbers its products by a count that lives as long as the program, so equal input would not give equal
/// bytes.
class StepText {
 public:
  /// Adds an entity and returns its number.
  int add(const std::string& entity);

  int point(const Eigen::Vector3d& p);
  int direction(const Eigen::Vector3d& d);
  int placement(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, const Eigen::Vector3d& reference);
  int vertex(const Eigen::Vector3d& p);
  /// A non-rational B-spline curve; flat knots.
  int splineCurve(int degree, const std::vector<double>& knots, const std::vector<Eigen::Vector3d>& poles,
                  const std::string& name = {});
  int splineSurface(const SplineSurface& surface);
  /// An edge along `curve` between two vertices.
  int edge(int start, int end, int curve);

  /// An oriented edge of the border.
  struct Side {
    int edge;
    bool forward;
  };
  /// A shell of one face of `surface` bounded by `border`, counter-clockwise about the surface's normal du ×
  /// dv.
  int shell(int surface, const std::vector<Side>& border, const std::string& name);
  /// The whole file: a part of these shells.
  std::string file(const std::vector<int>& shells, const std::string& name);
  /// Curves that are one part, and the layer that they lie on; none where that is empty.
  struct Wire {
    std::string name, layer;
    std::vector<int> curves;
  };
  /// The same of curves alone: a part of each wire, in an assembly of each layer, in one of all.
  std::string curveFile(const std::vector<Wire>& wires, const std::string& name);

 private:
  /// What products have in common.
  struct Shared {
    int application = 0, product = 0;
    int definition = 0;  ///< with the first product
  };
  /// A part, or an assembly of such.
  struct Part {
    std::string name;
    int definition = 0, shape = 0, placement = 0;
  };

  /// Lengths in mm, angles in rad.
  int metric();
  Shared shared();
  /// The definition of a product.
  int product(const std::string& name, Shared& shared);
  void shapeOf(int definition, int shape);
  int placement();
  Part assembly(const std::vector<Part>& parts, const std::string& name, int metric, Shared& shared);
  /// The whole file: a part whose shape is `model`, of that kind of representation.
  std::string fileOf(int model, const std::string& representation, const std::string& name);
  std::string whole(const std::string& name) const;

  std::string body_;
  int count_ = 0;
};

/// Adds the distinct knots of a flat list and how often each stands there.
void packKnots(const std::vector<double>& flat, std::vector<double>& knots, std::vector<int>& counts);

/// A number as the exchange structure wants it: with a decimal point, capital E; reads back as the same
/// double.
std::string stepReal(double value);

/// The text in quotes; letters beyond ASCII as \X2\…\X0\, those beyond the first plane of Unicode as
/// \X4\…\X0\.
std::string stepString(const std::string& utf8);

/// The names as they stand in a file: control characters as escapes, and each another (`distinctNames`).
std::vector<std::string> stepNames(const std::vector<std::string>& names);

}  // namespace bw::geometry
