// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#include "window/handle_numbers.h"

#include <algorithm>
#include <cmath>

#include "bw/core/shape/blade_ends.h"

namespace bw::app {

std::optional<SectionPoint> sectionPointOf(const DesignedSurface& surface, int handle) {
  const auto* loft = std::get_if<SectionsSurface>(&surface.shape);
  if (!loft || handle < 0) return {};
  for (std::size_t i = 0; i < loft->sections.size(); ++i) {
    const int count = int(loft->sections[i].points.size());
    if (handle < count) return SectionPoint{int(i), handle};
    handle -= count;
  }
  return {};
}

int handleOf(const DesignedSurface& surface, const SectionPoint& point) {
  const auto& sections = std::get<SectionsSurface>(surface.shape).sections;
  int handle = point.point;
  for (int i = 0; i < point.section; ++i) handle += int(sections[std::size_t(i)].points.size());
  return handle;
}

std::optional<int> bladeOf(const DesignedSurface& surface, int handle) {
  const auto* sweep = std::get_if<BladesSurface>(&surface.shape);
  const int count = sweep ? int(sweep->blades.size()) : 0;
  if (handle < 0 || handle >= 3 * count) return {};
  return handle < count ? handle : (handle - count) / 2;
}

std::optional<int> endOf(const DesignedSurface& surface, int handle) {
  if (!bladeOf(surface, handle)) return {};
  const int count = int(std::get<BladesSurface>(surface.shape).blades.size());
  return handle < count ? std::nullopt : std::optional((handle - count) % 2);
}

std::array<Eigen::Vector2d, 2> endsOf(const KeyBlade& blade) {
  return bladeEnds(blade).value_or(std::array{blade.middle, blade.middle});
}

std::optional<int> entryOf(const DesignedSurface& surface, int handle) {
  if (const auto* poles = std::get_if<PolesSurface>(&surface.shape))
    return handle >= 0 && handle < poles->rows * poles->columns ? std::optional(handle / poles->columns)
                                                                : std::nullopt;
  if (const std::optional<int> blade = bladeOf(surface, handle)) return blade;
  const std::optional<SectionPoint> at = sectionPointOf(surface, handle);
  return at ? std::optional(at->section) : std::nullopt;
}

int mirrorOf(const DesignedSurface& surface, int handle) {
  if (const auto* poles = std::get_if<PolesSurface>(&surface.shape)) {
    const int row = handle / poles->columns, column = handle % poles->columns;
    return handle < 0 ? -1 : row * poles->columns + poles->columns - 1 - column;
  }
  if (const std::optional<int> end = endOf(surface, handle)) return handle + (*end == 0 ? 1 : -1);
  const std::optional<SectionPoint> at = sectionPointOf(surface, handle);
  if (!at) return -1;
  const auto& section = std::get<SectionsSurface>(surface.shape).sections[std::size_t(at->section)];
  return handleOf(surface, {at->section, int(section.points.size()) - 1 - at->point});
}

namespace {

/// The number of a handle that the surface holds; null if it holds none.
double* heldNumber(DesignedSurface& surface, int handle, HandleNumber number) {
  if (auto* poles = std::get_if<PolesSurface>(&surface.shape)) {
    const bool there = handle >= 0 && std::size_t(handle) < poles->poles.size();
    return there && number == HandleNumber::height ? &poles->poles[std::size_t(handle)].height : nullptr;
  }
  if (auto* sweep = std::get_if<BladesSurface>(&surface.shape)) {
    if (handle < 0 || std::size_t(handle) >= sweep->blades.size()) return nullptr;
    Eigen::Vector2d& middle = sweep->blades[std::size_t(handle)].middle;
    return number == HandleNumber::height ? &middle.y() : &middle.x();
  }
  const std::optional<SectionPoint> at = sectionPointOf(surface, handle);
  if (!at) return nullptr;
  Eigen::Vector2d& point = std::get<SectionsSurface>(surface.shape)
                               .sections[std::size_t(at->section)]
                               .points[std::size_t(at->point)];
  return number == HandleNumber::height ? &point.y() : &point.x();
}

/// Turns a key blade about one end until the other is at a height, or upright.
void liftEnd(KeyBlade& blade, int end, double height) {
  const std::array<Eigen::Vector2d, 2> ends = endsOf(blade);
  const double about = ends[std::size_t(1 - end)].y(), length = (ends[1] - ends[0]).norm();
  EndHeights heights;
  heights[std::size_t(end)] = std::clamp(height, about - length, about + length);
  if (const Result<KeyBlade> turned = withEndHeights(blade, heights)) blade = *turned;
}

KeyBlade& keyBladeOf(DesignedSurface& surface, int handle) {
  return std::get<BladesSurface>(surface.shape).blades[std::size_t(*bladeOf(surface, handle))];
}

}  // namespace

const DesignedSurface* surfaceOf(const Workbench& bench) {
  return bench.source().surface ? &*bench.source().surface : nullptr;
}

std::vector<Eigen::Vector3d> placesOf(const DesignedSurface& surface) {
  std::vector<Eigen::Vector3d> places;
  const Eigen::Matrix3d turned = rotationFromAngles(surface.rotation);
  const auto add = [&](double x, double y, double z) {
    places.push_back(surface.origin + turned * Eigen::Vector3d(x, y, z));
  };
  if (const auto* poles = std::get_if<PolesSurface>(&surface.shape)) {
    for (int row = 0; row < poles->rows; ++row)
      for (int column = 0; column < poles->columns; ++column) {
        const SurfacePole& pole = poles->at(row, column);
        const Eigen::Vector2d place = poles->place(row, column) + pole.moved;
        add(place.x(), place.y(), pole.height);
      }
  } else if (const auto* sections = std::get_if<SectionsSurface>(&surface.shape)) {
    for (const SectionCurve& section : sections->sections)
      for (const Eigen::Vector2d& point : section.points) add(point.x(), section.y, point.y());
  } else if (const auto* blades = std::get_if<BladesSurface>(&surface.shape)) {
    for (const KeyBlade& blade : blades->blades) add(blade.middle.x(), blade.y, blade.middle.y());
    for (const KeyBlade& blade : blades->blades)
      for (const Eigen::Vector2d& end : endsOf(blade)) {
        const Eigen::Vector3d place = blade.placed(end);
        add(place.x(), place.y(), place.z());
      }
  }
  return places;
}

std::optional<double> numberOf(const DesignedSurface& surface, int handle, HandleNumber number) {
  DesignedSurface copy = surface;
  if (const std::optional<int> end = endOf(surface, handle))
    return number == HandleNumber::height
               ? std::optional(endsOf(keyBladeOf(copy, handle))[std::size_t(*end)].y())
               : std::nullopt;
  const double* value = heldNumber(copy, handle, number);
  return value ? std::optional(*value) : std::nullopt;
}

void setNumber(DesignedSurface& surface, int handle, HandleNumber number, double to) {
  if (const std::optional<int> end = endOf(surface, handle))
    return liftEnd(keyBladeOf(surface, handle), *end, to);
  if (double* value = heldNumber(surface, handle, number)) *value = to;
}

NumberPlace placeOfEnd(const Workbench& bench, int blade, int end) {
  return placeInSurface(bench, "/blades/" + std::to_string(blade) + "/end_heights/" + std::to_string(end));
}

NumberPlace placeOf(const Workbench& bench, int handle, HandleNumber number) {
  const std::optional<DesignedSurface>& surface = bench.source().surface;
  if (!surface) return [] { return std::string(); };
  if (const auto* poles = std::get_if<PolesSurface>(&surface->shape))
    return placeOfPole(bench, handle / poles->columns, handle % poles->columns);
  const std::string axis = number == HandleNumber::height ? "/1" : "/0";
  if (const std::optional<int> end = endOf(*surface, handle))
    return placeOfEnd(bench, *bladeOf(*surface, handle), *end);
  if (std::holds_alternative<BladesSurface>(surface->shape))
    return placeInSurface(bench, "/blades/" + std::to_string(handle) + "/middle" + axis);
  const std::optional<SectionPoint> at = sectionPointOf(*surface, handle);
  if (!at) return [] { return std::string(); };
  const SectionCurve& section = std::get<SectionsSurface>(surface->shape).sections[std::size_t(at->section)];
  return placeInSurface(bench, "/sections/" + std::to_string(at->section) + "/" +
                                   kSectionKinds[int(section.kind)] + "/" + std::to_string(at->point) + axis);
}

bool keepsOrder(const DesignedSurface& was, const DesignedSurface& now) {
  constexpr double kLeast = 0.999;  // mm between neighbours: 1, but for rounding
  const auto *before = std::get_if<SectionsSurface>(&was.shape),
             *after = std::get_if<SectionsSurface>(&now.shape);
  if (!before || !after) return true;
  for (std::size_t i = 0; i < before->sections.size(); ++i) {
    const auto &from = before->sections[i].points, &to = after->sections[i].points;
    for (std::size_t k = 1; k < from.size(); ++k) {
      const double gap = from[k].x() - from[k - 1].x(), left = to[k].x() - to[k - 1].x();
      // Points that stand one over the other have none.
      if (gap != 0 && (gap > 0 ? left : -left) < std::min(kLeast, std::abs(gap))) return false;
    }
  }
  return true;
}

namespace {

void move(DesignedSurface& moved, const DesignedSurface& from, int handle, const Eigen::Vector2d& by) {
  const auto curveOf = [](auto& of, const SectionPoint& at) -> auto& {
    return std::get<SectionsSurface>(of.shape).sections[std::size_t(at.section)];
  };
  const std::optional<SectionPoint> at = sectionPointOf(moved, handle);
  if (at && curveOf(moved, *at).kind == SectionCurve::Kind::bezier) {
    // From where it was, since it may have followed a neighbour already.
    const auto point = std::size_t(at->point);
    moveBezierPole(curveOf(moved, *at).points, point, curveOf(from, *at).points[point] + by);
    return;
  }
  if (const std::optional<int> end = endOf(moved, handle))
    // From where it was, since its middle or its other end may have moved it.
    return by.y() == 0 ? void()
                       : liftEnd(keyBladeOf(moved, handle), *end,
                                 *numberOf(from, handle, HandleNumber::height) + by.y());
  if (double* x = heldNumber(moved, handle, HandleNumber::across)) *x += by.x();
  if (double* height = heldNumber(moved, handle, HandleNumber::height)) *height += by.y();
}

}  // namespace

DesignedSurface movedBy(const DesignedSurface& surface, const std::vector<int>& handles,
                        const Eigen::Vector2d& by, bool symmetric) {
  DesignedSurface moved = surface;
  std::vector<int> inOrder = handles;  // middles of blades before their ends
  std::ranges::sort(inOrder);
  for (const int handle : inOrder) {
    const int mirror = symmetric ? mirrorOf(surface, handle) : -1;
    move(moved, surface, handle, mirror == handle ? Eigen::Vector2d(0, by.y()) : by);
    if (mirror >= 0 && std::ranges::find(handles, mirror) == handles.end())
      move(moved, surface, mirror, Eigen::Vector2d(-by.x(), by.y()));
  }
  return moved;
}

}  // namespace bw::app
