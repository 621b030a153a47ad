// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/target_actors.h"

#include <algorithm>

#include "scene/actors/mesh_edges.h"

namespace bw::scene {

TargetActors::TargetActors(Layers& layers) {
  surface_.setMatte(0.35, 0.65, 0.0);
  edges_.setFlat();
  for (Part* part : parts()) layers.add(Layer::target, *part);
}

void TargetActors::setContent(const ShownTarget* target) {
  target_ = target;
  static const TriangleMesh kNone;
  const TriangleMesh& mesh = target ? *target->mesh : kNone;
  const bool given = mesh.normals.size() == mesh.points.size();
  normals_ = given ? std::vector<Eigen::Vector3d>{} : pointNormals(mesh.points, mesh.triangles);
  shareMesh(surface_.data(), mesh.points, given ? mesh.normals : normals_, mesh.triangles);
  edges_.setSegments(boundaryEdges(mesh.points, mesh.triangles));
}

void TargetActors::setStyle(const Style& style) {
  const Theme& colors = theme(style.dark);
  const Look& look = style.of(Kind::target, target_ ? target_->id : ItemId{});
  for (Part* part : parts()) part->setVisible(target_ && look.visible && look.opacity > 0);
  surface_.setColor(colors.target);
  surface_.setOpacity(std::clamp(look.opacity, 0.0, 1.0));
  edges_.setColor(colors.targetEdge);
  edges_.setOpacity(std::min(1.0, look.opacity + 0.3));
  edges_.setLineWidth(style.pixelRatio);
}

void TargetActors::update(double behind, double line) {
  for (Part* part : parts()) part->setDepthBehind(behind);
  edges_.setDepthShift(line);
}

}  // namespace bw::scene
