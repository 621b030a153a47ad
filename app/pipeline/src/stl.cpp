// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>

#include "bw/pipeline/handover.h"

namespace bw::pipeline {

namespace {

constexpr std::size_t kHead = 80;  ///< bytes before the number of triangles

/// Little-endian, whatever the machine.
void append(std::string& out, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) out += char(word >> shift & 0xff);
}

void append(std::string& out, const Eigen::Vector3d& v) {
  for (int i = 0; i < 3; ++i) append(out, std::bit_cast<std::uint32_t>(float(v[i]) + 0.0f));
}

}  // namespace

std::string stlBytes(const TriangleMesh& mesh, const std::string& name) {
  std::string out = name.substr(0, kHead - 1);
  // A head that began with "solid" would be taken for the text form.
  if (out.rfind("solid", 0) == 0) out = "STL " + out.substr(0, kHead - 5);
  out.resize(kHead, ' ');
  out.reserve(kHead + 4 + 50 * mesh.triangles.size());
  append(out, std::uint32_t(mesh.triangles.size()));
  for (const std::array<int, 3>& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.points[std::size_t(t[0])], &b = mesh.points[std::size_t(t[1])],
                          &c = mesh.points[std::size_t(t[2])];
    append(out, (b - a).cross(c - a).stableNormalized());
    for (const Eigen::Vector3d* p : {&a, &b, &c}) append(out, *p);
    out += std::string(2, '\0');
  }
  return out;
}

}  // namespace bw::pipeline
