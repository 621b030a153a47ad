// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bw/core/motion/cell.h"
#include "bw/pipeline/overall.h"
#include "bw/pipeline/produce.h"

namespace bw::pipeline {

/// sweep.json, surface.step, parts.step and blocks.step (where parts are known), drawings.pdf and
/// cut-list.csv (where they were sought), mesh.obj, curves.step and curves.dxf, stations.csv and
/// deviation.csv of all strips, the programs of the design in programs/ as `programFiles` has them, the
/// design, those of the policy's caller, and last report.json; of these what `policy.wanted` has. The report
/// lists exactly these, with the fingerprint of each and the name of the run.
Result<FileSet> resultFiles(Evaluation& evaluation, const RunContext& context, const Policy& policy);

/// A row of blades that came to a result; files count them in the order of the evaluation.
struct Strip {
  int index = 0;
  const BlockEvaluation* block = nullptr;
  const CutEvaluation* cut = nullptr;
};
std::vector<Strip> stripsOf(const Evaluation& evaluation);

/// Where the programs of a strip lie beside those of others: "strip-0", and where there are several blocks in
/// the folder of its block, "column-2/strip-1". Letters that no file system minds stay of the block's id.
std::filesystem::path stripFolder(const Evaluation& evaluation, const Strip& strip);

/// Names a strip in front of a word, "column-2: ", where there are several.
std::string stripTitle(const Evaluation& evaluation, const Strip& strip);

/// How a block lies for a cut, in words: "the front face up, turned by 90°"; empty where as it is placed.
std::string lyingText(const Cut& cut);

/// By how much planes that turn are turned, the first and the last one of their block and the others at most
/// either way, degrees.
struct PlanesTurned {
  double first = 0, last = 0, least = 0, most = 0;
  static PlanesTurned of(const PlaneFamily& planes);
};
/// The same in words; empty where planes are parallel.
std::string turningText(const PlaneFamily& planes, const Box& block);

/// Programs of all strips of the blocks wanted in the formats of the design, each in its folder, that of the
/// only one in `ofOne`. An unknown format is an error naming the nearest one, and so is a program that fails
/// its check. Where the findings of its block, or those that concern all, hold errors, its RAPID is left out
/// unless `policy` says otherwise; motions as CSV and JSON, which no robot runs, are written all the same.
/// `evaluation.programs` gets what the check warns of, after `ProgramDespiteErrors` where errors stand
/// against the program: an error if it is left out, a warning if it is marked.
Result<FileSet> programFiles(Evaluation& evaluation, const Cell& cell, const std::string& name,
                             const Policy& policy, const std::filesystem::path& ofOne);

/// A surface and the name of its object.
struct NamedGrid {
  std::string name;
  const SurfaceGrid* grid = nullptr;
};
/// Surfaces as Wavefront OBJ.
std::string objText(const std::vector<NamedGrid>& grids);

}  // namespace bw::pipeline
