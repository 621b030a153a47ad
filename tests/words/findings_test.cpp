// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What findings say: one sentence each, in the words of who reads it.

#include "bw/words/findings.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <utility>

namespace bw::words {

namespace {

constexpr double kDegree = 0.017453292519943295;

std::string said(Cause cause, std::optional<StationRange> stations = {}, Remedies remedies = {},
                 Reader reader = Reader::window) {
  return sentence({Severity::warning, std::move(cause), {stations, {}}, std::move(remedies)}, reader);
}

const StationRange kOne = StationRange::of(7), kAll{2, 8, 6, 7}, kSome{2, 8, 6, 4};

/// Each cause once, by default values, with what its sentence needs.
template <std::size_t... I>
std::vector<Finding> oneOfEach(std::index_sequence<I...>) {
  std::vector<Finding> all;
  (all.push_back({Severity::warning, std::variant_alternative_t<I, Cause>{}, {}, {}}), ...);
  for (Finding& finding : all) {
    const FindingKind kind = finding.kind();
    const bool ofFiles = kind >= FindingKind::face;
    if (!ofFiles) finding.where.stations = kAll;
  }
  return all;
}

std::vector<Finding> everyCause() {
  return oneOfEach(std::make_index_sequence<std::variant_size_v<Cause>>());
}

}  // namespace

TEST(Findings, NumbersAreSeenToPassTheirLimits) {
  EXPECT_NE(
      said(Overbent{239.96, 240}, kOne).find("a radius of 239.96 mm but keeps its shape only down to 240"),
      std::string::npos)
      << said(Overbent{239.96, 240}, kOne);
  EXPECT_NE(said(TooFarOnTheWay{2.0041, 2}, kOne).find("up to 2.004 mm from the target (tolerance 2 mm)"),
            std::string::npos);
}

TEST(Findings, SayWhatAnErrorOfAGripPulls) {
  EXPECT_NE(
      said(PulledByGrips{0.0042, 0.5, 124.9}, kOne)
          .find("a grip that is off by 0.5 mm may take up the slack of the blade (0.0042 mm) and pull it, "
                "by up to 125 N/mm² if nothing gives way"),
      std::string::npos)
      << said(PulledByGrips{0.0042, 0.5, 124.9}, kOne);
  EXPECT_NE(said(PulledByGrips{1.1e-13, 0.5, 124.9}, kOne).find("the slack of the blade (next to none) and"),
            std::string::npos);
}

TEST(Findings, SayWhereABladeSnapsOnceAGripIsOff) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity(), kTurned = 0.2 * kDegree;
  const GripErrors snaps{kInfinite, 0.5, kTurned, 2, true};
  const std::string exactly = ", or let the grips be held more exactly (grip error, grip turn)";
  EXPECT_EQ(said(snaps, kOne, {OtherLength{700}}),
            "station 8: a grip that is off by 0.5 mm and 0.2° makes the blade snap; a blade of 700 mm "
            "serves" +
                exactly);
  EXPECT_NE(said(snaps, kOne, {CutInParts{}})
                .find("snap; take another blade or direction, or cut in parts" + exactly),
            std::string::npos);
  EXPECT_NE(said(GripErrors{kInfinite, 0.5, kTurned, 2}, kOne)
                .find("may make the blade snap: where it goes could not be found"),
            std::string::npos);
  EXPECT_NE(said(HeldByLittle{0, 1, 0.5, kTurned, 22.2}, kOne)
                .find("the blade snaps into another shape, 22.2 mm away; take another length" + exactly),
            std::string::npos);
}

TEST(Findings, SayHowThickAFlatBladeMayBeThatBendsAsFar) {
  EXPECT_NE(said(WouldTwist{}, kOne, {FlatBlade{"flat", "Flat"}})
                .find("take a flat blade, which is stiff across its plane"),
            std::string::npos);
  EXPECT_NE(said(WouldTwist{}, kOne, {FlatBlade{{}, {}, 0.68}})
                .find("take a flat blade of 0.6 mm at most, which is stiff across its plane"),
            std::string::npos);
  EXPECT_NE(said(BentSideways{2.4}, kOne, {FlatBlade{{}, {}, 0.04}})
                .find("; a flat blade of 0.04 mm at most carries it"),
            std::string::npos);
}

TEST(Findings, SayWhereALengthThatWasTakenServesStationsAlone) {
  ServingLengths taken{ServingLengths::Said::taken, 785, 785, 785};
  EXPECT_EQ(said(taken, kOne).find("though not all"), std::string::npos);
  taken.atStationsAlone = true;
  EXPECT_NE(said(taken, kOne).find("serves all stations, though not all that lies between or beside them"),
            std::string::npos)
      << said(taken, kOne);
}

TEST(Findings, AFindingGivesItsOwnAdviceAlone) {
  const std::string why = "The blade cannot be followed there: it is too taut. Take a longer blade.";
  const std::string way = said(NoWay{true, why}, kOne);
  EXPECT_NE(way.find("outside of the block: the blade cannot be followed there: it is too taut"),
            std::string::npos)
      << way;
  EXPECT_EQ(way.find("longer"), std::string::npos) << way;
  EXPECT_EQ(way.find(".;"), std::string::npos) << way;
  const std::string lost = said(LostOnTheWay{why}, kOne);
  EXPECT_TRUE(lost.ends_with("it is too taut; take a longer blade")) << lost;
  // Of ends that turn towards each other no blade is advised.
  EXPECT_EQ(said(TooTight{150, 240, 30, 2}, kOne, {CutInParts{}}).find("a blade that bends"),
            std::string::npos);
}

TEST(Findings, MoreStationsAreNoRemedyWhereTheBladeDoesNotRest) {
  EXPECT_NE(said(TooFarOnTheWay{70, 2}, kOne).find("take more stations"), std::string::npos);
  for (const std::string& text :
       {said(TooFarOnTheWay{70, 2, true}, kOne), said(OffTheSurfaceShown{70, 0.1, true}, kOne)}) {
    EXPECT_EQ(text.find("take more stations"), std::string::npos);
    EXPECT_NE(text.find("does not keep its shape there, which is to be mended first"), std::string::npos);
  }
}

TEST(Findings, MoreStationsAreNoRemedyWhereTheBladeSwingsFromTautToSlack) {
  TooFar off{8.16, 2, 0.991, TooFar::Source::between, 22.5, 0.753};
  EXPECT_NE(said(off, kOne).find("take more of them"), std::string::npos) << said(off, kOne);
  off.slackens = true;
  for (const std::string& text : {said(off, kOne), said(OffTheSurfaceShown{1.26, 0.1, false, true}, kOne)}) {
    EXPECT_EQ(text.find("take more"), std::string::npos) << text;
    EXPECT_NE(text.find("goes over from taut to slack, or back, and swings by that"), std::string::npos)
        << text;
    EXPECT_NE(text.find("a stiffer or lighter blade"), std::string::npos) << text;
  }
}

TEST(Findings, WhatIsOffBetweenTheStationsIsNotBlamedOnTheDirection) {
  Uncovered off{1000, 0.18, 2.26, Uncovered::Where::off};
  EXPECT_NE(said(off, kOne).find("choose another cutting direction"), std::string::npos) << said(off, kOne);
  off.between = true;
  EXPECT_EQ(said(off, kOne).find("direction"), std::string::npos) << said(off, kOne);
  EXPECT_NE(said(off, kOne).find("it is off between the stations"), std::string::npos);
}

TEST(Findings, OneStationSeveralAndSomeOfThem) {
  EXPECT_EQ(said(SectionMissing{}, kOne),
            "station 8 is left out: its plane does not meet the target inside the block");
  EXPECT_EQ(said(SectionMissing{}, kAll),
            "stations 3 to 9 are left out: their planes do not meet the target inside the block");
  EXPECT_EQ(said(SectionMissing{}, kSome),
            "4 of the stations 3 to 9 are left out: their planes do not meet the target inside the block");
  EXPECT_NE(said(SectionBranches{2, 2}, kAll).find("in 2 separate curves each; place"), std::string::npos);
  EXPECT_NE(said(SectionBranches{2, 4}, kAll).find("in 2 to 4 separate curves; place"), std::string::npos);
  EXPECT_NE(said(SectionBranches{2, 2}, kOne).find("in 2 separate curves; place"), std::string::npos);
  EXPECT_NE(
      said(SectionBranches{2, 2, 4.2}, kAll)
          .find("each; one of them goes out through the block's top and comes back: one that reaches 5 mm "
                "farther up holds it in one; place"),
      std::string::npos);
  EXPECT_NE(said(SectionBranches{2, 2, 4.2, 1}, kAll)
                .find("reaches 5 mm farther up, and 1 mm farther down holds it in one; place"),
            std::string::npos);
  EXPECT_NE(said(SectionBranches{2, 2, 0, 7}, kAll).find("through the block's bottom"), std::string::npos);
  EXPECT_NE(said(SectionBranches{2, 2}, kOne).find("(a gap between two is crossed where"), std::string::npos);
  EXPECT_EQ(
      said(ManyInflections{3}, kAll),
      "stations 3 to 9 (worst: 7): the blade would need 3 inflections; a stiff blade holds at most two, so "
      "cut it in parts, each with a narrower block of its own");
  EXPECT_EQ(
      said(UnsettledFit{0.25}, StationRange{2, 4, 3, 3}),
      "stations 3 to 5 (worst: 4): the search for the nearest curve did not come to rest; the curve taken "
      "is within 0.25 mm of the section");
}

TEST(Findings, SayWhereABladeCannotBeBetweenStations) {
  const std::string crosses =
      "the blade crosses itself, which no blade between two robots can; cut it in parts";
  EXPECT_EQ(said(BladeCrosses{true}, kOne).find("station 8: " + crosses), 0u);
  EXPECT_EQ(said(BladeCrosses{true}, StationRange{4, 5, 4, 0})
                .find("on the way from station 5 to station 6 " + crosses),
            0u);
  EXPECT_EQ(
      said(BladeCrosses{true}, StationRange{-1, 0, 0, 0}).find("on the way in, before station 1, " + crosses),
      0u);
  EXPECT_EQ(said(WouldTwist{}, StationRange{32, -1, 32, 0})
                .find("on the way out, after station 33, a round blade would twist"),
            0u);
  EXPECT_EQ(said(BladeCrosses{true}, StationRange{-1, -1, 0, 0})
                .find("all along, from the way in to the way out, " + crosses),
            0u);
  EXPECT_EQ(said(LowMargin{0.06, 0.15}, StationRange{1, 2, 1, 0})
                .find("on the way from station 2 to station 3 the blade rests in this shape with a margin of "
                      "0.06 alone"),
            0u);
  EXPECT_NE(said(LowMargin{0.2996, 0.3}, kOne).find("0.2996 alone (asked for: 0.3;"), std::string::npos);
  OtherShape weak;
  weak.lost = OtherShape::Lost::lowBarrier;
  EXPECT_EQ(said(weak, StationRange{1, 2, 1, 0})
                .find("on the way from station 2 to station 3 between these grips the blade rests in "),
            0u);
}

TEST(Findings, SayWhereTheSkinLeavesABlade) {
  EXPECT_EQ(said(SkinOff{0.034, 0.01}, StationRange{2, 4, 3, 3}),
            "stations 3 to 5 (worst: 4): the surface that is measured and written lies up to 0.034 mm from "
            "the blade, "
            "more than 0.01 mm; cut it in parts, each with a narrower block of its own");
}

TEST(Findings, SayThatPlanesDoNotTurnWithTheirKeyBlades) {
  EXPECT_EQ(said(PlanesNotTurned{-0.1, 0.25}),
            "the planes of the blades are parallel, because the cut has a direction of its own; its key "
            "blades are turned by -5.7° to 14.3°: choose the automatic direction to have the planes turn "
            "with them");
}

TEST(Findings, SayWhereTheRoutesOfSectionsDiffer) {
  EXPECT_EQ(said(SectionDiffers{1, 3, 0, true}, kOne),
            "station 8: OpenCASCADE finds 3 curves where tracing finds 1; what it finds is taken");
  EXPECT_EQ(
      said(SectionDiffers{1, 1, 0.25, true}, StationRange{2, 4, 3, 3}),
      "stations 3 to 5 (worst: 4): OpenCASCADE finds the section up to 0.25 mm from where it was traced; "
      "what it finds is taken");
  EXPECT_EQ(
      said(SectionDiffers{2, 1, 0, false}, kOne),
      "station 8: OpenCASCADE finds 1 curve where tracing finds 2; what was traced is longer and stays");
}

TEST(Findings, NameConditionsAndWhatToRelease) {
  EXPECT_EQ(said(UnmetConditions{{"length"}}, kOne),
            "station 8: no blade was found that meets the length; release it; the nearest curve without "
            "conditions stands in for it");
  EXPECT_NE(said(UnmetConditions{{"endpoints", "tangents", "length"}}, kOne)
                .find("meets the end points, the end tangents and the length together; release one of them"),
            std::string::npos);
}

TEST(Findings, SayTheSwingOfAnEndWhereItIs) {
  EXPECT_EQ(
      said(EndsSwing{120 * kDegree, 20, 45 * kDegree, 1}, StationRange{26, 27, 27, 2}),
      "station 28: the blade's end turns 120° within 20 mm of travel; take more stations, a shorter blade, "
      "or a block in which the sections change less");
}

TEST(Findings, TellOverWhatStretchKeyBladesAreNone) {
  using Fault = ToldBlades::Fault;
  EXPECT_EQ(said(ToldBlades{Fault::unstable, 310, 345.22, 328}),
            "at y = 310 to 345.2 mm the key blades tell shapes in which no blade rests: it would snap out of "
            "them, worst at y = 328; ease the key blades beside it, or add one there that a blade can be");
  EXPECT_EQ(
      said(ToldBlades{Fault::crossing, 0, 0, 0, 0, 0, "wall"}),
      "wall: at y = 0 mm the key blades tell shapes that cross themselves; ease the key blades beside it, "
      "or add one there that a blade can be");
  EXPECT_EQ(
      said(ToldBlades{Fault::tight, 600, 800, 800, 300, 400}, {}, {BendingBlade{297, "rod", "Rod", 150}}),
      "at y = 600 to 800 mm the key blades tell shapes that bend to a radius of 300 mm, which this blade "
      "may only down to 400 mm, worst at y = 800; ease the key blades beside it, or add one there that a "
      "blade can be; else it takes at least a blade that bends to 297 mm, such as the Rod (150 mm)");
}

TEST(Findings, TellTheRemediesTheyHold) {
  EXPECT_NE(said(GripTooNear{-12, 50}, kOne, {OtherLength{1200}})
                .find("12 mm inside the block; try a blade of 1200 mm"),
            std::string::npos);
  EXPECT_NE(said(GripTooNear{-12, 50, 1500}, kOne, {OtherBlock{OtherBlock::How::endsBefore}})
                .find("a blade that keeps the clearance (1500 mm) would not serve; choose a block that "
                      "ends before this station"),
            std::string::npos);
  EXPECT_NE(said(GripTooNear{-12, 50}, kAll, {OtherBlock{}})
                .find("no longer blade of this shape is known to keep the clearance; choose a smaller block"),
            std::string::npos);
  EXPECT_NE(said(GripTooNear{49.9902, 50}, kOne, {OtherLength{900}})
                .find("passes the block at 49.99 mm, less than the clearance of 50 mm"),
            std::string::npos);
  EXPECT_NE(said(GripTooNear{20, 50}, kOne, {OtherLength{900}})
                .find("passes the block at 20 mm, less than the clearance of 50 mm"),
            std::string::npos);
  EXPECT_NE(
      said(NearBottom{12.4, 20, NearBottom::Lower::keeps, 8}, kOne)
          .find("the blade passes the face that the block lies on at 12.4 mm, less than the floor of 20 "
                "mm; a block that reaches 8 mm lower keeps it"),
      std::string::npos);
  EXPECT_NE(
      said(NearBottom{-3, 20, NearBottom::Lower::keeps, 23}, kOne)
          .find("the blade would be 3 mm below the face that the block lies on; a block that reaches 23 "
                "mm lower keeps it"),
      std::string::npos);
  // Where that does not help it is not advised.
  for (const StationRange& place : {kOne, StationRange{4, 5, 4, 0}}) {
    EXPECT_TRUE(
        said(NearBottom{-3, 20, NearBottom::Lower::alsoCut}, place)
            .ends_with("; the surface goes on below the block, so that a lower one would be cut lower, too"));
    EXPECT_TRUE(said(NearBottom{-3, 20, NearBottom::Lower::noRoom, 23}, place)
                    .ends_with("; there is no room for a block that reaches 23 mm lower"));
    EXPECT_TRUE(said(NearBottom{12.4, 20}, place).ends_with("less than the floor of 20 mm"));
  }
  // A range that counts no station is the way between its ends, outside of the row where there is none.
  EXPECT_NE(
      said(NearBottom{-3, 20}, StationRange{-1, 0, 0, 0})
          .find("on the way in, before station 1, the blade would be 3 mm below the face that the block"),
      std::string::npos);
  EXPECT_NE(said(NearBottom{12.4, 20}, StationRange{32, -1, 32, 0})
                .find("on the way out, after station 33, the blade passes the face"),
            std::string::npos);
  EXPECT_NE(said(NearBottom{12.4, 20}, StationRange{4, 5, 4, 0})
                .find("on the way from station 5 to station 6 the blade passes the face"),
            std::string::npos);
  EXPECT_NE(
      said(NearBottom{-3, 20})
          .find("at the cell's home, as the program begins, the blade would be 3 mm below the face that "
                "the block lies on; a home that lies 23 mm higher keeps it"),
      std::string::npos);
  UnevenSpeed uneven{0.144};
  const std::string slow =
      "station 8: the slowest point of the blade moves at 14 % of the fastest, so that it melts a wider kerf "
      "there; ";
  EXPECT_EQ(said(uneven, kOne),
            slow + "turn the cutting direction, or cut it in parts, each with a narrower block of its own");
  uneven.tried = true;
  EXPECT_EQ(said(uneven, kOne), slow +
                                    "neither a split across the blade nor other planes were found that keep "
                                    "it at 30 % and bring no other warning");
  uneven.parts = {{0, 170, 0.372}, {170, 320.4, 0.41}, {320.4, 600, 0.55}};
  EXPECT_EQ(said(uneven, kOne),
            slow +
                "split across the blade at 170 and 320.4 mm along the block's x it is 37, 41 and 55 % in "
                "the parts");
  uneven.planes = {false, {0, 1, 0}, 0.996};
  EXPECT_TRUE(said(uneven, kOne)
                  .ends_with("% in the parts; in parallel planes, travelling along (0, 1, 0), it is 100 %"));
  uneven.planes->turning = true;
  uneven.parts.clear();
  EXPECT_EQ(said(uneven, kOne), slow + "in planes that turn with the key blades it is 100 %");
  EXPECT_NE(said(Overbent{200, 360}, kOne, {OtherLength{700}}).find("; try one of 700 mm"),
            std::string::npos);
  EXPECT_NE(said(Overbent{200, 360}, kOne, {OtherLength{700}, BendingBlade{198, "rod", "Rod", 150}})
                .find("; try one of 700 mm"),
            std::string::npos);
  EXPECT_NE(said(Overbent{200, 360}, kOne, {BendingBlade{198, "rod", "Rod", 150}})
                .find("it takes at least a blade that bends to 198 mm, such as the Rod (150 mm)"),
            std::string::npos);
  EXPECT_NE(
      said(TooTight{25, 360, 14, 2}, kOne, {BendingBlade{20, "rod", "Rod", 150}, LargerSurface{3.2, 2100}})
          .find("(none of the presets does; the Rod bends farthest, to 150 mm), or a surface at least 3.2 "
                "times as "
                "large with a blade of 2100 mm"),
      std::string::npos);
}

TEST(Findings, TellWhereAProgramIsTooFast) {
  Finding finding{Severity::warning, TooFastOnTheWay{27.1, 20}, {StationRange{3, 4, 3, 0}, {}}, {}};
  EXPECT_EQ(words::sentence(finding, words::Reader::window),
            "on the way from station 4 to station 5 a point of the blade goes at 27.1 mm/s (cutting speed "
            "20 mm/s), so that it melts less there");
}

TEST(Findings, TellTheClearanceThatServes) {
  OtherShape lost;
  lost.lost = OtherShape::Lost::lowBarrier;
  EXPECT_NE(said(lost, kOne, {OtherClearance{10, 620}})
                .find("; a blade of 620 mm serves where grips may come within 10 mm of the block"),
            std::string::npos);
  EXPECT_NE(said(lost, kOne, {OtherClearance{10}, OtherMargin{0.1}})
                .find("; this blade serves where grips may come within 10 mm of the block, or this blade "
                      "serves where a "
                      "stability margin of 0.1 is asked for"),
            std::string::npos);
  EXPECT_NE(
      said(GripTooNear{20, 50}, kOne, {OtherBlock{}, OtherClearance{15}})
          .find("known to keep the clearance; this blade serves where grips may come within 15 mm of the "
                "block"),
      std::string::npos);
  EXPECT_NE(said(NoWay{true, "it snaps"}, kOne, {OtherClearance{15, 700}})
                .find("it snaps; a blade of 700 mm serves where grips may come within 15 mm"),
            std::string::npos);
  using Said = ServingLengths::Said;
  ServingLengths none{Said::none, 800, 700, 1200, 10};
  EXPECT_EQ(said(none),
            "no length of this blade is known to serve all stations (700 to 1200 mm were tried, and grips "
            "down to 10 mm "
            "from the block); take another blade or direction, or cut in parts");
  EXPECT_EQ(said(none, {}, {OtherClearance{15, 625}}),
            "no length of this blade is known to serve all stations (700 to 1200 mm were tried with this "
            "clearance); a "
            "blade of 625 mm serves where grips may come within 15 mm of the block");
  ServingLengths others{Said::others, 705, 700, 900};
  EXPECT_EQ(
      said(others),
      "lengths that serve the stations that they were tried on: 700 to 900 mm; the best, 705 mm, serves "
      "all");
  others.said = Said::taken;
  EXPECT_EQ(
      said(others),
      "the blade's length was left open: 705 mm was taken, which serves all stations; 700 to 900 mm serve "
      "those that they were tried on");
  others.from = others.to = 705;
  EXPECT_EQ(said(others), "the blade's length was left open: 705 mm was taken, which serves all stations");
  others.said = Said::others;
  EXPECT_EQ(said(others), "a blade of 705 mm serves all stations");
  EXPECT_EQ(action(OtherClearance{15, 625}), "Allow a clearance of 15 mm with a blade of 625 mm");
  EXPECT_EQ(action(OtherClearance{15}), "Allow a clearance of 15 mm");
}

TEST(Findings, SpeakToWhoReadsThem) {
  const ProgramDespiteErrors refused{2, false};
  EXPECT_NE(said(refused, {}, {}, Reader::commandLine).find("--despite-errors"), std::string::npos);
  EXPECT_EQ(said(refused), "no RAPID program is written, because the design has 2 errors; mend them");
  EXPECT_EQ(
      said(ProgramDespiteErrors{1, true}),
      "the RAPID program is written although the design has an error; its modules are marked as not safe "
      "to run");
}

TEST(Findings, EveryCauseHasASentenceAndAWord) {
  for (const Finding& finding : everyCause()) {
    const bool foreign = std::holds_alternative<LeftOutOfFile>(finding.cause) ||
                         std::holds_alternative<Healed>(finding.cause) ||
                         std::holds_alternative<UnreadableCell>(finding.cause) ||
                         std::holds_alternative<ProgramBreach>(finding.cause);
    if (foreign) continue;  // says what it holds
    for (const Reader reader : {Reader::commandLine, Reader::window}) {
      const std::string text = sentence(finding, reader);
      EXPECT_GT(text.size(), 20u) << finding.cause.index();
      EXPECT_NE(text.back(), '.') << text;
      EXPECT_EQ(text.find("split"), std::string::npos) << "there is no such command: " << text;
    }
    EXPECT_FALSE(kindWord(finding).empty());
    EXPECT_EQ(sentence(finding, Reader::window).find("--"), std::string::npos);
  }
}

TEST(Findings, KindsHaveWordsOfTheirOwn) {
  std::set<std::pair<FindingKind, std::string>> kinds;
  std::set<std::string> words;
  for (const Finding& finding : everyCause()) {
    if (std::holds_alternative<ProgramBreach>(finding.cause)) continue;
    kinds.insert({finding.kind(), kindWord(finding)});
    words.insert(kindWord(finding));
  }
  EXPECT_EQ(kinds.size(), words.size());
}

TEST(Findings, InAListStandWithTheirPlace) {
  const Finding side{Severity::warning, WrongSide{"left", "T_ROB1", "T_ROB2", 900, 600, false}, {}, {}};
  EXPECT_EQ(listed(side, Reader::window).substr(0, 40), "End of the cut: the left end of the blad");
  const Finding row{Severity::warning, SectionPoint{}, {kAll, {}}, {}};
  EXPECT_EQ(listed(row, Reader::window).substr(0, 26), "Stations 3 to 9 are left o") << "once, not twice";
  EXPECT_EQ(placeText(row), "station 7");
  // Names stay as they were given.
  Finding named = side;
  named.where = {.block = "tail", .cut = "east"};
  EXPECT_EQ(listed(named, Reader::window).substr(0, 38), "tail, east: End of the cut: the left e");
  named.where = {.block = "tail", .cut = "cut-tail"};
  EXPECT_EQ(sentence(named, Reader::window).substr(0, 20), "cut-tail: the left e");
}

TEST(Findings, OfRobotsThatCannotHoldTheBladeNameWhatTurnsTheBlock) {
  const Finding side{Severity::warning, WrongSide{"left", "T_ROB1", "T_ROB2", 900, 600, false}, {}, {}};
  const Finding reach{Severity::error, HomeOutOfReach{"T_ROB1", "left", 2600, 2500}, {}, {}};
  for (const Finding& finding : {side, reach}) {
    EXPECT_NE(sentence(finding, Reader::window).find("turn the block (Turned by)"), std::string::npos);
    EXPECT_NE(sentence(finding, Reader::commandLine).find("turn the block (\"turn_deg\")"),
              std::string::npos);
  }
}

TEST(Remedies, HaveAnActionWhereTheProgramCanDoThem) {
  EXPECT_EQ(action(OtherLength{812}), "Use a blade of 812 mm");
  EXPECT_EQ(action(BendingBlade{100, "rod", "Rod 1 mm", 90}), "Use Rod 1 mm");
  EXPECT_EQ(action(BendingBlade{100, "rod", "Rod 1 mm", 110}), "") << "it does not bend so far";
  EXPECT_EQ(action(MoreStations{119}), "Take 119 stations");
  EXPECT_EQ(action(WiderTolerance{2.3}), "Allow 2.3 mm");
  EXPECT_EQ(action(CutInParts{}), "");
}

}  // namespace bw::words
