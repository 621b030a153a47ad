// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/station_lines.h"

#include <vtkRenderer.h>

#include <algorithm>

namespace bw::scene {

namespace {

constexpr double kLeastSpacing = 9;   ///< device-independent pixels between stations
constexpr double kDashShare = 0.008;  ///< length of a dash, in diagonals

}  // namespace

StationLines::StationLines() {
  for (Part* part : parts()) part->setFlat();
}

std::array<Part*, 5> StationLines::parts() {
  return {&stations_, &bladesInside_, &bladeDashes_, &selected_, &selectedDashes_};
}

void StationLines::addTo(vtkRenderer* renderer) {
  for (Part* part : parts()) renderer->AddActor(part->actor());
}

void StationLines::setContent(const Content& content, double diagonal) {
  dash_ = kDashShare * diagonal;
  std::vector<Polyline> lines;
  double travel = 0;
  for (const Polyline& line : content.stations) {
    if (!usable(line)) continue;
    if (!lines.empty()) travel += (line[line.size() / 2] - lines.back()[lines.back().size() / 2]).norm();
    lines.push_back(line);
  }
  spacing_ = lines.size() > 1 ? travel / double(lines.size() - 1) : 0;
  valid_ = false;
  selectedIndex_ = -1;
  for (Part* part : {&selected_, &selectedDashes_}) part->clear();
}

void StationLines::select(const Content& content, int index) {
  if (index == selectedIndex_) return;
  selectedIndex_ = index;
  selected_.clear();
  selectedDashes_.clear();
  if (index < 0 || index >= int(content.stations.size()) || !usable(content.stations[std::size_t(index)]))
    return;
  Extensions extensions;
  if (index < int(content.blades.size())) addExtensions(content, std::size_t(index), extensions);
  extensions.solid.push_back(content.stations[std::size_t(index)]);
  selected_.setLines(extensions.solid);
  selectedDashes_.setSegments(extensions.dashed);
}

void StationLines::addExtensions(const Content& content, std::size_t index, Extensions& extensions) const {
  const Polyline none, &station = index < content.stations.size() ? content.stations[index] : none;
  for (const Polyline& extension : beyondStation(content.blades[index], station)) {
    const std::vector<Polyline> outside =
        content.block ? clipped(extension, *content.block, Side::outside) : std::vector<Polyline>{extension};
    for (const Polyline& piece : outside) {
      const Segments more = dashes(piece, dash_, 0.7 * dash_);
      extensions.dashed.insert(extensions.dashed.end(), more.begin(), more.end());
    }
    if (!content.block) continue;
    for (Polyline& piece : clipped(extension, *content.block, Side::inside))
      extensions.solid.push_back(std::move(piece));
  }
}

void StationLines::rebuild(const Content& content) {
  std::vector<Polyline> lines;
  Extensions extensions;
  const std::size_t count = std::max(content.stations.size(), content.blades.size());
  for (std::size_t i = 0; i < count; ++i) {
    // The first and the last are always there.
    if (i % std::size_t(stride_) != 0 && i + 1 != count) continue;
    if (i < content.stations.size() && usable(content.stations[i])) lines.push_back(content.stations[i]);
    if (bladesShown_ && i < content.blades.size()) addExtensions(content, i, extensions);
  }
  stations_.setLines(lines);
  bladesInside_.setLines(extensions.solid);
  bladeDashes_.setSegments(extensions.dashed);
  valid_ = true;
}

void StationLines::setStyle(const Content& content, const Style& style, bool overSurface,
                            const Rgb& background) {
  const Theme& colors = theme(style.dark);
  const double keep = keptColor(style.stale), px = style.pixelRatio;
  stations_.setVisible(style.showStations);
  stations_.setColor(overSurface ? kLineOverSurface : colors.station);
  stations_.setLineWidth(px);
  stations_.setFade(keep, background);
  select(content, style.selectedStation);
  for (Part* part : {&selected_, &selectedDashes_}) {
    part->setVisible(selectedIndex_ >= 0);
    part->setColor(colors.selection);
    part->setFade(keep, background);
  }
  selected_.setLineWidth(2.5 * px);
  selectedDashes_.setLineWidth(1.5 * px);

  if (style.showBlades != bladesShown_) {
    bladesShown_ = style.showBlades;
    valid_ = false;
  }
  for (Part* part : {&bladesInside_, &bladeDashes_}) {
    part->setVisible(style.showBlades);
    part->setColor(colors.station);
    part->setLineWidth(px);
    part->setOpacity(0.7);
    part->setFade(keep, background);
  }
}

void StationLines::update(const Content& content, const Style& style, bool overSurface, double depthShift,
                          double millimetresPerPixel) {
  stations_.setDepthShift(depthShift);
  for (Part* part : {&selected_, &selectedDashes_}) part->setDepthShift(2 * depthShift);

  // Dense lines must not become a veil over the map: every second, fifth, tenth station is drawn where they
  // would crowd.
  stations_.setOpacity(overSurface ? 0.42 : 0.75);
  const double spacing = spacing_ / std::max(1e-12, millimetresPerPixel * style.pixelRatio);
  int stride = 1;
  for (const int candidate : {1, 2, 5, 10, 20, 50, 100, 200, 500}) {
    stride = candidate;
    if (spacing * candidate >= kLeastSpacing) break;
  }
  if (stride != stride_ || !valid_) {
    stride_ = stride;
    rebuild(content);
  }
}

}  // namespace bw::scene
