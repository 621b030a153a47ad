// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Takes the place of libFuzzer where there is none: the texts of a folder and slips in each, the same ones
// every time.
//   fuzz_NAME FOLDER

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr int kSlips = 5000;             // for each text
constexpr std::size_t kLongest = 16384;  // bytes, as in run.sh: longer texts are taken as they are

void take(const std::string& text) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

/// One to three of: another byte, a piece lost, a piece twice, the end cut off.
std::string withSlips(std::string text, std::mt19937& random) {
  // Not std::uniform_int_distribution, whose numbers differ from library to library.
  const auto below = [&](std::size_t n) { return std::size_t(random()) % n; };
  for (std::size_t left = 1 + below(3); left > 0 && !text.empty(); --left) {
    const std::size_t at = below(text.size()),
                      length = 1 + below(std::min<std::size_t>(32, text.size() - at));
    switch (below(4)) {
      case 0:
        text[at] = char(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      default:
        if (below(4) == 0) text.resize(at);
    }
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
    return 2;
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  int texts = 0;
  for (const std::filesystem::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    take(text);
    ++texts;
    std::mt19937 random(1);
    for (int i = 0; i < kSlips && text.size() <= kLongest; ++i, ++texts) take(withSlips(text, random));
  }
  std::printf("%d texts went through\n", texts);
  return texts > 0 ? 0 : 1;
}
