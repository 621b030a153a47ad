// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/key_blades.h"

#include <algorithm>
#include <cmath>

#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/shape/blade_ends.h"
#include "bw/core/shape/key_blades.h"
#include "bw/core/shape/turned_blades.h"
#include "bw/core/shape/turning_planes.h"
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
  double travel = 0;
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
    curves.push_back({section.frame, section.travel, section.curve()});
  }
  return curves;
}

/// Sections in the planes of the cut and in others between these: sections far apart say little of what
/// numbers do between them, and where planes turn, those of key blades are none of them.
Result<std::vector<Section>> closeSectionsOf(const CutEvaluation& cut, const RunContext& context) {
  constexpr int kLeast = 80;  // distances between them
  if (const Result<std::vector<FramedCurve>> own = sectionsOf(cut); !own)
    return tl::unexpected<Error>(own.error());
  const int apart = int(cut.sections.value->size()) - 1, parts = std::max(2, (kLeast + apart - 1) / apart);
  SectionRequest request;
  request.stations = std::min(apart * parts + 1, SectionRequest::kMost);
  request.route = cut.sections.request.sections.route;
  Findings findings;
  Result<std::vector<Section>> sections =
      geometry::cutSections(*cut.target.value, *cut.setup, request, context.child(0, 0.2), findings);
  if (!sections) return sections;
  for (const Section& section : *sections)
    if (section.chosen < 0)
      return fail(ErrorCode::badInput,
                  "between its stations, " + shortText(section.travel, 6) +
                      " mm along the travel, the section of the cut " + cut.id +
                      " is no single curve; give the cut a surface, or a block, that it meets in one",
                  "cut");
  return sections;
}

Result<std::vector<FramedCurve>> closeCurvesOf(const CutEvaluation& cut, const RunContext& context) {
  const Result<std::vector<Section>> sections = closeSectionsOf(cut, context);
  if (!sections) return tl::unexpected<Error>(sections.error());
  std::vector<FramedCurve> curves;
  for (const Section& section : *sections) curves.push_back({section.frame, section.travel, section.curve()});
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
    curves.push_back({pose.frame, pose.travel, *curve});
  }
  return curves;
}

/// Sections stand a little inside of the faces of the block; the surface reaches them where it did. `before`
/// and `after` are how far the first and the last blade stand from them.
void reach(std::vector<KeyBlade>& blades, double before, double after) {
  constexpr double kMost = 1;  // mm
  const Result<BladeSweep> sweep = BladeSweep::through(blades);
  if (!sweep) return;
  KeyBlade &first = blades.front(), &last = blades.back();
  if (before > 0 && before < kMost) first = bladeBeyond(first, sweep->changeAt(sweep->from()), -before);
  if (after > 0 && after < kMost) last = bladeBeyond(last, sweep->changeAt(sweep->to()), after);
}

/// How far blades in planes that turn go on, where the row ends so far inside of the block: to the plane that
/// touches it, and a little beyond where that is the last of the row.
double reachOf(double left) {
  constexpr double kMost = 1, kTouches = 1e-3, kBeyond = 0.5;  // mm
  if (!(left < kMost)) return 0;
  return std::max(left, 0.0) + (left < kTouches ? kBeyond : 0);
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

/// The points of what is cut, in rows along the blade at every station and between these.
std::vector<std::vector<Eigen::Vector3d>> linesOf(const SurfaceGrid& grid) {
  constexpr int kMostRows = 480, kMostColumns = 64;
  const auto thinned = [](int count, int most) {
    const int step = (count - 1 + most - 1) / most;
    std::vector<int> kept;
    for (int k = 0; k < count - 1; k += step) kept.push_back(k);
    kept.push_back(count - 1);
    return kept;
  };
  std::vector<std::vector<Eigen::Vector3d>> rows;
  for (const int r : thinned(grid.rows, kMostRows)) {
    std::vector<Eigen::Vector3d> row;
    for (const int c : thinned(grid.columns, kMostColumns)) row.push_back(grid.at(r, c));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// What places of a surface, in the frame of key blades that do not turn, lie off the blade in their plane.
struct OffBlades {
  double distance = 0;  ///< mm, the largest
  double y = 0;         ///< there
};
Result<OffBlades> offBlades(const std::vector<KeyBlade>& blades,
                            const std::vector<std::vector<Eigen::Vector3d>>& lines) {
  constexpr int kPoints = 257;
  constexpr std::size_t kEvery = 4;
  const Result<BladeSweep> sweep = BladeSweep::through(blades);
  if (!sweep) return tl::unexpected<Error>(sweep.error());
  OffBlades off;
  for (const std::vector<Eigen::Vector3d>& line : lines)
    for (std::size_t k = 0; k < line.size(); k += kEvery) {
      const Eigen::Vector3d& place = line[k];
      if (place.y() < sweep->from() || place.y() > sweep->to()) continue;
      const Result<Elastica> blade = elasticaOf(sweep->at(place.y()));
      if (!blade) return tl::unexpected<Error>(blade.error());
      const Result<PlanarCurve> chain = PlanarCurve::points(blade->sample(kPoints));
      if (!chain) return tl::unexpected<Error>(chain.error());
      const Eigen::Vector2d p(place.x(), place.z());
      const double distance = (chain->value(chain->nearestParameter(p)) - p).norm();
      if (distance > off.distance) off = {distance, place.y()};
    }
  return off;
}

/// Of a cut whose planes are parallel.
Result<CutKeyBlades> parallelBladesOf(const CutEvaluation& cut, Told told, double tolerance,
                                      const RunContext& context) {
  const Result<std::vector<FramedCurve>> framed =
      told == Told::target ? closeCurvesOf(cut, context) : bladesOf(cut);
  if (!framed) return tl::unexpected<Error>(framed.error());
  CutKeyBlades found;
  found.surface = frameAcross(framed->front().frame);
  const Eigen::Matrix3d axes = rotationFromAngles(found.surface.rotation);
  std::vector<PlacedCurve> curves;
  for (const auto& [frame, travel, own] : *framed) {
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
  if (told == Told::cut && cut.analysis.value) {
    // Blades are known at the stations; between them there is what they cut.
    std::vector<std::vector<Eigen::Vector3d>> lines = linesOf(cut.analysis.value->cut);
    for (std::vector<Eigen::Vector3d>& line : lines)
      for (Eigen::Vector3d& place : line) place = axes.transpose() * (place - found.surface.origin);
    const Result<OffBlades> off = offBlades(fewest->blades, lines);
    if (!off) return tl::unexpected<Error>(off.error());
    if (off->distance > found.deviation) {
      found.deviation = off->distance;
      found.worst = off->y;
    }
  }
  found.surface.shape = BladesSurface{std::move(fewest->blades)};
  return found;
}

/// Rows of a cut whose planes turn, in the frame of the surface that is to tell it.
class TurnedRows {
 public:
  explicit TurnedRows(const CutEvaluation& cut)
      : cut_(cut),
        surface_(frameAcross(cut.setup->planes.frame)),
        own_(rotationFromAngles(surface_.rotation).transpose()) {}

  const DesignedSurface& surface() const { return surface_; }
  Eigen::Vector3d placeOf(const Eigen::Vector3d& place) const { return own_ * (place - surface_.origin); }

  Result<TurnedRow> through(const std::vector<FramedCurve>& framed) const {
    TurnedRow row;
    for (const auto& [frame, travel, planar] : framed) {
      const Eigen::Vector3d place = placeOf(frame.origin), along = own_ * -frame.x;
      const Result<PlanarCurve> curve = seenFromBehind(planar);
      if (!curve) return tl::unexpected<Error>(curve.error());
      row.curves.push_back(
          {place.head<2>(), std::atan2(along.y(), along.x()), curve->transformed(0, 1, {0, place.z()})});
    }
    const Box& block = cut_.block();
    row.block = {
        {placeOf(block.frame.origin), own_ * block.frame.x, own_ * block.frame.y, own_ * block.frame.normal},
        block.size};
    const PlaneFamily& planes = cut_.setup->planes;
    row.before = reachOf(framed.front().travel);
    row.after = reachOf(planes.travel(planes.exit) - framed.back().travel);
    return row;
  }

 private:
  const CutEvaluation& cut_;
  DesignedSurface surface_;
  Eigen::Matrix3d own_;
};

/// Of a cut whose planes turn: of key blades that turn, whose planes are those of the cut at the keys.
Result<FewestTurnedBlades> turnedTargetOf(const CutEvaluation& cut, const TurnedRows& rows, double tolerance,
                                          const RunContext& context) {
  constexpr double kReach = 1e5;  // mm: all of a surface
  Result<std::vector<Section>> sections = closeSectionsOf(cut, context);
  if (!sections) return tl::unexpected<Error>(sections.error());
  if (Result<void> ok = geometry::followBeyond(*cut.target.value, *cut.setup, kReach, *sections, context);
      !ok)
    return tl::unexpected<Error>(ok.error());
  // From side to side of the surface, where what is elastica has numbers that run evenly; else in the block.
  Result<FewestTurnedBlades> best = fail(ErrorCode::internal, "no sections are told");
  for (const bool whole : {true, false}) {
    std::vector<FramedCurve> framed;
    for (const Section& section : *sections)
      if (!whole || section.beyond)
        framed.push_back({section.frame, section.travel, whole ? *section.beyond : section.curve()});
    if (framed.size() < sections->size()) continue;
    const Result<TurnedRow> row = rows.through(framed);
    if (!row) return tl::unexpected<Error>(row.error());
    Result<FewestTurnedBlades> found = fewestTurnedBlades(*row, tolerance, context.child(0.2, 1));
    if (context.stopped()) return stoppedError();
    if (!best || (found && found->deviation < best->deviation)) best = std::move(found);
    if (best && best->deviation <= tolerance) break;
  }
  return best;
}

Result<FewestTurnedBlades> turnedCutOf(const CutEvaluation& cut, const TurnedRows& rows, double tolerance,
                                       const RunContext& context) {
  const Result<std::vector<FramedCurve>> framed = bladesOf(cut);
  if (!framed) return tl::unexpected<Error>(framed.error());
  if (!cut.analysis.value)
    return fail(ErrorCode::badInput, "the cut " + cut.id + " has no surface that its blades cut yet", "cut");
  Result<TurnedRow> row = rows.through(*framed);
  if (!row) return tl::unexpected<Error>(row.error());
  row->between = linesOf(cut.analysis.value->cut);
  for (std::vector<Eigen::Vector3d>& places : row->between) {
    for (Eigen::Vector3d& place : places) place = rows.placeOf(place);
    if (places.front().x() > places.back().x()) std::ranges::reverse(places);
  }
  return fewestTurnedBlades(*row, tolerance, context);
}

}  // namespace

Result<CutKeyBlades> keyBladesOf(const CutEvaluation& cut, Told told, double tolerance,
                                 const RunContext& context) {
  if (!cut.setup || !cut.setup->planes.turns()) return parallelBladesOf(cut, told, tolerance, context);
  const TurnedRows rows(cut);
  Result<FewestTurnedBlades> fewest =
      (told == Told::target ? turnedTargetOf : turnedCutOf)(cut, rows, tolerance, context);
  if (!fewest) return tl::unexpected<Error>(fewest.error());
  CutKeyBlades found{rows.surface(), fewest->deviation, fewest->worst, fewest->turnedOff};
  found.surface.shape = BladesSurface{std::move(fewest->blades)};
  return found;
}

Result<Design> withSurface(const Evaluation& evaluation, const std::string& id, DesignedSurface surface) {
  Design design = evaluation.design;
  const CutEvaluation* made = evaluation.find(id);
  const auto cut = std::ranges::find(design.cuts, id, &Cut::id);
  if (!made || cut == design.cuts.end())
    return fail(ErrorCode::badInput, "there is no cut \"" + id + "\"", "cut");
  const bool turns = planesOf(surface).has_value();
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
  // Planes that turn are those of the key blades as long as the cut has no direction.
  if (made->setup && !cut->direction && !turns) cut->direction = made->setup->planes.direction();
  for (StockBlock& block : design.stock)
    if (block.id == cut->block && !block.placement && made->setup && cut->pose == CutPose{})
      block.placement = placementOf(made->block());
  // Expressions of numbers that are no longer there.
  const std::string gone = "/sources/" + std::to_string(&design.sourceOf(*cut) - design.sources.data()) + "/";
  std::erase_if(design.bindings, [&](const auto& bound) { return bound.first.starts_with(gone); });
  return design;
}

}  // namespace bw::pipeline
