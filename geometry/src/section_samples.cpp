// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "section_samples.h"

#include <algorithm>
#include <cmath>

#include "tolerances.h"

namespace bw::geometry {

std::vector<SectionBranch> chainPieces(const std::vector<LevelPiece>& pieces) {
  std::vector<SectionBranch> branches;
  std::vector<int> partner(2 * pieces.size(), -1);  // end 2k = first node of piece k, 2k + 1 = last
  const auto nodeOf = [&](int end) -> const LevelNode& {
    const LevelPiece& piece = pieces[std::size_t(end / 2)];
    return end % 2 ? piece.nodes.back() : piece.nodes.front();
  };
  std::vector<int> ends;
  for (int k = 0; k < int(pieces.size()); ++k) {
    if (pieces[k].closed) continue;
    ends.push_back(2 * k);
    ends.push_back(2 * k + 1);
  }
  for (const int e : ends) {
    const int root = nodeOf(e).root;
    if (root < 0) continue;
    std::vector<int> same;
    for (const int other : ends) {
      if (nodeOf(other).root == root) same.push_back(other);
    }
    if (same.size() == 2) partner[e] = same[0] == e ? same[1] : same[0];
  }
  for (const int e : ends) {
    if (partner[e] >= 0) continue;
    int best = -1;
    double nearest = kMeet;
    for (const int other : ends) {
      if (other == e || partner[other] >= 0) continue;
      // A short piece's two ends must not meet each other.
      if (other / 2 == e / 2 && pieces[e / 2].nodes.size() < 4) continue;
      const double d = (nodeOf(other).p - nodeOf(e).p).norm();
      if (d <= nearest) {
        nearest = d;
        best = other;
      }
    }
    if (best >= 0) {
      partner[e] = best;
      partner[best] = e;
    }
  }
  std::vector<char> used(pieces.size(), 0);
  const auto walk = [&](int start, bool closed) {
    SectionBranch branch;
    branch.closed = closed;
    int end = start;  // the end at which the piece is entered
    while (end >= 0 && !used[end / 2]) {
      used[end / 2] = 1;
      branch.parts.push_back({&pieces[end / 2], end % 2 == 1});
      end = partner[end ^ 1];
    }
    branches.push_back(std::move(branch));
  };
  for (int k = 0; k < int(pieces.size()); ++k) {
    if (pieces[k].closed) {
      branches.push_back({{{&pieces[k], false}}, true});
      used[k] = 1;
    }
  }
  for (const int e : ends) {
    if (!used[e / 2] && partner[e] < 0) walk(e, false);
  }
  for (const int e : ends) {
    if (!used[e / 2]) walk(e, true);
  }
  return branches;
}

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

std::vector<std::vector<SectionSample>> clipped(const PlaneCutter& cutter, std::vector<SectionSample> samples,
                                                bool closed, double level,
                                                const std::function<bool(const LevelNode&)>& holds,
                                                bool& cut) {
  std::vector<char> held;
  held.reserve(samples.size());
  for (const SectionSample& s : samples) held.push_back(holds(s.node));
  cut = std::ranges::find(held, 0) != held.end();
  if (!cut) return {std::move(samples)};
  if (closed) {  // begin outside, so that no part is broken at the arbitrary start
    samples.pop_back();
    held.pop_back();
    const auto out = std::ranges::find(held, 0) - held.begin();
    std::rotate(samples.begin(), samples.begin() + out, samples.end());
    std::rotate(held.begin(), held.begin() + out, held.end());
    samples.push_back(samples.front());
    held.push_back(held.front());
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
      if (holds(node)) {
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
    const bool in = held[i];
    if (in && i > 0 && !held[i - 1]) {
      const SectionSample first = border(samples[i], samples[i - 1]);
      if ((first.node.p - samples[i].node.p).norm() > kSameNode) current.push_back(first);
    }
    if (in) current.push_back(samples[i]);
    if (!in && i > 0 && held[i - 1]) {
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

namespace {

constexpr double kCorner = 0.02;  // rad between the tangents at a joint: more is a corner

}  // namespace

std::vector<std::vector<CurveSample>> runsOf(const PlaneCutter& cutter,
                                             const std::vector<SectionSample>& samples, const Frame& frame) {
  struct Raw {
    Eigen::Vector2d p, t;
    bool hasTangent, mark;
  };
  const auto plane = [&](const Eigen::Vector3d& d) {
    return Eigen::Vector2d(d.dot(frame.x), d.dot(frame.y));
  };
  std::vector<Raw> raw;
  for (const SectionSample& s : samples) {
    const Eigen::Vector3d t = cutter.tangent(s.face, s.node);
    raw.push_back({plane(s.node.p - frame.origin), plane(t), t.squaredNorm() > 0.5, s.corner});
  }
  const int count = int(raw.size());
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d chord = raw[std::min(i + 1, count - 1)].p - raw[std::max(i - 1, 0)].p;
    // At a joint the chord must stay on the sample's own side.
    const bool before = raw[i].mark && samples[i].face == samples[std::max(i - 1, 0)].face;
    const Eigen::Vector2d own =
        raw[i].mark && i > 0 && i + 1 < count
            ? Eigen::Vector2d(before ? raw[i].p - raw[i - 1].p : raw[i + 1].p - raw[i].p)
            : chord;
    if (!raw[i].hasTangent) {
      raw[i].t = own.norm() > 0 ? Eigen::Vector2d(own.normalized()) : Eigen::Vector2d::UnitX();
    } else if (raw[i].t.dot(own) < 0) {
      raw[i].t = -raw[i].t;
    }
  }
  std::vector<std::vector<CurveSample>> runs(1);
  double arc = 0;
  for (int i = 0; i < count; ++i) {
    if (i > 0) {
      const double chord = (raw[i].p - raw[i - 1].p).norm();
      const double turn = std::acos(std::clamp(raw[i].t.dot(raw[i - 1].t), -1.0, 1.0));
      const LevelNode &here = samples[i].node, &before = samples[i - 1].node;
      const bool crossing =
          here.root >= 0 && here.root == before.root && samples[i].face != samples[i - 1].face;
      if (raw[i].mark && (chord <= kMeet || crossing)) {  // the same point seen from the next face
        const bool corner = turn > kCorner;
        if (corner && runs.back().size() > 1) {
          CurveSample joint = runs.back().back();
          joint.tangent = raw[i].t;
          runs.push_back({joint});
        }
        continue;
      }
      if (chord < kNoLength) continue;
      // Within a smooth part the arc exceeds its chord by the square of the turn over 24.
      arc += chord * (1 + (turn < 0.5 ? turn * turn / 24 : 0.0));
    }
    runs.back().push_back({raw[i].p, raw[i].t, arc});
    if (raw[i].mark && i > 0 && i + 1 < count && samples[i].node.crease) {
      const Eigen::Vector2d in = (raw[i].p - raw[i - 1].p).normalized(),
                            out = (raw[i + 1].p - raw[i].p).normalized();
      const Eigen::Vector2d tin =
          2 * in.dot(raw[i - 1].t) * in - raw[i - 1].t;  // mirrored: the tangent of the arc's other end
      const Eigen::Vector2d tout = 2 * out.dot(raw[i + 1].t) * out - raw[i + 1].t;
      if (std::acos(std::clamp(tin.dot(tout), -1.0, 1.0)) > kCorner) {
        runs.back().back().tangent = tin;
        runs.push_back({{raw[i].p, tout, arc}});
      }
    }
  }
  if (runs.back().size() < 2) runs.pop_back();
  return runs;
}

}  // namespace bw::geometry
