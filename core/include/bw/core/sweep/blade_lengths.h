// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"
#include "bw/core/sweep/entry_exit.h"
#include "bw/core/sweep/row_certainty.h"
#include "bw/core/sweep/row_motion.h"
#include "bw/core/sweep/section.h"
#include "bw/core/sweep/sweep.h"
#include "bw/core/sweep/sweep_check.h"

namespace bw {

/// What a row is to keep with whatever length of blade.
struct LengthRequest {
  FitRequest fit;  ///< but for the length of its blade
  CheckRequest check;
  EntryExitRequest ends;
  FollowRequest follow = {};  ///< how robots move the blade from station to station
  bool operator==(const LengthRequest&) const = default;
};

/// How a row does with a blade of one length, asked to keep one margin.
struct RowTrial {
  double length = 0;        ///< mm
  Rest rest = Rest::lost;   ///< of its worst station; lost, too, where a limit is not kept
  double margin = 0;        ///< of stability, the least in the plane or across it
  double deviation = 1e30;  ///< mm, of the part that cuts from its section
  bool reaches = false;     ///< it keeps the clearance at both sides of the block, and the floor
  double asked = 0;         ///< the margin that was asked for
  double clearance = 0;     ///< mm, asked for
  bool serves() const { return rest == Rest::certain || rest == Rest::held; }
};

/// True where the blade of a row keeps at all of its stations what a blade of any length is to keep: radius,
/// margins, clearance and floor, its own side of itself, the plane to within the tolerance; and where it is
/// known how it hangs.
[[nodiscard]] bool keepsLimits(const Sweep& sweep, const SweepCheck& check, const CheckRequest& request);

/// Which of two trials is rather advised: what is certain before what is held, then that of the larger
/// margin.
[[nodiscard]] bool isFirmer(const RowTrial& a, const RowTrial& b);

/// Whether what serves on the sections that it was tried on serves as a whole; it may tell the trial more
/// than is known of it.
using ServesWhole = std::function<bool(RowTrial&)>;

/// Which lengths of a blade serve a row.
struct BladeLengths {
  std::vector<RowTrial> trials;               ///< ascending
  std::optional<double> best = std::nullopt;  ///< mm; none where none is known to serve
  int stations = 0;                           ///< that each was tried on
  bool designed = false;                      ///< the best serves when all of its design is computed
  /// mm: what is taken in place of a best one, where there is none (`findNearest`).
  std::optional<double> nearest = std::nullopt;
  /// A stretch of lengths that serve alike: no length that was tried in it does otherwise.
  struct Band {
    double from = 0, to = 0;
    Rest rest = Rest::certain;
  };
  std::vector<Band> bands() const;
  /// Which of two that serve is rather advised: the firmer one.
  static bool isBetter(const RowTrial& a, const RowTrial& b) { return isFirmer(a, b); }
  /// The trial at that length or the one next below; null below all.
  const RowTrial* at(double length) const;
};

/// Solves some of the sections (thirty, evenly over the row, and the longest: with fewer the grips could not
/// go from one to the next as they do) for blades of lengths from that of the longest section and its leads
/// up, each a fortieth, later a twentieth longer than the one before, as long as it may still serve, then
/// finer (5 mm) at the ends of what serves or reaches. A length serves where the blade keeps its radius, its
/// margin, its plane, the clearance and the floor, crosses nothing, lies on the sections within the tolerance
/// (where all are tried, halfway between them too, and is followed there as robots move its grips), rests in
/// the shape that is asked for, certain or held, and can be led into it and out of it. The best one is that
/// of the largest margin, one that is certain before one that is held; it serves as a `whole` (`confirm`): if
/// nothing else is given, all sections and halfway between them. Lengths are whole multiples of 5 mm.
/// docs/mathematics.md, sweep. Errors: badInput without sections; `cancelled`. Some 1 to 8 s.
[[nodiscard]] Result<BladeLengths> bladeLengths(const std::vector<Section>& sections,
                                                const LengthRequest& request, const Box& block,
                                                const PlaneFamily& planes, const RunContext& context,
                                                const ServesWhole& whole = {});

/// Where no length serves, the one that comes nearest to it: of the blades that rest and reach the one that
/// lies nearest to its sections, or that which misses its rest by least. What it does on some of the sections
/// is looked at on all, and taken over; where that is worse, so is the next, eight at most.
void findNearest(BladeLengths& lengths, const std::vector<Section>& sections, const LengthRequest& request,
                 const Box& block, const PlaneFamily& planes, const RunContext& context);

/// What of the deviation a row gives for the margin of its blades.
struct MarginTrade {
  std::vector<RowTrial> trials;  ///< by the margin asked for, ascending
  /// The least of them that serves and is not less than the request's, or else the largest that serves.
  std::optional<double> best = std::nullopt;
  double least = 0;  ///< the request's
  /// Which of two that serve is rather advised: the one nearer to the request's margin, from that on first.
  [[nodiscard]] bool isBetter(const RowTrial& a, const RowTrial& b) const;
};

/// Solves some of the sections (as `bladeLengths`) for the blade of the request, asked to keep margins from 0
/// to 0.6 and that of the request. Each trial tells the margin that the row then has, how far its blades lie
/// from their sections, and how the worst station rests: with the same limits as for lengths, but for the
/// margin, which is the one that is tried. The best serves as a `whole`. docs/mathematics.md, sweep. Errors:
/// badInput without sections or
/// where the blade is shorter than one; `cancelled`. Some 0.5 to 2 s.
[[nodiscard]] Result<MarginTrade> marginTrade(const std::vector<Section>& sections,
                                              const LengthRequest& request, const Box& block,
                                              const PlaneFamily& planes, const RunContext& context,
                                              const ServesWhole& whole = {});

/// What a row does where its grips may come nearer to the block.
struct ClearanceTrade {
  std::vector<RowTrial> trials;                 ///< by clearance, then by length, both ascending
  std::optional<RowTrial> best = std::nullopt;  ///< that with the largest clearance of those that serve
  std::optional<double> own = std::nullopt;     ///< mm, the length of the request's blade, unless left open
  /// Which of two that serve is rather advised: that with the larger clearance, then the blade of the
  /// request, then the firmer one.
  [[nodiscard]] bool isBetter(const RowTrial& a, const RowTrial& b) const;
  /// mm, the least that was tried; none where the one asked for is as small.
  std::optional<double> least() const {
    return trials.empty() ? std::nullopt : std::optional(trials.front().clearance);
  }
};

/// mm: nearer to the block no grip is sent by advice.
inline constexpr double kLeastClearance = 10;

/// Tries smaller clearances where no length serves with the one asked for: kLeastClearance, and where that
/// serves larger ones, by halves down to 5 mm. At each one the blade of the request, unless that leaves its
/// length open, and the lengths that are too short for the clearance asked for, in fours, until some serve
/// (the shortest four 5 mm apart, then each a fortieth longer, twelve at most). Of those that serve with one
/// clearance the blade of the request is the best, else as for lengths; the best of all serves as a `whole`.
/// Same limits as for these. Errors: badInput without sections; `cancelled`. Some 1 to 5 s.
[[nodiscard]] Result<ClearanceTrade> clearanceTrade(const std::vector<Section>& sections,
                                                    const LengthRequest& request, const Box& block,
                                                    const PlaneFamily& planes, const RunContext& context,
                                                    const ServesWhole& whole = {});

/// So many are asked at most whether they serve as a whole: each takes as long as the design itself.
inline constexpr int kMostConfirmed = 4;
/// The best of what serves becomes the first that serves as a whole; what does not is lost. Where one did
/// not, of all others that were not asked it is not known.
void confirm(BladeLengths& lengths, const ServesWhole& whole);
void confirm(MarginTrade& trade, const ServesWhole& whole);
void confirm(ClearanceTrade& trade, const ServesWhole& whole);

}  // namespace bw
