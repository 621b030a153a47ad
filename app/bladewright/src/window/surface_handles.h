// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <QObject>
#include <QPointF>
#include <QString>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bw/core/shape/designed_surface.h"
#include "bw/pipeline/reach.h"
#include "bw/scene/scene.h"
#include "bw/view/scene_view.h"
#include "controls/hand_pace.h"
#include "window/handle_numbers.h"
#include "window/handle_snap.h"
#include "workbench/workbench.h"

namespace bw::app {

/// The handles of a designed surface in the 3D view: its poles, or the points of its section curves, each
/// moved up and down, and what lies in a plane across the travel in it where that is looked at. A pole is
/// pulled in whole mm, or from line to line of a grid, with Shift in steps of 10
/// of these, with Ctrl or Alt by a tenth of the way of the hand; without these it may snap to what it comes
/// in line with. Esc gives a pull up; a click with Shift chooses several, which move together. Whatever moves
/// them, they stop where the surface can no longer be cut, as soon as that is known, and say why: one that is
/// let go of before goes back as far then.
class SurfaceHandles : public QObject {
  Q_OBJECT

 public:
  SurfaceHandles(Workbench& bench, view::SceneView* view);

  bool shown() const { return shown_; }
  void setShown(bool shown);
  /// Whether there is anything to take hold of.
  bool possible() const;
  /// How many there are in the picture: the first of its handles.
  int count() const;
  /// Puts the handles into a style.
  void applyTo(scene::Style& style) const;

  /// Those that move together, the one chosen last at the end.
  const std::vector<int>& chosen() const { return chosen_; }
  void choose(std::vector<int> handles);
  /// Whether what is moved takes its mirror image with it; that, and the grid, is remembered.
  bool symmetric() const { return habits_.symmetric; }
  void setSymmetric(bool on);
  /// Whether heights and places are taken from a grid; its spacing, mm.
  bool snapping() const { return habits_.snapping; }
  double grid() const { return habits_.grid; }
  void setSnapping(bool on);
  void setGrid(double spacing);
  /// Whether the mouse brings them in line with faces and middles of blocks, and with other handles.
  bool meeting() const { return habits_.meeting; }
  void setMeeting(bool on);
  /// What the handle that is held lies in line with, since it was brought there.
  std::vector<Snap> snapped() const;
  /// The handle that is moved; −1: none.
  int pulled() const { return pull_ ? pull_->handle : -1; }
  /// What a move is counted by, mm.
  HandSteps steps() const;

  /// A hand takes hold of a handle elsewhere than in the 3D view, moves it in a plane by so many mm from
  /// there and lets go of it. With Shift it is chosen with others.
  void grab(int handle, Qt::KeyboardModifiers keys);
  /// `pixel`: mm of a pixel there.
  void drag(const Frame& plane, const Eigen::Vector2d& by, double pixel, Qt::KeyboardModifiers keys);
  void drop(bool givenUp);
  /// Unit, on which a number of the handles moves.
  Eigen::Vector3d way(HandleNumber number = HandleNumber::height) const;

  /// Moves those chosen so that a number of the last becomes `to`, or as far as it may go: the last number
  /// before that is counted by `step`. Moves that follow each other are one undoable step. `anyway`: the
  /// number takes the place of an expression, whether or not it is another.
  void bring(HandleNumber number, double to, double step, bool anyway = false);
  /// Moves them back to where the first of these began; false where there was none.
  bool takeBack();
  bool moving() const { return pull_ && !pull_->letGoAt; }
  /// What comes next is a step of its own.
  void endMoves();

  /// The point of a section that was chosen last, where one alone is chosen; nothing else is one.
  std::optional<SectionPoint> sectionPoint() const;
  /// The key blade of which one handle alone is chosen; nothing else is one.
  std::optional<int> keyBlade() const;
  /// Add and remove what is of it: sections are key blades where these tell the surface.
  void addPoint();
  void removePoint();
  void addSection();
  void removeSection();
  /// What the one chosen is of once more, as it is, next to it along the travel.
  void duplicate();
  /// Rows of poles, sections or key blades that those chosen are of, besides that of the one chosen last.
  std::vector<std::size_t> others() const;
  /// Gives these the shape of that of the last.
  void copyShape();

  QString nameOf(int handle) const;
  Eigen::Vector3d placeOf(int handle) const { return places()[std::size_t(handle)]; }

 signals:
  /// What applyTo() adds is another.
  void changed();
  /// Other handles are chosen, or one is taken hold of.
  void chosenChanged();
  /// Why one that was let go of went back.
  void told(const QString& why);

 private:
  static constexpr double kFarthest = 400;  ///< mm that a hand moves a handle at once

  /// Handles that are moved.
  struct Pull {
    int handle = -1;
    bool held = false;                     ///< by the mouse
    DesignedSurface from;                  ///< as it was when a handle was pressed, or the keyboard began
    DesignedSurface base;                  ///< as it was before this number of it moved
    std::shared_ptr<const Design> design;  ///< as it was when the pull began, with its expressions
    Eigen::Vector2d along = {0, 1};        ///< unit, across and up: on which it moves
    bool freely = false;                   ///< in its plane, not up and down alone
    Eigen::Vector2d began = {0, 0};        ///< mm across and up, where the hand took hold
    double by = 0;                         ///< mm that it moved since
    std::optional<double> letGoAt = {};    ///< that, before it was known whether it may stay there
    int mergeId = -1;
    bool moved = false;
    bool around = false;                           ///< where in its plane it may go is sought
    double wished = 0;                             ///< mm, where the hand is
    bool beyond = false;                           ///< the hand is farther than one pull goes
    std::array<std::optional<double>, 2> to = {};  ///< the numbers there, to their last digit
    double step = 1;                               ///< mm, of the numbers
    double farthest = kFarthest;                   ///< mm, so far its border is sought
    std::array<double, 2> ordered = {};            ///< mm, so far the points keep their order
    QString stoppedBy = {};                        ///< why it lags behind the hand
    /// Where it was stopped last, below and above.
    std::array<std::optional<pipeline::Reach::End>, 2> stops = {};
    std::vector<Snap> snaps = {};  ///< of where it is wished to be
  };

  std::vector<Eigen::Vector3d> places() const;
  /// What moves by so many mm across and up.
  Eigen::Vector3d wayBy(const Eigen::Vector2d& by) const;
  double heightOf(const DesignedSurface& surface, int handle) const;

  void begin(Pull pull);
  void press(int handle, const QPointF& position, Qt::KeyboardModifiers keys);
  /// Turns the section to a handle that is taken hold of.
  void lookBeside(int handle);
  void move(int handle, const QPointF& position, Qt::KeyboardModifiers keys);
  void release(int handle, bool givenUp);
  void hover(int handle);
  /// Where the hand is at a place of the view, mm across and up from where the handle was.
  std::optional<Eigen::Vector2d> handAt(const QPointF& position) const;
  void drag(const Eigen::Vector2d& by, double pixel, Qt::KeyboardModifiers keys);
  void follow(const Change& change);
  /// Moves the handles to the hand, as far as they may go.
  void keepWithin();
  /// Ends a pull that was let go of, where it is known how far that may go, or `anyway`.
  void settle(bool anyway);
  /// Those that move together.
  std::vector<int> held() const;
  /// How many these are with their mirrored ones, while one of them is pulled.
  int movingTogether() const;
  /// The surface with the handles pulled by so many mm from where they were.
  DesignedSurface pulledBy(double by) const;
  /// Whether the surface that is shown is another than the handles stand for.
  bool lagsBehind() const;
  /// The number that is moved alone, where `by` is 0; 0 where both are.
  double pulledFrom() const;
  /// `by`, or as far as the points keep their order.
  double orderedBy(double by, const Eigen::Vector2d& along) const;
  void pull(double by, bool live);
  /// What the handle that is held may snap to: nothing that moves with it.
  SnapThings snapThings() const;
  /// Puts what it snapped to into a style.
  void markSnaps(scene::Handles& handles) const;
  /// Makes the design what it was when the pull began.
  void giveUp();
  QString pullName() const;
  /// Seeks how far the handles pulled may go.
  void seek();
  /// Seeks where in its plane it may go.
  void seekAround();
  void endPull();
  /// How far each handle that is moved may go with the others.
  std::vector<scene::HandleWay> ways(const pipeline::Reach& reach) const;
  /// Where in its plane the one that is held may go.
  scene::HandleRegion region(const pipeline::Region& region) const;
  /// What is told beside the handle that is moved.
  std::string pullText() const;

  Workbench& bench_;
  view::SceneView* view_;
  bool shown_ = true;
  int hovered_ = -1;
  model::HandleHabits habits_;
  bool pulling_ = false;  ///< the change of the design is its own
  std::string source_;    ///< whose handles they are
  std::vector<int> chosen_;
  std::optional<Pull> pull_;
};

}  // namespace bw::app
