// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bw/core/base/finding.h"
#include "bw/core/base/frame.h"
#include "bw/core/base/result.h"
#include "bw/core/surface/mesh.h"

namespace bw::scene {

/// Where a thing belongs, each level counted from 0; −1 stands for all of that level.
struct ItemId {
  int block = -1, cut = -1, strip = -1, station = -1;
  auto operator<=>(const ItemId&) const = default;
  /// The same without the station: the row of blades.
  ItemId row() const { return {block, cut, strip, -1}; }
};

using Polyline = std::vector<Eigen::Vector3d>;

/// What a thing is.
enum class Kind { none, target, cut, station, blade, block, face, travel, part, crease, told };

/// A cut surface with its fields.
struct CutSurface {
  SurfaceGrid grid;
  /// mm, of each of its points: how deep it lies in the foam that other cuts leave; what lies outside of it
  /// is not drawn. Empty: all of it is.
  std::vector<double> depths = {};
  std::map<std::string, double> limits;  ///< of its fields, > 0: the legend begins at 0 and marks them
};
/// The fitted part of each station.
struct Stations {
  std::vector<Polyline> lines;
};
/// The whole blade of each station; those of its stations have the same id.
struct Blades {
  std::vector<Polyline> lines;
};
/// All faces of the file, to choose among them; the first such item is shown.
struct Faces {
  std::shared_ptr<const FaceMesh> mesh;  ///< not null
};
/// The way the blade goes in a cut; an arrow beside its block shows that of the row whose blade moves.
struct Travel {
  Eigen::Vector3d direction;
};

/// What is left of the block of that id; of a single cut it is shown where the style says so.
struct FoamPart {
  TriangleMesh mesh;
  bool ofOneCut = false;
};

/// Where two cut surfaces of a block meet, by the block, the one as `cut` and the other as `strip` of its id:
/// as designed, or not measured, and farther from there than it may be.
struct Creases {
  std::vector<Polyline> within, beyond;
  /// The same without a break, and mm that each point is off, NaN where that is not known: what the map
  /// "crease" shows. Empty where it is not measured.
  std::vector<Polyline> curves = {};
  std::vector<std::vector<double>> off = {};
};

/// Blades that are told but that no blade can be, by their surface as `cut` of their id: marked over it.
struct ToldMarks {
  std::vector<Polyline> lines;
};

/// A thing in the picture.
struct Item {
  ItemId id;
  std::variant<TriangleMesh, CutSurface, Stations, Blades, Box, Faces, Travel, FoamPart, Creases,
               ToldMarks>
      data;  ///< in the order of Kind
  Kind kind() const { return Kind(data.index() + 1); }
};

/// What a picture shows, as plain values.
struct Content {
  std::vector<Item> items;
  std::optional<double> covered = std::nullopt;  ///< share of the targets that is cut; empty: not known

  /// The first thing of that sort, or null.
  template <class Thing>
  Thing* first() {
    for (Item& item : items)
      if (Thing* thing = std::get_if<Thing>(&item.data)) return thing;
    return nullptr;
  }
  template <class Thing>
  const Thing* first() const {
    return const_cast<Content*>(this)->first<Thing>();
  }
  void add(const ItemId& id, decltype(Item::data) data) { items.push_back({id, std::move(data)}); }
  void remove(Kind kind) {
    std::erase_if(items, [kind](const Item& item) { return item.kind() == kind; });
  }
};

/// A plane through the scene: what lies on the side that `normal` points to is taken away.
struct SectionPlane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  bool operator==(const SectionPlane&) const = default;
};

/// The place of a finding: a ring at the point, with its words beside it.
struct Marker {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  std::string text;
  Severity severity = Severity::info;
  bool operator==(const Marker&) const = default;
};

/// The way on which a handle is moved, as far as it may go: from one end to the other, mm, and whether
/// something stops it there.
struct HandleWay {
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();
  bool endsAtFrom = false, endsAtTo = false;
  bool operator==(const HandleWay&) const = default;
};

/// Where a handle may go in its plane: a polygon around it, of which some sides are borders beyond which it
/// may not.
struct HandleRegion {
  Polyline corners;
  std::vector<char> ends;  ///< of the side from each corner to the next
};

/// Places of which a hand takes hold, over everything.
struct Handles {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 2>> lines;  ///< between two of them
  std::vector<Polyline> curves;           ///< beside them
  std::size_t quiet = 0;                  ///< the first so many stand back behind the others
  std::vector<int> chosen;                ///< those that move together
  int lit = -1;                           ///< the one that is held, or under the cursor
  std::string text;                       ///< beside it
  bool stopped = false;                   ///< it goes no farther
  std::vector<HandleWay> ways;            ///< of all that move with it
  HandleRegion region = {};               ///< of the one that is held
};

/// How a thing is shown.
struct Look {
  bool visible = true;
  double opacity = 1;
  std::string map = "none";  ///< of a cut surface: a word of bw::cutMaps(), or "none"
};

/// How it is shown.
struct Style {
  Style();
  /// How things of a kind are shown. The legend is that of the map of Kind::cut.
  Look& operator[](Kind kind) { return kinds[std::size_t(kind)]; }
  const Look& operator[](Kind kind) const { return kinds[std::size_t(kind)]; }
  /// How one thing is shown: as `items` says, otherwise as its kind is.
  const Look& of(Kind kind, const ItemId& id) const;

  std::array<Look, std::size_t(Kind::told) + 1> kinds;
  std::map<std::pair<Kind, ItemId>, Look> items;  ///< of any kind but faces
  bool dark = false;
  bool isolines = false;
  bool legend = true;
  bool showGrid = true;
  bool partsOfOneCut = false;                ///< also what a single cut leaves of its block
  double tolerance = 2.0;                    ///< mm: the band of the deviation map that stays pale
  std::optional<double> rangeMin, rangeMax;  ///< of the legend; empty = round numbers around the data
  ItemId selected;                           ///< a station, or none
  ItemId moving{0, 0, 0};                    ///< the row whose blade moves
  double playhead = -1;  ///< position of the moving blade in stations (fractional), −1 = none
  Polyline movingBlade;  ///< where it is then; empty = between the blades of the stations
  bool stale = false;    ///< results are out of date: drawn at 60 %
  bool softShadows =
      true;  ///< ambient occlusion of solid things; weaker under a map, which keeps its colours
  std::optional<SectionPlane> section;  ///< cuts the scene open; the foam met is hatched
  std::optional<Marker> marker;         ///< stands before everything
  Handles handles;                      ///< stand before all but that
  /// The faces of the file stand in for the result: `chosenFaces` solid, the others pale, and a pick finds
  /// them.
  bool chooseFaces = false;
  std::vector<int> chosenFaces;  ///< indices of Faces::mesh
  int hoveredFace = -1;          ///< lights up while faces are chosen
  double pixelRatio = 1.0;
};

/// Standard views.
enum class View { iso, top, bottom, front, back, left, right };
std::optional<View> viewFromName(const std::string& name);
/// The direction from the focus to the camera, unit.
Eigen::Vector3d directionOf(View view);

/// Camera as numbers, to animate and to store.
struct Camera {
  Eigen::Vector3d position, focus, up;
  double viewAngle = 30;  ///< degrees, of the height
  bool parallel = false;
  double parallelScale = 100;  ///< mm, half of the height
};

/// What lies under a pixel.
struct Pick {
  using Kind = scene::Kind;
  Kind kind = Kind::none;
  ItemId id;       ///< of the thing
  ItemId station;  ///< the one that was hit, or the nearest to what was
  int face = -1;   ///< index of Faces::mesh, for Kind::face
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  std::optional<double> value;  ///< of the shown field
};

/// Of a picture, in pixels; of both sides at least one pixel is meant.
struct PictureSize {
  int width = 0, height = 0;
};

/// A rectangle in pixels from the upper left corner of a picture.
struct PixelRect {
  double x = 0, y = 0, width = 0, height = 0;
  bool contains(double px, double py) const {
    return px >= x && py >= y && px < x + width && py < y + height;
  }
  bool overlaps(const PixelRect& other) const {
    return x < other.x + other.width && other.x < x + width && y < other.y + other.height &&
           other.y < y + height;
  }
};

/// What lies over the scene in a picture: for hit tests and for checks that nothing is cut off.
struct Overlay {
  struct Text {
    std::string text;
    PixelRect box;
  };
  std::optional<PixelRect> legend;  ///< the whole card
  std::optional<PixelRect> bar;     ///< its colour bar; the upper edge is legendRange().second
  std::optional<PixelRect> marker;  ///< the orientation cube
  std::optional<PixelRect> place;   ///< the ring of Style::marker
  std::optional<PixelRect> label;   ///< the card with its words
  std::optional<PixelRect> handle;  ///< the card with the words of the handle that is lit
  std::vector<Text> texts;  ///< of the legend, the isolines, the label, the handle and the ground grid
};

/// An RGB picture, row by row from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// The scene: content and style to VTK actors. Renders offscreen (surfaceless EGL) for tests and the command
/// line; bw_view hands it the render window of a widget. Not thread-safe.
class Scene {
 public:
  Scene();
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  /// Replaces the content; the camera stays.
  void setContent(Content content);
  /// Puts things in the place of those of the same kind and id, and adds what is new; all others stay as they
  /// are, and only what is given costs time. The picture is that of `setContent` with all of it.
  void replace(Content content);
  /// Draws from now on as while the picture moves, without what costs time: smoothing, soft shadows, and more
  /// of large cut surfaces than the eye then sees.
  void setDraft(bool draft);
  /// Cheap where only the style changed: actors are kept.
  void setStyle(const Style& style);
  const Style& style() const;
  const Content& content() const;

  /// The legend's range in use (after rounding), if a field is shown.
  std::optional<std::pair<double, double>> legendRange() const;

  /// A camera that looks along a standard view and fits the work (or `bounds`) into a picture, beside the
  /// legend where one is shown.
  Camera fitCamera(View view, const PictureSize& picture,
                   const std::optional<Bounds>& bounds = std::nullopt) const;
  /// Looks from the direction `back` (focus to camera, not zero), level, and fits the work (or `bounds`).
  Camera fitFrom(const Eigen::Vector3d& back, bool parallel, const PictureSize& picture,
                 const std::optional<Bounds>& bounds = std::nullopt) const;
  /// Fits everything (or `bounds`), keeping the present direction.
  Camera fitCamera(const Camera& from, const PictureSize& picture,
                   const std::optional<Bounds>& bounds = std::nullopt) const;
  /// Fits the work, keeping the present direction.
  Camera fitWork(const Camera& from, const PictureSize& picture) const;
  /// Everything that is shown.
  Bounds bounds() const;
  /// What the picture is about: block, cut surface and whole blades, and the target unless it is far larger
  /// than the block. Without a cut or a block, all that there is.
  Bounds workBounds() const;
  void setCamera(const Camera& camera);
  Camera camera() const;

  /// What lies under the pixel (x, y; from the upper left corner) of a picture of that size taken with the
  /// present camera. A line within four pixels (times the pixel ratio) wins over the surface that carries it.
  /// `station` is the nearest station wherever a surface or line is hit. Needs no GL. The first call after a
  /// new content builds a search tree.
  Pick pick(double x, double y, int width, int height) const;
  /// The direction to look from that the orientation cube offers under that pixel: each component −1, 0 or 1;
  /// one of them differs from 0 on a face, two on an edge, three at a corner.
  std::optional<Eigen::Vector3d> cubeDirection(double x, double y, int width, int height) const;
  /// Layout of the last rendered picture; empty before the first.
  const Overlay& overlay() const;

  /// Renders offscreen at that size in pixels. Fails with a clear message where no GL is to be had.
  Result<Picture> render(int width, int height);

  struct Impl;
  Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;  ///< never null, except after a move
};

/// PNG bytes of a picture.
Result<std::string> pngBytes(const Picture& picture);

}  // namespace bw::scene
