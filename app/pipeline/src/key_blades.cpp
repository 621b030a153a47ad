// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/key_blades.h"

#include <algorithm>
#include <cmath>

#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/shape/key_blades.h"
#include "bw/core/text/number_text.h"

namespace bw::pipeline {

namespace {

/// A curve in a plane whose x runs the other way, run backwards: from its least x on where it was before.
Result<PlanarCurve> seenFromBehind(const PlanarCurve& curve) {
  std::vector<Eigen::Vector2d> poles = curve.poles();
  for (Eigen::Vector2d& pole : poles) pole.x() = -pole.x();
  Result<PlanarCurve> mirrored = [&] {
    switch (curve.kind()) {
      case PlanarCurve::Kind::bezier:
        return PlanarCurve::bezier(std::move(poles));
      case PlanarCurve::Kind::bspline:
        return PlanarCurve::bspline(curve.degree(), curve.knots(), std::move(poles), curve.weights());
      case PlanarCurve::Kind::points:
        break;
    }
    return PlanarCurve::points(std::move(poles));
  }();
  return mirrored && mirrored->value(mirrored->start()).x() > mirrored->value(mirrored->end()).x()
             ? mirrored->reversed()
             : mirrored;
}

struct FramedCurve {
  Frame frame;
  PlanarCurve curve;
};

Result<std::vector<FramedCurve>> sectionsOf(const CutEvaluation& cut) {
  if (!cut.sections.value || cut.sections.value->size() < 2)
    return fail(ErrorCode::badInput, "the cut " + cut.id + " has no sections to be told by blades", "cut");
  std::vector<FramedCurve> curves;
  for (const Section& section : *cut.sections.value) {
    if (section.chosen < 0)
      return fail(ErrorCode::badInput,
                  "section " + std::to_string(section.index) + " of the cut " + cut.id +
                      " is no single curve; give the cut a surface, or a block, that it meets in one",
                  "cut");
    curves.push_back({section.frame, section.curve()});
  }
  return curves;
}

/// The parts of the blades that cut, as they hang.
Result<std::vector<FramedCurve>> bladesOf(const CutEvaluation& cut) {
  constexpr int kPoints = 65;
  if (!cut.sweep.value || cut.sweep.value->poses.size() < 2)
    return fail(ErrorCode::badInput, "the cut " + cut.id + " has no blades yet", "cut");
  if (cut.middle.value)
    return fail(ErrorCode::badInput,
                "the blades of the cut " + cut.id +
                    " do not lie in the surface that is asked for; adopt it with a kerf and an offset of 0",
                "kerf");
  std::vector<FramedCurve> curves;
  for (const BladePose& pose : cut.sweep.value->poses) {
    const std::vector<double> arcs = pose.cutArcs(kPoints);
    std::vector<Elastica::State> states(arcs.size());
    pose.at(arcs, states);
    std::vector<Eigen::Vector2d> points;
    for (const Elastica::State& state : states) points.push_back(state.point);
    const Result<PlanarCurve> curve = cubicSplineThrough(points);
    if (!curve) return tl::unexpected<Error>(curve.error());
    curves.push_back({pose.frame, *curve});
  }
  return curves;
}

/// A blade so far beyond another that numbers go on evenly.
KeyBlade beyond(const KeyBlade& blade, const KeyBlade& change, double way) {
  return {blade.y + way,
          blade.middle + way * change.middle,
          blade.angle + way * change.angle,
          blade.length + way * change.length,
          blade.bend + way * change.bend,
          blade.force + way * change.force,
          blade.turn + way * change.turn};
}

/// Sections stand a little inside of the faces of the block; the surface reaches them where it did. `before`
/// and `after` are how far the first and the last blade stand from them.
void reach(std::vector<KeyBlade>& blades, double before, double after) {
  constexpr double kMost = 1;  // mm
  const Result<BladeSweep> sweep = BladeSweep::through(blades);
  if (!sweep) return;
  KeyBlade &first = blades.front(), &last = blades.back();
  if (before > 0 && before < kMost) first = beyond(first, sweep->changeAt(sweep->from()), -before);
  if (after > 0 && after < kMost) last = beyond(last, sweep->changeAt(sweep->to()), after);
}

/// The frame whose y is the travel and whose z is up in the planes of the sections; that of the design where
/// these are the same.
DesignedSurface frameAcross(const Frame& plane) {
  DesignedSurface surface;
  Eigen::Matrix3d axes;
  axes << -plane.x, plane.normal, plane.y;
  constexpr double kSame = 1e-9;
  if ((axes - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kSame) return surface;
  surface.origin = plane.origin;
  surface.rotation = anglesFromRotation(axes);
  return surface;
}

}  // namespace

Result<CutKeyBlades> keyBladesOf(const CutEvaluation& cut, Told told, double tolerance,
                                 const RunContext& context) {
  const Result<std::vector<FramedCurve>> framed = told == Told::target ? sectionsOf(cut) : bladesOf(cut);
  if (!framed) return tl::unexpected<Error>(framed.error());
  if (cut.setup && cut.setup->planes.turns())
    return fail(ErrorCode::badInput,
                "the planes of the cut " + cut.id +
                    " turn; key blades are told from parallel ones. Give the cut a direction first",
                "cut");
  CutKeyBlades found;
  found.surface = frameAcross(framed->front().frame);
  const Eigen::Matrix3d axes = rotationFromAngles(found.surface.rotation);
  std::vector<PlacedCurve> curves;
  for (const auto& [frame, own] : *framed) {
    const Eigen::Vector3d place = axes.transpose() * (frame.origin - found.surface.origin);
    const Result<PlanarCurve> curve = seenFromBehind(own);
    if (!curve) return tl::unexpected<Error>(curve.error());
    // Places as a person reads them; none moves by more than 1e-9 mm.
    const double y = std::round(place.y() * 1e9) / 1e9;
    curves.push_back({y, curve->transformed(0, 1, {place.x(), place.z()})});
  }
  Result<FewestBlades> fewest = fewestBlades(curves, tolerance, context);
  if (!fewest) return tl::unexpected<Error>(fewest.error());
  if (cut.setup) {
    const PlaneFamily& planes = cut.setup->planes;
    reach(fewest->blades, planes.travel(planes.level(framed->front().frame.origin)),
          planes.exit - planes.level(framed->back().frame.origin));
  }
  found.deviation = fewest->deviation;
  found.worst = curves[fewest->worst].y;
  found.surface.shape = BladesSurface{std::move(fewest->blades)};
  return found;
}

Result<Design> withSurface(const Evaluation& evaluation, const std::string& id, DesignedSurface surface) {
  Design design = evaluation.design;
  const CutEvaluation* made = evaluation.find(id);
  const auto cut = std::ranges::find(design.cuts, id, &Cut::id);
  if (!made || cut == design.cuts.end())
    return fail(ErrorCode::badInput, "there is no cut \"" + id + "\"", "cut");
  const bool shared = std::ranges::any_of(
      design.cuts, [&](const Cut& other) { return other.id != id && other.source == cut->source; });
  if (shared) {
    Source own;
    for (int k = 1; own.id.empty() || design.find(own.id); ++k) own.id = "blades-" + std::to_string(k);
    cut->source = own.id;
    own.surface = std::move(surface);
    design.sources.push_back(std::move(own));
  } else {
    Source& source = design.sourceOf(*cut);
    source = {.id = source.id};
    source.surface = std::move(surface);
  }
  cut->face = {};
  if (made->setup && !cut->direction) cut->direction = made->setup->planes.direction();
  for (StockBlock& block : design.stock)
    if (block.id == cut->block && !block.placement && made->setup && cut->pose == CutPose{})
      block.placement = placementOf(made->setup->block);
  // Expressions of numbers that are no longer there.
  const std::string gone = "/sources/" + std::to_string(&design.sourceOf(*cut) - design.sources.data()) + "/";
  std::erase_if(design.bindings, [&](const auto& bound) { return bound.first.starts_with(gone); });
  return design;
}

}  // namespace bw::pipeline
