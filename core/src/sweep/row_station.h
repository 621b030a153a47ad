// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/base/units.h"
#include "bw/core/elastica/elastica.h"
#include "bw/core/heavy/heavy_bvp.h"
#include "bw/core/sweep/sweep.h"
#include "sweep/in_foam.h"

namespace bw::sweep {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Row6 = Eigen::Matrix<double, 1, 6>;
using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

inline constexpr int kStationPlaces = 33;  // of a section, from which the blade's distance is taken
inline constexpr int kStationBends = 25;   // of the whole blade, where its curvature is looked at
inline constexpr int kStationMargins = 2;  // in the plane and, of a round blade, out of it
inline constexpr int kStationClearances = kStationPlaces + kStationBends + 3;  // of both grips: from there,
inline constexpr int kStationBarriers = kStationClearances + 2;                // over its passes: from there
inline constexpr int kStationPasses = 4;                                       // that are looked at
inline constexpr int kStationOwn = kStationBarriers + kStationPasses + kStationMargins;
/// What a request may ask of the part that cuts: both its ends, its tangents there, its length.
inline constexpr int kStationDemands = 5;

/// One station: the blade without weight told by its middle (point, angle, curvature, force), in lengths of a
/// quarter of the blade; its grips hold the blade that hangs.
struct Station {
  std::size_t index = 0;  ///< in the row
  const BladePose* pose = nullptr;
  std::array<Eigen::Vector2d, kStationPlaces> section;
  /// What its places count: 1 in the block, less beside it (`InFoam`); and their shares in the rms over the
  /// section, which are of one in sum.
  std::array<double, kStationPlaces> counts, shares;
  double sectionLength = 0;                  ///< mm
  double aside = 0;                          ///< mm along it, where the blade's middle is to be, from its own
  std::array<double, 2> sectionAngles = {};  ///< of its tangents at both ends
  double numbers[6] = {};
  std::optional<HeavyBranch> branch = std::nullopt;  ///< the blade that hangs, where it was looked at last
  Vector6 hungAt = Vector6::Zero();                  ///< its grips
  std::vector<HeavyBlade> passes = {};  ///< over which a push brings it into other shapes, if that is watched
  double asked = 0;                     ///< N mm, of that push
  std::array<bool, kStationMargins> watched = {};  ///< its margins that are near the least asked for
  std::array<double, kStationPlaces> feet = {};    ///< arc lengths of the blade nearest to the section

  double compared = 0;  ///< mm: its distance, or that of those before it, when it was last held against a fit

  std::optional<Vector6> lookedAt = std::nullopt;  ///< the numbers, where they were looked at
  bool sloped = false;                             ///< whether the derivatives are of that look
  std::optional<Vector6> slopesAt = std::nullopt;  ///< the numbers that they are of
  Eigen::Matrix<double, kStationMargins, 1> unsafeAt = Eigen::Matrix<double, kStationMargins, 1>::Zero();
  ///< what the margins cost there
  bool good = false;  ///< of the numbers looked at; the rest holds if it is
  Eigen::Matrix<double, kStationOwn, 1> own;
  Eigen::Matrix<double, kStationOwn, 6, Eigen::RowMajor> byOwn;
  Vector6 grips;  ///< x, y and angle of both, mm
  Matrix6 byGrips;
  /// By how much the part that cuts misses what the request asks of it, mm and rad; zero where it asks
  /// nothing.
  Eigen::Matrix<double, kStationDemands, 1> demands = Eigen::Matrix<double, kStationDemands, 1>::Zero();
  Eigen::Matrix<double, kStationDemands, 6, Eigen::RowMajor> byDemands;

  /// mm, of the farthest place of the section, as far as it counts.
  double distance() const {
    double farthest = 0;
    for (int k = 0; k < kStationPlaces; ++k)
      farthest = std::max(farthest, counts[std::size_t(k)] * std::abs(off(k)));
    return farthest;
  }
  /// mm, of a place of the section.
  double off(int k) const { return own(k) / shares[std::size_t(k)]; }
  /// True if a grip is nearer to the block than it need be.
  bool lacksClearance() const { return own.segment<2>(kStationClearances).maxCoeff() > 0; }
  /// rad, that the grips are turned more than those of another one.
  double turnedFrom(const Station& other) const {
    const auto turn = [&](int angle) {
      return std::abs(std::remainder(grips(angle) - other.grips(angle), 2 * kPi));
    };
    return std::max(turn(2), turn(5));
  }
};

/// Looks at stations.
class Row {
 public:
  /// `share`: of their weight, that its blades have.
  Row(const Sweep& sweep, const RunContext& context, double share = 1);

  /// A station as the row has it; empty where its blade does not rest near its section.
  std::optional<Station> standing(std::size_t i) const;
  /// The same from its blade without weight, which takes on this row's share of it; empty where it snaps.
  std::optional<Station> laid(std::size_t i) const;
  /// A station whose blade is held taut, straight along its section; empty where the section lies farther
  /// from that than the tolerance, or more is asked of it.
  std::optional<Station> straight(std::size_t i) const;
  /// A station whose blade goes through both ends of its section along its tangents there with nothing that
  /// pushes it together or pulls: the cubic between them, which sags. Where the section is flat it has
  /// nowhere to go, though a blade that arches as the section does falls through. Of the light shapes from
  /// which the weight leads there the nearest; empty where there is none.
  std::optional<Station> unforced(std::size_t i) const;
  /// Has a station of a row with another share of the weight take on that of this one.
  void weigh(Station& station) const;
  /// The same, to be followed from there, with the bounds that were felt; its blade may bend or rest as it
  /// will.
  std::optional<Station> following(std::size_t i) const;
  /// Gives a station the section of another.
  void take(Station& station, std::size_t i) const;
  /// Has a station look at its margin too, if that is near the least that is asked for.
  void watch(Station& station) const;
  /// A station of which the blade of another one, `from`, is to become the blade; `turned` as the section is.
  Station carried(std::size_t i, const Station& from, bool turned = false) const;
  /// The blade without weight; empty where the station's numbers are none of a blade.
  std::optional<Elastica> light(const Station& station) const;
  /// True if the blade keeps the margin that is asked for.
  bool isFirm(const Station& station) const;
  /// True if the part that cuts has the ends, tangents and length that the request asks for.
  bool meets(const Station& station) const;
  /// True if a blade like this may stand in the row.
  bool holds(const Station& station) const;
  /// True if the blade of a station that hangs comes to the shape of another one as its grips move evenly to
  /// those.
  bool leads(const Station& from, const Station& to) const;
  /// True if its smallest radius, its margin or its barrier keeps the blade from lying nearer to its section.
  bool isBounded(const Station& station, const Elastica& light) const;
  /// Looks at a station's numbers; without `slopes` the derivatives stay as they were, and of the margins
  /// that are watched is told what these say.
  void look(Station& station, bool slopes = true) const;
  /// True if another look at the same numbers would find the feet where they are.
  bool isSettled(const Station& station) const;
  /// True if the request asks for ends, tangents or length of the part that cuts.
  bool demands() const {
    const FitRequest& request = sweep_.request;
    return request.fitEndpoints || request.fitTangents || request.fitLength != FitOptions::Length::free;
  }
  const Sweep& sweep() const { return sweep_; }
  const RunContext& context() const { return context_; }
  const InFoam& foam() const { return foam_; }
  double unit() const { return unit_; }  ///< mm, of the numbers

 private:
  /// Half of the blade without weight, from its middle on.
  Result<Elastica> about(const Station& station) const;

  /// The blade as the station's grips hold it.
  HeavyProblem held(const Station& station) const;
  /// Lets the blade hang between the station's grips; `half` of it is without weight. False where it snaps
  /// on the way there.
  bool hangAt(Station& station, const Elastica& half) const;

  struct Margin {
    double value = 1;
    Row6 byNumbers = Row6::Zero();
  };
  /// One of the margins of the station's blade, as far as it is less than `below`, and how it changes there.
  /// `by`: what is known of its slopes, or null.
  Margin marginAt(const Station& station, int which, double below, const HeavySlopes* by = nullptr) const;
  bool isRound() const { return sweep_.request.blade.section != Blade::Section::flat; }

  /// What both grips lack of the clearance, and how that changes with the numbers.
  void clear(Station& station) const;
  /// What the part that cuts misses of what is asked of it. `states` are those of its places, `turns` how
  /// their tangents at both ends change with the numbers, `slides` how the ends' arc lengths do.
  void demand(Station& station, std::span<const Elastica::State> states, const std::array<Row6, 2>& turns,
              const std::array<Row6, 2>& slides) const;

  /// What the barriers cost, where they are watched.
  void push(Station& station, bool slopes) const;
  /// What the margins that are watched cost.
  void unsafe(Station& station, const HeavySlopes* by) const;

  /// Moves each foot nearer to where the blade is nearest to its place of the section.
  void step(Station& station, std::span<const Elastica::State> states) const;
  Station at(std::size_t i) const;
  /// Puts a blade without weight into a station; false where that is none that can be looked at.
  bool lay(Station& station, const BladePose& pose, const StationFit& fit) const;
  /// The same with its weight.
  bool begin(Station& station, const BladePose& pose, const StationFit& fit) const;

  const Sweep& sweep_;
  const RunContext& context_;
  double length_, unit_, limit_;  ///< of the blade, mm; of the numbers, mm; of the curvature, 1/mm
  double share_;                  ///< of the weight
  Box passed_;                    ///< the block, going on along the travel
  InFoam foam_;
};

/// Takes whole turns out of the angles between a station and the one before it; `unit` in mm, of the numbers.
void unwrap(std::vector<std::optional<Station>>& stations, double unit);

}  // namespace bw::sweep
