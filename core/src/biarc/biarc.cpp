// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/biarc/biarc.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "biarc/biarc_chain.h"
#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"

namespace bw {

namespace {

/// A piece that turns by less is straight: its rise is below 1e-13 of its length.
constexpr double kStraightTurning = 1e-12;
/// Arcs longer than this many chords are taken for the limit without a solution.
constexpr double kLongestArc = 1e7;

/// The biarc's data in the frame of its chord: α = angle of the chord against the start tangent, β = angle of
/// the end tangent against the chord.
struct ChordAngles {
  double length = 0, direction = 0, alpha = 0, beta = 0;
};

Result<ChordAngles> chordAngles(const Eigen::Vector2d& start, double startAngle, const Eigen::Vector2d& end,
                                double endAngle) {
  if (!start.allFinite() || !end.allFinite() || !std::isfinite(startAngle) || !std::isfinite(endAngle))
    return fail(ErrorCode::badInput, "a biarc needs finite points and tangent angles", "biarc");
  const Eigen::Vector2d chord = end - start;
  ChordAngles result;
  result.length = chord.stableNorm();
  if (!(result.length > 0) || !std::isfinite(result.length))
    return fail(ErrorCode::badInput,
                "the two points of a biarc coincide or are too far apart; drop one of them", "biarc",
                result.length);
  result.direction = std::atan2(chord.y(), chord.x());
  result.alpha = biarc::wrapAngle(result.direction - startAngle);
  result.beta = biarc::wrapAngle(endAngle - result.direction);
  return result;
}

tl::unexpected<Error> noBiarc() {
  return fail(ErrorCode::noSolution,
              "no biarc joins two points whose tangents both point straight back along the chord; turn one "
              "tangent",
              "biarc");
}

Result<Biarc> fromShare(const Eigen::Vector2d& start, double startAngle, const ChordAngles& c, double share) {
  const biarc::BiarcShape<double> shape = biarc::biarcShape(c.length, c.alpha, c.beta, share);
  const auto good = [&](double length) { return length > 0 && length < kLongestArc * c.length; };
  if (!good(shape.firstLength) || !good(shape.secondLength)) return noBiarc();
  Biarc biarc;
  biarc.first = {start, startAngle, shape.firstTurning, shape.firstLength};
  const double direction = startAngle + shape.firstTurning / 2;
  biarc.second = {start + shape.firstChord * Eigen::Vector2d(std::cos(direction), std::sin(direction)),
                  startAngle + shape.firstTurning, shape.secondTurning, shape.secondLength};
  for (CircularArc* arc : {&biarc.first, &biarc.second})
    if (std::abs(arc->turning) < kStraightTurning) arc->turning = 0;
  return biarc;
}

}  // namespace

std::optional<double> CircularArc::radius() const {
  if (straight()) return std::nullopt;
  return length / turning;
}

Eigen::Vector2d CircularArc::pointAt(double s) const {
  const double half = curvature() * s / 2;
  const double chord = s * biarc::sinc(half);
  return start + chord * Eigen::Vector2d(std::cos(startAngle + half), std::sin(startAngle + half));
}

Result<Biarc> makeBiarc(const Eigen::Vector2d& start, double startAngle, const Eigen::Vector2d& end,
                        double endAngle, double share) {
  const Result<ChordAngles> c = chordAngles(start, startAngle, end, endAngle);
  if (!c) return tl::unexpected<Error>(c.error());
  if (!(share > 0 && share < 1))
    return fail(ErrorCode::badInput, "the share of a biarc must lie between 0 and 1, not " + shortText(share),
                "share", share, 1);
  return fromShare(start, startAngle, *c, share);
}

Result<std::vector<double>> biarcTangents(const std::vector<Eigen::Vector2d>& points, bool closed) {
  const std::size_t count = points.size();
  if (count < (closed ? 3u : 2u))
    return fail(ErrorCode::badInput,
                std::string("tangents from neighbours need at least ") + (closed ? "3" : "2") +
                    " points; there are " + std::to_string(count),
                "points", double(count), closed ? 3 : 2);
  std::vector<double> angles(count);
  const auto edge = [&](std::size_t i) -> Eigen::Vector2d { return points[(i + 1) % count] - points[i]; };
  for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i)
    if (const double length = edge(i).stableNorm(); !(length > 0) || !std::isfinite(length))
      return fail(
          ErrorCode::badInput,
          "point " + std::to_string(i) + " and the next one coincide or are not finite; drop one of them",
          "points[" + std::to_string(i) + "]");
  for (std::size_t i = 0; i < count; ++i) {
    const bool first = !closed && i == 0, last = !closed && i + 1 == count;
    const Eigen::Vector2d in = first ? edge(i) : edge((i + count - 1) % count);
    const Eigen::Vector2d out = last ? in : edge(i);
    Eigen::Vector2d along = in + out;
    const Eigen::Vector2d u = in.stableNormalized(), v = out.stableNormalized();
    constexpr double kReversal = -0.8660254037844386;  // cos 150°
    if (u.dot(v) < kReversal) {
      const double side = u.x() * v.y() - u.y() * v.x() < 0 ? -1 : 1;
      along = side * Eigen::Vector2d(-(u - v).y(), (u - v).x());
    }
    angles[i] = std::atan2(along.y(), along.x());
  }
  return angles;
}

Result<BiarcCurve> biarcCurve(std::vector<Eigen::Vector2d> points, std::vector<double> tangents,
                              std::vector<double> shares, bool closed) {
  if (points.size() < 2 || tangents.size() != points.size())
    return fail(ErrorCode::badInput,
                "a curve of biarcs needs at least 2 points and one tangent angle for each; there are " +
                    std::to_string(points.size()) + " points and " + std::to_string(tangents.size()) +
                    " tangents",
                "points");
  const std::size_t count = closed ? points.size() : points.size() - 1;
  if (shares.empty()) shares.assign(count, 0.5);
  if (shares.size() != count)
    return fail(ErrorCode::badInput, "a curve of biarcs needs one share for each biarc", "shares");
  BiarcCurve curve{std::move(points), std::move(tangents), std::move(shares), {}, closed};
  curve.arcs.reserve(2 * count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t next = (k + 1) % curve.points.size();
    Result<Biarc> biarc = makeBiarc(curve.points[k], curve.tangents[k], curve.points[next],
                                    curve.tangents[next], curve.shares[k]);
    if (!biarc) {
      biarc.error().message = "biarc " + std::to_string(k) + ": " + biarc.error().message;
      return tl::unexpected<Error>(biarc.error());
    }
    curve.arcs.push_back(biarc->first);
    curve.arcs.push_back(biarc->second);
  }
  return curve;
}

const char* biarcStatusName(BiarcStatus status) {
  static const char* const kNames[] = {"constructed", "converged", "bound-active", "iteration-limit",
                                       "tolerance-exceeded"};
  return kNames[int(status)];
}

namespace {

constexpr int kDigits = 6;
/// Size of the picture's longer side, in its own units, and the margin in them.
constexpr double kExtent = 1000, kMargin = 40;

class Picture {
 public:
  Picture(const Eigen::Vector2d& low, const Eigen::Vector2d& high) : low_(low), high_(high) {
    const double longest = (high - low).maxCoeff();
    scale_ = longest > 0 ? kExtent / longest : 1;
  }
  Eigen::Vector2d place(const Eigen::Vector2d& p) const {
    return {kMargin + (p.x() - low_.x()) * scale_, kMargin + (high_.y() - p.y()) * scale_};
  }
  std::string text(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d q = place(p);
    return shortText(q.x(), kDigits) + " " + shortText(q.y(), kDigits);
  }
  std::string circle(const Eigen::Vector2d& p, double radius, const char* style) const {
    const Eigen::Vector2d q = place(p);
    return "<circle cx=\"" + shortText(q.x(), kDigits) + "\" cy=\"" + shortText(q.y(), kDigits) + "\" r=\"" +
           shortText(radius) + "\" " + style + "/>\n";
  }
  double scale() const { return scale_; }
  std::string head() const {
    const Eigen::Vector2d size = (high_ - low_) * scale_ + Eigen::Vector2d::Constant(2 * kMargin);
    const std::string width = shortText(size.x(), kDigits), height = shortText(size.y(), kDigits);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + width + " " + height + "\" width=\"" +
           width + "\" height=\"" + height + "\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  }

 private:
  Eigen::Vector2d low_, high_;
  double scale_ = 1;
};

/// One arc as a path; SVG draws at most half a turn unambiguously, so a longer one is drawn as two halves.
std::string pathOf(const CircularArc& arc, const Picture& picture, const char* colour) {
  std::string path = "<path d=\"M" + picture.text(arc.start);
  if (arc.straight()) {
    path += "L" + picture.text(arc.end());
  } else {
    const std::string radius = shortText(std::abs(*arc.radius()) * picture.scale(), kDigits);
    const char* sweep = arc.turning > 0 ? " 0 0 0 " : " 0 0 1 ";
    const int parts = std::abs(arc.turning) > kPi / 2 ? 4 : 1;
    for (int i = 1; i <= parts; ++i)
      path += "A" + radius + " " + radius + sweep + picture.text(arc.pointAt(arc.length * i / parts));
  }
  return path + "\" stroke=\"" + colour + "\"/>\n";
}

}  // namespace

std::string biarcSvg(const BiarcCurve& curve, const std::vector<Eigen::Vector2d>& data) {
  Eigen::Vector2d low = curve.points.empty() ? Eigen::Vector2d::Zero() : curve.points[0], high = low;
  const auto include = [&](const Eigen::Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  };
  for (const Eigen::Vector2d& p : data) include(p);
  for (const CircularArc& arc : curve.arcs)
    for (int i = 0; i <= 8; ++i) include(arc.pointAt(arc.length * i / 8));
  const Picture picture(low, high);
  std::string svg = picture.head();
  svg += "<g fill=\"#6b7280\">\n";
  for (const Eigen::Vector2d& p : data) svg += picture.circle(p, 3, "");
  svg += "</g>\n<g fill=\"none\" stroke-width=\"2\" stroke-linecap=\"round\">\n";
  for (std::size_t i = 0; i < curve.arcs.size(); ++i)
    svg += pathOf(curve.arcs[i], picture, i % 2 == 0 ? "#0f62a8" : "#c2410c");
  svg += "</g>\n<g stroke=\"#111827\" stroke-width=\"1.5\">\n";
  for (std::size_t i = 1; i < curve.arcs.size(); i += 2)
    svg += picture.circle(curve.arcs[i].start, 3, "fill=\"#fff\"");
  for (const Eigen::Vector2d& p : curve.points) svg += picture.circle(p, 5, "fill=\"#fff\"");
  return svg + "</g>\n</svg>\n";
}

}  // namespace bw
