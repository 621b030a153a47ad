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

void applyLook(vtkTextProperty* property, const TextLook& look) {
  useInterfaceFont(property, look.bold);
  property->SetFontSize(std::max(6, int(std::lround(look.size))));
  property->SetColor(look.color.r, look.color.g, look.color.b);
  property->SetJustificationToLeft();
  property->SetVerticalJustificationToBottom();
}

struct TextBox {
  int left = 0, bottom = 0, width = 0, height = 0;  ///< of the ink, from the anchor, y upwards
};

TextBox measure(const std::string& text, vtkTextProperty* property) {
  std::array<int, 4> box{};
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  if (!renderer || !renderer->GetBoundingBox(property, text, box.data(), kDpi)) return {};
  return {box[0], box[2], box[1] - box[0] + 1, box[3] - box[2] + 1};
}

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
  used_ = 0;
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

void Canvas::text(const std::string& text, double x, double y, Align align, const TextLook& look) {
  if (used_ == textActors_.size()) {
    const auto actor = vtkSmartPointer<vtkTextActor>::New();
    actor->PickableOff();
    if (behind_) actor->GetProperty()->SetDisplayLocationToBackground();
    if (renderer_) renderer_->AddActor2D(actor);
    textActors_.push_back(actor);
  }
  vtkTextActor* actor = textActors_[used_++];
  applyLook(actor->GetTextProperty(), look);
  actor->SetInput(text.c_str());
  const TextBox ink = measure(text, actor->GetTextProperty());
  const TextBox digits = measure("0", actor->GetTextProperty());
  const double left = align == Align::left ? x : align == Align::center ? x - 0.5 * ink.width : x - ink.width;
  const double anchorX = std::floor(left + 0.5) - ink.left;
  const double anchorY = std::floor(height_ - y - 0.5 * digits.height + 0.5) - digits.bottom;
  actor->SetPosition(anchorX, anchorY);
  actor->VisibilityOn();
  texts_.push_back({text,
                    {anchorX + ink.left, height_ - (anchorY + ink.bottom + ink.height), double(ink.width),
                     double(ink.height)}});
}

void Canvas::end() {
  data_->SetPoints(points_);
  data_->SetPolys(polygons_);
  data_->GetPointData()->SetScalars(colors_);
  actor_->SetVisibility(points_->GetNumberOfPoints() > 0);
  for (std::size_t i = used_; i < textActors_.size(); ++i) textActors_[i]->VisibilityOff();
}

double Canvas::textWidth(const std::string& text, const TextLook& look) {
  const auto property = vtkSmartPointer<vtkTextProperty>::New();
  applyLook(property, look);
  return measure(text, property).width;
}

}  // namespace bw::scene
