// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "block_layout.h"

#include <algorithm>
#include <array>

namespace bw::pipeline {

namespace {

constexpr double kLeastMet = 100;  ///< mm² of a surface in a block

/// mm² of a triangle, given in the coordinates of a box, that lies in it.
double areaIn(const std::array<Eigen::Vector3d, 3>& triangle, const Eigen::Vector3d& size) {
  std::vector<Eigen::Vector3d> part(triangle.begin(), triangle.end()), rest;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      const auto inside = [&](const Eigen::Vector3d& p) { return upper ? size(axis) - p(axis) : p(axis); };
      rest.clear();
      for (std::size_t i = 0; i < part.size(); ++i) {
        const Eigen::Vector3d &p = part[i], &q = part[(i + 1) % part.size()];
        const double a = inside(p), b = inside(q);
        if (a >= 0) rest.push_back(p);
        if ((a < 0) != (b < 0)) rest.push_back(p + a / (a - b) * (q - p));
      }
      part.swap(rest);
      if (part.size() < 3) return 0;
    }
  Eigen::Vector3d twice = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < part.size(); ++i)
    twice += Eigen::Vector3d(part[i] - part[0]).cross(Eigen::Vector3d(part[i + 1] - part[0]));
  return 0.5 * twice.norm();
}

/// True if so much of a surface lies in a box that it is cut.
bool meets(const TriangleMesh& mesh, const Box& box) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(mesh.points.size());
  for (const Eigen::Vector3d& p : mesh.points) points.push_back(box.frame.toLocal(p));
  double area = 0;
  for (const auto& corners : mesh.triangles) {
    const std::array<Eigen::Vector3d, 3> triangle = {
        points[std::size_t(corners[0])], points[std::size_t(corners[1])], points[std::size_t(corners[2])]};
    const Eigen::Array3d low = triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]).array(),
                         high = triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]).array();
    if ((high < 0).any() || (low > box.size.array()).any()) continue;
    area += areaIn(triangle, box.size);
    if (area >= kLeastMet) return true;
  }
  return false;
}

const StockBlock& stockBlock(const Design& design, const std::string& id) {
  return *std::ranges::find(design.stock, id, &StockBlock::id);
}

}  // namespace

Result<void> leaveOutMissed(Evaluation& e) {
  BlocksMissed missed;
  missed.of = int(e.blocks.size());
  std::vector<BlockEvaluation> met;
  for (BlockEvaluation& block : e.blocks) {
    if (const std::optional<BlockPlacement>& placement = stockBlock(e.design, block.id).placement)
      std::erase_if(block.cuts, [box = placement->box()](const CutEvaluation& cut) {
        return !meets(*cut.targetMesh.value, box);
      });
    if (block.cuts.empty())
      missed.blocks.push_back(block.id);
    else
      met.push_back(std::move(block));
  }
  e.blocks = std::move(met);
  if (e.blocks.empty()) {
    e.blocks.resize(1);
    return fail(ErrorCode::badInput,
                "none of the " + std::to_string(missed.of) +
                    " blocks is met by the surface; move or enlarge the blocks (grid or stock)",
                "stock");
  }
  if (e.blocks.size() > std::size_t(kMostBlocksMet))
    return fail(ErrorCode::badInput,
                "the surface comes through " + std::to_string(e.blocks.size()) + " blocks; at most " +
                    std::to_string(kMostBlocksMet) +
                    " are evaluated together: take larger blocks, or split the design",
                "stock", double(e.blocks.size()), kMostBlocksMet);
  if (!missed.blocks.empty())
    e.missed = {{e.design.grid ? Severity::info : Severity::warning, std::move(missed)}};
  return {};
}

Cut cutToMake(const Design& design, const std::string& id) {
  Cut cut = *std::ranges::find(design.cuts, id, &Cut::id);
  if (design.grid && !cut.direction) cut.direction = rotationFromAngles(design.grid->rotation).col(1);
  return cut;
}

std::vector<char> joinedCuts(const Evaluation& e) {
  std::vector<BlockRow> rows;
  std::vector<Box> boxes;
  std::vector<const geometry::Target*> surfaces;
  for (const BlockEvaluation& block : e.blocks)
    for (const CutEvaluation& cut : block.cuts) {
      surfaces.push_back(cut.target.value.get());
      const auto first = std::ranges::find(surfaces, surfaces.back());
      rows.push_back({block.id, cut.id, nullptr, int(first - surfaces.begin())});
      boxes.push_back(cut.setup->block);
    }
  if (e.design.process.join == Join::none) return std::vector<char>(rows.size(), 0);
  return joined(rows, boxes, jointRequest(e.design).apart);
}

std::vector<BlockRow> rowsOf(const Evaluation& e) {
  std::vector<BlockRow> rows;
  std::vector<const geometry::Target*> surfaces;
  for (const BlockEvaluation& block : e.blocks)
    for (const CutEvaluation& cut : block.cuts) {
      surfaces.push_back(cut.target.value.get());
      const auto first = std::ranges::find(surfaces, surfaces.back());
      rows.push_back({block.id, cut.id, cut.sweep.value.get(), int(first - surfaces.begin())});
    }
  return rows;
}

Result<void> inBlock(const Evaluation& e, const std::string& block, const Result<void>& result) {
  if (result || e.blocks.size() < 2 || result.error().code == ErrorCode::cancelled) return result;
  Error error = result.error();
  error.message = block + ": " + error.message;
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace bw::pipeline
