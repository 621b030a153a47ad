// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Which of the files of a result are written.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace bw::pipeline {

/// Files of a result that may be left out. The design, sweep.json and report.json never are: the result is
/// shown and checked again by them.
enum class FileKind { programs, workshop, pages, surface, parts, meshes, tables, curves };
inline constexpr std::size_t kFileKinds = 8;

/// How a kind is named, where it is kept and where people read it.
struct FileKindInfo {
  const char* word;   ///< in settings
  const char* title;  ///< in the window
  const char* about;  ///< its files
};
/// In the order of `FileKind`.
inline constexpr std::array<FileKindInfo, kFileKinds> kFileKindInfos = {{
    {"programs", "Robot programs", "A folder for each block and cut in programs/, in the formats above"},
    {"workshop", "Drawings and cut list",
     "drawings.pdf: a page for each block; cut-list.csv: the foam to order. For designed surfaces, and where "
     "there are several blocks or cuts"},
    {"pages", "Report with pictures",
     "report.html and report.pdf: verdict, pictures, numbers beside their limits; pictures/"},
    {"surface", "Cut surface", "surface.step and IGES, a file for each cut where there are several"},
    {"parts", "Blocks and parts",
     "blocks.step and parts.step: each block, and what is left of it, as a solid, where drawings are made"},
    {"meshes", "Meshes", "mesh.obj and mesh.stl of the cut surface"},
    {"tables", "Tables", "stations.csv and deviation.csv"},
    {"curves", "Curves",
     "curves.step and curves.dxf: the seams between blocks, the outlines of cut surfaces, and their creases"},
}};

/// What is written of a result.
struct Wanted {
  std::array<bool, kFileKinds> kinds = {true, true, true, true, true, true, true, true};
  /// Ids of the blocks whose programs, drawings, parts and lines of the cut list are written; empty: all. The
  /// report and the surfaces are those of all blocks in any case.
  std::vector<std::string> blocks = {};
  bool operator==(const Wanted&) const = default;

  bool has(FileKind kind) const { return kinds[std::size_t(kind)]; }
  bool hasBlock(const std::string& id) const {
    return blocks.empty() || std::ranges::find(blocks, id) != blocks.end();
  }
};

}  // namespace bw::pipeline
