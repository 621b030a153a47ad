// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <Standard_Failure.hxx>

#include <algorithm>
#include <cmath>

#include "bw/geometry/cad_model.h"
#include "bw/geometry/sections.h"
#include "model_impl.h"

namespace bw::geometry {

namespace {

constexpr int kAcross = 5;            // sections of a face in each main direction
constexpr int kCurvatureProbes = 33;  // points of a section

/// The height of an arc of this curvature over a chord as long as the face.
double rise(double curvature, double size) { return std::abs(curvature) * size * size / 8; }

void addBending(const FaceGeometry& geometry, FaceInfo& face) {
  const CurvatureRange range = geometry.curvatureRange();
  face.curvatureMin = range.min;
  face.curvatureMax = range.max;
  const double size = face.bounds.size().norm(), greater = std::max(std::abs(range.min), std::abs(range.max));
  face.curved = rise(greater, size) <= kCurvedTolerance        ? "flat"
                : rise(range.lesser, size) <= kCurvedTolerance ? "singly"
                                                               : "doubly";
  face.minRadius = greater > 0 ? 1 / greater : 0;
}

/// Sections across the main directions of the block that the face alone would get.
void addSections(const CadModel& model, FaceInfo& face, const RunContext& context) {
  const auto target = Target::make(model, {FaceChoice::Kind::indices, {face.index}});
  if (!target) return;
  Findings ignored;
  auto setup = resolveSetup(*target, {}, ignored);
  if (!setup) return;
  RunContext alone;
  alone.stop = context.stop;
  alone.threads = 1;
  for (const Eigen::Vector3d& direction : {setup->block.frame.x, setup->block.frame.y}) {
    setup->direction = direction;
    const auto sections = cutSections(*target, *setup, {kAcross, {}}, alone, ignored);
    if (!sections) continue;
    FaceSections facts;
    facts.direction = direction;
    facts.shortest = 1e300;
    double tightest = 0;
    for (const Section& section : *sections) {
      if (section.chosen < 0) continue;
      const PlanarCurve& curve = section.curve();
      const double length = curve.length();
      facts.shortest = std::min(facts.shortest, length);
      facts.longest = std::max(facts.longest, length);
      const double from = curve.start(), step = (curve.end() - from) / (kCurvatureProbes - 1);
      for (int i = 0; i < kCurvatureProbes; ++i) {
        const double curvature = std::abs(curve.curvature(from + i * step));
        if (std::isfinite(curvature)) tightest = std::max(tightest, curvature);
      }
    }
    facts.minRadius = tightest > 0 ? 1 / tightest : 0;
    face.sections.push_back(facts);
  }
}

}  // namespace

Result<CadInfo> CadModel::infoInFull(const RunContext& context) const {
  CadInfo info = impl_->info;
  const auto done = parallelFor(context, int(info.faceList.size()), [&](int i) {
    FaceInfo& face = info.faceList[i];
    if (!impl_->faces[i]) return;
    try {
      addBending(*impl_->faces[i], face);
      addSections(*this, face, context);
    } catch (const Standard_Failure&) {
      // A surface without second derivatives keeps a range of zero.
    }
  });
  if (!done) return tl::unexpected(done.error());
  return info;
}

}  // namespace bw::geometry
