// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/render/layers.h"

#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "bw/core/base/units.h"

namespace bw::scene {

namespace {

struct Typeface {
  std::string regular, bold;
};

/// Looked up at the places where Debian, Fedora and Arch put them; reading all fonts of a system would take
/// too long.
Typeface findTypeface() {
  struct Place {
    const char *folder, *regular, *bold;
  };
  constexpr std::array<Place, 9> kPlaces{{
      {"/usr/share/fonts/opentype/inter", "Inter-Regular.otf", "Inter-SemiBold.otf"},
      {"/usr/share/fonts/truetype/inter", "Inter-Regular.ttf", "Inter-SemiBold.ttf"},
      {"/usr/share/fonts/inter", "Inter-Regular.otf", "Inter-SemiBold.otf"},
      {"/usr/share/fonts/truetype/noto", "NotoSans-Regular.ttf", "NotoSans-Bold.ttf"},
      {"/usr/share/fonts/google-noto", "NotoSans-Regular.ttf", "NotoSans-Bold.ttf"},
      {"/usr/share/fonts/noto", "NotoSans-Regular.ttf", "NotoSans-Bold.ttf"},
      {"/usr/share/fonts/truetype/dejavu", "DejaVuSans.ttf", "DejaVuSans-Bold.ttf"},
      {"/usr/share/fonts/dejavu-sans-fonts", "DejaVuSans.ttf", "DejaVuSans-Bold.ttf"},
      {"/usr/share/fonts/TTF", "DejaVuSans.ttf", "DejaVuSans-Bold.ttf"},
  }};
  for (const Place& place : kPlaces) {
    const std::filesystem::path folder(place.folder);
    std::error_code ignored;
    if (std::filesystem::is_regular_file(folder / place.regular, ignored) &&
        std::filesystem::is_regular_file(folder / place.bold, ignored)) {
      return {(folder / place.regular).string(), (folder / place.bold).string()};
    }
  }
  return {};
}

constexpr int kDpi = 72;  ///< makes a font's point one pixel

int fontSize(const TextLook& look) { return std::max(6, int(std::lround(look.size))); }

void applyLook(vtkTextProperty* property, const TextLook& look) {
  useInterfaceFont(property, look.bold);
  property->SetFontSize(fontSize(look));
  property->SetColor(look.color.r, look.color.g, look.color.b);
  property->SetJustificationToLeft();
  property->SetVerticalJustificationToBottom();
}

constexpr std::size_t kMostMeasured = 2000;  ///< texts that are known with their size

}  // namespace

void useInterfaceFont(vtkTextProperty* property, bool bold) {
  static const Typeface kTypeface = findTypeface();
  if (kTypeface.regular.empty()) {
    property->SetFontFamilyToArial();
    property->SetBold(bold);
    return;
  }
  property->SetFontFamily(VTK_FONT_FILE);
  property->SetFontFile((bold ? kTypeface.bold : kTypeface.regular).c_str());
}

Canvas::Canvas(bool behind)
    : behind_(behind),
      actor_(vtkSmartPointer<vtkActor2D>::New()),
      data_(vtkSmartPointer<vtkPolyData>::New()) {
  const auto mapper = vtkSmartPointer<vtkPolyDataMapper2D>::New();
  mapper->SetInputData(data_);
  actor_->SetMapper(mapper);
  actor_->PickableOff();
  if (behind_) actor_->GetProperty()->SetDisplayLocationToBackground();
}

vtkActor2D* Canvas::drawnBy(vtkRenderer* renderer) {
  renderer_ = renderer;
  return actor_;
}

void Canvas::begin(int height) {
  height_ = height;
  points_ = vtkSmartPointer<vtkPoints>::New();
  polygons_ = vtkSmartPointer<vtkCellArray>::New();
  colors_ = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors_->SetNumberOfComponents(4);
  texts_.clear();
  placed_.clear();
}

void Canvas::vertex(double x, double y, const Rgb& color, double opacity) {
  const auto byte = [](double c) { return float(std::lround(255 * std::clamp(c, 0.0, 1.0))); };
  points_->InsertNextPoint(x, height_ - y, 0);
  colors_->InsertNextTuple4(byte(color.r), byte(color.g), byte(color.b), byte(opacity));
}

void Canvas::fan(int first, int count) {
  for (int i = 1; i + 1 < count; ++i) {
    const std::array<vtkIdType, 3> corners{first, first + i, first + i + 1};
    polygons_->InsertNextCell(3, corners.data());
  }
}

void Canvas::rect(const PixelRect& r, const Rgb& color, double opacity) {
  const int first = int(points_->GetNumberOfPoints());
  vertex(r.x, r.y, color, opacity);
  vertex(r.x, r.y + r.height, color, opacity);
  vertex(r.x + r.width, r.y + r.height, color, opacity);
  vertex(r.x + r.width, r.y, color, opacity);
  fan(first, 4);
}

void Canvas::roundedRect(const PixelRect& r, double radius, const Rgb& color, double opacity) {
  const int first = int(points_->GetNumberOfPoints()), steps = 6;
  const std::array<std::array<double, 2>, 4> centers{{{r.x + r.width - radius, r.y + radius},
                                                      {r.x + radius, r.y + radius},
                                                      {r.x + radius, r.y + r.height - radius},
                                                      {r.x + r.width - radius, r.y + r.height - radius}}};
  for (std::size_t corner = 0; corner < 4; ++corner) {
    for (int k = 0; k <= steps; ++k) {
      const double angle = (double(corner) + double(k) / steps) * kPi / 2;
      vertex(centers[corner][0] + radius * std::cos(angle), centers[corner][1] - radius * std::sin(angle),
             color, opacity);
    }
  }
  fan(first, 4 * (steps + 1));
}

void Canvas::triangle(double x0, double y0, double x1, double y1, double x2, double y2, const Rgb& color,
                      double opacity) {
  const int first = int(points_->GetNumberOfPoints());
  vertex(x0, y0, color, opacity);
  vertex(x1, y1, color, opacity);
  vertex(x2, y2, color, opacity);
  fan(first, 3);
}

void Canvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width, const Rgb& color,
                  double opacity) {
  const Eigen::Vector2d way = to - from;
  if (!(way.norm() > 0)) return;
  const Eigen::Vector2d side = 0.5 * width * Eigen::Vector2d(-way.y(), way.x()).normalized();
  const Eigen::Vector2d p = from + side, q = to + side, r = to - side, s = from - side;
  triangle(p.x(), p.y(), q.x(), q.y(), r.x(), r.y(), color, opacity);
  triangle(p.x(), p.y(), r.x(), r.y(), s.x(), s.y(), color, opacity);
}

void Canvas::disc(double x, double y, double radius, const Rgb& color) {
  const int first = int(points_->GetNumberOfPoints()), steps = 24;
  for (int k = 0; k < steps; ++k) {
    const double angle = 2 * kPi * k / steps;
    vertex(x + radius * std::cos(angle), y - radius * std::sin(angle), color, 1);
  }
  fan(first, steps);
}

const Canvas::TextBox& Canvas::measured(const std::string& text, const TextLook& look) {
  if (measured_.size() >= kMostMeasured) measured_.clear();
  const auto [place, fresh] = measured_.try_emplace({text, fontSize(look), look.bold});
  TextBox& ink = place->second;
  if (!fresh) return ink;
  const auto property = vtkSmartPointer<vtkTextProperty>::New();
  applyLook(property, look);
  std::array<int, 4> box{};
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  if (renderer && renderer->GetBoundingBox(property, text, box.data(), kDpi))
    ink = {box[0], box[2], box[1] - box[0] + 1, box[3] - box[2] + 1};
  return ink;
}

void Canvas::text(const std::string& text, double x, double y, Align align, const TextLook& look) {
  const TextBox digits = measured("0", look), ink = measured(text, look);
  const double left = align == Align::left ? x : align == Align::center ? x - 0.5 * ink.width : x - ink.width;
  const double anchorX = std::floor(left + 0.5) - ink.left;
  const double anchorY = std::floor(height_ - y - 0.5 * digits.height + 0.5) - digits.bottom;
  placed_.push_back({text, look, anchorX, anchorY});
  texts_.push_back({text,
                    {anchorX + ink.left, height_ - (anchorY + ink.bottom + ink.height), double(ink.width),
                     double(ink.height)}});
}

void Canvas::put(const Placed& placed, TextActor& actor) {
  if (!(actor.placed == placed)) {
    applyLook(actor.actor->GetTextProperty(), placed.look);
    actor.actor->SetInput(placed.text.c_str());
  }
  actor.placed = placed;
  actor.actor->SetPosition(placed.x, placed.y);
  actor.actor->VisibilityOn();
}

/// Gives each text an actor: that of the same text where there is one, since VTK draws a text anew wherever
/// it is another, which costs more than all else that is done for it.
void Canvas::placeTexts() {
  std::size_t used = 0;
  std::vector<const Placed*> others;
  for (const Placed& placed : placed_) {
    const auto same = std::find_if(textActors_.begin() + std::ptrdiff_t(used), textActors_.end(),
                                   [&](const TextActor& actor) { return actor.placed == placed; });
    if (same == textActors_.end()) {
      others.push_back(&placed);
      continue;
    }
    put(placed, *same);
    std::swap(*same, textActors_[used++]);
  }
  for (const Placed* placed : others) {
    if (used == textActors_.size()) {
      TextActor& made = textActors_.emplace_back(TextActor{vtkSmartPointer<vtkTextActor>::New(), {}});
      made.actor->PickableOff();
      if (behind_) made.actor->GetProperty()->SetDisplayLocationToBackground();
      if (renderer_) renderer_->AddActor2D(made.actor);
    }
    put(*placed, textActors_[used++]);
  }
  for (; used < textActors_.size(); ++used) textActors_[used].actor->VisibilityOff();
}

void Canvas::end() {
  data_->SetPoints(points_);
  data_->SetPolys(polygons_);
  data_->GetPointData()->SetScalars(colors_);
  actor_->SetVisibility(points_->GetNumberOfPoints() > 0);
  placeTexts();
}

double Canvas::textWidth(const std::string& text, const TextLook& look) { return measured(text, look).width; }

}  // namespace bw::scene
