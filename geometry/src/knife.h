// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <TopoDS_Face.hxx>

#include <memory>
#include <string>

#include "bw/core/surface/surface_sampler.h"
#include "bw/geometry/part.h"

namespace bw::geometry {

/// A cut that is ready to be made.
class Knife {
 public:
  /// Errors (`badInput`, with the id): numbers of the surface that do not fit; a side to be kept that is no
  /// direction, or along which the surface does not look.
  static Result<Knife> make(const PartCut& cut);

  const std::string& id() const { return id_; }
  const TopoDS_Face& face() const { return face_; }
  /// Whether du × dv of the surface looks to what stays.
  bool forward() const { return forward_; }

  /// How a point lies to the surface.
  struct Place {
    double distance = 0;        ///< mm
    double height = 0;          ///< mm along the surface's normal, positive towards what stays
    SurfaceSampler::Foot foot;  ///< the closest point
    bool beside() const { return foot.onBoundary; }  ///< it is the border that is closest
  };
  /// `near` is the foot of a point nearby, or null. Errors: those of `SurfaceSampler::closest`.
  Result<Place> place(const Eigen::Vector3d& p, const SurfaceSampler::Foot* near) const;
  /// Whether the closest point lies on the border, be it beside or straight above it.
  bool atBorder(const Place& place) const;

 private:
  std::string id_;
  TopoDS_Face face_;
  bool forward_ = true;
  double outward_ = 1;  ///< +1 if the sampler's outer side is what stays, −1 if not
  std::unique_ptr<SurfaceSampler> sampler_;
};

}  // namespace bw::geometry
