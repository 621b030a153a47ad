// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "knife.h"

#include <BRepTools.hxx>

#include <cmath>

#include "bw/core/text/number_text.h"
#include "bw/geometry/cad_model.h"
#include "model_impl.h"
#include "occt.h"
#include "spline_face.h"

namespace bw::geometry {

namespace {

constexpr double kBorder = 1e-6;   // of the range of a parameter: so near to its end is the border
constexpr double kDecided = 0.05;  // of the mean normal along the kept side: below it no side is meant

Error ofCut(const std::string& id, Error error) {
  error.message = "cut \"" + id + "\": " + error.message;
  error.where = id;
  return error;
}

}  // namespace

Result<Knife> Knife::make(const PartCut& cut) {
  BW_CHECK(cut.surface != nullptr);
  if (!cut.kept.allFinite() || !(cut.kept.norm() > 0))
    return fail(ErrorCode::badInput,
                "cut \"" + cut.id + "\" does not say which side stays; give it a direction that is not zero",
                cut.id);
  const Result<CadModel> model = CadModel::of(*cut.surface, "cut \"" + cut.id + "\"");
  if (!model) return tl::unexpected(ofCut(cut.id, model.error()));
  const Result<Target> target = Target::make(*model, {});
  if (!target) return tl::unexpected(ofCut(cut.id, target.error()));
  const double towards = target->impl().meanNormal.dot(cut.kept.normalized());
  if (!(std::abs(towards) >= kDecided))
    return fail(ErrorCode::badInput,
                "it is not decided which side of cut \"" + cut.id +
                    "\" stays: its surface looks to that side by " + shortText(towards) +
                    " only, where ±1 is straight and " + shortText(kDecided) +
                    " the least; give a direction more across the surface",
                cut.id, towards, kDecided);
  Knife knife;
  knife.id_ = cut.id;
  knife.face_ = faceOf(*cut.surface);
  knife.outward_ = towards > 0 ? 1 : -1;
  knife.forward_ = (towards > 0) != target->impl().flipped;
  knife.sampler_ = target->sampler();
  return knife;
}

Result<Knife::Place> Knife::place(const Eigen::Vector3d& p, const SurfaceSampler::Foot* near) const {
  const Result<SurfaceSampler::Foot> foot = sampler_->closest(p, near);
  if (!foot) return tl::unexpected(ofCut(id_, foot.error()));
  const double side = outward_ * (p - foot->point).dot(foot->normal);
  return Place{foot->distance, foot->onBoundary ? side : std::copysign(foot->distance, side), *foot};
}

bool Knife::atBorder(const Place& place) const {
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  BRepTools::UVBounds(face_, u0, u1, v0, v1);
  const Eigen::Vector2d& uv = place.foot.uv;
  const double du = kBorder * (u1 - u0), dv = kBorder * (v1 - v0);
  return place.beside() || uv.x() < u0 + du || uv.x() > u1 - du || uv.y() < v0 + dv || uv.y() > v1 - dv;
}

}  // namespace bw::geometry
