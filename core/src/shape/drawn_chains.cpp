// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "shape/drawn_chains.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"

namespace bw::shape {

namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr std::size_t kAllSamples = 4'000'000;                     // of all pieces, about
constexpr std::size_t kLeastSamples = 100, kMostSamples = 20'000;  // of a piece
constexpr std::size_t kMostMeeting = 64;                           // ends in one place that are looked at
constexpr std::size_t kNames = 4;                                  // of pieces in the name of a chain
constexpr double kUpright =
    0.1;  // sine of the angle between travel and plumb line below which up is chosen anew
constexpr double kWay = 0.05;        // of a chord: less across than that tells no direction
constexpr double kRounding = 1e-12;  // of a direction: what is left of an axis
constexpr double kParallel = 1e-9;   // sine of the angle between lines that do not cross
constexpr double kSameAngle = 0.01;  // degrees: planes nearer than that are told by their distance

std::string placeText(const Eigen::Vector3d& p) {
  return "(" + shortText(p.x(), 6) + ", " + shortText(p.y(), 6) + ", " + shortText(p.z(), 6) + ")";
}

double lengthOf(const Points& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

/// The largest distance of some points of one curve from the other one: no smaller than a true one by more
/// than what lies between samples.
bool same(const Points& a, const Points& b, double tolerance) {
  constexpr int kProbes = 16;
  for (int k = 1; k < kProbes; ++k) {
    const Eigen::Vector3d& p = a[(a.size() - 1) * std::size_t(k) / kProbes];
    double nearest = 1e300;
    for (std::size_t i = 1; i < b.size(); ++i) {
      const Eigen::Vector3d side = b[i] - b[i - 1];
      const double square = side.squaredNorm();
      const double share = square > 0 ? std::clamp((p - b[i - 1]).dot(side) / square, 0.0, 1.0) : 0;
      nearest = std::min(nearest, (p - b[i - 1] - share * side).norm());
    }
    if (nearest > tolerance) return false;
  }
  return true;
}

/// Ends of pieces, found by their place.
class Ends {
 public:
  explicit Ends(const std::vector<Points>& samples) {
    Bounds bounds;
    for (const Points& points : samples)
      for (const auto& p : {points.front(), points.back()}) bounds.add(p);
    bounds.size().maxCoeff(&axis_);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      ends_.push_back({samples[i].front(), 2 * i});
      ends_.push_back({samples[i].back(), 2 * i + 1});
    }
    std::ranges::sort(ends_, [&](const End& a, const End& b) {
      return a.at[axis_] != b.at[axis_] ? a.at[axis_] < b.at[axis_] : a.id < b.id;
    });
  }

  /// The ids of ends within `distance` of a place: twice the piece, and one for its last end; ascending. Of
  /// very many some.
  std::vector<std::size_t> near(const Eigen::Vector3d& place, double distance) const {
    std::vector<std::size_t> ids;
    auto at = std::ranges::lower_bound(ends_, place[axis_] - distance, {},
                                       [&](const End& end) { return end.at[axis_]; });
    for (; at != ends_.end() && at->at[axis_] <= place[axis_] + distance && ids.size() < kMostMeeting; ++at)
      if ((at->at - place).norm() <= distance) ids.push_back(at->id);
    std::ranges::sort(ids);
    return ids;
  }

 private:
  struct End {
    Eigen::Vector3d at;
    std::size_t id;
  };
  int axis_ = 0;
  std::vector<End> ends_;
};

/// Numbers of the file's curves as a list: "curves 3, 4 and 9".
std::string listed(const std::vector<const SpaceCurve*>& curves) {
  if (curves.size() == 1) return curveName(*curves.front());
  std::string text = "curves ";
  const std::size_t shown = std::min(curves.size(), kNames);
  for (std::size_t i = 0; i < shown; ++i)
    text += (i == 0 ? "" : i + 1 == curves.size() ? " and " : ", ") + std::to_string(curves[i]->number);
  if (shown < curves.size()) text += " and " + std::to_string(curves.size() - shown) + " more";
  return text;
}

/// The plane through points that they leave least: its normal, and how far they spread in it across their
/// longest direction, mm.
struct OwnPlane {
  Eigen::Vector3d normal, along;
  double spread = 0;
};
OwnPlane planeOf(const Eigen::Matrix3d& spread) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  return {axes.eigenvectors().col(0), axes.eigenvectors().col(2),
          std::sqrt(std::max(0.0, axes.eigenvalues()[1]))};
}

Eigen::Vector3d centreOf(const Points& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : points) sum += p;
  return sum / double(points.size());
}

Eigen::Matrix3d spreadOf(const Points& points) {
  const Eigen::Vector3d centre = centreOf(points);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto& p : points) spread += (p - centre) * (p - centre).transpose();
  return spread / double(points.size());
}

struct Place {
  double y = 0, off = 0;
};
/// The plane across `normal` that leaves as much of a chain on either side.
Place placeOf(const Chain& chain, const Eigen::Vector3d& normal) {
  double low = 1e300, high = -1e300;
  const auto take = [&](const Points& points) {
    for (const auto& p : points) {
      low = std::min(low, normal.dot(p));
      high = std::max(high, normal.dot(p));
    }
  };
  take(chain.samples);
  // Samples pass over corners of long polylines.
  for (const Chain::Piece& piece : chain.pieces)
    if (piece.curve->degree == 1) take(piece.curve->poles);
  return {(low + high) / 2, (high - low) / 2};
}

double farthestOff(const std::vector<Chain>& chains, const Eigen::Vector3d& normal) {
  double off = 0;
  for (const Chain& chain : chains) off = std::max(off, placeOf(chain, normal).off);
  return off;
}

/// Why chains do not lie in planes across one direction.
tl::unexpected<Error> notParallel(const std::vector<Chain>& chains, const Eigen::Vector3d& normal,
                                  double limit) {
  std::vector<OwnPlane> own;
  std::size_t worst = 0, flattest = 0;
  double bent = 0;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    own.push_back(planeOf(spreadOf(chains[i].samples)));
    const double off = placeOf(chains[i], own[i].normal).off;
    if (off > bent) bent = off, worst = i;
    if (own[i].spread > own[flattest].spread) flattest = i;
  }
  if (bent > limit)
    return fail(ErrorCode::badInput,
                chains[worst].name() + " is not planar: it leaves its plane by " + shortText(bent) +
                    " mm, where " + shortText(limit) +
                    " mm are taken (half the tolerance); project it to a plane, or allow a larger tolerance",
                chains[worst].name(), bent, limit);
  double widest = 0;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    if (i == flattest) continue;
    const double angle = own[i].spread > limit
                             ? std::acos(std::min(1.0, std::abs(own[i].normal.dot(own[flattest].normal))))
                             : std::asin(std::min(1.0, std::abs(own[i].along.dot(own[flattest].normal))));
    if (angle > widest) widest = angle, worst = i;
  }
  const double off = placeOf(chains[worst], own[flattest].normal).off;
  return fail(ErrorCode::badInput,
              "the plane of " + chains[worst].name() + " is not parallel to that of " +
                  chains[flattest].name() +
                  (toDegrees(widest) > kSameAngle ? ": it is turned by " + shortText(toDegrees(widest)) + "°"
                                                  : std::string()) +
                  ", so that the curve leaves a parallel plane by " +
                  shortText(std::max(off, farthestOff(chains, normal))) + " mm, where " + shortText(limit) +
                  " mm are taken (half the tolerance); a loft takes curves in parallel planes across the "
                  "travel of the blade: draw it so, or leave the curve out",
              chains[worst].name(), off, limit);
}

Result<Eigen::Vector3d> travelOf(const std::vector<Chain>& chains, double limit) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Chain& chain : chains) spread += spreadOf(chain.samples) / double(chains.size());
  const OwnPlane common = planeOf(spread);
  Eigen::Vector3d normal = common.normal;
  if (common.spread <= limit) {  // parallel lines: they lie beside each other that way
    Points centres;
    for (const Chain& chain : chains) {
      const Eigen::Vector3d centre = centreOf(chain.samples);
      centres.push_back(centre - centre.dot(common.along) * common.along);
    }
    const OwnPlane beside = planeOf(spreadOf(centres));
    normal = (beside.along - beside.along.dot(common.along) * common.along).normalized();
  }
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  if (normal[axis] < 0) normal = -normal;
  if (farthestOff(chains, Eigen::Vector3d::Unit(axis)) <= limit) normal = Eigen::Vector3d::Unit(axis);
  if (farthestOff(chains, normal) > limit) return notParallel(chains, normal, limit);
  for (double& part : normal) part = std::abs(part) < kRounding ? 0 : part;
  return normal.normalized();
}

/// The axes around a travel: z up, or where the travel is upright, x along the curves.
Eigen::Matrix3d axesAround(const Eigen::Vector3d& travel, const std::vector<Chain>& chains) {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ() - travel.z() * travel;
  if (up.norm() < kUpright) {
    Eigen::Vector3d chord = Eigen::Vector3d::Zero();
    for (const Chain& chain : chains) {
      const Eigen::Vector3d own = chain.samples.back() - chain.samples.front();
      chord += chord.dot(own) < 0 ? Eigen::Vector3d(-own) : own;
    }
    int axis = 0;
    Eigen::Vector3d(chord - chord.dot(travel) * travel).cwiseAbs().maxCoeff(&axis);
    Eigen::Vector3d x = Eigen::Vector3d::Unit(axis);
    x = (x - x.dot(travel) * travel).normalized();
    up = x.cross(travel);
  }
  Eigen::Matrix3d axes;
  axes.col(1) = travel;
  axes.col(2) = up.normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return axes;
}

/// All run the same way as their neighbours, and most of them along x.
void runAlike(std::vector<Chain>& chains, const Eigen::Matrix3d& axes) {
  for (std::size_t i = 1; i < chains.size(); ++i) {
    const Points &before = chains[i - 1].samples, &own = chains[i].samples;
    const auto apart = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      const Eigen::Vector3d d = a - b;
      return (d - d.dot(axes.col(1)) * axes.col(1)).norm();
    };
    const double as = apart(own.front(), before.front()) + apart(own.back(), before.back());
    const double turned = apart(own.back(), before.front()) + apart(own.front(), before.back());
    if (turned < as) chains[i].reverse();
  }
  Eigen::Vector3d chord = Eigen::Vector3d::Zero();
  for (const Chain& chain : chains) chord += chain.samples.back() - chain.samples.front();
  const double across = chord.dot(axes.col(0)), up = chord.dot(axes.col(2));
  const bool backwards = std::abs(across) > kWay * std::abs(up) ? across < 0 : up < 0;
  if (backwards)
    for (Chain& chain : chains) chain.reverse();
}

/// Where the lines from point to point of two curves in one plane cross, if they do.
std::optional<Eigen::Vector3d> crossing(const Points& a, const Points& b, const Eigen::Matrix3d& axes) {
  const auto flat = [&](const Eigen::Vector3d& p) {
    return Eigen::Vector2d(axes.col(0).dot(p), axes.col(2).dot(p));
  };
  const auto step = [](const Points& p) { return std::max<std::size_t>(1, p.size() / 500); };
  for (std::size_t i = 0; i + 1 < a.size(); i += step(a))
    for (std::size_t j = 0; j + 1 < b.size(); j += step(b)) {
      const Eigen::Vector3d &p = a[i], &q = a[std::min(i + step(a), a.size() - 1)];
      const Eigen::Vector3d& end = b[std::min(j + step(b), b.size() - 1)];
      if (const auto shares = crossingOf(flat(p), flat(q), flat(b[j]), flat(end)))
        return p + shares->first * (q - p);
    }
  return {};
}

}  // namespace

std::optional<std::pair<double, double>> crossingOf(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                                    const Eigen::Vector2d& otherFrom,
                                                    const Eigen::Vector2d& otherTo) {
  const auto area = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  const Eigen::Vector2d u = to - from, v = otherTo - otherFrom, r = otherFrom - from;
  const double both = area(u, v);
  if (!(std::abs(both) > kParallel * u.norm() * v.norm())) return {};
  const double s = area(r, v) / both, t = area(r, u) / both;
  if (s < 0 || s > 1 || t < 0 || t > 1) return {};
  return std::pair(s, t);
}

std::string Chain::name() const {
  std::vector<const SpaceCurve*> curves;
  for (const Piece& piece : pieces) curves.push_back(piece.curve);
  return curves.size() == 1 ? curveName(*curves.front()) : "the curve of " + listed(curves);
}

void Chain::reverse() {
  std::ranges::reverse(pieces);
  for (Piece& piece : pieces) piece.reversed = !piece.reversed;
  std::ranges::reverse(samples);
}

Result<Chains> chainsOf(const std::vector<SpaceCurve>& curves, double tolerance) {
  Chains found;
  std::vector<const SpaceCurve*> pieces;
  std::vector<Points> samples;
  const std::size_t most =
      std::clamp(kAllSamples / std::max<std::size_t>(1, curves.size()), kLeastSamples, kMostSamples);
  for (const SpaceCurve& curve : curves) {
    Points points = curve.samples(most);
    if (lengthOf(points) <= tolerance) {
      found.tiny.push_back(curveName(curve));
      continue;
    }
    pieces.push_back(&curve);
    samples.push_back(std::move(points));
  }
  if (pieces.empty()) return found;
  const Ends ends(samples);
  const std::size_t count = pieces.size();
  // A piece that is there already is left out.
  std::vector<bool> out(count, false);
  for (std::size_t i = 0; i < count; ++i)
    for (const std::size_t end : ends.near(samples[i].front(), tolerance)) {
      const std::size_t other = end / 2;
      if (other >= i || out[other]) continue;
      const Eigen::Vector3d& far = end % 2 ? samples[other].front() : samples[other].back();
      if ((far - samples[i].back()).norm() > tolerance || !same(samples[i], samples[other], tolerance) ||
          !same(samples[other], samples[i], tolerance))
        continue;
      out[i] = true;
      found.repeated.push_back(curveName(*pieces[i]) + " (as curve " + std::to_string(pieces[other]->number) +
                               ")");
      break;
    }
  // The end that each end touches.
  std::vector<std::size_t> partner(2 * count, 2 * count);
  for (std::size_t id = 0; id < 2 * count; ++id) {
    if (out[id / 2]) continue;
    const Eigen::Vector3d& place = id % 2 ? samples[id / 2].back() : samples[id / 2].front();
    std::vector<std::size_t> touching;
    for (const std::size_t other : ends.near(place, tolerance))
      if (other != id && !out[other / 2]) touching.push_back(other);
    if (touching.size() > 1) {
      std::vector<const SpaceCurve*> meeting = {pieces[id / 2]};
      for (const std::size_t other : touching)
        if (std::ranges::find(meeting, pieces[other / 2]) == meeting.end())
          meeting.push_back(pieces[other / 2]);
      return fail(ErrorCode::badInput,
                  (touching.size() + 1 < kMostMeeting ? std::to_string(touching.size() + 1)
                                                      : std::string("Very many")) +
                      " ends of " + listed(meeting) + " meet at " + placeText(place) +
                      "; a section goes on in one curve: leave out the others",
                  curveName(*pieces[id / 2]), double(touching.size() + 1), 2.0);
    }
    if (!touching.empty()) partner[id] = touching.front();
  }
  std::vector<bool> used(count, false);
  for (std::size_t first = 0; first < count; ++first) {
    if (out[first] || used[first]) continue;
    // Back to an end that touches nothing, then on from there.
    std::size_t end = 2 * first;
    for (std::size_t steps = 0; partner[end] < 2 * count && steps <= count; ++steps) {
      end = partner[end] ^ 1;
      if (end / 2 == first) break;
    }
    Chain chain;
    const bool closed = partner[end] < 2 * count;
    for (std::size_t at = end; !used[at / 2];) {
      used[at / 2] = true;
      const bool reversed = at % 2 == 1;
      chain.pieces.push_back({pieces[at / 2], reversed});
      Points points = samples[at / 2];
      if (reversed) std::ranges::reverse(points);
      chain.samples.insert(chain.samples.end(), points.begin(), points.end());
      const std::size_t next = partner[at ^ 1];
      if (next >= 2 * count) break;
      at = next;
    }
    if (closed)
      return fail(ErrorCode::badInput,
                  chain.name() +
                      " is closed; a section is open, from one side of the block to the other: cut it "
                      "open, or leave out the part that is no section",
                  chain.name());
    found.chains.push_back(std::move(chain));
  }
  return found;
}

Result<PlacedChains> placed(std::vector<Chain>& chains, double limit, double apart) {
  const Result<Eigen::Vector3d> travel = travelOf(chains, limit);
  if (!travel) return tl::unexpected<Error>(travel.error());
  std::vector<std::pair<Place, std::size_t>> order;
  for (std::size_t i = 0; i < chains.size(); ++i) order.emplace_back(placeOf(chains[i], *travel), i);
  std::ranges::stable_sort(order, {}, [](const auto& entry) { return entry.first.y; });
  const Eigen::Matrix3d axes = axesAround(*travel, chains);
  PlacedChains result{axes, {}, {}};
  std::vector<Chain> sorted;
  for (const auto& [place, index] : order) {
    if (!sorted.empty() && place.y - result.y.back() <= apart) {
      const Chain &one = sorted.back(), &other = chains[index];
      const auto cross = crossing(one.samples, other.samples, axes);
      return fail(ErrorCode::badInput,
                  one.name() + " and " + other.name() +
                      (cross ? " cross at " + placeText(*cross) : std::string(" lie in one plane")) + " (" +
                      shortText(place.y - result.y.back()) +
                      " mm apart along the travel); a loft has one curve in each plane: leave one of them "
                      "out, or join them",
                  other.name(), place.y - result.y.back(), apart);
    }
    result.y.push_back(place.y);
    result.off.push_back(place.off);
    sorted.push_back(std::move(chains[index]));
  }
  chains = std::move(sorted);
  runAlike(chains, axes);
  return result;
}

}  // namespace bw::shape
