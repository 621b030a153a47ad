// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/section_actors.h"

#include <vtkRenderer.h>

#include "scene/actors/section_cap.h"

namespace bw::scene {

namespace {

constexpr double kHatchShare = 0.016;  ///< distance of the hatching, in diagonals

}  // namespace

SectionActors::SectionActors() : plane_(vtkSmartPointer<vtkPlane>::New()) {
  for (Part* part : {&fill_, &hatch_, &cut_, &outline_}) part->setFlat();
}

void SectionActors::addTo(vtkRenderer* renderer) {
  for (Part* part : {&fill_, &hatch_, &outline_, &cut_}) renderer->AddActor(part->actor());
}

void SectionActors::setSection(const Content& content, const TriangleMesh& cutMesh,
                               const std::optional<SectionPlane>& plane, std::span<Part* const> clipped,
                               double diagonal) {
  const bool changed = !valid_ || section_ != plane;
  const bool switched = section_.has_value() != plane.has_value();
  section_ = plane;
  valid_ = true;
  if (switched) {
    for (Part* part : clipped) {
      part->mapper()->RemoveAllClippingPlanes();
      if (section_) part->mapper()->AddClippingPlane(plane_);
    }
  }
  if (changed) {
    for (Part* part : {&fill_, &hatch_, &cut_, &outline_}) part->clear();
    if (section_) {
      // VTK keeps what its planes' normals point to.
      const Eigen::Vector3d kept = -section_->normal;
      plane_->SetOrigin(section_->point.data());
      plane_->SetNormal(kept.data());
      const SectionCap cap =
          sectionCap(content.block.value_or(Box{}), cutMesh, *section_, kHatchShare * diagonal);
      if (content.block && cap.outline.size() >= 3) {
        fill_.setPolygons({cap.outline});
        Polyline closed = cap.outline;
        closed.push_back(closed.front());
        outline_.setLines({closed});
        hatch_.setSegments(cap.hatch);
      }
      cut_.setSegments(cap.cut);
    }
  }
}

void SectionActors::setStyle(const Content& content, const Style& style, const Rgb& background) {
  if (!section_) return;
  const Theme& colors = theme(style.dark);
  const double keep = keptColor(style.stale), px = style.pixelRatio;
  const bool foamShown = style.showBlock && content.block.has_value();
  for (Part* part : {&fill_, &hatch_, &outline_}) part->setVisible(foamShown);
  cut_.setVisible(style.showCut);
  const Rgb fill = mix(background, colors.foam, style.dark ? 0.22 : 0.7);
  fill_.setColor(fill);
  hatch_.setColor(mix(fill, colors.secondary, 0.38));
  outline_.setColor(colors.foamEdge);
  cut_.setColor(colors.text);
  hatch_.setLineWidth(px);
  outline_.setLineWidth(px);
  cut_.setLineWidth(2 * px);
  for (Part* part : {&fill_, &hatch_, &cut_, &outline_}) part->setFade(keep, background);
}

void SectionActors::update(double line) {
  hatch_.setDepthShift(0.5 * line);
  for (Part* part : {&cut_, &outline_}) part->setDepthShift(line);
}

}  // namespace bw::scene
