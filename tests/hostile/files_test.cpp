// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// CAD files with faults of every kind: each is read as far as it is usable, or refused with its name.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <random>

#include "bw/core/files/file_set.h"
#include "bw/geometry/cad_model.h"
#include "bw/geometry/export.h"
#include "step_merge.h"

namespace bw::geometry::test {
namespace {

constexpr int kRounds = 30;  // times BW_HOSTILE

using Engine = std::mt19937_64;

std::size_t below(Engine& engine, std::size_t n) { return n > 0 ? std::size_t(engine() % n) : 0; }

template <class T>
const T& oneOf(Engine& engine, const std::vector<T>& list) {
  return list[below(engine, list.size())];
}

/// Files to spoil: our examples, several faces in one file, and those of Debian's occt-misc if they are
/// there.
std::vector<std::pair<std::string, std::string>> wholeFiles() {
  std::vector<std::pair<std::string, std::string>> files;
  std::vector<std::string> parts;
  for (const char* name : {"saddle", "sphere-cap", "torus-patch"}) {
    parts.push_back(exampleStep(name).value());
    files.emplace_back(std::string(name) + ".step", parts.back());
  }
  files.emplace_back("several.stp", bw::test::mergedStep(parts));
  for (const char* name : {"step/screw.step", "step/linkrods.step", "iges/bearing.iges", "iges/hammer.iges",
                           "occ/face.brep", "occ/wing.brep", "occ/bottle.brep"}) {
    const auto bytes = readFile(std::string("/usr/share/opencascade/data/") + name);
    if (bytes) files.emplace_back(std::filesystem::path(name).filename().string(), *bytes);
  }
  return files;
}

std::pair<std::size_t, std::size_t> someLine(const std::string& text, Engine& engine) {
  const std::size_t at = below(engine, text.size());
  const std::size_t before = text.rfind('\n', at), after = text.find('\n', at);
  const std::size_t begin = before == std::string::npos || before == at ? 0 : before + 1;
  return {begin, (after == std::string::npos ? text.size() : after + 1) - std::min(begin, text.size())};
}

/// A stretch of characters of one kind that begins at or after a random place; empty if there is none.
template <class Of>
std::pair<std::size_t, std::size_t> someRun(const std::string& text, Engine& engine, const Of& of) {
  const auto start = text.begin() + long(below(engine, text.size()));
  const auto first = std::find_if(start, text.end(), of);
  return {std::size_t(first - text.begin()), std::size_t(std::find_if_not(first, text.end(), of) - first)};
}

std::string spoilt(std::string text, Engine& engine) {
  static const std::vector<std::string> kNumbers = {
      "0",  "-1", "1E308", "-1.E308", "1E-300", "NAN", "INF", "1e99",    "999999", "-0.", "1..2",
      "1E", "$",  "*",     "''",      "()",     "(",   ")",   "#999999", "#1",     ".T.", "2147483648"};
  static const std::vector<std::string> kHeads = {
      "\xef\xbb\xbf", "\xff\xfe", "\r\n\r\n", "/* a program */\n",
      "/* open",      "\x1a",     "%!PS\n",   std::string(80, '\0')};
  if (text.empty()) return text;
  const auto digit = [](unsigned char c) {
    return std::isdigit(c) || c == '.' || c == '-' || c == '+' || c == 'E';
  };
  switch (engine() % 12) {
    case 0:
      text[below(engine, text.size())] = char(engine() & 255u);
      break;
    case 1: {
      const auto [at, size] = someLine(text, engine);
      text.erase(at, size);
      break;
    }
    case 2: {
      const auto [at, size] = someLine(text, engine);
      text.insert(below(engine, text.size()), text.substr(at, size));
      break;
    }
    case 3:
      text.resize(below(engine, text.size()));
      break;
    case 4:
    case 5:
    case 6: {
      const auto [at, size] = someRun(text, engine, digit);
      text.replace(at, size, oneOf(engine, kNumbers));
      break;
    }
    case 7: {  // one reference for another
      const std::size_t a = text.find('#', below(engine, text.size())),
                        b = text.find('#', below(engine, text.size()));
      if (a == std::string::npos || b == std::string::npos) break;
      const std::size_t endA = text.find_first_not_of("0123456789", a + 1),
                        endB = text.find_first_not_of("0123456789", b + 1);
      if (endA == std::string::npos || endB == std::string::npos) break;
      text.replace(a, endA - a, text.substr(b, endB - b));
      break;
    }
    case 8: {  // an argument that is not given
      const std::size_t at = text.find("''", below(engine, text.size()));
      if (at != std::string::npos) text.replace(at, 2, "$");
      break;
    }
    case 9:
      text.insert(0, oneOf(engine, kHeads));
      break;
    case 10: {  // a word for another
      const auto word = [](unsigned char c) { return std::isupper(c) || c == '_'; };
      const auto [a, sizeA] = someRun(text, engine, word);
      const auto [b, sizeB] = someRun(text, engine, word);
      text.replace(a, sizeA, text.substr(b, sizeB));
      break;
    }
    default: {  // a piece is lost
      const std::size_t at = below(engine, text.size());
      text.erase(at, below(engine, 200));
      break;
    }
  }
  return text;
}

TEST(HostileFiles, AreReadAsFarAsTheyAreUsableOrRefusedByName) {
  const char* factor = std::getenv("BW_HOSTILE");
  const int rounds = int(kRounds * (factor ? std::max(std::atof(factor), 0.01) : 1.0));
  const auto files = wholeFiles();
  int whole = 0, inPart = 0, refused = 0, crashed = 0, endless = 0, unusable = 0;
  double slowest = 0;
  for (int round = 0; round < rounds; ++round) {
    Engine engine(std::uint64_t(round) + 1);
    const auto& [name, original] = oneOf(engine, files);
    std::string text = original;
    for (int faults = 1 + int(engine() % 3); faults > 0; --faults) text = spoilt(std::move(text), engine);
    SCOPED_TRACE(name + ", round " + std::to_string(round));
    const auto start = std::chrono::steady_clock::now();
    const auto model = CadModel::readBytes(text, name);
    if (!model) {
      const Error& error = model.error();
      EXPECT_TRUE(error.code == ErrorCode::cannotRead || error.code == ErrorCode::badInput) << error.message;
      EXPECT_NE(error.message.find(name), std::string::npos) << error.message;
      crashed += error.message.find("broke down") != std::string::npos;
      endless += error.message.find("did not come to an end") != std::string::npos;
      ++refused;
    } else {
      const CadInfo& info = model->info();
      (info.leftOut.empty() ? whole : inPart) += 1;
      EXPECT_TRUE(info.bounds.min.allFinite() && info.bounds.max.allFinite());
      EXPECT_EQ(info.faceList.size(), std::size_t(info.faces));
      const auto target = Target::make(*model, {});
      if (!target) {
        EXPECT_EQ(target.error().code, ErrorCode::badInput) << target.error().message;
        ++unusable;
      } else if (const auto foot = target->sampler()->closest(target->bounds().center(), nullptr)) {
        EXPECT_TRUE(std::isfinite(foot->distance));
      }
    }
    slowest =
        std::max(slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::cout << "hostile files: " << rounds << " spoilt STEP, IGES and BREP files; " << whole
            << " read whole, " << inPart << " in part, " << refused << " refused with their names ("
            << crashed << " where OpenCASCADE broke down, " << endless << " where it did not end), "
            << unusable << " without a face to use; slowest " << slowest << " s; 0 crashes of the program\n";
}

}  // namespace
}  // namespace bw::geometry::test
