// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/report_page.h"

#include <algorithm>
#include <map>

#include "block_layout.h"
#include "bw/core/base/units.h"
#include "bw/core/blade/cutting_limits.h"
#include "bw/core/design/program_formats.h"
#include "bw/core/text/base64.h"
#include "bw/core/text/number_text.h"
#include "bw/core/text/printable.h"
#include "bw/pipeline/produce.h"
#include "bw/pipeline/requests.h"
#include "bw/robotio/dialects.h"
#include "make_files.h"

namespace bw::pipeline {

namespace {

using Mark = drawings::ReportTable::Mark;

std::string mm(double value) { return shortText(value, 3) + " mm"; }
std::string degrees(double radians) { return fixedText(toDegrees(radians), 1) + "°"; }
std::string position(const Eigen::Vector3d& v) {
  return fixedText(v.x(), 1) + ", " + fixedText(v.y(), 1) + ", " + fixedText(v.z(), 1) + " mm";
}
std::string direction(const Eigen::Vector3d& v) {
  return fixedText(v.x(), 4) + ", " + fixedText(v.y(), 4) + ", " + fixedText(v.z(), 4);
}

/// Builds the report table by table.
class Page {
 public:
  void heading(const std::string& text) { parts_.emplace_back(drawings::ReportHeading{text}); }
  void paragraph(const std::string& text) { parts_.emplace_back(drawings::ReportParagraph{text}); }
  void picture(const ReportPicture& picture) { parts_.emplace_back(picture); }
  void begin(const std::vector<std::string>& columns) {
    parts_.emplace_back(drawings::ReportTable{columns});
    table_ = &std::get<drawings::ReportTable>(parts_.back());
  }
  void row(const std::vector<std::string>& cells, Mark mark = Mark::none) {
    table_->rows.push_back({cells, mark});
  }
  /// A number beside its limit, told in words and colour.
  void checked(const std::string& name, const std::string& value, const std::string& limit, bool holds) {
    row({name, value, limit, holds ? "✓ holds" : "✗ exceeded"}, holds ? Mark::good : Mark::bad);
  }
  std::vector<drawings::ReportPart> take() { return std::move(parts_); }

 private:
  std::vector<drawings::ReportPart> parts_;
  drawings::ReportTable* table_ = nullptr;
};

std::string edgeOf(const Evaluation& e, const BlockEvaluation& part, const Crease& crease) {
  return (e.blocks.size() > 1 ? part.id + ": e" : "E") + std::string("dge of ") + part.cuts[crease.first].id +
         " and " + part.cuts[crease.second].id;
}

std::string verdict(const Evaluation& e) {
  if (!e.complete()) return "There is no result: the findings tell why.";
  const Findings findings = e.findings();
  if (hasErrors(findings))
    return "This surface cannot be cut as designed: the findings marked as errors tell why.";
  if (exceedsLimit(findings)) return "A stated limit is exceeded: see the table of limits and the findings.";
  return "All stated limits hold.";
}

/// How many stations rest in which way: "31 certain, 2 held, 0 lost".
std::string restText(const std::map<Rest, int>& stations) {
  std::string text;
  for (const auto& [rest, count] : stations)
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + restName(rest);
  return text;
}

void limits(Page& page, const Evaluation& e) {
  const Overall all = overallOf(e);
  const SweepSummary& s = all.summary;
  const Design& design = e.design;
  double clearance = 1e300, margin = 1e300, uncoveredLimit = 1e300;
  std::optional<double> lowest;
  std::map<Rest, int> rests;
  for (const Strip& strip : stripsOf(e)) {
    uncoveredLimit = std::min(uncoveredLimit, strip.cut->coverage.value->limit);
    for (const Rest rest : strip.cut->rest.value->stations) ++rests[rest];
    for (const StationCheck& station : strip.cut->check.value->stations) {
      clearance = std::min(clearance, station.clearance);
      margin = std::min(margin, station.stabilityMargin);
      if (strip.cut->check.request.floor) lowest = std::min(lowest.value_or(1e300), station.aboveBottom);
    }
  }
  // Between the stations, on the way in and on the way out it may come lower.
  for (const Finding& finding : e.findings())
    if (const auto* low = std::get_if<NearBottom>(&finding.cause); low && lowest)
      lowest = std::min(*lowest, low->height);
  page.heading("Limits");
  page.begin({"Number", "Measured", "Limit", ""});
  page.checked("Largest deviation", mm(s.deviationMax), "at most " + mm(design.process.tolerance),
               s.deviationMax <= design.process.tolerance);
  const auto ofPrograms = [&](const char* what, const std::optional<double>& value, double limit) {
    page.checked(what, value ? mm(*value) : "not known", "at most " + mm(limit), value && *value <= limit);
  };
  ofPrograms("Largest deviation of what the program cuts", all.programMax, design.process.tolerance);
  ofPrograms("Largest distance of that from the surface shown", all.fromShown,
             design.process.motionTolerance);
  page.checked("Farthest that the target reaches beyond the cut surface, or lies off it uncut",
               mm(all.uncovered), "at most " + mm(uncoveredLimit), all.uncovered <= uncoveredLimit);
  if (!e.uncut.empty())
    page.checked("Blocks that the surface meets and no blade can cut", std::to_string(e.uncut.size()), "none",
                 false);
  if (e.joints.value && !e.joints.value->joints.empty()) {
    const Joints& joints = *e.joints.value;
    page.checked("Widest gap between neighbouring blocks at their boundary", mm(joints.gapMax()),
                 "at most " + mm(design.process.jointGap), joints.gapMax() <= design.process.jointGap);
    page.checked("Sharpest kink there", fixedText(toDegrees(joints.kinkMax()), 2) + "°",
                 "at most " + fixedText(design.process.jointKink, 2) + "°",
                 toDegrees(joints.kinkMax()) <= design.process.jointKink);
  }
  for (const BlockEvaluation& part : e.blocks) {
    if (!part.together.value) continue;
    for (const Crease& crease : part.together.value->creases)
      page.checked(edgeOf(e, part, crease) + ", off where the surfaces designed meet", mm(crease.offMax),
                   "at most " + mm(design.process.tolerance), crease.offMax <= design.process.tolerance);
  }
  page.checked("Shape of the blade at the stations", restText(rests), "certain or held",
               !rests.contains(Rest::lost) && !rests.contains(Rest::unknown));
  page.checked("Smallest radius of the blade", s.minRadius > 0 ? mm(s.minRadius) : "straight",
               "at least " + mm(design.blade.minRadius()),
               s.minRadius <= 0 || s.minRadius >= design.blade.minRadius());
  page.checked("Smallest distance of a grip from the block", mm(clearance),
               "at least " + mm(design.process.clearance), clearance >= design.process.clearance);
  if (lowest)
    page.checked("Lowest point of the blade over the face that its block lies on", mm(*lowest),
                 "at least " + mm(design.process.floor), *lowest >= design.process.floor);
  page.checked("Smallest margin against snapping", fixedText(margin, 2),
               "at least " + fixedText(design.process.margin, 2), margin >= design.process.margin);
  page.heading("Numbers");
  page.begin({"Number", "Value"});
  page.row({"Mean deviation", mm(s.deviationMean)});
  page.row({"Root mean square of the deviation", mm(s.deviationRms)});
  page.row({"Surface shown within tolerance", shareText(s.withinTolerance)});
  page.row({std::string("Target in the block that has cut surface over it") +
                (all.lost > 0 ? ", did the blade keep its shape" : ""),
            shareText(all.covered)});
  if (all.outside > 0) page.row({"Surface that lies in no block", shortText(100 * all.outside, 3) + " %"});
  page.row({"Steepest cutting angle (the blade drags above " +
                fixedText(toDegrees(cuttingAngleLimit(e.design.blade)), 0) + "°)",
            degrees(s.angleMax)});
  page.row({"Mean cutting angle", degrees(s.angleMean)});
  page.row({"Slowest over fastest point of the blade", fixedText(s.speedRatioMin, 2)});
  for (const BlockEvaluation& part : e.blocks) {
    if (!part.together.value) continue;
    for (const Crease& crease : part.together.value->creases)
      page.row({edgeOf(e, part, crease), mm(crease.length) + " long, " + mm(crease.offMean) +
                                             " on the mean from where the surfaces designed meet"});
  }
  page.row({"Cutting time, leads included", fixedText(all.cuttingTime, 0) + " s"});
  page.row({"Time with entry and exit, too", fixedText(all.runTime, 0) + " s"});
}

/// What holds the grips of blades.
std::string holdText(const FitRequest& fit) {
  switch (fit.extend) {
    case Extension::none:
      break;
    case Extension::surface:
      return "the surface beyond the block as far as it goes, then straight on";
    case Extension::straight:
      return "the tangents at the ends of the section";
    case Extension::curvature:
      return "the circles that bend as the section does at its ends";
  }
  std::vector<std::string> kept;
  if (fit.fitEndpoints) kept.push_back("ends");
  if (fit.fitTangents) kept.push_back("tangents");
  if (fit.fitLength != FitOptions::Length::free) kept.push_back("length");
  const std::string nearest = "the blade that lies nearest to it, continued";
  if (kept.empty()) return "the section alone: " + nearest;
  std::string text = kept.front();
  for (std::size_t i = 1; i < kept.size(); ++i) text += (i + 1 < kept.size() ? ", " : " and ") + kept[i];
  return "the " + text + " of the section, and else " + nearest;
}

/// A row for each way in which blades are held.
void holds(Page& page, const Evaluation& e) {
  std::map<std::string, std::string> ways;
  for (const Strip& strip : stripsOf(e)) {
    std::string& cuts = ways[holdText(strip.cut->sweep.value->request)];
    const std::string title = stripTitle(e, strip);  // "column-1: "
    if (!title.empty()) cuts += (cuts.empty() ? "" : ", ") + title.substr(0, title.size() - 2);
  }
  for (const auto& [way, cuts] : ways)
    page.row({(ways.size() > 1 ? cuts + ": " : "") + "What holds the grips", way});
}

void parameters(Page& page, const Evaluation& e) {
  const Design& design = e.design;
  page.heading("Parameters");
  page.begin({"Parameter", "Value"});
  for (const Source& source : design.sources) {
    const std::string of = design.sources.size() > 1 ? source.id + ": " : "";
    if (source.surface)
      page.row({of + "Surface", "designed: " + shapeText(*source.surface)});
    else
      page.row({of + "CAD file", source.path.filename().string()});
  }
  for (const Variable& variable : design.variables)
    page.row({"Variable " + variable.name,
              shortText(variable.value, 6) + (variable.unit.empty() ? "" : " " + variable.unit)});
  if (e.cut().target.value) {
    std::string faces;
    for (const int face : e.cut().target.value->faces())
      faces += (faces.empty() ? "" : ", ") + std::to_string(face);
    page.row({"Faces (counted from 0)", faces});
    page.row({"Area of the target", shortText(e.cut().target.value->area() * 1e-6, 4) + " m²"});
  }
  page.row({"Blade", design.blade.title.empty() ? design.blade.name : design.blade.title});
  std::map<double, std::vector<std::string>> lengths;
  for (const BlockEvaluation& part : e.blocks)
    for (const CutEvaluation& cut : part.cuts)
      lengths[bladeOf(design, *std::ranges::find(design.cuts, cut.id, &Cut::id)).length].push_back(
          (e.blocks.size() > 1 ? part.id + " " : "") + cut.id);
  for (const auto& [length, cuts] : lengths) {
    std::string of;
    for (const std::string& cut : cuts) of += (of.empty() ? " of " : ", ") + cut;
    page.row({"Length of the blade between the grips" + (lengths.size() > 1 ? of : ""),
              shortText(length, 6) + " mm"});
  }
  page.row({"Smallest radius that the blade bears", mm(design.blade.minRadius())});
  for (const BlockEvaluation& part : e.blocks) {
    const CutEvaluation& cut = part.cuts.front();
    if (!cut.setup) continue;
    const Box block = placedBlock(design, cut);
    const std::string of = e.blocks.size() > 1 ? part.id + ": " : "";
    page.row({of + "Block", shortText(block.size.x(), 5) + " × " + shortText(block.size.y(), 5) + " × " +
                                shortText(block.size.z(), 5) + " mm"});
    page.row({of + "Corner of the block, in the file's frame", position(block.frame.origin)});
    page.row({of + "Edges of the block: x", direction(block.frame.x)});
    page.row({of + "Edges of the block: y", direction(block.frame.y)});
    for (const CutEvaluation& each : part.cuts) {
      if (!each.setup) continue;
      const std::string which = part.cuts.size() > 1 ? of + each.id + ": " : of;
      const std::string lies = lyingText(*std::ranges::find(design.cuts, each.id, &Cut::id));
      if (!lies.empty()) page.row({which + "The block lies with", lies});
      const KeptSide kept = std::ranges::find(design.cuts, each.id, &Cut::id)->keep;
      page.row({which + "Foam that stays, seen from the surface", kKeptSides[std::size_t(kept)]});
      if (const double offset = std::ranges::find(design.cuts, each.id, &Cut::id)->offset; offset > 0)
        page.row({which + "Stands back from the surface by", mm(offset)});
      page.row({which + "Cutting direction", direction(each.setup->planes.direction())});
      if (const std::string turns = turningText(each.setup->planes, each.block()); !turns.empty())
        page.row({which + "The plane of the blade turns as it travels", turns});
    }
    if (part.part.value && part.part.value->solid) {
      const geometry::Part& solid = *part.part.value->solid;
      constexpr double kLitre = 1e6;  // mm³
      page.row({of + "What is left of the block",
                shortText(solid.volume() / kLitre, 4) + " of " + shortText(solid.blockVolume() / kLitre, 4) +
                    " litres" +
                    (solid.pieces() == 1 ? "" : ", " + std::to_string(solid.pieces()) + " pieces")});
    }
  }
  for (const Strip& strip : stripsOf(e))
    page.row({stripTitle(e, strip) + "Stations",
              std::to_string(strip.cut->sweep.value->poses.size()) +
                  (strip.cut->count.value ? " (as many as the tolerance asks for)" : "")});
  page.row({"Cutting speed of the fastest point", shortText(design.process.cuttingSpeed, 4) + " mm/s"});
  page.row({"Lead before and after the block", mm(design.process.lead)});
  page.row({"Tolerance", mm(design.process.tolerance)});
  if (const KerfTable& kerf = design.process.kerfTable; !kerf.empty()) {
    std::string widths;
    for (const KerfAt& entry : kerf)
      widths += mm(entry.width) + " at " + shortText(entry.speed, 4) + " mm/s, ";
    page.row({"Kerf", widths + "in between as the speed there (programs carry the middle of the blade)"});
  } else if (design.process.kerf > 0)
    page.row({"Kerf", mm(design.process.kerf) + " (programs carry the middle of the blade)"});
  if (e.blocks.size() > 1 && design.process.join == Join::tangentPlanes)
    page.row({"Where blocks go on in each other", "blades have the ends and the tangents of their sections"});
  page.row({"Clearance", mm(design.process.clearance)});
  page.row({"Floor: the blade stays above the face that its block lies on by", mm(design.process.floor)});
  holds(page, e);
  page.row({"Weight of the blade", !design.process.weight ? "left out"
                                   : design.process.up
                                       ? "counted, up is " + direction(*design.process.up)
                                       : "counted, up is the way to the top of the block as it lies"});
  page.row({"A grip may be off by",
            mm(design.process.gripError) + " and turned by " + shortText(design.process.gripAngle, 4) + "°"});
  page.row({"Stability margin of the blade", fixedText(design.process.margin, 2)});
  page.row({"Robot cell", design.output.cell});
}

void findings(Page& page, const Evaluation& e) {
  page.heading("Findings");
  const Findings all = e.findings();
  if (all.empty()) return page.paragraph("None.");
  page.begin({"", "Where", "What"});
  for (const Finding& finding : all)
    page.row({severityName(finding.severity), words::placeText(finding),
              words::sentence(finding, words::Reader::window)});
}

void stations(Page& page, const Evaluation& e, const Strip& strip) {
  const std::string of = stripTitle(e, strip);
  page.heading(of.empty() ? "Stations" : "Stations of " + of.substr(0, of.size() - 2));
  page.begin(
      {"Station", "Travel", "Section", "Distance", "Radius", "Angle", "Grip to block", "Margin", "Shape"});
  const CutResult result = *strip.cut->result();
  for (std::size_t i = 0; i < result.size(); ++i) {
    const StationView s = result.station(i);
    const double radius = s.pose.minRadius();
    page.row({std::to_string(s.pose.index + 1), fixedText(s.pose.travel, 1),
              fixedText(s.fit.target.length(), 1), fixedText(s.fit.fit.hausdorff, 3),
              radius > 0 ? fixedText(radius, 0) : "straight", degrees(s.check.angleMax),
              fixedText(s.check.clearance, 0), fixedText(s.check.stabilityMargin, 2), restName(s.rest)});
  }
  page.paragraph(
      "Lengths in mm. Distance: between the section of the target and its elastica (Hausdorff). Margin: 1 "
      "for "
      "a straight blade, 0 where it is about to snap. Shape: certain where no other one rests between the "
      "same "
      "grips or this is clearly the lowest, held where it is another that the way in leads to, lost "
      "otherwise.");
}

/// Files that a report stands beside, and what they are.
struct Kind {
  std::vector<std::string> names;  ///< within the folder
  const char* text;
};

void files(Page& page, const std::vector<std::filesystem::path>& made) {
  static const Kind kKinds[] = {
      {{"surface.step", "surface.iges"},
       "The cut surface as one smooth face, mm, in the frame of the CAD file"},
      {{"mesh.obj", "mesh.stl"}, "The same as triangles"},
      {{"parts.step"}, "What is left of the blocks, as solids"},
      {{"blocks.step"}, "The blocks before they are cut, as solids"},
      {{"curves.step", "curves.dxf"},
       "The seams between blocks, the outlines of the cut surfaces and their creases, as curves"},
      {{"drawings.pdf"}, "A drawing of each block for the workshop: its size, and how it lies for each cut"},
      {{"cut-list.csv"}, "The blocks of foam to order, with volumes, waste and cutting times"},
      {{"stations.csv"}, "One row a station: where the blade's ends are, and the numbers of the table above"},
      {{"deviation.csv"}, "Every point of the map with its values"},
      {{"report.json", "sweep.json"}, "All numbers for scripts"}};
  const auto isThere = [&](const std::string& name) {
    // The report follows, and lists the others.
    return name == "report.json" || std::find(made.begin(), made.end(), name) != made.end();
  };
  page.heading("Files beside this report");
  page.begin({"File", "What it is"});
  for (const Kind& kind : kKinds) {
    std::string names;
    for (const std::string& name : kind.names)
      if (isThere(name)) names += (names.empty() ? "" : ", ") + name;
    if (!names.empty()) page.row({names, kind.text});
  }
  for (const robotio::Dialect& dialect : robotio::dialects()) {
    const std::string title = programFormat(dialect.word)->title;
    if (std::ranges::any_of(made, [&](const std::filesystem::path& file) {
          return *file.begin() == "programs" && robotio::dialectOfFile(file.string()) == &dialect;
        }))
      page.row({"programs/", dialect.check ? title + " programs, one folder a robot"
                                           : "The motion of the blade's ends as " + title});
  }
  if (isThere(kDesignFile))
    page.row({kDesignFile, "The design: opens in Bladewright, with all that can be changed"});
}

}  // namespace

std::string sizeText(std::uintmax_t bytes) {
  if (bytes < 1000) return std::to_string(bytes) + (bytes == 1 ? " byte" : " bytes");
  if (bytes < 1'000'000) return shortText(double(bytes) / 1e3, 3) + " kB";
  return shortText(double(bytes) / 1e6, 3) + " MB";
}

drawings::Report reportOf(const Evaluation& e, const std::vector<ReportPicture>& pictures,
                          const std::vector<std::filesystem::path>& made) {
  Page page;
  page.paragraph(verdict(e));
  page.paragraph("Made by Bladewright " BW_VERSION ".");
  for (const ReportPicture& picture : pictures) page.picture(picture);
  if (e.complete()) limits(page, e);
  findings(page, e);
  parameters(page, e);
  for (const Strip& strip : stripsOf(e)) stations(page, e, strip);
  files(page, made);
  return {e.design.name, page.take()};
}

namespace {

/// Text from outside as text in a page.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : printable(text)) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

/// The parts of a report as HTML.
struct Html {
  std::string operator()(const drawings::ReportHeading& heading) const {
    return "<h2>" + escaped(heading.text) + "</h2>\n";
  }
  std::string operator()(const drawings::ReportParagraph& paragraph) const {
    return "<p>" + escaped(paragraph.text) + "</p>\n";
  }
  std::string operator()(const drawings::ReportTable& table) const {
    std::string out = "<table>\n<tr>";
    for (const std::string& column : table.columns) out += "<th>" + escaped(column) + "</th>";
    out += "</tr>\n";
    for (const drawings::ReportTable::Row& row : table.rows) {
      out += "<tr>";
      for (std::size_t i = 0; i < row.cells.size(); ++i) {
        const bool marked = i + 1 == row.cells.size() && row.mark != Mark::none;
        out +=
            marked ? std::string("<td class=\"") + (row.mark == Mark::good ? "good" : "bad") + "\">" : "<td>";
        out += escaped(row.cells[i]) + "</td>";
      }
      out += "</tr>\n";
    }
    return out + "</table>\n";
  }
  std::string operator()(const ReportPicture& picture) const {
    // Both sides, so that the page stands as it will before its pictures are unpacked.
    constexpr int kWidth = 640;
    const int height = int(double(kWidth) * picture.height / std::max(picture.width, 1) + 0.5);
    return "<p><img src=\"data:image/png;base64," + toBase64(picture.png) + "\" alt=\"" +
           escaped(picture.title) + "\" width=\"" + std::to_string(kWidth) + "\" height=\"" +
           std::to_string(height) + "\"><br>" + escaped(picture.title) + "</p>\n";
  }
};

}  // namespace

std::string reportHtml(const drawings::Report& report) {
  const std::string name = escaped(report.title);
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + name +
      "</title>\n<style>body{font-family:Inter,'Noto Sans','DejaVu Sans',sans-serif;font-size:10pt;"
      "color:#22252a;max-width:900px;margin:24px auto}table{border-collapse:collapse;margin:8px 0;width:100%}"
      "td,th{border-bottom:1px solid #dadad6;padding:4px;text-align:left;font-variant-numeric:tabular-nums}"
      "th{background:#f1f1ee}.good{color:#2b8a3e}.bad{color:#c92a2a}h2{font-size:12pt;margin-top:24px}"
      "</style></head>\n<body>\n<h1>" +
      name + "</h1>\n";
  for (const drawings::ReportPart& part : report.parts) page += std::visit(Html(), part);
  return page + "</body></html>\n";
}

}  // namespace bw::pipeline
