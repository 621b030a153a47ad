// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/shape/drawn_sections.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "bw/core/base/units.h"
#include "bw/core/constructions/spline_constructions.h"
#include "bw/core/text/number_text.h"
#include "shape/drawn_chains.h"
#include "shape/shapes.h"

namespace bw {

namespace {

using shape::Chain;
using Kind = SectionCurve::Kind;
using Points = std::vector<Eigen::Vector2d>;

constexpr double kPlanarShare = 0.5;           // of the tolerance that a curve may leave its plane by
constexpr int kFewSamples = 200;               // of a curve while places are sought
constexpr std::size_t kCloseSamples = 20'000;  // where these were too few
constexpr int kCloseEven = 2'000;              // even ones beside these
constexpr std::size_t kMostSamples = 200'000;  // with which the result is measured
constexpr int kEach = 16;                      // samples more of each span, both ways, of that
constexpr double kPeak = 0.8;     // of the largest distance: peaks that are sought between samples
constexpr int kPeakBits = 20;     // of their places
constexpr int kRounds = 8;        // in which places are shifted for one number of points
constexpr double kOrder = 4;      // of the error of a cubic over its span
constexpr double kMostShift = 2;  // of a span in a round
constexpr int kStepUntil = 12;    // points up to which each number is tried
constexpr double kGrowth = 1.15;  // beyond
constexpr int kChordRounds = 40;
constexpr double kLeastSpan = 1e-6;  // of a length, between two points
constexpr double kFlat = 1e-6;       // of a chord: a cubic that leaves it by less has legs as they are
constexpr double kMostLonger = 1.5;
constexpr double kChord = 1e-12;           // of a length, by which the shares of chords differ
constexpr double kSides = 2;               // of a polyline, to either side, that tell its tangent
constexpr double kNoAngle = 1e-12;         // rad
constexpr int kAcross = 64, kAlong = 256;  // places of the loft by which its bounds are told
constexpr int kLoopSamples = 300;
constexpr double kPassing = 4;  // tolerances of length that two pieces have beyond where they pass each other
constexpr double kReadable = 1e9;  // parts of a mm that places are rounded to

struct Sample {
  double share = 0;  ///< of the length; of a section its parameter
  Eigen::Vector2d point;
};

/// Puts `each` evenly spaced samples of every span between `breaks` among those that are there.
template <class PointAt>
void addBetween(std::vector<Sample>& samples, const std::vector<double>& breaks, int each,
                const PointAt& pointAt) {
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
    for (int i = 0; i < each; ++i) {
      const double share = breaks[k] + (breaks[k + 1] - breaks[k]) * (i + 0.5) / each;
      samples.push_back({share, pointAt(share)});
    }
  std::ranges::stable_sort(samples, {}, &Sample::share);
}

/// A chain in its plane, told by its arc length.
class PlaneCurve {
 public:
  static Result<PlaneCurve> of(const Chain& chain, const Frame& plane) {
    PlaneCurve curve;
    for (const Chain::Piece& piece : chain.pieces) {
      Result<PlanarCurve> planar = inPlane(*piece.curve, plane);
      if (!planar) return tl::unexpected<Error>(planar.error());
      curve.pieces_.push_back(piece.reversed ? planar->reversed() : std::move(*planar));
      curve.from_.push_back(curve.length_);
      curve.length_ += curve.pieces_.back().length();
    }
    return curve;
  }

  double length() const { return length_; }
  Eigen::Vector2d at(double s) const {
    const auto [piece, t] = find(s);
    return piece->value(t);
  }
  double angle(double s) const {
    const auto [piece, t] = find(s);
    Eigen::Vector2d tangent = piece->tangent(t);
    if (piece->kind() == PlanarCurve::Kind::points) {
      // A side of a polyline turns against the curve that is meant: that of the parabola through three
      // places.
      const double step = std::min(length_ / 4, kSides * piece->length() / double(piece->poles().size() - 1));
      const double middle = std::clamp(s, step, length_ - step), off = (s - middle) / step;
      const Eigen::Vector2d before = at(middle - step), here = at(middle), after = at(middle + step);
      tangent = (after - before) / 2 + off * (after - 2 * here + before);
    }
    return std::atan2(tangent.y(), tangent.x());
  }

  /// Points of it, both ends of each piece and some in each of its spans among them, `most` about, and `even`
  /// ones beside these: a long arc is one span, whose few nodes pass over what it leaves of a section.
  std::vector<Sample> samples(std::size_t most, int even) const {
    std::vector<Sample> all;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const PlanarCurve& piece = pieces_[i];
      const PlanarCurve::Quadrature& inner = piece.quadrature();
      all.push_back({from_[i] / length_, piece.value(piece.start())});
      const std::size_t stride = std::max<std::size_t>(1, inner.point.size() * pieces_.size() / most);
      for (std::size_t k = stride / 2; k < inner.point.size(); k += stride)
        all.push_back({(from_[i] + inner.arc[k]) / length_, inner.point[k]});
      if (piece.kind() == PlanarCurve::Kind::points) {
        double arc = 0;
        const Points& corners = piece.poles();
        const std::size_t step = std::max<std::size_t>(1, corners.size() * pieces_.size() / most);
        for (std::size_t k = 1; k < corners.size(); ++k) {
          arc += (corners[k] - corners[k - 1]).norm();
          if (k % step == 0) all.push_back({(from_[i] + arc) / length_, corners[k]});
        }
      }
      all.push_back({(from_[i] + piece.length()) / length_, piece.value(piece.end())});
    }
    addBetween(all, {0, 1}, even, [&](double share) { return at(share * length_); });
    return all;
  }

  /// How far a point lies from it, downhill from the place at s.
  double distance(const Eigen::Vector2d& p, double s) const {
    std::size_t i = pieceAt(s);
    double t = pieces_[i].nearestParameter(p, pieces_[i].parameterAt(s - from_[i]));
    double best = (pieces_[i].value(t) - p).norm();
    for (const bool on : {true, false})
      while (on ? t >= pieces_[i].end() && i + 1 < pieces_.size() : t <= pieces_[i].start() && i > 0) {
        const PlanarCurve& next = pieces_[on ? i + 1 : i - 1];
        const double there = next.nearestParameter(p, on ? next.start() : next.end());
        const double distance = (next.value(there) - p).norm();
        if (distance > best) break;
        best = distance;
        t = there;
        i = on ? i + 1 : i - 1;
      }
    return best;
  }
  /// The same from anywhere, slower.
  double distance(const Eigen::Vector2d& p) const {
    double best = std::numeric_limits<double>::infinity();
    for (const PlanarCurve& piece : pieces_)
      best = std::min(best, (piece.value(piece.nearestParameter(p)) - p).norm());
    return best;
  }

 private:
  std::size_t pieceAt(double s) const {
    const auto above = std::upper_bound(from_.begin() + 1, from_.end(), s);
    return std::size_t(above - from_.begin()) - 1;
  }
  std::pair<const PlanarCurve*, double> find(double s) const {
    const std::size_t i = pieceAt(s);
    return {&pieces_[i], pieces_[i].parameterAt(s - from_[i])};
  }

  std::vector<PlanarCurve> pieces_;
  std::vector<double> from_;  // arc length at which each begins
  double length_ = 0;
};

/// What sections are to follow.
struct Wanted {
  std::string name;
  PlaneCurve curve;
  double y = 0, off = 0;
  double bound = 0;  ///< mm that its section may be off in the plane
  std::vector<Sample> few;
};

struct Miss {
  double share = 0;     ///< of what is allowed
  double distance = 0;  ///< mm in the plane
  std::size_t span = 0;
  Eigen::Vector2d where = Eigen::Vector2d::Zero();
};

/// Sections of one number of points for all curves, and by how much each span of theirs is off.
struct Trial {
  std::vector<double> shares;  ///< 0 … 1, of the length: where the points lie
  std::vector<SectionCurve> sections;
  std::vector<Miss> worst;    ///< of each curve
  std::vector<double> spans;  ///< the largest share of what is allowed, of any curve
  double miss = 0;            ///< the largest of these

  bool within() const { return miss <= 1; }
};

double readable(double mm) { return std::round(mm * kReadable) / kReadable + 0.0; }
Eigen::Vector2d readable(const Eigen::Vector2d& p) { return {readable(p.x()), readable(p.y())}; }

/// Arc lengths at which the chords between the points of a curve have given shares of their sum, so that the
/// splines of all sections have the same knots.
std::vector<double> arcsOfChords(const PlaneCurve& curve, const std::vector<double>& shares) {
  const double length = curve.length();
  std::vector<double> arcs;
  for (const double share : shares) arcs.push_back(share * length);
  const std::size_t last = shares.size() - 1;
  for (int round = 0; round < kChordRounds; ++round) {
    std::vector<double> chords = {0};
    for (std::size_t i = 1; i <= last; ++i)
      chords.push_back(chords.back() + (curve.at(arcs[i]) - curve.at(arcs[i - 1])).norm());
    double most = 0;
    for (std::size_t i = 1; i < last; ++i) {
      const double shift = shares[i] - chords[i] / chords.back();
      most = std::max(most, std::abs(shift));
      arcs[i] += shift * length;
    }
    for (std::size_t i = 1; i < last; ++i) arcs[i] = std::clamp(arcs[i], arcs[i - 1], length);
    if (most <= kChord) break;
  }
  // Where chords tell too little of a curve the points lie by its length.
  for (std::size_t i = 1; i <= last; ++i)
    if (!(arcs[i] - arcs[i - 1] > kLeastSpan * length)) {
      for (std::size_t k = 0; k <= last; ++k) arcs[k] = shares[k] * length;
      break;
    }
  return arcs;
}

/// Makes the legs of a cubic so much longer or shorter that its middle lies as far beside the chord as that
/// of the curve.
void meetMiddle(CubicPoles& cubic, const Eigen::Vector2d& middle) {
  const Eigen::Vector2d chord = cubic[3] - cubic[0], across(-chord.y(), chord.x());
  const Eigen::Vector2d first = cubic[1] - cubic[0], last = cubic[3] - cubic[2];
  const double has = 3 * across.dot(first - last);
  const double wants = across.dot(8 * middle - 4 * (cubic[0] + cubic[3]));
  if (!(std::abs(has) > kFlat * chord.squaredNorm())) return;
  const double longer = std::clamp(wants / has, 1 / kMostLonger, kMostLonger);
  cubic[1] = cubic[0] + longer * first;
  cubic[2] = cubic[3] - longer * last;
}

/// The section of a curve through its points there.
Result<SectionCurve> sectionAt(const Wanted& wanted, Kind kind, const std::vector<double>& shares) {
  SectionCurve section{wanted.y, kind, {}};
  const PlaneCurve& curve = wanted.curve;
  Points places;
  std::vector<double> angles;
  const std::vector<double> arcs = arcsOfChords(curve, shares);
  for (const double arc : arcs) {
    places.push_back(readable(curve.at(arc)));
    if (kind == Kind::bezier) angles.push_back(curve.angle(arc));
  }
  if (kind != Kind::bezier) {
    section.points = std::move(places);
    return section;
  }
  Result<std::vector<CubicPoles>> chain = bezierChain(places, angles);
  if (!chain) return tl::unexpected<Error>(chain.error());
  for (std::size_t i = 0; i < chain->size(); ++i)
    meetMiddle((*chain)[i], curve.at(0.5 * (arcs[i] + arcs[i + 1])));
  section.points.push_back(places.front());
  for (const CubicPoles& cubic : *chain)
    section.points.insert(section.points.end(), cubic.begin() + 1, cubic.end());
  return section;
}

/// The place among `to` that lies as a place lies among `from`.
double among(const std::vector<double>& from, const std::vector<double>& to, double place) {
  const auto above = std::upper_bound(from.begin() + 1, from.end() - 1, place);
  const std::size_t k = std::size_t(above - from.begin()) - 1;
  const double width = from[k + 1] - from[k];
  const double within = width > 0 ? std::clamp((place - from[k]) / width, 0.0, 1.0) : 0.5;
  return to[k] + within * (to[k + 1] - to[k]);
}

/// How far a curve and its section lie from each other.
class Misses {
 public:
  Misses(double bound, std::size_t spans, bool exact) : bound_(bound), exact_(exact), spans_(spans, 0.0) {}

  /// Looks from samples of one to the other: `near` is the distance downhill from where a place of the one
  /// leads to, `far` the one from anywhere, `pointAt` a point of the one.
  template <class PointAt, class Near, class Far>
  void look(const std::vector<Sample>& samples, const std::vector<double>& breaks, const PointAt& pointAt,
            const Near& near, const Far& far) {
    std::vector<double> distances;
    std::size_t span = 0;
    const auto take = [&](double distance, const Eigen::Vector2d& p) {
      // What is off by more than all before may have been led astray.
      if (exact_ && distance / bound_ > worst_.share) distance = std::min(distance, far(p));
      const double share = distance / bound_;
      spans_[span] = std::max(spans_[span], share);
      if (share > worst_.share) worst_ = {share, distance, span, p};
    };
    for (const Sample& sample : samples) {
      while (span + 2 < breaks.size() && sample.share > breaks[span + 1]) ++span;
      distances.push_back(near(sample.point, sample.share));
      take(distances.back(), sample.point);
    }
    if (!exact_) return;
    // The largest distance lies between samples.
    const double most = worst_.distance;
    span = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      while (span + 2 < breaks.size() && samples[i].share > breaks[span + 1]) ++span;
      const std::size_t before = i == 0 ? i : i - 1, after = std::min(i + 1, samples.size() - 1);
      if (distances[i] < kPeak * most || distances[before] > distances[i] || distances[after] > distances[i])
        continue;
      const double from = samples[before].share, to = samples[after].share;
      if (!(to > from)) continue;
      const auto nearness = [&](double place) { return -near(pointAt(place), place); };
      const auto [place, value] = boost::math::tools::brent_find_minima(nearness, from, to, kPeakBits);
      take(-value, pointAt(place));
    }
  }

  const Miss& worst() const { return worst_; }
  const std::vector<double>& spans() const { return spans_; }

 private:
  double bound_;
  bool exact_;
  std::vector<double> spans_;
  Miss worst_;
};

/// How far a curve lies from its section at samples of it; or, `exact`, how far each lies from the other.
Result<Miss> missOf(const Wanted& wanted, const SectionCurve& section, const std::vector<double>& shares,
                    std::vector<Sample> samples, bool exact, std::vector<double>& spans) {
  const Result<PlanarCurve> own = shape::curveOf(section);
  if (!own) return tl::unexpected<Error>(own.error());
  // Where the points lie among the parameters of the section.
  std::vector<double> at;
  const std::size_t each = section.kind == Kind::bezier ? 3 : 1;
  double seed = own->start();
  for (std::size_t i = 0; i < shares.size(); ++i) {
    seed = i == 0                   ? own->start()
           : i + 1 == shares.size() ? own->end()
                                    : own->nearestParameter(section.points[i * each], shares[i]);
    at.push_back(seed);
  }
  const PlaneCurve& curve = wanted.curve;
  const auto ofCurve = [&](double share) { return curve.at(share * curve.length()); };
  Misses misses(wanted.bound, shares.size() - 1, exact);
  if (exact) addBetween(samples, shares, kEach, ofCurve);
  misses.look(
      samples, shares, ofCurve,
      [&](const Eigen::Vector2d& p, double share) {
        return (own->value(own->nearestParameter(p, among(shares, at, share))) - p).norm();
      },
      [&](const Eigen::Vector2d& p) { return (own->value(own->nearestParameter(p)) - p).norm(); });
  if (exact) {
    // A section may leave the curve where no place of the curve shows it: beside a corner.
    const auto ofSection = [&](double t) { return own->value(t); };
    std::vector<Sample> back;
    addBetween(back, at, kEach, ofSection);
    misses.look(
        back, at, ofSection,
        [&](const Eigen::Vector2d& p, double t) {
          return curve.distance(p, among(at, shares, t) * curve.length());
        },
        [&](const Eigen::Vector2d& p) { return curve.distance(p); });
  }
  spans = misses.spans();
  return misses.worst();
}

class Search {
 public:
  Search(const std::vector<Wanted>& wanted, Kind kind, const RunContext& context)
      : wanted_(wanted), kind_(kind), context_(context) {}

  /// Looks at many samples of the curves from now on.
  void lookCloser() {
    close_.resize(wanted_.size());
    for (std::size_t i = 0; i < wanted_.size(); ++i)
      close_[i] = wanted_[i].curve.samples(kCloseSamples, kCloseEven);
  }
  bool close() const { return !close_.empty(); }

  Result<Trial> measure(std::vector<double> shares, bool all = false) const {
    const std::size_t count = wanted_.size();
    Trial trial{std::move(shares), std::vector<SectionCurve>(count), std::vector<Miss>(count), {}, 0};
    std::vector<std::vector<double>> spans(count);
    std::vector<std::optional<Error>> errors(count);
    const auto done = parallelFor(context_, int(count), [&](int k) {
      const auto i = std::size_t(k);
      Result<SectionCurve> section = sectionAt(wanted_[i], kind_, trial.shares);
      if (!section) {
        errors[i] = section.error();
        return;
      }
      const Result<Miss> miss = missOf(wanted_[i], *section, trial.shares,
                                       all       ? wanted_[i].curve.samples(kMostSamples, 0)
                                       : close() ? close_[i]
                                                 : wanted_[i].few,
                                       all, spans[i]);
      if (!miss) {
        errors[i] = miss.error();
        return;
      }
      trial.sections[i] = std::move(*section);
      trial.worst[i] = *miss;
    });
    if (!done) return tl::unexpected<Error>(done.error());
    for (std::size_t i = 0; i < count; ++i)
      if (errors[i]) {
        errors[i]->message = wanted_[i].name + ": " + errors[i]->message;
        return tl::unexpected<Error>(*errors[i]);
      }
    trial.spans.assign(trial.shares.size() - 1, 0.0);
    for (const std::vector<double>& own : spans)
      for (std::size_t j = 0; j < own.size(); ++j) trial.spans[j] = std::max(trial.spans[j], own[j]);
    trial.miss = *std::ranges::max_element(trial.spans);
    return trial;
  }

  /// The best found of so many points: spans that are off more become shorter, until all are off alike.
  Result<Trial> best(std::vector<double> shares, bool untilWithin) const {
    std::optional<Trial> best;
    Error last;
    for (int round = 0; round < kRounds; ++round) {
      Result<Trial> trial = measure(shares);
      if (!trial) {
        if (trial.error().code == ErrorCode::cancelled || !best) return trial;
        break;
      }
      const std::vector<double> spans = trial->spans;
      if (!best || trial->miss < best->miss) best = std::move(*trial);
      if ((untilWithin && best->within()) || spans.size() == 1) break;
      shares = shifted(shares, spans);
    }
    return std::move(*best);
  }

  /// Another number of points, spread as these are.
  static std::vector<double> spread(const std::vector<double>& shares, int points) {
    std::vector<double> more;
    for (int i = 0; i < points; ++i) {
      const double place = double(i) / (points - 1) * double(shares.size() - 1);
      const auto k = std::min(std::size_t(place), shares.size() - 2);
      more.push_back(shares[k] + (place - double(k)) * (shares[k + 1] - shares[k]));
    }
    more.back() = 1;
    return more;
  }

 private:
  static std::vector<double> shifted(const std::vector<double>& shares, const std::vector<double>& spans) {
    double mean = 0;
    for (const double span : spans) mean += span / double(spans.size());
    std::vector<double> next = {0};
    for (std::size_t j = 0; j < spans.size(); ++j) {
      const double wish = spans[j] > 0 ? std::pow(mean / spans[j], 1 / kOrder) : kMostShift;
      next.push_back(next.back() +
                     (shares[j + 1] - shares[j]) * std::clamp(wish, 1 / kMostShift, kMostShift));
    }
    for (double& share : next) share /= next.back();
    return next;
  }

  const std::vector<Wanted>& wanted_;
  Kind kind_;
  const RunContext& context_;
  std::vector<std::vector<Sample>> close_;
};

int mostPlaces(Kind kind) {
  return kind == Kind::ducks    ? SectionCurve::kMostDucks
         : kind == Kind::bezier ? (SectionCurve::kMost - 1) / 3 + 1
                                : SectionCurve::kMost;
}

/// A trial that does with fewer places than another one, as few as do in turn but more than `tooFew`.
Result<Trial> withFewer(const Search& search, Trial trial, int tooFew) {
  while (int(trial.shares.size()) - 1 > tooFew) {
    Result<Trial> less = search.best(Search::spread(trial.shares, int(trial.shares.size()) - 1), true);
    if (less && less->within()) less = search.measure(less->shares, true);
    if (!less && less.error().code == ErrorCode::cancelled) return less;
    if (!less || !less->within()) break;
    trial = std::move(*less);
  }
  return trial;
}

/// The fewest places found with which all curves are followed; if none are, the most.
Result<Trial> fewest(Search& search, Kind kind, const RunContext& context) {
  const int most = mostPlaces(kind);
  std::vector<double> shares = {0, 1};
  Result<Trial> last = fail(ErrorCode::internal, "no sections were tried");
  for (int points = 2, tooFew = 1;;) {
    if (context.stopped()) return stoppedError();
    context.report(std::log(points) / std::log(most), "sections");
    Result<Trial> trial = search.best(Search::spread(shares, points), true);
    if (trial && trial->within()) {
      // What lies between the samples is looked at once a number serves.
      Result<Trial> all = search.measure(trial->shares, true);
      if (all && all->within()) return withFewer(search, std::move(*all), tooFew);
      if (all && !search.close()) {
        search.lookCloser();
        continue;
      }
      trial = std::move(all);
    }
    if (!trial && trial.error().code == ErrorCode::cancelled) return trial;
    // Some numbers of points may make no curve where more of them do.
    if (trial) shares = trial->shares;
    if (trial || !last) last = std::move(trial);
    tooFew = points;
    if (points == most) return last;
    points = std::min(most, points < kStepUntil ? points + 1 : int(std::ceil(points * kGrowth)));
  }
}

/// The places of the points that a caller asks for.
Result<int> placesOf(const DrawnOptions& options) {
  const bool bezier = options.kind == Kind::bezier;
  const int most = options.kind == Kind::ducks ? SectionCurve::kMostDucks : SectionCurve::kMost;
  if (options.points < 2 || options.points > most || (bezier && options.points % 3 != 1))
    return fail(ErrorCode::badInput,
                std::to_string(options.points) + " points are asked for; " +
                    (bezier ? "chains of cubics take 4, or 3 more for each further cubic, up to "
                            : "a section takes 2 to ") +
                    std::to_string(bezier ? (most - 1) / 3 * 3 + 1 : most),
                "points", options.points, most);
  return bezier ? (options.points - 1) / 3 + 1 : options.points;
}

/// A curve that runs through itself has no side of foam. Pieces whose ends miss by less than the tolerance
/// may pass each other by as much: that is no loop.
Result<void> checkLoops(const Wanted& wanted, double tolerance) {
  Points points;
  const double step = wanted.curve.length() / kLoopSamples;
  for (int i = 0; i <= kLoopSamples; ++i) points.push_back(wanted.curve.at(step * i));
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    for (std::size_t j = i + 2; j + 1 < points.size(); ++j) {
      const auto crossing = shape::crossingOf(points[i], points[i + 1], points[j], points[j + 1]);
      if (!crossing) continue;
      const double one = step * (double(i) + crossing->first), other = step * (double(j) + crossing->second);
      if (other - one <= kPassing * tolerance) continue;
      return fail(ErrorCode::badInput,
                  wanted.name + " crosses itself (after " + shortText(one) + " and " + shortText(other) +
                      " mm of its length); a blade cannot: draw it without a loop",
                  wanted.name, points[i].x());
    }
  return {};
}

tl::unexpected<Error> notFollowed(const std::vector<Wanted>& wanted, const Trial& trial,
                                  const Eigen::Matrix3d& axes, double tolerance) {
  std::size_t worst = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (trial.worst[i].share > trial.worst[worst].share) worst = i;
  const Miss& miss = trial.worst[worst];
  const Eigen::Vector3d at = axes * Eigen::Vector3d(miss.where.x(), wanted[worst].y, miss.where.y());
  return fail(ErrorCode::badInput,
              wanted[worst].name + " is not followed within " + shortText(tolerance) + " mm by sections of " +
                  std::to_string(trial.sections[worst].points.size()) + " points each: near (" +
                  shortText(at.x(), 6) + ", " + shortText(at.y(), 6) + ", " + shortText(at.z(), 6) +
                  ") it is off by " + shortText(miss.distance) +
                  " mm; round its corners there, allow a larger tolerance, or ask for a number of points",
              wanted[worst].name, miss.distance, tolerance);
}

}  // namespace

Result<DrawnSections> sectionsThrough(const std::vector<SpaceCurve>& curves, const DrawnOptions& options,
                                      const RunContext& context) {
  if (!(options.tolerance >= DrawnOptions::kLeast) || !(options.tolerance <= DrawnOptions::kMost))
    return fail(ErrorCode::badInput,
                "a tolerance of " + shortText(options.tolerance) + " mm is asked for; it takes " +
                    shortText(DrawnOptions::kLeast) + " to " + shortText(DrawnOptions::kMost),
                "tolerance", options.tolerance);
  if (curves.size() > kMostPieces)
    return fail(ErrorCode::badInput,
                "there are " + std::to_string(curves.size()) + " curves; " + std::to_string(kMostPieces) +
                    " are taken: choose those that are sections",
                "curves", double(curves.size()), double(kMostPieces));
  std::optional<int> places;
  if (options.points != 0) {
    const Result<int> asked = placesOf(options);
    if (!asked) return tl::unexpected<Error>(asked.error());
    places = *asked;
  }
  for (const SpaceCurve& curve : curves)
    if (Result<void> ok = checkSpaceCurve(curve); !ok) return tl::unexpected<Error>(ok.error());
  Result<shape::Chains> chains = shape::chainsOf(curves, options.tolerance);
  if (!chains) return tl::unexpected<Error>(chains.error());
  const std::size_t count = chains->chains.size();
  if (count < 2 || count > std::size_t(SectionsSurface::kMost))
    return fail(ErrorCode::badInput,
                (count == 0   ? std::string("there is no curve")
                 : count == 1 ? "there is one curve, " + chains->chains.front().name()
                              : "there are " + std::to_string(count) + " curves") +
                    (count < curves.size() && count < 2 && curves.size() > 1
                         ? " once those that touch are joined and those that are there twice are left out"
                         : "") +
                    "; a loft takes 2 to " + std::to_string(SectionsSurface::kMost) +
                    (count < 2 ? ": draw another section beside it" : ": choose those that are sections"),
                "curves", double(count), count < 2 ? 2.0 : double(SectionsSurface::kMost));
  const double limit = kPlanarShare * options.tolerance;
  const Result<shape::PlacedChains> placed = shape::placed(chains->chains, limit, options.tolerance);
  if (!placed) return tl::unexpected<Error>(placed.error());
  if (context.stopped()) return stoppedError();

  DrawnSections found;
  std::vector<Wanted> wanted;
  for (std::size_t i = 0; i < count; ++i) {
    const Chain& chain = chains->chains[i];
    // (x, z) of the axes are (x, y) of the frame in which curves are flat.
    const Frame plane{Eigen::Vector3d::Zero(), placed->axes.col(0), placed->axes.col(2),
                      -placed->axes.col(1)};
    Result<PlaneCurve> curve = PlaneCurve::of(chain, plane);
    if (!curve) return tl::unexpected<Error>(curve.error());
    const double off = placed->off[i];
    Wanted own{chain.name(),
               std::move(*curve),
               readable(placed->y[i]),
               off,
               std::sqrt(options.tolerance * options.tolerance - off * off),
               {}};
    if (Result<void> ok = checkLoops(own, options.tolerance); !ok) return tl::unexpected<Error>(ok.error());
    own.few = own.curve.samples(kFewSamples, kFewSamples);
    for (const Sample& sample : own.few) found.bounds.add({sample.point.x(), own.y, sample.point.y()});
    found.longest = std::max(found.longest, own.curve.length());
    found.joined += int(chain.pieces.size()) - 1;
    wanted.push_back(std::move(own));
  }
  Search search(wanted, options.kind, context);
  Result<Trial> trial =
      places ? search.best(Search::spread({0, 1}, *places), false) : fewest(search, options.kind, context);
  if (trial && places) trial = search.measure(trial->shares, true);
  if (!trial) return tl::unexpected<Error>(trial.error());
  if (!places && !trial->within()) return notFollowed(wanted, *trial, placed->axes, options.tolerance);
  for (std::size_t i = 0; i < count; ++i) {
    const double distance = std::hypot(trial->worst[i].distance, wanted[i].off);
    if (i == 0 || distance > found.deviation) found.deviation = distance, found.worst = wanted[i].name;
  }
  SectionsSurface loft;
  loft.sections = std::move(trial->sections);
  const Result<SplineSurface> spline = shape::splineOf(loft);
  if (!spline) return tl::unexpected<Error>(spline.error());
  for (int i = 0; i <= kAcross; ++i)
    for (int k = 0; k <= kAlong; ++k)
      found.bounds.add(spline->value(double(i) / kAcross, double(k) / kAlong));
  found.surface.shape = std::move(loft);
  if (!placed->axes.isIdentity(0))
    for (int axis = 0; axis < 3; ++axis) {
      const double angle = anglesFromRotation(placed->axes)[axis];
      found.surface.rotation[axis] = std::abs(angle) < kNoAngle ? 0.0 : angle;
    }
  found.repeated = std::move(chains->repeated);
  found.tiny = std::move(chains->tiny);
  return found;
}

}  // namespace bw
