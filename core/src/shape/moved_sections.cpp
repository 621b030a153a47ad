// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/shape/moved_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "bw/core/sweep/kerf.h"
#include "bw/core/text/number_text.h"
#include "shape/shapes.h"

namespace bw {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kPlaces = 96;  // of a section, at least
constexpr int kMostPlaces = 4000;
constexpr int kSpan = 4;         // places of each span of its spline
constexpr int kSteps = 12;       // of Newton's method
constexpr double kThere = 1e-5;  // mm
constexpr double kAlong = 0.02;  // of a unit normal: less of it in the plane, and the surface runs along that
constexpr double kLeastOut = 1e-3;  // mm: nothing of the cut shows it
constexpr int kChunks = 16;         // of the sections, each with a sampler of its own
constexpr double kFarthest = 50;    // times the reach, that a place is moved within its plane

tl::unexpected<Error> cannot(const std::string& why, double value, double reach) {
  return fail(ErrorCode::badInput,
              why + ", so that no blade keeps the " + shortText(reach) +
                  " mm off it that kerf and offset ask for; ease the surface, make these smaller, or choose "
                  "another cutting direction",
              "kerf", value, reach);
}

Result<PlanarCurve> moved(const Frame& frame, const PlanarCurve& curve, SurfaceSampler& surface,
                          double reach) {
  const int count = std::clamp(kSpan * int(curve.knots().size()), kPlaces, kMostPlaces) + 1;
  const double length = curve.length();
  std::vector<Vector2d> places;
  std::vector<double> at;
  std::optional<SurfaceSampler::Foot> seed;
  for (int k = 0; k < count; ++k) {
    const double t = curve.parameterAt(length * k / (count - 1));
    const Vector2d from = curve.value(t), tangent = curve.tangent(t);
    const Vector2d across(-tangent.y(), tangent.x());
    double by = 0;
    Vector2d place = from;
    for (int step = 0;; ++step) {
      const Vector3d p = frame.toWorld(place);
      const Result<SurfaceSampler::Foot> foot = surface.closest(p, seed ? &*seed : nullptr);
      if (!foot) return tl::unexpected<Error>(foot.error());
      seed = *foot;
      const double left = -surface.offset(p, *foot);
      if (std::abs(left) < kThere) break;
      const double slope = foot->normal.dot(frame.x) * across.x() + foot->normal.dot(frame.y) * across.y();
      if (std::abs(slope) < kAlong)
        return cannot("the surface runs along the plane of the blade", std::abs(slope), reach);
      by += left / slope;
      if (step == kSteps || !(std::abs(by) < kFarthest * reach))
        return cannot("no place beside the surface is found there", std::abs(by), reach);
      place = from + by * across;
    }
    if (!places.empty()) {
      // Where the section is bent more tightly than it is moved, neighbours change places.
      const Vector2d step = place - places.back();
      if (step.dot(tangent) <= 0)
        return cannot("the section is bent too tightly", 1 / std::max(std::abs(curve.curvature(t)), 1e-12),
                      reach);
      at.push_back(at.back() + step.norm());
    } else {
      at.push_back(0);
    }
    places.push_back(place);
  }
  constexpr int kDegree = 3;
  const shape::SplineInterpolation spline(at, kDegree);
  spline.solve(places.data(), 1);
  return PlanarCurve::bspline(kDegree, spline.knots(), std::move(places));
}

/// How far a row has to go on before its first section (`way` −1) or behind its last one (1) for what stands
/// to begin in the plane of that, as levels of the family.
Result<double> wayOut(const Section& section, const PlaneFamily& planes, SurfaceSampler& surface, double half,
                      int kept, int way) {
  const double level = planes.level(section.frame.origin);
  double most = 0;
  std::optional<SurfaceSampler::Foot> seed;
  for (const Vector2d& local : section.curve().sample(kPlaces + 1)) {
    const Vector3d place = section.frame.toWorld(local);
    const Result<SurfaceSampler::Foot> foot = surface.closest(place, seed ? &*seed : nullptr);
    if (!foot) return tl::unexpected<Error>(foot.error());
    seed = *foot;
    const double back = -way * half * kept * foot->normal.dot(section.frame.normal);
    most = std::max(most, back / std::max(planes.speed(level, place), kAlong));
  }
  return most;
}

/// A frame that is carried with the planes of a family from one level to another one.
Frame carried(Frame frame, const PlaneFamily& planes, double from, double to) {
  if (!planes.turns()) {
    frame.origin += (to - from) * planes.direction();
    return frame;
  }
  const Frame before = planes.at(from), after = planes.at(to);
  const auto turned = [&](const Vector3d& v) -> Vector3d {
    return v.dot(before.x) * after.x + v.dot(before.y) * after.y + v.dot(before.normal) * after.normal;
  };
  return {after.origin + turned(frame.origin - before.origin), turned(frame.x), turned(frame.y),
          turned(frame.normal)};
}

}  // namespace

Result<std::vector<Section>> carriedOut(std::vector<Section> sections, const PlaneFamily& planes,
                                        SurfaceSampler& surface, double half, int kept) {
  const auto followed = [](const Section& section) { return section.chosen >= 0; };
  const auto first = std::ranges::find_if(sections, followed);
  const auto last = std::find_if(sections.rbegin(), sections.rend(), followed);
  if (half == 0 || first == sections.end() || &*first == &*last) return sections;
  const std::array<std::pair<Section*, int>, 2> ends = {{{&*first, -1}, {&*last, 1}}};
  for (const auto& [section, way] : ends) {
    const Result<double> out = wayOut(*section, planes, surface, half, kept, way);
    if (!out) return tl::unexpected<Error>(out.error());
    if (*out < kLeastOut) continue;
    const double level = planes.level(section->frame.origin);
    section->frame = carried(section->frame, planes, level, level + way * *out);
    section->travel += way * *out;
  }
  return sections;
}

Result<std::vector<Section>> movedBy(const std::vector<Section>& sections, const SurfaceSampler& surface,
                                     double off, const RunContext& context, Findings& findings) {
  if (off == 0) return sections;
  return sectionsOn(sections, *movedBy(surface.clone(), off), std::abs(off), context, findings);
}

Result<std::vector<Section>> sectionsOn(const std::vector<Section>& sections, const SurfaceSampler& surface,
                                        double reach, const RunContext& context, Findings& findings) {
  std::vector<Section> result = sections;
  std::vector<std::optional<Error>> errors(kChunks), refused(result.size());
  const Result<void> ok = parallelFor(context, kChunks, [&](int chunk) {
    const std::unique_ptr<SurfaceSampler> sampler = surface.clone();
    const std::size_t from = result.size() * std::size_t(chunk) / kChunks,
                      to = result.size() * std::size_t(chunk + 1) / kChunks;
    for (std::size_t i = from; i < to && !context.stopped(); ++i) {
      if (result[i].chosen < 0) continue;
      Section& section = result[i];
      Result<PlanarCurve> curve = moved(section.frame, section.curve(), *sampler, reach);
      if (curve) {
        section.curve() = std::move(*curve);
        if (!section.beyond) continue;
        // Beyond the block nothing is cut: where no place beside the surface is found it is not followed.
        if (Result<PlanarCurve> beyond = moved(section.frame, *section.beyond, *sampler, reach))
          section.beyond = std::move(*beyond);
        else
          section.beyond.reset();
      } else if (curve.error().code == ErrorCode::badInput) {
        refused[i] = curve.error();
      } else {
        errors[std::size_t(chunk)] = curve.error();
        return;
      }
    }
  });
  if (!ok) return tl::unexpected<Error>(ok.error());
  if (context.stopped()) return stoppedError();
  for (const std::optional<Error>& error : errors)
    if (error) return tl::unexpected<Error>(*error);
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (!refused[i]) continue;
    Section& section = result[i];
    const Vector3d point = section.frame.toWorld(section.curve().value(section.curve().start()));
    section.chosen = -1;
    if (i > 0 && refused[i - 1]) {
      StationRange& range = *findings.back().where.stations;
      range.last = section.index;
      ++range.count;
    } else {
      findings.push_back({Severity::warning,
                          SectionUnfit{refused[i]->message},
                          {StationRange::of(section.index), point},
                          {}});
    }
  }
  if (std::ranges::none_of(result, [](const Section& section) { return section.chosen >= 0; }))
    for (const std::optional<Error>& error : refused)
      if (error) return tl::unexpected<Error>(*error);
  return result;
}

}  // namespace bw
