// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/drawings/report.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>

#include "pdf_pages.h"

namespace bw::drawings {

namespace {

// mm
constexpr double kPaperWidth = 210, kPaperHeight = 297, kMargin = 15;
constexpr double kTop = kPaperHeight - kMargin, kBottom = kMargin + 8, kWidth = kPaperWidth - 2 * kMargin;
constexpr double kLine = 4.0;     // from one line of text to the next
constexpr double kPadding = 1.3;  // within a cell
constexpr double kGap = 4;        // between two parts
constexpr double kTogether = 28;  // that stands below a heading on its page
constexpr double kPictureWidth = 150;
constexpr int kMostLines = 30;  // of a cell or a paragraph

const Letters kText{.size = 8.5}, kTitle{.size = 17, .bold = true}, kHeading{.size = 11.5, .bold = true};
const Letters kColumn{.size = 8.5, .bold = true}, kFooter{.size = 7.5, .grey = 0.45};
constexpr std::array<double, 3> kGood = {0.17, 0.54, 0.24}, kBad = {0.79, 0.16, 0.16};
const Pen kRule{.width = 0.15, .grey = 0.82};

/// Widths of columns by what they would like to have: each at most its wish, and those who wish for more than
/// an even part share what the others leave.
std::vector<double> shared(const std::vector<double>& wishes, double width) {
  std::vector<std::size_t> order(wishes.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::sort(order, {}, [&](std::size_t i) { return wishes[i]; });
  std::vector<double> widths(wishes.size());
  double left = width;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double even = left / double(order.size() - k);
    widths[order[k]] = std::min(wishes[order[k]], even);
    left -= widths[order[k]];
  }
  for (double& own : widths) own += left / double(widths.size());
  return widths;
}

/// Sets a report page by page. `pages` is how many there will be, where that is known: without it nothing is
/// drawn that only takes time.
class Setter {
 public:
  Setter(const Report& report, std::optional<int> pages, ReportLetters letters)
      : report_(report),
        pages_(pages),
        pdf_(report.title, {kPaperWidth, kPaperHeight, letters == ReportLetters::all}) {}

  Result<void> set(const RunContext& context) {
    page();
    for (const std::string& line : pdf_.wrapped(report_.title, kTitle, kWidth, 3)) write(line, kTitle, 8);
    y_ -= kGap;
    for (const ReportPart& part : report_.parts) {
      if (context.stopped()) return stoppedError();
      std::visit([this](const auto& own) { add(own); }, part);
    }
    return {};
  }
  int count() const { return count_; }
  Result<std::string> bytes() { return pdf_.bytes(); }

 private:
  void page() {
    pdf_.begin();
    ++count_;
    y_ = kTop;
    const double below = kMargin;
    pdf_.text({kMargin, below}, pdf_.fitted(report_.title, kFooter, kWidth - 25), kFooter);
    Letters right = kFooter;
    right.align = Align::right;
    if (pages_)
      pdf_.text({kPaperWidth - kMargin, below}, std::to_string(count_) + " / " + std::to_string(*pages_),
                right);
  }
  /// A new page unless so much of this one is left.
  void need(double height) {
    if (y_ - height < kBottom && y_ < kTop) page();
  }
  void write(const std::string& line, const Letters& letters, double height) {
    need(height);
    y_ -= height;
    pdf_.text({kMargin, y_ + height - 0.75 * kLine * letters.size / kText.size}, line, letters);
  }

  void add(const ReportHeading& heading) {
    y_ -= kGap;
    need(kTogether);
    write(pdf_.fitted(heading.text, kHeading, kWidth), kHeading, 6.5);
  }

  void add(const ReportParagraph& paragraph) {
    for (const std::string& line : pdf_.wrapped(paragraph.text, kText, kWidth, kMostLines))
      write(line, kText, kLine);
    y_ -= kGap / 2;
  }

  void add(const ReportPicture& picture) {
    const double height = kPictureWidth * picture.height / std::max(picture.width, 1);
    const double width = std::min(1.0, (kTop - kBottom - 2 * kLine) / height) * kPictureWidth;
    const double own = width * picture.height / std::max(picture.width, 1);
    need(own + 2 * kLine);
    y_ -= own;
    if (pages_) pdf_.picture({{kMargin, y_}, {kMargin + width, y_ + own}}, picture.png);
    y_ -= 0.3 * kLine;
    write(pdf_.fitted(picture.title, kText, kWidth), kText, kLine);
    y_ -= kGap;
  }

  using Cells = std::vector<std::vector<std::string>>;  // their lines

  Cells cellsOf(const std::vector<std::string>& texts, const std::vector<double>& widths,
                const Letters& letters) {
    Cells cells;
    for (std::size_t i = 0; i < widths.size(); ++i)
      cells.push_back(i < texts.size() ? pdf_.wrapped(texts[i], letters, widths[i] - 2 * kPadding, kMostLines)
                                       : std::vector<std::string>());
    return cells;
  }
  static double heightOf(const Cells& cells) {
    std::size_t most = 1;
    for (const auto& lines : cells) most = std::max(most, lines.size());
    return double(most) * kLine + 2 * kPadding;
  }
  void row(const Cells& cells, const std::vector<double>& widths, const Letters& letters,
           ReportTable::Mark mark) {
    const double height = heightOf(cells);
    double x = kMargin;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      Letters own = letters;
      if (mark != ReportTable::Mark::none && i + 1 == cells.size())
        own.colour = mark == ReportTable::Mark::good ? kGood : kBad;
      for (std::size_t k = 0; k < cells[i].size(); ++k)
        pdf_.text({x + kPadding, y_ - kPadding - (double(k) + 0.78) * kLine}, cells[i][k], own);
      x += widths[i];
    }
    y_ -= height;
    pdf_.line({{kMargin, y_}, {kMargin + kWidth, y_}}, kRule);
  }
  void columns(const Cells& names, const std::vector<double>& widths) {
    const double height = heightOf(names);
    pdf_.fill(
        {{kMargin, y_}, {kMargin + kWidth, y_}, {kMargin + kWidth, y_ - height}, {kMargin, y_ - height}},
        0.945);
    row(names, widths, kColumn, ReportTable::Mark::none);
  }

  void add(const ReportTable& table) {
    std::vector<double> wishes;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      double wish = pdf_.widthOf(table.columns[i], kColumn);
      for (const ReportTable::Row& own : table.rows)
        if (i < own.cells.size()) wish = std::max(wish, pdf_.widthOf(own.cells[i], kText));
      wishes.push_back(wish + 2 * kPadding + 0.2);
    }
    const std::vector<double> widths = shared(wishes, kWidth);
    const Cells names = cellsOf(table.columns, widths, kColumn);
    need(heightOf(names) + 2 * kLine);
    columns(names, widths);
    for (const ReportTable::Row& own : table.rows) {
      const Cells cells = cellsOf(own.cells, widths, kText);
      if (y_ - heightOf(cells) < kBottom) {
        page();
        columns(names, widths);
      }
      row(cells, widths, kText, own.mark);
    }
    y_ -= kGap;
  }

  const Report& report_;
  std::optional<int> pages_;
  PdfPages pdf_;
  double y_ = kTop;
  int count_ = 0;
};

}  // namespace

Result<std::string> reportPdf(const Report& report, const RunContext& context, ReportLetters letters) {
  Setter counted(report, std::nullopt, letters);
  if (Result<void> ok = counted.set(context); !ok) return tl::unexpected<Error>(ok.error());
  Setter setter(report, counted.count(), letters);
  if (Result<void> ok = setter.set(context); !ok) return tl::unexpected<Error>(ok.error());
  return setter.bytes();
}

}  // namespace bw::drawings
