// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/drawings/block_drawing.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <limits>
#include <set>

#include "bw/core/base/units.h"
#include "pdf_pages.h"
#include "pdf_text.h"

namespace bw::drawings {
namespace {

/// The lower part of a box of 600 × 400 × 300 mm, 200 mm high, as triangles whose faces share no points.
const TriangleMesh& slab() {
  static const TriangleMesh mesh = [] {
    TriangleMesh out;
    const Eigen::Vector3d size(600, 400, 200);
    for (int k = 0; k < 3; ++k)
      for (const int side : {0, 1}) {
        const int u = (k + 1) % 3, v = (k + 2) % 3, base = int(out.points.size());
        for (int i = 0; i < 4; ++i) {
          Eigen::Vector3d p = Eigen::Vector3d::Zero();
          p[k] = side ? size[k] : 0;
          p[u] = i == 1 || i == 2 ? size[u] : 0;
          p[v] = i >= 2 ? size[v] : 0;
          out.points.push_back(p);
          out.normals.push_back((side ? 1 : -1) * Eigen::Vector3d::Unit(k));
        }
        if (side) {
          out.triangles.push_back({base, base + 1, base + 2});
          out.triangles.push_back({base, base + 2, base + 3});
        } else {
          out.triangles.push_back({base, base + 2, base + 1});
          out.triangles.push_back({base, base + 3, base + 2});
        }
      }
    return out;
  }();
  return mesh;
}

DrawnDesign design(std::size_t cuts, std::size_t blocks = 1) {
  DrawnDesign out{"Roof", "0123456789abcdef", {}};
  for (std::size_t b = 0; b < blocks; ++b) {
    DrawnBlock block;
    block.id = "block-" + std::to_string(b + 1);
    block.placed.size = {600, 400, 300};
    block.part = {&slab(), 72e6, 48e6, 1};
    for (std::size_t i = 0; i < cuts; ++i) {
      DrawnCut cut;
      cut.id = "cut-" + std::to_string(i + 1);
      cut.direction = Eigen::Vector3d::UnitY();
      cut.blade = {{-100, -20, 200}, {700, -20, 200}};
      for (const double y : {0.0, 200.0, 400.0}) cut.across.push_back({{0, y, 200}, {600, y, 200}});
      cut.bladeLength = 800;
      cut.stations = 33;
      cut.cuttingTime = 61.6;
      cut.runTime = 130.2;
      cut.folder = "programs/strip-" + std::to_string(i);
      cut.removed = 24e6;
      block.cuts.push_back(cut);
    }
    out.blocks.push_back(block);
  }
  return out;
}

std::vector<std::vector<Written>> drawn(const DrawnDesign& of) {
  const Result<std::string> pdf = drawingsPdf(of);
  EXPECT_TRUE(pdf) << pdf.error().message;
  return pdf ? pagesOf(*pdf) : std::vector<std::vector<Written>>();
}

void expectHas(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
}

/// No words over others, and all on the page.
void expectLegible(const std::vector<Written>& page) {
  struct Place {
    double left, bottom, right, top;
  };
  PdfPages measure("");
  std::vector<Place> places;
  for (const Written& written : page) {
    // Widths by the bytes again: letters of code page 1252 above 0x7f are as wide as an n at least here.
    std::string plain = written.words;
    for (char& c : plain)
      if (static_cast<unsigned char>(c) > 0x7e) c = 'n';
    const double width = measure.widthOf(plain, {written.size, true}),
                 height = 0.7 * written.size * 25.4 / 72;
    const Place place = written.upright
                            ? Place{written.x - height, written.y, written.x, written.y + 0.9 * width}
                            : Place{written.x, written.y, written.x + 0.9 * width, written.y + height};
    EXPECT_GE(written.size, 7) << written.words;
    EXPECT_GT(place.left, 10) << written.words;
    EXPECT_LT(place.right, 287.5) << written.words;
    EXPECT_GT(place.bottom, 10) << written.words;
    EXPECT_LT(place.top, 200) << written.words;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Place& other = places[i];
      EXPECT_FALSE(place.left < other.right && other.left < place.right && place.bottom < other.top &&
                   other.bottom < place.top)
          << written.words << " over " << page[i].words;
    }
    places.push_back(place);
  }
}

TEST(BlockDrawing, TellsTheBlockAndItsCuts) {
  const std::vector<std::vector<Written>> pages = drawn(design(1));
  ASSERT_EQ(pages.size(), 1u);
  const std::string text = textOf(pages[0]);
  for (const char* part : {"Design: Roof",
                           "Label: block-1",
                           "600 \xd7 400 \xd7 300 mm",
                           "run 0123456789abcdef",
                           "Page 1 of 1",
                           "Cut 1 of 1: cut-1",
                           "as it is placed: its top face up",
                           "from front to back",
                           "blade end L (left robot) at the left",
                           "Blade 800 mm, 33 stations",
                           "62 s of cutting, 2:10 min with entry and exit",
                           "Takes off 24.0 l",
                           "Program: programs/strip-0",
                           "Block 72.0 l",
                           "Left: 48.0 l (66.7 %)",
                           "Waste: 24.0 l (33.3 %)",
                           "Front",
                           "From the right",
                           "Top",
                           "Scale 1:",
                           "first-angle",
                           "front, right, bottom"})
    expectHas(text, part);
  expectLegible(pages[0]);
  // The dimensions are those of the block, as words of their own.
  for (const char* number : {"600", "400", "300"})
    EXPECT_EQ(std::ranges::count(pages[0], number, &Written::words), 1) << number;
}

TEST(BlockDrawing, HasAPageABlockAndMoreForManyCuts) {
  EXPECT_EQ(drawn(design(4)).size(), 1u);
  EXPECT_EQ(drawn(design(5)).size(), 2u);
  EXPECT_EQ(drawn(design(1, 3)).size(), 3u);
  EXPECT_EQ(drawn(design(12)).size(), 2u);
  const std::vector<std::vector<Written>> pages = drawn(design(10, 2));
  ASSERT_EQ(pages.size(), 4u);
  for (const std::vector<Written>& page : pages) expectLegible(page);
  for (int i = 1; i <= 10; ++i)
    expectHas(textOf(pages[i <= kCutsOnFirstPage ? 0 : 1]), "Cut " + std::to_string(i) + " of 10: ");
  expectHas(textOf(pages[3]), "Page 4 of 4");
  expectHas(textOf(pages[3]), "block-2");
}

TEST(BlockDrawing, IsLegibleForBlocksOfAnyShape) {
  for (const Eigen::Vector3d& size : {Eigen::Vector3d(3000, 100, 100), Eigen::Vector3d(100, 3000, 100),
                                      Eigen::Vector3d(100, 100, 3000), Eigen::Vector3d(1234.5, 1000.25, 20),
                                      Eigen::Vector3d(9, 8, 7), Eigen::Vector3d(20000, 15000, 9000)}) {
    SCOPED_TRACE(size.transpose());
    DrawnDesign of = design(4);
    of.blocks[0].placed.size = size;
    of.blocks[0].part.reset();
    of.blocks[0].whyNoPart = "its surfaces do not part it";
    for (std::size_t i = 0; i < 4; ++i) of.blocks[0].cuts[i].pose = {BlockFace(i + 1), int(i)};
    const std::vector<std::vector<Written>> pages = drawn(of);
    ASSERT_EQ(pages.size(), 1u);
    expectLegible(pages[0]);
  }
}

TEST(BlockDrawing, TellsHowTheBlockLies) {
  DrawnDesign of = design(1);
  DrawnCut& cut = of.blocks[0].cuts[0];
  cut.pose = {BlockFace::top, 1};
  cut.lies = "its top face up, then turned by 90 degrees counter-clockwise seen from above";
  // What goes to the back of the block goes to the left once it is turned.
  std::string text = textOf(drawn(of)[0]);
  expectHas(text, "from right to left");
  expectHas(text, "L (left robot) at the front");
  expectHas(text, "Lay the block with its top face up");
  cut.direction = Eigen::Vector3d(1, 1, 0).normalized();
  text = textOf(drawn(of)[0]);
  expectHas(text, "along -0.707, 0.707, 0 (right, back, up)");
  EXPECT_EQ(text.find("turns as it travels"), std::string::npos);
  // As long as it comes, all of it is read.
  cut.pose = {BlockFace::left, 2};
  cut.lies = "its left face up, then turned by 180 degrees counter-clockwise seen from above";
  cut.turns =
      "by 12.5 clockwise at first, 17.5 counter-clockwise at last, between 12.5 clockwise and 22.5 "
      "counter-clockwise (degrees, seen from above)";
  of.blocks[0].cuts.resize(4, cut);
  const std::vector<Written> page = drawn(of)[0];
  expectLegible(page);
  expectHas(textOf(page), "The blade turns as it travels: by 12.5 clockwise at first");
  expectHas(textOf(page), "seen from above");
}

TEST(BlockDrawing, SaysThatThereIsNoPart) {
  DrawnDesign of = design(2);
  of.blocks[0].part.reset();
  of.blocks[0].whyNoPart = "the surface of cut-2 ends inside of the block";
  of.blocks[0].cuts[1].removed.reset();
  of.blocks[0].cuts[1].folder.clear();
  const std::vector<std::vector<Written>> pages = drawn(of);
  ASSERT_EQ(pages.size(), 1u);
  const std::string text = textOf(pages[0]);
  expectHas(text, "could not be worked out: the surface of cut-2 ends inside of the block");
  expectHas(text, "not known");
  expectHas(text, "No program");
  expectHas(text, "Block 72.0 l");
  expectLegible(pages[0]);
  // Nothing left at all is a part, too.
  const TriangleMesh nothing;
  of.blocks[0].part = {&nothing, 72e6, 0, 0};
  expectHas(textOf(drawn(of)[0]), "Nothing is left");
}

TEST(BlockDrawing, IsMarkedWhereItMustNotBeCut) {
  DrawnDesign of = design(5, 2);
  of.blocks[0].whyNoCut = "a grip passes the block at 36.3 mm, less than the clearance of 50 mm";
  const std::vector<std::vector<Written>> pages = drawn(of);
  ASSERT_EQ(pages.size(), 4u);
  for (std::size_t page = 0; page < pages.size(); ++page) {
    const std::string text = textOf(pages[page]);
    const bool first = page < 2;
    EXPECT_EQ(text.find("DO NOT CUT") != std::string::npos, page == 0) << page;
    EXPECT_EQ(text.find("Do not cut: block-1") != std::string::npos, first) << page;
    EXPECT_EQ(text.find("Not as designed: a grip passes the block at 36.3 mm") != std::string::npos, first);
    EXPECT_EQ(text.find("Mark the corner") != std::string::npos, !first) << page;
    expectLegible(pages[page]);
  }
}

TEST(BlockDrawing, BearsNamesOfAnyLettersAndLength) {
  for (const std::string& name :
       {std::string("Dach f\u00fcr K\u00f6ln \u20ac"), std::string("\u03a3\u03c4\u03ad\u03b3\u03b7"),
        std::string(300, 'W'), std::string("a b ") + std::string(5000, 'x'), std::string("\xff\xfe broken"),
        std::string("line\nbreak (and) \\ back"), std::string()}) {
    SCOPED_TRACE(name.substr(0, 40));
    DrawnDesign of = design(4);
    of.name = of.run = of.blocks[0].id = name;
    for (DrawnCut& cut : of.blocks[0].cuts) cut.id = cut.folder = cut.lies = name;
    const std::vector<std::vector<Written>> pages = drawn(of);
    ASSERT_EQ(pages.size(), 1u);
    expectLegible(pages[0]);
  }
  DrawnDesign of = design(1);
  of.name = "Dach f\u00fcr K\u00f6ln";
  of.blocks[0].id = "\u03a3\u03c4";
  of.blocks[0].cuts[0].id = std::string(300, 'W');
  const std::string text = textOf(drawn(of)[0]);
  expectHas(text, "Label: ?? Design: Dach f\xfcr K\xf6ln ");
  expectHas(text,
            "WW\x85"
            "WW");
}

TEST(BlockDrawing, TellsBlocksApartHoweverTheirNamesBegin) {
  DrawnDesign of = design(1);
  std::set<std::string> texts;
  for (const char end : {'1', '2'}) {
    const std::string name = std::string(70, 'x') + end;
    of.blocks[0].id = of.blocks[0].cuts[0].id = name;
    of.blocks[0].cuts[0].folder = "programs/" + name;
    const std::string text = textOf(drawn(of)[0]);
    for (const char* begin : {"Label: x", "Cut 1 of 1: x", "Program: programs/x"}) {
      const std::size_t at = text.find(begin), over = text.find(' ', at + std::string(begin).size());
      ASSERT_NE(at, std::string::npos) << begin;
      texts.insert(text.substr(at, over - at));
    }
  }
  EXPECT_EQ(texts.size(), 6u);
}

TEST(BlockDrawing, TellsWhereABlockStandsHoweverFarTurnedOrSmall) {
  DrawnDesign of = design(1);
  expectHas(textOf(drawn(of)[0]), "of the design 1 cut");
  DrawnBlock& block = of.blocks[0];
  block.placed = BlockPlacement{{1234567.891, -0.0001, 0}, {600, 400, 300}, {0, 0, fromDegrees(37.25)}}.box();
  block.part->blockVolume = 30000;
  block.part->volume = 16320;
  const std::string text = textOf(drawn(of)[0]);
  expectHas(text, "Corner at 1234567.89, 0, 0 of the design");
  expectHas(text, "Turned by 0, 0, 37.25\xb0 about x, y, z there");
  expectHas(text, "Block 0.03 l");
  expectHas(text, "Left: 0.0163 l (54.4 %)");
}

TEST(BlockDrawing, IsTheSameForAnyNumberOfThreads) {
  const DrawnDesign of = design(6, 5);
  RunContext one, two;
  one.threads = 1;
  two.threads = 2;
  const Result<std::string> first = drawingsPdf(of, one), again = drawingsPdf(of, one),
                            other = drawingsPdf(of, two);
  ASSERT_TRUE(first && again && other);
  EXPECT_EQ(*first, *again);
  EXPECT_EQ(*first, *other);
  EXPECT_EQ(first->find("Date"), std::string::npos);
  EXPECT_EQ(first->find("/ID"), std::string::npos);
  EXPECT_EQ(first->rfind("%PDF-1.", 0), 0u);
}

TEST(BlockDrawing, RefusesWhatCannotBeDrawn) {
  const auto code = [](const DrawnDesign& of) { return drawingsPdf(of).error().code; };
  EXPECT_EQ(code({}), ErrorCode::badInput);
  DrawnDesign of = design(1);
  of.blocks[0].placed.size.z() = 0;
  EXPECT_EQ(code(of), ErrorCode::badInput);
  of = design(0);
  EXPECT_EQ(code(of), ErrorCode::badInput);
  of = design(1);
  of.blocks[0].cuts[0].blade[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code(of), ErrorCode::badInput);
  std::stop_source stop;
  stop.request_stop();
  const Result<std::string> stopped = drawingsPdf(design(1), {stop.get_token(), {}, 1});
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
}

TEST(PdfPages, TellsWhatTheLibraryRefuses) {
  PdfPages pages("");
  pages.begin();
  pages.line({{0, 0}, {1, 1}}, {-1, 0, {}});  // a line of negative width
  pages.text({0, 0}, "after that", {});
  const Result<std::string> bytes = pages.bytes();
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, ErrorCode::internal);
  EXPECT_NE(bytes.error().message.find("libharu"), std::string::npos);
}

TEST(PdfPages, ShortensAndWrapsByWidth) {
  PdfPages pages("");
  const Letters letters{8};
  EXPECT_EQ(pages.fitted("short", letters, 50), "short");
  const std::string cut = pages.fitted("a name that does not fit", letters, 15);
  EXPECT_TRUE(cut.starts_with("a n") && cut.ends_with("t")) << cut;
  EXPECT_NE(cut.find("\u2026"), std::string::npos) << cut;
  EXPECT_LE(pages.widthOf(cut, letters), 15);
  EXPECT_GT(pages.widthOf(cut, letters), 10);
  const std::vector<std::string> lines = pages.wrapped("one two three four five six", letters, 15, 3);
  ASSERT_EQ(lines.size(), 3u);
  for (const std::string& line : lines) EXPECT_LE(pages.widthOf(line, letters), 15) << line;
  EXPECT_EQ(lines[0], "one two");
  EXPECT_EQ(windowsBytes("\u00fc\u20ac\u2026\u03a3\U0001f600z"), "\xfc\x80\x85??z");
}

}  // namespace
}  // namespace bw::drawings
