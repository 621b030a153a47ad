// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "scene/actors/orientation_marker.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkTexture.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace bw::scene {

namespace {

constexpr double kSize = 116;  ///< device-independent pixels, of the square that holds the cube
constexpr double kCornerMargin = 10;
constexpr double kReach = 2.15;   ///< half of the square, in half edges of the cube
constexpr double kBorder = 0.42;  ///< of a half edge: the strips along the edges that stand for oblique views
constexpr double kAxis = 1.0;     ///< how far the axes reach beyond the cube, in half edges

struct Face {
  const char* word;
  Eigen::Vector3d out, up;  ///< as the face is read
  double shade;             ///< lighter from above, darker on the sides that turn away, as in daylight
};

const std::array<Face, 6>& faces() {
  static const std::array<Face, 6> kFaces{{{"Front", {0, -1, 0}, {0, 0, 1}, 0.05},
                                           {"Back", {0, 1, 0}, {0, 0, 1}, 0.05},
                                           {"Left", {-1, 0, 0}, {0, 0, 1}, 0.10},
                                           {"Right", {1, 0, 0}, {0, 0, 1}, 0.10},
                                           {"Top", {0, 0, 1}, {0, 1, 0}, 0.0},
                                           {"Bottom", {0, 0, -1}, {0, -1, 0}, 0.16}}};
  return kFaces;
}

Box cube() {
  Box box;
  box.frame.origin = Eigen::Vector3d::Constant(-1);
  box.size = Eigen::Vector3d::Constant(2);
  return box;
}

}  // namespace

OrientationMarker::OrientationMarker(Layers& layers) : renderer_(vtkSmartPointer<vtkRenderer>::New()) {
  layers.add(Layer::overlay, canvas_);
  renderer_->SetLayer(1);
  renderer_->InteractiveOff();
  for (std::size_t i = 0; i < 6; ++i) {
    const Face& face = faces()[i];
    const auto points = vtkSmartPointer<vtkPoints>::New();
    const auto coordinates = vtkSmartPointer<vtkFloatArray>::New();
    coordinates->SetNumberOfComponents(2);
    coordinates->SetName("place");
    const auto cells = vtkSmartPointer<vtkCellArray>::New();
    cells->InsertNextCell(4);
    for (const auto& [u, v] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
      const Eigen::Vector3d p = face.out + (2 * u - 1) * face.up.cross(face.out) + (2 * v - 1) * face.up;
      cells->InsertCellPoint(points->InsertNextPoint(p.data()));
      coordinates->InsertNextTuple2(u, v);
    }
    faces_[i].data()->SetPoints(points);
    faces_[i].data()->SetPolys(cells);
    faces_[i].data()->GetPointData()->SetTCoords(coordinates);
    faces_[i].property()->BackfaceCullingOn();
    faces_[i].setFlat();
    textures_[i] = vtkSmartPointer<vtkTexture>::New();
    textures_[i]->InterpolateOn();
    textures_[i]->MipmapOn();
    faces_[i].actor()->SetTexture(textures_[i]);
    renderer_->AddActor(faces_[i].actor());
  }
  hovered_.setFlat();
  hovered_.setOpacity(0.45);
  hovered_.setDepthShift(-0.002);
  hovered_.setVisible(false);
  renderer_->AddActor(hovered_.actor());
  edges_.setSegments(edgesOf(cube()));
  edges_.setFlat();
  edges_.setDepthShift(-0.004);
  renderer_->AddActor(edges_.actor());
  for (int axis = 0; axis < 3; ++axis) {
    Part& part = axes_[std::size_t(axis)];
    const Eigen::Vector3d origin = Eigen::Vector3d::Constant(-1);
    part.setSegments({{origin, origin + (2 + kAxis) * Eigen::Vector3d::Unit(axis)}});
    part.setFlat();
    part.setDepthShift(-0.008);
    renderer_->AddActor(part.actor());
  }
}

PixelRect OrientationMarker::place(int height, double pixelRatio) {
  const double size = std::round(kSize * pixelRatio), margin = std::round(kCornerMargin * pixelRatio);
  return {margin, height - margin - size, size, size};
}

void OrientationMarker::paintFaces(bool dark, double pixelRatio) {
  const Theme& colors = theme(dark);
  const int size = std::clamp(int(std::lround(128 * pixelRatio)), 64, 512);
  const auto property = vtkSmartPointer<vtkTextProperty>::New();
  useInterfaceFont(property, false);
  property->SetFontSize(std::max(8, int(std::lround(size * 0.215))));
  property->SetColor(1, 1, 1);
  for (std::size_t i = 0; i < 6; ++i) {
    const double shade = faces()[i].shade;
    const Rgb ground = dark ? mix(Rgb::hex(0x454B54), Rgb::hex(0x24272C), 3 * shade)
                            : mix(Rgb::hex(0xFFFFFF), Rgb::hex(0x8C96A3), 1.6 * shade);
    const auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(size, size, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    const auto word = vtkSmartPointer<vtkImageData>::New();
    std::array<int, 2> extent{};
    vtkTextRenderer* writer = vtkTextRenderer::GetInstance();
    const bool written = writer && writer->RenderString(property, faces()[i].word, word, extent.data(), 72);
    std::array<int, 3> given{};
    if (written) word->GetDimensions(given.data());
    const int x0 = (size - extent[0]) / 2, y0 = (size - extent[1]) / 2;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        double ink = 0;
        if (written && x >= x0 && y >= y0 && x - x0 < std::min(extent[0], given[0]) &&
            y - y0 < std::min(extent[1], given[1])) {
          ink = static_cast<unsigned char*>(word->GetScalarPointer(x - x0 + word->GetExtent()[0],
                                                                   y - y0 + word->GetExtent()[2], 0))[3] /
                255.0;
        }
        const Rgb c = mix(ground, dark ? colors.text : Rgb::hex(0x4A5058), ink);
        auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
        pixel[0] = (unsigned char)(std::lround(255 * c.r));
        pixel[1] = (unsigned char)(std::lround(255 * c.g));
        pixel[2] = (unsigned char)(std::lround(255 * c.b));
      }
    }
    textures_[i]->SetInputData(image);
  }
}

void OrientationMarker::update(const Projection& view, int width, int height, const Style& style) {
  const Theme& colors = theme(style.dark);
  const PixelRect square = place(height, style.pixelRatio);
  const std::array<Rgb, 3> axisColors{colors.axisX, colors.axisY, colors.axisZ};
  const bool fits = width > 2.5 * square.width && height > 2 * square.height;
  renderer_->SetDraw(fits);
  canvas_.begin(height);
  if (!fits) {
    canvas_.end();
    return;
  }
  if (dark_ != style.dark || pixelRatio_ != style.pixelRatio) {
    dark_ = style.dark;
    pixelRatio_ = style.pixelRatio;
    paintFaces(style.dark, style.pixelRatio);
    edges_.setLine(style.dark ? Rgb::hex(0x6C737C) : Rgb::hex(0xADB5BD), style.pixelRatio);
    hovered_.setColor(colors.selection);
    for (std::size_t k = 0; k < 3; ++k) {
      axes_[k].setLine(axisColors[k], 2 * style.pixelRatio);
    }
  }
  renderer_->SetViewport(square.x / width, 1 - (square.y + square.height) / height,
                         (square.x + square.width) / width, 1 - square.y / height);
  vtkCamera* camera = renderer_->GetActiveCamera();
  const Eigen::Vector3d eye = -10 * view.forward();
  camera->SetFocalPoint(0, 0, 0);
  camera->SetPosition(eye.data());
  camera->SetViewUp(view.up().data());
  camera->ParallelProjectionOn();
  camera->SetParallelScale(kReach);
  camera->SetClippingRange(5, 15);

  // Letters at the tips of the axes, unless an axis points at the viewer.
  const double scale = 0.5 * square.height / kReach, cx = square.x + 0.5 * square.width,
               cy = square.y + 0.5 * square.height;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(view.forward()[axis]) > 0.97) continue;
    const Eigen::Vector3d tip =
        Eigen::Vector3d::Constant(-1) + (2 + kAxis + 0.35) * Eigen::Vector3d::Unit(axis);
    canvas_.text(std::string(1, "xyz"[axis]), cx + scale * tip.dot(view.right()),
                 cy - scale * tip.dot(view.up()), Align::center,
                 {12 * style.pixelRatio, true, axisColors[std::size_t(axis)]});
  }
  canvas_.end();
}

std::optional<Eigen::Vector3d> OrientationMarker::directionAt(double x, double y, const Projection& view,
                                                              int width, int height, double pixelRatio) {
  const PixelRect square = place(height, pixelRatio);
  if (width <= 2.5 * square.width || height <= 2 * square.height || !square.contains(x, y))
    return std::nullopt;
  const double scale = 0.5 * square.height / kReach;
  const Eigen::Vector3d origin = (x - square.x - 0.5 * square.width) / scale * view.right() -
                                 (y - square.y - 0.5 * square.height) / scale * view.up() -
                                 10 * view.forward();
  const std::optional<double> t = rayMeetsBox({origin, view.forward()}, cube());
  if (!t) return std::nullopt;
  const Eigen::Vector3d hit = origin + *t * view.forward();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(hit[axis]) > 1 - kBorder) direction[axis] = hit[axis] > 0 ? 1 : -1;
  return direction;
}

void OrientationMarker::setHovered(const std::optional<Eigen::Vector3d>& direction) {
  hovered_.setVisible(direction.has_value());
  if (!direction) return;
  // On each face that has a part of the place under the cursor: its square, strip or corner.
  std::vector<Polyline> patches;
  for (int axis = 0; axis < 3; ++axis) {
    if ((*direction)[axis] == 0) continue;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto range = [&](int k) {
      const double side = (*direction)[k];
      return side == 0  ? std::pair(-1 + kBorder, 1 - kBorder)
             : side > 0 ? std::pair(1 - kBorder, 1.0)
                        : std::pair(-1.0, -1 + kBorder);
    };
    Polyline patch;
    for (const auto& [a, b] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
      Eigen::Vector3d p;
      p[axis] = (*direction)[axis];
      p[u] = a ? range(u).second : range(u).first;
      p[v] = b ? range(v).second : range(v).first;
      patch.push_back(p);
    }
    patches.push_back(patch);
  }
  hovered_.setPolygons(patches);
}

}  // namespace bw::scene
