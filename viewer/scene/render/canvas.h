// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkActor2D.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <string>
#include <vector>

#include "bw/scene/scene.h"
#include "scene/theme.h"

class vtkCellArray;
class vtkPoints;
class vtkRenderer;
class vtkTextProperty;
class vtkUnsignedCharArray;

namespace bw::scene {

/// Sets the typeface that the windows of the desktop use too: Inter, Noto Sans or DejaVu Sans, whichever is
/// installed; otherwise VTK's own.
void useInterfaceFont(vtkTextProperty* property, bool bold);

enum class Align { left, center, right };

struct TextLook {
  double size = 12;  ///< pixels
  bool bold = false;
  Rgb color;
};

/// Flat drawing over (or, if `behind`, under) the scene, in pixels from the upper left corner. Draw between
/// begin() and end().
class Canvas {
 public:
  explicit Canvas(bool behind = false);
  /// Texts are drawn by that renderer; the rest is the actor returned, which it has yet to be given.
  vtkActor2D* drawnBy(vtkRenderer* renderer);

  /// `height` is that of the picture.
  void begin(int height);
  void rect(const PixelRect& rect, const Rgb& color, double opacity = 1);
  void roundedRect(const PixelRect& rect, double radius, const Rgb& color, double opacity = 1);
  void triangle(double x0, double y0, double x1, double y1, double x2, double y2, const Rgb& color,
                double opacity = 1);
  void disc(double x, double y, double radius, const Rgb& color);
  /// Text whose digits stand centred on `y`, placed on `x` by `align`.
  void text(const std::string& text, double x, double y, Align align, const TextLook& look);
  void end();

  /// Width of a text in pixels.
  static double textWidth(const std::string& text, const TextLook& look);
  const std::vector<Overlay::Text>& texts() const { return texts_; }

 private:
  void vertex(double x, double y, const Rgb& color, double opacity);
  void fan(int first, int count);

  bool behind_;
  int height_ = 0;
  vtkRenderer* renderer_ = nullptr;
  vtkSmartPointer<vtkActor2D> actor_;
  vtkSmartPointer<vtkPolyData> data_;
  vtkSmartPointer<vtkPoints> points_;
  vtkSmartPointer<vtkCellArray> polygons_;
  vtkSmartPointer<vtkUnsignedCharArray> colors_;
  std::vector<vtkSmartPointer<vtkTextActor>> textActors_;
  std::size_t used_ = 0;
  std::vector<Overlay::Text> texts_;
};

}  // namespace bw::scene
