// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <unsupported/Eigen/BVH>

#include <memory>
#include <mutex>
#include <string>
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
    double fine;    ///< mm to its nearest one; of a border's sample, the same as the radius
  };
  PointTree tree;
  std::vector<Sample> samples;
  std::vector<Eigen::Vector3d> points;  ///< of the samples
  double spacing = 0;                   ///< the largest of the radii
  /// Of a face of the target: its samples lie together.
  struct Face {
    int first = 0, count = 0;
    double spacing = 0;  ///< mm, the largest of its radii
    Eigen::AlignedBox3d box;
  };
  std::vector<Face> faces;
  Eigen::KdBVH<double, 3, int> tower;  ///< of their boxes, by index in the target; empty for one face
};

/// A face beside another one, and the largest tolerance of the edges that both share, mm.
struct Neighbour {
  int face = 0;
  double tolerance = 0;
};

/// A surface that several faces lie on which hang together, over the rectangle of its parameters around them.
struct Carrier {
  std::shared_ptr<const FaceGeometry> surface;
  std::vector<int> faces;
  Bounds bounds;  ///< of the surface's grid
};

struct Target::Impl {
  std::shared_ptr<const CadModel::Impl> model;
  std::vector<int> indices;
  std::vector<std::shared_ptr<const FaceGeometry>> faces;
  std::vector<int> edgeUses;  ///< by model edge: how often the chosen faces are bounded by it
  /// By face: the faces that share an edge with it.
  std::vector<std::vector<Neighbour>> neighbours;
  std::vector<Carrier> carriers;
  bool flipped = false;  ///< the outer side is against that of the file: sheets are seen from above
  bool sheet = false;    ///< no solid gives the outer side
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

/// A model of one face that was never in a file. Throws Standard_Failure where there is none.
Result<std::shared_ptr<const CadModel::Impl>> modelOf(const TopoDS_Face& face, const std::string& name);
/// These faces of a model as a target.
std::shared_ptr<const Target::Impl> targetOf(std::shared_ptr<const CadModel::Impl> model,
                                             const std::vector<int>& faces);

/// The foot of a point on a face, or on its border.
struct FaceFoot {
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double distance = 1e300;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< outer side; zero where it takes another look
  bool onBorder = false;                             ///< the border holds the foot back
  int edge = -1;                                     ///< the model's edge that does
};

/// The local minimum of the distance from `p` to the face that Newton's method finds from `start`; inside the
/// borders. Accuracy 1e-7 mm (docs/mathematics.md, closest points).
FaceFoot footOnFace(const FaceGeometry& face, const std::vector<EdgeGeometry>& edges,
                    const Eigen::Vector3d& p, const Eigen::Vector2d& start);
/// The same on the surface under the face, within the rectangle of its parameters: its borders do not count.
FaceFoot footOnSurface(const FaceGeometry& face, const Eigen::Vector3d& p, const Eigen::Vector2d& start);

}  // namespace bw::geometry
