// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/block_handles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "bw/core/base/box_in_plane.h"
#include "bw/core/base/units.h"
#include "bw/core/parts/cut_pose.h"
#include "bw/core/text/number_text.h"
#include "controls/numbers.h"
#include "window/corner_expressions.h"
#include "window/handle_ray.h"
#include "workbench/block_layout.h"

namespace bw::app {

namespace {

constexpr int kFaces = 6;
constexpr double kLeast = 10, kMost = 1e5;       // mm, of a size, or of a place
constexpr HandSteps kTurns = {1, 15, 45};        // degrees
constexpr HandSteps kLeans = {1, 5, 15};         // degrees
constexpr double kMostLean = 80;                 // degrees
constexpr double kRing = 1.12, kTip = 1.35;      // of half a diagonal of the block, from its middle
constexpr double kRingAt = 45;                   // degrees: where the ring of z is held
constexpr double kArc = 18;                      // degrees: half of what is drawn of the others
constexpr double kSpoke = 0.16;                  // of that half diagonal, out of the corner
constexpr double kMast = 0.35;                   // of that, over the top of the block
constexpr double kBarb = 0.09, kBarbAngle = 25;  // of the arrow's length, and degrees
constexpr int kRingParts = 72;
constexpr double kUpright = 1e-3;  // sine between the travel and the vertical, below which it turns nothing
constexpr std::array<const char*, 3> kAxes = {"X", "Y", "Z"};

bool isFace(BlockPart part) { return int(part) < kFaces; }
bool isTurn(BlockPart part) { return part >= BlockPart::turnX && part <= BlockPart::turnZ; }
bool isMove(BlockPart part) { return part >= BlockPart::moveX && part <= BlockPart::moveZ; }
/// True of what is counted in mm, along a way.
bool slides(BlockPart part) { return isFace(part) || isMove(part); }
/// 0 x, 1 y, 2 z: of the block, of its rotations, or of the frame of the design.
int axisOf(BlockPart part) {
  return isFace(part) ? int(part) / 2 : int(part) - int(isTurn(part) ? BlockPart::turnX : BlockPart::moveX);
}
double sideOf(BlockPart part) { return int(part) % 2 ? 1 : -1; }
/// True of what belongs to the cut rather than to the block.
bool isOfCut(BlockPart part) { return part == BlockPart::direction || part == BlockPart::lean; }

Eigen::Vector3d axisIn(const Frame& frame, int axis) {
  return axis == 0 ? frame.x : axis == 1 ? frame.y : frame.normal;
}

/// Degrees in (−180, 180].
double wrapped(double degrees) {
  const double within = std::remainder(degrees, 360);
  return within == -180 ? 180 : within;
}

QString degreesText(double degrees) { return QString::fromStdString(shortText(degrees, 6)) + QChar(0xb0); }

/// The direction at an angle, without the digits that a sine of 180° leaves.
Eigen::Vector2d unitAt(double degrees) {
  const auto clean = [](double number) { return std::abs(number) < 1e-15 ? 0.0 : number; };
  return {clean(std::cos(fromDegrees(degrees))), clean(std::sin(fromDegrees(degrees)))};
}

QString textOfEdit(BlockPart part) {
  if (isFace(part)) return BlockHandles::tr("Resize block");
  if (isTurn(part)) return BlockHandles::tr("Rotate block");
  if (isMove(part)) return BlockHandles::tr("Move block");
  return part == BlockPart::lean ? BlockHandles::tr("Lean planes") : BlockHandles::tr("Change direction");
}

/// The block with another value of a part.
BlockPlacement placedWith(const BlockPlacement& placed, BlockPart part, double value) {
  BlockPlacement next = placed;
  const Box box = placed.box();
  if (isFace(part)) {
    const int axis = axisOf(part);
    next.size[axis] = value;
    // The other face stays.
    if (sideOf(part) < 0) next.origin -= (value - placed.size[axis]) * axisIn(box.frame, axis);
    return next;
  }
  if (isMove(part)) {
    next.origin[axisOf(part)] = value;
    return next;
  }
  next.rotation[axisOf(part)] = fromDegrees(value);
  next.origin += box.center() - next.box().center();
  return next;
}

}  // namespace

double BlockHandles::within(const Standing& was, BlockPart part, double value) {
  if (part == BlockPart::lean) return std::clamp(value, -kMostLean, kMostLean);
  if (isMove(part)) return std::clamp(value, -kMost, kMost);
  if (!isFace(part)) return wrapped(value);
  return std::clamp(value, std::min(kLeast, valueOf(was, part)), kMost);
}

BlockHandles::BlockHandles(Workbench& bench, view::SceneView* view, SurfaceHandles& surface)
    : QObject(view), bench_(bench), view_(view), surface_(surface), field_(new HandleField(bench, view)) {
  view->installEventFilter(this);
  connect(view, &view::SceneView::handlePressed, this, &BlockHandles::press);
  connect(view, &view::SceneView::handleMoved, this, &BlockHandles::move);
  connect(view, &view::SceneView::handleReleased, this, &BlockHandles::release);
  connect(view, &view::SceneView::handleHovered, this, &BlockHandles::hover);
  connect(&bench, &Workbench::changed, this, &BlockHandles::follow);
  connect(&surface, &SurfaceHandles::chosenChanged, this, [this] {
    if (!surface_.chosen().empty()) choose({});
  });
}

std::optional<BlockHandles::Standing> BlockHandles::standing() const {
  if (bench_.document().empty() || bench_.selection().kind != Selection::Kind::block || !surface_.shown())
    return {};
  const std::optional<BlockPlacement> placed = placementOf(bench_);
  if (!placed) return {};
  Standing now{*placed, placed->box(), {}, Eigen::Vector3d::UnitY()};
  now.lies = lying(now.box, bench_.cut().pose);
  const pipeline::CutEvaluation* shown = bench_.shownCut();
  if (bench_.cut().direction)
    now.travel = bench_.cut().direction->normalized();
  else if (shown && shown->setup)
    now.travel = shown->setup->planes.direction();
  now.travelled = now.travel.cross(now.lies.frame.normal).norm() > kUpright;
  now.gridded = bench_.design().grid && bench_.design().grid->count() > 1;
  return now;
}

double BlockHandles::valueOf(const Standing& standing, BlockPart part) {
  if (isFace(part)) return standing.placed.size[axisOf(part)];
  if (isTurn(part)) return toDegrees(standing.placed.rotation[axisOf(part)]);
  if (isMove(part)) return standing.placed.origin[axisOf(part)];
  const Frame& frame = standing.lies.frame;
  if (part == BlockPart::lean)
    return toDegrees(std::asin(std::clamp(standing.travel.dot(frame.normal), -1.0, 1.0)));
  return toDegrees(std::atan2(standing.travel.dot(frame.y), standing.travel.dot(frame.x)));
}

Eigen::Vector3d BlockHandles::travelWith(const Standing& was, BlockPart part, double value) {
  const Frame& frame = was.lies.frame;
  const bool leans = part == BlockPart::lean;
  const Eigen::Vector2d up = unitAt(leans ? value : valueOf(was, BlockPart::lean));
  const Eigen::Vector2d way = up.x() * unitAt(leans ? valueOf(was, BlockPart::direction) : value);
  Eigen::Vector3d travel = way.x() * frame.x + way.y() * frame.y + up.y() * frame.normal;
  for (double& number : travel)
    if (std::abs(number) < 1e-12) number = 0;
  return travel;
}

Frame BlockHandles::planeOf(const Standing& standing, BlockPart part) {
  const Box& box = isTurn(part) ? standing.box : standing.lies;
  Frame plane = box.frame;
  plane.origin = box.center();
  if (part == BlockPart::turnX || part == BlockPart::turnY) {
    // A rotation about x turns all that follows, one about y what follows on that.
    const Eigen::Vector3d& angles = standing.placed.rotation;
    const bool first = part == BlockPart::turnX;
    const Eigen::Matrix3d axes = rotationFromAngles({first ? 0 : angles.x(), 0, 0});
    plane.x = axes.col(first ? 1 : 2);
    plane.y = axes.col(first ? 2 : 0);
    plane.normal = axes.col(first ? 0 : 1);
  } else if (part == BlockPart::lean) {
    const Eigen::Vector3d up = box.frame.normal;
    plane.x = (standing.travel - standing.travel.dot(up) * up).normalized();
    plane.y = up;
    plane.normal = plane.x.cross(plane.y);
  } else {
    plane.origin += 0.5 * box.size.z() * box.frame.normal;
  }
  return plane;
}

double BlockHandles::ringOf(const Standing& standing, BlockPart part) {
  const Frame plane = planeOf(standing, part);
  double radius = 0;
  for (const Eigen::Vector3d& corner : standing.box.corners())
    radius = std::max(radius, plane.toLocal(corner).head<2>().norm());
  return kRing * radius;
}

double BlockHandles::ringAngle(const Standing& standing, BlockPart part) {
  // Beside an edge between two faces, with which it turns: those of x and y at the top.
  if (part == BlockPart::turnZ) return -kRingAt;
  const Eigen::Vector3d& size = standing.box.size;
  const double edge =
      part == BlockPart::turnX ? std::atan2(size.z(), size.y()) : std::atan2(size.x(), size.z());
  return toDegrees(edge) + valueOf(standing, part);
}

scene::Polyline BlockHandles::ringLine(const Standing& standing, BlockPart part, bool whole) {
  const Frame plane = planeOf(standing, part);
  const double radius = ringOf(standing, part), middle = ringAngle(standing, part);
  const double half = whole ? 180 : kArc;
  scene::Polyline line;
  for (int i = 0; i <= kRingParts; ++i)
    line.push_back(plane.toWorld(radius * unitAt(middle + half * (2.0 * i / kRingParts - 1))));
  return line;
}

Eigen::Vector3d BlockHandles::wayOf(const Standing& standing, BlockPart part) {
  if (isMove(part)) return Eigen::Vector3d::Unit(axisOf(part));
  return sideOf(part) * axisIn(standing.box.frame, axisOf(part));
}

Eigen::Vector3d BlockHandles::placeOf(const Standing& standing, BlockPart part) {
  if (isFace(part)) {
    const int axis = axisOf(part);
    return standing.box.center() +
           0.5 * sideOf(part) * standing.box.size[axis] * axisIn(standing.box.frame, axis);
  }
  if (isMove(part))
    return standing.box.frame.origin -
           kSpoke * 0.5 * standing.box.size.norm() * Eigen::Vector3d::Unit(axisOf(part));
  if (isTurn(part))
    return planeOf(standing, part).toWorld(ringOf(standing, part) * unitAt(ringAngle(standing, part)));
  const Box& box = standing.lies;
  const double radius = 0.5 * box.size.head<2>().norm();
  if (part == BlockPart::lean)
    return planeOf(standing, part)
        .toWorld((0.5 * box.size.z() + kMast * radius) * unitAt(90 + valueOf(standing, part)));
  return planeOf(standing, part).toWorld(kTip * radius * unitAt(valueOf(standing, part)));
}

HandSteps BlockHandles::stepsOf(BlockPart part) const {
  return slides(part) ? surface_.steps() : part == BlockPart::lean ? kLeans : kTurns;
}

QString BlockHandles::nameOf(BlockPart part) const {
  switch (part) {
    case BlockPart::left:
      return tr("Left face");
    case BlockPart::right:
      return tr("Right face");
    case BlockPart::front:
      return tr("Front face");
    case BlockPart::back:
      return tr("Back face");
    case BlockPart::bottom:
      return tr("Bottom face");
    case BlockPart::top:
      return tr("Top face");
    case BlockPart::turnX:
    case BlockPart::turnY:
    case BlockPart::turnZ:
      return tr("Rotation %1").arg(kAxes[std::size_t(axisOf(part))]);
    case BlockPart::moveX:
    case BlockPart::moveY:
    case BlockPart::moveZ:
      return tr("Corner %1").arg(kAxes[std::size_t(axisOf(part))]);
    case BlockPart::direction:
      return tr("Cutting direction");
    case BlockPart::lean:
      break;
  }
  return tr("Lean of the planes");
}

QString BlockHandles::textOf(const Standing& standing, BlockPart part) const {
  const double value = valueOf(standing, part);
  QString text =
      isFace(part)
          ? tr("%1: size %2 %3").arg(nameOf(part), kAxes[std::size_t(axisOf(part))], lengthText(value))
      : isMove(part)                 ? tr("%1: %2").arg(nameOf(part), lengthText(value))
      : part == BlockPart::direction ? tr("%1: %2 from the block's X").arg(nameOf(part), degreesText(value))
                                     : tr("%1: %2").arg(nameOf(part), degreesText(value));
  if (!pull_ || pull_->part != part) return text;
  const double off = value - valueOf(pull_->was, part), by = slides(part) ? off : wrapped(off);
  text += (by < 0 ? " (−" : " (+") + QString::fromStdString(shortText(std::abs(by), 4)) + ")";
  return pull_->snap ? text + "\n" + tr("Snapped to %1").arg(pull_->snap->words) : text;
}

SnapThings BlockHandles::snapThings(const Standing& standing) const {
  SnapThings things;
  const Design& design = bench_.design();
  for (const StockBlock& block : design.stock)
    if (block.id != bench_.block().id && block.placement)
      things.blocks.push_back({QString::fromStdString(block.id), block.placement->box()});
  const auto shown = bench_.shown();
  if (!shown) return things;
  for (const Cut& cut : design.cuts) {
    const pipeline::CutEvaluation* own = shown->find(cut.id);
    if (cut.block != bench_.block().id || !own || !own->targetMesh.value) continue;
    Bounds bounds;
    for (const Eigen::Vector3d& point : own->targetMesh.value->points)
      bounds.add(standing.box.frame.toLocal(point));
    if (!bounds.valid()) continue;
    Box box{standing.box.frame, bounds.size()};
    const Frame& frame = standing.box.frame;
    box.frame.origin += bounds.min.x() * frame.x + bounds.min.y() * frame.y + bounds.min.z() * frame.normal;
    things.blocks.push_back(
        {design.sources.size() > 1 ? QString::fromStdString(cut.source) : tr("the surface"), box});
  }
  return things;
}

std::optional<Snap> BlockHandles::snapOf(BlockPart part, double by) const {
  const Standing& was = pull_->was;
  const Eigen::Vector3d way = wayOf(was, part);
  // Moved, either of the faces across its way may come in line with something; turned askew none lies across.
  std::vector<BlockPart> faces;
  for (int face = 0; face < kFaces; ++face)
    if (isFace(part) ? BlockPart(face) == part
                     : std::abs(way.dot(wayOf(was, BlockPart(face)))) > 1 - kUpright * kUpright)
      faces.push_back(BlockPart(face));
  std::optional<Snap> nearest;
  for (const BlockPart face : faces) {
    const int axis = axisOf(face);
    const SnapWay from{placeOf(was, face), way, axisIn(was.box.frame, axis == 2 ? 0 : 2), axis == 2};
    std::optional<Snap> snap =
        snapTo(pull_->things, from, by, kMeetingReach * mmOfPixel(*view_, from.from, from.way));
    // What the part does not let it come to is nothing to snap to.
    const double value = snap ? valueOf(was, part) + snap->by : 0;
    if (snap && within(was, part, value) == value &&
        (!nearest || std::abs(snap->by - by) < std::abs(nearest->by - by)))
      nearest = std::move(snap);
  }
  return nearest;
}

QString BlockHandles::whyFixed(const Standing& standing, BlockPart part) const {
  if (isOfCut(part) || !standing.gridded) return {};
  const QString block = QString::fromStdString(bench_.selection().block);
  return isFace(part)
             ? tr("%1 lies in a grid, which tells its size: pull a boundary in the tab Blocks, or type its "
                  "sizes there")
                   .arg(block)
             : tr("%1 lies in a grid, whose blocks stand side by side: none is moved or turned alone")
                   .arg(block);
}

int BlockHandles::handleOf(BlockPart part) const {
  const std::optional<Standing> now = standing();
  if (!now || (isOfCut(part) && !now->travelled)) return -1;
  return surface_.count() + int(part);
}

std::optional<BlockPart> BlockHandles::partOf(int handle) const {
  const int part = handle - surface_.count();
  if (part < 0 || part > int(BlockPart::lean) || handleOf(BlockPart(part)) != handle) return {};
  return BlockPart(part);
}

void BlockHandles::applyTo(scene::Style& style) const {
  const std::optional<Standing> now = standing();
  if (!now || style.chooseFaces) return;
  scene::Handles& handles = style.handles;
  const int first = int(handles.points.size());
  handles.quiet = handles.points.size();
  const int last = int(now->travelled ? BlockPart::lean : BlockPart::moveZ);
  for (int part = 0; part <= last; ++part) handles.points.push_back(placeOf(*now, BlockPart(part)));
  const std::optional<BlockPart> lit =
      pull_ && (pull_->held || !hovered_) ? std::optional(pull_->part) : hovered_;
  for (const BlockPart part : {BlockPart::turnX, BlockPart::turnY, BlockPart::turnZ})
    handles.curves.push_back(
        ringLine(*now, part, part == BlockPart::turnZ || lit == part || chosen_ == part));
  for (const BlockPart part : {BlockPart::moveX, BlockPart::moveY, BlockPart::moveZ})
    handles.curves.push_back({now->box.frame.origin, placeOf(*now, part)});
  if (now->travelled) {
    const Frame plane = planeOf(*now, BlockPart::direction);
    const double length = kTip * 0.5 * now->lies.size.head<2>().norm();
    const double angle = valueOf(*now, BlockPart::direction);
    const Eigen::Vector2d tip = length * unitAt(angle);
    scene::Polyline arrow = {plane.origin, plane.toWorld(tip)};
    for (const double barb : {180 - kBarbAngle, 180 + kBarbAngle})
      arrow.insert(arrow.end(),
                   {plane.toWorld(tip + kBarb * length * unitAt(angle + barb)), plane.toWorld(tip)});
    handles.curves.push_back(std::move(arrow));
    handles.curves.push_back({planeOf(*now, BlockPart::lean).origin, placeOf(*now, BlockPart::lean)});
    handles.curves.push_back(middlePlaneOf(*now));
  }
  if (pull_ && !isOfCut(pull_->part)) {
    // The block goes with the hand at once; its picture follows.
    const std::array<Eigen::Vector3d, 8> corner = now->box.corners();
    for (const auto& [a, b] : std::initializer_list<std::pair<int, int>>{
             {0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}})
      handles.curves.push_back({corner[std::size_t(a)], corner[std::size_t(b)]});
    if (pull_->snap) {
      handles.curves.push_back({pull_->snap->line[0], pull_->snap->line[1]});
      if (scene::Polyline mark = meetingMark(*view_, placeOf(*now, pull_->part)); !mark.empty())
        handles.curves.push_back(std::move(mark));
    }
  }
  if (chosen_ && int(*chosen_) <= last) handles.chosen.push_back(first + int(*chosen_));
  if (!lit || int(*lit) > last) return;
  handles.lit = first + int(*lit);
  const QString why = whyFixed(*now, *lit);
  handles.text = (why.isEmpty() ? textOf(*now, *lit) : textOf(*now, *lit) + "\n" + why).toStdString();
  handles.stopped = !why.isEmpty();
  handles.ways.clear();
}

scene::Polyline BlockHandles::middlePlaneOf(const Standing& standing) {
  Frame plane;
  plane.origin = standing.lies.center();
  plane.normal = standing.travel;
  plane.x = standing.travel.unitOrthogonal();
  plane.y = plane.normal.cross(plane.x);
  scene::Polyline outline;
  for (const Eigen::Vector2d& corner : boxInPlane(standing.lies, plane))
    outline.push_back(plane.toWorld(corner));
  if (!outline.empty()) outline.push_back(outline.front());
  return outline;
}

void BlockHandles::choose(std::optional<BlockPart> part) {
  if (!pull_ || !pull_->held) endPull();
  field_->close();
  block_ = bench_.selection().block;
  cut_ = bench_.cut().id;
  if (std::exchange(chosen_, part) != part) emit changed();
}

bool BlockHandles::isOfAnother() const {
  return chosen_ && (bench_.selection().block != block_ || (isOfCut(*chosen_) && bench_.cut().id != cut_));
}

void BlockHandles::begin(BlockPart part, bool held, const Standing& standing) {
  pull_ = Pull{part, held, bench_.design(), standing, 0, valueOf(standing, part), bench_.newMergeId()};
}

void BlockHandles::press(int handle, const QPointF& position) {
  const std::optional<BlockPart> part = partOf(handle);
  if (!part) return;
  const Standing now = *standing();
  surface_.choose({});
  choose(part);
  if (const QString why = whyFixed(now, *part); !why.isEmpty()) {
    view_->letGo();
    return emit told(why);
  }
  begin(*part, true, now);
  if (slides(*part)) pull_->things = snapThings(now);
  pull_->began = (slides(*part) ? alongWay(*view_, position, placeOf(now, *part), wayOf(now, *part))
                                : angleIn(*view_, position, planeOf(now, *part)))
                     .value_or(0);
  emit changed();
}

void BlockHandles::move(int handle, const QPointF& position, Qt::KeyboardModifiers keys) {
  if (!pull_ || !pull_->held || partOf(handle) != pull_->part) return;
  const Standing& was = pull_->was;
  const BlockPart part = pull_->part;
  const auto [step, share] = handPace(keys, stepsOf(part));
  double by = 0;
  if (slides(part)) {
    const std::optional<double> at = alongWay(*view_, position, placeOf(was, part), wayOf(was, part));
    if (!at) return;
    by = *at - pull_->began;
  } else {
    const std::optional<double> at = angleIn(*view_, position, planeOf(was, part));
    if (!at) return;
    by = wrapped(*at - pull_->began);
  }
  // The number, not the way to it, is a round one.
  double value = std::round((valueOf(was, part) + by * (slides(part) ? share : 1)) / step) * step;
  const std::optional<Snap> before = std::exchange(pull_->snap, std::nullopt);
  if (slides(part) && surface_.meeting() && share == 1) pull_->snap = snapOf(part, by);
  if (pull_->snap) value = withoutNoise(valueOf(was, part) + pull_->snap->by);
  if (const double next = within(was, part, value); next != pull_->value)
    pull(next, true);
  else if (before.has_value() != pull_->snap.has_value())
    emit changed();
}

void BlockHandles::pull(double value, bool live) {
  pull_->value = value;
  pull_->moved = true;
  const BlockPart part = pull_->part;
  const Standing& was = pull_->was;
  pulling_ = true;
  if (isOfCut(part)) {
    const Eigen::Vector3d direction = travelWith(was, part, value);
    bench_.editCut(
        textOfEdit(part), [&](Cut& cut) { cut.direction = direction; }, pull_->mergeId, live);
  } else {
    const BlockPlacement next = placedWith(was.placed, part, value);
    bench_.editBlock(
        textOfEdit(part), [&](StockBlock& block) { block.placement = next; }, pull_->mergeId, live);
  }
  pulling_ = false;
  emit changed();
}

void BlockHandles::bindCorner(const Standing& was, BlockPart part, const std::string& expression) {
  // A face whose opposite one is the corner moves with the size alone.
  if (isMove(part) || (isFace(part) && sideOf(part) > 0)) return;
  // No corner keeps the middle where two rotations stand for expressions.
  for (int axis = 0; axis < 3 && isTurn(part); ++axis)
    if (axis != axisOf(part) &&
        bench_.design().bindings.contains(placeInBlock(bench_, "/rotation_deg/" + std::to_string(axis))()))
      return;
  const CornerExpressions corner = isFace(part) ? cornerOfSize(was.placed, axisOf(part), expression)
                                                : cornerOfTurn(was.placed, axisOf(part), expression);
  const std::string place = placeInBlock(bench_, "/origin/")();
  pulling_ = true;
  bench_.editDesign(
      textOfEdit(part),
      [&](Design& design) {
        StockBlock& block = *std::ranges::find(design.stock, bench_.block().id, &StockBlock::id);
        for (std::size_t i = 0; i < corner.size(); ++i) {
          const Result<double> value = corner[i] ? valueOver(bench_, *corner[i]) : Result<double>(0);
          if (!corner[i] || !value || !block.placement) continue;
          block.placement->origin[Eigen::Index(i)] = *value;
          design.bindings[place + std::to_string(i)] = {*corner[i], *value};
        }
      },
      pull_->mergeId);
  pulling_ = false;
}

void BlockHandles::bindCornerAnew() {
  const std::optional<Standing> now = standing();
  const std::string origin = placeInBlock(bench_, "/origin/")(),
                    turns = placeInBlock(bench_, "/rotation_deg/")();
  const auto boundIn = [](const Design& design, const std::string& place) {
    std::vector<int> axes;
    for (int axis = 0; axis < 3; ++axis)
      if (design.bindings.contains(place + std::to_string(axis))) axes.push_back(axis);
    return axes;
  };
  if (!now || boundIn(pull_->from, origin).empty() || boundIn(pull_->from, turns).empty()) return;
  const std::vector<int> turned = boundIn(bench_.design(), turns);
  const std::string expression =
      turned.size() == 1 ? bench_.design().bindings.at(turns + std::to_string(turned.front())).text
                         : std::string();
  pulling_ = true;
  bench_.editDesign(
      textOfEdit(pull_->part),
      [&](Design& design) {
        for (int axis = 0; axis < 3; ++axis) design.bindings.erase(origin + std::to_string(axis));
      },
      pull_->mergeId);
  pulling_ = false;
  // On several at once it cannot, and stays where it is.
  if (turned.size() == 1) bindCorner(*now, BlockPart(int(BlockPart::turnX) + turned.front()), expression);
}

void BlockHandles::giveUp() {
  pulling_ = true;
  bench_.editDesign(
      textOfEdit(pull_->part), [this](Design& design) { design = pull_->from; }, pull_->mergeId);
  pulling_ = false;
}

void BlockHandles::endPull() {
  if (!pull_) return;
  pull_.reset();
  emit changed();
}

void BlockHandles::release(int handle, bool givenUp) {
  if (!pull_ || !pull_->held || partOf(handle) != pull_->part) return;
  if (pull_->moved && givenUp) {
    giveUp();
  } else if (pull_->moved) {
    pull(pull_->value, false);
    bindCornerAnew();
  }
  endPull();
}

void BlockHandles::hover(int handle) {
  if (std::exchange(hovered_, partOf(handle)) != partOf(handle)) emit changed();
}

void BlockHandles::follow(const Change& change) {
  if (pulling_ || !change.any(Aspect::design | Aspect::selection)) return;
  const bool there = standing().has_value();
  if (there && isOfAnother()) choose({});
  if (pull_) {
    // Another block, or an undo while it is held.
    const bool held = pull_->held;
    pull_.reset();
    if (held) view_->letGo();
  }
  if (!there) {
    hovered_.reset();
    choose({});
  } else if (change.any(Aspect::design)) {
    emit changed();
  }
}

bool BlockHandles::eventFilter(QObject* watched, QEvent* event) {
  const bool override = event->type() == QEvent::ShortcutOverride;
  if (watched != view_ || (!override && event->type() != QEvent::KeyPress)) return false;
  if (!chosen_ || view_->holding() || handleOf(*chosen_) < 0) return false;
  const auto& key = *static_cast<QKeyEvent*>(event);
  if (override) {
    // Before a computation is stopped.
    if (key.key() == Qt::Key_Escape && (pull_ || !bench_.runner().busy())) event->accept();
    return false;
  }
  return pressKey(key);
}

bool BlockHandles::pressKey(const QKeyEvent& key) {
  switch (key.key()) {
    case Qt::Key_Up:
    case Qt::Key_Right:
      return nudge(1, key), true;
    case Qt::Key_Down:
    case Qt::Key_Left:
      return nudge(-1, key), true;
    case Qt::Key_Return:
    case Qt::Key_Enter:
      return openField(nullptr), true;
    case Qt::Key_Escape:
      if (pull_) {
        giveUp();
        endPull();
      } else {
        choose({});
      }
      return true;
    default:
      break;
  }
  if (!beginsNumber(key)) return false;
  openField(&key);
  return true;
}

void BlockHandles::nudge(double steps, const QKeyEvent& key) {
  const Standing now = *standing();
  if (const QString why = whyFixed(now, *chosen_); !why.isEmpty()) return emit told(why);
  if (!pull_) begin(*chosen_, false, now);
  const double step = handPace(key.modifiers(), stepsOf(*chosen_)).step;
  pull(within(now, *chosen_, nextRound(valueOf(now, *chosen_), step, steps)), true);
  bindCornerAnew();
}

void BlockHandles::openField(const QKeyEvent* typed) {
  const BlockPart part = *chosen_;
  if (const QString why = whyFixed(*standing(), part); !why.isEmpty()) return emit told(why);
  endPull();
  const QString block = QString::fromStdString(bench_.selection().block);
  HandleField::Line line;
  line.label = isFace(part) ? tr("Size %1").arg(kAxes[std::size_t(axisOf(part))]) : nameOf(part);
  line.name = tr("%1 of %2").arg(line.label, block);
  line.range = isFace(part)   ? NumberRange{kLeast, kMost, 3, 10, "mm"}
               : isMove(part) ? NumberRange{-kMost, kMost, 3, 10, "mm"}
               : part == BlockPart::lean
                   ? NumberRange{-kMostLean, kMostLean, 3, kLeans.plain, QString(QChar(0xb0))}
                   : NumberRange{-360, 360, 3, kTurns.plain, QString(QChar(0xb0))};
  line.value = [this, part]() -> std::optional<double> {
    const std::optional<Standing> now = standing();
    return now && chosen_ == part ? std::optional(valueOf(*now, part)) : std::nullopt;
  };
  if (isFace(part)) line.place = placeInBlock(bench_, "/size/" + std::to_string(axisOf(part)));
  if (isTurn(part)) line.place = placeInBlock(bench_, "/rotation_deg/" + std::to_string(axisOf(part)));
  if (isMove(part)) line.place = placeInBlock(bench_, "/origin/" + std::to_string(axisOf(part)));
  line.take = [this, part](double to, const NumberField& field) {
    const std::optional<Standing> now = standing();
    if (!now) return;
    begin(part, false, *now);
    pull(to, false);
    bindCornerAnew();
    if (const QString told = field.expression(); !told.isEmpty()) bindCorner(*now, part, told.toStdString());
    endPull();
  };
  field_->open(
      nameOf(part), {line},
      [this, part]() -> std::optional<Eigen::Vector3d> {
        const std::optional<Standing> now = standing();
        return now && chosen_ == part ? std::optional(placeOf(*now, part)) : std::nullopt;
      },
      typed);
}

}  // namespace bw::app
