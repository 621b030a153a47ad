// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/row_actors.h"

#include <vtkDoubleArray.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>

#include "bw/core/sweep/maps.h"

namespace bw::scene {

namespace {

constexpr int kTableColors = 2048;

constexpr double kShortest = 0.04;  ///< diagonals: a shorter line carries no value
constexpr double kLong = 0.6;       ///< diagonals: a longer one carries several
constexpr double kTextSize = 11, kHeight = 15, kLabelPadding = 4, kAir = 10;  ///< device-independent pixels
constexpr std::size_t kMost = 40;

Eigen::Vector3d pointAt(const Polyline& line, double arc) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double step = (line[i + 1] - line[i]).norm();
    if (arc <= step && step > 0) return line[i] + arc / step * (line[i + 1] - line[i]);
    arc -= step;
  }
  return line.back();
}

/// Every so-many-th point of a line, and the last.
Polyline thinned(const Polyline& line, int stride) {
  Polyline some;
  for (std::size_t i = 0; i + 1 < line.size(); i += std::size_t(stride)) some.push_back(line[i]);
  some.push_back(line.back());
  return some;
}

/// Gives a surface the values of a field, one a point. VTK only reads through this pointer.
void shareField(Part& part, const Field& field, const std::vector<double>& values) {
  const auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(field.name.c_str());
  array->SetArray(const_cast<double*>(values.data()), vtkIdType(values.size()), 1);
  part.data()->GetPointData()->AddArray(array);
}

// What a picture does not show, in its pixels, as a part of the range of a map, and of the length of normals:
// how far a surface, its colour and its light are off, and all that lies between two lines so close.
constexpr double kUnseenPlace = 0.1, kUnseenShare = 1.0 / 128, kUnseenNormal = 0.008, kUnseenGap = 1;

constexpr double kLeastSpacing = 9;   ///< device-independent pixels between stations
constexpr double kDashShare = 0.008;  ///< length of a dash, in diagonals

}  // namespace

void IsolineLabels::add(const std::vector<Isoline>& lines, const std::function<std::string(double)>& text,
                        double diagonal) {
  for (const Isoline& isoline : lines) {
    const double length = lengthOf(isoline.line);
    if (length < kShortest * diagonal) continue;
    const bool several = length > kLong * diagonal;
    // The middle first; where it is out of sight a place beside it stands in.
    for (const auto& [share, weight] : {std::pair(0.5, 1.0), std::pair(0.2, 0.4), std::pair(0.8, 0.4)}) {
      if (share != 0.5 && !several) continue;
      places_.push_back({pointAt(isoline.line, share * length), text(isoline.level), weight * length});
    }
  }
  std::ranges::stable_sort(places_, std::greater(), &Place::rank);
}

void IsolineLabels::update(const Projection& view, int width, int height, double pixelRatio,
                           const std::vector<PixelRect>& taken,
                           const std::function<bool(const Eigen::Vector3d&)>& seen) {
  canvas_.begin(height);
  std::vector<PixelRect> boxes = taken;
  // Lines are dark in both themes, and so are their values, on a light ground of their own.
  const TextLook look{kTextSize * pixelRatio, false, kLineOverSurface};
  std::size_t drawn = 0;
  for (const Place& place : places_) {
    if (drawn == kMost) break;
    const Eigen::Vector3d pixel = view.toPixel(place.point);
    if (!view.parallel() && pixel.z() <= 0) continue;
    const double w = canvas_.textWidth(place.text, look) + 2 * kLabelPadding * pixelRatio,
                 h = kHeight * pixelRatio, air = kAir * pixelRatio;
    const PixelRect box{pixel.x() - 0.5 * w, pixel.y() - 0.5 * h, w, h};
    const PixelRect wide{box.x - air, box.y - air, w + 2 * air, h + 2 * air};
    if (box.x < 0 || box.y < 0 || box.x + w > width || box.y + h > height) continue;
    if (std::any_of(boxes.begin(), boxes.end(), [&](const PixelRect& b) { return b.overlaps(wide); }))
      continue;
    if (!seen(place.point)) continue;
    boxes.push_back(box);
    canvas_.roundedRect(box, 0.5 * h, Rgb::hex(0xFFFFFF), 0.85);
    canvas_.text(place.text, pixel.x(), pixel.y(), Align::center, look);
    ++drawn;
  }
  canvas_.end();
}

CutActors::CutActors(Layers& layers) : table_(vtkSmartPointer<vtkLookupTable>::New()) {
  for (Part* part : {&edges_, &isolines_, &coarseLines_}) part->setFlat();
  for (Part* part : surfaces()) {
    part->mapper()->SetLookupTable(table_);
    part->mapper()->UseLookupTableScalarRangeOn();
    part->mapper()->SetScalarModeToUsePointFieldData();
  }
  for (ThinnedSurface* thinned : {&resting_, &moving_, &solid_}) thinned->part().setVisible(false);
  for (Part* part : parts()) layers.add(Layer::cut, *part);
}

void CutActors::setContent(const Row* row) {
  row_ = row;
  static const TriangleMesh kNone;
  const TriangleMesh& mesh = row ? row->mesh : kNone;
  shareMesh(surface_.data(), mesh.points, mesh.normals, mesh.triangles);
  edges_.setSegments(boundaryEdges(mesh.points, mesh.triangles));
  for (Part* part : {&isolines_, &coarseLines_}) part->clear();
  for (ThinnedSurface* thinned : {&resting_, &moving_, &solid_}) thinned->clear();
  isolined_.clear();
  lineStride_ = 0;
  pixel_ = -1;
  reach_ = 0;
  if (mesh.triangles.empty()) return;
  for (const Field& field : row->cut->grid.fields) {
    if (field.values.size() != mesh.points.size()) continue;
    shareField(surface_, field, field.values);
    if (mapRule(field.name) == MapRule::banded) {
      const FieldSummary summary = summarize(field.values);
      reach_ = std::max(std::abs(summary.min), std::abs(summary.max));
    }
  }
}

void ThinnedSurface::clear() {
  part_.clear();
  mesh_ = {};
  fields_.clear();
  kept_ = {};
}

void ThinnedSurface::make(const Row& row, const KeptLines& kept) {
  if (kept == kept_) return;
  clear();
  kept_ = kept;
  const SurfaceGrid& grid = row.cut->grid;
  const std::vector<int>&rows = kept.rows, &columns = kept.columns;
  std::vector<std::size_t> points;
  for (const int r : rows)
    for (const int c : columns) points.push_back(std::size_t(r) * std::size_t(grid.columns) + std::size_t(c));
  const std::vector<double>& depths = row.cut->depths;
  const auto gone = [&](std::size_t corner) {
    return depths.size() == grid.points.size() && depths[corner] < 0;
  };
  const auto add = [&](const std::array<int, 3>& t) {
    const auto at = [&](std::size_t k) { return points[std::size_t(t[k])]; };
    if (gone(at(0)) && gone(at(1)) && gone(at(2))) return;
    for (std::size_t k = 0; k < 3; ++k)
      if (!grid.points[at(k)].allFinite()) return;
    mesh_.triangles.push_back(t);
  };
  const int across = int(columns.size());
  for (int r = 0; r + 1 < int(rows.size()); ++r)
    for (int c = 0; c + 1 < across; ++c) {
      const int a = r * across + c, b = a + 1, d = a + across, e = d + 1;
      add({a, d, e});
      add({a, e, b});
    }
  for (const std::size_t i : points) {
    mesh_.points.push_back(row.mesh.points[i]);
    mesh_.normals.push_back(row.mesh.normals[i]);
  }
  shareMesh(part_.data(), mesh_.points, mesh_.normals, mesh_.triangles);
  fields_.reserve(grid.fields.size());
  for (const Field& field : grid.fields) {
    if (field.values.size() != grid.points.size()) continue;
    std::vector<double>& values = fields_.emplace_back();
    for (const std::size_t i : points) values.push_back(field.values[i]);
    shareField(part_, field, values);
  }
}

void CutActors::makeCoarseLines(int stride) {
  lineStride_ = stride;
  std::vector<Polyline> drawn;
  for (const Isoline& isoline : lines_) drawn.push_back(thinned(isoline.line, stride));
  coarseLines_.setLines(drawn);
}

void CutActors::setStyle(const Style& style, const Rgb& background) {
  const double keep = keptColor(style.stale), px = style.pixelRatio;
  const bool shown = row_ && row_->covered(style);
  const Field* field = shown ? row_->field() : nullptr;
  shown_ = shown;
  surface_.setVisible(shown);
  for (ThinnedSurface* thinned : {&resting_, &moving_, &solid_}) thinned->part().setVisible(false);
  edges_.setVisible(shown);
  lined_ = field && style.isolines && mapRule(field->name) != MapRule::words;
  isolines_.setVisible(lined_);
  coarseLines_.setVisible(false);
  if (!shown) return;
  for (Part* part : surfaces()) {
    part->setOpacity(std::clamp(style.of(Kind::cut, row_->id).opacity, 0.0, 1.0));
    part->setColor(theme(style.dark).cut);
    part->mapper()->SetScalarVisibility(field != nullptr);
    // A map must keep its colours; the form may only speak softly.
    if (field)
      part->setMatte(0.70, 0.32, 0.0);
    else
      part->setMatte(0.38, 0.66, 0.05);
    part->setFade(keep, background);
    if (!field) continue;
    part->mapper()->SelectColorArray(field->name.c_str());
    // Between two words there is no third.
    part->mapper()->SetInterpolateScalarsBeforeMapping(mapRule(field->name) != MapRule::words);
  }
  if (field) {
    const ColorMap& map = row_->map->colors;
    if (map != tableMap_ || table_->GetNumberOfTableValues() != kTableColors) {
      tableMap_ = map;
      table_->SetNumberOfTableValues(kTableColors);
      table_->SetRange(map.range.first, map.range.second);
      for (int i = 0; i < kTableColors; ++i) {
        const Rgb c =
            map.at(map.range.first + (i + 0.5) / kTableColors * (map.range.second - map.range.first));
        table_->SetTableValue(i, c.r, c.g, c.b, 1);
      }
      table_->SetNanColor(0.6, 0.6, 0.6, 1);
    }
  }
  edges_.setLine(Rgb::hex(0x4A5058), px);
  edges_.setFade(keep, background);
  if (!lined_) return;
  const Ticks ticks = legendTicks(field->name, row_->map->colors.range);
  if (isolined_ != field->name || levels_.values != ticks.values) {
    isolined_ = field->name;
    levels_ = ticks;
    lines_ = joinedIsolines(row_->mesh.points, row_->mesh.triangles, field->values, ticks.values);
    std::vector<Polyline> drawn;
    for (const Isoline& isoline : lines_) drawn.push_back(isoline.line);
    isolines_.setLines(drawn);
    lineStride_ = 0;
  }
  for (Part* part : {&isolines_, &coarseLines_}) {
    part->setLine(kLineOverSurface, px);
    part->setFade(keep, background);
  }
}

void CutActors::label(IsolineLabels& labels, double diagonal) const {
  if (!lined_) return;
  const bool sign = mapRule(isolined_) == MapRule::banded;
  labels.add(
      lines_, [&](double level) { return tickText(level, levels_.decimals, sign); }, diagonal);
}

void CutActors::findLinesAtRest(double pixel) {
  const Field* field = row_->field();
  const auto range = field ? row_->map->colors.range : std::pair(0.0, 0.0);
  const std::string name = field ? field->name : std::string();
  const double width = range.second - range.first;
  const bool otherSize = pixel != pixel_;
  if (!otherSize && name == pixelField_ && width == pixelRange_) return;
  pixel_ = pixel;
  pixelField_ = name;
  pixelRange_ = width;
  const SurfaceGrid& grid = row_->cut->grid;
  const std::vector<Eigen::Vector3d>& normals = row_->mesh.normals;
  const Unseen unseen{kUnseenPlace * pixel, kUnseenNormal, kUnseenShare * width, kUnseenGap * pixel};
  const KeptLines all{everySoMany(grid.rows, 1), everySoMany(grid.columns, 1)};
  // Where a part of the surface is not there, and between two words, a border would move.
  const bool whole = std::ranges::none_of(row_->cut->depths, [](double depth) { return depth < 0; });
  const bool words = field && mapRule(name) == MapRule::words;
  const bool valued = field && field->values.size() == grid.points.size();
  if (otherSize) bare_ = whole ? unseenLines(grid, normals, nullptr, unseen) : all;
  atRest_ = !whole || words ? all : valued ? unseenLines(grid, normals, &field->values, unseen) : bare_;
}

void CutActors::update(double line, double pixel, int stride, bool draft) {
  for (Part* part : {&edges_, &isolines_, &coarseLines_}) part->setBare(draft);
  const bool gridded = shown_ && row_->mesh.normals.size() == row_->cut->grid.points.size();
  const bool atRest = gridded && !draft, coarse = gridded && draft && stride > 1;
  if (coarse) {
    const SurfaceGrid& grid = row_->cut->grid;
    moving_.make(*row_, {everySoMany(grid.rows, stride), everySoMany(grid.columns, stride)});
  }
  if (atRest) {
    findLinesAtRest(pixel);
    resting_.make(*row_, atRest_);
    solid_.make(*row_, bare_);
  }
  surface_.setVisible(shown_ && !atRest && !coarse);
  moving_.part().setVisible(coarse);
  for (ThinnedSurface* thinned : {&resting_, &solid_}) thinned->part().setVisible(atRest);
  // Between two points that were left out a line may lie below the surface: not by more than that is coarser.
  if (coarse && lined_ && stride != lineStride_) makeCoarseLines(stride);
  isolines_.setVisible(lined_ && !coarse);
  coarseLines_.setVisible(lined_ && coarse);
  edges_.setDepthShift(line);
  for (Part* part : {&isolines_, &coarseLines_}) part->setDepthShift(1.2 * line);
}

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

void StationLines::setDiagonal(double diagonal) {
  dash_ = kDashShare * diagonal;
  valid_ = valid_ && !bladesShown_;
  selectedIndex_ = -1;
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

bool StationLines::drawn(std::size_t index) const {
  const std::size_t count = std::max(row_->stations->size(), row_->blades->size());
  return index % std::size_t(stride_) == 0 || index + 1 == count;  // the first and the last are always there
}

void StationLines::rebuildStations() {
  std::vector<Polyline> lines;
  for (std::size_t i = 0; i < row_->stations->size(); ++i)
    if (const Polyline& line = (*row_->stations)[i]; drawn(i) && usable(line))
      lines.push_back(thinned(line, along_));
  stations_.setLines(lines);
}

void StationLines::rebuild() {
  rebuildStations();
  Extensions extensions;
  for (std::size_t i = 0; bladesShown_ && i < row_->blades->size(); ++i)
    if (drawn(i)) addExtensions(i, extensions);
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

void StationLines::update(const Style& style, double depthShift, double millimetresPerPixel, int along,
                          bool draft) {
  if (!row_) return;
  for (Part* part : parts()) part->setBare(draft);
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
  const bool other = along != along_;
  along_ = along;
  if (stride != stride_ || !valid_) {
    stride_ = stride;
    rebuild();
  } else if (other) {
    rebuildStations();
  }
}

}  // namespace bw::scene
