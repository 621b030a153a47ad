// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/surface_handles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "bw/core/base/frame.h"
#include "controls/numbers.h"
#include "window/handle_ray.h"
#include "window/handle_reach.h"
#include "workflow/section_edits.h"

namespace bw::app {

namespace {

constexpr double kCoarse = 10;         // steps
constexpr double kAlongTravel = 0.94;  // cosine between it and the line of sight
constexpr double kSameNumber = 1e-4;   // mm
constexpr double kLeastShown = 0.3;    // share of a plane that another shows of it
constexpr std::array kNumbers = {HandleNumber::across, HandleNumber::height};

}  // namespace

SurfaceHandles::SurfaceHandles(Workbench& bench, view::SceneView* view)
    : QObject(view), bench_(bench), view_(view), habits_(bench.settings().handles()) {
  connect(view, &view::SceneView::handlePressed, this, &SurfaceHandles::press);
  connect(view, &view::SceneView::handleMoved, this, &SurfaceHandles::move);
  connect(view, &view::SceneView::handleReleased, this, &SurfaceHandles::release);
  connect(view, &view::SceneView::handleHovered, this, &SurfaceHandles::hover);
  connect(view, &view::SceneView::picked, this, [this] { choose({}); });
  connect(&bench, &Workbench::changed, this, &SurfaceHandles::follow);
  connect(&bench.runner(), &model::EvaluationRunner::reached, this, [this] {
    keepWithin();
    settle(false);
  });
  // An evaluation comes after the first look at what is sought: where there was none, nothing is.
  connect(&bench.runner(), &model::EvaluationRunner::finished, this, [this] {
    const model::EvaluationRunner& runner = bench_.runner();
    settle(!runner.reach() && runner.evaluatedDesign() == bench_.document().design());
  });
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

int SurfaceHandles::count() const { return shown_ ? int(places().size()) : 0; }

std::vector<Eigen::Vector3d> SurfaceHandles::places() const {
  const DesignedSurface* surface = surfaceOf(bench_);
  return surface ? placesOf(*surface) : std::vector<Eigen::Vector3d>();
}

Eigen::Vector3d SurfaceHandles::wayBy(const Eigen::Vector2d& by) const {
  return by.x() * way(HandleNumber::across) + by.y() * way(HandleNumber::height);
}

Eigen::Vector3d SurfaceHandles::way(HandleNumber number) const {
  const DesignedSurface* surface = surfaceOf(bench_);
  const Eigen::Matrix3d turned =
      surface ? rotationFromAngles(surface->rotation) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  return turned.col(number == HandleNumber::height ? 2 : 0);
}

void SurfaceHandles::choose(std::vector<int> handles) {
  if (std::exchange(chosen_, std::move(handles)) == chosen_) return;
  emit chosenChanged();
  emit changed();
}

void SurfaceHandles::setSymmetric(bool on) {
  if (std::exchange(habits_.symmetric, on) == on) return;
  bench_.settings().setHandles(habits_);
  emit chosenChanged();  // others move together now
  if (pull_) seek();
  if (pull_ && pull_->around) seekAround();
  emit changed();
}

void SurfaceHandles::setSnapping(bool on) {
  habits_.snapping = on;
  bench_.settings().setHandles(habits_);
}

void SurfaceHandles::setGrid(double spacing) {
  habits_.grid = spacing;
  bench_.settings().setHandles(habits_);
}

void SurfaceHandles::setMeeting(bool on) {
  habits_.meeting = on;
  bench_.settings().setHandles(habits_);
}

HandSteps SurfaceHandles::steps() const {
  HandSteps steps;
  if (habits_.snapping) steps.plain = habits_.grid;  // fine ones are free of it
  steps.coarse = kCoarse * steps.plain;
  return steps;
}

std::optional<SectionPoint> SurfaceHandles::sectionPoint() const {
  const DesignedSurface* surface = surfaceOf(bench_);
  return surface && shown_ && chosen_.size() == 1 ? sectionPointOf(*surface, chosen_.back()) : std::nullopt;
}

std::optional<int> SurfaceHandles::keyBlade() const {
  const DesignedSurface* surface = surfaceOf(bench_);
  return surface && shown_ && chosen_.size() == 1 ? bladeOf(*surface, chosen_.back()) : std::nullopt;
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
  if (const std::optional<int> blade = keyBlade()) {
    const int after =
        std::min(*blade, int(std::get<BladesSurface>(surfaceOf(bench_)->shape).blades.size()) - 2);
    if (app::addBlade(bench_, std::size_t(after))) choose({after + 1});
    return;
  }
  const std::optional<SectionPoint> at = sectionPoint();
  if (at && app::addSection(bench_, std::size_t(at->section)))
    choose({handleOf(*surfaceOf(bench_), {at->section + 1, 0})});
}

void SurfaceHandles::removeSection() {
  if (const std::optional<int> blade = keyBlade()) {
    if (app::removeBlade(bench_, std::size_t(*blade))) choose({});
    return;
  }
  if (const std::optional<SectionPoint> at = sectionPoint())
    if (app::removeSection(bench_, std::size_t(at->section))) choose({});
}

void SurfaceHandles::duplicate() {
  if (const std::optional<int> blade = keyBlade()) {
    if (app::repeatEntry(bench_, std::size_t(*blade))) choose({*blade + 1});
  } else if (const std::optional<SectionPoint> at = sectionPoint()) {
    if (app::repeatEntry(bench_, std::size_t(at->section)))
      choose({app::handleOf(*surfaceOf(bench_), {at->section + 1, at->point})});
  }
}

std::vector<std::size_t> SurfaceHandles::others() const {
  const DesignedSurface* surface = surfaceOf(bench_);
  if (!surface || !shown_ || chosen_.empty()) return {};
  const std::optional<int> last = entryOf(*surface, chosen_.back());
  std::vector<std::size_t> others;
  for (const int handle : chosen_)
    if (const std::optional<int> entry = entryOf(*surface, handle); entry && entry != last)
      others.push_back(std::size_t(*entry));
  std::ranges::sort(others);
  const auto again = std::ranges::unique(others);
  others.erase(again.begin(), again.end());
  return others;
}

void SurfaceHandles::copyShape() {
  const std::vector<std::size_t> to = others();
  if (to.empty()) return;
  const int from = *entryOf(*surfaceOf(bench_), chosen_.back());
  const std::optional<SectionPoint> at = sectionPointOf(*surfaceOf(bench_), chosen_.back());
  if (!app::copyShape(bench_, std::size_t(from), to) || !at) return;
  // Sections may have other numbers of points now.
  std::vector<int> handles;
  for (const std::size_t entry : to)
    handles.push_back(app::handleOf(*surfaceOf(bench_), {int(entry), at->point}));
  handles.push_back(app::handleOf(*surfaceOf(bench_), *at));
  choose(std::move(handles));
}

void SurfaceHandles::lookBeside(int handle) {
  const std::string cut = bench_.selection().cut;
  bench_.lookBeside(placeOf(handle), chosen_.size() == 1);
  // What is chosen is of another cut, too, and not of the one that was selected.
  if (bench_.selection().cut != cut && bench_.selection().kind != Selection::Kind::station)
    emit chosenChanged();
}

void SurfaceHandles::press(int handle, const QPointF& position, Qt::KeyboardModifiers keys) {
  if (handle >= count()) return;  // another's
  grab(handle, keys);
  lookBeside(handle);
  const Eigen::Vector3d travel = way(HandleNumber::across).cross(way());
  if (std::abs(view_->rayAt(position).second.dot(travel)) < kAlongTravel) pull_->freely = false;
  pull_->began = handAt(position).value_or(Eigen::Vector2d(0, 0));
}

void SurfaceHandles::grab(int handle, Qt::KeyboardModifiers keys) {
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
  const DesignedSurface& surface = *surfaceOf(bench_);
  begin({handle, true, surface, surface, bench_.document().design()});
  pull_->freely = numberOf(surface, handle, HandleNumber::across).has_value();
  emit changed();
}

void SurfaceHandles::begin(Pull pull) {
  pull_ = std::move(pull);
  pull_->mergeId = bench_.newMergeId();
  seek();
}

void SurfaceHandles::seek() {
  pull_->ordered = {orderedBy(-pull_->farthest, pull_->along), orderedBy(pull_->farthest, pull_->along)};
  pull_->stops = {};
  bench_.runner().seekReach(
      [design = bench_.design(), cut = bench_.cut(), base = pull_->base, moved = held(), along = pull_->along,
       symmetric = habits_.symmetric](double by) {
        Design pulled = design;
        pulled.sourceOf(cut).surface = movedBy(base, moved, by * along, symmetric);
        return pulled;
      },
      pull_->farthest);
}

void SurfaceHandles::seekAround() {
  pull_->around = true;
  bench_.runner().seekRegion([design = bench_.design(), cut = bench_.cut(), base = pull_->base,
                              moved = held(), symmetric = habits_.symmetric](const Eigen::Vector2d& by) {
    Design pulled = design;
    pulled.sourceOf(cut).surface = movedBy(base, moved, by, symmetric);
    return pulled;
  });
}

double SurfaceHandles::orderedBy(double by, const Eigen::Vector2d& along) const {
  constexpr int kHalvings = 24;
  const auto ordered = [&](double to) {
    return keepsOrder(pull_->base, movedBy(pull_->base, held(), to * along, habits_.symmetric));
  };
  if (along.x() == 0 || ordered(by)) return by;
  double free = 0, barred = by;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (free + barred);
    (ordered(middle) ? free : barred) = middle;
  }
  return free;
}

std::optional<Eigen::Vector2d> SurfaceHandles::handAt(const QPointF& position) const {
  const Eigen::Vector3d from = placesOf(pull_->base)[std::size_t(pull_->handle)];
  if (pull_->freely) {
    const Eigen::Vector3d x = way(HandleNumber::across), z = way();
    return inPlane(*view_, position, {from, x, z, x.cross(z)});
  }
  const std::optional<double> up = alongWay(*view_, position, from, way());
  return up ? std::optional(Eigen::Vector2d(0, *up)) : std::nullopt;
}

void SurfaceHandles::move(int handle, const QPointF& position, Qt::KeyboardModifiers keys) {
  if (!pull_ || !pull_->held || pull_->handle != handle) return;
  const Eigen::Vector3d from = placesOf(pull_->base)[std::size_t(handle)];
  const QPointF way1 = view_->toWidget(from + way()) - view_->toWidget(from);
  if (const std::optional<Eigen::Vector2d> at = handAt(position))
    drag(*at - pull_->began, 1 / std::hypot(way1.x(), way1.y()), keys);
}

void SurfaceHandles::drag(const Frame& plane, const Eigen::Vector2d& by, double pixel,
                          Qt::KeyboardModifiers keys) {
  const Eigen::Vector3d x = way(HandleNumber::across), z = way();
  // What the plane shows of a way across and of one up.
  const Eigen::Vector2d across(x.dot(plane.x), x.dot(plane.y)), up(z.dot(plane.x), z.dot(plane.y));
  const double shown = across.x() * up.y() - across.y() * up.x();
  Eigen::Vector2d moved(0, by.y() / up.y());
  if (pull_ && pull_->freely && std::abs(shown) > kLeastShown)
    moved = {(by.x() * up.y() - by.y() * up.x()) / shown,
             (across.x() * by.y() - across.y() * by.x()) / shown};
  drag(moved, pixel / std::abs(up.y()), keys);
}

void SurfaceHandles::drag(const Eigen::Vector2d& by, double pixel, Qt::KeyboardModifiers keys) {
  if (!pull_ || !pull_->held) return;
  const auto [step, share] = handPace(keys, steps());
  const double reach = kMeetingReach * pixel;
  Eigen::Vector2d hand = share * by;
  // Nearly straight up or across is meant to be so.
  const Eigen::Vector2d off = by.cwiseAbs();
  const bool middle = habits_.symmetric && mirrorOf(pull_->base, pull_->handle) == pull_->handle;
  if (!pull_->freely || middle || (off.x() < reach && off.x() <= off.y()))
    hand.x() = 0;
  else if (off.y() < reach)
    hand.y() = 0;
  const SnapThings things = habits_.meeting && share == 1 ? snapThings() : SnapThings();
  const Eigen::Vector3d place = placesOf(pull_->base)[std::size_t(pull_->handle)];
  const auto wayOf = [&](int n, const Eigen::Vector2d& from) {
    return SnapWay{place + wayBy(from), way(kNumbers[std::size_t(n)]), way(kNumbers[std::size_t(1 - n)]),
                   n == 1};
  };
  Eigen::Vector2d wished(0, 0);
  std::array<bool, 2> met = {};
  pull_->to = {};
  pull_->beyond = false;
  for (const int n : {0, 1}) {
    if (hand[n] == 0) continue;
    // The number, not the way to it, is a round one.
    const double from = *numberOf(pull_->base, pull_->handle, kNumbers[std::size_t(n)]);
    double to = std::round((from + hand[n]) / step) * step;
    if (const std::optional<Snap> snap = snapTo(things, wayOf(n, {0, 0}), hand[n], reach)) {
      to = withoutNoise(from + snap->by);
      met[std::size_t(n)] = true;
    }
    wished[n] = std::clamp(to - from, -kFarthest, kFarthest);
    if (wished[n] == to - from)
      pull_->to[std::size_t(n)] = to;
    else
      pull_->beyond = true;
  }
  // As they lie where it comes to lie.
  pull_->snaps.clear();
  for (const int n : {0, 1}) {
    Eigen::Vector2d beside = wished;
    beside[n] = 0;
    if (!met[std::size_t(n)]) continue;
    if (const std::optional<Snap> snap = snapTo(things, wayOf(n, beside), wished[n], kSameNumber))
      pull_->snaps.push_back(*snap);
  }
  const Eigen::Vector2d along = wished.isZero()   ? pull_->along
                                : wished.x() == 0 ? Eigen::Vector2d(0, 1)
                                : wished.y() == 0 ? Eigen::Vector2d(1, 0)
                                                  : Eigen::Vector2d(wished.normalized());
  pull_->wished = wished.dot(along);
  pull_->step = step;
  if (along != pull_->along) {
    pull_->along = along;
    pull_->by = std::nan("");  // of another way
    pull_->farthest = std::max(kFarthest, pull_->wished);
    seek();
  }
  if (pull_->freely && !middle && !pull_->around && !wished.isZero()) seekAround();
  keepWithin();
}

void SurfaceHandles::bring(HandleNumber number, double to, double step, bool anyway) {
  settle(true);
  const DesignedSurface* surface = surfaceOf(bench_);
  const std::optional<double> now =
      surface && !chosen_.empty() ? numberOf(*surface, chosen_.back(), number) : std::nullopt;
  if (!now || (pull_ && pull_->held)) return;
  const Eigen::Vector2d along =
      number == HandleNumber::height ? Eigen::Vector2d(0, 1) : Eigen::Vector2d(1, 0);
  if (!pull_) {
    begin({chosen_.back(), false, *surface, *surface, bench_.document().design(), along});
    lookBeside(chosen_.back());
  } else if (pull_->along != along) {
    pull_->base = *surface;
    pull_->along = along;
    pull_->by = 0;
    seek();
  }
  pull_->to = {};
  pull_->beyond = false;
  pull_->to[number == HandleNumber::height ? 1 : 0] = to;
  pull_->wished = to - pulledFrom();
  pull_->step = step;
  if (const double way = std::abs(pull_->wished); way > pull_->farthest) {
    pull_->farthest = way;
    seek();
  }
  if (anyway) pull(pull_->by, true);
  keepWithin();
}

bool SurfaceHandles::takeBack() {
  if (!moving() || pull_->held) return false;
  giveUp();
  endPull();
  return true;
}

QString SurfaceHandles::pullName() const {
  const std::size_t count = held().size();
  return count > 1 ? tr("Move %1 handles").arg(count)
                   : tr("Move %1").arg(withinSentence(nameOf(pull_->handle)));
}

void SurfaceHandles::giveUp() {
  pulling_ = true;
  bench_.editDesign(
      pullName(), [was = pull_->design](Design& design) { design = *was; }, pull_->mergeId);
  pulling_ = false;
}

void SurfaceHandles::endMoves() {
  if (pull_ && !pull_->held) endPull();
}

void SurfaceHandles::endPull() {
  pull_.reset();
  bench_.runner().endReach();
  emit changed();
}

void SurfaceHandles::keepWithin() {
  if (!pull_) return;
  bench_.runner().aimReach(pull_->wished);
  const std::optional<pipeline::Reach>& reach = bench_.runner().reach();
  WithinReach may = withinReach(reach, pull_->wished, pulledFrom(), pull_->step);
  const std::size_t side = pull_->wished < 0 ? 0 : 1;
  if (std::optional<pipeline::Reach::End>& stop = pull_->stops[side]; may.stoppedBy) {
    stop = reach->ends[side];
  } else if (stop && reach && !reach->knows(pull_->wished)) {
    // What sketches barred is looked at once more. Until that is sure it stays, and does not leap to the
    // hand.
    may = {lastBefore(stop->free, pulledFrom(), pull_->step), stop->bar};
  }
  QString why = may.stoppedBy ? wordsOf(*may.stoppedBy) : QString();
  if (may.stoppedBy && reach && !reach->ends[side].known) why += tr("; being looked at more closely");
  double by = may.by;
  if (const double ordered = orderedBy(by, pull_->along); ordered != by) {
    by = lastBefore(ordered, pulledFrom(), pull_->step);
    why = tr("a point may not overtake its neighbour");
  }
  if (why.isEmpty() && pull_->beyond && reach && reach->knows(pull_->wished))
    why = tr("one pull goes %1 mm at most; let go, and pull it again").arg(kFarthest);
  const bool other = std::exchange(pull_->stoppedBy, why) != why;
  if (by != pull_->by)
    pull(by, true);
  else if (other || reach)
    emit changed();
}

std::vector<int> SurfaceHandles::held() const {
  std::vector<int> held = chosen_;
  if (pull_ && std::ranges::find(held, pull_->handle) == held.end()) held.push_back(pull_->handle);
  return held;
}

int SurfaceHandles::movingTogether() const {
  const std::vector<Eigen::Vector3d> before = placesOf(pull_->base),
                                     after = placesOf(
                                         movedBy(pull_->base, held(), pull_->along, habits_.symmetric));
  int count = 0;
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) count += before[i] != after[i];
  return count;
}

bool SurfaceHandles::lagsBehind() const {
  const std::shared_ptr<const pipeline::Sketch> sketch = bench_.runner().sketch();
  const std::shared_ptr<const pipeline::Evaluation> evaluation = bench_.shown();
  if (!sketch && !evaluation) return true;
  const std::vector<Source>& sources = sketch ? sketch->design.sources : evaluation->design.sources;
  const auto shown = std::ranges::find(sources, source_, &Source::id);
  return shown == sources.end() || shown->surface != bench_.source().surface;
}

double SurfaceHandles::pulledFrom() const {
  const Eigen::Vector2d& along = pull_->along;
  if (along.x() != 0 && along.y() != 0) return 0;
  return *numberOf(pull_->base, pull_->handle, along.x() != 0 ? HandleNumber::across : HandleNumber::height);
}

DesignedSurface SurfaceHandles::pulledBy(double by) const {
  const bool atHand = by == pull_->wished;
  Eigen::Vector2d way = by * pull_->along;
  // Stopped on a way aslant, both numbers are the last round ones before there.
  const bool aslant = pull_->along.x() != 0 && pull_->along.y() != 0;
  if (aslant && !(atHand && pull_->to[0] && pull_->to[1]))
    for (std::size_t n = 0; n < kNumbers.size(); ++n)
      way[Eigen::Index(n)] =
          lastBefore(way[Eigen::Index(n)], *numberOf(pull_->base, pull_->handle, kNumbers[n]), pull_->step);
  DesignedSurface pulled = movedBy(pull_->base, held(), way, habits_.symmetric);
  if (!atHand) return pulled;
  for (std::size_t n = 0; n < kNumbers.size(); ++n)
    if (pull_->to[n]) setNumber(pulled, pull_->handle, kNumbers[n], *pull_->to[n]);
  return pulled;
}

void SurfaceHandles::pull(double by, bool live) {
  pull_->by = by;
  pull_->moved = true;
  const DesignedSurface pulled = pulledBy(by);
  pulling_ = true;
  bench_.editSurface(
      pullName(), [&](DesignedSurface& surface) { surface = pulled; }, pull_->mergeId, live);
  pulling_ = false;
}

void SurfaceHandles::release(int handle, bool givenUp) {
  if (pull_ && pull_->handle == handle) drop(givenUp);
}

void SurfaceHandles::drop(bool givenUp) {
  if (!pull_ || !pull_->held) return;
  if (pull_->moved && givenUp) giveUp();
  if (!pull_->moved || givenUp) return endPull();
  pull_->held = pull_->beyond = false;
  pull_->letGoAt = pull_->by;
  // It stays where it is seen to be, not where the hand was, unless it has to go back.
  if (std::exchange(pull_->wished, pull_->by) != pull_->by) pull_->to = {};
  settle(false);
}

void SurfaceHandles::settle(bool anyway) {
  if (!pull_ || !pull_->letGoAt) return;
  const std::optional<pipeline::Reach>& reach = bench_.runner().reach();
  const bool known = reach && reach->knows(pull_->wished);
  if (!known && !anyway) return;
  pull(pull_->by, false);
  const bool back = pull_->by != *pull_->letGoAt;
  const QString words = tr("%1 went back: %2").arg(nameOf(pull_->handle), pull_->stoppedBy);
  endPull();
  if (back) emit told(words);
}

void SurfaceHandles::hover(int handle) {
  hovered_ = handle < count() ? handle : -1;
  emit changed();
}

void SurfaceHandles::follow(const Change& change) {
  if (bench_.source().id != source_) {  // the handles are those of another surface
    source_ = bench_.source().id;
    choose({});
    if (!change.any(model::Aspect::design)) return emit changed();
  }
  if (!change.any(model::Aspect::design)) return;
  if (!pulling_) endMoves();
  // Another surface, or an undo while a handle is held.
  const DesignedSurface* surface = surfaceOf(bench_);
  const int count = surface ? int(places().size()) : 0;
  if (std::erase_if(chosen_, [count](int handle) { return handle >= count; }) > 0) emit chosenChanged();
  if (pull_ && (!surface || surface->shape.index() != pull_->from.shape.index() || pull_->handle >= count)) {
    endPull();
    view_->letGo();
  }
  if (hovered_ >= count) hovered_ = -1;
  emit changed();
}

}  // namespace bw::app
