// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include <cstdio>
#include <cstring>
#include <vector>

/// Copies its argument to a buffer that it may not fit, and asks an empty vector for an element: one end for
/// each rule that is switched on.
int main(int argc, char** argv) {
  char buffer[16];
  if (argc > 1) {
    std::strcpy(buffer, argv[1]);
    std::puts(buffer);
    std::puts(__FILE__);
    return 0;
  }
  const std::vector<int> none;
  return none[std::size_t(argc)];
}
