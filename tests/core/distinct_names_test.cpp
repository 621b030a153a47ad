// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "bw/core/text/distinct_names.h"

#include <gtest/gtest.h>

namespace bw::test {
namespace {

using Names = std::vector<std::string>;

std::string whole(const std::string& name, const std::string& behind) { return name + behind; }

TEST(DistinctNames, LeavesAloneWhatDiffers) {
  const Names names = {"one", "two", "one two", "One", ""};
  EXPECT_EQ(distinctNames(names, whole), names);
  EXPECT_TRUE(distinctNames({}, whole).empty());
}

TEST(DistinctNames, NumberWhatComesOutTheSame) {
  const Names names = {"a", "b", "a", "a", "b"};
  EXPECT_EQ(distinctNames(names, whole), (Names{"a", "b", "a (2)", "a (3)", "b (2)"}));
  EXPECT_EQ(distinctNames(Names{"seam 1", "seam 2", "door"},
                          [](const std::string& name, const std::string& behind) {
                            return name.substr(0, 4) + behind;
                          }),
            (Names{"seam", "seam (2)", "door"}));
}

TEST(DistinctNames, CountNoSpaces) {
  EXPECT_EQ(distinctNames(Names{"a b", "a  b", " a b ", "ab"}, whole),
            (Names{"a b", "a  b (2)", " a b  (3)", "ab"}));
}

TEST(DistinctNames, TakeNoNumberThatANameHas) {
  EXPECT_EQ(distinctNames(Names{"a (2)", "a", "a", "a (2)"}, whole),
            (Names{"a (2)", "a", "a (3)", "a (2) (2)"}));
}

}  // namespace
}  // namespace bw::test
