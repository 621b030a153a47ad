// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// What is shown of the handles of a surface: themselves, where they may go, what they snapped to and words.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "bw/core/base/frame.h"
#include "bw/core/shape/key_blades.h"
#include "bw/core/text/number_text.h"
#include "controls/numbers.h"
#include "window/handle_ray.h"
#include "window/handle_reach.h"
#include "window/surface_handles.h"
#include "workbench/block_layout.h"
#include "workflow/section_edits.h"

namespace bw::app {

namespace {

constexpr int kCurveParts = 32;  // of a key blade

}  // namespace

double SurfaceHandles::heightOf(const DesignedSurface& surface, int handle) const {
  return numberOf(surface, handle, HandleNumber::height).value_or(0);
}

QString SurfaceHandles::nameOf(int handle) const {
  const DesignedSurface* surface = surfaceOf(bench_);
  if (const auto* poles = surface ? std::get_if<PolesSurface>(&surface->shape) : nullptr)
    return tr("Pole %1 of %2")
        .arg(handle % poles->columns + 1)
        .arg(curveTitle(bench_, std::size_t(handle / poles->columns)));
  if (const auto* sections = surface ? std::get_if<SectionsSurface>(&surface->shape) : nullptr)
    for (std::size_t i = 0; i < sections->sections.size(); ++i) {
      const int count = int(sections->sections[i].points.size());
      if (handle < count) return tr("Point %1 of %2").arg(handle + 1).arg(curveTitle(bench_, i));
      handle -= count;
    }
  if (const std::optional<int> blade = surface ? bladeOf(*surface, handle) : std::nullopt) {
    const std::optional<int> end = endOf(*surface, handle);
    return (!end        ? tr("Middle of %1")
            : *end == 0 ? tr("−x end of %1")
                        : tr("+x end of %1"))
        .arg(curveTitle(bench_, std::size_t(*blade)));
  }
  return {};
}

void SurfaceHandles::applyTo(scene::Style& style) const {
  style.handles = {};
  const DesignedSurface* surface = surfaceOf(bench_);
  if (!shown_ || !surface || style.chooseFaces) return;
  scene::Handles& handles = style.handles;
  handles.points = places();
  const auto join = [&](int a, int b) { handles.lines.push_back({a, b}); };
  if (const auto* poles = std::get_if<PolesSurface>(&surface->shape)) {
    for (int row = 0; row < poles->rows; ++row)
      for (int column = 0; column < poles->columns; ++column) {
        const int at = row * poles->columns + column;
        if (column > 0) join(at - 1, at);
        if (row > 0) join(at - poles->columns, at);
      }
  } else if (const auto* sections = std::get_if<SectionsSurface>(&surface->shape)) {
    int at = 0;
    for (const SectionCurve& section : sections->sections) {
      for (std::size_t k = 1; k < section.points.size(); ++k) join(at + int(k) - 1, at + int(k));
      at += int(section.points.size());
    }
  } else if (const auto* blades = std::get_if<BladesSurface>(&surface->shape)) {
    const Eigen::Matrix3d turned = rotationFromAngles(surface->rotation);
    for (const KeyBlade& blade : blades->blades) {
      if (const Result<Elastica> curve = elasticaOf(blade)) {
        scene::Polyline& line = handles.curves.emplace_back();
        for (const Eigen::Vector2d& p : curve->sample(kCurveParts + 1))
          line.push_back(surface->origin + turned * blade.placed(p));
      }
    }
    for (std::size_t k = 1; k < blades->blades.size(); ++k) join(int(k) - 1, int(k));
  }
  handles.chosen = chosen_;
  if (habits_.symmetric)
    for (const int handle : chosen_)
      if (const int mirror = mirrorOf(*surface, handle); mirror >= 0) handles.chosen.push_back(mirror);
  handles.lit = pull_ && (pull_->held || hovered_ < 0) ? pull_->handle : hovered_;
  if (handles.lit < 0 || std::size_t(handles.lit) >= handles.points.size()) return;
  const double height = heightOf(*surface, handles.lit);
  handles.text = tr("%1: %2").arg(nameOf(handles.lit), lengthText(height)).toStdString();
  if (!pull_ || handles.lit != pull_->handle) return;
  handles.text += pullText();
  markSnaps(handles);
  const std::optional<pipeline::Reach>& reach = bench_.runner().reach();
  handles.stopped = !pull_->stoppedBy.isEmpty() || (reach && reach->now != pipeline::Bar::none);
  if (reach && reach->now == pipeline::Bar::none) handles.ways = ways(*reach);
  if (const std::optional<pipeline::Region>& around = bench_.runner().region())
    handles.region = region(*around);
}

scene::HandleRegion SurfaceHandles::region(const pipeline::Region& region) const {
  constexpr std::size_t kLeast = 4;  // rays: fewer enclose nothing
  scene::HandleRegion shown;
  if (region.rays.size() < kLeast) return shown;
  const Eigen::Vector3d from = placesOf(pull_->base)[std::size_t(pull_->handle)];
  std::vector<char> stops;
  for (const pipeline::Region::Ray& ray : region.rays) {
    const double ordered = orderedBy(ray.free, ray.way);
    shown.corners.push_back(from + wayBy(ordered * ray.way));
    stops.push_back(ray.bar != pipeline::Bar::none || ordered < ray.free);
  }
  for (std::size_t k = 0; k < stops.size(); ++k)
    shown.ends.push_back(stops[k] && stops[(k + 1) % stops.size()]);
  return shown;
}

std::vector<scene::HandleWay> SurfaceHandles::ways(const pipeline::Reach& reach) const {
  const auto& [below, above] = reach.ends;
  const auto& [lowest, highest] = pull_->ordered;
  const std::vector<Eigen::Vector3d> from = placesOf(pull_->base);
  std::vector<scene::HandleWay> ways;
  const auto add = [&](int handle, const Eigen::Vector2d& along) {
    if (along.isZero()) return;  // what lies in the middle stays there
    const Eigen::Vector3d& start = from[std::size_t(handle)];
    ways.push_back({start + wayBy(std::max(below.free, lowest) * along),
                    start + wayBy(std::min(above.free, highest) * along),
                    below.bar != pipeline::Bar::none || lowest > below.free,
                    above.bar != pipeline::Bar::none || highest < above.free});
  };
  const Eigen::Vector2d& along = pull_->along;
  const std::vector<int> moved = held();
  for (const int handle : moved) {
    const int mirror = habits_.symmetric ? mirrorOf(pull_->base, handle) : -1;
    add(handle, mirror == handle ? Eigen::Vector2d(0, along.y()) : along);
    if (mirror >= 0 && std::ranges::find(moved, mirror) == moved.end()) add(mirror, {-along.x(), along.y()});
  }
  return ways;
}

std::vector<Snap> SurfaceHandles::snapped() const {
  // Not where it was stopped on its way there.
  return pull_ && pull_->by == pull_->wished ? pull_->snaps : std::vector<Snap>();
}

SnapThings SurfaceHandles::snapThings() const {
  SnapThings things;
  const std::vector<StockBlock>& stock = bench_.design().stock;
  for (const StockBlock& block : stock) {
    const std::optional<BlockPlacement> placed =
        block.id == bench_.block().id ? placementOf(bench_) : block.placement;
    const QString name = stock.size() > 1 ? QString::fromStdString(block.id) : tr("the block");
    if (placed) things.blocks.push_back({name, placed->box()});
  }
  const std::vector<Eigen::Vector3d> places = placesOf(pull_->base);
  const std::vector<Eigen::Vector3d> moved =
      placesOf(movedBy(pull_->base, held(), {0, 1}, habits_.symmetric));
  for (std::size_t i = 0; i < places.size(); ++i)
    if (moved[i] == places[i]) things.points.push_back({withinSentence(nameOf(int(i))), places[i]});
  return things;
}

void SurfaceHandles::markSnaps(scene::Handles& handles) const {
  const std::vector<Snap> snaps = snapped();
  if (snaps.empty()) return;
  for (const Snap& snap : snaps) handles.curves.push_back({snap.line[0], snap.line[1]});
  if (scene::Polyline mark = meetingMark(*view_, handles.points[std::size_t(pull_->handle)]); !mark.empty())
    handles.curves.push_back(std::move(mark));
}

std::string SurfaceHandles::pullText() const {
  const auto changed = [&](HandleNumber which) {
    return *numberOf(*surfaceOf(bench_), pull_->handle, which) - *numberOf(pull_->from, pull_->handle, which);
  };
  const auto number = [](double mm) {
    return (mm < 0 ? "−" : "+") + QString::fromStdString(shortText(std::abs(mm), 4));
  };
  QString text;
  if (pull_->along.y() != 0) text = " (" + number(changed(HandleNumber::height)) + ")";
  if (pull_->along.x() != 0)
    text += tr(", across %1 mm (%2)")
                .arg(QString::fromStdString(
                         shortText(*numberOf(*surfaceOf(bench_), pull_->handle, HandleNumber::across), 5)),
                     number(changed(HandleNumber::across)));
  const std::optional<pipeline::Reach>& reach = bench_.runner().reach();
  if (reach && reach->now != pipeline::Bar::none) {
    text += "\n" + tr("Not to be cut as it is: %1").arg(wordsOf(reach->now));
  } else if (const int together = reach ? movingTogether() : 0; together > 1) {
    // The way of one of them would be another.
    QStringList ends;
    for (const pipeline::Reach::End& end : reach->ends)
      if (end.bar != pipeline::Bar::none) ends << number(end.free);
    if (!ends.isEmpty())
      text += "\n" + tr("%1 handles together: %2 mm at most").arg(together).arg(ends.join(", "));
  }
  if (!pull_->stoppedBy.isEmpty()) text += "\n" + tr("Goes no farther: %1").arg(pull_->stoppedBy);
  if (reach && !reach->knows(pull_->by) && lagsBehind())
    text += "\n" + tr("The surface is still on its way: how far it may go is being looked at");
  QStringList things;
  for (const Snap& snap : snapped()) things << snap.words;
  if (!things.isEmpty()) text += "\n" + tr("Snapped to %1").arg(things.join(tr(" and ")));
  return text.toStdString();
}

}  // namespace bw::app
