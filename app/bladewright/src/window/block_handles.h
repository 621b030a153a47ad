// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <QKeyEvent>
#include <QObject>
#include <QPointF>
#include <QString>

#include <optional>
#include <string>

#include "bw/core/base/frame.h"
#include "bw/scene/scene.h"
#include "bw/view/scene_view.h"
#include "controls/hand_pace.h"
#include "window/handle_field.h"
#include "window/handle_snap.h"
#include "window/surface_handles.h"
#include "workbench/workbench.h"

namespace bw::app {

/// What of a block is taken hold of: its faces, the rings that turn it about its middle (each changes one of
/// its rotations), the spokes that move its corner along x, y and z, the tip of the arrow that the blade
/// travels along, and the mast of the plane in its middle, by which all planes lean.
enum class BlockPart {
  left,
  right,
  front,
  back,
  bottom,
  top,
  turnX,
  turnY,
  turnZ,
  moveX,
  moveY,
  moveZ,
  direction,
  lean
};

/// The handles of the block that is selected, in the 3D view beside those of the surface. A face is pulled
/// along its normal, a spoke along its own way: size and place are counted in mm or by the grid of the
/// handles; the rings and the arrow are turned in steps of 15°, with Shift of 45°, with Ctrl or Alt of 1°,
/// the mast in 5°, 15° and 1°.
/// Esc gives a pull up. The handle pressed last takes the arrow keys, and numbers typed. Blocks of a grid are
/// neither resized, moved nor turned here, and say so.
class BlockHandles : public QObject {
  Q_OBJECT

 public:
  BlockHandles(Workbench& bench, view::SceneView* view, SurfaceHandles& surface);

  /// Adds the handles to a style that has those of the surface.
  void applyTo(scene::Style& style) const;
  /// The handle of the picture that a part is; −1 where it is none.
  int handleOf(BlockPart part) const;
  const QFrame& field() const { return *field_; }

 signals:
  /// What applyTo() adds is another.
  void changed();
  /// Why what was pressed does not move.
  void told(const QString& why);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  /// The block as it stands now.
  struct Standing {
    BlockPlacement placed;
    Box box, lies;           ///< as it is placed, and as it lies for the cut at work
    Eigen::Vector3d travel;  ///< unit
    bool travelled = false;  ///< across its vertical, so that it can be turned
    bool gridded = false;    ///< it is one of several of a grid
  };
  /// What is moved, from the press of a handle or the first key on.
  struct Pull {
    BlockPart part;
    bool held;  ///< by the mouse
    Design from;
    Standing was;
    double began = 0;  ///< where the hand took hold: mm along the normal, or degrees
    double value = 0;  ///< of the part now
    int mergeId = -1;
    bool moved = false;
    SnapThings things = {};                   ///< what a face may be brought in line with
    std::optional<Snap> snap = std::nullopt;  ///< what it lies in line with now
  };

  std::optional<Standing> standing() const;
  static double valueOf(const Standing& standing, BlockPart part);
  /// What a part may become of what it is wished to be.
  static double within(const Standing& was, BlockPart part, double value);
  static Eigen::Vector3d placeOf(const Standing& standing, BlockPart part);
  /// The way that a face or a spoke is pulled along, unit, as its number grows.
  static Eigen::Vector3d wayOf(const Standing& standing, BlockPart part);
  /// mm, the radius of a ring, and where in its plane it is taken hold of, degrees.
  static double ringOf(const Standing& standing, BlockPart part);
  static double ringAngle(const Standing& standing, BlockPart part);
  /// A ring, or an arc of it about where it is taken hold of.
  static scene::Polyline ringLine(const Standing& standing, BlockPart part, bool whole);
  /// The travel of the blade with another value of the arrow or the mast.
  static Eigen::Vector3d travelWith(const Standing& was, BlockPart part, double value);
  /// Where the plane of the blade through the middle of the block leaves it.
  static scene::Polyline middlePlaneOf(const Standing& standing);
  /// The plane in which a part turns.
  static Frame planeOf(const Standing& standing, BlockPart part);
  /// What a part is counted by.
  HandSteps stepsOf(BlockPart part) const;
  QString nameOf(BlockPart part) const;
  QString textOf(const Standing& standing, BlockPart part) const;
  /// The other blocks, and how far the surfaces of the cuts reach along the axes of this one.
  SnapThings snapThings(const Standing& standing) const;
  /// What a face that the hand has moved by so many mm along its normal is brought in line with.
  std::optional<Snap> snapOf(BlockPart part, double by) const;
  /// Why a part does not move; empty where it does.
  QString whyFixed(const Standing& standing, BlockPart part) const;
  std::optional<BlockPart> partOf(int handle) const;

  void press(int handle, const QPointF& position);
  void move(int handle, const QPointF& position, Qt::KeyboardModifiers keys);
  void release(int handle, bool givenUp);
  void hover(int handle);
  void follow(const Change& change);
  bool pressKey(const QKeyEvent& key);
  void nudge(double steps, const QKeyEvent& key);
  void openField(const QKeyEvent* typed);
  void begin(BlockPart part, bool held, const Standing& standing);
  /// Gives the part that is pulled another value.
  void pull(double value, bool live);
  /// Where the part that was typed stands for an expression: the corner follows, so that the face opposite of
  /// it, or the middle of the block, stays.
  void bindCorner(const Standing& was, BlockPart part, const std::string& expression);
  /// Where a rotation stands for an expression, and the corner hung on it when the pull began: the corner
  /// hangs on it as the block stands now.
  void bindCornerAnew();
  void giveUp();
  void endPull();
  void choose(std::optional<BlockPart> part);
  /// Whether what is chosen is a handle of another block or cut than that at work.
  bool isOfAnother() const;

  Workbench& bench_;
  view::SceneView* view_;
  SurfaceHandles& surface_;
  HandleField* field_;
  std::optional<BlockPart> hovered_, chosen_;
  std::string block_ = {}, cut_ = {};  ///< that `chosen_` is of
  std::optional<Pull> pull_;
  bool pulling_ = false;  ///< the change of the design is its own
};

}  // namespace bw::app
