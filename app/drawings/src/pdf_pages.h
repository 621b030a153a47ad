// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Pages of lines and words as PDF: libharu behind a plain face.
#pragma once

#include <Eigen/Core>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bw/core/base/result.h"

namespace bw::drawings {

/// A point of a page, mm from its lower left corner.
using Point = Eigen::Vector2d;

/// A rectangle of a page, mm.
struct Rectangle {
  Point low = Point::Zero(), high = Point::Zero();
  double width() const { return high.x() - low.x(); }
  double height() const { return high.y() - low.y(); }
  Point center() const { return 0.5 * (low + high); }
};

/// How a line is drawn.
struct Pen {
  double width = 0.25;         ///< mm
  double grey = 0;             ///< 0 black to 1 white
  std::vector<int> dash = {};  ///< points (1/72 inch) drawn and left out in turn; empty: all of it
};

enum class Align { left, centre, right };

/// How words are written.
struct Letters {
  double size = 8;  ///< points
  bool bold = false;
  Align align = Align::left;
  bool upright = false;  ///< from below to above
  double grey = 0;
  std::optional<std::array<double, 3>> colour =
      std::nullopt;  ///< red, green and blue, 0 to 1, in place of grey
};

/// What pages are made of.
struct Paper {
  double width = 297, height = 210;  ///< mm; A4 landscape
  /// The file carries the letters of DejaVu Sans, of most alphabets; else, and where that is not installed,
  /// it has those of code page 1252 in Helvetica, which every reader of PDF has.
  bool allLetters = false;
};

/// Builds a PDF of pages of one size. Of what libharu complains of first, `bytes` tells; what is drawn after
/// that is lost. Not for several threads at once.
class PdfPages {
 public:
  explicit PdfPages(const std::string& title, const Paper& paper = {});
  ~PdfPages();
  PdfPages(const PdfPages&) = delete;
  PdfPages& operator=(const PdfPages&) = delete;

  /// A new page, on which is drawn from now on.
  void begin();
  void line(const std::vector<Point>& points, const Pen& pen, bool closed = false);
  void rectangle(const Rectangle& r, const Pen& pen);
  void fill(const std::vector<Point>& points, double grey);
  /// Words with their base line at `at`.
  void text(const Point& at, std::string_view words, const Letters& letters);

  /// A picture, PNG, that fills a rectangle.
  void picture(const Rectangle& r, const std::string& png);

  /// mm that words take.
  double widthOf(std::string_view words, const Letters& letters);
  /// The words, or their beginning and end with an ellipsis between, so that they take at most `width` mm.
  std::string fitted(std::string_view words, const Letters& letters, double width);
  /// The words in at most `most` lines of at most `width` mm each; what is too much ends in an ellipsis.
  std::vector<std::string> wrapped(std::string_view words, const Letters& letters, double width, int most);

  /// The file. Error `internal`: libharu failed, with its number.
  Result<std::string> bytes();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// UTF-8 in the bytes of code page 1252, which the standard fonts of PDF have; a question mark for each other
/// character.
std::string windowsBytes(std::string_view utf8);

}  // namespace bw::drawings
