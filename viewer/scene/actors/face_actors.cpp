// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/face_actors.h"

#include <algorithm>

#include "scene/actors/mesh_edges.h"

namespace bw::scene {

namespace {

constexpr double kSurrounding = 0.10;  ///< opacity of the faces around a result
constexpr double kSurroundingEdges = 0.3;

}  // namespace

FaceActors::FaceActors(Layers& layers) {
  for (Part* part : {&pale_, &chosen_, &hovered_}) part->setMatte(0.4, 0.6, 0.0);
  edges_.setFlat();
  for (Part* part : parts()) layers.add(Layer::faces, *part);
}

void FaceActors::setContent(const std::shared_ptr<const FaceMesh>& given) {
  if (given == faces_) return;
  for (Part* part : parts()) part->clear();
  sorted_ = false;
  lit_ = -1;
  faces_ = given;
  first_.clear();
  if (!faces_) return;
  const FaceMesh& faces = *faces_;
  int count = 0;
  for (const int face : faces.faces) count = std::max(count, face + 1);
  first_.assign(std::size_t(count) + 1, 0);
  for (const int face : faces.faces) ++first_[std::size_t(face) + 1];
  for (std::size_t i = 0; i + 1 < first_.size(); ++i) first_[i + 1] += first_[i];
  std::vector<int> next = first_;
  order_.resize(faces.faces.size());
  for (std::size_t k = 0; k < faces.faces.size(); ++k)
    order_[std::size_t(next[std::size_t(faces.faces[k])]++)] = int(k);
  edges_.setSegments(boundaryEdges(faces.mesh.points, faces.mesh.triangles));
}

void FaceActors::sort(const std::vector<int>& chosen) {
  if (sorted_ && chosen == sortedFor_) return;
  sorted_ = true;
  sortedFor_ = chosen;
  const FaceMesh& faces = *faces_;
  std::vector<bool> isChosen(first_.size(), false);
  for (const int face : chosen)
    if (face >= 0 && std::size_t(face) + 1 < first_.size()) isChosen[std::size_t(face)] = true;
  for (Part* part : {&pale_, &chosen_}) part->clear();
  paleTriangles_.clear();
  chosenTriangles_.clear();
  for (std::size_t k = 0; k < faces.faces.size(); ++k)
    (isChosen[std::size_t(faces.faces[k])] ? chosenTriangles_ : paleTriangles_)
        .push_back(faces.mesh.triangles[k]);
  shareMesh(pale_.data(), faces.mesh.points, faces.mesh.normals, paleTriangles_);
  shareMesh(chosen_.data(), faces.mesh.points, faces.mesh.normals, chosenTriangles_);
}

void FaceActors::light(int face) {
  if (face == lit_) return;
  lit_ = face;
  hovered_.clear();
  hoveredTriangles_.clear();
  if (face < 0 || std::size_t(face) + 1 >= first_.size()) return;
  for (int k = first_[std::size_t(face)]; k < first_[std::size_t(face) + 1]; ++k)
    hoveredTriangles_.push_back(faces_->mesh.triangles[std::size_t(order_[std::size_t(k)])]);
  shareMesh(hovered_.data(), faces_->mesh.points, faces_->mesh.normals, hoveredTriangles_);
}

void FaceActors::setStyle(const Style& style, const Rgb& background) {
  const Theme& colors = theme(style.dark);
  const bool any = faces_ != nullptr, choosing = any && style.chooseFaces;
  const bool around = any && style[Kind::face].visible;
  if (choosing || around) sort(style.chosenFaces);
  light(choosing ? style.hoveredFace : -1);

  pale_.setVisible(choosing || around);
  pale_.setColor(choosing ? mix(background, colors.target, 0.3) : colors.target);
  pale_.setOpacity(choosing ? 1.0 : kSurrounding);
  chosen_.setVisible(choosing);
  chosen_.setColor(mix(colors.target, colors.selection, 0.45));
  hovered_.setVisible(choosing && lit_ >= 0);
  const bool again = std::count(style.chosenFaces.begin(), style.chosenFaces.end(), lit_) > 0;
  hovered_.setColor(mix(again ? colors.selection : colors.target, colors.accent, again ? 0.25 : 0.4));
  edges_.setVisible(choosing || around);
  edges_.setColor(colors.targetEdge);
  edges_.setOpacity(choosing ? 1.0 : kSurroundingEdges);
  edges_.setLineWidth(style.pixelRatio);
}

void FaceActors::update(const Style& style, double behind, double line) {
  for (Part* part : parts()) part->setDepthBehind(style.chooseFaces ? 0 : behind);
  hovered_.setDepthShift(0.5 * line);
  edges_.setDepthShift(line);
}

}  // namespace bw::scene
