// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "section_runs.h"

#include <algorithm>
#include <cmath>

#include "tolerances.h"

namespace bw::geometry {

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
