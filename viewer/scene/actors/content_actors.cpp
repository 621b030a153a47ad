// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/content_actors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/actors/mesh_lines.h"
#include "scene/camera/camera.h"

namespace bw::scene {

namespace {

constexpr double kSurrounding = 0.10;  ///< opacity of the faces around a result
constexpr double kSurroundingEdges = 0.3;

constexpr double kMarkWidth = 2.5;  ///< device-independent pixels

/// How far behind the cut the target is drawn, in diagonals: so much that even at a glancing sight, which
/// stretches the distance of the two, no shard of it comes through.
constexpr double kLeastSetBack = 0.1, kMostSetBack = 0.3;

/// Of all cut surfaces together, while the picture moves: so many are drawn in a third of the time that a
/// picture then has where the processor does the work of a graphics card.
constexpr std::size_t kDraftTriangles = 50000;

/// The size of a pixel or less, the same while the view comes nearer little by little.
double steadyPixel(double millimetres) {
  constexpr double kSteps = 4;  // while its size doubles
  return std::exp2(std::floor(kSteps * std::log2(millimetres)) / kSteps);
}

/// Gives each thing its actors, and none to the actors that are left over.
template <class Actors, class Range, class... More>
void share(Layers& layers, std::deque<Actors>& actors, const Range& things, More... more) {
  while (actors.size() < things.size()) actors.emplace_back(layers);
  for (std::size_t i = 0; i < actors.size(); ++i)
    actors[i].setContent(i < things.size() ? &things[i] : nullptr, more...);
}

}  // namespace

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
  edges_.setLine(colors.targetEdge, style.pixelRatio);
  edges_.setOpacity(std::min(1.0, look.opacity + 0.3));
}

void TargetActors::update(double behind, double line) {
  for (Part* part : parts()) part->setDepthBehind(behind);
  edges_.setDepthShift(line);
}

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
  if (faces_) edges_.setSegments(boundaryEdges(faces_->mesh.points, faces_->mesh.triangles));
}

void FaceActors::fill(Part& part, Triangles& triangles, const std::function<bool(int)>& holds) {
  part.clear();
  triangles.clear();
  for (std::size_t k = 0; k < faces_->faces.size(); ++k)
    if (holds(faces_->faces[k])) triangles.push_back(faces_->mesh.triangles[k]);
  shareMesh(part.data(), faces_->mesh.points, faces_->mesh.normals, triangles);
}

void FaceActors::sort(const std::vector<int>& chosen) {
  if (sorted_ && chosen == sortedFor_) return;
  sorted_ = true;
  sortedFor_ = chosen;
  std::vector<bool> among(std::size_t(std::ranges::max(faces_->faces)) + 1, false);
  for (const int face : chosen)
    if (face >= 0 && std::size_t(face) < among.size()) among[std::size_t(face)] = true;
  fill(pale_, paleTriangles_, [&](int face) { return !among[std::size_t(face)]; });
  fill(chosen_, chosenTriangles_, [&](int face) { return among[std::size_t(face)]; });
}

void FaceActors::light(int face) {
  if (face == lit_) return;
  lit_ = face;
  fill(hovered_, hoveredTriangles_, [&](int other) { return other == face; });
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
  edges_.setLine(colors.targetEdge, style.pixelRatio);
  edges_.setOpacity(choosing ? 1.0 : kSurroundingEdges);
}

void FaceActors::update(const Style& style, double behind, double line) {
  for (Part* part : parts()) part->setDepthBehind(style.chooseFaces ? 0 : behind);
  hovered_.setDepthShift(0.5 * line);
  edges_.setDepthShift(line);
}

ToldActors::ToldActors(Layers& layers) {
  lines_.setFlat();
  layers.add(Layer::stations, lines_);
}

void ToldActors::setContent(const std::map<ItemId, const ToldMarks*>& marks) {
  marks_ = marks;
  drawn_.clear();
  lines_.clear();
}

void ToldActors::setStyle(const Style& style, const Rgb& background) {
  std::vector<const ToldMarks*> seen;
  for (const auto& [id, marks] : marks_)
    if (style.of(Kind::told, id).visible) seen.push_back(marks);
  if (seen != drawn_) {
    drawn_ = std::move(seen);
    std::vector<Polyline> lines;
    for (const ToldMarks* marks : drawn_) lines.insert(lines.end(), marks->lines.begin(), marks->lines.end());
    lines_.setLines(lines);
  }
  lines_.setVisible(!drawn_.empty());
  lines_.setLine(theme(false).warning, kMarkWidth * style.pixelRatio);
  lines_.setFade(keptColor(style.stale), background);
}

ContentActors::ContentActors(Layers& layers)
    : layers_(layers),
      faces_(layers),
      told_(layers),
      isolineLabels_(layers),
      plane_(vtkSmartPointer<vtkPlane>::New()) {}

void ContentActors::setContent(const Things& things, double diagonal, bool targetAfar) {
  things_ = &things;
  diagonal_ = diagonal;
  targetAfar_ = targetAfar;
  faces_.setContent(things.faces);
  told_.setContent(things.told);
  share(layers_, targets_, things.targets);
  share(layers_, cuts_, things.rows);
  share(layers_, stations_, things.rows, diagonal);
  share(layers_, blocks_, things.stocks);
}

void ContentActors::replace(const Things::Changes& changes, double diagonal, bool targetAfar) {
  const bool larger = diagonal != diagonal_;
  diagonal_ = diagonal;
  targetAfar_ = targetAfar;
  told_.setContent(things_->told);
  for (const std::size_t i : changes.targets) targets_[i].setContent(&things_->targets[i]);
  for (const std::size_t i : changes.rows) cuts_[i].setContent(&things_->rows[i]);
  for (std::size_t i = 0; i < things_->rows.size(); ++i) {
    if (changes.rows.contains(i))
      stations_[i].setContent(&things_->rows[i], diagonal);
    else if (larger)
      stations_[i].setDiagonal(diagonal);
  }
  for (std::size_t i = 0; i < things_->stocks.size(); ++i) {
    if (changes.stocks.contains(i))
      blocks_[i].setContent(&things_->stocks[i]);
    else if (larger)
      blocks_[i].hatchAnew();
  }
}

void ContentActors::setStyle(const Style& style, const Rgb& background) {
  if (style.section) {
    // VTK keeps what its planes' normals point to.
    const Eigen::Vector3d kept = -style.section->normal;
    plane_->SetOrigin(style.section->point.data());
    plane_->SetNormal(kept.data());
  }
  const auto cutOpen = [&](auto& actors) {
    for (Part* part : actors.parts()) part->setCutOpen(style.section ? plane_.Get() : nullptr);
  };
  for (TargetActors& target : targets_) {
    target.setStyle(style);
    cutOpen(target);
  }
  isolineLabels_.clear();
  for (CutActors& cut : cuts_) {
    cut.setStyle(style, background);
    cut.label(isolineLabels_, diagonal_);
    cutOpen(cut);
    for (Part* solid : cut.solids()) solid->setCutOpen(style.section ? plane_.Get() : nullptr);
  }
  faces_.setStyle(style, background);
  cutOpen(faces_);
  told_.setStyle(style, background);
  cutOpen(told_);
  for (StationLines& stations : stations_) {
    stations.setStyle(style, background);
    cutOpen(stations);
  }
  for (BlockActors& block : blocks_) {
    block.setStyle(style, diagonal_, background);
    cutOpen(block);
  }
}

std::vector<vtkSmartPointer<vtkActor>> ContentActors::solids() {
  std::vector<vtkSmartPointer<vtkActor>> solids;
  for (CutActors& cut : cuts_)
    for (const Part* solid : cut.solids()) solids.emplace_back(solid->actor());
  for (const BlockActors& block : blocks_) solids.emplace_back(block.solid());
  return solids;
}

Bounds ContentActors::arrowBounds() const {
  Bounds bounds;
  for (const BlockActors& block : blocks_) bounds = joined(bounds, block.arrow().bounds());
  return bounds;
}

double ContentActors::targetSetBack(const Style& style) const {
  double reach = -1;
  for (std::size_t i = 0; i < things_->rows.size(); ++i) {
    const Row& row = things_->rows[i];
    if (row.covered(style) && style.of(Kind::cut, row.id).opacity >= 0.5)
      reach = std::max(reach, cuts_[i].reach());
  }
  if (reach < 0) return 0;
  if (targetAfar_) return std::numeric_limits<double>::infinity();
  return std::clamp(8 * reach, kLeastSetBack * diagonal_, kMostSetBack * diagonal_);
}

void ContentActors::update(const Style& style, double depthPerMillimetre, double millimetresPerPixel,
                           double targetBehind, bool draft) {
  const double size = 1.5 * millimetresPerPixel * style.pixelRatio + 0.0004 * diagonal_;
  const double line = -depthPerMillimetre * size;
  for (TargetActors& target : targets_) target.update(targetBehind, line);
  faces_.update(style, targetBehind, line);
  told_.update(line);
  std::size_t triangles = 0;
  for (const Row& row : things_->rows)
    if (row.covered(style)) triangles += row.mesh.triangles.size();
  const int stride =
      draft ? std::max(1, int(std::ceil(std::sqrt(double(triangles) / double(kDraftTriangles))))) : 1;
  const double pixel = steadyPixel(millimetresPerPixel);
  for (CutActors& cut : cuts_) cut.update(line, pixel, stride, draft);
  for (StationLines& stations : stations_) stations.update(style, line, millimetresPerPixel, stride, draft);
  for (BlockActors& block : blocks_) block.update(line);
}

}  // namespace bw::scene
