// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "rapid/names.h"

#include <gtest/gtest.h>

namespace bw::robotio {
namespace {

TEST(RapidNames, ReservedWordsAreKnownInAnyCase) {
  for (const char* word : {"ALIAS", "and", "EndModule", "TASK", "xor", "undo", "PERS", "to", "Mod"})
    EXPECT_TRUE(isReservedWord(word)) << word;
  for (const char* word : {"blade", "toe", "endmodules", "", "robtarget"})
    EXPECT_FALSE(isReservedWord(word)) << word;
}

TEST(RapidNames, IdentifiersFollowTheRuleOf32Characters) {
  EXPECT_EQ(identifierFault("a"), "");
  EXPECT_EQ(identifierFault("Blade_Left2"), "");
  EXPECT_EQ(identifierFault(std::string(32, 'x')), "");
  EXPECT_NE(identifierFault(std::string(33, 'x')), "");
  for (const char* word :
       {"", "_a", "1a", "a-b", "a b", "\xC3\xA4", "While", "v200", "z0", "FINE", "tool0", "MoveL"})
    EXPECT_NE(identifierFault(word), "") << word;
  EXPECT_EQ(identifierFault("v201"), "") << "only the controller's own speeds are taken";
}

TEST(RapidNames, AnyTextBecomesAnIdentifier) {
  EXPECT_EQ(makeIdentifier("Blade", 20), "Blade");
  EXPECT_EQ(makeIdentifier("wavy wall (2)", 20), "wavy_wall_2");
  EXPECT_EQ(makeIdentifier("Fassade S\xC3\xBC"
                           "d",
                           20),
            "Fassade_S_d");
  EXPECT_EQ(makeIdentifier("", 20), "Blade");
  EXPECT_EQ(makeIdentifier("\xE5\xA3\x81", 20), "Blade");
  EXPECT_EQ(makeIdentifier("3 panels", 20), "P3_panels");
  EXPECT_EQ(makeIdentifier("abcdefghijklmnopqrs_uvw", 20), "abcdefghijklmnopqrs");
  for (const char* text : {"a", "__", "9", "- -", "x y z", "01234567890123456789012345678901234567890"})
    EXPECT_EQ(identifierFault(makeIdentifier(text, 20)), "") << text;
}

TEST(RapidNames, SystemSpeedsAndZonesHaveTheirValues) {
  EXPECT_EQ(predefinedSpeed("v20"), 20.0);
  EXPECT_EQ(predefinedSpeed("V200"), 200.0);
  EXPECT_EQ(predefinedSpeed("v21"), std::nullopt);
  EXPECT_EQ(predefinedSpeed("v020"), std::nullopt);
  EXPECT_EQ(predefinedZone("fine"), -1.0);
  EXPECT_EQ(predefinedZone("z0"), 0.3);
  EXPECT_EQ(predefinedZone("z5"), 5.0);
  EXPECT_EQ(predefinedZone("z2"), std::nullopt);
  for (const char* zone : {"fine", "z0", "z1", "z200"})
    EXPECT_EQ(predefinedZoneName(std::max(0.0, *predefinedZone(zone))), zone);
  EXPECT_EQ(predefinedZoneName(0.05), "");
}

}  // namespace
}  // namespace bw::robotio
