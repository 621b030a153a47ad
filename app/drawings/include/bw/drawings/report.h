// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// A report as what it says, and its pages on A4.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "bw/core/base/result.h"
#include "bw/core/base/run_context.h"

namespace bw::drawings {

struct ReportHeading {
  std::string text;
};

struct ReportParagraph {
  std::string text;
};

struct ReportTable {
  enum class Mark { none, good, bad };
  struct Row {
    std::vector<std::string> cells;
    Mark mark = Mark::none;  ///< of the last cell
  };
  std::vector<std::string> columns;
  std::vector<Row> rows = {};
};

struct ReportPicture {
  std::string name;           ///< of its file, without suffix
  std::string title;          ///< what it shows
  std::string png;            ///< its bytes
  int width = 1, height = 1;  ///< pixels
};

using ReportPart = std::variant<ReportHeading, ReportParagraph, ReportTable, ReportPicture>;

/// What a report says, from above to below. Texts are UTF-8.
struct Report {
  std::string title;
  std::vector<ReportPart> parts;
};

/// The letters that a report is printed in: those that its file carries, of most alphabets, or those of
/// western Europe, which are plain text in the file.
enum class ReportLetters { all, western };

/// The report as PDF, A4 upright with numbered pages: a table that goes on has its columns' names on each
/// page, a heading stands with what follows. No date: equal input gives equal bytes. Errors: `cancelled`;
/// `internal` if libharu fails, for instance at a picture that is no PNG.
[[nodiscard]] Result<std::string> reportPdf(const Report& report, const RunContext& context = {},
                                            ReportLetters letters = ReportLetters::all);

}  // namespace bw::drawings
