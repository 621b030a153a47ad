// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/drawings/report.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bw/core/text/base64.h"
#include "pdf_text.h"

namespace bw::drawings {
namespace {

/// A red picture of 2 × 1 pixels.
std::string redPng() {
  return fromBase64(
             "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAADUlEQVR42mP4z8AARAAI/gH/"
             "GcBr5wAAAABJRU5ErkJggg==")
      .value();
}

Report longReport() {
  Report report{"Roof of the \xc3\xa4nnex", {}};
  report.parts.emplace_back(ReportParagraph{"All stated limits hold."});
  report.parts.emplace_back(ReportPicture{"a", "A picture", redPng(), 2, 1});
  report.parts.emplace_back(ReportHeading{"Limits"});
  report.parts.emplace_back(
      ReportTable{{"Number", "Measured", ""}, {{{"Deviation", "1.2 mm", "holds"}, ReportTable::Mark::good}}});
  report.parts.emplace_back(ReportHeading{"Stations"});
  ReportTable table{{"Station", "What is to be told of it"}};
  for (int i = 1; i <= 120; ++i)
    table.rows.push_back(
        {{std::to_string(i),
          "station-" + std::to_string(i) +
              (i % 10 == 0 ? " " + std::string(40, 'w') + " " + std::string(60, 'n') + " lastword" : "")}});
  report.parts.emplace_back(table);
  return report;
}

std::vector<std::string> wordsOf(const std::vector<Written>& page) {
  std::vector<std::string> words;
  for (const Written& written : page) words.push_back(written.words);
  return words;
}

TEST(ReportPdf, HasEveryRowOnceAndNamesItsColumnsOnEachPage) {
  const std::string pdf = reportPdf(longReport(), {}, ReportLetters::western).value();
  EXPECT_EQ(pdf, reportPdf(longReport(), {}, ReportLetters::western).value());
  const auto pages = pagesOf(pdf);
  ASSERT_GE(pages.size(), 3u);
  std::vector<std::string> all;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const std::vector<std::string> words = wordsOf(pages[i]);
    EXPECT_EQ(std::ranges::count(words, std::to_string(i + 1) + " / " + std::to_string(pages.size())), 1);
    if (i > 0) {
      EXPECT_EQ(std::ranges::count(words, "What is to be told of it"), 1) << i;
    }
    EXPECT_GE(std::ranges::count(words, "Roof of the \xe4nnex"), 1);
    for (const Written& written : pages[i]) {
      EXPECT_GE(written.x, 15 - 1e-3);
      EXPECT_LT(written.x, 196);
      EXPECT_GE(written.y, 15 - 1e-3);
      EXPECT_LT(written.y, 283);
    }
    all.insert(all.end(), words.begin(), words.end());
  }
  for (int i = 1; i <= 120; ++i) {
    const std::string name = "station-" + std::to_string(i);
    EXPECT_EQ(std::ranges::count_if(
                  all, [&](const std::string& word) { return word == name || word.starts_with(name + " "); }),
              1)
        << i;
  }
  EXPECT_EQ(std::ranges::count_if(all, [](const std::string& word) { return word.ends_with("lastword"); }),
            12)
      << "what is too long for a line goes on in the next";
  // A heading does not stand alone at the foot of a page.
  for (const auto& page : pages) {
    double lowest = 300;
    for (const Written& written : page)
      if (written.y > 20) lowest = std::min(lowest, written.y);
    for (const Written& written : page)
      if (written.words == "Stations" || written.words == "Limits") {
        EXPECT_GT(written.y, lowest + 5);
      }
  }
}

TEST(ReportPdf, CarriesItsLettersAndPictures) {
  Report report = longReport();
  report.title = "\xce\xa3\xcf\x84\xce\xad\xce\xb3\xce\xb7";  // Greek
  const std::string pdf = reportPdf(report).value();
  EXPECT_NE(pdf.find("/Subtype /Image"), std::string::npos);
  EXPECT_NE(pdf.find("DejaVuSans"), std::string::npos);
  EXPECT_EQ(pdf, reportPdf(report).value());
  EXPECT_LT(pdf.size(), 400'000u) << "of the fonts only what is used";
}

TEST(ReportPdf, WhatIsNoPictureIsAnError) {
  Report report{"x", {ReportPicture{"a", "b", "no PNG", 2, 1}}};
  EXPECT_EQ(reportPdf(report).error().code, ErrorCode::internal);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(reportPdf(longReport(), {.stop = stop.get_token()}).error().code, ErrorCode::cancelled);
  EXPECT_TRUE(reportPdf({}));
}

}  // namespace
}  // namespace bw::drawings
