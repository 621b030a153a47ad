// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/kerf.h"

#include <utility>

#include "sweep/standing.h"

namespace bw {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

class Moved final : public SurfaceSampler {
 public:
  Moved(std::unique_ptr<SurfaceSampler> surface, double off) : surface_(std::move(surface)), off_(off) {}

  Result<Foot> closest(const Vector3d& p, const Foot* seed) override { return surface_->closest(p, seed); }
  Result<SurfaceJet> at(int face, const Vector2d& uv) const override { return surface_->at(face, uv); }
  double offset(const Vector3d& p, const Foot& foot) const override {
    return surface_->offset(p, foot) - off_;
  }
  std::unique_ptr<SurfaceSampler> clone() const override {
    return std::make_unique<Moved>(surface_->clone(), off_);
  }

 private:
  std::unique_ptr<SurfaceSampler> surface_;
  double off_;
};

}  // namespace

std::unique_ptr<SurfaceSampler> movedBy(std::unique_ptr<SurfaceSampler> surface, double off) {
  if (off == 0) return surface;
  return std::make_unique<Moved>(std::move(surface), off);
}

SurfaceGrid standingBeside(SurfaceGrid swept, const Kerf& kerf) {
  if (kerf.width == 0) return swept;
  return sweep::standing(std::move(swept), kerf.kept, [&kerf](const Vector3d&) { return kerf.width; });
}

}  // namespace bw
