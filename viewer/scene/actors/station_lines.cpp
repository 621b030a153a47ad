// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/station_lines.h"

#include <algorithm>

namespace bw::scene {

namespace {

constexpr double kLeastSpacing = 9;   ///< device-independent pixels between stations
constexpr double kDashShare = 0.008;  ///< length of a dash, in diagonals

}  // namespace

StationLines::StationLines(Layers& layers) {
  for (Part* part : parts()) {
    part->setFlat();
    layers.add(Layer::stations, *part);
  }
}

std::array<Part*, 5> StationLines::parts() {
  return {&stations_, &bladesInside_, &bladeDashes_, &selected_, &selectedDashes_};
}

void StationLines::setContent(const Row* row, double diagonal) {
  row_ = row;
  dash_ = kDashShare * diagonal;
  for (Part* part : parts()) part->clear();
  valid_ = false;
  selectedIndex_ = -1;
  if (!row) return;
  const Polyline* before = nullptr;
  double travel = 0;
  int gaps = 0;
  for (const Polyline& line : *row->stations) {
    if (!usable(line)) continue;
    if (before) {
      travel += (line[line.size() / 2] - (*before)[before->size() / 2]).norm();
      ++gaps;
    }
    before = &line;
  }
  spacing_ = gaps > 0 ? travel / gaps : 0;
}

void StationLines::select(int index) {
  if (index == selectedIndex_) return;
  selectedIndex_ = index;
  selected_.clear();
  selectedDashes_.clear();
  const std::vector<Polyline>& stations = *row_->stations;
  if (index < 0 || index >= int(stations.size()) || !usable(stations[std::size_t(index)])) return;
  Extensions extensions;
  if (index < int(row_->blades->size())) addExtensions(std::size_t(index), extensions);
  extensions.solid.push_back(stations[std::size_t(index)]);
  selected_.setLines(extensions.solid);
  selectedDashes_.setSegments(extensions.dashed);
}

void StationLines::addExtensions(std::size_t index, Extensions& extensions) const {
  const std::vector<Polyline>& stations = *row_->stations;
  const Box* block = row_->block;
  const Polyline none, &station = index < stations.size() ? stations[index] : none;
  for (const Polyline& extension : beyondStation((*row_->blades)[index], station)) {
    const std::vector<Polyline> outside =
        block ? clipped(extension, *block, Side::outside) : std::vector<Polyline>{extension};
    for (const Polyline& piece : outside) {
      const Segments more = dashes(piece, dash_, 0.7 * dash_);
      extensions.dashed.insert(extensions.dashed.end(), more.begin(), more.end());
    }
    if (!block) continue;
    for (Polyline& piece : clipped(extension, *block, Side::inside))
      extensions.solid.push_back(std::move(piece));
  }
}

void StationLines::rebuild() {
  const std::vector<Polyline>&stations = *row_->stations, &blades = *row_->blades;
  std::vector<Polyline> lines;
  Extensions extensions;
  const std::size_t count = std::max(stations.size(), blades.size());
  for (std::size_t i = 0; i < count; ++i) {
    // The first and the last are always there.
    if (i % std::size_t(stride_) != 0 && i + 1 != count) continue;
    if (i < stations.size() && usable(stations[i])) lines.push_back(stations[i]);
    if (bladesShown_ && i < blades.size()) addExtensions(i, extensions);
  }
  stations_.setLines(lines);
  bladesInside_.setLines(extensions.solid);
  bladeDashes_.setSegments(extensions.dashed);
  valid_ = true;
}

void StationLines::setStyle(const Style& style, const Rgb& background) {
  if (!row_) return;
  const Theme& colors = theme(style.dark);
  const double keep = keptColor(style.stale), px = style.pixelRatio;
  stations_.setVisible(style.of(Kind::station, row_->id).visible);
  stations_.setLine(row_->covered(style) ? kLineOverSurface : colors.station, px);
  stations_.setFade(keep, background);
  select(style.selected.row() == row_->id ? style.selected.station : -1);
  for (Part* part : {&selected_, &selectedDashes_}) {
    part->setVisible(selectedIndex_ >= 0);
    part->setLine(colors.selection, part == &selected_ ? 2.5 * px : 1.5 * px);
    part->setFade(keep, background);
  }

  const bool bladesShown = style.of(Kind::blade, row_->id).visible;
  if (bladesShown != bladesShown_) {
    bladesShown_ = bladesShown;
    valid_ = false;
  }
  for (Part* part : {&bladesInside_, &bladeDashes_}) {
    part->setVisible(bladesShown);
    part->setLine(colors.station, px);
    part->setOpacity(0.7);
    part->setFade(keep, background);
  }
}

void StationLines::update(const Style& style, double depthShift, double millimetresPerPixel) {
  if (!row_) return;
  stations_.setDepthShift(depthShift);
  for (Part* part : {&selected_, &selectedDashes_}) part->setDepthShift(2 * depthShift);

  // Dense lines must not become a veil over the map: every second, fifth, tenth station is drawn where they
  // would crowd.
  stations_.setOpacity(row_->covered(style) ? 0.42 : 0.75);
  const double spacing = spacing_ / std::max(1e-12, millimetresPerPixel * style.pixelRatio);
  int stride = 1;
  for (const int candidate : {1, 2, 5, 10, 20, 50, 100, 200, 500}) {
    stride = candidate;
    if (spacing * candidate >= kLeastSpacing) break;
  }
  if (stride != stride_ || !valid_) {
    stride_ = stride;
    rebuild();
  }
}

}  // namespace bw::scene
