// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "scene/actors/grid_lines.h"
#include "scene/actors/mesh_lines.h"
#include "scene/camera/picking.h"
#include "scene/render/layers.h"
#include "scene/render/polyline.h"
#include "scene/things.h"

namespace bw::scene {

/// The values that stand on isolines: each at a fixed place of its line, where it is seen and there is room.
class IsolineLabels {
 public:
  explicit IsolineLabels(Layers& layers) { layers.add(Layer::overlay, canvas_); }
  void clear() { places_.clear(); }
  /// Chooses places on more lines. `text` gives the words of a level; lines shorter than a share of
  /// `diagonal` (mm) get none.
  void add(const std::vector<Isoline>& lines, const std::function<std::string(double)>& text,
           double diagonal);
  /// Lays them out for a picture. `taken` is what they keep clear of; `seen` tells whether a place is in
  /// sight.
  void update(const Projection& view, int width, int height, double pixelRatio,
              const std::vector<PixelRect>& taken, const std::function<bool(const Eigen::Vector3d&)>& seen);
  const std::vector<Overlay::Text>& texts() const { return canvas_.texts(); }

 private:
  struct Place {
    Eigen::Vector3d point;
    std::string text;
    double rank;
  };
  Canvas canvas_;
  std::vector<Place> places_;  ///< the most important first
};

/// The cut surface of a row in fewer rows and columns.
class ThinnedSurface {
 public:
  Part& part() { return part_; }
  /// Forgets what was made.
  void clear();
  /// Makes it of so much of the surface, unless it is that already.
  void make(const Row& row, const KeptLines& kept);

 private:
  Part part_;
  TriangleMesh mesh_;                        ///< VTK reads it in place
  std::vector<std::vector<double>> fields_;  ///< and these
  KeptLines kept_;
};

/// A cut surface with its map, its borders and its isolines.
class CutActors {
 public:
  explicit CutActors(Layers& layers);
  /// All that it draws.
  std::array<Part*, 6> parts() {
    return {&surface_, &resting_.part(), &moving_.part(), &edges_, &isolines_, &coarseLines_};
  }
  /// What shades and is shaded, of which one is seen at a time.
  std::array<Part*, 2> solids() { return {&surface_, &solid_.part()}; }
  /// Shares the arrays of the row, which stays where it is until the next call; null hides it.
  void setContent(const Row* row);
  void setStyle(const Style& style, const Rgb& background);
  /// `line` is the depth shift that brings a line before the surface that it lies on, `pixel` the size of
  /// one, mm. Of the rows and columns of the surface so many are drawn that it looks the same; in a `draft`,
  /// whose lines are drawn bare, every `stride`-th, and the last; so are then the points of its isolines.
  void update(double line, double pixel, int stride, bool draft);
  /// Adds the values that stand on its isolines, if they are shown.
  void label(IsolineLabels& labels, double diagonal) const;
  /// Largest deviation, mm.
  double reach() const { return reach_; }

 private:
  std::array<Part*, 4> surfaces() { return {&surface_, &resting_.part(), &moving_.part(), &solid_.part()}; }
  /// Those in which the surface looks the same, with its map and without.
  void findLinesAtRest(double pixel);
  void makeCoarseLines(int stride);

  Part surface_, edges_, isolines_, coarseLines_;
  ThinnedSurface resting_, moving_, solid_;  ///< in fewer rows and columns; the last for shadows alone
  int lineStride_ = 0;                       ///< of `coarseLines_`; 0: not made yet
  KeptLines atRest_, bare_;                  ///< of what is told by these, with the map and without
  double pixel_ = -1;                        ///< mm; below 0: not found yet
  std::string pixelField_;
  double pixelRange_ = 0;
  bool shown_ = false;
  vtkSmartPointer<vtkLookupTable> table_;
  ColorMap tableMap_;
  const Row* row_ = nullptr;
  std::vector<Isoline> lines_;
  Ticks levels_;          ///< that the isolines were made for
  std::string isolined_;  ///< the field that they were made of; empty: none
  bool lined_ = false;
  double reach_ = 0;
};

/// The stations as lines, one of them selected, and the blades beyond them: solid in the foam, dashed
/// outside. Where the lines would crowd, only every second, fifth, tenth … is drawn.
class StationLines {
 public:
  explicit StationLines(Layers& layers);
  /// All that it draws.
  std::array<Part*, 5> parts();

  /// `diagonal` is the size of what is shown, mm: it gives the dashes their length. The row stays where it is
  /// until the next call; null hides the lines.
  void setContent(const Row* row, double diagonal);
  /// Another diagonal of the same row.
  void setDiagonal(double diagonal);
  void setStyle(const Style& style, const Rgb& background);
  /// Settles what depends on the view: the depth by which the lines stand before the surface that they lie
  /// on, and how many are drawn, from the size of a pixel at the focus. Of the points of a station every
  /// `along`-th is drawn, and the last.
  void update(const Style& style, double depthShift, double millimetresPerPixel, int along, bool draft);

 private:
  /// A blade beyond its station.
  struct Extensions {
    std::vector<Polyline> solid;
    Segments dashed;
  };
  void select(int index);
  void addExtensions(std::size_t index, Extensions& extensions) const;
  bool drawn(std::size_t index) const;
  void rebuildStations();
  void rebuild();

  Part stations_, selected_, selectedDashes_, bladesInside_, bladeDashes_;
  const Row* row_ = nullptr;
  bool valid_ = false, bladesShown_ = false;
  int stride_ = 1;  ///< every how many-th station is drawn
  int along_ = 1;   ///< and of its points
  int selectedIndex_ = -1;
  double dash_ = 1;     ///< mm
  double spacing_ = 0;  ///< mm, mean distance of neighbours
};

}  // namespace bw::scene
