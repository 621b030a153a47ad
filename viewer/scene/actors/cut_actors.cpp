// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/cut_actors.h"

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
constexpr double kTextSize = 11, kHeight = 15, kPadding = 4, kAir = 10;  ///< device-independent pixels
constexpr std::size_t kMost = 40;

Eigen::Vector3d pointAt(const Polyline& line, double arc) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double step = (line[i + 1] - line[i]).norm();
    if (arc <= step && step > 0) return line[i] + arc / step * (line[i + 1] - line[i]);
    arc -= step;
  }
  return line.back();
}

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
    const double w = Canvas::textWidth(place.text, look) + 2 * kPadding * pixelRatio,
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
  edges_.setFlat();
  isolines_.setFlat();
  surface_.mapper()->SetInterpolateScalarsBeforeMapping(true);
  surface_.mapper()->SetLookupTable(table_);
  surface_.mapper()->UseLookupTableScalarRangeOn();
  surface_.mapper()->SetScalarModeToUsePointFieldData();
  for (Part* part : parts()) layers.add(Layer::cut, *part);
}

void CutActors::setContent(const Row* row) {
  row_ = row;
  static const TriangleMesh kNone;
  const TriangleMesh& mesh = row ? row->mesh : kNone;
  shareMesh(surface_.data(), mesh.points, mesh.normals, mesh.triangles);
  edges_.setSegments(boundaryEdges(mesh.points, mesh.triangles));
  isolines_.clear();
  isolined_.clear();
  reach_ = 0;
  if (mesh.triangles.empty()) return;
  for (const Field& field : row->cut->grid.fields) {
    if (field.values.size() != mesh.points.size()) continue;
    const auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetName(field.name.c_str());
    // VTK only reads through this pointer.
    array->SetArray(const_cast<double*>(field.values.data()), vtkIdType(field.values.size()), 1);
    surface_.data()->GetPointData()->AddArray(array);
    if (mapRule(field.name) == MapRule::banded) {
      const FieldSummary summary = summarize(field.values);
      reach_ = std::max(std::abs(summary.min), std::abs(summary.max));
    }
  }
}

void CutActors::setStyle(const Style& style, const Rgb& background) {
  const double keep = keptColor(style.stale), px = style.pixelRatio;
  const bool shown = row_ && row_->covered(style);
  const Field* field = shown ? row_->field() : nullptr;
  surface_.setVisible(shown);
  edges_.setVisible(shown);
  lined_ = field && style.isolines;
  isolines_.setVisible(lined_);
  if (!shown) return;
  surface_.setOpacity(std::clamp(style.of(Kind::cut, row_->id).opacity, 0.0, 1.0));
  surface_.setColor(theme(style.dark).cut);
  surface_.mapper()->SetScalarVisibility(field != nullptr);
  if (field) {
    const ColorMap& map = row_->map->colors;
    // A map must keep its colours; the form may only speak softly.
    surface_.setMatte(0.70, 0.32, 0.0);
    surface_.mapper()->SelectColorArray(field->name.c_str());
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
  } else {
    surface_.setMatte(0.38, 0.66, 0.05);
  }
  surface_.setFade(keep, background);
  edges_.setLine(Rgb::hex(0x4A5058), px);
  edges_.setFade(keep, background);
  if (!lined_) return;
  const Ticks ticks = legendTicks(row_->map->colors.range);
  if (isolined_ != field->name || levels_.values != ticks.values) {
    isolined_ = field->name;
    levels_ = ticks;
    lines_ = joinedIsolines(row_->mesh.points, row_->mesh.triangles, field->values, ticks.values);
    std::vector<Polyline> drawn;
    for (const Isoline& isoline : lines_) drawn.push_back(isoline.line);
    isolines_.setLines(drawn);
  }
  isolines_.setLine(kLineOverSurface, px);
  isolines_.setFade(keep, background);
}

void CutActors::label(IsolineLabels& labels, double diagonal) const {
  if (!lined_) return;
  const bool sign = mapRule(isolined_) == MapRule::banded;
  labels.add(
      lines_, [&](double level) { return tickText(level, levels_.decimals, sign); }, diagonal);
}

void CutActors::update(double line) {
  edges_.setDepthShift(line);
  isolines_.setDepthShift(1.2 * line);
}

}  // namespace bw::scene
