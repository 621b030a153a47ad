// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "section_samples.h"

namespace bw::geometry {

namespace {

constexpr double kBisected = 1e-12;  // relative: places so near differ by rounding
constexpr double kOnSide = 1e-8;     // mm along a section within which it leaves the block

}  // namespace

std::vector<SectionSample> sampleBranch(const PlaneCutter& cutter, const SectionBranch& branch, double level,
                                        int parts) {
  std::vector<SectionSample> samples;
  for (std::size_t b = 0; b < branch.parts.size(); ++b) {
    const LevelPiece& piece = *branch.parts[b].piece;
    std::vector<const LevelNode*> nodes;
    for (const LevelNode& node : piece.nodes) nodes.push_back(&node);
    if (branch.parts[b].reversed) std::reverse(nodes.begin(), nodes.end());
    if (piece.closed) nodes.push_back(nodes.front());
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (k > 0) {
        for (int m = 1; m < parts; ++m) {
          LevelNode node;
          if (cutter.between(piece.face, *nodes[k - 1], *nodes[k], double(m) / parts, level, node)) {
            samples.push_back({piece.face, node});
          }
        }
      }
      samples.push_back({piece.face, *nodes[k]});
      // A joint between faces, and a line of low continuity, may be a corner.
      const bool joint = k == 0 && b > 0;
      samples.back().corner = joint || (nodes[k]->crease && k > 0 && k + 1 < nodes.size());
    }
  }
  return samples;
}

std::vector<std::vector<SectionSample>> clipToBlock(const PlaneCutter& cutter,
                                                    std::vector<SectionSample> samples, bool closed,
                                                    double level, const BlockWindow& window, bool& cut) {
  std::vector<double> h;
  h.reserve(samples.size());
  for (const SectionSample& s : samples) h.push_back(window.outside(s.node.p));
  cut = std::any_of(h.begin(), h.end(), [](double x) { return x > 0; });
  if (!cut) return {std::move(samples)};
  if (closed) {  // begin outside, so that no part is broken at the arbitrary start
    samples.pop_back();
    h.pop_back();
    const auto out = std::find_if(h.begin(), h.end(), [](double x) { return x > 0; }) - h.begin();
    std::rotate(samples.begin(), samples.begin() + out, samples.end());
    std::rotate(h.begin(), h.begin() + out, h.end());
    samples.push_back(samples.front());
    h.push_back(h.front());
  }
  std::vector<std::vector<SectionSample>> result;
  std::vector<SectionSample> current;
  const auto border = [&](const SectionSample& in, const SectionSample& out) {
    double a = 0, b = 1;
    SectionSample best = in;
    best.corner = false;
    best.node.crease = false;
    best.node.root = -1;
    if (in.face != out.face) return best;
    for (int k = 0; k < 50 && b - a > kBisected; ++k) {
      const double m = 0.5 * (a + b);
      LevelNode node;
      if (!cutter.between(in.face, in.node, out.node, m, level, node)) break;
      if (window.outside(node.p) <= 0) {
        a = m;
        best.node = node;
      } else {
        b = m;
      }
      if ((out.node.p - in.node.p).norm() * (b - a) < kOnSide) break;
    }
    return best;
  };
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool in = h[i] <= 0;
    if (in && i > 0 && h[i - 1] > 0) {
      const SectionSample first = border(samples[i], samples[i - 1]);
      if ((first.node.p - samples[i].node.p).norm() > kSameNode) current.push_back(first);
    }
    if (in) current.push_back(samples[i]);
    if (!in && i > 0 && h[i - 1] <= 0) {
      const SectionSample last = border(samples[i - 1], samples[i]);
      if ((last.node.p - samples[i - 1].node.p).norm() > kSameNode) current.push_back(last);
      result.push_back(std::move(current));
      current.clear();
    }
  }
  if (!current.empty()) result.push_back(std::move(current));
  return result;
}

std::vector<SectionSample> refined(const PlaneCutter& cutter, const std::vector<SectionSample>& samples,
                                   double level, int division) {
  std::vector<SectionSample> result;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i > 0 && samples[i].face == samples[i - 1].face &&
        !samples[i].node.p.isApprox(samples[i - 1].node.p, kBisected)) {
      for (int m = 1; m < division; ++m) {
        LevelNode node;
        if (cutter.between(samples[i].face, samples[i - 1].node, samples[i].node, double(m) / division, level,
                           node)) {
          result.push_back({samples[i].face, node});
        }
      }
    }
    result.push_back(samples[i]);
  }
  return result;
}

double lengthOf(const std::vector<SectionSample>& samples) {
  double length = 0;
  for (std::size_t i = 1; i < samples.size(); ++i)
    length += (samples[i].node.p - samples[i - 1].node.p).norm();
  return length;
}

}  // namespace bw::geometry
