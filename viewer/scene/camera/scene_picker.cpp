// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/camera/scene_picker.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bw/core/sweep/maps.h"

namespace bw::scene {

namespace {

constexpr double kLinePickPixels = 4;
constexpr double kClear = 0.05;  ///< opacity up to which a surface is looked through

/// A place on a line, and how far from the cursor it appears.
struct LinePlace {
  double pixels;
  ItemId id;
  Eigen::Vector3d point;
};

/// Puts the place of `line` that appears nearest to `cursor` into `best` if it is nearer.
void nearestOn(const Polyline& line, const ItemId& id, const Projection& view, const Eigen::Vector2d& cursor,
               std::optional<LinePlace>& best) {
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Eigen::Vector3d now = view.toPixel(line[k]);
    if (k > 0 && (view.parallel() || (before.z() > 0 && now.z() > 0))) {
      const Eigen::Vector2d edge = (now - before).head<2>(), offset = cursor - before.head<2>();
      const double square = edge.squaredNorm();
      const double t = square > 0 ? std::clamp(offset.dot(edge) / square, 0.0, 1.0) : 0.0;
      const double distance = (offset - t * edge).norm();
      if (!best || distance < best->pixels) {
        // Shares on the screen are not shares in space under perspective.
        const double s = view.parallel() ? t : t * before.z() / (t * before.z() + (1 - t) * now.z());
        best = LinePlace{distance, id, line[k - 1] + s * (line[k] - line[k - 1])};
      }
    }
    before = now;
  }
}

struct NearStation {
  int station = -1;
  double distance = std::numeric_limits<double>::max();  ///< squared
};

/// The station that passes nearest to a point of space; −1 if there is none.
NearStation nearestStation(const std::vector<Polyline>& stations, const Eigen::Vector3d& point) {
  NearStation best;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const Polyline& line = stations[i];
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Eigen::Vector3d edge = line[k + 1] - line[k];
      const double square = edge.squaredNorm();
      const double t = square > 0 ? std::clamp((point - line[k]).dot(edge) / square, 0.0, 1.0) : 0.0;
      const double distance = (line[k] + t * edge - point).squaredNorm();
      if (distance < best.distance) best = {int(i), distance};
    }
  }
  return best;
}

bool cutAway(const std::optional<SectionPlane>& section, const Eigen::Vector3d& point) {
  return section && (point - section->point).dot(section->normal) > 0;
}

/// The first hit on what the section leaves.
std::optional<RayHit> firstHit(const TriangleTree& tree, const std::optional<SectionPlane>& section,
                               const Ray& ray) {
  if (!section) return tree.firstHit(ray);
  const double slope = ray.direction.dot(section->normal);
  const double height = (ray.origin - section->point).dot(section->normal);
  Ray kept = ray;
  double skipped = 0;
  if (height > 0) {
    // The ray begins where everything is taken away: it meets nothing before the plane.
    if (slope >= 0) return std::nullopt;
    skipped = -height / slope;
    kept.origin = ray.at(skipped);
  }
  std::optional<RayHit> hit = tree.firstHit(kept);
  if (!hit) return hit;
  hit->t += skipped;
  if (height <= 0 && slope > 0 && hit->t > -height / slope) return std::nullopt;
  return hit;
}

/// The field's value where a ray hits the cut surface, that of the nearest corner if it stands for a word;
/// none where it is not a number.
std::optional<double> valueAt(const Field& field, const TriangleMesh& mesh, const RayHit& hit) {
  const auto& corners = mesh.triangles[std::size_t(hit.triangle)];
  const auto at = [&](int k) { return field.values[std::size_t(corners[std::size_t(k)])]; };
  double value = 0;
  if (mapRule(field.name) == MapRule::words) {
    int nearest = 0;
    hit.weights.maxCoeff(&nearest);
    value = at(nearest);
  } else {
    for (int k = 0; k < 3; ++k) value += hit.weights[k] * at(k);
  }
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

/// The ray through a pixel. In a parallel picture the eye is nowhere: it begins before everything.
Ray sightThrough(const ScenePicker::Shown& shown, const Projection& view, double x, double y) {
  Ray ray = view.ray(x, y);
  const Bounds& all = shown.bounds;
  if (view.parallel() && all.valid())
    ray.origin -= 4 * (all.size().norm() + (view.position() - all.center()).norm()) * ray.direction;
  return ray;
}

}  // namespace

void ScenePicker::reset(const TriangleMesh* kept) {
  std::erase_if(trees_, [&](const auto& tree) { return tree.first != kept; });
}

std::optional<RayHit> ScenePicker::hit(const TriangleMesh& mesh, const Shown& shown, const Ray& ray) const {
  const TriangleTree& tree = trees_.try_emplace(&mesh, mesh.points, mesh.triangles).first->second;
  return firstHit(tree, shown.style.section, ray);
}

template <class Range>
auto ScenePicker::firstOf(const Range& things, Kind kind, const Shown& shown, const Ray& ray) const {
  std::optional<Hit<typename Range::value_type>> first;
  for (const auto& thing : things) {
    const Look& look = shown.style.of(kind, thing.id);
    if (!look.visible || look.opacity <= kClear || thing.surface().triangles.empty()) continue;
    if (const auto met = hit(thing.surface(), shown, ray); met && (!first || met->t < first->t))
      first = {*met, &thing};
  }
  return first;
}

Pick ScenePicker::pickFace(const Shown& shown, const Ray& ray) const {
  const FaceMesh& faces = *shown.things.faces;
  Pick result;
  if (const std::optional<RayHit> met = hit(faces.mesh, shown, ray)) {
    result.kind = Kind::face;
    result.face = faces.faces[std::size_t(met->triangle)];
    result.point = ray.at(met->t);
  }
  return result;
}

bool ScenePicker::sees(const Shown& shown, const Projection& view, const Eigen::Vector3d& point) const {
  if (cutAway(shown.style.section, point)) return false;
  const Eigen::Vector3d pixel = view.toPixel(point);
  const Ray sight = sightThrough(shown, view, pixel.x(), pixel.y());
  const auto met = firstOf(shown.things.rows, Kind::cut, shown, sight);
  const double distance = (point - sight.origin).dot(sight.direction);
  const double size = shown.bounds.valid() ? shown.bounds.size().norm() : 0.0;
  return !met || met->t > distance - 4 * view.pixelSize(pixel.z()) - 0.002 * std::max(size, 1e-3);
}

Pick ScenePicker::pick(const Shown& shown, const Projection& view, double x, double y) const {
  const Things& things = shown.things;
  const Style& style = shown.style;
  const Eigen::Vector2d cursor(x, y);
  Pick result;
  const Ray ray = sightThrough(shown, view, x, y);
  if (style.chooseFaces && things.faces) return pickFace(shown, ray);
  const auto onCut = firstOf(things.rows, Kind::cut, shown, ray);
  const auto onTarget = firstOf(things.targets, Kind::target, shown, ray);

  // Lines: the nearest to the pixel that is not hidden.
  const double reach = kLinePickPixels * style.pixelRatio;
  std::optional<LinePlace> onBlade, onStation;
  if (shown.movingBlade.size() >= 2) nearestOn(shown.movingBlade, style.moving, view, cursor, onBlade);
  if (onBlade && onBlade->pixels <= reach + 1 && sees(shown, view, onBlade->point)) {
    result.kind = Kind::blade;
    result.point = onBlade->point;
    result.id = result.station = onBlade->id;
    const auto row = std::ranges::find(things.rows, onBlade->id.row(), &Row::id);
    result.station.station = std::clamp(int(std::lround(style.playhead)), 0, int(row->blades->size()) - 1);
    return result;
  }

  const bool targetFirst = onTarget && (!onCut || onTarget->t + shown.targetSetBack < onCut->t);
  if (onCut && !targetFirst) {
    const Row& row = *onCut->thing;
    result.kind = Kind::cut;
    result.point = ray.at(onCut->t);
    result.id = result.station = row.id;
    result.station.station = nearestStation(*row.stations, result.point).station;
    if (const Field* field = row.field()) result.value = valueAt(*field, row.mesh, *onCut);
  } else if (onTarget) {
    result.kind = Kind::target;
    result.point = ray.at(onTarget->t);
    result.id = onTarget->thing->id;
    double least = std::numeric_limits<double>::max();
    for (const Row& row : things.rows) {
      const NearStation near = nearestStation(*row.stations, result.point);
      if (near.distance >= least) continue;
      least = near.distance;
      result.station = row.id;
      result.station.station = near.station;
    }
  }
  for (const Row& row : things.rows) {
    if (!style.of(Kind::station, row.id).visible) continue;
    ItemId id = row.id;
    for (const Polyline& line : *row.stations) {
      ++id.station;
      nearestOn(line, id, view, cursor, onStation);
    }
  }
  if (onStation && onStation->pixels <= reach && sees(shown, view, onStation->point)) {
    result.kind = Kind::station;
    result.id = onStation->id.row();
    result.station = onStation->id;
    // The value stays that of the surface below, if the cursor is over it.
    if (!onCut || targetFirst) result.point = onStation->point;
    return result;
  }
  if (result.kind != Kind::none) return result;
  double nearest = std::numeric_limits<double>::max();
  for (const Stock& stock : things.stocks) {
    if (!stock.box || !style.of(Kind::block, stock.id).visible) continue;
    if (const std::optional<double> t = rayMeetsBox(ray, *stock.box); t && *t < nearest) {
      nearest = *t;
      result.kind = Kind::block;
      result.id = stock.id;
      result.point = ray.at(*t);
    }
  }
  return result;
}

}  // namespace bw::scene
