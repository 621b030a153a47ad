// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/surface_handles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "bw/core/base/frame.h"
#include "bw/core/text/number_text.h"
#include "controls/numbers.h"
#include "workflow/section_edits.h"

namespace bw::app {

namespace {

constexpr double kCoarse = 10;       // steps
constexpr double kFine = 0.1;        // mm
constexpr double kFarthest = 400;    // mm that a handle is moved at once
constexpr double kSteepest = 0.999;  // cosine between the way and the line of sight

const DesignedSurface* surfaceOf(const Workbench& bench) {
  return bench.source().surface ? &*bench.source().surface : nullptr;
}

}  // namespace

SurfaceHandles::SurfaceHandles(Workbench& bench, view::SceneView* view)
    : QObject(view), bench_(bench), view_(view) {
  connect(view, &view::SceneView::handlePressed, this, &SurfaceHandles::press);
  connect(view, &view::SceneView::handleMoved, this, &SurfaceHandles::move);
  connect(view, &view::SceneView::handleReleased, this, &SurfaceHandles::release);
  connect(view, &view::SceneView::handleHovered, this, &SurfaceHandles::hover);
  connect(view, &view::SceneView::picked, this, [this] { choose({}); });
  connect(&bench, &Workbench::changed, this, &SurfaceHandles::follow);
  connect(&bench.runner(), &model::EvaluationRunner::reached, this, &SurfaceHandles::keepWithin);
}

void SurfaceHandles::setShown(bool shown) {
  if (std::exchange(shown_, shown) == shown) return;
  view_->letGo();
  emit changed();
}

bool SurfaceHandles::possible() const {
  const DesignedSurface* surface = surfaceOf(bench_);
  return surface && !std::holds_alternative<FormulaSurface>(surface->shape);
}

std::vector<Eigen::Vector3d> SurfaceHandles::places() const {
  std::vector<Eigen::Vector3d> places;
  const DesignedSurface* surface = surfaceOf(bench_);
  if (!surface) return places;
  const Eigen::Matrix3d turned = rotationFromAngles(surface->rotation);
  const auto add = [&](double x, double y, double z) {
    places.push_back(surface->origin + turned * Eigen::Vector3d(x, y, z));
  };
  if (const auto* poles = std::get_if<PolesSurface>(&surface->shape)) {
    for (int row = 0; row < poles->rows; ++row)
      for (int column = 0; column < poles->columns; ++column) {
        const SurfacePole& pole = poles->at(row, column);
        const Eigen::Vector2d place = poles->place(row, column) + pole.moved;
        add(place.x(), place.y(), pole.height);
      }
  } else if (const auto* sections = std::get_if<SectionsSurface>(&surface->shape)) {
    for (const SectionCurve& section : sections->sections)
      for (const Eigen::Vector2d& point : section.points) add(point.x(), section.y, point.y());
  } else if (const auto* blades = std::get_if<BladesSurface>(&surface->shape)) {
    for (const KeyBlade& blade : blades->blades) add(blade.middle.x(), blade.y, blade.middle.y());
  }
  return places;
}

Eigen::Vector3d SurfaceHandles::way() const {
  const DesignedSurface* surface = surfaceOf(bench_);
  return surface ? Eigen::Vector3d(rotationFromAngles(surface->rotation).col(2)) : Eigen::Vector3d::UnitZ();
}

void SurfaceHandles::choose(std::vector<int> handles) {
  if (std::exchange(chosen_, std::move(handles)) == chosen_) return;
  emit chosenChanged();
  emit changed();
}

void SurfaceHandles::setSymmetric(bool on) {
  if (std::exchange(symmetric_, on) == on) return;
  emit chosenChanged();  // others move together now
  emit changed();
}

std::optional<SectionPoint> SurfaceHandles::sectionPoint() const {
  const DesignedSurface* surface = surfaceOf(bench_);
  return surface && shown_ && chosen_.size() == 1 ? sectionPointOf(*surface, chosen_.back()) : std::nullopt;
}

void SurfaceHandles::addPoint() {
  const std::optional<SectionPoint> at = sectionPoint();
  if (!at) return;
  if (const auto added = app::addPoint(bench_, std::size_t(at->section), std::size_t(at->point)))
    choose({handleOf(*surfaceOf(bench_), {at->section, int(*added)})});
}

void SurfaceHandles::removePoint() {
  if (const std::optional<SectionPoint> at = sectionPoint())
    if (app::removePoint(bench_, std::size_t(at->section), std::size_t(at->point))) choose({});
}

void SurfaceHandles::addSection() {
  const std::optional<SectionPoint> at = sectionPoint();
  if (at && app::addSection(bench_, std::size_t(at->section)))
    choose({handleOf(*surfaceOf(bench_), {at->section + 1, 0})});
}

void SurfaceHandles::removeSection() {
  if (const std::optional<SectionPoint> at = sectionPoint())
    if (app::removeSection(bench_, std::size_t(at->section))) choose({});
}

void SurfaceHandles::tellChosen(bool on) {
  if (std::exchange(told_, on) != on) emit changed();
}

std::optional<double> SurfaceHandles::along(const QPointF& position, const Eigen::Vector3d& through) const {
  const auto [origin, sight] = view_->rayAt(position);
  const Eigen::Vector3d up = way();
  const double cosine = sight.dot(up);
  if (std::abs(cosine) > kSteepest) return {};
  const Eigen::Vector3d from = origin - through;
  return (from.dot(up) - cosine * from.dot(sight)) / (1 - cosine * cosine);
}

double SurfaceHandles::heightOf(const DesignedSurface& surface, int handle) const {
  return numberOf(surface, handle, HandleNumber::height).value_or(0);
}

QString SurfaceHandles::nameOf(int handle) const {
  const DesignedSurface* surface = surfaceOf(bench_);
  if (const auto* poles = surface ? std::get_if<PolesSurface>(&surface->shape) : nullptr)
    return tr("Pole %1 of row %2").arg(handle % poles->columns + 1).arg(handle / poles->columns + 1);
  if (const auto* sections = surface ? std::get_if<SectionsSurface>(&surface->shape) : nullptr)
    for (std::size_t i = 0; i < sections->sections.size(); ++i) {
      const int count = int(sections->sections[i].points.size());
      if (handle < count) return tr("Point %1 of section %2").arg(handle + 1).arg(i + 1);
      handle -= count;
    }
  if (surface && std::holds_alternative<BladesSurface>(surface->shape))
    return tr("Middle of key blade %1").arg(handle + 1);
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
    for (std::size_t k = 1; k < blades->blades.size(); ++k) join(int(k) - 1, int(k));
  }
  handles.chosen = chosen_;
  if (symmetric_)
    for (const int handle : chosen_)
      if (const int mirror = mirrorOf(*surface, handle); mirror >= 0) handles.chosen.push_back(mirror);
  handles.lit = pull_ ? pull_->handle : hovered_ < 0 && told_ && !chosen_.empty() ? chosen_.back() : hovered_;
  if (handles.lit < 0 || std::size_t(handles.lit) >= handles.points.size()) return;
  const double height = heightOf(*surface, handles.lit);
  handles.text = tr("%1: %2").arg(nameOf(handles.lit), lengthText(height)).toStdString();
  if (!pull_) return;
  const double by = height - heightOf(pull_->from, handles.lit);
  handles.text += (by < 0 ? " (−" : " (+") + shortText(std::abs(by), 4) + ")";
  const Eigen::Vector3d start = handles.points[std::size_t(handles.lit)] - by * way();
  if (const std::optional<pipeline::Reach>& reach = bench_.runner().reach()) {
    const auto& [below, above] = reach->ends;
    if (reach->now != pipeline::Bar::none) {
      handles.stopped = true;
      handles.text += "\n" + tr("Not to be cut as it is: %1").arg(wordsOf(reach->now)).toStdString();
    } else {
      handles.way = scene::HandleWay{start + below.free * way(), start + above.free * way(),
                                     below.bar != pipeline::Bar::none, above.bar != pipeline::Bar::none};
    }
  }
  if (!pull_->stoppedBy) return;
  handles.stopped = true;
  handles.text += "\n" + tr("Goes no farther: %1").arg(wordsOf(*pull_->stoppedBy)).toStdString();
}

void SurfaceHandles::press(int handle, const QPointF& position, Qt::KeyboardModifiers keys) {
  const DesignedSurface* surface = surfaceOf(bench_);
  const std::vector<Eigen::Vector3d> all = places();
  if (!surface || std::size_t(handle) >= all.size()) return view_->letGo();
  const auto known = std::ranges::find(chosen_, handle);
  if (keys & Qt::ShiftModifier) {
    if (known == chosen_.end())
      chosen_.push_back(handle);
    else
      chosen_.erase(known);
  } else if (known == chosen_.end()) {
    chosen_ = {handle};
  } else {  // the one that numbers are typed for
    std::rotate(known, known + 1, chosen_.end());
  }
  emit chosenChanged();
  pull_ =
      Pull{handle, *surface, along(position, all[std::size_t(handle)]).value_or(0), 0, bench_.newMergeId()};
  const Design design = bench_.design();
  bench_.runner().seekReach(
      [design, cut = bench_.cut(), from = *surface, moved = held(), symmetric = symmetric_](double by) {
        Design pulled = design;
        pulled.sourceOf(cut).surface = movedBy(from, moved, Eigen::Vector2d(0, by), symmetric);
        return pulled;
      },
      kFarthest);
  emit changed();
}

void SurfaceHandles::move(int handle, const QPointF& position, Qt::KeyboardModifiers keys) {
  if (!pull_ || pull_->handle != handle) return;
  const double moved = heightOf(*surfaceOf(bench_), handle) - heightOf(pull_->from, handle);
  const Eigen::Vector3d start = places()[std::size_t(handle)] - moved * way();
  const std::optional<double> at = along(position, start);
  if (!at) return;
  double by = *at - pull_->began;
  const bool fine = keys & (Qt::ControlModifier | Qt::AltModifier);
  if (fine) by *= kFine;
  // The height, not the way to it, is a round number.
  const double step = fine ? kFine : keys & Qt::ShiftModifier ? kCoarse * this->step() : this->step();
  const double from = heightOf(pull_->from, handle);
  by = std::round((from + by) / step) * step - from;
  pull_->wished = std::clamp(by, -kFarthest, kFarthest);
  pull_->step = step;
  keepWithin();
}

void SurfaceHandles::keepWithin() {
  if (!pull_) return;
  const std::optional<pipeline::Reach>& reach = bench_.runner().reach();
  double by = pull_->wished;
  const std::optional<pipeline::Bar> before = std::exchange(pull_->stoppedBy, std::nullopt);
  if (reach && reach->now == pipeline::Bar::none)
    for (const pipeline::Reach::End& end : reach->ends) {
      const bool beyond = &end == &reach->ends[0] ? by < end.free : by > end.free;
      if (end.bar == pipeline::Bar::none || !beyond) continue;
      // The last round number before the border.
      const double from = heightOf(pull_->from, pull_->handle), last = (from + end.free) / pull_->step;
      by = (end.free < 0 ? std::ceil(last) : std::floor(last)) * pull_->step - from;
      if ((by > 0) != (end.free > 0)) by = 0;
      pull_->stoppedBy = end.bar;
    }
  if (by != pull_->by)
    pull(by, true);
  else if (pull_->stoppedBy != before || reach)
    emit changed();
}

QString SurfaceHandles::wordsOf(pipeline::Bar bar) {
  switch (bar) {
    case pipeline::Bar::noBlade:
      return tr("no blade can be laid on it");
    case pipeline::Bar::tooTight:
      return tr("the blade would bend sharper than it may");
    case pipeline::Bar::crosses:
      return tr("the blade would cross itself");
    case pipeline::Bar::lost:
      return tr("nothing is known to keep the blade in its shape");
    case pipeline::Bar::tooFar:
      return tr("the blade would leave the surface by more than the tolerance");
    case pipeline::Bar::none:
      break;
  }
  return {};
}

std::vector<int> SurfaceHandles::held() const {
  std::vector<int> held = chosen_;
  if (pull_ && std::ranges::find(held, pull_->handle) == held.end()) held.push_back(pull_->handle);
  return held;
}

void SurfaceHandles::pull(double by, bool live) {
  pull_->by = by;
  pull_->moved = true;
  const std::vector<int> moved = held();
  const DesignedSurface pulled = movedBy(pull_->from, moved, Eigen::Vector2d(0, by), symmetric_);
  const QString text = moved.size() > 1 ? tr("Move %1 handles").arg(moved.size())
                                        : tr("Move %1").arg(nameOf(pull_->handle).toLower());
  bench_.editSurface(
      text, [&](DesignedSurface& surface) { surface = pulled; }, pull_->mergeId, live);
}

void SurfaceHandles::release(int handle, bool givenUp) {
  if (!pull_ || pull_->handle != handle) return;
  const bool moved = pull_->moved;
  if (moved) pull(givenUp ? 0 : pull_->by, false);
  pull_.reset();
  bench_.runner().endReach();
  emit changed();
}

void SurfaceHandles::hover(int handle) {
  hovered_ = handle;
  emit changed();
}

void SurfaceHandles::follow(const Change& change) {
  if (bench_.source().id != source_) {  // the handles are those of another surface
    source_ = bench_.source().id;
    choose({});
    if (!change.any(model::Aspect::design)) return emit changed();
  }
  if (!change.any(model::Aspect::design)) return;
  // Another surface, or an undo while a handle is held.
  const DesignedSurface* surface = surfaceOf(bench_);
  const int count = surface ? int(places().size()) : 0;
  if (std::erase_if(chosen_, [count](int handle) { return handle >= count; }) > 0) emit chosenChanged();
  if (pull_ && (!surface || surface->shape.index() != pull_->from.shape.index() || pull_->handle >= count)) {
    pull_.reset();
    bench_.runner().endReach();
    view_->letGo();
  }
  if (hovered_ >= count) hovered_ = -1;
  emit changed();
}

}  // namespace bw::app
