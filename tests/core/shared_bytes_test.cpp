// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/files/shared_bytes.h"

#include <gtest/gtest.h>

#include "bw/core/design/design.h"

namespace bw {

TEST(SharedBytes, CopiesOfADesignShareItsEmbeddedFile) {
  Design design;
  design.source().bytes = std::string(1 << 20, 'x');
  const Design copy = design;
  EXPECT_EQ(&copy.source().bytes.str(), &design.source().bytes.str());
  EXPECT_EQ(copy.source(), design.source());
}

TEST(SharedBytes, EqualBytesAreEqualWhereverTheyLie) {
  const SharedBytes a("abc"), b(std::string("abc")), c("abd"), none, empty("");
  EXPECT_TRUE(a == b);
  EXPECT_FALSE(a == c);
  EXPECT_TRUE(none == empty);
  EXPECT_TRUE(empty.empty());
  EXPECT_EQ(none.size(), 0u);
  EXPECT_EQ(none.str(), "");
  SharedBytes cleared = a;
  cleared.clear();
  EXPECT_TRUE(cleared.empty());
  EXPECT_EQ(a.str(), "abc");
}

}  // namespace bw
