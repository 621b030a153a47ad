// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/discrete/discrete_elastica.h"

#include <algorithm>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica_bvp.h"
#include "bw/core/text/number_text.h"
#include "discrete/angle_chain.h"
#include "optimise/bracketed_root.h"

namespace bw {
namespace {

using discrete::AngleChain;
using discrete::ChainSolution;
using Eigen::Vector2d;

constexpr int kFewest = 4, kMost = 2000;
/// Starts are tried and branches chosen with this many segments; more only refine.
constexpr int kCoarse = 60;
/// A chord this close to the length (relative) is a straight blade.
constexpr double kTaut = 1e-12;
constexpr double kSameAngle = 1e-9;
/// Energies this close (relative) are one: the earlier start wins.
constexpr double kSameEnergy = 1e-9;
constexpr double kLargest = 1e12;
/// Handles of a Bézier start, over the length, and how well it is made as long as the chain, relatively:
/// Newton's method does the rest.
constexpr double kShortestHandle = 1e-3, kLongestHandle = 2, kSketched = 1e-6;

double wrapped(double angle) { return std::remainder(angle, 2 * kPi); }

std::string text(double x) { return shortText(x, 6); }

Result<void> check(const ClampedEnds& ends, const DiscreteOptions& options) {
  const double numbers[] = {ends.start.x(), ends.start.y(),  ends.end.x(),
                            ends.end.y(),   ends.startAngle, ends.endAngle};
  for (const double x : numbers)
    if (!(std::abs(x) <= kLargest))
      return fail(ErrorCode::badInput, "the ends and their angles must be finite numbers", "start");
  if (!(ends.length > 0 && ends.length <= kLargest))
    return fail(ErrorCode::badInput, "the length must be greater than 0 mm", "length", ends.length, 0);
  if (options.segments < kFewest || options.segments > kMost)
    return fail(ErrorCode::badInput, "the number of segments must lie between 4 and 2000", "segments",
                options.segments, options.segments < kFewest ? kFewest : kMost);
  if (int(options.sketch.has_value()) + int(options.turningAngles.has_value()) +
          int(options.shape.has_value()) >
      1)
    return fail(ErrorCode::badInput,
                "give a sketch or initial turning angles or an initial elastica, not two of them", "initial");
  if (options.turning) {
    const double off = wrapped(*options.turning - (ends.endAngle - ends.startAngle));
    if (!(std::abs(off) < kSameAngle))
      return fail(ErrorCode::badInput,
                  "the total turning must equal the end angle less the start angle, up to whole turns",
                  "turning", *options.turning, *options.turning - off);
  }
  return {};
}

/// Directions at the middles of N segments of an angle function over [0, 1].
template <class Function>
std::vector<double> sampled(int segments, const Function& angle) {
  std::vector<double> angles;
  angles.reserve(std::size_t(segments));
  for (int i = 0; i < segments; ++i) angles.push_back(angle((i + 0.5) / segments));
  return angles;
}

/// The same chain with another number of segments, end tangents included.
std::vector<double> resampled(const AngleChain& chain, const std::vector<double>& angles, int segments) {
  const int n = int(angles.size());
  const auto value = [&](int i) {
    if (i < 0) return chain.halfEnds ? 2 * chain.startAngle - angles.front() : chain.startAngle;
    if (i >= n) return chain.halfEnds ? 2 * chain.endAngle - angles.back() : chain.endAngle;
    return angles[std::size_t(i)];
  };
  return sampled(segments, [&](double s) {
    const double at = s * n - 0.5;
    const int i = int(std::floor(at));
    return value(i) + (at - i) * (value(i + 1) - value(i));
  });
}

/// Directions of a curve between points of equal arc length, continuous, the first near `startAngle`.
std::vector<double> directions(const PlanarCurve& sketch, int segments, double startAngle) {
  const std::vector<Vector2d> points = sketch.sample(segments + 1);
  std::vector<double> angles;
  double before = startAngle;
  for (int i = 0; i < segments; ++i) {
    const Vector2d d = points[std::size_t(i) + 1] - points[std::size_t(i)];
    before += wrapped(std::atan2(d.y(), d.x()) - before);
    angles.push_back(before);
  }
  return angles;
}

/// Directions to start from, one a segment, and the tangents of the same curve at its ends.
struct Guide {
  std::vector<double> angles;
  double start = 0, end = 0;
};

/// Turns a guide a little along its length so that it begins and ends with the angles wanted.
std::vector<double> ledOnto(double startAngle, double endAngle, const Guide& guide) {
  std::vector<double> angles = guide.angles;
  const double atStart = startAngle - guide.start, atEnd = endAngle - guide.end;
  const double n = double(angles.size());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double s = (double(i) + 0.5) / n;
    angles[i] += atStart + s * (atEnd - atStart);
  }
  return angles;
}

/// Angles of a cubic Bézier curve with equal handles that has the length wanted, if there is one with the
/// turning wanted.
std::optional<std::vector<double>> bezierStart(const AngleChain& chain) {
  const auto curve = [&](double handle) {
    const Vector2d t0(std::cos(chain.startAngle), std::sin(chain.startAngle));
    const Vector2d t1(std::cos(chain.endAngle), std::sin(chain.endAngle));
    return PlanarCurve::bezier({Vector2d::Zero(), handle * t0, chain.chord - handle * t1, chain.chord});
  };
  const auto excess = [&](double handle) {
    const Result<PlanarCurve> sketch = curve(handle);
    return sketch ? sketch->length() - 1 : -1;
  };
  const optimise::RootBracket handle =
      optimise::bracketedRoot(excess, kShortestHandle, kLongestHandle, kSketched);
  if (handle.low == handle.high) return std::nullopt;
  const Result<PlanarCurve> sketch = curve(handle.high);
  if (!sketch) return std::nullopt;
  std::vector<double> angles = directions(*sketch, chain.segments, chain.startAngle);
  if (std::abs(angles.back() - chain.endAngle) > 0.5 * kPi) return std::nullopt;
  return angles;
}

/// The lowest minimum out of several starts, or the best that was reached.
ChainSolution bestOfStarts(const AngleChain& chain) {
  std::vector<std::vector<double>> starts;
  if (std::optional<std::vector<double>> bezier = bezierStart(chain)) starts.push_back(std::move(*bezier));
  const double slack = std::max(0.0, 1 - chain.chord.norm());
  // An S of this amplitude in the angle takes up the slack; an arch likewise.
  const double wave = std::min(2.0, 2 * std::sqrt(slack));
  const Vector2d waves[] = {{wave, 0}, {-wave, 0}, {0, wave}, {0, -wave}};
  for (const Vector2d& amplitude : waves)
    starts.push_back(sampled(chain.segments, [&](double s) {
      return chain.startAngle + s * (chain.endAngle - chain.startAngle) +
             amplitude.x() * std::sin(2 * kPi * s) + amplitude.y() * std::sin(kPi * s);
    }));
  ChainSolution best;
  int iterations = 0;
  for (std::vector<double>& start : starts) {
    ChainSolution found = solveChain(chain, std::move(start));
    iterations += found.iterations;
    const bool good = found.converged && found.minimum;
    if (good && (!best.converged || found.energy < best.energy * (1 - kSameEnergy))) best = std::move(found);
  }
  best.iterations = iterations;
  return best;
}

/// The directions of an elastica against `frame`, its start within half a turn of `startAngle`.
Guide guideAlong(const Elastica& blade, int segments, double frame, double startAngle) {
  const double own = blade.startAngle() - frame;
  const double shift = frame + 2 * kPi * std::round((own - startAngle) / (2 * kPi));
  Guide guide;
  guide.angles = sampled(segments, [&](double s) { return blade.at(s * blade.length()).angle - shift; });
  guide.start = blade.startAngle() - shift;
  guide.end = blade.at(blade.length()).angle - shift;
  return guide;
}

/// The blade at rest between the ends, or nothing where none was found. Of two mirror images the one to the
/// left of the chord, whose direction is `frame`.
std::optional<Guide> guideAtRest(const ClampedEnds& ends, const std::optional<double>& turning,
                                 const AngleChain& chain, double frame) {
  const Result<ClampedAnswer> rest =
      solveClamped({ends.start, ends.end, ends.startAngle, ends.endAngle, ends.length, turning});
  if (!rest || rest->kind == ClampedKind::straight) return std::nullopt;
  Guide guide = guideAlong(rest->solutions.front().elastica, chain.segments, frame, chain.startAngle);
  if (rest->kind == ClampedKind::buckling) {
    double rise = 0;
    for (std::size_t i = 0; i < guide.angles.size() / 2; ++i) rise += std::sin(guide.angles[i]);
    if (rise < 0)
      for (double& angle : guide.angles) angle = 2 * chain.startAngle - angle;
  }
  return guide;
}

DiscreteElastica assemble(const ClampedEnds& ends, const AngleChain& chain, double frame,
                          const ChainSolution& found) {
  DiscreteElastica result;
  result.ends = ends;
  result.held = chain.halfEnds ? DiscreteOptions::Ends::half : DiscreteOptions::Ends::tangent;
  const double segment = ends.length / chain.segments;
  Vector2d at = ends.start;
  result.vertices.push_back(at);
  for (const double angle : found.angles) {
    result.angles.push_back(angle + frame);
    at += segment * Vector2d(std::cos(angle + frame), std::sin(angle + frame));
    result.vertices.push_back(at);
  }
  result.closure = (at - ends.end).norm();
  if (chain.halfEnds) result.turningAngles.push_back(found.angles.front() - chain.startAngle);
  for (std::size_t i = 1; i < found.angles.size(); ++i)
    result.turningAngles.push_back(found.angles[i] - found.angles[i - 1]);
  if (chain.halfEnds) result.turningAngles.push_back(chain.endAngle - found.angles.back());
  for (const double turn : result.turningAngles) result.squaredTurning += turn * turn;
  result.energy = found.energy / ends.length;
  const double c = std::cos(frame), s = std::sin(frame);
  result.force =
      Vector2d(c * found.force.x() - s * found.force.y(), s * found.force.x() + c * found.force.y()) /
      (ends.length * ends.length);
  result.stable = found.minimum;
  result.iterations = found.iterations;
  return result;
}

}  // namespace

Result<DiscreteElastica> discreteElastica(const ClampedEnds& given, const DiscreteOptions& options) {
  if (Result<void> ok = check(given, options); !ok) return tl::unexpected<Error>(ok.error());
  ClampedEnds ends = given;
  const Vector2d across = ends.end - ends.start;
  const double chord = across.norm() / ends.length;
  const double frame = chord > 0 ? std::atan2(across.y(), across.x()) : ends.startAngle;
  AngleChain chain;
  chain.segments = options.segments;
  chain.halfEnds = options.ends == DiscreteOptions::Ends::half;
  chain.chord = Vector2d(chord, 0);
  const double plain = ends.endAngle - ends.startAngle;

  // The guide, as angles against the chord, and the total turning.
  std::optional<Guide> guide;
  chain.startAngle = ends.startAngle - frame;
  const bool guided = options.turningAngles || options.sketch || options.shape;
  if (options.turningAngles) {
    const std::size_t want = std::size_t(chain.segments + (chain.halfEnds ? 1 : -1));
    if (options.turningAngles->size() != want)
      return fail(ErrorCode::badInput,
                  std::to_string(chain.segments) + " segments held like this have " + std::to_string(want) +
                      " turning angles; " + std::to_string(options.turningAngles->size()) + " are given",
                  "initial", double(options.turningAngles->size()), double(want));
    guide.emplace();
    double angle = chain.startAngle;
    if (!chain.halfEnds) guide->angles.push_back(angle);
    for (const double turn : *options.turningAngles) {
      if (!std::isfinite(turn))
        return fail(ErrorCode::badInput, "the initial turning angles must be finite numbers", "initial");
      angle += turn;
      guide->angles.push_back(angle);
    }
    if (chain.halfEnds) guide->angles.pop_back();
    guide->start = chain.startAngle;
    guide->end = angle;
  } else if (options.sketch) {
    guide.emplace();
    guide->angles = directions(options.sketch->transformed(-frame, 1, Vector2d::Zero()), chain.segments,
                               chain.startAngle);
    guide->start = guide->angles.front();
    guide->end = guide->angles.back();
  } else if (options.shape) {
    guide = guideAlong(*options.shape, chain.segments, frame, chain.startAngle);
  } else {
    guide = guideAtRest(ends, options.turning, chain, frame);
  }
  double turning =
      chord > 0 ? wrapped(ends.endAngle - frame) - wrapped(ends.startAngle - frame) : wrapped(plain);
  if (guide) turning = plain + 2 * kPi * std::round((guide->end - chain.startAngle - plain) / (2 * kPi));
  if (options.turning) turning = *options.turning;
  chain.endAngle = chain.startAngle + turning;
  ends.endAngle = ends.startAngle + turning;

  const bool aligned = std::abs(wrapped(chain.startAngle)) < kSameAngle && std::abs(turning) < kSameAngle;
  if (chord > 1 + kTaut || (chord > 1 - kTaut && !aligned))
    return fail(ErrorCode::noSolution,
                "a blade of " + text(ends.length) + " mm cannot reach over " + text(chord * ends.length) +
                    " mm with these tangents; make it longer or bring its ends closer",
                "length", ends.length, chord * ends.length);
  if (chord > 1 - kTaut) {
    ChainSolution straight;
    straight.angles.assign(std::size_t(chain.segments), chain.startAngle);
    straight.converged = straight.minimum = true;
    return assemble(ends, chain, frame, straight);
  }
  if (!chain.halfEnds) {
    const double n = chain.segments;
    const Vector2d inner = chain.chord - (Vector2d(std::cos(chain.startAngle), std::sin(chain.startAngle)) +
                                          Vector2d(std::cos(chain.endAngle), std::sin(chain.endAngle))) /
                                             n;
    if (inner.norm() > (n - 2) / n)
      return fail(
          ErrorCode::noSolution,
          "with " + std::to_string(chain.segments) +
              " segments, of which the first and the last lie along the tangents, the others cannot span the "
              "rest; take more segments or ends \"half\"",
          "segments", chain.segments);
  }

  ChainSolution found;
  if (guide) found = solveChain(chain, ledOnto(chain.startAngle, chain.endAngle, *guide));
  if (!guided && !(found.converged && found.minimum)) {
    AngleChain coarse = chain;
    coarse.segments = std::min(chain.segments, kCoarse);
    const int spent = found.iterations;
    found = bestOfStarts(coarse);
    found.iterations += spent;
    if (found.converged && coarse.segments < chain.segments) {
      const int before = found.iterations;
      found = solveChain(chain, resampled(coarse, found.angles, chain.segments));
      found.iterations += before;
    }
  }
  if (!found.converged)
    return fail(
        ErrorCode::noSolution,
        "no resting shape was found near the start; give a sketch that resembles the curve, or more segments",
        "initial", found.closure * ends.length);
  return assemble(ends, chain, frame, found);
}

}  // namespace bw
