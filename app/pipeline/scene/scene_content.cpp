// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/pipeline/scene_content.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "bw/core/parts/crease.h"
#include "bw/core/text/number_text.h"
#include "bw/pipeline/overall.h"
#include "crossings.h"
#include "report_picture.h"

namespace bw::pipeline {

namespace {

/// Points of a drawn curve; a blade bends gently.
constexpr int kCurvePoints = 65;
/// mm of travel between the lines that mark a stretch of told blades.
constexpr double kMarkSpacing = 10;

/// The longest stretch of a station's curve that no other cut takes; `depths` are those of its row, evenly
/// along it, and are even between two of them. A point where everything is taken.
std::vector<Eigen::Vector3d> leftOf(const std::vector<Eigen::Vector3d>& curve,
                                    std::span<const double> depths) {
  const auto crossing = [&](std::size_t in, std::size_t out) {
    const double part = depths[in] / (depths[in] - depths[out]);
    return std::isfinite(part) ? part : 1.0;
  };
  double from = 0, to = 0;
  for (std::size_t begin = 0; begin < depths.size(); ++begin) {
    if (depths[begin] < 0) continue;
    std::size_t end = begin;
    while (end + 1 < depths.size() && depths[end + 1] >= 0) ++end;
    const double first = begin > 0 ? double(begin) - crossing(begin, begin - 1) : 0;
    const double last = end + 1 < depths.size() ? double(end) + crossing(end, end + 1) : double(end);
    if (last - first > to - from) {
      from = first;
      to = last;
    }
    begin = end;
  }
  if (!(to > from)) return {curve.front(), curve.front()};
  const double ofCurve = double(curve.size() - 1) / double(depths.size() - 1);
  const auto at = [&](double place) {
    const auto k = std::min(std::size_t(place), curve.size() - 2);
    return Eigen::Vector3d(curve[k] + (place - double(k)) * (curve[k + 1] - curve[k]));
  };
  from *= ofCurve;
  to *= ofCurve;
  std::vector<Eigen::Vector3d> left = {at(from)};
  for (auto k = std::size_t(from) + 1; double(k) < to; ++k) left.push_back(curve[k]);
  left.push_back(at(to));
  return left;
}

/// A crease, told apart by whether it is as far from that designed as the tolerance lets it; a stretch that
/// no crease designed is near to is beyond.
scene::Creases linesOf(const Crease& crease, double tolerance) {
  scene::Creases lines;
  lines.curves = crease.curves;
  for (std::size_t i = 0; i < crease.curves.size(); ++i) {
    const Polyline& curve = crease.curves[i];
    std::vector<double>& off = lines.off.emplace_back(curve.size(), std::nan(""));
    for (std::size_t k = 0; k < curve.size(); ++k)
      if (i < crease.off.size() && k < crease.off[i].size() && crease.off[i][k]) off[k] = *crease.off[i][k];
    const auto good = [&](std::size_t k) {
      return i < crease.off.size() && k < crease.off[i].size() && crease.off[i][k] &&
             *crease.off[i][k] <= tolerance;
    };
    std::optional<bool> within;
    for (std::size_t k = 0; k + 1 < curve.size(); ++k) {
      const bool now = good(k) && good(k + 1);
      std::vector<scene::Polyline>& those = now ? lines.within : lines.beyond;
      if (within != now) those.push_back({curve[k]});
      within = now;
      those.back().push_back(curve[k + 1]);
    }
  }
  return lines;
}

/// Where the cut surfaces of a block cross while a hand moves them: not measured, and whole, as these are.
/// Of two that are as they were `before`, nothing.
void addCrossings(scene::Content& content, int block, const std::vector<CutSketch>& cuts,
                  const std::vector<CutSketch>* before) {
  std::vector<TriangleMesh> meshes, former;
  const auto meshOf = [](std::vector<TriangleMesh>& made, const std::vector<CutSketch>& of, std::size_t i) {
    made.resize(of.size());
    if (made[i].triangles.empty()) made[i] = of[i].look->cut.triangles();
    return &made[i];
  };
  for (std::size_t a = 0; a < cuts.size(); ++a)
    for (std::size_t b = a + 1; b < cuts.size(); ++b) {
      const auto same = [&](std::size_t i) {
        return before && (*before)[i].look == cuts[i].look && (*before)[i].setup == cuts[i].setup;
      };
      if (same(a) && same(b)) continue;
      scene::Creases lines{
          crossings(*meshOf(meshes, cuts, a), *meshOf(meshes, cuts, b), cuts[a].setup->block), {}};
      // None is told where there was one.
      const bool told = !lines.within.empty() ||
                        (before && !crossings(*meshOf(former, *before, a), *meshOf(former, *before, b),
                                              (*before)[a].setup->block)
                                        .empty());
      if (told) content.add({block, int(a), int(b)}, std::move(lines));
    }
}

void addCut(scene::Content& content, const scene::ItemId& row, SurfaceGrid cut, const Sweep& sweep,
            double tolerance, std::vector<double> depths = {}, std::span<const int> rows = {}) {
  const Blade& blade = sweep.request.blade;
  scene::Stations stations;
  scene::Blades blades;
  const auto columns = std::size_t(cut.columns);
  for (std::size_t i = 0; i < sweep.poses.size(); ++i) {
    const BladePose& pose = sweep.poses[i];
    stations.lines.push_back(pose.cutPoints(kCurvePoints));
    if (!depths.empty() && i < rows.size())
      stations.lines.back() =
          leftOf(stations.lines.back(), std::span(depths).subspan(std::size_t(rows[i]) * columns, columns));
    blades.lines.push_back(pose.bladePoints(kCurvePoints));
  }
  content.add(row, scene::CutSurface{std::move(cut),
                                     std::move(depths),
                                     {{"curvature", 1.0},
                                      {"stress", blade.stress(blade.maxCurvature())},
                                      {"grip_error", tolerance}}});
  content.add(row, std::move(stations));
  content.add(row, std::move(blades));
}

/// Of the blocks that a design places those whose id is none of `known`.
std::vector<const StockBlock*> othersThan(const Design& design, const std::set<std::string>& known) {
  constexpr std::size_t kMostDrawn = 32;
  std::vector<const StockBlock*> others;
  for (const StockBlock& block : design.stock)
    if (block.placement && !known.contains(block.id)) others.push_back(&block);
  if (others.size() > kMostDrawn) others.clear();
  return others;
}

std::vector<const StockBlock*> othersThan(const Evaluation& evaluation) {
  std::set<std::string> known;
  for (const BlockEvaluation& block : evaluation.blocks) known.insert(block.id);
  return othersThan(evaluation.design, known);
}

void addOutlines(scene::Content& content, int first, const std::vector<const StockBlock*>& blocks) {
  for (const StockBlock* block : blocks) content.add({first++}, block->placement->box());
}

/// What a picture shows of a sketch, or of that what is another than `before`, which is of as many cuts.
scene::Content contentOf(const Sketch& sketch, const Sketch* before) {
  scene::Content content;
  std::set<const TriangleMesh*> shown;  // several cuts may be of one surface, which is drawn once
  const auto each = [&](const auto& step) {
    for (int b = 0; b < int(sketch.blocks.size()); ++b)
      for (int c = 0; c < int(sketch.blocks[std::size_t(b)].size()); ++c)
        step(b, c, sketch.blocks[std::size_t(b)][std::size_t(c)],
             before ? &before->blocks[std::size_t(b)][std::size_t(c)] : nullptr);
  };
  each([&](int b, int c, const CutSketch& cut, const CutSketch* was) {
    if (shown.insert(cut.target.get()).second && (!was || was->target != cut.target))
      content.add({b, c}, *cut.target);
  });
  each([&](int b, int c, const CutSketch& cut, const CutSketch* was) {
    if (!was || was->setup != cut.setup) {
      if (c == 0) content.add({b}, cut.setup->block);
      content.add({b, c}, scene::Travel{cut.setup->planes.direction()});
    }
    if (!was || was->look != cut.look)
      addCut(content, {b, c, 0}, cut.look->cut, *cut.sweep, sketch.design.process.tolerance);
  });
  for (std::size_t b = 0; b < sketch.blocks.size(); ++b)
    addCrossings(content, int(b), sketch.blocks[b], before ? &before->blocks[b] : nullptr);
  return content;
}

}  // namespace

scene::Content sceneContent(const Sketch& sketch) {
  scene::Content content = contentOf(sketch, nullptr);
  std::set<std::string> known;
  for (const std::vector<CutSketch>& block : sketch.blocks)
    for (const CutSketch& cut : block)
      known.insert(std::ranges::find(sketch.design.cuts, cut.id, &Cut::id)->block);
  addOutlines(content, int(sketch.blocks.size()), othersThan(sketch.design, known));
  return content;
}

std::optional<scene::Content> sceneChange(const Sketch& sketch, const Sketch& before) {
  if (sketch.design.process.tolerance != before.design.process.tolerance ||
      !std::ranges::equal(sketch.blocks, before.blocks, [](const auto& cuts, const auto& were) {
        return std::ranges::equal(cuts, were, {}, &CutSketch::id, &CutSketch::id);
      }))
    return {};
  return contentOf(sketch, &before);
}

scene::Content sceneContent(const Evaluation& evaluation) {
  scene::Content content;
  if (std::ranges::any_of(evaluation.blocks, [](const BlockEvaluation& block) {
        return std::ranges::any_of(block.cuts,
                                   [](const CutEvaluation& cut) { return cut.result().has_value(); });
      }))
    content.covered = overallOf(evaluation).covered;
  std::set<const TriangleMesh*> shown;  // several cuts may be of one surface, which is drawn once
  for (int b = 0; b < int(evaluation.blocks.size()); ++b) {
    const std::vector<CutEvaluation>& cuts = evaluation.blocks[std::size_t(b)].cuts;
    for (int c = 0; c < int(cuts.size()); ++c)
      if (const auto& mesh = cuts[std::size_t(c)].targetMesh.value; mesh && shown.insert(mesh.get()).second)
        content.add({b, c}, *mesh);
  }
  if (evaluation.faceMesh.value) content.add({}, scene::Faces{evaluation.faceMesh.value});
  for (std::size_t i = 0; i < evaluation.told.size(); ++i) {
    const auto& told = evaluation.told[i];
    if (!told.value || told.value->empty()) continue;
    scene::ToldMarks marks;
    for (const ToldStretch& stretch : *told.value)
      std::ranges::move(markedBlades(*told.request.surface, stretch, kMarkSpacing),
                        std::back_inserter(marks.lines));
    content.add({-1, int(i)}, std::move(marks));
  }
  for (int b = 0; b < int(evaluation.blocks.size()); ++b) {
    const BlockEvaluation& block = evaluation.blocks[std::size_t(b)];
    if (const CutEvaluation& first = block.cuts.front(); first.setup)
      content.add({b}, first.block());
    else if (evaluation.design.stock.size() > std::size_t(b) &&
             evaluation.design.stock[std::size_t(b)].placement)
      content.add({b}, evaluation.design.stock[std::size_t(b)]
                           .placement->box());  // it misses the surface: shown where it was put
    for (int c = 0; c < int(block.cuts.size()); ++c)
      if (const auto& own = block.cuts[std::size_t(c)].setup)
        content.add({b, c}, scene::Travel{own->planes.direction()});
    if (block.part.value) content.add({b}, scene::FoamPart{block.part.value->mesh, block.cuts.size() < 2});
    if (block.together.value)
      for (const Crease& crease : block.together.value->creases)
        content.add({b, int(crease.first), int(crease.second)},
                    linesOf(crease, evaluation.design.process.tolerance));
    for (int c = 0; c < int(block.cuts.size()); ++c) {
      const std::optional<CutResult> result = block.cuts[std::size_t(c)].result();
      if (!result) continue;
      SurfaceGrid cut = result->analysis.cut;
      cut.fields.push_back(certaintyField(result->rest, result->analysis.stationRow, cut));
      const CutsTogether* together = block.together.value.get();
      addCut(content, {b, c, 0}, std::move(cut), result->sweep, evaluation.design.process.tolerance,
             together ? together->depths[std::size_t(c)] : std::vector<double>(),
             result->analysis.stationRow);
    }
  }
  addOutlines(content, int(evaluation.blocks.size()), othersThan(evaluation));
  return content;
}

std::vector<std::string> blocksLeftOut(const Evaluation& evaluation) {
  std::vector<std::string> ids;
  for (const StockBlock* block : othersThan(evaluation)) ids.push_back(block->id);
  return ids;
}

std::optional<scene::Marker> uncoveredMark(const Evaluation& evaluation) {
  const Coverage* worst = nullptr;
  for (const BlockEvaluation& block : evaluation.blocks)
    for (const CutEvaluation& cut : block.cuts)
      if (const Coverage* own = cut.coverage.value.get();
          own && own->distance > own->limit && (!worst || own->distance > worst->distance))
        worst = own;
  if (!worst) return {};
  return scene::Marker{
      worst->point, "Not cut: the surface reaches " + shortText(worst->distance) + " mm beyond the cut here",
      Severity::error};
}

Result<void> PictureList::add(scene::View view, bool parallel, const char* name, const char* title) {
  if (context_.stopped()) return stoppedError();
  constexpr int kWidth = kReportPictureWidth, kHeight = kReportPictureHeight;
  const auto [camera, isNew] = cameras_.try_emplace({view, parallel, scene_.legendRange().has_value()});
  if (isNew) camera->second = scene_.fitFrom(scene::directionOf(view), parallel, {kWidth, kHeight});
  scene_.setCamera(camera->second);
  Result<scene::Picture> picture = scene_.render(kWidth, kHeight);
  if (!picture) return tl::unexpected<Error>(picture.error());
  const std::launch when = context_.threads == 1 ? std::launch::deferred : std::launch::async;
  drawn_.push_back(
      {name, title, std::async(when, [picture = std::move(*picture)] { return scene::pngBytes(picture); })});
  return {};
}

Result<std::vector<ReportPicture>> PictureList::take() {
  std::vector<ReportPicture> pictures;
  for (Drawn& drawn : drawn_) {
    if (context_.stopped()) return stoppedError();
    Result<std::string> png = drawn.png.get();
    if (!png) return tl::unexpected<Error>(png.error());
    pictures.push_back({drawn.name, drawn.title, std::move(*png), kReportPictureWidth, kReportPictureHeight});
  }
  drawn_.clear();
  return pictures;
}

Result<std::vector<ReportPicture>> reportPictures(const Evaluation& evaluation, const RunContext& context) {
  scene::Scene scene;
  scene.setContent(sceneContent(evaluation));
  PictureList pictures(scene, context);
  for (const PictureOfReport& wanted : kReportPictures) {
    if (!isOf(wanted, evaluation)) continue;
    scene::Style style;
    style[scene::Kind::cut].map = wanted.field;
    style.tolerance = evaluation.design.process.tolerance;
    style.marker = uncoveredMark(evaluation);
    scene.setStyle(style);
    if (Result<void> ok = pictures.add(wanted.above ? scene::View::top : scene::View::iso, wanted.above,
                                       wanted.name, wanted.title);
        !ok)
      return tl::unexpected<Error>(ok.error());
  }
  return pictures.take();
}

}  // namespace bw::pipeline
