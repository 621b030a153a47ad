// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "bw/words/findings.h"

namespace bw::words {

/// Says the cause of a finding: an overload for each, so that a cause without a sentence does not compile.
struct Sentences {
  const Finding& finding;
  Reader reader;

  // Blades and rows.
  std::string operator()(const UnmetConditions& cause) const;
  std::string operator()(const UnsettledFit& cause) const;
  std::string operator()(const HeldBackFit& cause) const;
  std::string operator()(const Overbent& cause) const;
  std::string operator()(const TooTight& cause) const;
  std::string operator()(const ManyInflections& cause) const;
  std::string operator()(const WouldSnap& cause) const;
  std::string operator()(const LowMargin& cause) const;
  std::string operator()(const SnapsInWeight& cause) const;
  std::string operator()(const MovedByWeight& cause) const;
  std::string operator()(const BentSideways& cause) const;
  std::string operator()(const WeightElsewhere& cause) const;
  std::string operator()(const UnknownInWeight& cause) const;
  std::string operator()(const WouldTwist& cause) const;
  std::string operator()(const GripTooNear& cause) const;
  std::string operator()(const NearBottom& cause) const;
  std::string operator()(const SteepAngle& cause) const;
  std::string operator()(const UnevenSpeed& cause) const;
  std::string operator()(const EndsSwing& cause) const;
  std::string operator()(const GapInRow& cause) const;
  std::string operator()(const TooFar& cause) const;
  std::string operator()(const Uncovered& cause) const;
  std::string operator()(const OutsideBlocks& cause) const;
  std::string operator()(const BladeCrosses& cause) const;
  std::string operator()(const ToldBlades& cause) const;
  std::string operator()(const TargetsCrowd& cause) const;
  std::string operator()(const LeadGrown& cause) const;
  std::string operator()(const OtherShape& cause) const;
  std::string operator()(const NoWay& cause) const;
  std::string operator()(const SnapsOnTheWay& cause) const;
  std::string operator()(const ArrivesOtherwise& cause) const;
  std::string operator()(const LostOnTheWay& cause) const;
  std::string operator()(const TooFarOnTheWay& cause) const;
  std::string operator()(const OffTheSurfaceShown& cause) const;
  std::string operator()(const TooFastOnTheWay& cause) const;
  std::string operator()(const SkinOff& cause) const;
  std::string operator()(const JointGap& cause) const;
  std::string operator()(const JointKink& cause) const;
  std::string operator()(const JointOpen& cause) const;
  std::string operator()(const JointUnknown& cause) const;
  std::string operator()(const KerfUnsettled& cause) const;
  std::string operator()(const BlocksMissed& cause) const;
  std::string operator()(const BlockUncut& cause) const;
  std::string operator()(const CutDropped& cause) const;
  std::string operator()(const CreaseOff& cause) const;
  std::string operator()(const TakesSurface& cause) const;
  std::string operator()(const PartUnknown& cause) const;
  std::string operator()(const PiecesLeft& cause) const;
  // Surfaces and sections.
  std::string operator()(const SectionMissing& cause) const;
  std::string operator()(const SectionPoint& cause) const;
  std::string operator()(const SectionShort& cause) const;
  std::string operator()(const SectionBranches& cause) const;
  std::string operator()(const SectionClosed& cause) const;
  std::string operator()(const ServingLengths& cause) const;
  std::string operator()(const GripErrors& cause) const;
  std::string operator()(const PulledByGrips& cause) const;
  std::string operator()(const HeldByLittle& cause) const;
  std::string operator()(const SectionBridged& cause) const;
  std::string operator()(const SectionExtended& cause) const;
  std::string operator()(const SectionBorder& cause) const;
  std::string operator()(const SectionUnfit& cause) const;
  std::string operator()(const SectionRough& cause) const;
  std::string operator()(const SectionDiffers& cause) const;
  std::string operator()(const LargestFace& cause) const;
  std::string operator()(const NearestFace& cause) const;
  std::string operator()(const FacesLeftOut& cause) const;
  std::string operator()(const TravelAcross& cause) const;
  std::string operator()(const PlanesNotTurned& cause) const;
  std::string operator()(const ChosenDirection& cause) const;
  std::string operator()(const LeftOutOfFile& cause) const;
  std::string operator()(const Healed& cause) const;
  // Files and programs.
  std::string operator()(const ChangedSource& cause) const;
  std::string operator()(const OddSize& cause) const;
  std::string operator()(const EarlierDesign& cause) const;
  std::string operator()(const UnreadableCell& cause) const;
  std::string operator()(const WrongSide& cause) const;
  std::string operator()(const HomeUnknown& cause) const;
  std::string operator()(const HomeOutOfReach& cause) const;
  std::string operator()(const ProgramDespiteErrors& cause) const;
  std::string operator()(const ProgramBreach& cause) const;
  std::string operator()(const RunMismatch& cause) const;

 private:
  /// "station 8", "stations 3 to 9 (worst: 7)" or "4 of the stations 3 to 9 (worst: 7)".
  std::string at() const;
  /// "station 8 is left out: its" or "stations 3 to 9 are left out: their", then one or the other rest.
  std::string leftOut(const std::string& one, const std::string& several) const;
  /// True if it is about one station.
  bool single() const { return finding.where.stations && finding.where.stations->count == 1; }
};

/// "stations 3 to 9", or "4 of the stations 3 to 9"; "station 8" for one.
std::string rangeText(const StationRange& range);

/// What is advised: "a blade that bends to 96 mm, such as …".
std::string bendingBladeText(const BendingBlade& blade);
/// "0.32 m²", or "5.8 mm²" of what is less than a square decimetre.
std::string areaText(double mm2);

inline constexpr const char* kInParts = "cut it in parts, each with a narrower block of its own";

}  // namespace bw::words
