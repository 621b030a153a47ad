// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <TopoDS_Shape.hxx>

#include <memory>
#include <mutex>
#include <vector>

#include "bw/geometry/cad_model.h"
#include "face_geometry.h"
#include "point_tree.h"

namespace bw::geometry {

struct CadModel::Impl {
  std::string name;
  TopoDS_Shape shape;
  std::vector<std::shared_ptr<const FaceGeometry>> faces;  ///< null where a face cannot be computed with
  std::vector<std::string> faceFault;                      ///< why not
  std::vector<bool> inSolid;
  std::vector<EdgeGeometry> edges;
  CadInfo info;
};

/// What the closest-point search looks up first: samples of the faces and of the free borders.
struct SearchTable {
  struct Sample {
    int face;  ///< index in the target
    int i, j;  ///< node of the face's grid; i = −1: a sample of its border number j
    double u, v;
    double radius;  ///< mm to its furthest neighbour
  };
  PointTree tree;
  std::vector<Sample> samples;
  std::vector<Eigen::Vector3d> points;  ///< of the samples
  double spacing = 0;                   ///< the largest of the radii
};

struct Target::Impl {
  std::shared_ptr<const CadModel::Impl> model;
  std::vector<int> indices;
  std::vector<std::shared_ptr<const FaceGeometry>> faces;
  std::vector<int> edgeUses;  ///< by model edge: how often the chosen faces are bounded by it
  bool flipped = false;       ///< the outer side is against that of the file: sheets are seen from above
  bool sheet = false;         ///< no solid gives the outer side
  Eigen::Vector3d meanNormal = Eigen::Vector3d::Zero();  ///< area-weighted mean of the outer unit normals:
                                                         ///< length 1 for a plane, 0 for a closed surface
  Bounds bounds;
  double area = 0;

  mutable std::once_flag tableOnce;
  mutable std::unique_ptr<const SearchTable> table;
  const SearchTable& searchTable() const;

  bool freeEdge(int edge) const { return edge >= 0 && edgeUses[edge] == 1; }
  /// Smallest and largest value of direction · point.
  std::array<double, 2> extent(const Eigen::Vector3d& direction) const;
};

/// Appends triangles of faces within `deflection` mm (> 0) to `mesh`. `flipped` turns their outer side round.
/// Returns, for each triangle of `mesh`, the position of its face in `faces`; `mesh` was empty before. A face
/// too thin for the mesher has no triangles.
std::vector<int> meshFaces(const std::vector<const FaceGeometry*>& faces, bool flipped, double deflection,
                           TriangleMesh& mesh);

}  // namespace bw::geometry
