// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/content_actors.h"

#include <algorithm>
#include <limits>

#include "scene/camera/camera_fit.h"

namespace bw::scene {

namespace {

/// How far behind the cut the target is drawn, in diagonals: so much that even at a glancing sight, which
/// stretches the distance of the two, no shard of it comes through.
constexpr double kLeastSetBack = 0.1, kMostSetBack = 0.3;

/// Gives each thing its actors, and none to the actors that are left over.
template <class Actors, class Range, class... More>
void share(Layers& layers, std::deque<Actors>& actors, const Range& things, More... more) {
  while (actors.size() < things.size()) actors.emplace_back(layers);
  for (std::size_t i = 0; i < actors.size(); ++i)
    actors[i].setContent(i < things.size() ? &things[i] : nullptr, more...);
}

}  // namespace

ContentActors::ContentActors(Layers& layers)
    : layers_(layers), faces_(layers), isolineLabels_(layers), plane_(vtkSmartPointer<vtkPlane>::New()) {}

void ContentActors::setContent(const Things& things, double diagonal, bool targetAfar) {
  things_ = &things;
  diagonal_ = diagonal;
  targetAfar_ = targetAfar;
  faces_.setContent(things.faces);
  share(layers_, targets_, things.targets);
  share(layers_, cuts_, things.rows);
  share(layers_, stations_, things.rows, diagonal);
  share(layers_, blocks_, things.stocks);
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
  }
  faces_.setStyle(style, background);
  cutOpen(faces_);
  for (StationLines& stations : stations_) {
    stations.setStyle(style, background);
    cutOpen(stations);
  }
  for (BlockActors& block : blocks_) {
    block.setStyle(style, diagonal_, background);
    cutOpen(block);
  }
}

std::vector<vtkSmartPointer<vtkActor>> ContentActors::solids() const {
  std::vector<vtkSmartPointer<vtkActor>> solids;
  for (const CutActors& cut : cuts_) solids.emplace_back(cut.solid());
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
                           double targetBehind) {
  const double size = 1.5 * millimetresPerPixel * style.pixelRatio + 0.0004 * diagonal_;
  const double line = -depthPerMillimetre * size;
  for (TargetActors& target : targets_) target.update(targetBehind, line);
  faces_.update(style, targetBehind, line);
  for (CutActors& cut : cuts_) cut.update(line);
  for (StationLines& stations : stations_) stations.update(style, line, millimetresPerPixel);
  for (BlockActors& block : blocks_) block.update(line);
}

}  // namespace bw::scene
