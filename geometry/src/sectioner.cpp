// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "sectioner.h"

#include <algorithm>

#include "curve_fit.h"
#include "occt.h"
#include "tolerances.h"

namespace bw::geometry {

namespace {

constexpr double kPromised = 1e-3;      // mm between a section and its spline
constexpr double kFitTolerance = 5e-4;  // mm between samples of a section and its spline
constexpr double kSpeck = 0.01;         // mm: a part shorter than this is rounding, not a branch
constexpr double kNudge = 1e-4;         // mm that a plane along a border or plane face is moved
constexpr int kMinSamples = 96;         // of a section, before it is fitted
constexpr int kMaxSamples = 12000;

}  // namespace

bool Sectioner::hits(double level) const {
  const PlaneCutter::Cut cut = cutter_.cut(level);
  for (const LevelPiece& piece : cut.pieces) {
    for (const LevelNode& node : piece.nodes) {
      if (window_.outside(node.p) <= 0) return true;
    }
  }
  return false;
}

SectionOutcome Sectioner::cut(double level, int station, bool byKernel) const {
  if (grazes(level)) level += kNudge;
  SectionOutcome outcome;
  const Frame frame = planes_.at(level);
  const auto tell = [&](Severity severity, Cause cause, const Eigen::Vector3d& point) {
    outcome.findings.push_back({severity, std::move(cause), {StationRange::of(station), point}, {}});
  };

  const auto cut = guarded(ErrorCode::internal, "OpenCASCADE finds no section",
                           [&]() -> Result<PlaneCutter::Cut> { return cutter_.cut(level, byKernel); });
  if (!cut) {
    tell(Severity::warning, SectionUnfit{cut.error().message}, frame.origin);
    return outcome;
  }
  const std::vector<SectionBranch> branches = chainPieces(cut->pieces);

  struct Part {
    const SectionBranch* branch;
    std::vector<SectionSample> samples;
    bool closed, clipped;
    double length;
  };
  std::vector<Part> parts;
  double speck = 0;
  for (const SectionBranch& branch : branches) {
    std::size_t nodes = 0;
    for (const auto& part : branch.parts) nodes += part.piece->nodes.size();
    const int division = std::max(2, int((kMinSamples + nodes - 1) / nodes));
    bool clipped = false;
    auto pieces = clipToBlock(cutter_, sampleBranch(cutter_, branch, level, division), branch.closed, level,
                              window_, clipped);
    for (auto& piece : pieces) {
      const double length = lengthOf(piece);
      if (length < kSpeck) {
        speck = std::max(speck, length);
        continue;
      }
      outcome.found += length;
      parts.push_back({&branch, std::move(piece), branch.closed && !clipped, clipped, length});
    }
  }
  outcome.curves = int(parts.size());
  if (parts.empty()) {
    tell(Severity::warning, speck > 0 ? Cause(SectionPoint{}) : Cause(SectionMissing{}), frame.origin);
    return outcome;
  }
  const Eigen::Vector3d place = parts.front().samples.front().node.p;
  outcome.section = Section{station, planes_.travel(level), frame, {}, -1};
  if (parts.size() > 1 || parts.front().closed) {
    for (const Part& part : parts) {
      std::vector<Eigen::Vector2d> points;
      for (const SectionSample& sample : part.samples)
        points.push_back(frame.toLocal(sample.node.p).head<2>());
      if (auto chain = PlanarCurve::points(std::move(points))) outcome.section->branches.push_back(*chain);
    }
  }
  if (parts.size() > 1) {
    tell(Severity::warning, SectionBranches{int(parts.size()), int(parts.size())}, place);
    return outcome;
  }
  Part& part = parts.front();
  if (part.closed) {
    tell(Severity::warning, SectionClosed{}, place);
    return outcome;
  }
  if (cut->doubtful) tell(Severity::info, SectionBorder{}, place);

  // Fit, with more samples where the curve asks for more spans.
  std::optional<CurveFit> best;
  for (int round = 0;; ++round) {
    auto fit = fitCurve(runsOf(cutter_, part.samples, frame), kFitTolerance);
    if (!fit) {
      tell(Severity::warning, SectionUnfit{fit.error().message}, place);
      return outcome;
    }
    if (!best || fit->deviation < best->deviation) best = std::move(*fit);
    if (best->enough || int(part.samples.size()) > kMaxSamples / 3 || round == 8) break;
    part.samples = refined(cutter_, part.samples, level, 3);
  }
  if (best->deviation > kPromised) tell(Severity::warning, SectionRough{best->deviation}, place);
  outcome.length = part.length;
  outcome.section->branches = {std::move(best->curve)};
  outcome.section->chosen = 0;
  return outcome;
}

}  // namespace bw::geometry
