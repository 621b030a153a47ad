// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

#include "bw/core/base/frame.h"
#include "face_geometry.h"
#include "model_impl.h"

namespace bw::geometry {

/// The height g = normal · point along an edge, with which its crossings of a plane are found.
struct EdgeLevels {
  int edge;                  ///< index of the model's edge
  std::vector<double> t, g;  ///< so close that g is monotone between neighbours
  double low, high;          ///< range of g
};

/// The height g = normal · point over the grid of a face.
struct FaceLevels {
  std::vector<double> g;                ///< on the grid
  std::vector<char> active;             ///< cells near the region
  std::vector<double> rowLow, rowHigh;  ///< range of g over the cells of a row
  double low, high;                     ///< range of g
};

/// The levels of edge number `index`, which must not be degenerate: its samples, and the extrema between
/// them.
EdgeLevels levelsOf(const EdgeGeometry& edge, int index, const Eigen::Vector3d& normal);

/// The levels of a face. Cells near `region` are active, the others are not looked at.
FaceLevels levelsOf(const FaceGeometry& face, const Eigen::Vector3d& normal, const Box& region);

/// A grid node this close (mm) counts as above the plane, so that rounding has no say.
inline constexpr double kOnPlane = 1e-9;
inline constexpr double kConverged = 1e-9;  ///< mm from the plane
inline constexpr double kSameNode = 1e-7;   ///< mm: nodes closer than this are one

/// A point of a section: on the face, and on the plane to 1e-8 mm.
struct LevelNode {
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  int root = -1;        ///< the crossing of a border that the node lies on; unique within one cut
  bool crease = false;  ///< on a line where the surface is less than twice continuously differentiable
};

/// A stretch of a curve beyond a border, on one surface.
struct LevelWay {
  int face = 0;  ///< index of a face or carrier, as in a LevelPiece
  std::vector<LevelNode> nodes;
};

/// A connected part of the section of one face, or of a carrier between faces.
struct LevelPiece {
  int face = 0;  ///< index in the target; carriers are numbered on from its faces
  std::vector<LevelNode> nodes;
  bool closed = false;  ///< the last node is followed by the first
  double bridged = 0;   ///< mm, the widest gap of the face that it leads across
  /// How the curve goes on beyond its first and its last node on the surfaces under the faces, outward from
  /// that node; empty where the border there is not one of this face alone, or the surface ends with it.
  std::vector<LevelWay> before = {}, after = {};
};

/// Cuts a target with planes of one normal.
///
/// A section is the level set of g(u, v) = normal · S(u, v). The grid of each face shows its topology
/// (marching squares, the ambiguous cell decided at its centre); every node is then found on the surface
/// itself. OpenCASCADE's intersection is the other way to the same curves. Trimmed faces are cut where the
/// section meets the curves of their borders, whose crossings are found on the space curves that neighbouring
/// faces share. Immutable; cuts from several threads are safe.
class PlaneCutter {
 public:
  /// `region`: only the neighbourhood of this box is looked at.
  PlaneCutter(const Target::Impl& target, const Eigen::Vector3d& normal, const Box& region);

  struct Cut {
    std::vector<LevelPiece> pieces;
    bool doubtful = false;  ///< a crossing of a border belongs to no curve that was found
  };
  /// `byKernel`: the curves on each surface are those that OpenCASCADE's intersection finds, which takes some
  /// hundred times as long; the borders cut them alike. Throws Standard_Failure where that fails.
  Cut cut(double level, bool byKernel = false) const;

  /// The point of the section between two nodes of a piece: `at` = 0…1 from a to b. False if the section
  /// cannot be followed there.
  bool between(int face, const LevelNode& a, const LevelNode& b, double at, double level,
               LevelNode& node) const;
  /// Unit tangent of the section, either way; zero where the plane touches the face.
  Eigen::Vector3d tangent(int face, const LevelNode& node) const;

  /// True if the plane runs along a border or a plane face, where a section is not a curve that it crosses.
  bool grazes(double level) const;

  const Eigen::Vector3d& normal() const { return normal_; }

 private:
  /// Where a border crosses the plane.
  struct Root {
    int edge;  ///< index of the model's edge
    double t;  ///< parameter on it
    Eigen::Vector3d p;
  };

  /// A face of the target, or of the carriers that are numbered on from them.
  const FaceGeometry& geometryOf(int face) const {
    const int faces = int(target_.faces.size());
    return face < faces ? *target_.faces[std::size_t(face)]
                        : *target_.carriers[std::size_t(face - faces)].surface;
  }

  /// The crossings of all borders with the plane.
  std::vector<Root> crossings(double level) const;
  /// Adds the curves of the whole surface under a face, by marching squares over its grid.
  void march(int face, double level, std::vector<LevelPiece>& chains) const;
  /// The same curves by OpenCASCADE.
  void intersect(int face, double level, std::vector<LevelPiece>& chains) const;
  /// Adds the curve that leads over these parameters, parted at seams and with a node on each crease.
  void follow(int face, double level, std::vector<Eigen::Vector2d> places,
              std::vector<LevelPiece>& chains) const;
  /// Moves a node along the line of the other parameter to the plane; `along` is 0 for u, 1 for v.
  void slide(int face, double level, int along, LevelNode& node) const;
  /// Cuts these curves at the borders and adds the parts inside to `cut`. Across holes and notches of the
  /// face that no other face of the target fills they go on: no blade leaves the foam there.
  void split(int face, const std::vector<Root>& roots, double level, std::vector<LevelPiece>& chains,
             Cut& cut) const;

  // Holes and notches over the edges of faces (level_bridges.cpp).
  using Nodes = std::vector<LevelNode>;
  struct LooseEnd;
  struct Stretch;
  struct Meeting;
  struct Path;
  struct Paths;
  class Bridging;
  /// Joins pieces whose ways on lead to each other, and has those that are left know their ways on.
  void bridge(const std::vector<Root>& roots, double level, bool byKernel, Cut& cut) const;
  /// Where two curves come nearest to each other: at the first place where they run together, if they do.
  Meeting meetingOf(int faceA, const Nodes& a, int faceB, const Nodes& b, double level) const;
  /// The place of a curve nearest to p: the number of a node, and the part of the way to the next one.
  double nearestPlace(int face, const Nodes& nodes, const Eigen::Vector3d& p, double level) const;
  LevelNode nodeAt(int face, const Nodes& nodes, double place, double level) const;
  /// mm that two surfaces whose faces share an edge may be apart there; empty where they share none.
  std::optional<double> jointTolerance(int faceA, int faceB) const;
  /// Moves a node along the surface to the plane; false if it does not get there.
  bool project(int face, double level, LevelNode& node) const;
  /// The node between two neighbours of the grid, one above and one below the plane.
  LevelNode crossing(int face, double level, double ua, double va, double ub, double vb) const;

  const Target::Impl& target_;
  Eigen::Vector3d normal_;
  std::vector<EdgeLevels> edges_;
  std::vector<FaceLevels> faces_;  ///< and carriers
};

}  // namespace bw::geometry
