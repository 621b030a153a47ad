// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/sweep/row_certainty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "bw/core/base/units.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/sweep/maps.h"
#include "sweep/held_blade.h"
#include "sweep/smooth_way.h"
#include "sweep/sweep_findings.h"

namespace bw {

namespace {

constexpr std::size_t kSearched = 5;       // stations at which all shapes are sought
constexpr std::size_t kSearchedAgain = 8;  // at most, where one of them was lost on the way
constexpr double kSameShape = 0.5;         // mm
constexpr double kSameAngle = 1e-3;        // rad
constexpr int kPlaces = 101;               // of another shape
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr int kLooks = 4;          // parts of the way to the next station
constexpr double kNearby = 8;      // times the least barrier: where all are higher, they are looked at half
constexpr double kMuchHigher = 4;  // way alone; and times that of the station: higher ones are let be

/// A blade that can leave the straight line by so little has one shape.
bool isTaut(const BladePose& pose) { return sweep::slackOf(pose) < kOneShape; }

/// True where it is known how the blade rests.
bool isKnown(const Sweep& sweep, std::size_t i) {
  return sweep.request.weight.isZero() || (sweep.poses[i].heavy && sweep.fits[i].unknown.empty());
}

/// What else the blade of a station may rest in, and what is between.
struct OthersThere {
  std::vector<HeavyBlade> shapes = {};
  std::optional<double> barrier = std::nullopt;
  std::vector<HeavyBlade> passes = {};
  bool passesKnown = false;
};

/// Empty where they could not be sought.
std::optional<OthersThere> othersAt(const Sweep& sweep, std::size_t i) {
  const BladePose& pose = sweep.poses[i];
  OthersThere others;
  if (!isKnown(sweep, i)) return {};
  if (isTaut(pose)) return others;
  const std::optional<HeavyBranch> own = sweep::standing(sweep, pose);
  const std::optional<HeavyBlade> blade = own ? std::optional(own->blade()) : std::nullopt;
  Result<HeavyRests> all = restsOf(sweep::heldAt(sweep, pose), blade ? &*blade : nullptr);
  if (!all) return {};
  for (const HeavyBlade& shape : all->stable)
    if (sweep::apart(pose, shape) > kSameShape) others.shapes.push_back(shape);
  others.barrier = all->barrier;
  others.passes = std::move(all->passes);
  others.passesKnown = blade.has_value();
  return others;
}

/// What becomes of shapes at rest at one station on the way to another, that excluded.
class Others {
 public:
  Others(const Sweep& sweep, std::vector<StationCertainty>& stations) : sweep_(sweep), stations_(stations) {}

  void follow(const HeavyBlade& other, std::size_t from, std::size_t to) {
    const double stiffness = sweep_.request.blade.flexuralRigidity();
    const Result<HeavyBranch> start = HeavyBranch::from(other, stiffness);
    if (!start) return forget(from, to);
    HeavyBranch branch = *start;
    for (std::size_t i = from; i != to; from < to ? ++i : --i) {
      if (i != from) {
        const Result<ClampedBranch::Move> move = branch.moveTo(sweep::heldAt(sweep_, sweep_.poses[i]));
        if (!move) return forget(i, to);
        if (move->snapped) return;
      }
      see(i, branch.blade());
    }
  }

  /// What begins and ends between stations that were searched: arches that are flat enough there to hang
  /// through, and only there.
  void seekAcross(std::size_t i) {
    const BladePose& pose = sweep_.poses[i];
    if (!stations_[i].certain() || !isKnown(sweep_, i) || isTaut(pose)) return;
    const std::optional<HeavyBranch> own = sweep::standing(sweep_, pose);
    if (!own) return;
    const std::optional<HeavyBlade> blade = acrossFrom(own->blade());
    // The search tells the higher ones.
    const double highest = stations_[i].energy + stations_[i].gap;
    if (blade && sweep_.request.blade.flexuralRigidity() * blade->energy() <= highest) see(i, *blade);
  }

  /// A shape was lost: of what is there nothing is claimed, but where there can be none.
  void forget(std::size_t from, std::size_t to) {
    for (std::size_t i = from; i != to; from < to ? ++i : --i)
      if (!isTaut(sweep_.poses[i])) stations_[i].energy = kUnknown;
  }

 private:
  void see(std::size_t i, const HeavyBlade& blade) {
    if (!isKnown(sweep_, i)) return;
    std::optional<OtherRest>& lowest = stations_[i].other;
    const double energy = sweep_.request.blade.flexuralRigidity() * blade.energy();
    if (lowest && lowest->energy <= energy) return;
    const double distance = sweep::apart(sweep_.poses[i], blade);
    if (distance <= kSameShape) return;
    lowest = OtherRest{energy, distance};
    lowest->blade = blade;
    for (const Elastica::State& state : blade.sample(kPlaces)) lowest->places.push_back(state.point);
  }

  const Sweep& sweep_;
  std::vector<StationCertainty>& stations_;
};

/// Which of two such stations is the less certain one.
auto moreExcess(const std::vector<StationCertainty>& stations) {
  return [&stations](std::size_t a, std::size_t b) {
    const auto excess = [&](std::size_t i) { return stations[i].energy - stations[i].other->energy; };
    return excess(a) > excess(b);
  };
}

std::vector<sweep::Stretch> unsureStretches(const std::vector<StationCertainty>& stations) {
  return sweep::stretchesOf(
      stations.size(), [&](std::size_t i) { return stations[i].unsure(); }, moreExcess(stations));
}

/// The least barrier that is known of a stretch, with the ways to its stations and from there.
std::optional<double> barrierOf(const RowCertainty& row, const sweep::Stretch& at) {
  std::optional<double> least;
  for (std::size_t i = at.first; i <= at.last; ++i)
    if (const std::optional<double> one = row.barrierAt(i)) least = std::min(least.value_or(*one), *one);
  return least;
}

/// A pass of a station, followed to another one.
struct PassThere {
  std::size_t station;
  HeavyBlade pass;
  double barrier;  ///< N mm
};

/// The passes of a station followed to both sides, as long as they are known there and other shapes are not
/// clearly higher, up to the next station where some were found.
std::vector<PassThere> passesAround(const Sweep& sweep, const std::vector<StationCertainty>& stations,
                                    std::size_t from) {
  std::vector<PassThere> there;
  const double stiffness = sweep.request.blade.flexuralRigidity();
  for (const int step : {-1, 1}) {
    std::vector<HeavyBlade> passes = stations[from].passes;
    for (std::size_t i = from + std::size_t(step); i < stations.size() && stations[i].unsure();
         i += std::size_t(step)) {
      const std::optional<HeavyBranch> own = sweep::standing(sweep, sweep.poses[i]);
      if (!own || passes.empty()) break;
      const std::vector<HeavyPass> over = passesOver(passes, own->blade(), stiffness);
      passes.clear();
      for (const HeavyPass& pass : over) {
        there.push_back({i, pass.shape, pass.height});
        passes.push_back(pass.shape);
      }
      if (!stations[i].passes.empty()) break;
    }
  }
  return there;
}

/// Adds passes to those of their stations, each once, and the least barriers.
void addPasses(const std::vector<PassThere>& all, std::vector<StationCertainty>& stations) {
  for (const PassThere& there : all) {
    StationCertainty& station = stations[there.station];
    const double middle = 0.5 * there.pass.length();
    const auto same = [&](const HeavyBlade& pass) {
      return (pass.at(middle).point - there.pass.at(middle).point).norm() < kSameShape &&
             std::abs(std::remainder(pass.at(middle).angle - there.pass.at(middle).angle, 2 * kPi)) <
                 kSameAngle;
    };
    const bool lower = !station.barrier || there.barrier < *station.barrier;
    if (lower) station.barrier = there.barrier;
    if (std::ranges::any_of(station.passes, same)) continue;
    station.passes.insert(lower ? station.passes.begin() : station.passes.end(), there.pass);
  }
}

/// Follows what is between a blade and other shapes on the smooth way from station to station.
class Between {
 public:
  explicit Between(const Sweep& sweep, const std::vector<StationCertainty>& stations)
      : sweep_(sweep), stations_(stations), smooth_(sweep) {}

  /// N mm, the least on the way from a station to the next one, but at these. Empty, too, where a station
  /// gives way: that tells enough.
  std::optional<double> after(std::size_t i) const {
    const bool here = stations_[i].unsure(), there = stations_[i + 1].unsure();
    for (const std::size_t k : {i, i + 1})
      if (stations_[k].unsure() && stations_[k].barrier.value_or(kLeastBarrier) < kLeastBarrier) return {};
    const auto end = [&](bool both) { return both ? kLooks / 2 : kLooks - 1; };
    std::optional<double> least;
    if (here) follow(i, i + 1, end(there), least);
    if (there) follow(i + 1, i, end(here), least);
    return least;
  }

 private:
  /// So many parts of the way from one station to the other.
  void follow(std::size_t from, std::size_t to, int parts, std::optional<double>& least) const {
    const StationCertainty& start = stations_[from];
    std::optional<HeavyBranch> own = sweep::standing(sweep_, sweep_.poses[from]);
    if (!own || !start.barrier) return;
    const double stiffness = sweep_.request.blade.flexuralRigidity();
    const bool high = *start.barrier > kNearby * kLeastBarrier;
    std::vector<HeavyBlade> passes;
    for (const HeavyBlade& pass : start.passes)
      if (heightOf(pass, own->blade(), stiffness).energy < kMuchHigher * *start.barrier)
        passes.push_back(pass);
    for (int k = high ? kLooks / 2 : 1; k <= parts && !passes.empty(); ++k) {
      const std::optional<BladePose> pose =
          smooth_.at(std::lerp(sweep_.poses[from].travel, sweep_.poses[to].travel, double(k) / kLooks));
      if (!pose || isTaut(*pose)) return;
      const Result<ClampedBranch::Move> move = own->moveTo(sweep::heldAt(sweep_, *pose));
      if (!move || move->snapped) return;
      const HeavyBlade blade = own->blade();
      const std::vector<HeavyPass> over = passesOver(passes, blade, stiffness);
      if (over.empty()) return;
      const auto height = [](const HeavyPass& pass) { return pass.height; };
      const double barrier = std::ranges::min(over, {}, height).height;
      if (barrier < least.value_or(std::numeric_limits<double>::infinity())) {
        // The other shape may be clearly higher there, as it becomes on the way to one that is certain.
        if (barrier < kLeastBarrier && !hasAnother(blade, stations_[to].certain())) return;
        least = barrier;
      }
      passes.clear();
      for (const HeavyPass& pass : over) passes.push_back(pass.shape);
    }
  }

  /// True if a blade could rest in another shape that is not clearly higher. Where the search finds none,
  /// there is one but where it `ends` on the way.
  bool hasAnother(const HeavyBlade& blade, bool ends) const {
    const Result<HeavyRivals> all = rivalsOf(blade, sweep_.request.blade.flexuralRigidity());
    if (!all || !all->next) return !all || !ends;
    return all->nextEnergy - all->energy <= sweep_.request.blade.flexuralRigidity() * blade.clearGap();
  }

  const Sweep& sweep_;
  const std::vector<StationCertainty>& stations_;
  sweep::SmoothWay smooth_;
};

}  // namespace

bool StationCertainty::certain() const {
  return std::isfinite(energy) && (!other || other->energy - energy > gap);
}

bool StationCertainty::unsure() const { return std::isfinite(energy) && !certain(); }

std::optional<double> StationCertainty::energyRatio() const {
  return std::isfinite(energy) && other && other->energy > 0 ? std::optional(energy / other->energy)
                                                             : std::nullopt;
}

Result<RowCertainty> certaintyOf(const Sweep& sweep, const RunContext& context, Along along) {
  const std::size_t n = sweep.poses.size();
  const double stiffness = sweep.request.blade.flexuralRigidity();
  RowCertainty row{std::vector<StationCertainty>(n)};
  const auto ownEnergy = [&](std::size_t i) {
    return isKnown(sweep, i) ? stiffness * sweep::energyOf(sweep.poses[i]) : kUnknown;
  };
  for (std::size_t i = 0; i < n; ++i) {
    row.stations[i].energy = ownEnergy(i);
    row.stations[i].gap = stiffness * sweep::clearGapOf(sweep.poses[i]);
  }
  std::vector<std::size_t> searched;
  for (std::size_t k = 0; k < kSearched; ++k) {
    const std::size_t i = (n - 1) * k / (kSearched - 1);
    if (searched.empty() || i != searched.back()) searched.push_back(i);
  }
  std::vector<std::optional<OthersThere>> found(searched.size());
  // Each takes the stations up to the next one that was searched, in either direction; the lowest of both is
  // kept, whichever comes first.
  std::vector<std::vector<StationCertainty>> onward(2, row.stations);
  Result<void> ok = parallelFor(context, int(searched.size()), [&](int k) {
    found[std::size_t(k)] = othersAt(sweep, searched[std::size_t(k)]);
  });
  if (ok)
    ok = parallelFor(context, 2, [&](int back) {
      Others others(sweep, onward[std::size_t(back)]);
      for (std::size_t k = 0; k < searched.size() && !context.stopped(); ++k) {
        const std::size_t here = searched[k];
        if (back == 1 && k == 0) continue;
        const std::size_t onwards = k + 1 < searched.size() ? searched[k + 1] : here + 1;
        const std::size_t to = back == 1 ? searched[k - 1] : onwards;
        if (!found[k]) {
          others.forget(here, to);
          continue;
        }
        for (const HeavyBlade& blade : found[k]->shapes) others.follow(blade, here, to);
      }
    });
  if (!ok) return tl::unexpected<Error>(ok.error());
  if (context.stopped()) return stoppedError();
  for (std::size_t i = 0; i < n; ++i) {
    const std::optional<OtherRest>&a = onward[0][i].other, &b = onward[1][i].other;
    if (!std::isfinite(onward[0][i].energy + onward[1][i].energy)) row.stations[i].energy = kUnknown;
    row.stations[i].other = !a || (b && b->energy < a->energy) ? b : a;
  }
  // Where one was lost on the way all are sought once more, and followed as far as nothing is known.
  const auto isLost = [&](std::size_t i) {
    return isKnown(sweep, i) && !std::isfinite(row.stations[i].energy);
  };
  for (std::size_t i = 0, times = 0; i < n && times < kSearchedAgain; ++i) {
    if (!isLost(i)) continue;
    if (context.stopped()) return stoppedError();
    ++times;
    const std::optional<OthersThere> all = othersAt(sweep, i);
    if (!all) continue;
    std::size_t to = i;
    for (; to < n && isLost(to); ++to) row.stations[to].energy = ownEnergy(to);
    Others others(sweep, row.stations);
    for (const HeavyBlade& blade : all->shapes) others.follow(blade, i, to);
  }
  ok = parallelFor(context, int(n), [&](int i) { Others(sweep, row.stations).seekAcross(std::size_t(i)); });
  if (!ok) return tl::unexpected<Error>(ok.error());
  // How little brings it over, at the stations that were searched, where it is known by now, and where that
  // is most needed.
  std::vector<std::size_t> asked;
  std::vector<const OthersThere*> known;
  for (std::size_t k = 0; k < searched.size(); ++k)
    if (row.stations[searched[k]].unsure()) {
      asked.push_back(searched[k]);
      known.push_back(found[k] && found[k]->passesKnown ? &*found[k] : nullptr);
    }
  for (const sweep::Stretch& at : unsureStretches(row.stations))
    if (std::ranges::find(asked, at.worst) == asked.end()) asked.push_back(at.worst);
  known.resize(asked.size());
  std::vector<std::optional<HeavyRivals>> rivals(asked.size());
  std::vector<std::vector<PassThere>> passes(asked.size());
  ok = parallelFor(context, int(asked.size()), [&](int k) {
    const std::size_t i = asked[std::size_t(k)];
    if (known[std::size_t(k)]) return;
    const std::optional<HeavyBranch> own = sweep::standing(sweep, sweep.poses[i]);
    if (!own) return;
    Result<HeavyRivals> all = rivalsOf(own->blade(), stiffness);
    if (all) rivals[std::size_t(k)] = std::move(*all);
  });
  if (!ok) return tl::unexpected<Error>(ok.error());
  for (std::size_t k = 0; k < asked.size(); ++k) {
    if (known[k]) {
      row.stations[asked[k]].barrier = known[k]->barrier;
      row.stations[asked[k]].passes = known[k]->passes;
    }
    if (!rivals[k]) continue;
    row.stations[asked[k]].barrier = rivals[k]->barrier;
    row.stations[asked[k]].passes = std::move(rivals[k]->passes);
  }
  ok = parallelFor(context, int(asked.size()), [&](int k) {
    passes[std::size_t(k)] = passesAround(sweep, row.stations, asked[std::size_t(k)]);
  });
  if (!ok) return tl::unexpected<Error>(ok.error());
  for (const std::vector<PassThere>& around : passes) addPasses(around, row.stations);
  if (along == Along::stations || n < 2 || asked.empty()) return row;
  row.between.resize(n - 1);
  const Between between(sweep, row.stations);
  ok = parallelFor(context, int(n - 1),
                   [&](int i) { row.between[std::size_t(i)] = between.after(std::size_t(i)); });
  if (!ok) return tl::unexpected<Error>(ok.error());
  return row;
}

std::optional<double> RowCertainty::barrierAt(std::size_t i) const {
  std::optional<double> least = stations[i].barrier;
  for (const std::size_t way : {i - 1, i})  // i - 1 wraps around at the first
    if (way < between.size() && between[way]) least = std::min(least.value_or(*between[way]), *between[way]);
  return least;
}

std::optional<double> RowCertainty::leastBarrier() const {
  double least = std::numeric_limits<double>::infinity();
  for (const sweep::Stretch& at : unsureStretches(stations)) {
    const std::optional<double> barrier = barrierOf(*this, at);
    if (!barrier) return {};
    least = std::min(least, *barrier);
  }
  return least;
}

const char* restName(Rest rest) {
  switch (rest) {
    case Rest::unknown:
      return "unknown";
    case Rest::certain:
      return "certain";
    case Rest::held:
      return "held";
    case Rest::lost:
      break;
  }
  return "lost";
}

Field certaintyField(const RowRest& rest, const std::vector<int>& stationRow, const SurfaceGrid& cut) {
  const MapInfo& map = *cutMap("certainty");
  Field field{map.name, map.title, map.unit, {}};
  field.values.reserve(cut.points.size());
  std::size_t nearest = 0;
  for (int row = 0; row < cut.rows; ++row) {
    const auto farther = [&](std::size_t i) { return std::abs(stationRow[i] - row); };
    while (nearest + 1 < stationRow.size() && farther(nearest + 1) < farther(nearest)) ++nearest;
    const auto word = std::ranges::find(map.words, std::string_view(restName(rest.stations[nearest])));
    field.values.insert(field.values.end(), std::size_t(cut.columns), double(word - map.words.begin()));
  }
  return field;
}

RowRest restOf(const Sweep& sweep, const SweepCheck& check, const RowCertainty& certainty,
               const BladeWay& entry, const RowMotion& motion, double margin) {
  using Lost = OtherShape::Lost;
  const std::size_t n = sweep.poses.size();
  RowRest row{std::vector<Rest>(n, Rest::unknown)};
  // The way to each station: whether there is one, and the least margin on it.
  std::vector<Lost> way(n, Lost::no);
  std::vector<double> least(n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    const StationCertainty& station = certainty.stations[i];
    if (station.unsure()) row.stations[i] = Rest::held;
    if (station.certain()) row.stations[i] = Rest::certain;
    least[i] = check.stations[i].stabilityMargin;
    if (station.certain()) continue;
    if (i == 0) {
      way[i] = entry.poses.empty() ? Lost::noEntry : Lost::no;
      least[i] = std::min(least[i], entry.margin);
    } else {
      way[i] = motion.reached[i] ? way[i - 1] : Lost::leaves;
      least[i] = std::min(least[i], least[i - 1]);
    }
  }
  for (const sweep::Stretch& at : unsureStretches(certainty.stations)) {
    const std::optional<double> barrier = barrierOf(certainty, at);
    for (std::size_t i = at.first; i <= at.last; ++i) {
      if (row.stations[i] != Rest::held) continue;
      if (way[i] == Lost::no && least[i] < margin) way[i] = Lost::lowMargin;
      if (way[i] == Lost::no && !barrier) way[i] = Lost::unknownBarrier;
      if (way[i] == Lost::no && *barrier < kLeastBarrier) way[i] = Lost::lowBarrier;
      if (way[i] != Lost::no) row.stations[i] = Rest::lost;
    }
  }
  // A blade that does not rest there at all, in its plane or across it, or snaps once a grip is off, is told
  // of by the check.
  const auto rests = [&](std::size_t i) {
    const StationCheck& seen = check.stations[i];
    return seen.stable && seen.outOfPlaneMargin > 0 && !seen.snapsByGrip;
  };
  for (std::size_t i = 0; i < n; ++i)
    if (!rests(i)) row.stations[i] = Rest::lost;
  for (const Rest rest : {Rest::lost, Rest::held}) {
    const auto concerned = [&](std::size_t i) { return row.stations[i] == rest && rests(i); };
    for (const sweep::Stretch& at : sweep::stretchesOf(n, concerned, moreExcess(certainty.stations))) {
      const StationCertainty& worst = certainty.stations[at.worst];
      OtherShape cause{worst.energy, worst.other->energy, worst.other->distance,
                       {},           way[at.worst],       least[at.worst]};
      for (std::size_t i = at.first; i <= at.last; ++i)
        if (const std::optional<double> barrier = certainty.barrierAt(i); barrier && concerned(i))
          cause.barrier = std::min(cause.barrier.value_or(*barrier), *barrier);
      row.findings.push_back({rest == Rest::lost ? Severity::error : Severity::info,
                              cause,
                              sweep::placeOf(sweep.poses, at),
                              {}});
    }
  }
  // Where it is not known how a blade hangs that is told of with its fit.
  const auto unsought = [&](std::size_t i) {
    return row.stations[i] == Rest::unknown && rests(i) && isKnown(sweep, i);
  };
  const auto any = [](std::size_t, std::size_t) { return false; };
  for (const sweep::Stretch& at : sweep::stretchesOf(n, unsought, any)) {
    OtherShape cause;
    cause.lost = Lost::unsought;
    row.findings.push_back({Severity::error, cause, sweep::placeOf(sweep.poses, at), {}});
  }
  return row;
}

}  // namespace bw
