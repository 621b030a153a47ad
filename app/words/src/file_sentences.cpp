// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What is said of surfaces, sections, files and programs.

#include <cmath>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "sentences.h"

namespace bw::words {

std::string areaText(double mm2) {
  return mm2 >= 1e4 ? shortText(mm2 * 1e-6) + " m²" : shortText(mm2) + " mm²";
}

namespace {

/// "face 3 (\"Roof\")".
std::string faceText(const FaceName& face) {
  return "face " + std::to_string(face.index) + (face.name.empty() ? "" : " (\"" + face.name + "\")");
}

std::string figures(const ChosenDirection::Trial& trial) {
  if (trial.failed) return "no sweep";
  return "a cutting angle of up to " + fixedText(toDegrees(trial.angle), 1) + "°, sections met within " +
         shortText(trial.deviation) + " mm, " + std::to_string(trial.unusable) + " of " +
         std::to_string(trial.stations) + " stations unusable" +
         (trial.unrested > 0 ? ", the blade not at rest at " + std::to_string(trial.unrested) : "");
}

const char* const kAnew = "; write the results anew";

}  // namespace

std::string Sentences::operator()(const SectionMissing&) const {
  return leftOut("plane does not meet the target inside the block",
                 "planes do not meet the target inside the block");
}

std::string Sentences::operator()(const SectionPoint&) const {
  return leftOut("plane meets the target only in a point", "planes meet the target only in points");
}

std::string Sentences::operator()(const SectionShort& cause) const {
  const std::string rest = shortText(cause.length) + " mm long (less than " + shortText(cause.least) +
                           " mm), too short to hold a blade to";
  return leftOut("section is only " + rest, "sections are, the shortest, only " + rest);
}

namespace {

/// Where a curve leaves the block and comes back, and what block would hold all of it.
std::string leaving(const SectionBranches& cause) {
  const auto way = [](double by, const char* face, const char* place) {
    return std::string("through the block's ") + face + " and comes back: one that reaches " +
           shortText(std::ceil(by)) + " mm farther " + place;
  };
  if (!(cause.above > 0) && !(cause.below > 0)) return "";
  const bool both = cause.above > 0 && cause.below > 0;
  return "; one of them goes out " +
         (both ? way(cause.above, "top", "up") + ", and " + shortText(std::ceil(cause.below)) +
                     " mm farther down"
          : cause.above > 0 ? way(cause.above, "top", "up")
                            : way(cause.below, "bottom", "down")) +
         " holds it in one";
}

}  // namespace

std::string Sentences::operator()(const SectionBranches& cause) const {
  const bool same = cause.least == cause.most;
  const std::string rest = (same ? "" : std::to_string(cause.least) + " to ") + std::to_string(cause.most) +
                           " separate curves" + (same && !single() ? " each" : "") + leaving(cause) +
                           "; place the block so that only one of them lies in it, choose "
                           "another direction or fewer faces (a gap between two is crossed where a surface "
                           "leads across it, or where each side, bent on, comes to the other within 1 % of "
                           "its width; sewing with a tolerance as wide as the gap may close others)";
  return leftOut("plane cuts the target in " + rest, "planes cut the target in " + rest);
}

std::string Sentences::operator()(const SectionClosed&) const {
  const std::string rest = ", which no blade can follow; choose one side of the solid";
  return leftOut("plane cuts the target in a closed curve" + rest,
                 "planes cut the target in closed curves" + rest);
}

std::string Sentences::operator()(const SectionBridged& cause) const {
  return at() + "the target has a hole, a notch or a gap there, of up to " + shortText(cause.width) +
         " mm; the blade crosses it on the surface continued";
}

std::string Sentences::operator()(const SectionExtended& cause) const {
  return at() + "the border of the target steps back or runs to a point there; the blade goes on by up to " +
         shortText(cause.length) + " mm on the surface continued";
}

std::string Sentences::operator()(const SectionBorder&) const {
  return rangeText(*finding.where.stations) +
         ": a border of the target could not be matched with the section";
}

std::string Sentences::operator()(const SectionUnfit& cause) const {
  if (finding.severity == Severity::info) return rangeText(*finding.where.stations) + ": " + cause.why;
  return rangeText(*finding.where.stations) + (single() ? " is" : " are") + " left out: " + cause.why;
}

std::string Sentences::operator()(const SectionRough& cause) const {
  return at() + "the section is so rough that its spline keeps within " + shortText(cause.distance) +
         " mm of it only";
}

std::string Sentences::operator()(const SectionDiffers& cause) const {
  const auto curves = [](int n) { return n == 1 ? std::string("1 curve") : std::to_string(n) + " curves"; };
  return at() + "OpenCASCADE finds " +
         (cause.traced != cause.kernel
              ? curves(cause.kernel) + " where tracing finds " + std::to_string(cause.traced)
          : cause.distance > 0
              ? "the section up to " + shortText(cause.distance) + " mm from where it was traced"
              : std::string("as many curves as tracing, of other lengths")) +
         (cause.taken ? "; what it finds is taken" : "; what was traced is longer and stays");
}

std::string Sentences::operator()(const LargestFace& cause) const {
  const std::string text =
      faceText(cause.face) + " of " + std::to_string(cause.faces) + " is cut, the largest";
  const std::string which = cause.face.type + ", " + areaText(cause.face.area);
  const std::string left =
      finding.severity == Severity::info
          ? ""
          : "; " + areaText(cause.left) + " of the sheet " +
                (cause.faces == 2 ? "is in the other, which is" : "are in the others, which are") +
                " not cut: choose all faces, or those that are wanted";
  if (!cause.larger) return text + ": " + which + left;
  return text + " that is neither plane, cylinder nor cone: " + which + "; " + faceText(*cause.larger) +
         ", a " + cause.larger->type + " of " + areaText(cause.larger->area) + ", is larger" + left;
}

std::string Sentences::operator()(const NearestFace& cause) const {
  return faceText(cause.face) + " is cut, the nearest to [" + shortText(cause.point.x()) + ", " +
         shortText(cause.point.y()) + ", " + shortText(cause.point.z()) + "], " + shortText(cause.distance) +
         " mm away";
}

std::string Sentences::operator()(const FacesLeftOut& cause) const {
  return (cause.count == 1 ? "1 face is" : std::to_string(cause.count) + " faces are") +
         " left out, narrower than " + shortText(cause.width) + " mm or damaged";
}

std::string Sentences::operator()(const TravelAcross&) const {
  return "the blade travels across the surface rather than along it; a direction in the plane of the block "
         "is "
         "usual";
}

std::string Sentences::operator()(const PlanesNotTurned& cause) const {
  const auto angle = [](double turn) { return fixedText(toDegrees(turn), 1) + "°"; };
  return "the planes of the blades are parallel, because the cut has a direction of its own; its key blades "
         "are turned by " +
         angle(cause.least) + " to " + angle(cause.most) +
         ": choose the automatic direction to have the planes turn with them";
}

std::string Sentences::operator()(const ChosenDirection& cause) const {
  return "the blade goes along the " + cause.chosen.name + " (" + figures(cause.chosen) +
         ") rather than the " + cause.usual.name + " (" + figures(cause.usual) + ")";
}

std::string Sentences::operator()(const LeftOutOfFile& cause) const { return cause.text; }

std::string Sentences::operator()(const Healed& cause) const { return cause.text; }

std::string Sentences::operator()(const ChangedSource& cause) const {
  const std::string sizes =
      cause.bytesNow == cause.bytesThen
          ? "as many bytes, others"
          : std::to_string(cause.bytesThen) + " bytes then, " + std::to_string(cause.bytesNow) + " now";
  return "the CAD file " + cause.file + " has changed since the design was saved (" + sizes +
         "); look at the result, then save the design again";
}

std::string Sentences::operator()(const OddSize& cause) const {
  return "the surface measures " + shortText(cause.size.x()) + " × " + shortText(cause.size.y()) + " × " +
         shortText(cause.size.z()) + " mm, its file being read in " + cause.readAs +
         ": if that is not the unit meant, tell which (" +
         (reader == Reader::commandLine ? "unit" : "Input ▸ Read as") + ")";
}

std::string Sentences::operator()(const EarlierDesign& cause) const {
  return cause.file + " is a design of version " + std::to_string(cause.version) +
         " and was taken over as it is; this program writes version " + std::to_string(cause.present);
}

std::string Sentences::operator()(const UnreadableCell& cause) const { return cause.why; }

/// The cell in which robots hold the blade, or what else is to be tried.
static std::string otherCellText(const Finding& finding, Reader reader) {
  const OtherCell* cell = remedyOf<OtherCell>(finding.remedies);
  if (!cell)
    return std::string("turn the block (") + (reader == Reader::window ? "Turned by" : "\"turn_deg\"") +
           ") or the cutting direction, or take a cell whose work object stands otherwise";
  return "take the cell " +
         (reader == Reader::window ? cell->title : "\"" + cell->name + "\" (" + cell->title + ")") +
         ", in which robots hold the blade all along";
}

std::string Sentences::operator()(const WrongSide& cause) const {
  return "the " + cause.end + " end of the blade lies " + fixedText(cause.distance, 0) +
         " mm from its robot " + cause.robot + " but " + fixedText(cause.otherDistance, 0) + " mm from " +
         cause.other + "; " + otherCellText(finding, reader);
}

std::string Sentences::operator()(const HomeUnknown& cause) const {
  return "how the blade lies at the cell's home, and on the way from there to the block, is not known: "
         "resources/robots has no kinematics of " +
         cause.robots + "; add them, or see to it on the cell";
}

std::string Sentences::operator()(const HomeOutOfReach& cause) const {
  return cause.robot + " cannot hold the " + cause.end + " end of the blade " +
         (finding.where.point ? "at a target of the program: "
                              : "at the cell's home as the program begins: ") +
         (cause.distance > cause.reach
              ? "its wrist would be " + fixedText(cause.distance, 0) + " mm from its shoulder (reach " +
                    fixedText(cause.reach, 0) + " mm)"
              : "no joint angles within its ranges turn its grip so") +
         "; " + otherCellText(finding, reader);
}

std::string Sentences::operator()(const ProgramDespiteErrors& cause) const {
  const std::string errors = cause.errors == 1 ? "an error" : std::to_string(cause.errors) + " errors";
  if (cause.written)
    return "the RAPID program is written although the design has " + errors +
           "; its modules are marked as not safe to run";
  return "no RAPID program is written, because the design has " + errors +
         (cause.errors == 1 ? "; mend it" : "; mend them") +
         (reader == Reader::commandLine
              ? ", or have it written and marked as not safe to run with --despite-errors"
              : "");
}

std::string Sentences::operator()(const ProgramBreach& cause) const { return cause.text; }

std::string Sentences::operator()(const RunMismatch& cause) const {
  using What = RunMismatch::What;
  const std::string report = "report.json of run " + cause.run;
  switch (cause.what) {
    case What::missing:
      return report + " names the file, but it is missing" + kAnew;
    case What::unreadable:
      return cause.text + kAnew;
    case What::reportDamaged:
      return std::string("it is damaged, or of another program") + kAnew;
    case What::noFingerprint:
      return report + " lists the file without its fingerprint" + kAnew;
    case What::changedModule:
      return "the module was changed since run " + cause.run + " wrote it";
    case What::moduleOfOther:
      return "the module is of " + (cause.other.empty() ? "no run that it names" : "run " + cause.other) +
             ", but report.json is of run " + cause.run + kAnew;
    case What::otherFile:
      return "the file is of another run than report.json (run " + cause.run + ") or was changed since" +
             kAnew;
    case What::strayModule:
      return "the module is of " + (cause.other.empty() ? "no run that it names" : "run " + cause.other) +
             ", and " + report + " does not name it; remove it, or write the results anew";
    case What::noProgramHere:
      return report + " names no program here" + kAnew;
    case What::reportNamesNoRun:
      return std::string("it names no run, so that nothing tells whether the files are of one run") + kAnew;
    case What::reportMissing:
      return std::string("it is missing, so that nothing tells whether the files beside it are of one run") +
             kAnew;
  }
  return {};
}

}  // namespace bw::words
