// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What is said of blades and their rows.

#include <algorithm>
#include <cctype>
#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/blade/cutting_limits.h"
#include "bw/core/fit/elastica_fit.h"
#include "bw/core/text/number_text.h"
#include "sentences.h"

namespace bw::words {

namespace {

/// Where nothing that was tried serves.
const std::string kNoneServes = "take another blade or direction, or cut in parts";

std::string mm(double value, int digits = 3) { return shortText(value, digits) + " mm"; }

/// What was found to serve besides another length: another clearance, another margin. Empty if nothing was.
std::string alsoServes(const Finding& finding) {
  std::string text;
  if (const OtherClearance* nearer = remedyOf<OtherClearance>(finding.remedies))
    text = (nearer->length ? "a blade of " + mm(*nearer->length, 6) + " serves"
                           : std::string("this blade serves")) +
           " where grips may come within " + mm(nearer->clearance) + " of the block";
  if (const OtherMargin* margin = remedyOf<OtherMargin>(finding.remedies))
    text += (text.empty() ? "" : ", or ") + std::string("this blade serves where a stability margin of ") +
            shortText(margin->margin, 2) + " is asked for";
  return text;
}

/// "try one of 812 mm": the length was tried at some stations, each for itself; or what else serves.
std::string shorterText(const Finding& finding, const std::string& otherwise, const std::string& more = {}) {
  const OtherLength* blade = remedyOf<OtherLength>(finding.remedies);
  const std::string also = alsoServes(finding);
  if (!blade) return also.empty() ? otherwise : also;
  return "try one of " + mm(blade->length, 6) + more + (also.empty() ? "" : "; " + also);
}

/// So many digits, `digits` at least, that a number is seen to be another than its limit.
int digitsBeside(double number, double limit, int digits) {
  while (digits < 8 && shortText(number, digits) == shortText(limit, digits)) ++digits;
  return digits;
}

/// A number that is told beside its limit, in mm.
std::string mmBeside(double number, double limit) { return mm(number, digitsBeside(number, limit, 3)); }

/// "a flat blade", and how thick it may be where none of the presets bends far enough.
std::string flatBladeText(const Finding& finding) {
  const FlatBlade* flat = remedyOf<FlatBlade>(finding.remedies);
  if (!flat || !flat->thickness) return "a flat blade";
  const double tenths = std::floor(10 * *flat->thickness) / 10;
  return "a flat blade of " + mm(tenths > 0 ? tenths : *flat->thickness, 2) + " at most";
}

std::string takesText(const Finding& finding) {
  const BendingBlade* blade = remedyOf<BendingBlade>(finding.remedies);
  return blade ? "it takes at least " + bendingBladeText(*blade) : std::string(kInParts);
}

std::string otherBlockText(const Finding& finding, bool single) {
  const OtherBlock* block = remedyOf<OtherBlock>(finding.remedies);
  if (!block || block->how == OtherBlock::How::smaller)
    return "choose a smaller block or another cutting direction";
  return std::string("choose a block that ") +
         (block->how == OtherBlock::How::beginsAfter ? "begins after" : "ends before") +
         (single ? " this station" : " these stations") +
         ", one that is narrower along the blade, or another cutting direction";
}

/// What helps where more stations do not.
const std::string kSlackens =
    "the blade goes over from taut to slack, or back, and swings by that: more stations do not change it; "
    "take "
    "a stiffer or lighter blade, which straight sections need not be pulled into";
const std::string kUnrested = "it does not keep its shape there, which is to be mended first";

/// "take more stations", and what a longer section between them would need before.
std::string moreStationsText(const Finding& finding, const std::string& take) {
  const OtherLength* blade = remedyOf<OtherLength>(finding.remedies);
  return take +
         (blade ? " (a section between may need a blade of " + mm(blade->length, 6) + ": take that first)"
                : std::string());
}

std::string leftOutText(int first, int last) {
  return first == last
             ? stationName(first) + " is left out"
             : "stations " + std::to_string(first + 1) + " to " + std::to_string(last + 1) + " are left out";
}

}  // namespace

std::string Sentences::operator()(const UnmetConditions& cause) const {
  const std::string list = conditionsInWords(cause.conditions);
  const std::size_t count = cause.conditions.size();
  return at() + "no blade was found that meets " +
         (count == 0   ? std::string("all conditions together; release one of them")
          : count == 1 ? list + "; release it"
                       : list + " together; release one of them") +
         "; the nearest curve without conditions stands in for it";
}

std::string Sentences::operator()(const UnsettledFit& cause) const {
  return at() + "the search for the nearest curve did not come to rest; the curve taken is within " +
         mm(cause.distance) + " of the section";
}

std::string Sentences::operator()(const HeldBackFit& cause) const {
  return at() +
         "continued to its grips, the nearest curve would overbend the blade, leave it without its margin or "
         "open to a push; a curve within " +
         mm(cause.distance) + " of the section, which the whole blade holds, takes its place";
}

std::string Sentences::operator()(const Overbent& cause) const {
  return at() + "the blade must bend to a radius of " + mmBeside(cause.radius, cause.limit) +
         " but keeps its shape only down to " + mm(cause.limit) + "; " +
         shorterText(finding, takesText(finding));
}

std::string Sentences::operator()(const TooTight& cause) const {
  std::string text = at() + "the surface is too tight: it bends to a radius of " +
                     mmBeside(cause.radius, cause.limit) + ", the blade only to " + mm(cause.limit) +
                     ", so that it stays " + mm(cause.distance) + " or more off (tolerance " +
                     mm(cause.tolerance) + "); ";
  if (!remedyOf<BendingBlade>(finding.remedies))
    return text +
           "its ends turn towards each other, so that no blade between two grips follows it whatever it "
           "bends to: " +
           kInParts;
  text += takesText(finding);
  if (const LargerSurface* larger = remedyOf<LargerSurface>(finding.remedies))
    text += ", or a surface at least " + shortText(larger->scale, 4) + " times as large" +
            (larger->bladeLength ? " with a blade of " + mm(*larger->bladeLength, 6) : std::string());
  return text;
}

std::string Sentences::operator()(const ManyInflections& cause) const {
  return at() + "the blade would need " + std::to_string(cause.count) +
         " inflections; a stiff blade holds at most two, so " + kInParts;
}

std::string Sentences::operator()(const WouldSnap&) const {
  return at() + "the blade would not rest in this shape but snap to another; " +
         shorterText(finding, kInParts);
}

/// Where a finding of stations is: at them, or on a way beside them.
static std::string onTheWay(const Finding& finding, const std::string& atStations) {
  const StationRange& range = *finding.where.stations;
  if (range.count > 0) return atStations;
  if (range.first < 0 && range.last < 0) return "all along, from the way in to the way out, ";
  if (range.first < 0) return "on the way in, before " + stationName(range.last) + ", ";
  if (range.last < 0) return "on the way out, after " + stationName(range.first) + ", ";
  if (range.first == range.last) return "beside " + stationName(range.first) + " ";
  return "on the way from " + stationName(range.first) + " to " + stationName(range.last) + " ";
}

std::string Sentences::operator()(const LowMargin& cause) const {
  return onTheWay(finding, at()) + "the blade rests in this shape with a margin of " +
         shortText(cause.margin, digitsBeside(cause.margin, cause.asked, 2)) +
         " alone (asked for: " + shortText(cause.asked, 3) + "; it snaps at 0); " +
         shorterText(finding, kInParts);
}

std::string Sentences::operator()(const SnapsInWeight& cause) const {
  return at() + "as its own weight comes on, the blade leaves this shape (at " +
         shortText(100 * cause.share, 2) + " % of it) for another, " + mm(cause.distance) + " away; " +
         shorterText(finding, "take a lighter or stiffer blade, or one that is shorter");
}

std::string Sentences::operator()(const MovedByWeight& cause) const {
  return at() + "its own weight moves the blade by " + mm(cause.distance) +
         ", which the surface shown contains";
}

std::string Sentences::operator()(const BentSideways& cause) const {
  return at() + "its own weight across the plane bends the round blade " + mm(cause.distance) +
         " out of it, which the surface shown does not contain; " + flatBladeText(finding) + " carries it";
}

std::string Sentences::operator()(const WeightElsewhere& cause) const {
  // What rounding leaves of 0 is none.
  const auto part = [&](int axis) { return shortText(std::round(1e6 * cause.up[axis]) / 1e6 + 0.0, 4); };
  return "as the block lies in the cell, up is " + fixedText(toDegrees(cause.angle), 0) +
         "° off what the weight of the blade is counted along, so that it hangs otherwise there; leave it to "
         "the block (\"up\": \"block\"), or let it be [" +
         part(0) + ", " + part(1) + ", " + part(2) + "], or place the block as it will lie";
}

std::string Sentences::operator()(const UnknownInWeight& cause) const {
  return at() + "how the blade hangs in its own weight could not be found: " + cause.why;
}

std::string Sentences::operator()(const WouldTwist&) const {
  return onTheWay(finding, at()) +
         "a round blade would twist out of its plane rather than rest in this shape; " +
         shorterText(finding, "take " + flatBladeText(finding) + ", which is stiff across its plane",
                     ", or " + flatBladeText(finding));
}

/// What would keep the blade in the row's shape, as far as it was tried.
static std::string keptText(const Finding& finding, const std::string& untried) {
  const OtherLength* length = remedyOf<OtherLength>(finding.remedies);
  std::string text = length ? "a blade of " + mm(length->length, 6) + " serves" : std::string();
  if (const std::string also = alsoServes(finding); !also.empty())
    text += (text.empty() ? "" : ", or ") + also;
  if (!text.empty()) return "; " + text;
  return "; " + (remedyOf<CutInParts>(finding.remedies) ? kNoneServes : untried);
}

/// The same of a blade that snaps where a grip is off, which may be held more exactly, too.
static std::string keptOrHeldExactly(const Finding& finding) {
  return keptText(finding, "take another length") +
         ", or let the grips be held more exactly (grip error, grip turn)";
}

std::string Sentences::operator()(const GripErrors& cause) const {
  const std::string off = onTheWay(finding, at()) + "a grip that is off by " + shortText(cause.error) +
                          " mm and " + shortText(toDegrees(cause.angle)) + "° ";
  return std::isfinite(cause.moved)
             ? off + "moves the cut by up to " + mmBeside(cause.moved, cause.tolerance) +
                   ", more than the tolerance of " + shortText(cause.tolerance) + " mm"
         : cause.snaps ? off + "makes the blade snap" + keptOrHeldExactly(finding)
                       : off + "may make the blade snap: where it goes could not be found";
}

std::string Sentences::operator()(const PulledByGrips& cause) const {
  return at() + "a grip that is off by " + shortText(cause.error) +
         " mm may take up the slack of the blade (" +
         (cause.slack < 1e-3 ? std::string("next to none") : shortText(cause.slack, 2) + " mm") +
         ") and pull it, by up to " + shortText(cause.stress, 2) + " N/mm² if nothing gives way";
}

std::string Sentences::operator()(const HeldByLittle& cause) const {
  const std::string off = at() + "where a grip is off by " + shortText(cause.error) + " mm and " +
                          shortText(toDegrees(cause.angle)) + "°, ";
  const std::string other = " another shape, " + mm(cause.distance) + " away";
  return cause.barrier > 0 ? off + "a push of " + shortText(cause.barrier, 2) +
                                 " N mm brings the blade into" + other + ", which a touch may bring about"
                           : off + "the blade snaps into" + other + keptOrHeldExactly(finding);
}

std::string Sentences::operator()(const ServingLengths& cause) const {
  using Said = ServingLengths::Said;
  const auto whole = [](double length) { return shortText(length, 6); };
  const std::string stretch =
      cause.from < cause.to ? whole(cause.from) + " to " + whole(cause.to) + " mm" : whole(cause.to) + " mm";
  const std::string also = alsoServes(finding);
  const bool nearer = remedyOf<OtherClearance>(finding.remedies) != nullptr;
  const std::string clearances = nearer ? " with this clearance"
                                 : cause.leastClearance
                                     ? ", and grips down to " + mm(*cause.leastClearance) + " from the block"
                                     : "";
  const std::string none =
      "no length of this blade is known to serve all stations (" + stretch + " were tried" + clearances + ")";
  const std::string mended = "; " + (also.empty() ? kNoneServes : also);
  // The best was computed whole; of others that is known what they were tried on.
  const std::string best = whole(cause.best) + " mm";
  const bool alone = cause.from == cause.to;
  switch (cause.said) {
    case Said::others:
      return alone ? "a blade of " + best + " serves all stations"
                   : "lengths that serve the stations that they were tried on: " + stretch + "; the best, " +
                         best + ", serves all" +
                         (cause.atStationsAlone ? " stations; what is not cut between or beside them is "
                                                  "to be mended by itself"
                                                : "");
    case Said::none:
      return none + mended;
    case Said::taken:
      return "the blade's length was left open: " + best + " was taken, which serves all stations" +
             (cause.atStationsAlone ? ", though not all that lies between or beside them" : "") +
             (alone ? "" : "; " + stretch + " serve those that they were tried on");
    case Said::nearest:
      break;
  }
  return none + "; " + whole(cause.best) + " mm, which comes nearest, was taken" + mended;
}

std::string Sentences::operator()(const GripTooNear& cause) const {
  const StationRange& range = *finding.where.stations;
  const bool between = range.count == 0 && range.first >= 0 && range.last >= 0;
  std::string text =
      onTheWay(finding, at()) +
      (cause.distance < 0 ? "a grip would be " + mm(-cause.distance) + " inside the block"
                          : "a grip passes the block at " + mmBeside(cause.distance, cause.clearance) +
                                ", less than the clearance of " + mm(cause.clearance));
  if (between) return text + "; " + moreStationsText(finding, "take more stations");
  if (range.count == 0) return text + "; " + otherBlockText(finding, true);
  if (const OtherLength* blade = remedyOf<OtherLength>(finding.remedies))
    return text + "; try a blade of " + mm(blade->length, 6);
  text += cause.unheldLength
              ? "; a blade that keeps the clearance (" + mm(*cause.unheldLength, 6) + ") would not serve"
              : "; no longer blade of this shape is known to keep the clearance";
  if (const std::string also = alsoServes(finding); !also.empty()) return text + "; " + also;
  return text + "; " + otherBlockText(finding, finding.where.stations->first == finding.where.stations->last);
}

/// Where a blade comes near to the face that its block lies on: at stations, on a way beside them, or, with
/// none, where the cell holds it before the motion.
static std::string lowAt(const Finding& finding, const std::string& atStations) {
  if (!finding.where.stations) return "at the cell's home, as the program begins, ";
  return onTheWay(finding, atStations);
}

std::string Sentences::operator()(const NearBottom& cause) const {
  constexpr double kNothing = 1e-4;  // mm
  const bool atHome = !finding.where.stations;
  const std::string text =
      lowAt(finding, atHome ? std::string() : at()) +
      (cause.height < -kNothing
           ? "the blade would be " + mm(-cause.height) + " below the face that the block lies on"
           : "the blade passes the face that the block lies on at " + mm(std::max(0.0, cause.height)) +
                 ", less than the floor of " + mm(cause.floor));
  if (atHome)
    return text + "; a home that lies " + mm(std::ceil(cause.floor - cause.height)) + " higher keeps it";
  switch (cause.lower) {
    case NearBottom::Lower::unknown:
      break;
    case NearBottom::Lower::keeps:
      return text + "; a block that reaches " + mm(cause.lowerBy) + " lower keeps it";
    case NearBottom::Lower::alsoCut:
      return text + "; the surface goes on below the block, so that a lower one would be cut lower, too";
    case NearBottom::Lower::noRoom:
      return text + "; there is no room for a block that reaches " + mm(cause.lowerBy) + " lower";
  }
  return text;
}

std::string Sentences::operator()(const SteepAngle& cause) const {
  return at() + "the blade moves at " + fixedText(toDegrees(cause.angle), 1) +
         "° to the normal of its plane; above " + fixedText(toDegrees(cause.limit), 0) +
         "° this blade drags instead of cutting; turn the cutting direction";
}

static std::string percent(double ratio) { return fixedText(100 * ratio, 0); }

/// "split across the blade at 170 and 320 mm along the block's x it is 37, 41 and 52 % in the parts".
static std::string splitText(const UnevenSpeed& cause) {
  const auto list = [&](std::size_t from, auto text) {
    std::string all;
    for (std::size_t i = from; i < cause.parts.size(); ++i)
      all += (i == from ? "" : i + 1 == cause.parts.size() ? " and " : ", ") + text(cause.parts[i]);
    return all;
  };
  return "split across the blade at " +
         list(1, [](const UnevenSpeed::Part& part) { return shortText(part.from, 4); }) +
         " mm along the block's " + "xyz"[cause.edge] + " it is " +
         list(0, [](const UnevenSpeed::Part& part) { return percent(part.ratio); }) + " % in the parts";
}

static std::string otherPlanesText(const UnevenSpeed::Planes& planes) {
  std::string text = "in planes that turn with the key blades";
  if (!planes.turning) {
    text = "in parallel planes, travelling along (";
    for (int axis = 0; axis < 3; ++axis)
      text += (axis > 0 ? ", " : "") +
              shortText(std::abs(planes.direction[axis]) < 5e-4 ? 0 : planes.direction[axis], 3);
    text += "),";
  }
  return text + " it is " + percent(planes.ratio) + " %";
}

std::string Sentences::operator()(const UnevenSpeed& cause) const {
  const std::string text = at() + "the slowest point of the blade moves at " + percent(cause.ratio) +
                           " % of the fastest, so that it melts a wider kerf there; ";
  if (!cause.tried) return text + "turn the cutting direction, or " + kInParts;
  if (cause.parts.empty() && !cause.planes)
    return text + "neither a split across the blade nor other planes were found that keep it at " +
           percent(kSpeedRatioLimit) + " % and bring no other warning";
  std::string helps = cause.parts.empty() ? std::string() : splitText(cause);
  if (cause.planes) helps += (helps.empty() ? "" : "; ") + otherPlanesText(*cause.planes);
  return text + helps;
}

std::string Sentences::operator()(const EndsSwing& cause) const {
  return stationName(finding.where.stations->worst) + ": the blade's end turns " +
         fixedText(toDegrees(cause.angle), 0) + "° within " + mm(cause.travel) + " of travel" +
         (cause.places > 1 ? " (more than " + fixedText(toDegrees(cause.limit), 0) + "° at " +
                                 std::to_string(cause.places) + " places)"
                           : std::string()) +
         "; " + moreStationsText(finding, "take more stations") +
         ", a shorter blade, or a block in which the sections change less";
}

std::string Sentences::operator()(const GapInRow& cause) const {
  const StationRange& range = *finding.where.stations;
  const bool missed = finding.severity == Severity::info;
  std::string left = leftOutText(range.first + 1, range.last - 1) + " inside the row";
  if (cause.otherPlaces > 0) left += ", and others in " + std::to_string(cause.otherPlaces) + " more places";
  if (missed)
    return left + (cause.otherPlaces > 0 ? ", each in a gap" : ", in a gap") +
           " of the target: the blade goes straight on over " + mm(cause.width) + " from " +
           stationName(range.first) + " to " + stationName(range.last) +
           (cause.otherPlaces > 0 ? " and over the others" : "");
  return left + ": with nothing to follow, the blade would cut straight on over " + mm(cause.width) +
         " from " + stationName(range.first) + " to " + stationName(range.last) +
         "; choose a block on one side of the gap, one face without it, or another cutting direction";
}

std::string Sentences::operator()(const TooFar& cause) const {
  std::string text = "the cut surface is up to " + mmBeside(cause.deviation, cause.tolerance) +
                     " from the target near " + placeText(finding) + ", more than the tolerance of " +
                     mm(cause.tolerance) + " (" + fixedText(std::min(99.9, 100 * cause.within), 1) +
                     " % of its area lies within); ";
  switch (cause.source) {
    case TooFar::Source::stations:
      break;
    case TooFar::Source::between:
      if (cause.slackens)
        return text + "it arises between the stations, which keep within " + mm(cause.own) + ", where " +
               kSlackens;
      return text + "it arises between the stations, which are " + mm(cause.spacing) +
             " apart there; the stations themselves keep within " + mm(cause.own) + ", so " +
             moreStationsText(finding, "take more of them");
    case TooFar::Source::gap:
      return text + "it arises where " + leftOutText(cause.leftFirst, cause.leftLast) +
             ": close that gap first";
  }
  if (cause.unheld)
    text +=
        "the ends, tangents or length that are asked for (fit, join) keep it there, and without them a curve "
        "lies within " +
        mm(*cause.unheld) + "; ";
  return text + kInParts + ", turn the cutting direction, or allow more";
}

/// mm² of a surface that are told.
static constexpr double kHardlyAny = 1;

std::string Sentences::operator()(const Uncovered& cause) const {
  if (cause.where == Uncovered::Where::elsewhere)
    return "nothing of the surface lies in the block, where it has a hole or ends: no cut is asked for "
           "there; "
           "move the block to where the surface is";
  const std::string where = cause.where == Uncovered::Where::before  ? " before the first station that cuts"
                            : cause.where == Uncovered::Where::after ? " after the last station that cuts"
                                                                     : " beyond the end of the blade's cut";
  // Of a line that is missed the area says nothing.
  const std::string part = cause.area < kHardlyAny
                               ? std::string("a border of the surface in the block")
                               : shortText(100 * cause.share, 3) + " % of the surface in the block (" +
                                     shortText(cause.area, 3) + " mm²)";
  std::string remedy = cause.between ? "; it is off between the stations, which keep the tolerance: what is "
                                       "told of the way between them is to be mended first"
                                     : "; choose another cutting direction, or " + std::string(kInParts);
  if (const std::optional<Eigen::Vector3d>& point = finding.where.point)
    remedy = ", farthest at (" + shortText(point->x(), 4) + ", " + shortText(point->y(), 4) + ", " +
             shortText(point->z(), 4) + ")" + remedy;
  if (cause.where == Uncovered::Where::off)
    return (cause.area < kHardlyAny ? "a place of the surface in the block" : part) +
           " is not cut: it lies up to " + mm(cause.distance) + " from what is" + remedy;
  return part + " is not cut: it reaches " + mm(cause.distance) + where + remedy;
}

std::string Sentences::operator()(const OutsideBlocks& cause) const {
  const std::string part =
      shortText(100 * cause.share, 3) + " % of the surface (" + areaText(cause.area) + ") ";
  return part + (cause.several ? "lies in none of the blocks" : "lies outside of the block") + ", up to " +
         mm(cause.distance) + " from " + (cause.several ? "them" : "it") +
         ", and is not cut: what is told of the surface is of the rest; " +
         (cause.several ? "make the blocks larger, or more of them" : "make the block larger, or move it") +
         ", where that is wanted, too";
}

std::string Sentences::operator()(const BladeCrosses& cause) const {
  const OtherLength* blade = remedyOf<OtherLength>(finding.remedies);
  return onTheWay(finding, at()) +
         (cause.itself ? "the blade crosses itself"
                       : "the grips stand on each other's sides of the surface") +
         ", which no blade between two robots can; " +
         (blade ? "try one of " + mm(blade->length, 6) : std::string(kInParts));
}

std::string Sentences::operator()(const ToldBlades& cause) const {
  using Fault = ToldBlades::Fault;
  const auto place = [](double y) { return shortText(y, 4); };
  std::string text =
      (cause.source.empty() ? "" : cause.source + ": ") + std::string("at y = ") + place(cause.from);
  if (place(cause.to) != place(cause.from)) text += " to " + place(cause.to);
  text += " mm the key blades tell shapes ";
  switch (cause.fault) {
    case Fault::unstable:
      text += "in which no blade rests: it would snap out of them";
      break;
    case Fault::tight:
      text += "that bend to a radius of " + mmBeside(cause.radius, cause.limit) +
              ", which this blade may only down to " + mm(cause.limit);
      break;
    case Fault::crossing:
      text += "that cross themselves";
      break;
  }
  if (place(cause.worst) != place(cause.from) || place(cause.to) != place(cause.from))
    text += ", worst at y = " + place(cause.worst);
  text += "; ease the key blades beside it, or add one there that a blade can be";
  return remedyOf<BendingBlade>(finding.remedies) ? text + "; else " + takesText(finding) : text;
}

std::string Sentences::operator()(const TargetsCrowd& cause) const {
  return (cause.count == 1 ? "a target of the program follows"
                           : std::to_string(cause.count) + " targets of the program follow") +
         std::string(" in less than ") + shortText(cause.least) + " s (the soonest in " +
         shortText(cause.seconds, 2) + " s), because the motion tolerance of " + mm(cause.tolerance) +
         " asks for them; where the controller cannot keep up, cut more slowly or allow more";
}

std::string Sentences::operator()(const LeadGrown& cause) const {
  return std::string(cause.atStart ? "the blade starts " : "the blade goes on ") + mm(cause.grown) +
         (cause.atStart ? " before the first station" : " beyond the last station") + " in place of " +
         mm(cause.asked) + ", so that all of it is outside of the block there; it cuts the foam on that way";
}

/// What keeps the blade in its shape, or why nothing does.
static std::string lostText(const OtherShape& cause, const std::string& shorter) {
  using Lost = OtherShape::Lost;
  switch (cause.lost) {
    case Lost::no:
      return "; the program leads it into this one, and it stays there while its grips are where they should "
             "be";
    case Lost::noEntry:
      return ", and no way is known that leads it into this one" + shorter;
    case Lost::leaves:
      return ", and before it comes there it leaves the shapes of the row" + shorter;
    case Lost::lowMargin:
      return ", and on the way there its stability margin falls to " + shortText(cause.margin, 2) + shorter;
    case Lost::lowBarrier:
      return ", which a touch may bring about" + shorter;
    case Lost::unknownBarrier:
    case Lost::unsought:
      break;
  }
  return ", and how little brings it over could not be found" + shorter;
}

std::string Sentences::operator()(const OtherShape& cause) const {
  if (cause.lost == OtherShape::Lost::unsought)
    return onTheWay(finding, at()) +
           "it could not be found out whether the blade rests in another shape there too, so that nothing "
           "tells that it is in the one shown" +
           keptText(finding, "take a shorter blade");
  return onTheWay(finding, at()) + "between these grips the blade rests in another shape too, " +
         mm(cause.distance) + " away, with an energy of " + shortText(cause.other) +
         " N mm (this one: " + shortText(cause.energy) + " N mm" +
         (cause.barrier ? "; a push of " + shortText(*cause.barrier, 2) + " N mm brings it from here there"
                        : "") +
         ")" + lostText(cause, keptText(finding, "take a shorter blade"));
}

/// What was told as sentences, the last of which advises something, as a clause without that: the advice is
/// that of the finding.
static std::string clauseOf(const std::string& why) {
  std::string clause = why.substr(0, why.find(". "));
  if (clause.ends_with('.')) clause.pop_back();
  if (clause.starts_with("The ")) clause[0] = 't';
  return clause;
}

/// The same with it.
static std::string clauseAndAdvice(const std::string& why) {
  const std::size_t end = why.find(". ");
  if (end == std::string::npos) return clauseOf(why);
  std::string advice = why.substr(end + 2);
  if (advice.ends_with('.')) advice.pop_back();
  if (!advice.empty()) advice[0] = char(std::tolower(static_cast<unsigned char>(advice[0])));
  return clauseOf(why) + "; " + advice;
}

std::string Sentences::operator()(const NoWay& cause) const {
  return std::string("no way is known that leads the blade ") +
         (cause.entry ? "into the shape of the first station" : "out of the shape of the last station") +
         " outside of the block: " + clauseOf(cause.why) +
         keptText(finding, "take a shorter or stiffer blade");
}

/// The way from a station to the next one, or that on which a run of the motion is.
static std::string wayThere(const Finding& finding, const std::string& atStations) {
  return finding.where.stations->count > 0 ? atStations + "on the way from there to the next station "
                                           : onTheWay(finding, atStations);
}

std::string Sentences::operator()(const SnapsOnTheWay&) const {
  return wayThere(finding, at()) + "the blade leaves its shape and snaps into another" +
         keptText(finding, "take a shorter or stiffer blade");
}

std::string Sentences::operator()(const ArrivesOtherwise&) const {
  return at() + "the blade arrives there in another shape than the one shown" +
         keptText(finding, "take a shorter or stiffer blade");
}

std::string Sentences::operator()(const LostOnTheWay& cause) const {
  return wayThere(finding, at()) + "the blade could not be followed: " + clauseAndAdvice(cause.why);
}

std::string Sentences::operator()(const TooFarOnTheWay& cause) const {
  const std::string text = "between the stations, as the robots move it, the blade is up to " +
                           mmBeside(cause.deviation, cause.tolerance) + " from the target (tolerance " +
                           mm(cause.tolerance) + "); ";
  if (cause.unrested) return text + kUnrested;
  return text + moreStationsText(finding, "take more stations") +
         ", or a smaller motion tolerance, which sets the targets more closely";
}

std::string Sentences::operator()(const OffTheSurfaceShown& cause) const {
  return at() + "on the way from there to the next station the blade is up to " +
         mmBeside(cause.distance, cause.tolerance) + " from the surface shown (motion tolerance " +
         mm(cause.tolerance) + "), and the targets of the program bring it no nearer; " +
         (cause.unrested   ? kUnrested
          : cause.slackens ? kSlackens
                           : moreStationsText(finding, "take more stations"));
}

std::string Sentences::operator()(const TooFastOnTheWay& cause) const {
  // No remedy: at another cutting speed all of the program is as much slower or faster.
  return onTheWay(finding, at()) + "a point of the blade goes at " + shortText(cause.speed) +
         " mm/s (cutting speed " + shortText(cause.limit) + " mm/s), so that it melts less there";
}

std::string Sentences::operator()(const SkinOff& cause) const {
  return at() + "the surface that is measured and written lies up to " + shortText(cause.distance) +
         " mm from the blade, more than " + shortText(cause.tolerance) + " mm; " + kInParts;
}

namespace {

/// What helps where blocks do not meet: more stations, if only what lies between them misses.
std::string jointRemedy(bool atStations) {
  return atStations
             ? "their stations miss each other: where join is none, tangent-planes has the ends of their "
               "cuts held at the boundary; where they are held, their surfaces or their blades do not come "
               "together there: let the surfaces meet, take a blade that bends as they do, or put the "
               "boundary elsewhere"
             : "the stations themselves keep it, so take more of them";
}

}  // namespace

std::string Sentences::operator()(const JointGap& cause) const {
  return cause.one + " and " + cause.other + " meet with a gap of up to " + mmBeside(cause.gap, cause.limit) +
         ", more than the " + mm(cause.limit) + " allowed; " + jointRemedy(cause.atStations > cause.limit);
}

std::string Sentences::operator()(const JointKink& cause) const {
  return cause.one + " and " + cause.other + " meet with a kink of up to " +
         shortText(toDegrees(cause.angle), digitsBeside(toDegrees(cause.angle), toDegrees(cause.limit), 3)) +
         "°, more than the " + shortText(toDegrees(cause.limit)) + "° allowed; " +
         jointRemedy(cause.atStations > cause.limit);
}

std::string Sentences::operator()(const JointOpen& cause) const {
  return "the surface comes to the boundary of " + cause.one + " and " + cause.other +
         " and is cut in one of them alone at " + std::to_string(cause.open) + " of " +
         std::to_string(cause.open + cause.places) +
         " places looked at; choose blocks whose boundary it passes as a whole";
}

std::string Sentences::operator()(const JointUnknown& cause) const {
  return "how the surface passes from " + cause.one + " to " + cause.other + " is not compared at " +
         std::to_string(cause.places) + (cause.places == 1 ? " place" : " places") +
         " of their boundary, because it runs along that or its blades are not known there; look at both "
         "cut surfaces there, or put the boundary elsewhere";
}

std::string Sentences::operator()(const KerfUnsettled& cause) const {
  return "the blades and the kerf over their speed do not come to rest: after " +
         std::to_string(cause.rounds) + " rounds widths still change by " + mm(cause.change) +
         ", half of which the map of deviation shows; flatten the table of the kerf";
}

std::string Sentences::operator()(const BlocksMissed& cause) const {
  constexpr std::size_t kNamed = 6;
  std::string names;
  for (std::size_t i = 0; i < std::min(kNamed, cause.blocks.size()); ++i)
    names += (i ? ", " : "") + cause.blocks[i];
  if (cause.blocks.size() > kNamed) names += " and others";
  return std::to_string(cause.blocks.size()) + " of " + std::to_string(cause.of) +
         " blocks are not met by the surface, and nothing is cut of them: " + names;
}

std::string Sentences::operator()(const BlockUncut& cause) const {
  return "nothing is cut of the block: " + cause.reason;
}

std::string Sentences::operator()(const CutDropped& cause) const {
  return "the cut " + cause.cut + " is not made: of what the cuts before it leave of the block it takes " +
         (cause.met > 1e-3 ? "only what is " + mm(cause.met) + " thick" : "nothing") + " (tolerance " +
         mm(cause.tolerance) + "); take it away, or make it earlier (order)";
}

std::string Sentences::operator()(const CreaseOff& cause) const {
  const std::string edge = "the edge that " + cause.one + " and " + cause.other + " leave";
  std::string text;
  if (cause.most > cause.tolerance)
    text = edge + " lies up to " + mm(cause.most) + " from where the surfaces designed meet, " +
           mm(cause.mean) + " on the mean (tolerance " + mm(cause.tolerance) + ")";
  if (cause.lacking > 0)
    text += (text.empty() ? edge : std::string(", and")) + " lacks " + mm(cause.lacking) +
            " of where the surfaces designed meet";
  return text +
         "; the flatter the angle in which cuts meet, the more their deviations move it: a lower "
         "tolerance or a steeper angle helps";
}

std::string Sentences::operator()(const TakesSurface& cause) const {
  return "where the blade of " + cause.cut + " goes on beyond its own surface it takes up to " +
         mm(cause.depth) + " of the foam below " + cause.of + " away (tolerance " + mm(cause.tolerance) +
         "): a blade goes through the whole block, so that no two cuts leave a hollow edge; make the hollow "
         "one "
         "cut, or part the block there";
}

std::string Sentences::operator()(const PartUnknown& cause) const {
  return "what is left of the block could not be made a solid, and there is no STEP of it and no volume: " +
         cause.reason;
}

std::string Sentences::operator()(const PiecesLeft& cause) const {
  if (cause.pieces == 0)
    return "nothing is left of the block after its cuts; let the other side of one of them stay (keep)";
  return "the block falls into " + std::to_string(cause.pieces) +
         " pieces, which are all to stay; hold each of them, or let another side of a cut stay (keep)";
}

}  // namespace bw::words
