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
    if (i > 0 && samples[i].face == samples[i - 1].face && !gapBetween(samples[i - 1], samples[i]) &&
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

/// A sample in its plane.
struct Raw {
  Eigen::Vector2d p, t;
  bool hasTangent = true, mark = false;
};

double turnBetween(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

/// How a section bends at sample `end` as it comes there, or goes on from there (`way` −1 and 1): counter-
/// clockwise along the samples, from the tangents at two places before, or behind, it.
double bendAt(const std::vector<Raw>& raw, int end, int way, double apart) {
  const auto from = [&](int i) {
    int j = i;
    while (j + way >= 0 && j + way < int(raw.size()) &&
           (raw[std::size_t(j)].p - raw[std::size_t(i)].p).norm() < apart)
      j += way;
    return j;
  };
  const auto mean = [&](int i, int j) {
    const double chord = (raw[std::size_t(j)].p - raw[std::size_t(i)].p).norm();
    return chord > 0 ? way * turnBetween(raw[std::size_t(i)].t, raw[std::size_t(j)].t) / chord : 0.0;
  };
  const int near = from(end), far = from(near);
  if (near == end) return 0;
  const double first = mean(end, near);
  if (far == near) return first;
  const double a = (raw[std::size_t(near)].p - raw[std::size_t(end)].p).norm(),
               b = (raw[std::size_t(far)].p - raw[std::size_t(near)].p).norm();
  return first + (first - mean(near, far)) * a / (a + b);
}

constexpr int kOverGap = 64;           // samples of what leads over a gap
constexpr double kLooksBack = 0.05;    // of a gap: so far from it its ends' bend is seen
constexpr double kLeastLook = 0.5;     // mm, at least
constexpr double kMeetsWithin = 0.01;  // of a gap: so near to its other end what is bent on comes there
constexpr double kMeetsTurned = 0.1;   // rad, and so nearly along it
constexpr double kGentle = 0.3;        // cosine of the angle at which either end may look across
constexpr double kQuarter = 0.95;      // sine of what an arc may turn by on its way

/// What leads over a gap between two samples: the quintic with their places, tangents and bends, as samples
/// between them.
std::vector<Raw> overGap(const std::vector<Raw>& raw, int before) {
  const Raw &a = raw[std::size_t(before)], &b = raw[std::size_t(before) + 1];
  const double chord = (b.p - a.p).norm(), apart = std::max(kLeastLook, kLooksBack * chord);
  const double bendA = bendAt(raw, before, -1, apart), bendB = bendAt(raw, before + 1, 1, apart);
  const double half = 0.5 * turnBetween(a.t, b.t);
  const double length = std::abs(half) > 1e-6 ? chord * half / std::sin(half) : chord;
  const auto across = [](const Eigen::Vector2d& t) { return Eigen::Vector2d(-t.y(), t.x()); };
  const Eigen::Vector2d d0 = length * a.t, d1 = length * b.t, e0 = length * length * bendA * across(a.t),
                        e1 = length * length * bendB * across(b.t), by = b.p - a.p;
  const Eigen::Vector2d c3 = 10 * by - 6 * d0 - 4 * d1 - 1.5 * e0 + 0.5 * e1,
                        c4 = -15 * by + 8 * d0 + 7 * d1 + 1.5 * e0 - e1,
                        c5 = 6 * by - 3 * d0 - 3 * d1 - 0.5 * e0 + 0.5 * e1;
  std::vector<Raw> between;
  for (int k = 1; k < kOverGap; ++k) {
    const double s = double(k) / kOverGap;
    const Eigen::Vector2d p = a.p + s * (d0 + s * (0.5 * e0 + s * (c3 + s * (c4 + s * c5))));
    const Eigen::Vector2d t = d0 + s * (e0 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)));
    between.push_back({p, t.normalized()});
  }
  return between;
}

/// True if what is bent on from the one end of a gap as it is there comes to the other end, nearly along it.
bool meetOver(const std::vector<Raw>& raw, int before) {
  const Raw &a = raw[std::size_t(before)], &b = raw[std::size_t(before) + 1];
  const Eigen::Vector2d by = b.p - a.p;
  const double chord = by.norm(), apart = std::max(kLeastLook, kLooksBack * chord);
  if (!(chord > 0) || a.t.dot(by) < kGentle * chord || b.t.dot(by) < kGentle * chord) return false;
  const auto reaches = [&](const Eigen::Vector2d& tangent, const Eigen::Vector2d& way, double bend,
                           const Eigen::Vector2d& there) {
    // An arc of that bend to where it is as far along the tangent.
    const double along = way.dot(tangent), side = tangent.x() * way.y() - tangent.y() * way.x();
    const double sine = bend * along;
    if (!(std::abs(sine) < kQuarter)) return false;
    const double turned = std::asin(sine);
    const double arrives = std::abs(sine) > 1e-9 ? (1 - std::cos(turned)) / bend : 0.0;
    const double off = std::abs(turnBetween(tangent, there) - turned);
    return std::abs(side - arrives) <= kMeetsWithin * chord && off <= kMeetsTurned;
  };
  return reaches(a.t, by, bendAt(raw, before, -1, apart), b.t) &&
         reaches(-b.t, -by, -bendAt(raw, before + 1, 1, apart), -a.t);
}

std::vector<Raw> rawOf(const PlaneCutter& cutter, const std::vector<SectionSample>& samples,
                       const Frame& frame) {
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
  return raw;
}

}  // namespace

std::optional<JoinedParts> joined(const PlaneCutter& cutter,
                                  const std::vector<std::vector<SectionSample>>& parts, const Frame& frame) {
  struct Span {
    std::size_t part;
    double low, high;
    bool turned;
  };
  std::vector<Span> spans;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto xOf = [&](const SectionSample& sample) { return (sample.node.p - frame.origin).dot(frame.x); };
    const auto [low, high] = std::ranges::minmax(parts[i], {}, xOf);
    spans.push_back({i, xOf(low), xOf(high), xOf(parts[i].front()) > xOf(parts[i].back())});
  }
  std::ranges::sort(spans, {}, &Span::low);
  JoinedParts all;
  for (std::size_t k = 0; k < spans.size(); ++k) {
    if (k > 0 && spans[k].low < spans[k - 1].high) return {};
    std::vector<SectionSample> next = parts[spans[k].part];
    if (spans[k].turned) {
      std::ranges::reverse(next);
      for (std::size_t i = 1; i < next.size(); ++i)
        next[i].corner = next[i].corner || next[i].face != next[i - 1].face;
    }
    if (k > 0) {
      SectionSample &end = all.samples.back(), &begin = next.front();
      if (end.node.root < 0 || begin.node.root < 0 || next.size() < 2) return {};
      all.widest = std::max(all.widest, (begin.node.p - end.node.p).norm());
      end.gap = begin.gap = int(k);
    }
    all.samples.insert(all.samples.end(), next.begin(), next.end());
  }
  all.first = spans.front().part;
  all.firstTurned = spans.front().turned;
  all.last = spans.back().part;
  all.lastTurned = spans.back().turned;
  const std::vector<Raw> raw = rawOf(cutter, all.samples, frame);
  for (std::size_t i = 1; i < all.samples.size(); ++i)
    if (gapBetween(all.samples[i - 1], all.samples[i]) && !meetOver(raw, int(i) - 1)) return {};
  return all;
}

std::vector<std::vector<CurveSample>> runsOf(const PlaneCutter& cutter,
                                             const std::vector<SectionSample>& samples, const Frame& frame) {
  const std::vector<Raw> raw = rawOf(cutter, samples, frame);
  const int count = int(raw.size());
  std::vector<std::vector<CurveSample>> runs(1);
  double arc = 0;
  for (int i = 0; i < count; ++i) {
    if (i > 0 && gapBetween(samples[i - 1], samples[i])) {
      Eigen::Vector2d last = raw[i - 1].p;
      for (const Raw& over : overGap(raw, i - 1)) {
        arc += (over.p - last).norm();
        last = over.p;
        runs.back().push_back({over.p, over.t, arc});
      }
      arc += (raw[i].p - last).norm();
    } else if (i > 0) {
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
