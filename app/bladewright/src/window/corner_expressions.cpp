// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/corner_expressions.h"

#include <cmath>

#include "bw/core/text/number_text.h"

namespace bw::app {

namespace {

constexpr double kNothing = 1e-12;  // of a unit vector: rounding

/// " - 0.5*(of)"; empty where the factor is nothing beside `unit`.
std::string less(double factor, double unit, const std::string& of) {
  if (std::abs(factor) <= kNothing * unit) return {};
  const std::string sign = factor < 0 ? " + " : " - ";
  return std::abs(factor) == 1 ? sign + of : sign + roundTripText(std::abs(factor)) + "*" + of;
}

}  // namespace

CornerExpressions cornerOfSize(const BlockPlacement& placed, int axis, const std::string& size) {
  const Eigen::Vector3d along = rotationFromAngles(placed.rotation).col(axis);
  const Eigen::Vector3d far = placed.origin + placed.size[axis] * along;
  CornerExpressions corner;
  for (int i = 0; i < 3; ++i)
    if (const std::string term = less(along[i], 1, "(" + size + ")"); !term.empty())
      corner[std::size_t(i)] = roundTripText(far[i]) + term;
  return corner;
}

CornerExpressions cornerOfTurn(const BlockPlacement& placed, int axis, const std::string& degrees) {
  // The corner is middle − M R(v) half, where M are the turns before that one, and those after it turn half.
  const Eigen::Vector3d middle = placed.box().center();
  Eigen::Vector3d first = placed.rotation, last = placed.rotation;
  for (int i = 0; i < 3; ++i) (i < axis ? last : first)[i] = 0;
  last[axis] = 0;
  const Eigen::Matrix3d before = rotationFromAngles(first);
  const Eigen::Vector3d half = rotationFromAngles(last) * (0.5 * placed.size);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const std::string angle = "(pi*(" + degrees + ")/180)";
  CornerExpressions corner;
  for (int i = 0; i < 3; ++i) {
    const double byCos = before(i, u) * half[u] + before(i, v) * half[v],
                 bySin = before(i, v) * half[u] - before(i, u) * half[v];
    const std::string terms =
        less(byCos, half.norm(), "cos" + angle) + less(bySin, half.norm(), "sin" + angle);
    if (!terms.empty())
      corner[std::size_t(i)] = roundTripText(middle[i] - before(i, axis) * half[axis]) + terms;
  }
  return corner;
}

}  // namespace bw::app
