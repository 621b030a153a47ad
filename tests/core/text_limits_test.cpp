// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bw/core/design/design.h"
#include "bw/core/files/file_set.h"
#include "bw/core/motion/cell.h"
#include "bw/core/text/json_reader.h"
#include "bw/core/text/printable.h"

namespace bw {

TEST(Printable, LeavesWordsOfAnyLanguageAlone) {
  for (const char* text :
       {"", "a.step", "Größe 5°, Übermaß – naïve", "数值 \xf0\x9f\x94\xa5", "back\\slash \"quoted\""})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesWhatActsInsteadOfBeingSeen) {
  EXPECT_EQ(printable("a\nblade: done\r\t"), "a\\nblade: done\\r\\t");
  EXPECT_EQ(printable("\x1b[2J\x07\x7f"), "\\x1b[2J\\x07\\x7f");
  EXPECT_EQ(printable(std::string_view("\0end", 4)), "\\x00end");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\u009b31m")
      << "the C1 form of the escape sequence";
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b\xe2\x80\xa8"),
            "a\\u202eb\\u2028");
}

TEST(Printable, EscapesBytesThatAreNoCharacter) {
  EXPECT_EQ(printable("\xff\xfe"), "\\xff\\xfe");
  EXPECT_EQ(printable("\xc0\x8a"), "\\xc0\\x8a") << "a line feed in too many bytes";
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half a surrogate pair";
  EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82") << "cut short";
  EXPECT_EQ(printable("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
}

TEST(JsonText, NamesTheNumberThatIsNone) {
  const auto said = [](const std::string& text) {
    const Result<nlohmann::json> read = parseJsonText(text, "design");
    EXPECT_FALSE(read) << text;
    return read ? std::string() : read.error().message;
  };
  EXPECT_EQ(said("{\"blade\": {\"length\": NaN}}"),
            "design.blade.length is NaN, which is no number; give a finite one (line 1)");
  EXPECT_EQ(said("{\"a\": [[1, 2], {}, [3,\n -Infinity]]}"),
            "design.a[2][1] is -Infinity, which is no number; give a finite one (line 2)");
  EXPECT_EQ(said("{\"a\": 1, \"b\": nan}"),
            "design.b is nan, which is no number; give a finite one (line 1)");
  EXPECT_EQ(said("{\"a\": inf}"), "design.a is inf, which is no number; give a finite one (line 1)");
  EXPECT_EQ(said("[0, 1e999]"), "design[1] is a number that is too large");
  // Other slips are told by their place.
  EXPECT_NE(said("{\"a\": nun}").find("is not valid JSON: line 1"), std::string::npos);
  EXPECT_NE(said("{\"a\": }").find("is not valid JSON: line 1"), std::string::npos);
  EXPECT_NE(said("NaN").find("is NaN"), std::string::npos);
  const Result<Design> design = parseDesign("{\"bladewright_design\": 2, \"blade\": {\"length\": NaN}}");
  ASSERT_FALSE(design);
  EXPECT_EQ(design.error().message.find("CAD file"), std::string::npos) << design.error().message;
}

TEST(JsonText, AByteOrderMarkIsNoPartOfIt) {
  const Result<nlohmann::json> marked = parseJsonText("\xEF\xBB\xBF{\"a\": 1}", "design");
  ASSERT_TRUE(marked) << marked.error().message;
  EXPECT_EQ((*marked)["a"], 1);
  const Result<nlohmann::json> none = parseJsonText("\xEF\xBB\xBF \n", "design");
  EXPECT_EQ(none.error().message, "design is empty; it must hold a JSON object");
  for (const std::string& other : {std::string("\xFF\xFE{\0", 4), std::string("\xFE\xFF\0{", 4)}) {
    EXPECT_EQ(parseJsonText(other, "job").error().message,
              "job is UTF-16 text, which is not read here; save it as UTF-8");
    EXPECT_EQ(parseDesign(other).error().message.find("CAD file"), std::string::npos)
        << parseDesign(other).error().message;
  }
}

TEST(TextLimits, DepthIsBoundedWhereverJsonIsRead) {
  const std::string deep = "{\"cases\":" + std::string(200000, '[') + std::string(200000, ']') + "}";
  const auto refused = [](const auto& result) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::badInput);
    EXPECT_NE(result.error().message.find("128 deep"), std::string::npos) << result.error().message;
  };
  refused(parseJsonText(deep, "the input"));
  refused(parseJob(deep));
  refused(parseDesign(deep));
  refused(parseCell(deep, "deep"));
}

TEST(TextLimits, ValuesAreCountedWhileReading) {
  std::string many = "[";
  for (int i = 0; i < 20'000'001; ++i) many += "0,";
  many += "0]";
  const Result<nlohmann::json> read = parseJsonText(many, "the input");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("20 million values"), std::string::npos) << read.error().message;
}

TEST(TextLimits, AListCountsOnce) {
  std::string lists = "[";
  for (int i = 0; i < 10'100'000; ++i) lists += "[],";
  lists += "[]]";
  EXPECT_TRUE(parseJsonText(lists, "the input"));
}

TEST(TextLimits, FilesAboveTheLimitAreRefusedByTheirSize) {
  // A file with a hole: as large as it says, and no byte of it written.
  const std::filesystem::path file = std::filesystem::path(BW_TEST_OUTPUT) / "vast.bladewright";
  ASSERT_TRUE(writeFile(file, "{}"));
  std::filesystem::resize_file(file, kLargestText + 1);
  const Result<Design> design = loadDesign(file);
  std::filesystem::remove(file);
  ASSERT_FALSE(design);
  EXPECT_EQ(design.error().code, ErrorCode::cannotRead);
  EXPECT_NE(design.error().message.find("larger than 256 MB"), std::string::npos) << design.error().message;
}

TEST(TextLimits, ADesignThatCouldNotBeOpenedAgainIsNotSaved) {
  Design design;
  design.source().path = "large.step";
  design.source().bytes = std::string(kLargestText / 4 * 3 + 1, 'x');
  const std::filesystem::path file = std::filesystem::path(BW_TEST_OUTPUT) / "too-large.bladewright";
  const Result<void> saved = saveDesign(design, file);
  ASSERT_FALSE(saved);
  EXPECT_NE(saved.error().message.find("link the CAD file"), std::string::npos) << saved.error().message;
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(Versions, ANewerOneIsToldBeforeWhateverElseItHolds) {
  const auto told = [](const auto& result) {
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().message.find("but this program reads up to"), std::string::npos)
        << result.error().message;
  };
  told(parseDesign(R"({"blocks": [], "bladewright_design": 3, "job": {"cuts": 3}, "source": 7})"));
  told(parseCell(R"({"robots": 4, "version": 2, "tasks": "none"})", "new"));
}

}  // namespace bw
