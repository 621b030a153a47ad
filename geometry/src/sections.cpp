// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/geometry/sections.h"

#include <algorithm>
#include <cmath>

#include "bw/core/number_text.h"
#include "curve_fit.h"
#include "level_curves.h"
#include "model_impl.h"
#include "occt.h"

namespace bw::geometry {

namespace {

constexpr double kFitTolerance = 5e-4;    // mm between samples of a section and its spline; the promise is 1e-3
constexpr double kInsetRatio = 1e-4;      // of the range: the first and last plane keep off the very border
constexpr double kInset = 0.01;           // mm, at least
constexpr double kMeet = 1e-3;            // mm: ends of pieces this close are one point
constexpr double kBoxSlack = 1e-6;        // mm that a curve may lie outside the block
constexpr double kSpeck = 0.01;           // mm: a part shorter than this is rounding, not a branch
constexpr double kShortRatio = 0.01;      // of the longest section: shorter ones carry no shape
constexpr double kShort = 0.1;            // mm, likewise
constexpr double kCorner = 0.02;          // rad between the tangents at a joint: more is a corner
constexpr double kNudge = 1e-4;           // mm that a plane along a border or plane face is moved
constexpr int kMinSamples = 96;           // of a section, before it is fitted
constexpr int kMaxSamples = 12000;
constexpr int kProbePlanes = 64;          // tried when no sample of the target lies in the block
constexpr int kBisections = 16;           // halvings of the distance between a plane that hits and one that misses

/// A chain of pieces over the faces.
struct Branch {
  struct Part {
    const LevelPiece* piece;
    bool reversed;
  };
  std::vector<Part> parts;
  bool closed = false;
};

/// Joins pieces whose ends lie on the same crossing of a border, or else at the same point.
std::vector<Branch> chainPieces(const std::vector<LevelPiece>& pieces) {
  std::vector<Branch> branches;
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
    Branch branch;
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

/// A sample of a branch on its way to the fit.
struct Sample {
  int face;
  LevelNode node;
  bool corner = false;  ///< a new run begins here
};

/// The samples of a branch, `parts` to each interval between the nodes.
std::vector<Sample> sampleBranch(const PlaneCutter& cutter, const Branch& branch, double level, int parts) {
  std::vector<Sample> samples;
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

/// The convex region of a section plane that lies in the block: h(p) ≤ 0 for each of its sides.
struct Window {
  const Box& box;
  double outside(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d q = box.frame.toLocal(p);
    return std::max((q - box.size).maxCoeff(), (-q).maxCoeff()) - kBoxSlack;
  }
};

/// Cuts the samples to the block; each part is open.
std::vector<std::vector<Sample>> clip(const PlaneCutter& cutter, std::vector<Sample> samples, bool closed, double level,
                                      const Window& window, bool& cut) {
  std::vector<double> h;
  h.reserve(samples.size());
  for (const Sample& s : samples) h.push_back(window.outside(s.node.p));
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
  std::vector<std::vector<Sample>> result;
  std::vector<Sample> current;
  const auto border = [&](const Sample& in, const Sample& out) {
    double a = 0, b = 1;
    Sample best = in;
    best.corner = false;
    best.node.crease = false;
    best.node.root = -1;
    if (in.face != out.face) return best;
    for (int k = 0; k < 50 && b - a > 1e-12; ++k) {
      const double m = 0.5 * (a + b);
      LevelNode node;
      if (!cutter.between(in.face, in.node, out.node, m, level, node)) break;
      if (window.outside(node.p) <= 0) {
        a = m;
        best.node = node;
      } else {
        b = m;
      }
      if ((out.node.p - in.node.p).norm() * (b - a) < 1e-8) break;
    }
    return best;
  };
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool in = h[i] <= 0;
    if (in && i > 0 && h[i - 1] > 0) {
      const Sample first = border(samples[i], samples[i - 1]);
      if ((first.node.p - samples[i].node.p).norm() > 1e-7) current.push_back(first);
    }
    if (in) current.push_back(samples[i]);
    if (!in && i > 0 && h[i - 1] <= 0) {
      const Sample last = border(samples[i - 1], samples[i]);
      if ((last.node.p - samples[i - 1].node.p).norm() > 1e-7) current.push_back(last);
      result.push_back(std::move(current));
      current.clear();
    }
  }
  if (!current.empty()) result.push_back(std::move(current));
  return result;
}

double lengthOf(const std::vector<Sample>& samples) {
  double length = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) length += (samples[i].node.p - samples[i - 1].node.p).norm();
  return length;
}

/// One section plane and what it found.
struct Outcome {
  std::optional<Section> section;
  Issues issues;
  double length = 0;
};

class Sectioner {
 public:
  Sectioner(const Target::Impl& target, const Setup& setup)
      : setup_(setup), cutter_(target, setup.direction, setup.block), window_{setup.block} {
    frame_.normal = setup.direction;
    const Frame& block = setup.block.frame;
    // y: towards the side that the block is looked at from; where the blade travels that way, the block's own y.
    Eigen::Vector3d up = block.normal - block.normal.dot(frame_.normal) * frame_.normal;
    if (up.norm() < 1e-6) up = block.y - block.y.dot(frame_.normal) * frame_.normal;
    frame_.y = up.normalized();
    frame_.x = frame_.y.cross(frame_.normal);
    entry_ = 1e300;
    for (const Eigen::Vector3d& corner : setup.block.corners()) {
      entry_ = std::min(entry_, setup.direction.dot(corner));
      exit_ = std::max(exit_, setup.direction.dot(corner));
    }
  }

  /// Where the block begins and ends along the direction.
  double entry() const { return entry_; }
  double exit() const { return exit_; }

  Frame frameAt(double level) const {
    Frame frame = frame_;
    const Eigen::Vector3d& corner = setup_.block.frame.origin;
    frame.origin = corner + (level - setup_.direction.dot(corner)) * setup_.direction;
    return frame;
  }

  /// True if the plane meets the target within the block.
  bool hits(double level) const {
    const PlaneCutter::Cut cut = cutter_.cut(level);
    for (const LevelPiece& piece : cut.pieces) {
      for (const LevelNode& node : piece.nodes) {
        if (window_.outside(node.p) <= 0) return true;
      }
    }
    return false;
  }

  Outcome cut(double level, int station) const {
    if (cutter_.grazes(level)) level += kNudge;
    Outcome outcome;
    const PlaneCutter::Cut cut = cutter_.cut(level);
    const std::vector<Branch> branches = chainPieces(cut.pieces);
    const Frame frame = frameAt(level);
    const auto issue = [&](Severity severity, const char* kind, const std::string& message,
                           const std::optional<Eigen::Vector3d>& point) {
      outcome.issues.push_back({severity, kind, message, {stationName(station), {}, station, point}});
    };

    struct Part {
      const Branch* branch;
      std::vector<Sample> samples;
      bool closed, clipped;
      double length;
    };
    std::vector<Part> parts;
    double speck = 0;
    for (const Branch& branch : branches) {
      std::size_t nodes = 0;
      for (const auto& part : branch.parts) nodes += part.piece->nodes.size();
      const int division = std::max(2, int((kMinSamples + nodes - 1) / nodes));
      bool clipped = false;
      auto pieces = clip(cutter_, sampleBranch(cutter_, branch, level, division), branch.closed, level, window_, clipped);
      for (auto& piece : pieces) {
        const double length = lengthOf(piece);
        if (length < kSpeck) {
          speck = std::max(speck, length);
          continue;
        }
        parts.push_back({&branch, std::move(piece), branch.closed && !clipped, clipped, length});
      }
    }
    if (parts.empty() && speck > 0) {
      issue(Severity::warning, "section-short",
            stationName(station) + " is left out: its plane meets the target only in a point", frame.origin);
      return outcome;
    }
    if (parts.empty()) {
      issue(Severity::warning, "section-missing",
            stationName(station) + " is left out: its plane does not meet the target inside the block",
            frame.origin);
      return outcome;
    }
    if (parts.size() > 1) {
      issue(Severity::warning, "section-branches",
            stationName(station) + " is left out: its plane cuts the target in " +
                std::to_string(parts.size()) +
                " separate curves; place the block so that only one of them lies in it, choose another direction or fewer faces",
            parts.front().samples.front().node.p);
      return outcome;
    }
    Part& part = parts.front();
    if (part.closed) {
      issue(Severity::warning, "section-closed",
            stationName(station) +
                " is left out: its plane cuts the target in a closed curve, which no blade can follow; choose one side of the solid",
            part.samples.front().node.p);
      return outcome;
    }
    if (cut.doubtful) {
      issue(Severity::info, "section-border",
            stationName(station) + ": a border of the target could not be matched with the section",
            part.samples.front().node.p);
    }

    // Fit, with more samples where the curve asks for more spans.
    std::optional<CurveFit> best;
    for (int round = 0;; ++round) {
      auto fit = fitCurve(runsOf(part.samples, frame), kFitTolerance);
      if (!fit) {
        issue(Severity::warning, "section-fit", stationName(station) + " is left out: " + fit.error().message,
              part.samples.front().node.p);
        return outcome;
      }
      if (!best || fit->deviation < best->deviation) best = std::move(*fit);
      if (best->enough || int(part.samples.size()) > kMaxSamples / 3 || round == 8) break;
      part.samples = refined(part.samples, level, 3);
    }
    if (best->deviation > 1e-3) {
      issue(Severity::warning, "section-fit",
            stationName(station) + ": the section is so rough that its spline keeps within " +
                shortText(best->deviation) + " mm of it only",
            part.samples.front().node.p);
    }
    outcome.length = part.length;
    outcome.section = Section{station, level - entry_, frame, std::move(best->curve)};
    return outcome;
  }

 private:
  /// Samples between the samples.
  std::vector<Sample> refined(const std::vector<Sample>& samples, double level, int division) const {
    std::vector<Sample> result;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (i > 0 && samples[i].face == samples[i - 1].face && !samples[i].node.p.isApprox(samples[i - 1].node.p, 1e-12)) {
        for (int m = 1; m < division; ++m) {
          LevelNode node;
          if (cutter_.between(samples[i].face, samples[i - 1].node, samples[i].node, double(m) / division, level, node)) {
            result.push_back({samples[i].face, node});
          }
        }
      }
      result.push_back(samples[i]);
    }
    return result;
  }

  /// Plane points with tangents and arc lengths, broken into runs at corners.
  std::vector<std::vector<CurveSample>> runsOf(const std::vector<Sample>& samples, const Frame& frame) const {
    struct Raw {
      Eigen::Vector2d p, t;
      bool hasTangent, mark;
    };
    const auto plane = [&](const Eigen::Vector3d& d) { return Eigen::Vector2d(d.dot(frame.x), d.dot(frame.y)); };
    std::vector<Raw> raw;
    for (const Sample& s : samples) {
      const Eigen::Vector3d t = cutter_.tangent(s.face, s.node);
      raw.push_back({plane(s.node.p - frame.origin), plane(t), t.squaredNorm() > 0.5, s.corner});
    }
    const int count = int(raw.size());
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector2d chord = raw[std::min(i + 1, count - 1)].p - raw[std::max(i - 1, 0)].p;
      // At a joint the chord must stay on the sample's own side.
      const bool before = raw[i].mark && samples[i].face == samples[std::max(i - 1, 0)].face;
      const Eigen::Vector2d own = raw[i].mark && i > 0 && i + 1 < count
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
        const bool crossing = here.root >= 0 && here.root == before.root && samples[i].face != samples[i - 1].face;
        if (raw[i].mark && (chord <= kMeet || crossing)) {  // the same point seen from the next face
          const bool corner = turn > kCorner;
          if (corner && runs.back().size() > 1) {
            CurveSample joint = runs.back().back();
            joint.tangent = raw[i].t;
            runs.push_back({joint});
          }
          continue;
        }
        if (chord < 1e-9) continue;
        // Within a smooth part the arc exceeds its chord by the square of the turn over 24.
        arc += chord * (1 + (turn < 0.5 ? turn * turn / 24 : 0.0));
      }
      runs.back().push_back({raw[i].p, raw[i].t, arc});
      if (raw[i].mark && i > 0 && i + 1 < count && creased(samples, i)) {
        const Eigen::Vector2d in = (raw[i].p - raw[i - 1].p).normalized(), out = (raw[i + 1].p - raw[i].p).normalized();
        const Eigen::Vector2d tin = 2 * in.dot(raw[i - 1].t) * in - raw[i - 1].t;    // mirrored: the tangent of the arc's other end
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

  static bool creased(const std::vector<Sample>& samples, int i) { return samples[i].node.crease; }

  const Setup& setup_;
  PlaneCutter cutter_;
  Window window_;
  Frame frame_;
  double entry_ = 1e300, exit_ = -1e300;
};

/// The first and last place along the direction where the target lies in the block.
Result<std::array<double, 2>> rangeOf(const Target::Impl& target, const Setup& setup, const Sectioner& sectioner) {
  const auto extent = target.extent(setup.direction);
  const double low = std::max(extent[0], sectioner.entry()), high = std::min(extent[1], sectioner.exit());
  const auto missed = [&]() {
    return fail(ErrorCode::badInput,
                "no plane across the cutting direction meets the target inside the block; move or enlarge the block, or choose \"auto\"",
                "block");
  };
  if (!(high > low)) {
    if (extent[1] - extent[0] < 1e-6 && extent[0] > sectioner.entry() && extent[0] < sectioner.exit()) {
      return fail(ErrorCode::badInput,
                  "the target has no extent along the cutting direction; choose a direction that runs along the surface",
                  "direction", extent[1] - extent[0]);
    }
    return missed();
  }
  if (high - low < 4 * kInset) {
    return fail(ErrorCode::badInput,
                "the target extends only " + shortText(high - low) +
                    " mm along the cutting direction inside the block; choose a direction that runs along the surface",
                "direction", high - low, 4 * kInset);
  }
  const double inset = std::max(kInset, kInsetRatio * (high - low));
  double first = low + inset, last = high - inset;
  if (sectioner.hits(first) && sectioner.hits(last)) return std::array<double, 2>{first, last};

  // The target leaves the block by another side, or a border is ragged: look where it begins and ends.
  double a = 1e300, b = -1e300;
  for (int k = 0; k <= kProbePlanes; ++k) {
    const double level = first + (last - first) * k / kProbePlanes;
    if (!sectioner.hits(level)) continue;
    a = std::min(a, level);
    b = std::max(b, level);
  }
  if (a > b) return missed();
  const auto bisect = [&](double hit, double miss) {
    for (int k = 0; k < kBisections && std::abs(miss - hit) > 0.5 * inset; ++k) {
      const double middle = 0.5 * (hit + miss);
      (sectioner.hits(middle) ? hit : miss) = middle;
    }
    return hit;
  };
  if (a > first) a = bisect(a, std::max(first, a - (last - first) / kProbePlanes));
  if (b < last) b = bisect(b, std::min(last, b + (last - first) / kProbePlanes));
  if (!(b > a)) return missed();
  return std::array<double, 2>{a, b};
}

/// Makes all curves run the same way: towards +x where that is clear, else like their neighbours.
void orient(std::vector<Section>& sections) {
  constexpr double kClear = 0.05;  // of the chord
  const auto chord = [](const PlanarCurve& c) -> Eigen::Vector2d { return c.value(c.end()) - c.value(c.start()); };
  int anchor = -1;
  for (int i = 0; i < int(sections.size()); ++i) {
    const Eigen::Vector2d d = chord(sections[i].curve);
    if (std::abs(d.x()) <= kClear * d.norm()) continue;
    if (d.x() < 0) sections[i].curve = sections[i].curve.reversed();
    if (anchor < 0) anchor = i;
  }
  if (anchor < 0 && !sections.empty()) {
    anchor = 0;
    if (chord(sections[0].curve).y() < 0) sections[0].curve = sections[0].curve.reversed();
  }
  const auto follow = [&](int i, int neighbour) {
    const Eigen::Vector2d d = chord(sections[i].curve);
    if (std::abs(d.x()) > kClear * d.norm()) return;
    const PlanarCurve& c = sections[i].curve;
    const PlanarCurve& n = sections[neighbour].curve;
    const Eigen::Vector2d a = c.value(c.start()), b = c.value(c.end()), na = n.value(n.start()), nb = n.value(n.end());
    if ((a - na).squaredNorm() + (b - nb).squaredNorm() > (b - na).squaredNorm() + (a - nb).squaredNorm()) {
      sections[i].curve = c.reversed();
    }
  };
  for (int i = anchor + 1; i < int(sections.size()); ++i) follow(i, i - 1);
  for (int i = anchor - 1; i >= 0; --i) follow(i, i + 1);
}

}  // namespace

Result<std::vector<Section>> cutSections(const Target& target, const Setup& given, const Job& job,
                                         const RunContext& context, Issues& issues) {
  Setup setup = given;
  const double length = setup.direction.norm();
  if (!std::isfinite(length) || length < 1e-9) {
    return fail(ErrorCode::badInput, "the cutting direction is zero or not a number; give a vector such as [0, 1, 0]",
                "direction");
  }
  setup.direction /= length;
  if (!setup.block.size.allFinite() || !(setup.block.size.minCoeff() > 0) || !setup.block.frame.origin.allFinite() ||
      !setup.block.frame.x.allFinite() || !setup.block.frame.y.allFinite() || !setup.block.frame.normal.allFinite()) {
    return fail(ErrorCode::badInput, "the block must have a finite place and a size above 0 mm in all three directions",
                "block", setup.block.size.minCoeff(), 0.0);
  }
  if (job.spacing && !(std::isfinite(*job.spacing) && *job.spacing > 0)) {
    return fail(ErrorCode::badInput, "the spacing of stations must be above 0 mm", "stations", *job.spacing, 0.0);
  }
  if (!job.spacing && (job.stations < 2 || job.stations > Job::kMaxStations)) {
    return fail(ErrorCode::badInput,
                "the number of stations must be between 2 and " + std::to_string(Job::kMaxStations) + ", not " +
                    std::to_string(job.stations),
                "stations", job.stations, job.stations < 2 ? 2 : Job::kMaxStations);
  }
  return guarded(ErrorCode::internal, "the sections cannot be computed", [&]() -> Result<std::vector<Section>> {
    context.report(0.0, "sections");
    const Sectioner sectioner(target.impl(), setup);
    auto range = rangeOf(target.impl(), setup, sectioner);
    if (!range) return tl::unexpected(range.error());
    const double first = (*range)[0], last = (*range)[1];
    int count = job.stations;
    if (job.spacing) {
      const double gaps = std::ceil((last - first) / *job.spacing - 1e-9);
      if (gaps + 1 > Job::kMaxStations) {
        return fail(ErrorCode::badInput,
                    "a spacing of " + shortText(*job.spacing) + " mm makes more than " +
                        std::to_string(Job::kMaxStations) + " stations over " + shortText(last - first) +
                        " mm; choose a larger spacing",
                    "stations", gaps + 1, Job::kMaxStations);
      }
      count = std::max(2, int(gaps) + 1);
    }
    std::vector<Outcome> outcomes(std::size_t(count), Outcome{});
    const auto done = parallelFor(context, count, [&](int i) {
      outcomes[i] = sectioner.cut(i + 1 == count ? last : first + (last - first) * i / (count - 1), i);
    });
    if (!done) return tl::unexpected(done.error());

    double longest = 0;
    for (const Outcome& outcome : outcomes) longest = std::max(longest, outcome.length);
    const double shortest = std::max(kShort, kShortRatio * longest);
    std::vector<Section> sections;
    for (Outcome& outcome : outcomes) {
      issues.insert(issues.end(), outcome.issues.begin(), outcome.issues.end());
      if (!outcome.section) continue;
      if (outcome.length < shortest) {
        const int station = outcome.section->index;
        issues.push_back({Severity::warning, "section-short",
                          stationName(station) + " is left out: its section is only " +
                              shortText(outcome.length) + " mm long (less than " + shortText(shortest) +
                              " mm), too short to hold a blade to",
                          {stationName(station), {}, station,
                           outcome.section->frame.toWorld(outcome.section->curve.value(outcome.section->curve.start()))}});
        continue;
      }
      sections.push_back(std::move(*outcome.section));
    }
    if (sections.empty()) {
      const std::string why = issues.empty() ? "" : " (" + issues.back().message + ")";
      return fail(ErrorCode::noSolution,
                  "none of the " + std::to_string(count) +
                      " planes cuts the target in one open curve inside the block" + why,
                  "sections");
    }
    orient(sections);
    context.report(1.0, "sections");
    return sections;
  });
}

}  // namespace bw::geometry
