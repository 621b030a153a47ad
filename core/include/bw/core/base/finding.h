// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bw/core/base/remedy.h"

namespace bw {

/// How serious a finding is. An `error` means that the surface cannot be cut as designed.
enum class Severity { info, warning, error };

/// "info", "warning" or "error".
const char* severityName(Severity severity);

/// What findings are about; each has a stable word for scripts (`bw/words/findings.h`).
enum class FindingKind {
  fit,
  fitBounded,
  curvature,
  inflections,
  stability,
  outOfPlane,
  weight,
  length,
  gripErrors,
  clearance,
  floor,
  angle,
  speed,
  swing,
  gap,
  deviation,
  coverage,
  crossing,
  keyBlades,
  certainty,
  entry,
  lead,
  motion,
  skin,
  sectionShort,
  sectionMissing,
  sectionBranches,
  sectionClosed,
  sectionBridged,
  sectionBorder,
  sectionFit,
  sectionRoute,
  kerf,
  face,
  direction,
  leftOut,
  healing,
  source,
  joint,
  crease,
  cuts,
  part,
  blocks,
  cell,
  cellSides,
  program,
  programCheck,
  run
};

// What was found, one value a cause. Lengths in mm, angles in rad, stations by their index.

/// No curve meets these conditions of the fit together; the nearest curve without them stands in.
struct UnmetConditions {
  static constexpr FindingKind kind = FindingKind::fit;
  std::vector<std::string> conditions;  ///< "length", "endpoints", "tangents", …: `FitResult::conflict`
};
/// The search for the nearest curve did not come to rest.
struct UnsettledFit {
  static constexpr FindingKind kind = FindingKind::fit;
  double distance = 0;  ///< of the curve taken from the section
};
/// The nearest curve would break the blade beyond the section; another takes its place.
struct HeldBackFit {
  static constexpr FindingKind kind = FindingKind::fitBounded;
  double distance = 0;
};
/// The blade would bend below its radius.
struct Overbent {
  static constexpr FindingKind kind = FindingKind::curvature;
  double radius = 0, limit = 0;
};
/// The section itself bends more than the blade can, and keeps it off by more than the tolerance.
struct TooTight {
  static constexpr FindingKind kind = FindingKind::curvature;
  double radius = 0, limit = 0, distance = 0, tolerance = 0;
};
struct ManyInflections {
  static constexpr FindingKind kind = FindingKind::inflections;
  int count = 0;
};
/// The blade does not rest in the shape.
struct WouldSnap {
  static constexpr FindingKind kind = FindingKind::stability;
};
/// The blade rests less firmly than asked for.
struct LowMargin {
  static constexpr FindingKind kind = FindingKind::stability;
  double margin = 0, asked = 0;
};
/// Its weight brings the blade into another shape.
struct SnapsInWeight {
  static constexpr FindingKind kind = FindingKind::stability;
  double share = 0;     ///< of the weight, at which it snaps
  double distance = 0;  ///< to where it rests then
};
/// Its weight moves the blade.
struct MovedByWeight {
  static constexpr FindingKind kind = FindingKind::weight;
  double distance = 0;
};
/// Weight across the plane bends a round blade out of it; infinite where it twists out anyway.
struct BentSideways {
  static constexpr FindingKind kind = FindingKind::weight;
  double distance = 0;
};
/// In the cell the block lies another way than the blade's weight is counted along.
struct WeightElsewhere {
  static constexpr FindingKind kind = FindingKind::weight;
  double angle = 0;                               ///< between the two ways up
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< what is up there, in the file's frame: unit
};
/// How the blade hangs in its weight could not be found.
struct UnknownInWeight {
  static constexpr FindingKind kind = FindingKind::weight;
  std::string why;
};
/// A round blade does not rest in its plane.
struct WouldTwist {
  static constexpr FindingKind kind = FindingKind::outOfPlane;
};
/// A grip comes too near to the block, or into it.
struct GripTooNear {
  static constexpr FindingKind kind = FindingKind::clearance;
  double distance = 0;  ///< negative inside
  double clearance = 0;
  /// The blade that would clear the block, where it would not hold the shape.
  std::optional<double> unheldLength = std::nullopt;
};
/// The blade comes near to the face that the block lies on, or below it.
struct NearBottom {
  static constexpr FindingKind kind = FindingKind::floor;
  /// What a block that reaches lower comes to there.
  enum class Lower {
    unknown,
    keeps,    ///< with one that reaches `lowerBy` lower the blade keeps the floor
    alsoCut,  ///< the surface goes on below the block: a lower one is cut lower, too
    noRoom    ///< something lies below, or no block is as large
  };
  double height = 0, floor = 0;  ///< negative below the face
  Lower lower = Lower::unknown;
  double lowerBy = 0;
};
struct SteepAngle {
  static constexpr FindingKind kind = FindingKind::angle;
  double angle = 0, limit = 0;
};
struct UnevenSpeed {
  static constexpr FindingKind kind = FindingKind::speed;
  /// A part of the block that is split across the blade: where it lies along that edge of the block (mm from
  /// its corner), and the ratio there.
  struct Part {
    double from = 0, to = 0, ratio = 1;
    bool operator==(const Part&) const = default;
  };
  /// Planes of another family, and the ratio that blades in them have.
  struct Planes {
    bool turning = false;                                 ///< as the key blades tell, or parallel
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< of the travel
    double ratio = 1;
    bool operator==(const Planes&) const = default;
  };
  double ratio = 1;  ///< slowest over fastest point
  /// Whether what follows was sought; what is told was computed as a design of its own, and keeps the limit.
  bool tried = false;
  std::size_t edge = 0;                         ///< of the block that is split: 0 for its x, 1 y, 2 z
  std::vector<Part> parts = {};                 ///< none where no split was found that helps
  std::optional<Planes> planes = std::nullopt;  ///< likewise
};
/// An end of the blade turns much from the first station of the range to the second.
struct EndsSwing {
  static constexpr FindingKind kind = FindingKind::swing;
  double angle = 0, travel = 0, limit = 0;
  int places = 1;  ///< where it turns by more than the limit
};
/// Stations that are left out inside the row: the range is that of its neighbours.
struct GapInRow {
  static constexpr FindingKind kind = FindingKind::gap;
  double width = 0;
  int otherPlaces = 0;  ///< narrower gaps
};
/// The cut surface is too far from the target.
struct TooFar {
  static constexpr FindingKind kind = FindingKind::deviation;
  /// Where the distance comes from.
  enum class Source { stations, between, gap };
  double deviation = 0, tolerance = 0;
  double within = 1;  ///< part of the area within the tolerance
  Source source = Source::stations;
  double spacing = 0;               ///< of the stations there
  double own = 0;                   ///< largest distance of the stations themselves
  int leftFirst = 0, leftLast = 0;  ///< of the gap
  /// Of a curve without the ends, tangents or length that are asked for, where these keep the blade so far
  /// off.
  std::optional<double> unheld = std::nullopt;
  bool slackens = false;  ///< it arises where the blade goes over from taut to slack, or back
};
/// A part of the target is not cut.
struct Uncovered {
  static constexpr FindingKind kind = FindingKind::coverage;
  /// Where it reaches farthest: before the first station that cuts, after the last one, beyond an end of the
  /// blade's cut, or off the surface that is cut over or under it; or nothing of it is in the block.
  enum class Where { before, after, beside, off, elsewhere };
  double area = 0, share = 0;  ///< mm², and of all of the target in the block
  double distance = 0;         ///< beyond the cut surface, or off it, at most
  Where where = Where::beside;
  bool between = false;  ///< it is off between the stations, which keep the tolerance themselves
};
/// Some of the surface lies in none of the blocks that it is cut in.
struct OutsideBlocks {
  static constexpr FindingKind kind = FindingKind::coverage;
  double area = 0, share = 0;  ///< mm², and of all of the surface
  double distance = 0;         ///< mm from the nearest block, at most
  bool several = false;        ///< blocks
};
/// The blade crosses itself, or its grips stand on each other's sides.
struct BladeCrosses {
  static constexpr FindingKind kind = FindingKind::crossing;
  bool itself = true;
};
/// Over a stretch of their travel key blades tell shapes that no blade can have, mm of their y.
struct ToldBlades {
  static constexpr FindingKind kind = FindingKind::keyBlades;
  enum class Fault {
    unstable,  ///< it would snap out of them
    tight,     ///< they bend sharper than it may: `radius` at the worst, `limit` allowed
    crossing   ///< they cross themselves
  } fault = Fault::unstable;
  double from = 0, to = 0, worst = 0;
  double radius = 0, limit = 0;
  std::string source = {};  ///< its id, where there are several
};
/// Between the same grips the blade rests in another shape as well, which is not clearly higher.
struct OtherShape {
  static constexpr FindingKind kind = FindingKind::certainty;
  /// Why nothing is known to keep the blade in the row's shape, if nothing is; `unsought` where it is not
  /// known whether there is another one, of which nothing is told then.
  enum class Lost { no, noEntry, leaves, lowMargin, lowBarrier, unknownBarrier, unsought };
  double energy = 0, other = 0;                  ///< N mm
  double distance = 0;                           ///< between them
  std::optional<double> barrier = std::nullopt;  ///< N mm that bring it from the row's shape into another one
  Lost lost = Lost::no;
  double margin = 1;  ///< the least on the way there
};
/// No way is known that leads the blade into the shape of the first station, or out of that of the last.
struct NoWay {
  static constexpr FindingKind kind = FindingKind::entry;
  bool entry = true;
  std::string why;
};
/// On the way from one station to the next the blade leaves its shape and snaps into another.
struct SnapsOnTheWay {
  static constexpr FindingKind kind = FindingKind::stability;
};
/// It arrives at the station in another shape than the one shown.
struct ArrivesOtherwise {
  static constexpr FindingKind kind = FindingKind::stability;
};
/// It could not be followed.
struct LostOnTheWay {
  static constexpr FindingKind kind = FindingKind::motion;
  std::string why;
};
/// Between the stations, as the robots move it, the blade is too far from the target.
struct TooFarOnTheWay {
  static constexpr FindingKind kind = FindingKind::deviation;
  double deviation = 0, tolerance = 0;
  bool unrested = false;  ///< the blade does not keep its shape, as others tell: more stations do not help
};
/// Between the stations the blade leaves the surface shown, however many targets the robots have.
struct OffTheSurfaceShown {
  static constexpr FindingKind kind = FindingKind::motion;
  double distance = 0, tolerance = 0;
  bool unrested = false;  ///< as above
  bool slackens = false;  ///< the blade goes over from taut to slack there, or back
};
/// A point of the blade goes faster than the cutting speed as the program is run.
struct TooFastOnTheWay {
  static constexpr FindingKind kind = FindingKind::motion;
  double speed = 0, limit = 0;  ///< mm/s
};
/// Targets follow each other faster than controllers like, because the motion tolerance asks for them.
struct TargetsCrowd {
  static constexpr FindingKind kind = FindingKind::motion;
  int count = 0;
  double seconds = 0, least = 0;  ///< the shortest time between two, and what it should be
  double tolerance = 0;           ///< mm
};
/// A lead is longer than was asked for, so that all of the blade leaves the block.
struct LeadGrown {
  static constexpr FindingKind kind = FindingKind::lead;
  double asked = 0, grown = 0;
  bool atStart = true;
};
/// The surface that is measured and written leaves the blade of a station.
struct SkinOff {
  static constexpr FindingKind kind = FindingKind::skin;
  double distance = 0, tolerance = 0;
};

/// The plane of a station does not meet the target in the block.
struct SectionMissing {
  static constexpr FindingKind kind = FindingKind::sectionMissing;
};
/// … meets it only in a point.
struct SectionPoint {
  static constexpr FindingKind kind = FindingKind::sectionShort;
};
struct SectionShort {
  static constexpr FindingKind kind = FindingKind::sectionShort;
  double length = 0, least = 0;
};
struct SectionBranches {
  static constexpr FindingKind kind = FindingKind::sectionBranches;
  int least = 0, most = 0;  ///< separate curves over the range
  /// mm by which one of them leaves the block through its top, or its bottom, and comes back as another; 0
  /// where none does, or by another side, too.
  double above = 0, below = 0;
};
struct SectionClosed {
  static constexpr FindingKind kind = FindingKind::sectionClosed;
};
/// The section goes on across a hole or a notch of the target, on the surface continued there.
struct SectionBridged {
  static constexpr FindingKind kind = FindingKind::sectionBridged;
  double width = 0;  ///< mm along it
};
/// The border of the target steps back; the section goes on beyond it, on the surface continued there.
struct SectionExtended {
  static constexpr FindingKind kind = FindingKind::sectionBridged;
  double length = 0;  ///< mm along it
};
/// A border of the target could not be matched with the section.
struct SectionBorder {
  static constexpr FindingKind kind = FindingKind::sectionBorder;
};
/// No curve could be laid through the section.
struct SectionUnfit {
  static constexpr FindingKind kind = FindingKind::sectionFit;
  std::string why;
};
struct SectionRough {
  static constexpr FindingKind kind = FindingKind::sectionFit;
  double distance = 0;  ///< of its spline from it
};
/// OpenCASCADE finds another section than the tracer.
struct SectionDiffers {
  static constexpr FindingKind kind = FindingKind::sectionRoute;
  int traced = 0, kernel = 0;  ///< curves that each finds
  double distance = 0;         ///< between them, where each finds one
  bool taken = false;          ///< OpenCASCADE's takes the place of the traced one
};

/// A face of a CAD file.
struct FaceName {
  int index = 0;
  std::string name = {}, type = {};
  double area = 0;  ///< mm²
};
/// The largest face was taken, and which that was.
struct LargestFace {
  static constexpr FindingKind kind = FindingKind::face;
  FaceName face;
  int faces = 0;  ///< of the file
  /// A plane, cylinder or cone that is larger.
  std::optional<FaceName> larger = std::nullopt;
  double left = 0;  ///< mm² of the other faces of a file that holds sheets alone
};
struct NearestFace {
  static constexpr FindingKind kind = FindingKind::face;
  FaceName face;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double distance = 0;
};
struct FacesLeftOut {
  static constexpr FindingKind kind = FindingKind::face;
  int count = 0;
  double width = 0;  ///< narrower ones cannot be cut
};
/// The blade travels across the surface rather than along it.
struct TravelAcross {
  static constexpr FindingKind kind = FindingKind::direction;
};
/// The key blades of the surface turn, but the cut has a direction of its own: its planes are parallel.
struct PlanesNotTurned {
  static constexpr FindingKind kind = FindingKind::direction;
  double least = 0, most = 0;  ///< what the planes of the key blades are turned by, rad
};
/// The direction that was chosen rather than the usual one.
struct ChosenDirection {
  static constexpr FindingKind kind = FindingKind::direction;
  struct Trial {
    std::string name;
    bool failed = false;
    double angle = 0, deviation = 0;
    int unusable = 0, stations = 0;
    int unrested = 0;  ///< stations at which the blade does not rest
  };
  Trial chosen, usual;
};

/// What of a CAD file was left out or healed, as its reader says it.
struct LeftOutOfFile {
  static constexpr FindingKind kind = FindingKind::leftOut;
  std::string text;
};
struct Healed {
  static constexpr FindingKind kind = FindingKind::healing;
  std::string text;
};
/// The linked CAD file is another than when the design was saved.
struct ChangedSource {
  static constexpr FindingKind kind = FindingKind::source;
  std::string file;
  std::uint64_t bytesThen = 0, bytesNow = 0;
};
/// The surface is so small or so large that the unit of its file is hardly the one meant.
struct OddSize {
  static constexpr FindingKind kind = FindingKind::source;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< mm
  std::string readAs;                              ///< the unit that its numbers were taken in
};
/// The design was written by an earlier version of the program; saving it writes the present form.
struct EarlierDesign {
  static constexpr FindingKind kind = FindingKind::source;
  std::string file;
  int version = 1, present = 1;  ///< of the form of design files
};
struct UnreadableCell {
  static constexpr FindingKind kind = FindingKind::cell;
  std::string why;
};
/// An end of the blade lies nearer to another robot than to its own.
struct WrongSide {
  static constexpr FindingKind kind = FindingKind::cellSides;
  std::string end, robot, other;
  double distance = 0, otherDistance = 0;
  bool atStart = true;  ///< of the cut, or at its end
};
/// Where the cell's home lies, and so what the blade does there and on the way from it, is not known.
struct HomeUnknown {
  static constexpr FindingKind kind = FindingKind::cell;
  std::string robots;  ///< whose kinematics are not known
};
/// A grip that is off would move the cut by more than the tolerance, or lets the blade snap.
struct GripErrors {
  static constexpr FindingKind kind = FindingKind::gripErrors;
  double moved = 0;             ///< mm; infinite where the blade snaps, or could not be followed
  double error = 0, angle = 0;  ///< mm and rad that the grip is off
  double tolerance = 0;
  bool snaps = false;
};
/// A grip that is off may take up all the slack of the blade, and pulls it then.
struct PulledByGrips {
  static constexpr FindingKind kind = FindingKind::gripErrors;
  double slack = 0, error = 0;  ///< mm, that the blade has, and that the grip is off
  double stress = 0;            ///< N/mm² in the blade, if neither robot nor grip gives way
};
/// A shape that is held does not stay so where a grip is off.
struct HeldByLittle {
  static constexpr FindingKind kind = FindingKind::gripErrors;
  double barrier = 0;           ///< N mm that then bring the blade into another shape; 0 where it snaps
  double least = 0;             ///< N mm that count as more than a touch
  double error = 0, angle = 0;  ///< mm and rad that the grip is off
  double distance = 0;          ///< mm to the other shape, the grips being where they should
};
/// What lengths of the blade serve a row, where the one that is asked for does not, or none is asked for.
struct ServingLengths {
  static constexpr FindingKind kind = FindingKind::length;
  enum class Said {
    others,  ///< these serve, the one asked for does not
    none,    ///< none does
    taken,   ///< none was asked for: `best` was taken
    nearest  ///< none was asked for and none serves: `best` comes nearest
  } said = Said::others;
  double best = 0;  ///< mm
  double from = 0,
         to = 0;  ///< mm, the stretch of those that serve that holds it; where none does, of those tried
  /// mm, the least that was tried besides the one asked for where no length serves; that if none was.
  std::optional<double> leastClearance = std::nullopt;
  /// What was taken breaks limits between the stations, or beside them; or what is advised may, as what is
  /// does.
  bool atStationsAlone = false;
};
/// The widths of a kerf over speed and the blades, which their speeds follow from, do not come to rest.
struct KerfUnsettled {
  static constexpr FindingKind kind = FindingKind::kerf;
  int rounds = 0;     ///< tried
  double change = 0;  ///< mm of width, in the last of these
};
/// The surfaces of two neighbouring blocks do not meet at their boundary.
struct JointGap {
  static constexpr FindingKind kind = FindingKind::joint;
  std::string one, other;                     ///< the blocks' ids
  double gap = 0, limit = 0, atStations = 0;  ///< mm: the widest, what is allowed, the widest at a station
};
/// They meet with a kink.
struct JointKink {
  static constexpr FindingKind kind = FindingKind::joint;
  std::string one, other;
  double angle = 0, limit = 0, atStations = 0;  ///< rad
};
/// The surface comes to a boundary in one block and does not go on in the other one.
struct JointOpen {
  static constexpr FindingKind kind = FindingKind::joint;
  std::string one, other;
  int open = 0, places = 0;  ///< where it does not and where it does, of the places that were looked at
};
/// How they meet is not known there: the surface runs along the boundary, or its blades are not known.
struct JointUnknown {
  static constexpr FindingKind kind = FindingKind::joint;
  std::string one, other;
  int places = 0;
};
/// Blocks that the surface does not come through: nothing is cut of them.
struct BlocksMissed {
  static constexpr FindingKind kind = FindingKind::blocks;
  std::vector<std::string> blocks;  ///< ids
  int of = 0;                       ///< how many there are in all
};
/// Why nothing is cut of a block that the surface does come through.
struct BlockUncut {
  static constexpr FindingKind kind = FindingKind::blocks;
  std::string reason;
};
/// A cut that takes nothing of what the cuts before it left of its block: it is not made.
struct CutDropped {
  static constexpr FindingKind kind = FindingKind::cuts;
  std::string cut;                ///< its id
  double met = 0, tolerance = 0;  ///< mm of foam that it takes of what is left, at most, and at least
};
/// The edge that two cuts leave is not the one where the surfaces designed meet.
struct CreaseOff {
  static constexpr FindingKind kind = FindingKind::crease;
  std::string one, other;                    ///< the cuts' ids
  double most = 0, mean = 0, tolerance = 0;  ///< mm
  double lacking = 0;                        ///< mm of the edge designed that the cuts do not have
};
/// Where the blade of one cut goes on beyond its own surface it takes foam away that bounds another one.
struct TakesSurface {
  static constexpr FindingKind kind = FindingKind::crease;
  std::string cut, of;              ///< the cuts' ids
  double depth = 0, tolerance = 0;  ///< mm
};
/// What is left of a block could not be made a solid.
struct PartUnknown {
  static constexpr FindingKind kind = FindingKind::part;
  std::string reason;  ///< a clause
};
/// What is left of a block is not one piece.
struct PiecesLeft {
  static constexpr FindingKind kind = FindingKind::part;
  int pieces = 0;
};
/// A robot cannot hold its end of the blade at the place, or, without one, at home as the program begins.
struct HomeOutOfReach {
  static constexpr FindingKind kind = FindingKind::cell;
  std::string end, robot;
  double distance = 0, reach = 0;  ///< mm, of the wrist's centre from the middle of axis 2
};
/// No program is written, because of so many errors, or it is marked.
struct ProgramDespiteErrors {
  static constexpr FindingKind kind = FindingKind::program;
  int errors = 0;
  bool written = false;
};
/// What the check of a program says, in its words.
struct ProgramBreach {
  static constexpr FindingKind kind = FindingKind::programCheck;
  std::string rule;  ///< "rapid-rule-13"
  std::string place, text;
};
/// Files of different runs, or that nothing proves to be of one.
struct RunMismatch {
  static constexpr FindingKind kind = FindingKind::run;
  enum class What {
    missing,
    unreadable,  ///< `text` says why
    noFingerprint,
    changedModule,  ///< of the run, edited since
    moduleOfOther,  ///< `other` is its run, empty if it names none
    otherFile,
    strayModule,  ///< of the run `other`, not named by the report
    noProgramHere,
    reportNamesNoRun,
    reportMissing,
    reportDamaged  ///< or of another program
  };
  What what = What::missing;
  std::string file, run = {}, other = {}, text = {};
};

using Cause = std::variant<
    UnmetConditions, UnsettledFit, HeldBackFit, Overbent, TooTight, ManyInflections, WouldSnap, LowMargin,
    SnapsInWeight, MovedByWeight, BentSideways, WeightElsewhere, UnknownInWeight, WouldTwist, GripTooNear,
    NearBottom, SteepAngle, UnevenSpeed, EndsSwing, GapInRow, TooFar, Uncovered, OutsideBlocks, BladeCrosses,
    ToldBlades, TargetsCrowd, LeadGrown, OtherShape, NoWay, SnapsOnTheWay, ArrivesOtherwise, LostOnTheWay,
    TooFarOnTheWay, OffTheSurfaceShown, TooFastOnTheWay, SkinOff, ServingLengths, GripErrors, PulledByGrips,
    HeldByLittle, SectionMissing, SectionPoint, SectionShort, SectionBranches, SectionClosed, SectionBridged,
    SectionExtended, SectionBorder, SectionUnfit, SectionRough, SectionDiffers, LargestFace, NearestFace,
    FacesLeftOut, TravelAcross, PlanesNotTurned, ChosenDirection, LeftOutOfFile, Healed, ChangedSource,
    OddSize, EarlierDesign, JointGap, JointKink, JointOpen, JointUnknown, KerfUnsettled, BlocksMissed,
    BlockUncut, CutDropped, CreaseOff, TakesSurface, PartUnknown, PiecesLeft, UnreadableCell, WrongSide,
    HomeUnknown, HomeOutOfReach, ProgramDespiteErrors, ProgramBreach, RunMismatch>;

/// Stations of a row by their index: from first to last, `count` of them concerned, the worst among them.
struct StationRange {
  int first = 0, last = 0, worst = 0, count = 1;
  static StationRange of(int index) { return {index, index, index, 1}; }
  bool operator==(const StationRange&) const = default;
};

/// Where a finding is: what the window needs to select and frame it.
struct Place {
  std::optional<StationRange> stations = std::nullopt;
  std::optional<Eigen::Vector3d> point = std::nullopt;  ///< in the file's frame, mm
  std::string block = {};  ///< its id, where there are several; empty for what concerns them all
  std::string cut = {};    ///< its id, where a block has several; empty for what concerns all of these
};

/// One finding of a check, as data; `bw/words/findings.h` says it in words.
struct Finding {
  Severity severity = Severity::info;
  Cause cause;
  Place where = {};
  Remedies remedies = {};

  FindingKind kind() const;
};

using Findings = std::vector<Finding>;

/// True if any of `findings` is an error.
bool hasErrors(const Findings& findings);

/// True if any of `findings` says that a limit is exceeded: an error of any kind, or a warning about a limit
/// that the job or the blade states: deviation (tolerance), clearance, floor or stability (the blade would
/// not keep its shape), motion (what it does between stations is not known), joint (how blocks meet) or
/// crease (how cuts of one do). Warnings by rules of thumb (angle, speed, inflections, …) do not count, nor
/// does that a round blade may leave its plane, which hangs on how the grips hold it.
bool exceedsLimit(const Findings& findings);

/// True where a finding says that the blade snaps once a grip is off.
bool isSnapByGrip(const Finding& finding);

}  // namespace bw
