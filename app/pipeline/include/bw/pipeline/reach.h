// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "bw/pipeline/sketch.h"

namespace bw::pipeline {

/// What bars a design from being cut, as far as a sketch of it tells: the first of these.
enum class Bar {
  none,
  noBlade,   ///< no blade can be laid on it: none is long enough, or none is found
  outside,   ///< at a station the surface lies outside of the block, or leaves it and comes back
  tooTight,  ///< a blade bends sharper than it may
  crosses,   ///< a blade crosses itself, or its grips lie the wrong way round
  lost,      ///< nothing keeps a blade in its shape, or it is not known what does
  tooFar,    ///< a blade lies farther from the surface than the tolerance
  low        ///< a blade comes nearer to the face that its block lies on than the floor
};
Bar barOf(const Sketch& sketch);
/// The same where blades may lie so far (mm) from the surface at their stations.
Bar barOf(const Sketch& sketch, double deviation);

/// How far something of a design may be moved, both ways.
struct Reach {
  struct End {
    double free = 0;      ///< so far it may, as far as was looked
    Bar bar = Bar::none;  ///< what bars it beyond; none where nothing was found to
    bool known = false;   ///< neither sketches nor evaluations find more of it
    bool operator==(const End&) const = default;
  };
  std::array<End, 2> ends = {};  ///< below and above 0
  Bar now = Bar::none;           ///< what bars it where it is; then nothing is known of both ends
  bool operator==(const Reach&) const = default;

  /// Whether it is known how far on the way by so much it may go.
  bool knows(double by) const;
};

/// Seeks how far something of a design may be moved, look by look, from where it is: a little way, which
/// blades follow in some ms, then farther, by `kStride` at most at once, until it is barred, and back to
/// within `kWithin` of the border, or `kWithinSight` where blades were only lost sight of. What sketches tell
/// of a border depends on the way there, which the blades follow; an evaluation tells whether it bars in
/// truth.
class ReachSearch {
 public:
  static constexpr double kNear = 1, kFirst = 4, kStride = 32, kWithin = 0.5, kWithinSight = 4;
  static constexpr double kWithinShare = 0.05;  ///< of a way, as near as evaluations seek its end
  static constexpr double kStepShare = 0.1;     ///< of a way, to the next evaluation, at least

  /// `at` makes the design that is moved by so much, in the unit of `farthest` (mm), beyond which nobody
  /// looks. Sketches seek a border no nearer than by that share of the way to it.
  ReachSearch(const std::shared_ptr<const Evaluation>& from, std::function<Design(double)> at,
              double farthest, double withinShare = 0);

  /// One more look each way, two sketches, or only that way where it is wanted farther than is known; false
  /// where they find nothing more. What is free and barred between two looks is not seen.
  bool look(const RunContext& context);
  bool looking() const;
  /// True while looks may yet tell whether it may be moved by so much.
  bool seeks(double by) const;
  /// True where it is known to be barred, as far as looks tell.
  bool bars(double by) const;
  /// The design moved that way as far as it is known to be free.
  Design towards(double by) const { return at_(reach_.ends[by < 0 ? 0 : 1].free); }
  /// One evaluation beside a border that sketches found: just beyond it, then, if it bars nothing in truth,
  /// ever farther and back; and just before it, then, if it is barred in truth, ever nearer. False where
  /// nothing is left to be held against one.
  bool confirm(const RunContext& context);
  /// Where it is wanted: that side is looked at first, and its border held against evaluations first, and
  /// where sketches only lost sight of the blades, there, if that is not far.
  void aim(double by) { aim_ = by; }
  bool unsure() const;
  const Reach& reach() const { return reach_; }

 private:
  struct Side {
    Sketcher sketcher;
    double barred = 0;     ///< from here on, where it is known
    bool done = false;     ///< sketches find no more
    bool proved = false;   ///< by an evaluation it is barred there
    double sure = 0;       ///< up to here an evaluation found it free, or nothing is moved
    double step = kFirst;  ///< to the next one, while none is
    double back = kNear;   ///< likewise, while none is free
  };
  /// What bars the design that is moved by so much.
  Bar barAt(Sketcher& sketcher, double by, const RunContext& context) const;
  bool unsure(std::size_t side) const;

  std::shared_ptr<const Evaluation> from_;
  std::function<Design(double)> at_;
  double farthest_, withinShare_;
  double deviation_ = 0;  ///< mm, allowed at stations
  std::array<Side, 2> sides_;
  double aim_ = 0;
  std::optional<Sketcher> near_;  ///< of where it is and little beside: one row for both ways
  Reach reach_;
  bool began_ = false;
};

}  // namespace bw::pipeline
