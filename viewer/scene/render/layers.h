// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <Eigen/Core>

#include <array>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bw/scene/scene.h"
#include "scene/render/polyline.h"
#include "scene/theme.h"

class vtkCellArray;
class vtkPoints;
class vtkTextProperty;
class vtkUnsignedCharArray;

namespace bw::scene {

/// An actor with a mapper and a data set of its own, and two additions to VTK's shading: a depth shift that
/// settles which of two coinciding things lies in front, and a fade towards the background that keeps solid
/// things solid.
class Part {
 public:
  Part();
  vtkActor* actor() const { return actor_; }
  vtkPolyData* data() const { return data_; }
  vtkPolyDataMapper* mapper() const { return mapper_; }
  vtkProperty* property() const;

  void setVisible(bool on);
  void setColor(const Rgb& color);
  void setOpacity(double opacity);
  /// Colour and width, in pixels, of what are lines.
  void setLine(const Rgb& color, double pixels);
  /// Whether fine lines are drawn bare, in a fraction of the time: for a picture that moves, whose edges are
  /// not smoothed either.
  void setBare(bool bare);
  /// Draws in plain colour, without light.
  void setFlat();
  /// Soft matte foam and card, or a picture of numbers that light must not bend too far.
  void setMatte(double ambient, double diffuse, double specular);
  /// Moves depths by that share of the depth range (in normalised device coordinates), towards the viewer if
  /// negative.
  void setDepthShift(double ndc);
  /// Moves depths by that share (in [0, 1)) of their way to the far plane, beyond which nothing is drawn.
  void setDepthBehind(double share);
  /// Takes away what `plane` does not keep; null keeps all.
  void setCutOpen(vtkPlane* plane);
  /// Mixes `keep` of the colour with 1 − `keep` of `background`.
  void setFade(double keep, const Rgb& background);

  void setLines(const std::vector<Polyline>& lines);
  /// The same, each point in its own colour, and from point to point from one to the next.
  void setLines(const std::vector<Polyline>& lines, const std::vector<std::vector<Rgb>>& colors);
  void setSegments(const Segments& segments);
  /// Flat polygons.
  void setPolygons(const std::vector<Polyline>& polygons);
  void clear();

 private:
  vtkSmartPointer<vtkActor> actor_;
  vtkSmartPointer<vtkPolyDataMapper> mapper_;
  vtkSmartPointer<vtkPolyData> data_;
  double width_ = 1;    ///< pixels, of lines
  bool shines_ = true;  ///< what is drawn
};

/// Points, normals and triangles without copying: the vectors must outlive the data set's use of them.
void shareMesh(vtkPolyData* data, const std::vector<Eigen::Vector3d>& points,
               const std::vector<Eigen::Vector3d>& normals, const std::vector<std::array<int, 3>>& triangles);

/// Sets the typeface that the windows of the desktop use too: Inter, Noto Sans or DejaVu Sans, whichever is
/// installed; otherwise VTK's own.
void useInterfaceFont(vtkTextProperty* property, bool bold);

enum class Align { left, center, right };

struct TextLook {
  double size = 12;  ///< pixels
  bool bold = false;
  Rgb color;
  bool operator==(const TextLook&) const = default;
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
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width, const Rgb& color,
            double opacity = 1);
  /// Text whose digits stand centred on `y`, placed on `x` by `align`.
  void text(const std::string& text, double x, double y, Align align, const TextLook& look);
  void end();

  /// Width of a text in pixels.
  double textWidth(const std::string& text, const TextLook& look);
  const std::vector<Overlay::Text>& texts() const { return texts_; }

 private:
  /// The ink of a text, pixels from its anchor, y upwards.
  struct TextBox {
    int left = 0, bottom = 0, width = 0, height = 0;
  };
  /// A text where it stands, or stood in the last picture.
  struct Placed {
    std::string text;
    TextLook look;
    double x = 0, y = 0;  ///< of the anchor, from the lower left corner
    bool operator==(const Placed& other) const { return text == other.text && look == other.look; }
  };
  struct TextActor {
    vtkSmartPointer<vtkTextActor> actor;
    Placed placed;
  };

  void vertex(double x, double y, const Rgb& color, double opacity);
  void fan(int first, int count);
  const TextBox& measured(const std::string& text, const TextLook& look);
  void put(const Placed& placed, TextActor& actor);
  void placeTexts();

  bool behind_;
  int height_ = 0;
  vtkRenderer* renderer_ = nullptr;
  vtkSmartPointer<vtkActor2D> actor_;
  vtkSmartPointer<vtkPolyData> data_;
  vtkSmartPointer<vtkPoints> points_;
  vtkSmartPointer<vtkCellArray> polygons_;
  vtkSmartPointer<vtkUnsignedCharArray> colors_;
  std::vector<TextActor> textActors_;
  std::vector<Placed> placed_;
  std::vector<Overlay::Text> texts_;
  std::map<std::tuple<std::string, int, bool>, TextBox> measured_;  ///< of texts, their size and weight
};

/// What is drawn after what. Things of the world come first: what is solid, then what lets light through,
/// from the back to the front. Over the world lies what tells of it, and over all of it stand the handles:
/// what marks or moves a place.
enum class Layer {
  ground,
  cut,
  section,
  blade,
  travel,
  blockBack,
  faces,
  target,
  stations,
  glow,
  blockFront,
  overlay,
  handles
};

/// Draws parts and canvases in the order of their layers, and in the order in which they came within one.
/// What was added stays: what VTK holds in the graphics card for it goes with the context.
class Layers {
 public:
  explicit Layers(vtkRenderer* renderer) : renderer_(renderer) {}
  void add(Layer layer, Part& part) { place(parts_, layer, part.actor()); }
  /// Canvases are added before the first picture: their texts come into being with what they show.
  void add(Layer layer, Canvas& canvas) { place(canvases_, layer, canvas.drawnBy(renderer_)); }

 private:
  using Props = std::multimap<Layer, vtkProp*>;
  void place(Props& props, Layer layer, vtkProp* prop) {
    // What comes after it moves to the end of VTK's list, past the new one.
    for (auto next = props.emplace(layer, prop); next != props.end(); ++next) {
      renderer_->GetViewProps()->RemoveItem(next->second);
      renderer_->AddViewProp(next->second);
    }
  }

  vtkRenderer* renderer_;
  Props parts_, canvases_;
};

}  // namespace bw::scene
