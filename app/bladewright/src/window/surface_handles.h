// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <QObject>
#include <QPointF>
#include <QString>

#include <optional>
#include <string>
#include <vector>

#include "bw/core/shape/designed_surface.h"
#include "bw/scene/scene.h"
#include "bw/view/scene_view.h"
#include "window/handle_numbers.h"
#include "workbench/workbench.h"

namespace bw::app {

/// The handles of a designed surface in the 3D view: its poles, or the points of its section curves, each
/// moved up and down. A pole is pulled in whole mm, or from line to line of a grid, with Shift in steps of 10
/// of these, with Ctrl by a tenth of the way of the hand. Esc gives a pull up; a click with Shift chooses
/// several, which move together.
class SurfaceHandles : public QObject {
  Q_OBJECT

 public:
  SurfaceHandles(Workbench& bench, view::SceneView* view);

  bool shown() const { return shown_; }
  void setShown(bool shown);
  /// Whether there is anything to take hold of.
  bool possible() const;
  /// Adds the handles to a style.
  void applyTo(scene::Style& style) const;

  /// Those that move together, the one chosen last at the end.
  const std::vector<int>& chosen() const { return chosen_; }
  void choose(std::vector<int> handles);
  /// Tells the height of the one chosen last beside it, as of one under the cursor.
  void tellChosen(bool on);
  /// Whether what is moved takes its mirror image with it.
  bool symmetric() const { return symmetric_; }
  void setSymmetric(bool on);
  /// Whether heights and places are taken from a grid; its spacing, mm.
  bool snapping() const { return snapping_; }
  double grid() const { return grid_; }
  void setSnapping(bool on) { snapping_ = on; }
  void setGrid(double spacing) { grid_ = spacing; }
  /// What a move is counted by, mm.
  double step() const { return snapping_ ? grid_ : 1; }

  /// The point of a section that was chosen last, where one alone is chosen; nothing else is one.
  std::optional<SectionPoint> sectionPoint() const;
  /// Add and remove what is of it.
  void addPoint();
  void removePoint();
  void addSection();
  void removeSection();

  QString nameOf(int handle) const;
  Eigen::Vector3d placeOf(int handle) const { return places()[std::size_t(handle)]; }

 signals:
  /// What applyTo() adds is another.
  void changed();
  /// Other handles are chosen, or one is taken hold of.
  void chosenChanged();

 private:
  /// Numbers of the surface as they were when a handle was pressed.
  struct Pull {
    int handle = -1;
    DesignedSurface from;
    double began = 0;  ///< mm along the way, where the hand took hold
    double by = 0;     ///< mm that it moved since
    int mergeId = -1;
    bool moved = false;
    double wished = 0;                                      ///< mm, where the hand is
    double step = 1;                                        ///< mm, of the heights
    std::optional<pipeline::Bar> stoppedBy = std::nullopt;  ///< why it lags behind the hand
  };

  std::vector<Eigen::Vector3d> places() const;
  Eigen::Vector3d way() const;  ///< unit, on which handles move
  /// Where the ray through a place of the view comes nearest to the way through a point, mm along it.
  std::optional<double> along(const QPointF& position, const Eigen::Vector3d& through) const;
  double heightOf(const DesignedSurface& surface, int handle) const;

  void press(int handle, const QPointF& position, Qt::KeyboardModifiers keys);
  void move(int handle, const QPointF& position, Qt::KeyboardModifiers keys);
  void release(int handle, bool givenUp);
  void hover(int handle);
  void follow(const Change& change);
  /// Moves the handles to the hand, as far as they may go.
  void keepWithin();
  static QString wordsOf(pipeline::Bar bar);
  /// Those that move together.
  std::vector<int> held() const;
  /// Moves the handles pulled by so many mm from where they were.
  void pull(double by, bool live);

  Workbench& bench_;
  view::SceneView* view_;
  bool shown_ = true;
  int hovered_ = -1;
  bool symmetric_ = false, snapping_ = false;
  double grid_ = 10;
  bool told_ = false;   ///< the one chosen last
  std::string source_;  ///< whose handles they are
  std::vector<int> chosen_;
  std::optional<Pull> pull_;
};

}  // namespace bw::app
