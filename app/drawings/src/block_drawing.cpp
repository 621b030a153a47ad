// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/drawings/block_drawing.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "bw/core/base/units.h"
#include "bw/core/text/number_text.h"
#include "mark.h"
#include "pdf_pages.h"
#include "pose_picture.h"
#include "seen_lines.h"

namespace bw::drawings {

namespace {

constexpr double kLitre = 1e6;  // mm³

// The page, mm: a border, the title block along its foot, on the first page the views and a column of cuts.
constexpr double kBorder = 10;
constexpr double kFoot = 26;
constexpr double kCutsWidth = 100;
Rectangle sheetOfPage() { return {{kBorder, kBorder}, {Paper().width - kBorder, Paper().height - kBorder}}; }
constexpr double kAboveFoot = kBorder + kFoot;

// Around the views, mm: room for dimensions and for what they are called.
constexpr double kLeftOfViews = 5, kBetweenColumns = 14, kRightOfViews = 15;
constexpr double kAboveViews = 13, kBetweenRows = 14, kBelowViews = 10;
constexpr double kMarkLeg = 5;  // mm on the page

const Pen kVisible{0.35, 0, {}}, kHidden{0.18, 0.35, {2, 2}}, kBefore{0.18, 0.45, {7, 2, 1, 2, 1, 2}},
    kThin{0.15, 0, {}}, kBlades{0.1, 0.6, {}};

constexpr std::array<double, 3> kForbidden = {0.79, 0.16, 0.16};  // red, of what must not be done

/// The scales of a workshop: lengths of the foam over those on the page.
constexpr std::array<double, 19> kScales = {0.1, 0.2, 0.5, 1,  2,  2.5, 5,   10,  15,  20,
                                            25,  30,  40,  50, 75, 100, 200, 500, 1000};

std::string litres(double volume) {
  const double l = volume / kLitre;
  return (l < 1 ? shortText(l, 3) : fixedText(l, 1)) + " l";
}

/// To hundredths of a mm or a degree, however large.
std::string hundredths(double number) {
  constexpr int kDigits = 12;
  return shortText(std::round(100 * number) / 100 + 0.0, kDigits);
}
std::string hundredths(const Eigen::Vector3d& v) {
  return hundredths(v.x()) + ", " + hundredths(v.y()) + ", " + hundredths(v.z());
}
std::string millimetres(double length) { return shortText(std::round(100 * length) / 100, 7); }
std::string sizeText(const Eigen::Vector3d& size) {
  return millimetres(size.x()) + " \u00d7 " + millimetres(size.y()) + " \u00d7 " + millimetres(size.z()) +
         " mm";
}
std::string timeText(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 120) return std::to_string(whole) + " s";
  const std::string rest = std::to_string(whole % 60);
  return std::to_string(whole / 60) + ":" + (rest.size() < 2 ? "0" : "") + rest + " min";
}

/// How long the blade cuts, and is on its way altogether.
std::string timesText(double cutting, double run) {
  return timeText(cutting) + " of cutting, " + timeText(run) + " with entry and exit";
}

/// One view of a block: its lines, mm in the plane of the view.
struct DrawnView {
  View view;
  SeenLines lines;                         ///< of what is left
  std::vector<std::vector<Point>> blades;  ///< on the surfaces that are cut
  std::vector<std::vector<Point>> before;  ///< edges of the block before the cuts
  Rectangle bounds;                        ///< of the block
};

/// A block with all that is drawn of it; found for all blocks side by side.
struct PreparedBlock {
  Mark mark;
  std::array<DrawnView, 4> views;  ///< front, from the right, top, and from all three
  std::string seenFrom;            ///< the last
};
enum ViewIndex : std::size_t { kFront, kSide, kTop, kSpace };

std::vector<Polyline> edgesOf(const Eigen::Vector3d& size) {
  const std::array<Eigen::Vector3d, 8> corners = Box{Frame{}, size}.corners();
  std::vector<Polyline> edges;
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t k = 0; k < 3; ++k)
      if (const std::size_t b = a | (std::size_t(1) << k); b != a) edges.push_back({corners[a], corners[b]});
  return edges;
}

Polyline inBlock(const Box& block, const Polyline& line) {
  Polyline out;
  for (const Eigen::Vector3d& p : line) out.push_back(block.frame.toLocal(p));
  return out;
}

TriangleMesh inBlock(const Box& block, TriangleMesh mesh) {
  for (Eigen::Vector3d& p : mesh.points) p = block.frame.toLocal(p);
  for (Eigen::Vector3d& n : mesh.normals)
    n = {n.dot(block.frame.x), n.dot(block.frame.y), n.dot(block.frame.normal)};
  return mesh;
}

/// mm² of cut surface that is seen from a side: of triangles that do not lie on a face of the block.
double cutSeen(const TriangleMesh& mesh, const Eigen::Vector3d& size, const Eigen::Vector3d& toward) {
  const double slack = 1e-6 * size.norm();
  double area = 0;
  for (const std::array<int, 3>& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.points[std::size_t(t[0])], &b = mesh.points[std::size_t(t[1])],
                          &c = mesh.points[std::size_t(t[2])];
    bool onFace = false;
    for (int k = 0; k < 3; ++k)
      for (const double at : {0.0, size[k]})
        onFace = onFace || std::max({std::abs(a[k] - at), std::abs(b[k] - at), std::abs(c[k] - at)}) < slack;
    if (!onFace) area += std::max(0.0, 0.5 * (b - a).cross(c - a).dot(toward));
  }
  return area;
}

/// From which corner a block is looked at: in front, right and above, unless another shows more of its cuts.
Eigen::Vector3d bestSide(const Solid* part, const Eigen::Vector3d& size) {
  constexpr double kMore = 1.15;
  const Eigen::Vector3d usual = Eigen::Vector3d(0.5, -0.8, 0.5).normalized();
  if (!part) return usual;
  Eigen::Vector3d best = usual;
  double most = cutSeen(part->mesh(), size, best);
  for (const double z : {1.0, -1.0})
    for (const double y : {1.0, -1.0})
      for (const double x : {1.0, -1.0}) {
        const Eigen::Vector3d side = usual.cwiseProduct(Eigen::Vector3d(x, y, z));
        if (const double area = cutSeen(part->mesh(), size, side); area > kMore * most) {
          most = area;
          best = side;
        }
      }
  return best;
}

DrawnView drawView(const DrawnBlock& block, const Solid* part, const View& view, bool space) {
  DrawnView out{view, {}, {}, {}, {}};
  const Eigen::Vector3d& size = block.placed.size;
  out.bounds = {Point::Constant(1e300), Point::Constant(-1e300)};
  const std::vector<Polyline> edges = edgesOf(size);
  for (const Polyline& edge : edges)
    for (const Eigen::Vector3d& p : edge) {
      out.bounds.low = out.bounds.low.cwiseMin(view.flat(p));
      out.bounds.high = out.bounds.high.cwiseMax(view.flat(p));
    }
  // Of the block, edges that are away from the eye are left out: with it they would hide what is left.
  Eigen::Vector3d away;
  for (int k = 0; k < 3; ++k) away[k] = view.toward[k] > 0 ? 0 : size[k];
  std::vector<Polyline> ofBlock;
  for (const Polyline& edge : edges)
    if (!space || ((edge[0] - away).norm() > 0 && (edge[1] - away).norm() > 0)) ofBlock.push_back(edge);
  if (!part) {
    for (const Polyline& edge : ofBlock)
      out.lines.seen.push_back({view.flat(edge.front()), view.flat(edge.back())});
    return out;
  }
  const DepthBuffer buffer(part->mesh(), view);
  out.before = buffer.lines(ofBlock).seen;
  out.lines = buffer.lines(part->edges());
  if (space) out.lines.hidden.clear();
  std::vector<Polyline> further = part->outlines(view);
  for (const Polyline& crease : block.creases) further.push_back(inBlock(block.placed, crease));
  for (std::vector<Point>& line : buffer.lines(further).seen) out.lines.seen.push_back(std::move(line));
  if (!space) return out;
  std::vector<Polyline> across;
  for (const DrawnCut& cut : block.cuts)
    for (const Polyline& blade : cut.across) across.push_back(inBlock(block.placed, blade));
  out.blades = buffer.onSurface(across);
  return out;
}

PreparedBlock prepared(const DrawnBlock& block) {
  PreparedBlock out;
  const Eigen::Vector3d& size = block.placed.size;
  std::optional<Solid> part;
  if (block.part && block.part->mesh && !block.part->mesh->triangles.empty())
    part.emplace(inBlock(block.placed, *block.part->mesh));
  const Solid* const solid = part ? &*part : nullptr;
  out.mark = Mark::on(size, solid);
  const Eigen::Vector3d side = bestSide(solid, size);
  out.seenFrom = std::string(side.y() < 0 ? "front" : "back") + ", " + (side.x() > 0 ? "right" : "left") +
                 " and " + (side.z() > 0 ? "above" : "below");
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  out.views[kFront] = drawView(block, solid, {x, z, -y}, false);
  out.views[kSide] = drawView(block, solid, {y, z, x}, false);
  out.views[kTop] = drawView(block, solid, {x, y, z}, false);
  out.views[kSpace] = drawView(block, solid, View::from(side), true);
  return out;
}

/// A view at its place of the page.
struct Placed {
  const DrawnView* view;
  double scale;  ///< mm of the page a mm of foam
  Point low;     ///< of the block's bounds on the page

  Point operator()(const Point& p) const { return low + scale * (p - view->bounds.low); }
  Rectangle room() const { return {low, (*this)(view->bounds.high)}; }
};

void drawLines(PdfPages& pages, const Placed& at, const std::vector<std::vector<Point>>& lines,
               const Pen& pen) {
  for (const std::vector<Point>& line : lines) {
    std::vector<Point> points;
    for (const Point& p : line) points.push_back(at(p));
    pages.line(simplified(points, 0.01), pen);
  }
}

void drawPlaced(PdfPages& pages, const Placed& at, const Mark& mark, const Eigen::Vector3d& size) {
  drawLines(pages, at, at.view->before, kBefore);
  drawLines(pages, at, at.view->blades, kBlades);
  drawLines(pages, at, at.view->lines.hidden, kHidden);
  drawLines(pages, at, at.view->lines.seen, kVisible);
  drawMark(pages, mark.triangles(size, kMarkLeg / at.scale), at.view->view.toward, false,
           [&](const Eigen::Vector3d& p) { return at(at.view->view.flat(p)); });
}

/// A dimension between two points that lie along x or y of the page, `off` beside them, mm. A number without
/// room between the arrows stands beside the first point.
void drawDimension(PdfPages& pages, const Point& from, const Point& to, const Point& off,
                   const std::string& number) {
  constexpr double kGap = 1, kBeyond = 1.5, kHead = 2.6, kHeadWidth = 0.9, kOverLine = 0.8;
  const Point along = (to - from).normalized(), out = off.normalized();
  const Point a = from + off, b = to + off;
  pages.line({from + kGap * out, a + kBeyond * out}, kThin);
  pages.line({to + kGap * out, b + kBeyond * out}, kThin);
  const double length = (b - a).norm();
  const bool upright = std::abs(along.y()) > 0.5;
  const Letters letters{8, false, Align::centre, upright};
  const double width = pages.widthOf(number, letters);
  const bool inside = length > 3 * kHead;
  if (inside) {
    pages.line({a, b}, kThin);
    drawHead(pages, a, -along, kHead, kHeadWidth);
    drawHead(pages, b, along, kHead, kHeadWidth);
  } else {
    pages.line({a - 2 * kHead * along, b + 2 * kHead * along}, kThin);
    drawHead(pages, a, along, kHead, kHeadWidth);
    drawHead(pages, b, -along, kHead, kHeadWidth);
  }
  // Over the line, or beside its end where there is no room.
  const Point over = upright ? Point(-1, 0) : Point(0, 1);
  const bool fits = width + 1 < length;
  const Point middle = fits ? Point(0.5 * (a + b)) : Point(a - (2 * kHead + 1 + 0.5 * width) * along);
  const Point low = upright ? Point(0.35 * 8 * 25.4 / 72, 0) : Point(0, -0.35 * 8 * 25.4 / 72);
  pages.text(fits ? Point(middle + kOverLine * over) : Point(middle + low), number, letters);
}

/// The views of a block in first-angle projection, and it from a corner where room is left.
double drawViews(PdfPages& pages, const Rectangle& room, const DrawnBlock& block,
                 const PreparedBlock& prepared) {
  const Eigen::Vector3d& size = block.placed.size;
  const double width = room.width() - kLeftOfViews - kBetweenColumns - kRightOfViews;
  const double height = room.height() - kAboveViews - kBetweenRows - kBelowViews;
  const double asked = std::max((size.x() + size.y()) / width, (size.z() + size.y()) / height);
  const auto* const found = std::ranges::find_if(kScales, [&](double scale) { return scale >= asked; });
  const double scale = found == kScales.end() ? std::ceil(asked / 1000) * 1000 : *found;
  const double s = 1 / scale;
  const double high = room.high.y() - kAboveViews;
  const Placed front{
      &prepared.views[kFront], s, {room.high.x() - kRightOfViews - s * size.x(), high - s * size.z()}};
  const Placed side{
      &prepared.views[kSide], s, {front.low.x() - kBetweenColumns - s * size.y(), front.low.y()}};
  const Placed top{&prepared.views[kTop], s, {front.low.x(), front.low.y() - kBetweenRows - s * size.y()}};
  for (const Placed& view : {front, side, top}) drawPlaced(pages, view, prepared.mark, size);

  const Letters name{7.5, false, Align::centre};
  constexpr double kBelow = 4.5;
  const auto called = [&](const Placed& view, const std::string& text) {
    pages.text({view.room().center().x(), view.low.y() - kBelow}, text, name);
  };
  called(front, "Front");
  called(side, "From the right");
  called(top, "Top");
  constexpr double kOff = 7;
  const Rectangle f = front.room(), t = top.room();
  drawDimension(pages, {f.low.x(), f.high.y()}, f.high, {0, kOff}, millimetres(size.x()));
  drawDimension(pages, f.high, {f.high.x(), f.low.y()}, {kOff, 0}, millimetres(size.z()));
  drawDimension(pages, {t.high.x(), t.low.y()}, t.high, {kOff, 0}, millimetres(size.y()));

  // The block from a corner, where most room is left: below the side view, beside it, or below the top.
  const DrawnView& space = prepared.views[kSpace];
  const Point low = room.low + Point(4, kBelowViews);
  const std::array<Rectangle, 3> corners = {Rectangle{low, {front.low.x() - 8, front.low.y() - kBelow - 5}},
                                            Rectangle{low, {side.low.x() - 12, room.high.y() - 4}},
                                            Rectangle{low, {room.high.x() - 4, top.low.y() - kBelow - 5}}};
  const auto fitOf = [&](const Rectangle& corner) {
    return std::min(corner.width() / space.bounds.width(), corner.height() / space.bounds.height());
  };
  const Rectangle& corner = *std::ranges::max_element(corners, {}, fitOf);
  const double fit = fitOf(corner);
  const Placed seen{&space, fit, corner.center() - 0.5 * fit * (space.bounds.high - space.bounds.low)};
  drawPlaced(pages, seen, prepared.mark, size);
  std::string from = "From " + prepared.seenFrom;
  if (pages.widthOf(from + ", not to scale", name) < corner.width()) from += ", not to scale";
  const double half = 0.5 * pages.widthOf(from, name);
  pages.text({std::max(corner.center().x(), room.low.x() + 2 + half), seen.low.y() - kBelow}, from, name);
  return scale;
}

/// One cut: its picture, and what is to be done.
void drawCut(PdfPages& pages, const Rectangle& room, const DrawnBlock& block, std::size_t index,
             const Mark& mark) {
  const DrawnCut& cut = block.cuts[index];
  constexpr double kPicture = 42, kMostLine = 3.5, kEdge = 1.5;
  drawPose(pages, {room.low + Point(0, 0.5), {room.low.x() + kPicture, room.high.y() - 0.5}}, block, cut,
           mark);
  const double left = room.low.x() + kPicture + 1, width = room.high.x() - left - kEdge;
  double y = room.high.y() - 4.5;
  const Letters heading{9, true}, body{7.5};
  std::vector<std::string> lines;
  pages.text({left, y},
             pages.fitted("Cut " + std::to_string(index + 1) + " of " + std::to_string(block.cuts.size()) +
                              ": " + cut.id,
                          heading, width),
             heading);
  y -= 0.8;
  const auto say = [&](const std::string& words, int most) {
    std::ranges::move(pages.wrapped(words, body, width, most), std::back_inserter(lines));
  };
  say(cut.lies.empty() ? "Lay the block as it is placed: its top face up" : "Lay the block with " + cut.lies,
      3);
  say("Travel " + travelText(block, cut), 3);
  if (!cut.turns.empty()) say("The blade turns as it travels: " + cut.turns, 3);
  say("Blade " + millimetres(cut.bladeLength) + " mm, " + std::to_string(cut.stations) + " stations", 1);
  say(timesText(cut.cuttingTime, cut.runTime), 1);
  say((cut.removed ? "Takes off " + litres(*cut.removed) : "Takes off: not known") +
          (cut.keeps.empty() ? "" : "; what is " + cut.keeps + " stays"),
      2);
  say(cut.folder.empty() ? "No program" : "Program: " + cut.folder, 1);
  const double line = std::min(kMostLine, (y - room.low.y() - 1) / double(lines.size()));
  for (const std::string& words : lines) pages.text({left, y -= line}, words, body);
}

/// The sign of first-angle projection: a cone from the side, and what is seen of it from the left.
void drawFirstAngle(PdfPages& pages, const Point& center) {
  constexpr double kLength = 5, kSmall = 1.2, kLarge = 2.4, kApart = 4;
  constexpr int kParts = 40;
  const Pen pen{0.25, 0, {}};
  const Point cone = center - Point(kApart, 0), round = center + Point(kApart, 0);
  pages.line({cone + Point(-kLength / 2, -kSmall), cone + Point(kLength / 2, -kLarge),
              cone + Point(kLength / 2, kLarge), cone + Point(-kLength / 2, kSmall)},
             pen, true);
  for (const double radius : {kSmall, kLarge}) {
    std::vector<Point> circle;
    for (int i = 0; i < kParts; ++i)
      circle.push_back(round +
                       radius * Point(std::cos(2 * kPi * i / kParts), std::sin(2 * kPi * i / kParts)));
    pages.line(circle, pen, true);
  }
  pages.line({cone - Point(kLength / 2 + 1, 0), cone + Point(kLength / 2 + 1, 0)}, {0.1, 0, {5, 2, 1, 2}});
  pages.line({round - Point(kLarge + 1, 0), round + Point(kLarge + 1, 0)}, {0.1, 0, {5, 2, 1, 2}});
  pages.line({round - Point(0, kLarge + 1), round + Point(0, kLarge + 1)}, {0.1, 0, {5, 2, 1, 2}});
}

struct PageNumber {
  int page = 0, of = 0;
};

void drawFoot(PdfPages& pages, const DrawnDesign& design, const DrawnBlock& block, const Mark& mark,
              std::optional<double> scale, const PageNumber& number) {
  const Rectangle sheet = sheetOfPage();
  constexpr std::array<double, 4> kWidths = {92, 66, 57, 62};
  constexpr double kEdge = 2, kLine = 4.1;
  pages.rectangle(sheet, {0.5, 0, {}});
  pages.line({{sheet.low.x(), kAboveFoot}, {sheet.high.x(), kAboveFoot}}, {0.5, 0, {}});
  double x = sheet.low.x(), y = 0;
  std::size_t column = 0;
  const auto begin = [&](const std::string& heading) {
    if (column > 0) {
      x += kWidths[column - 1];
      pages.line({{x, sheet.low.y()}, {x, kAboveFoot}}, {0.25, 0, {}});
    }
    ++column;
    Letters letters{11, true};
    if (column == 1 && !block.whyNoCut.empty()) letters.colour = kForbidden;
    y = kAboveFoot - 5.2;
    pages.text({x + kEdge, y}, pages.fitted(heading, letters, kWidths[column - 1] - 2 * kEdge), letters);
    y -= 0.5;
  };
  const auto say = [&](const std::string& words, int most = 1) {
    const Letters letters{8};
    for (const std::string& line : pages.wrapped(words, letters, kWidths[column - 1] - 2 * kEdge, most))
      pages.text({x + kEdge, y -= kLine}, line, letters);
  };
  begin((block.whyNoCut.empty() ? "Label: " : "Do not cut: ") + block.id);
  say("Design: " + (design.name.empty() ? std::string("without a name") : design.name));
  if (block.whyNoCut.empty())
    say("Mark the corner " + mark.place() + " before the first cut: a filled triangle on the " +
            (mark.far[1] ? "back" : "front") + " face, open ones on the other two.",
        2);
  else
    say("Not as designed: " + block.whyNoCut, 2);
  say("Bladewright, run " + design.run);

  begin(sizeText(block.placed.size));
  const Frame& placed = block.placed.frame;
  say("x (to the right), y (to the back), z (up)");
  say("Corner at " + hundredths(placed.origin) + " of the design");
  constexpr double kTurned = 0.005;  // degrees
  if (const Eigen::Vector3d turned = placementOf(block.placed).rotation / kDegree;
      turned.cwiseAbs().maxCoeff() >= kTurned)
    say("Turned by " + hundredths(turned) + "° about x, y, z there");
  double cutting = 0, run = 0;
  for (const DrawnCut& cut : block.cuts) {
    cutting += cut.cuttingTime;
    run += cut.runTime;
  }
  say(std::to_string(block.cuts.size()) + (block.cuts.size() == 1 ? " cut, " : " cuts, ") +
          timesText(cutting, run),
      2);
  if (!mark.stays) say("No corner stays whole: renew the mark");

  if (block.part) {
    const double whole = block.part->blockVolume, left = block.part->volume, waste = whole - left;
    const auto share = [&](double volume) { return " (" + fixedText(100 * volume / whole, 1) + " %)"; };
    begin("Block " + litres(whole));
    say("Left: " + litres(left) + share(left));
    say("Waste: " + litres(waste) + share(waste));
    if (block.part->pieces != 1)
      say(block.part->pieces == 0 ? "Nothing is left"
                                  : "What is left: " + std::to_string(block.part->pieces) + " pieces");
  } else {
    begin("Block " + litres(block.placed.size.prod()));
    say("Left and waste: not known, see the note");
  }

  begin(scale ? (*scale >= 1 ? "Scale 1:" + shortText(*scale, 6) : "Scale " + shortText(1 / *scale, 6) + ":1")
              : "Further cuts");
  say("Lengths in mm, first-angle projection");
  if (scale && block.part) say("Dash-dotted: the block before its cuts");
  drawFirstAngle(pages, {x + kWidths[3] - 16, sheet.low.y() + 7});
  y = sheet.low.y() + 2.4 + kLine;
  say("Page " + std::to_string(number.page) + " of " + std::to_string(number.of));
}

int pagesOf(const DrawnBlock& block) {
  const int further = std::max(0, int(block.cuts.size()) - kCutsOnFirstPage);
  return 1 + (further + kCutsOnFurtherPage - 1) / kCutsOnFurtherPage;
}

void drawFirstPage(PdfPages& pages, const DrawnDesign& design, const DrawnBlock& block,
                   const PreparedBlock& prepared, const PageNumber& number) {
  pages.begin();
  const Rectangle sheet = sheetOfPage();
  const double column = sheet.high.x() - kCutsWidth;
  Rectangle views{{sheet.low.x(), kAboveFoot}, {column, sheet.high.y()}};
  if (!block.part) {
    const Letters letters{8};
    const std::vector<std::string> lines = pages.wrapped(
        "Drawn is the block alone: what is left of it could not be worked out: " + block.whyNoPart, letters,
        views.width() - 8, 3);
    double y = kAboveFoot + 2 + 3.6 * double(lines.size());
    views.low.y() = y + 1;
    for (const std::string& line : lines) pages.text({views.low.x() + 4, y -= 3.6}, line, letters);
  }
  const double scale = drawViews(pages, views, block, prepared);
  pages.line({{column, kAboveFoot}, {column, sheet.high.y()}}, {0.25, 0, {}});
  const double height = (sheet.high.y() - kAboveFoot) / kCutsOnFirstPage;
  for (std::size_t i = 0; i < std::min<std::size_t>(block.cuts.size(), kCutsOnFirstPage); ++i) {
    const double high = sheet.high.y() - double(i) * height;
    drawCut(pages, {{column, high - height}, {sheet.high.x(), high}}, block, i, prepared.mark);
    pages.line({{column, high - height}, {sheet.high.x(), high - height}}, {0.15, 0, {}});
  }
  drawFoot(pages, design, block, prepared.mark, scale, number);
  if (!block.whyNoCut.empty())
    pages.text({sheet.low.x() + 2, sheet.high.y() - 6}, "DO NOT CUT: see the label below",
               {14, true, Align::left, false, 0, kForbidden});
}

void drawFurtherPage(PdfPages& pages, const DrawnDesign& design, const DrawnBlock& block,
                     const PreparedBlock& prepared, std::size_t first, const PageNumber& number) {
  pages.begin();
  const Rectangle sheet = sheetOfPage();
  constexpr int kColumns = 2, kRows = kCutsOnFurtherPage / kColumns;
  const double height = (sheet.high.y() - kAboveFoot) / kRows, width = sheet.width() / kColumns;
  for (int i = 0; i < kCutsOnFurtherPage && first + std::size_t(i) < block.cuts.size(); ++i) {
    const Point low(sheet.low.x() + (i / kRows) * width, sheet.high.y() - (i % kRows + 1) * height);
    drawCut(pages, {low, low + Point(width, height)}, block, first + std::size_t(i), prepared.mark);
    pages.line({low, low + Point(width, 0)}, {0.15, 0, {}});
  }
  pages.line({{sheet.center().x(), kAboveFoot}, {sheet.center().x(), sheet.high.y()}}, {0.15, 0, {}});
  drawFoot(pages, design, block, prepared.mark, std::nullopt, number);
}

bool finite(const Polyline& line) {
  return std::ranges::all_of(line, [](const Eigen::Vector3d& p) { return p.allFinite(); });
}

Result<void> checked(const DrawnDesign& design) {
  if (design.blocks.empty()) return fail(ErrorCode::badInput, "there is no block to draw", "blocks");
  for (const DrawnBlock& block : design.blocks) {
    const auto bad = [&](const std::string& why) {
      return fail(ErrorCode::badInput, block.id + ": " + why, block.id);
    };
    const Frame& frame = block.placed.frame;
    if (!(block.placed.size.array() > 0).all() || !block.placed.size.allFinite())
      return bad("a block without size cannot be drawn");
    if (block.cuts.empty()) return bad("a block without cuts cannot be drawn");
    bool good =
        frame.origin.allFinite() && frame.x.allFinite() && frame.y.allFinite() && frame.normal.allFinite();
    if (block.part && block.part->mesh)
      good = good && finite(block.part->mesh->points) && finite(block.part->mesh->normals) &&
             block.part->mesh->normals.size() == block.part->mesh->points.size();
    good = good && std::ranges::all_of(block.creases, finite);
    for (const DrawnCut& cut : block.cuts)
      good = good && cut.direction.allFinite() && cut.direction.norm() > 0.5 && finite(cut.blade) &&
             std::ranges::all_of(cut.across, finite);
    if (!good) return bad("a number of its drawing is not finite");
  }
  return {};
}

}  // namespace

Result<std::string> drawingsPdf(const DrawnDesign& design, const RunContext& context) {
  if (const Result<void> ok = checked(design); !ok) return tl::unexpected<Error>(ok.error());
  std::vector<PreparedBlock> all(design.blocks.size());
  const Result<void> ok = parallelFor(context, int(all.size()), [&](int i) {
    all[std::size_t(i)] = prepared(design.blocks[std::size_t(i)]);
  });
  if (!ok) return tl::unexpected<Error>(ok.error());
  PageNumber number;
  for (const DrawnBlock& block : design.blocks) number.of += pagesOf(block);
  PdfPages pages(design.name);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (context.stopped()) return stoppedError();
    const DrawnBlock& block = design.blocks[i];
    ++number.page;
    drawFirstPage(pages, design, block, all[i], number);
    for (std::size_t first = kCutsOnFirstPage; first < block.cuts.size(); first += kCutsOnFurtherPage) {
      ++number.page;
      drawFurtherPage(pages, design, block, all[i], first, number);
    }
  }
  return pages.bytes();
}

}  // namespace bw::drawings
